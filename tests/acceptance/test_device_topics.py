"""Input devices through the public face: their topics, services, rates and `ambf-cli devices`."""

import json
import math
import os
import subprocess
import sys

import pytest
import scenes
from geometry_msgs.msg import Vector3, Wrench
from harness import ROOT, eventually

from ambf_msgs.msg import (
    DeviceMapping,
    ObjectCmd,
    ObjectState,
    RigidBodyState,
    WorldCmd,
    WorldDeviceRates,
    WorldRates,
    WorldState,
)
from ambf_msgs.srv import Devices, SetDevice

pytestmark = pytest.mark.alone

LEFT, RIGHT = "/ambf/env/physical_device_0/left", "/ambf/env/physical_device_1/right_hand"
DEVICES = """\
input devices: [left, right hand]
left:
  hardware name: scripted
  driver: {type: scripted, motion: circle, size: 0.05, rate: 2.0, axis: x, hold: 0.1, force: 5.0}
  root link: Box
  ramp: 0.1
right hand:
  hardware name: scripted
  driver: {type: scripted, motion: none, hold: 0.1, force: 5.0}
  root link: Slide
"""


@pytest.fixture
def two_users(tmp_path, master, start, ros):
    """A simulator with two scripted devices, one of them in motion."""
    launch = scenes.write(tmp_path)
    (tmp_path / "devices.yaml").write_text(DEVICES)
    with launch.open("a") as file:
        file.write("input devices config: ./devices.yaml\n")
    simulator = start("--launch_file", launch, "-l", "0", "-n", "2", "-e", "true", master_uri=master.uri)
    eventually(lambda: {LEFT + "/State", RIGHT + "/Mapping"} <= set(master.published()), 20.0, "the devices' topics")
    yield simulator
    simulator.stop()
    eventually(lambda: not master.names(), 5.0, "no topics are left behind")


def test_two_users_are_seen_and_set(two_users, ros, master):
    two_users.allowed += [r"command to '/ambf/env/physical_device_0/left' refused"]
    hand = ros.listen(LEFT + "/State", ObjectState)
    mapping = ros.listen(LEFT + "/Mapping", DeviceMapping)
    box = ros.listen("/ambf/env/Box/State", RigidBodyState)
    assert ros.listen("/ambf/env/World/State", WorldState).last().n_devices == 2

    # The hand moves the tool: both go round.
    moving = mapping.next(lambda m: m.engaged, what="it is engaged")
    assert moving.effector == "/ambf/env/Box" and moving.camera == "/ambf/env/cameras/eye"
    far = box.next(lambda m: abs(m.pose.position.y - 1.0) > 0.02, what="the tool moves")
    assert hand.last().name.data == "left" and far.sim_step > 0

    # Its State is one of its Mapping's cycles, expressed in the world.
    stamp = mapping.last().header.stamp
    state = hand.next(lambda m: m.header.stamp > stamp)
    same = eventually(lambda: next((m for m in mapping.messages if m.header.stamp == state.header.stamp), None), 5.0)
    u, p = same.T_world_u.position, state.pose.position
    iid = same.T_u_iid.position
    from_view = math.dist((p.x, p.y, p.z), (u.x, u.y, u.z))
    assert from_view == pytest.approx(math.hypot(iid.x, iid.y, iid.z), abs=1e-9)

    # Also while the simulation waits, at a rate of its own.
    running = hand.rate()
    ros.talk("/ambf/env/World/Command", WorldCmd).publish(WorldCmd(True, False, 1))
    waiting = hand.rate()
    assert waiting > 0.5 * running
    ros.talk("/ambf/env/World/Command", WorldCmd).publish(WorldCmd(False, False, 1))

    # What can be changed is listed and changed from the next cycle on.
    listed = ros.service("/ambf/env/World/Devices", Devices)()
    assert [each.name for each in listed.devices] == ["left", "right hand"] and listed.forces
    assert listed.devices[1].topic == RIGHT
    change = ros.service("/ambf/env/World/SetDevice", SetDevice)
    assert change("left", "dominance", [0.8]).success
    mapping.next(lambda m: m.dominance == 0.8)
    for wrong in (
        ("left", "dominance", [2.0]),
        ("left", "charm", [1.0]),
        ("middle", "dominance", [0.5]),
        ("", "x", [1]),
    ):
        assert not change(*wrong).success
    assert change("", "forces", [0.0]).success
    mapping.next(lambda m: not m.forces_on)
    assert change("", "forces", [1.0]).success

    # An external wrench is felt, and ends by itself; nonsense is refused and counted.
    right = ros.listen(RIGHT + "/Mapping", DeviceMapping)
    right.next(lambda m: m.forces_on and m.started)
    push = ros.talk(RIGHT + "/Command", ObjectCmd)
    push.publish(ObjectCmd(wrench=Wrench(Vector3(0.0, 0.0, 2.0), Vector3())))
    right.next(lambda m: m.wrench_u_wanted.force.z > 1.5, what="the push")
    right.next(lambda m: m.wrench_u_wanted.force.z < 0.5, what="its end")
    ros.talk(LEFT + "/Command", ObjectCmd).publish(ObjectCmd(wrench=Wrench(Vector3(math.nan, 0.0, 0.0), Vector3())))
    rates = ros.listen("/ambf/env/World/Rates", WorldRates)
    counted = rates.next(lambda m: LEFT in m.refused_names, what="the refusal is counted")
    threads = {thread.name: thread for thread in counted.threads}
    assert threads["device 0 left"].frequency > 0.0 and "device 1 right hand" in threads

    # Over the whole run.
    times = ros.listen("/ambf/env/World/DeviceRates", WorldDeviceRates).next(
        lambda m: all(device.set_point_age.count > 0 for device in m.devices)
    )
    period = times.devices[0].period
    assert period.count > 100 and 0.0 < period.p50 <= period.p99 <= period.p999 <= period.max
    assert [device.fault for device in times.devices] == ["", ""]


@pytest.fixture
def run_python(master):
    """run_python(*arguments): what a Python program printed."""

    def run(*arguments):
        path = os.pathsep.join([str(ROOT / "ambf_client_py"), os.environ.get("PYTHONPATH", "")])
        environment = dict(os.environ, PYTHONPATH=path, ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
        command = [sys.executable, *map(str, arguments)]
        return subprocess.run(command, stdout=subprocess.PIPE, text=True, env=environment, check=True).stdout

    return run


def test_two_users_are_seen_and_set_by_programs(two_users, ros, run_python, tmp_path):
    def cli(*words):
        return json.loads(run_python("-m", "ambf_tools.cli", "devices", *words, "--json"))

    assert [each["name"] for each in cli()["devices"]] == ["left", "right hand"]
    cli("set", "right", "linear-stiffness", "100", "200", "0")
    right = ros.listen(RIGHT + "/Mapping", DeviceMapping)
    right.next(lambda m: (m.linear_stiffness.x, m.linear_stiffness.y, m.linear_stiffness.z) == (100.0, 200.0, 0.0))

    example = ROOT / "ambf_client_py/examples/record_two_users.py"
    report = run_python(example, "--seconds", 1, "--folder", tmp_path).splitlines()
    assert report[0] == "left: 0.8, right hand: 0.2"
    assert report[2].endswith(" 0 lost")
    assert [line.split(":")[0] for line in report[3:]] == ["left", "right hand"]
