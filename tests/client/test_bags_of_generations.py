"""Programs of AMBF 2.0 and 3.0 move one simulator at once; a bag of either moves the other's scene alike."""

import subprocess
import time

import numpy as np
import pytest
import scenes
from ambf_tools import read_bag
from ambf_tools.record import Recorder
from harness import SLOWNESS, Simulator
from user_script import Script

SECONDS = 3.0
PATH = f"""
import math, time
def way():  # slow, so that a controller's lag does not depend on a machine's load
    begin = time.time()
    while time.time() - begin < {SECONDS}:
        t = 2.0 * math.pi * (time.time() - begin) / {SECONDS}
        yield 0.4 * math.sin(t), 0.05 * math.sin(2.0 * t)
"""
SECOND = (
    PATH
    + """
import rospy
from ambf_client import Client
client = Client()
client.connect()
base, table = client.get_obj_handle("/ambf/env/Base"), client.get_obj_handle("/ambf/env/Table")
print("ready", flush=True)
input()
for turn, lift in way():
    base.set_joint_pos(0, turn)
    base.set_joint_pos(1, lift)
    time.sleep(0.01)
print("saw", abs(table.get_pos().y + 1.0) < 0.1, table.get_sim_step() > 0, flush=True)
rospy.spin()
"""
)
THIRD = (
    PATH
    + """
from ambf_client import Client
client = Client("third", 5)
client.connect(120)
base, table = client.get_obj_handle("Base"), client.get_obj_handle("Table")
rate = client.create_rate(100)
print("ready", flush=True)
input()
for turn, lift in way():
    table.set_pos(turn, -1.0, lift)
    rate.sleep()
print("saw", len(base.get_all_joint_pos()), base._state.sim_step > 0, flush=True)
while not client.is_shutdown():
    rate.sleep()
"""
)
# What watches a played bag: a program of the other generation, which commands nothing.
SEEN_BY_THIRD = """
from ambf_client import Client
client = Client("watcher", 5)
client.connect()
body = client.get_obj_handle("Base")
rate = client.create_rate(100)
print("ready", flush=True)
while not client.is_shutdown():
    joints = body._state.joint_positions
    if len(joints) == 2:
        print("at", *joints, flush=True)
    rate.sleep()
"""
SEEN_BY_SECOND = """
import rospy
from ambf_client import Client
client = Client()
client.connect()
body = client.get_obj_handle("/ambf/env/Table")
print("ready", flush=True)
while not rospy.is_shutdown():
    place = body.get_pos()
    print("at", place.x, place.z, flush=True)
    rospy.sleep(0.01)
"""


def farthest(points, way):
    """The greatest distance of a point from the nearest of a way."""
    return max(np.linalg.norm(way - point, axis=1).min() for point in points)


@pytest.fixture(scope="module")
def launch(tmp_path_factory):
    return scenes.write(tmp_path_factory.mktemp("scene"))


def simulator(launch, master, *flags):
    master.forget_dead()
    allowed = [r"md5sum"] if flags else []
    running = Simulator(
        launch.parent, "--launch_file", launch, "-l", "0", *flags, master_uri=master.uri, allowed=allowed
    )
    running.wait_loaded()
    return running


@pytest.fixture(scope="module")
def recorded(launch, master, tmp_path_factory):
    """The bag of both programs' commands, and of the states that they caused."""
    folder = tmp_path_factory.mktemp("bag")
    running = simulator(launch, master)
    programs = [Script(folder, text, master.uri) for text in (SECOND, THIRD)]
    for each in programs:
        each.wait_line("ready")
    names = [f"/ambf/env/{body}/{kind}" for body in ("Base", "Table") for kind in ("Command", "State")]
    try:
        with Recorder(folder / "both.bag", names, strict=True) as recorder:
            assert recorder.ready(4)
            for each in programs:
                each.type("go")
            assert programs[0].wait_line("saw", 30.0) == "saw True True"
            assert programs[1].wait_line("saw", 30.0) == "saw 2 True"
    finally:
        for each in programs:
            each.end()
        running.stop()
    running.close()
    return recorder.path


@pytest.mark.parametrize(
    "topic, columns, watcher, flags",
    [
        ("/ambf/env/Base", ["joint_positions"], SEEN_BY_THIRD, ("--legacy-states", "g4")),
        ("/ambf/env/Table", ["pose.position.x", "pose.position.z"], SEEN_BY_SECOND, ()),
    ],
    ids=["of 2.0 to 3.0", "of 3.0 to 2.0"],
)
def test_a_bag_of_either_moves_the_other_s_scene(launch, master, script, recorded, topic, columns, watcher, flags):
    with read_bag.open(recorded) as bag:
        assert bag.topics[f"{topic}/Command"].type == "ambf_msgs/RigidBodyCmd"
        moved = bag.array(f"{topic}/State", columns)
    assert np.ptp(moved, axis=0) == pytest.approx((0.8, 0.1), rel=0.3)

    running = simulator(launch, master, *flags)
    program = script(watcher, master.uri)
    program.wait_line("ready")
    time.sleep(0.5)
    subprocess.run(
        ["rosbag", "play", "--quiet", "--delay", "1", "--topics", f"{topic}/Command", "--bags", str(recorded)],
        check=True,
        stdin=subprocess.DEVNULL,
        timeout=60.0 * SLOWNESS,
    )
    seen = np.array([line.split()[1:] for line in program.lines if line.startswith("at ")], dtype=float)
    program.interrupt()
    running.stop()
    running.close()
    assert np.ptp(seen, axis=0) == pytest.approx(np.ptp(moved, axis=0), rel=0.3)
    assert farthest(seen, moved) < 0.05, "where it was is where it had been"
