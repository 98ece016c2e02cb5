"""This tree beside another one, built in its own folder: is anything slower? Both are measured in turns, in one run.

Start it with ./dev shell -- python tests/benchmarks/compare_trees.py --before FOLDER. Each tree is measured with its
own program, client and messages. Prints medians and the median ratio of the pairs; above 1 this tree is better. Ends
with 1 when a ratio lies below --limit.
"""

import argparse
import json
import os
import signal
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ROS_MODULES = "build/ros/lib/python3/dist-packages"
SCENES = ("PSM", "PSM+ECM+MTM", "puzzle1", "300 cubes")
FREE = ("-t", "1", "-p", "1000000", "-s", "1000", "--sleeping", "0")


def free_steps(scene):
    import support

    return support.summary_of((*support.SCENES[scene], *FREE), 2.5)["steps per CPU second"]


def with_client(measure, *arguments):
    """What measure(client) returns of a simulator with a ROS master of its own."""
    import support
    from harness import Simulator

    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    try:
        from ambf_client import Client

        with support.scratch() as folder:
            simulator = Simulator(folder, *arguments, master_uri=master.uri)
            try:
                with Client() as client:
                    return measure(client)
            finally:
                simulator.stop()
    finally:
        master.kill()


def round_trips():
    """Commands by topic until a state shows them, a second."""
    import scenes
    import support

    def measure(client):
        table = client.wait_for("Table")
        times = []
        for i in range(500):
            begin = time.perf_counter()
            table.set_pos(1.0 + 0.01 * i, 0.0, 0.0)
            while table.get_pos().x != 1.0 + 0.01 * i:
                if not table.wait_for_next_state(5.0):
                    raise SystemExit("no state for 5 s")
            times.append(time.perf_counter() - begin)
        return 1.0 / statistics.median(times[100:])

    with support.scratch() as folder:
        return with_client(measure, "--launch_file", scenes.write(Path(folder)), "-l", "0")


def calls_of_50_steps():
    """Steps a second, 50 a call."""
    import support

    def measure(client):
        arm = client.wait_for("psm/baselink")
        arm.set_joint_pos([0.0, 0.0, 0.1, 0.0, 0.0, 0.0])
        client.world.step(1000)
        begin = time.perf_counter()
        for _ in range(200):
            client.world.step(50)
        return 10_000 / (time.perf_counter() - begin)

    return with_client(measure, *FREE, *support.SCENES["PSM"])


def states_at_2_khz():
    """States of one of 300 cubes that arrive a second; each is published 2000 times a second."""
    import support

    def measure(client):
        import rospy

        count = 0

        def arrived(_):
            nonlocal count
            count += 1

        rospy.Subscriber("/ambf/env/cubes/cube_150/State", rospy.AnyMsg, arrived, tcp_nodelay=True)
        time.sleep(3.0)
        first, begin = count, time.monotonic()
        time.sleep(4.0)
        return (count - first) / (time.monotonic() - begin)

    rates = ("--override_min_comm_freq", "2000", "--override_max_comm_freq", "2000", "-p", "2000")
    return with_client(measure, *support.SCENES["300 cubes"], *rates)


def pictures(scene):
    """Pictures a second of a window drawn by the processor."""
    import support
    from bench_windows import measure

    master = support.Master()
    display = f":{200 + os.getpid() % 1000}"
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1", DISPLAY=display)
    server = subprocess.Popen(["Xvfb", display, "-screen", "0", "1280x1100x24"], stderr=subprocess.DEVNULL)
    try:
        time.sleep(1.0)
        import rospy

        rospy.init_node("compare", anonymous=True, disable_signals=True)
        return measure(rospy, support.SCENES[scene], 4.0)[0]
    finally:
        server.send_signal(signal.SIGTERM)
        master.kill()


MEASURES = {
    **{f"free steps a CPU second, {scene}": (free_steps, scene) for scene in SCENES},
    "round trips a second": (round_trips,),
    "steps a second, 50 a call": (calls_of_50_steps,),
    "states a second of 300 cubes at 2 kHz": (states_at_2_khz,),
    "pictures a second, PSM+ECM+MTM": (pictures, "PSM+ECM+MTM"),
    "pictures a second, 300 cubes": (pictures, "300 cubes"),
}


def measured(tree, name):
    """One figure of a tree, measured by a process with that tree's program, client and messages."""
    build = tree / "build"
    environment = dict(
        os.environ,
        AMBF_SIMULATOR=str(build / "bin/ambf_simulator"),
        AMBF_BUILD_DIR=str(build),
        PYTHONPATH=os.pathsep.join(
            str(tree / part)
            for part in (
                "tests/benchmarks",
                "tests/acceptance",
                "ambf_client_py",
                "build/ros/lib/python3/dist-packages",
            )
        ),
        ROS_PACKAGE_PATH=f"{tree}:/usr/share",
    )
    command = [tree / ".venv/bin/python", __file__, "--measure", name]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)
    if done.returncode != 0:
        raise SystemExit(f"{name} of {tree}:\n{done.stdout}{done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", type=Path, help="the other tree: a checkout with its build/ and .venv/")
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--only", default="", help="figures whose name contains this")
    parser.add_argument("--limit", type=float, default=0.97)
    parser.add_argument("--measure", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.measure:
        measure, *arguments = MEASURES[options.measure]
        print(json.dumps(measure(*arguments)))
        return 0
    if options.before is None:
        parser.error("--before is needed: the other tree")
    sys.path.insert(0, str(ROOT / "tests/benchmarks"))
    import support

    print(support.machine(), "beside", options.before.name)
    rows, worse = [], False
    for name in (n for n in MEASURES if options.only in n):
        before, after, ratios = [], [], []
        for number in range(options.rounds):
            pair = {}
            # Who goes first changes, so that a machine that gets slower favours nobody.
            for tree in (ROOT, options.before)[:: 1 if number % 2 else -1]:
                pair[tree] = measured(tree, name)
            before.append(pair[options.before]), after.append(pair[ROOT])
            ratios.append(pair[ROOT] / pair[options.before])
        ratio = statistics.median(ratios)
        worse |= ratio < options.limit
        rows.append([name, f"{statistics.median(before):.4g}", f"{statistics.median(after):.4g}", f"{ratio:.3f}"])
        rows[-1].append(f"{min(ratios):.2f} to {max(ratios):.2f}")
        print(" ".join(rows[-1]), flush=True)
    support.table(rows, ["figure", "before", "now", "ratio", "of the pairs"])
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
