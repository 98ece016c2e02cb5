"""Two grippers of 2 x 50 resistive rays at work on the peg board, all topics up: steps a second, share of a core.

Both hands move all the time, beside and above the board's objects, so that all rays are cast in each step. The target:
1000 +-2 steps a second, less than 60 % of a core. What a ray costs by shape, and how much of a sensor's step is
casting: ambf_touch_benchmark.
"""

import argparse
import math
import os
import sys
import threading
from pathlib import Path

import support

sys.path.insert(0, str(support.ROOT / "ambf_models/scripts"))
import touch_parts as parts  # noqa: E402
from adf_writer import Model  # noqa: E402

MODELS = support.ROOT / "ambf_models"
# Of the palms, over the board's objects; rays reach from finger to finger.
PLACES = {"one": (-0.030, -0.060, 0.100), "two": (-0.030, 0.060, 0.100)}
OPENING, RANGE, SWAY = 0.022, 0.044, 0.003  # m


def scene(folder):
    """The board with two hands of 2 x 50 rays, and a launch file for it; rays reach what is between the fingers."""
    hands = Model("Two hands over the peg board.", namespace="/ambf/env/hands/", meshes=MODELS / "meshes/hand")
    for name, at in PLACES.items():
        parts.add_hand(hands, name, at, (0, 0, 0), OPENING, parts.OBJECT_GRASP, RANGE, (0.022, 10, 0.030, 5))
    text = hands.text().replace("../../two_finger", str(MODELS / "meshes/two_finger"))
    text = text.replace("../../hand/high_res/", "")
    file = Path(folder) / "hands.yaml"
    file.write_text(text)
    launch = Path(folder) / "launch.yaml"
    board = MODELS / "descriptions/multi-bodies/puzzles/peg_transfer.yaml"
    launch.write_text(
        f"world config: {MODELS / 'descriptions/world/peg_transfer_world.yaml'}\n"
        f"color config: {MODELS / 'descriptions/color/colors.yaml'}\n"
        f"multibody configs:\n  - {board}\n  - {file}\n"
    )
    return launch


class Operator:
    """Moves both hands to and fro at 100 Hz."""

    def __init__(self, uri):
        os.environ.update(ROS_MASTER_URI=uri, ROS_IP="127.0.0.1")
        import rospy
        from geometry_msgs.msg import Point, Pose, Quaternion

        from ambf_msgs.msg import RigidBodyCmd

        rospy.init_node("bench_touch", anonymous=True, disable_signals=True, disable_rosout=True)
        self.ending = threading.Event()
        topics = [
            (rospy.Publisher(f"/ambf/env/hands/{name}/Command", RigidBodyCmd, queue_size=1), at)
            for name, at in PLACES.items()
        ]

        def run():
            turns = 0
            while not self.ending.wait(0.01):
                turns += 1
                for topic, (x, y, z) in topics:
                    command = RigidBodyCmd(cartesian_cmd_type=RigidBodyCmd.TYPE_POSITION)
                    command.pose = Pose(Point(x + SWAY * math.sin(0.06 * turns), y, z), Quaternion(0, 0, 0, 1))
                    topic.publish(command)

        self.thread = threading.Thread(target=run, daemon=True)
        self.thread.start()

    def close(self):
        self.ending.set()
        self.thread.join()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--runs", type=int, default=2)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    operator = Operator(master.uri)
    rows = []
    try:
        with support.scratch() as folder:
            launch = scene(folder)
            for what, models in (("board alone", "0"), ("with two hands of 2 x 50 rays", "0,1")):
                arguments = ("--launch_file", launch, "-l", models)
                runs = [support.summary_of(arguments, options.seconds, master=master) for _ in range(options.runs)]
                best = min(runs, key=lambda run: abs(run["steps per second"] - 1000))
                rows.append(
                    [
                        what,
                        f"{best['steps per second']:.1f}",
                        f"{best['real-time factor']:.4f}",
                        f"{best['process CPU']:.1f}",
                        f"{best['physics thread CPU']:.1f}",
                        f"{100 * best['busy']:.0f}",
                    ]
                )
    finally:
        operator.close()
        master.kill()
    support.table(rows, ["scene", "steps/s", "real-time factor", "CPU %", "of it physics", "machine busy %"])


if __name__ == "__main__":
    main()
