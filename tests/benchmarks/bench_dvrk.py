"""The whole dVRK with the CRTK in real time, all six arms on their way from pose to pose: steps a wall second, the true
real-time factor, and what that costs.

The target: 1000 +-2 steps a second, factor 1.000 +-0.005, less than 60 % of a core (the original with three arms: 946
steps, 99 %).
"""

import argparse
import os
import threading

import support  # first: it makes the tools of the acceptance tests importable

# isort: split
from harness import ROOT, Master, eventually

ARMS = ("PSM1", "PSM2", "PSM3", "ECM", "MTMR", "MTML")
ANGLE, SHIFT = 0.15, 0.02  # rad and m to either side of home
UNTIL_READY_S = 20.0  # before the time that counts, most of it with nothing to do


class Mover:
    """Sends an arm to and fro; the next move when the last one is done."""

    def __init__(self, rospy, name):
        from sensor_msgs.msg import JointState

        from crtk_msgs.msg import OperatingState, StringStamped

        self.state, self.home, self.moves, self.message = None, None, 0, JointState
        self.slides = {2} if name[0] != "M" else set()  # the insertion
        rospy.Subscriber(f"/{name}/operating_state", OperatingState, self.on_state)
        rospy.Subscriber(f"/{name}/measured_js", JointState, self.on_measured)
        self.move = rospy.Publisher(f"/{name}/move_jp", JointState, queue_size=10)
        self.command = rospy.Publisher(f"/{name}/state_command", StringStamped, queue_size=10, latch=True)
        self.command.publish(StringStamped(string="home"))

    def on_state(self, message):
        self.state = message

    def on_measured(self, message):
        self.home = self.home or list(message.position)

    def ready(self):
        return self.state and self.home and self.state.is_homed and not self.state.is_busy

    def go_on(self):
        if not self.ready():
            return
        side = -1.0 if self.moves % 2 else 1.0
        steps = (SHIFT if joint in self.slides else ANGLE for joint in range(len(self.home)))
        self.move.publish(self.message(position=[at + side * step for at, step in zip(self.home, steps, strict=True)]))
        self.moves += 1


def run(master, rospy, seconds):
    files = ",".join(str(ROOT / f"ambf_models/descriptions/crtk/{name.lower()}.yaml") for name in ARMS)
    launch = ROOT / "ambf_models/descriptions/launch_dvrk.yaml"
    arguments = ["--launch_file", launch, "-l", "0,1,2,3,4,5,6,7,8,9", "--crtk", files]
    numbers = {}
    simulator = threading.Thread(
        target=lambda: numbers.update(support.summary_of(arguments, seconds + UNTIL_READY_S, master=master))
    )
    simulator.start()
    movers = [Mover(rospy, name) for name in ARMS]
    eventually(lambda: all(mover.ready() for mover in movers), UNTIL_READY_S, "six arms at home")
    while simulator.is_alive():
        for mover in movers:
            mover.go_on()
        simulator.join(0.2)
    if not numbers or min(mover.moves for mover in movers) < seconds / 10:
        raise SystemExit(f"not all arms went on moving: {[mover.moves for mover in movers]}")
    return numbers, [mover.moves for mover in movers]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--runs", type=int, default=2)
    options = parser.parse_args()
    print(support.machine())
    master = Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    import rospy

    rospy.init_node("bench_dvrk", anonymous=True, disable_signals=True, disable_rosout=True)
    rows = []
    try:
        for _ in range(options.runs):
            numbers, moves = run(master, rospy, options.seconds)
            rows.append(
                [
                    f"{numbers['steps per second']:.1f}",
                    f"{numbers['real-time factor']:.4f}",
                    f"{numbers['process CPU']:.1f}",
                    f"{numbers['physics thread CPU']:.1f}",
                    f"{numbers['steps given up']:.0f}",
                    f"{min(moves)} to {max(moves)}",
                    f"{100 * numbers['busy']:.0f}",
                ]
            )
    finally:
        master.kill()
    head = ["steps/s", "real-time factor", "CPU %", "of it physics", "given up", "moves of an arm", "machine busy %"]
    support.table(rows, head)


if __name__ == "__main__":
    main()
