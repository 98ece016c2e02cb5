"""The simulation's statistics of commands: age, regularity, and how many were obeyed, coalesced or refused."""

import math
import time

import pytest
from geometry_msgs.msg import Vector3, Wrench

from ambf_msgs.msg import RigidBodyCmd, WorldCommandRates

pytestmark = pytest.mark.alone


@pytest.fixture
def told(bench, ros):
    listening = ros.listen("/ambf/env/World/CommandRates", WorldCommandRates)

    def wait_for(wanted, timeout=10.0):
        """The first account of the box from now on that is as wanted."""

        def box_of(message):
            return next((each for each in message.objects if each.name == "/ambf/env/Box"), None)

        message = listening.next(lambda m: box_of(m) is not None and wanted(box_of(m)), timeout)
        return message, box_of(message)

    return wait_for


def command(force):
    return RigidBodyCmd(cartesian_cmd_type=RigidBodyCmd.TYPE_FORCE, wrench=Wrench(Vector3(force, 0.0, 0.0), Vector3()))


def test_a_stream_is_measured_and_every_command_accounted_for(bench, ros, told):
    bench.allowed += [r"command to '.*' refused"]
    talk = ros.talk("/ambf/env/Box/Command", RigidBodyCmd)
    interval, sent, begin = 0.005, 0, time.monotonic()
    while time.monotonic() - begin < 3.5:
        talk.publish(command(0.0))
        sent += 1
        time.sleep(max(0.0, begin + sent * interval - time.monotonic()))
    period = (time.monotonic() - begin) / sent  # as kept, whatever else the machine does
    message, box = told(lambda m: m.in_force)
    assert message.watchdog == 0.5
    assert box.source == "topic"
    assert 0.0 < box.age < message.watchdog
    assert box.periods > 0
    assert box.period_mean == pytest.approx(period, rel=0.5)
    assert box.period_least <= box.period_mean <= box.period_most
    assert 0.0 < box.delay_least <= box.delay_mean <= box.delay_most

    _, box = told(lambda m: not m.in_force)
    assert box.received == sent
    assert box.applied + box.coalesced == sent
    assert box.applied > 0
    assert box.expired == 1
    assert box.age > message.watchdog

    talk.publish(command(math.nan))
    _, box = told(lambda m: m.refused > 0)
    assert (box.refused, box.received) == (1, sent)


def test_what_comes_faster_than_steps_is_coalesced(bench, ros, told):
    talk = ros.talk("/ambf/env/Box/Command", RigidBodyCmd)
    for _ in range(50):
        for _ in range(20):
            talk.publish(command(0.0))
        time.sleep(0.01)
    _, box = told(lambda m: not m.in_force and m.received > 0)
    assert box.coalesced > 0
    assert box.applied + box.coalesced == box.received
