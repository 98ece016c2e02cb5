"""Messages and requests that claim more than they hold: refused before anything is allocated for them (PR2)."""

import re
import struct
import time
import urllib.request
import xmlrpc.client
from io import BytesIO
from pathlib import Path

import pytest
import rospy
from harness import SLOWNESS

from ambf_msgs.msg import RigidBodyCmd, WorldRates
from ambf_msgs.srv import Forget, Load, LoadRequest, Remove, Restore, Snapshot, Step, StepRequest, Unload

HUGE = 500_000_000


class RawCommand(RigidBodyCmd):
    """Sent as the bytes that it is given."""

    raw = b""

    def serialize(self, buff):
        buff.write(self.raw)


class RawStep(StepRequest):
    raw = b""

    def serialize(self, buff):
        buff.write(self.raw)


def bytes_of(message):
    buffer = BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def peak_megabytes(simulator):
    text = Path(f"/proc/{simulator.pid}/status").read_text()
    return int(re.search(r"VmHWM:\s+(\d+)", text).group(1)) / 1024


@pytest.fixture
def hostile(bench):
    bench.allowed += [r"malformed", r"and \d+ more refused commands"]
    return bench


def test_lengths_that_lie_allocate_nothing_and_are_counted(hostile, ros):
    rates = ros.listen("/ambf/env/World/Rates", WorldRates)
    rates.last()
    before = peak_megabytes(hostile)

    # The length of joint_cmds is the last before three flags.
    lying = bytes_of(RigidBodyCmd())[:-7] + struct.pack("<I", HUGE) + b"\0\0\0"
    talk = ros.talk("/ambf/env/Box/Command", RawCommand)
    for raw in (lying, lying[:20], b""):
        message = RawCommand()
        message.raw = raw
        talk.publish(message)
    counted = rates.next(lambda m: m.refused_commands >= 3)
    assert dict(zip(counted.refused_names, counted.refused_counts, strict=True)) == {"/ambf/env/Box": 3}
    hostile.wait_log(rf"'/ambf/env/Box' refused: malformed message from /acceptance\S*: .* length of {HUGE}")

    # n, then the length of the first list of names.
    request = RawStep()
    request.raw = bytes_of(StepRequest())[:4] + struct.pack("<I", HUGE)
    step = ros.service("/ambf/env/World/Step", Step)
    step.request_class = RawStep
    with pytest.raises(rospy.ServiceException):
        step.call(request)
    counted = rates.next(lambda m: m.refused_commands >= 4)
    assert "/ambf/env/World/Step" in counted.refused_names
    hostile.wait_log(r"'/ambf/env/World/Step' refused: malformed request from /acceptance")

    assert peak_megabytes(hostile) - before < 32
    assert ros.service("/ambf/env/World/Step", Step)(n=1).success


def test_requests_for_too_much_and_with_names_of_megabytes_are_refused_briefly(hostile, ros):
    hostile.allowed += [r"states are wanted", r"\d+ bytes"]
    long = "a" * 10_000_000
    step = ros.service("/ambf/env/World/Step", Step)
    begin = time.monotonic()
    answers = [
        step(n=1, wanted_states=["nothing"] * 60_000),
        step(n=1, rigid_body_names=[long], rigid_body_cmds=[RigidBodyCmd()]),
        step(n=1, wanted_states=[long]),
        ros.service("/ambf/env/World/Unload", Unload)(long),
        ros.service("/ambf/env/World/Remove", Remove)(long),
        ros.service("/ambf/env/World/Load", Load)(LoadRequest(path=long)),
        ros.service("/ambf/env/World/Restore", Restore)(long, ""),
        ros.service("/ambf/env/World/Snapshot", Snapshot)(long, ""),
        ros.service("/ambf/env/World/Snapshot", Snapshot)("here", "/tmp/" + long),
        ros.service("/ambf/env/World/Forget", Forget)(long),
    ]
    assert time.monotonic() - begin < 10.0 * SLOWNESS
    for answer in answers:
        assert not answer.success
        assert len(answer.message) < 500 and not answer.diagnostics
    assert "60000 states are wanted; expected at most 1024" in answers[0].message
    assert len(hostile.log()) < 10_000


def test_a_deeply_nested_call_of_its_node_does_not_end_it(hostile, ros, master):
    """4 MB of nested arrays overflowed the stack of roscpp's parser."""
    with xmlrpc.client.ServerProxy(master.uri) as proxy:
        node = next(iter(master.state()[0]["/ambf/env/Box/State"]))
        uri = proxy.lookupNode("/test", node)[2]
    value = b"<value><array><data>" * 100_000 + b"</data></array></value>" * 100_000
    call = b"<methodCall><methodName>getPid</methodName><params><param>" + value + b"</param></params></methodCall>"
    with urllib.request.urlopen(urllib.request.Request(uri, call, {"Content-Type": "text/xml"}), timeout=20) as answer:
        assert b"methodResponse" in answer.read()
    assert ros.service("/ambf/env/World/Step", Step)(n=1).success
