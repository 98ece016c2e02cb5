"""Recordings of inputs: does a live session of two users repeat to the bit, and what does recording it cost?

Scripted devices that fall silent now and then move both grippers of the demonstration for two users, while a client
moves a camera, pushes a ring, pauses the world and loads and unloads a gripper. The target: every replay has the
recorded state_hash in every frame.
"""

import argparse
import os
import re
import signal
import subprocess

import support

DESCRIPTIONS = support.ROOT / "ambf_models/descriptions"
DEVICES = """\
input devices: [Left, Right]
Left:
  hardware name: Scripted
  driver: {type: scripted, motion: circle, axis: x, size: 0.02, rate: 1.5, hold: 1.0, force: 5.0, noise: 0.0002,
    dropout every: 11, dropout: 0.4}
  haptic gain: {linear: 100.0, angular: 0.0}
  root link: left_gripper
  pair cameras: [operator_camera]
Right:
  hardware name: Scripted
  driver: {type: scripted, motion: line, axis: y, size: 0.02, rate: 2.0, jaw swing: 0.4, hold: 1.0, force: 5.0,
    hertz: 300, delay: 0.005, dropout every: 17, dropout: 0.6}
  haptic gain: {linear: 100.0, angular: 0.0}
  root link: right_gripper
  pair cameras: [assistant_camera]
"""


def write_launch(folder):
    (folder / "devices.yaml").write_text(DEVICES)
    launch = folder / "launch.yaml"
    launch.write_text(
        f"world config: {DESCRIPTIONS}/world/two_views_world.yaml\ncolor config: {DESCRIPTIONS}/color/colors.yaml\n"
        "input devices config: devices.yaml\n"
        f"multibody configs: [{DESCRIPTIONS}/multi-bodies/puzzles/peg_transfer.yaml]\n"
    )
    return launch


class User:
    """What a person and a script do to the running simulation."""

    def __init__(self):
        import rospy
        from geometry_msgs.msg import Point, Pose, Quaternion

        from ambf_msgs.msg import CameraCmd, CameraState, RigidBodyCmd, WorldCmd
        from ambf_msgs.srv import Load, Unload

        self.Pose, self.Point, self.Quaternion, self.CameraCmd = Pose, Point, Quaternion, CameraCmd
        self.WorldCmd = WorldCmd
        name = "/ambf/env/cameras/operator_camera"
        self.camera = rospy.Publisher(name + "/Command", CameraCmd, queue_size=10)
        self.ring = rospy.Publisher("/ambf/env/ring2/Command", RigidBodyCmd, queue_size=10)
        self.world = rospy.Publisher("/ambf/env/World/Command", WorldCmd, queue_size=10)
        self.pose = rospy.wait_for_message(name + "/State", CameraState, 30.0).pose
        rospy.wait_for_service("/ambf/env/World/Load", 30.0)
        self.load = rospy.ServiceProxy("/ambf/env/World/Load", Load)
        self.unload = rospy.ServiceProxy("/ambf/env/World/Unload", Unload)
        self.push = RigidBodyCmd(cartesian_cmd_type=RigidBodyCmd.TYPE_FORCE)
        self.push.wrench.force.z = 0.03

    def look_around(self):
        turn, at = self.pose.orientation, self.pose.position
        for i in range(50):
            pose = self.Pose(self.Point(at.x, at.y + 0.004 * i, at.z), self.Quaternion(turn.x, turn.y, turn.z, turn.w))
            self.camera.publish(self.CameraCmd(enable_position_controller=True, pose=pose))
            support.time.sleep(0.02)

    def pause(self):
        self.world.publish(self.WorldCmd(True, False, 1))
        support.time.sleep(1.0)
        self.world.publish(self.WorldCmd(False, False, 1))

    def load_a_gripper(self):
        path = DESCRIPTIONS / "multi-bodies/grippers/two_finger.yaml"
        loaded = self.load(path=str(path), pose=self.Pose(self.Point(-0.11, 0, -0.15), self.Quaternion(0, 0, 0, 1)))
        support.time.sleep(1.0)
        self.unload(model=loaded.model)


def run(launch, arguments, seconds, user_acts):
    """The summary that the simulator prints at its end."""
    command = [support.SIMULATOR, "-g", "false", "--launch_file", launch, "-l", "0", "-n", "2", "-e", "true"]
    command += ["--run_for", seconds, *arguments]
    simulator = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        end = support.time.monotonic() + seconds - 3.0
        user = User() if user_acts else None
        while user is not None and support.time.monotonic() < end:
            user.ring.publish(user.push)
            user.look_around()
            user.pause()
            user.load_a_gripper()
        return simulator.communicate(timeout=seconds + 60.0)[0]
    finally:
        if simulator.poll() is None:
            simulator.send_signal(signal.SIGKILL)


def figure(summary, name):
    return float(re.search(rf"{name}: ([\d.e+-]+)", summary).group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--replays", type=int, default=3)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ["ROS_MASTER_URI"] = master.uri
    import rospy

    rospy.init_node("bench_replay", anonymous=True, disable_signals=True)
    equal = 0
    try:
        with support.scratch() as folder:
            launch, file = write_launch(support.Path(folder)), support.Path(folder) / "session.ambfin"
            plain = run(launch, [], 10.0, False)
            recorded = run(launch, ["--record_input", support.Path(folder) / "cost.ambfin"], 10.0, False)
            session = run(launch, ["--record_input", file], options.seconds, True)
            names = ("real-time factor", "physics thread CPU", "phase publish", "lateness p99.9")
            rows = [
                [what, *(f"{figure(summary, name):.4g}" for name in names)]
                for what, summary in (("without", plain), ("recorded", recorded), ("the session, recorded", session))
            ]
            support.table(
                rows, ["", "real-time factor", "physics, % of a core", "publishing, us a step", "p99.9 late, us"]
            )
            print(f"{file.stat().st_size / options.seconds / 1e3:.0f} kB a second")
            for _ in range(options.replays):
                done = subprocess.run(
                    [support.SIMULATOR, "--replay_input", file], capture_output=True, text=True, timeout=600
                )
                print("\n".join(done.stderr.strip().splitlines()[-2:]))
                equal += done.returncode == 0
    finally:
        master.kill()
    print(f"{equal} of {options.replays} replays were equal")
    raise SystemExit(equal != options.replays)


if __name__ == "__main__":
    main()
