"""From the start of the process to the first state of the last body, the end after SIGINT, memory and threads.

A rospy subscriber waits already, the master is warm, as when the original was measured. Targets: not slower than it;
puzzle1 below 100 MB, 300 cubes with fewer than 20 threads and ended in 1 s, PSM in 0.3 s.
"""

import argparse
import math
import os
import statistics
import threading
import time
from pathlib import Path

import support
import yaml
from harness import Simulator

# s to the state, s to the end, MB, threads
ORIGINAL = {
    "1 box": (0.38, 0.31, 104, 11),
    "PSM": (0.35, 0.41, 127, 19),
    "PSM+ECM+MTM": (0.55, 0.47, 160, 29),
    "our PSM+ECM+MTM": (0.55, 0.47, 160, 29),  # as theirs
    "puzzle1": (0.47, 0.36, 120, 20),
    "300 cubes": (1.31, 0.62, 135, 310),
}
BOX = """\
namespace: /ambf/env/
bodies: [BODY Box]
joints: []
BODY Box:
  name: Box
  mass: 1.0
  shape: BOX
  geometry: {x: 0.1, y: 0.1, z: 0.1}
  collision shape: BOX
  collision geometry: {x: 0.1, y: 0.1, z: 0.1}
  location: {position: {x: 0, y: 0, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}
"""


def last_body(arguments):
    """The State topic of the last body of the last model; passive ones have none."""
    if "-a" in arguments:
        file = Path(arguments[arguments.index("-a") + 1])
    else:
        launch = Path(arguments[1])
        models = yaml.safe_load(launch.read_text())["multibody configs"]
        file = launch.parent / models[int(str(arguments[3]).split(",")[-1])]
    model = yaml.safe_load(file.read_text())
    body = [model[block] for block in model["bodies"] if not model[block].get("passive")][-1]
    return f"{model.get('namespace', '/ambf/env/').rstrip('/')}/{body.get('namespace', '')}{body['name']}/State"


def measure(folder, master, arguments):
    """(s to the first valid state, s to the end, memory in MB, threads) of one run."""
    import rospy

    from ambf_msgs.msg import RigidBodyState

    came, times = threading.Event(), []

    def on_state(message):
        q = message.pose.orientation
        if not came.is_set() and abs(math.hypot(q.x, q.y, q.z, q.w) - 1.0) < 1e-3 and math.isfinite(message.wall_time):
            times.append(time.monotonic())
            came.set()

    topic = last_body(arguments)
    subscriber = rospy.Subscriber(topic, RigidBodyState, on_state, tcp_nodelay=True)
    time.sleep(0.3)
    simulator = Simulator(folder, *arguments, master_uri=master.uri)
    try:
        if not came.wait(30.0):
            raise SystemExit(f"no state on {topic} within 30 s:\n{simulator.log()}")
        time.sleep(1.5)
        numbers = support.process_numbers(simulator.pid)
    finally:
        _, end = simulator.stop()
        subscriber.unregister()
    return times[0] - simulator.started, end, numbers["memory"], numbers["threads"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=3, help="medians are shown")
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    import rospy

    rospy.init_node("bench_start", anonymous=True, disable_signals=True, disable_rosout=True)
    rows, figures = [], {}
    try:
        with support.scratch() as folder:
            box = Path(folder) / "box.yaml"
            box.write_text(BOX)
            scenes = {"1 box": ("--launch_file", support.OWN_LAUNCH, "-a", box)}
            scenes |= {name: support.SCENES[name] for name in support.available(list(ORIGINAL)[1:])}
            for scene, arguments in scenes.items():
                runs = [measure(folder, master, arguments) for _ in range(options.runs)]
                start, end, memory, threads = (statistics.median(column) for column in zip(*runs, strict=True))
                was = ORIGINAL[scene]
                figures |= {f"{scene}, first state": (start, "time"), f"{scene}, memory": (memory, "size")}
                rows.append(
                    [
                        scene,
                        f"{start:.2f} ({was[0]})",
                        f"{end:.2f} ({was[1]})",
                        f"{memory:.0f} ({was[2]})",
                        f"{threads:.0f} ({was[3]})",
                    ]
                )
    finally:
        master.kill()
    print("in brackets: the original")
    support.record("start", rows, ["scene", "first state s", "end s", "memory MB", "threads"], figures)


if __name__ == "__main__":
    main()
