"""What ROS communication achieves, one "name: value" a line. Compare with docs/benchmarks.md; a busy machine does less.

Start it with ./dev bench ros
"""

import contextlib
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "acceptance"))
import scenes  # noqa: E402
from harness import COMPAT, ROOT, Master, Simulator, eventually  # noqa: E402

# Counts messages and distinct sim_steps of one topic; reads sim_step from the bytes (behind a header without frame_id).
PROBE = """
import struct, sys, time, rospy
rospy.init_node("probe", anonymous=True, disable_signals=True, disable_rosout=True)
steps = []
rospy.Subscriber(sys.argv[1], rospy.AnyMsg, lambda m: steps.append(m._buff[16:20]), tcp_nodelay=True)
while not steps: time.sleep(0.01)
time.sleep(3.0)
begin, first = time.monotonic(), len(steps)
time.sleep(5.0)
seen = steps[first:]
seconds = time.monotonic() - begin
print(len(seen) / seconds, len(set(seen)) / seconds)
"""


def steal():
    with open("/proc/stat") as stat:
        numbers = [int(n) for n in stat.readline().split()[1:]]
    return numbers[7], sum(numbers[:8])


@contextlib.contextmanager
def simulator(*arguments, master):
    with tempfile.TemporaryDirectory() as folder:
        process = Simulator(folder, *arguments, master_uri=master.uri)
        try:
            yield process
        finally:
            process.stop()


def report(name, value, unit=""):
    print(f"{name}: {value:.4g}{' ' if unit else ''}{unit}", flush=True)


def publishing(master, folder):
    """300 cubes, every object at 2000 Hz, three of them listened to."""
    launch = scenes.write(folder, scenes.cubes(300))
    rates = ("--override_min_comm_freq", "2000", "--override_max_comm_freq", "2000")
    with simulator("--launch_file", launch, "-l", "0", "-p", "2000", *rates, master=master) as running:
        eventually(lambda: len(master.names()) >= 2 * 302 + 13, 60.0)
        env = dict(os.environ, ROS_MASTER_URI=master.uri)
        probes = [
            subprocess.Popen(
                [sys.executable, "-c", PROBE, f"/ambf/env/Cube{n}/State"], stdout=subprocess.PIPE, text=True, env=env
            )
            for n in ("000", "150", "299")
        ]
        for number, probe in zip(("000", "150", "299"), probes, strict=True):
            rate, distinct = map(float, probe.communicate(timeout=120)[0].split())
            report(f"300 cubes at 2000 Hz, Cube{number} received", rate, "Hz")
            report(f"300 cubes at 2000 Hz, Cube{number} distinct steps", distinct, "1/s")
        report("300 cubes at 2000 Hz, threads", len(os.listdir(f"/proc/{running.pid}/task")))


def round_trip(ros, master, folder):
    """Pose command by plain rospy until a State shows it."""
    from ambf_msgs.msg import RigidBodyCmd, RigidBodyState

    with simulator("--launch_file", scenes.write(folder), "-l", "0", master=master):
        state = ros.listen("/ambf/env/Table/State", RigidBodyState)
        talk = ros.talk("/ambf/env/Table/Command", RigidBodyCmd)
        message = RigidBodyCmd(cartesian_cmd_type=RigidBodyCmd.TYPE_POSITION)
        message.pose.orientation.w = 1.0

        def once(x):
            message.pose.position.x = x
            begin = time.perf_counter()
            talk.publish(message)
            while state.messages[-1].pose.position.x != x:
                time.sleep(0.00005)
                if time.perf_counter() - begin > 2.0:
                    return 2.0
            return time.perf_counter() - begin

        state.last()
        for i in range(200):
            once(1.0 + i)
        trips = sorted(once(i + 0.5) * 1e3 for i in range(1000))
        for name, share in (("p50", 0.5), ("p95", 0.95), ("p99", 0.99)):
            report(f"command to state, {name}", trips[int(share * len(trips))], "ms")
        silent = []
        for i in range(10):
            time.sleep(0.7)
            silent.append(once(5000.0 + i) * 1e3)
        report("first command after silence, median", statistics.median(silent), "ms")
        ros.close()


def stepping(ros, master, folder):
    from ambf_msgs.msg import WorldCmd, WorldState
    from ambf_msgs.srv import Step

    with simulator("--launch_file", scenes.write(folder), "-l", "0", master=master):
        state = ros.listen("/ambf/env/World/State", WorldState)
        talk = ros.talk("/ambf/env/World/Command", WorldCmd)
        for steps in (1, 10, 50):
            clock = steps == 10
            talk.publish(WorldCmd(True, clock, steps))
            time.sleep(0.2)
            count, begin = 0, time.perf_counter()
            while time.perf_counter() - begin < 3.0:
                at = state.messages[-1].sim_step
                clock = not clock
                talk.publish(WorldCmd(True, clock, steps))
                while state.messages[-1].sim_step < at + steps and time.perf_counter() - begin < 4.0:
                    time.sleep(0.00002)
                count += 1
            report(f"toggles a second, {steps} steps each", count / (time.perf_counter() - begin))
        step = ros.service("/ambf/env/World/Step", Step)
        count, begin = 0, time.perf_counter()
        while time.perf_counter() - begin < 3.0:
            step(n=1)
            count += 1
        report("Step calls a second", count / (time.perf_counter() - begin))
        ros.close()


def start_and_exit(ros, master, folder):
    """Process start to the first State of the last body, with a listener waiting; signal to exit."""
    from ambf_msgs.msg import RigidBodyState

    robots = COMPAT / "ambf_models/descriptions/multi-bodies/robots"
    cases = []
    if robots.is_dir():
        cases.append(("PSM", ("-a", robots / "blender-psm.yaml"), "/ambf/env/psm/toolgripper2link"))
    launch = scenes.write(folder, scenes.cubes(300))
    cases.append(("300 cubes", ("--launch_file", launch, "-l", "0"), "/ambf/env/Cube299"))
    cases.append(("peg transfer", (), "/ambf/env/right_jaw_b"))
    for name, arguments, body in cases:
        first, ended = [], []
        for _ in range(3):
            state = ros.listen(f"{body}/State", RigidBodyState)
            with simulator(*arguments, master=master) as running:
                eventually(lambda state=state: state.messages, 30.0, interval=0.001)
                first.append(state.times[0] - running.started)
                eventually(lambda: master.names(), 30.0)
                time.sleep(1.0)
                ended.append(running.stop(signal.SIGINT)[1])
            ros.close()
        report(f"{name}: start to first state", statistics.median(first), "s")
        report(f"{name}: signal to exit", statistics.median(ended), "s")


def main():
    from harness import Ros

    master = Master()
    os.environ["ROS_MASTER_URI"] = master.uri
    os.environ["ROS_IP"] = "127.0.0.1"
    os.environ.setdefault("AMBF_SIMULATOR", str(ROOT / "build/bin/ambf_simulator"))
    before = steal()
    try:
        with tempfile.TemporaryDirectory() as folder:
            ros = Ros()
            publishing(master, Path(folder))
            round_trip(ros, master, Path(folder))
            stepping(ros, master, Path(folder))
            start_and_exit(ros, master, Path(folder))
    finally:
        master.kill()
    after = steal()
    report("stolen by other machines", 100.0 * (after[0] - before[0]) / max(after[1] - before[1], 1), "% of all time")


if __name__ == "__main__":
    main()
