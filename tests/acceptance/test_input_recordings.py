"""Recordings of inputs: live sessions repeat to the bit, after kill -9, too; what cannot be replayed says why."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
import scenes
from ambf_tools import read_input
from geometry_msgs.msg import Point, Pose, Quaternion
from harness import ROOT

from ambf_msgs.msg import CameraCmd, CameraState, RigidBodyCmd, RigidBodyState, WorldCmd
from ambf_msgs.srv import Load, Step, Unload

pytestmark = pytest.mark.alone

DESCRIPTIONS = ROOT / "ambf_models/descriptions"
CAMERA = "/ambf/env/cameras/operator_camera"
# Both fall silent now and then, each at its own times.
DEVICES = """\
input devices: [Left, Right]
Left:
  hardware name: Scripted
  driver: {{type: scripted, motion: circle, axis: x, size: 0.02, rate: 1.5, hold: 0.5, force: 5.0, noise: 0.0002,
    dropout every: {left}, dropout: 0.3}}
  haptic gain: {{linear: 100.0, angular: 0.0}}
  workspace scaling: 1.0
  root link: left_gripper
  pair cameras: [operator_camera]
Right:
  hardware name: Scripted
  driver: {{type: scripted, motion: line, axis: y, size: 0.02, rate: 2.0, jaw: 0.5, jaw swing: 0.4, hold: 0.5,
    force: 5.0, hertz: 300, delay: 0.005, dropout every: {right}, dropout: 0.5}}
  haptic gain: {{linear: 100.0, angular: 0.0}}
  workspace scaling: 1.0
  root link: right_gripper
  pair cameras: [assistant_camera]
"""


def two_users(folder, left=2.5, right=3.1):
    """A launch file of the demonstration's scene with devices that get lost."""
    (folder / "devices.yaml").write_text(DEVICES.format(left=left, right=right))
    launch = folder / "launch.yaml"
    launch.write_text(
        f"world config: {DESCRIPTIONS}/world/two_views_world.yaml\ncolor config: {DESCRIPTIONS}/color/colors.yaml\n"
        "input devices config: devices.yaml\n"
        f"multibody configs: [{DESCRIPTIONS}/multi-bodies/puzzles/peg_transfer.yaml]\n"
    )
    return launch


LOST = [r"device '(Left|Right)': no sample arrives"]


def replay(start, file, **options):
    """The exit code and the log of a replay."""
    simulator = start("--replay-input", file, **options)
    return simulator.process.wait(60.0), simulator.log()


def test_a_live_session_of_two_users_repeats_to_the_bit(tmp_path, master, start, ros):
    file = tmp_path / "session.ambfin"
    launch = two_users(tmp_path)
    simulator = start(
        "--launch_file", launch, "-l", "0", "-n", "2", "-e", "true", "--record-input", file,
        master_uri=master.uri, allowed=LOST,
    )  # fmt: skip
    simulator.wait_log("device 'Right' moves")
    began = time.monotonic()
    camera = ros.talk(CAMERA + "/Command", CameraCmd)
    seen = ros.listen(CAMERA + "/State", CameraState)
    ring = ros.talk("/ambf/env/ring2/Command", RigidBodyCmd)
    ring_state = ros.listen("/ambf/env/ring2/State", RigidBodyState)
    world = ros.talk("/ambf/env/World/Command", WorldCmd)
    start_pose = seen.next().pose
    for i in range(30):  # the first user's view moves while hands do
        at = start_pose.position
        pose = Pose(
            Point(at.x, at.y + 0.01 * i, at.z), Quaternion(*(getattr(start_pose.orientation, a) for a in "xyzw"))
        )
        camera.publish(CameraCmd(enable_position_controller=True, pose=pose))
        time.sleep(0.02)
    push = RigidBodyCmd()
    push.cartesian_cmd_type = RigidBodyCmd.TYPE_FORCE
    push.wrench.force.z = 0.03
    ring.publish(push)
    ring_state.next(lambda m: m.pose.position.z > 0.0, what="the ring moves")
    world.publish(WorldCmd(True, False, 1))  # a pause: the world waits for a clock that does not tick
    time.sleep(0.4)
    step = ros.service("/ambf/env/World/Step", Step)
    assert step(n=25).success
    world.publish(WorldCmd(False, False, 1))
    load, unload = ros.service("/ambf/env/World/Load", Load), ros.service("/ambf/env/World/Unload", Unload)
    gripper = DESCRIPTIONS / "multi-bodies/grippers/two_finger.yaml"
    loaded = load(path=str(gripper), pose=Pose(Point(-0.11, 0, -0.15), Quaternion(0, 0, 0, 1)))
    assert loaded.success
    time.sleep(0.5)
    assert unload(model=loaded.model).success
    time.sleep(max(0.0, 8.0 - (time.monotonic() - began)))
    assert simulator.stop()[0] == 0

    for _ in range(3):
        code, log = replay(start, file, allowed=[])
        assert code == 0 and "all of it was equal to the recording" in log, log

    # The same in numpy.
    trial = read_input.read(file)
    assert trial.problem == ""
    assert trial.requests["command"] > 20  # of 31: the newest counts where two come between two steps
    assert [what for what, _ in trial.changes] == ["world", "load", "start", "load", "unload"]
    left, right = trial.device("Left"), trial.device("Right")
    assert len(left.cycles["time"]) > 1000 and len(right.samples["time"]) < 0.5 * len(left.samples["time"])
    obeyed = left.set_points["step"][left.set_points["step"] > 0]
    assert len(obeyed) > 500 and (obeyed[1:] >= obeyed[:-1]).all()
    assert trial.frames["sim_step"][-1] >= obeyed[-1]
    gaps = left.samples["time"][1:] - left.samples["time"][:-1]
    assert gaps.max() > 0.25, "a loss is in it"
    held = left.set_points["position"][left.set_points["engaged"]]
    assert 0.03 < held[:, 2].max() - held[:, 2].min() < 0.2, "the hand's circle of 2 cm"

    cli = [sys.executable, "-m", "ambf_tools.cli", "--json", "inputs", str(file)]
    shown = json.loads(subprocess.run(cli, capture_output=True, check=True, timeout=60).stdout)
    assert shown["devices"][0]["cycles"] == len(left.cycles["time"]) and shown["frames"] == len(trial.frames["time"])


def test_after_kill_9_all_but_the_last_half_second_is_there(tmp_path, start):
    file = tmp_path / "killed.ambfin"
    simulator = start(
        "--launch_file", two_users(tmp_path, 50, 50), "-l", "0", "-n", "2", "--no-ros", "--record-input", file
    )
    simulator.wait_log("device 'Right' moves")
    time.sleep(2.0)
    os.kill(simulator.pid, signal.SIGKILL)
    killed = time.time()
    simulator.process.wait(10.0)
    trial = read_input.read(file)
    assert trial.start + trial.seconds > killed - 0.5
    assert "cut off" in trial.problem
    code, log = replay(start, file, allowed=["no whole record"])
    assert code == 0 and "all of it was equal" in log, log


def test_what_cannot_be_replayed_says_why(tmp_path, start):
    launch = scenes.write(tmp_path)
    file = tmp_path / "short.ambfin"
    simulator = start("--launch_file", launch, "-l", "0", "--no-ros", "--record-input", file, "--run-for", "0.5")
    assert simulator.process.wait(30.0) == 0
    whole = file.read_bytes()

    def refused(text, *, code=2, arguments=()):
        simulator = start("--replay-input", file, *arguments, allowed=[".*"])
        assert simulator.process.wait(30.0) == code
        lines = [line for line in simulator.log().splitlines() if text in line]
        assert len(lines) == 1, simulator.log()

    assert replay(start, file)[0] == 0
    refused("--load_multibodies has no meaning beside it", arguments=("-l", "1"))
    file.write_bytes(whole[:8] + b"\x07" + whole[9:])
    refused("a recording of version 7; this simulator reads version 4")
    file.write_bytes(b"bodies: []\n")
    refused("this is no recording of inputs")
    file.write_bytes(whole)
    model = tmp_path / "model.yaml"
    model.write_text(scenes.BENCH.replace("y: 1.0", "y: 1.01"))
    refused("the scene is another one than that of the recording")
    model.unlink()
    refused("what is loaded differs from the recording")
    launch.unlink()
    refused("nothing is replayed: ")
