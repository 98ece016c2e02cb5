"""Six arms of the whole dVRK over CRTK, each told a position 1000 times a second and heard at 1000 Hz: the rate of
every topic, and the time from servo_jp to the first measured_js of a frame that has the new set-point. The original has
no CRTK; through its client a command shows in a State after 5.9 ms (p50). Python hears the topics: on two cores it
bounds the rates, and not the simulator."""

import argparse
import os
import re
import tempfile
import threading
import time
from pathlib import Path
from statistics import median

import support  # first: it makes the tools of the acceptance tests importable

# isort: split
from harness import ROOT, Master, Simulator, eventually

ARMS = {"PSM1": 6, "PSM2": 6, "PSM3": 6, "ECM": 4, "MTMR": 7, "MTML": 7}
QUERIES = ("measured_js", "measured_cp", "setpoint_js", "setpoint_cp", "measured_cv")


def fast_descriptions(folder):
    files = []
    for name in ("psm1", "psm2", "psm3", "ecm", "mtmr", "mtml"):
        text = (ROOT / f"ambf_models/descriptions/crtk/{name}.yaml").read_text()
        file = folder / f"{name}.yaml"
        file.write_text(re.sub(r"(\n    base: .*\n)", r"\1    rate: 1000\n", text))
        files.append(str(file))
    return ",".join(files)


class Served:
    """One arm: what is heard of it, and the way from a command to its effect."""

    def __init__(self, rospy, name, joints):
        from geometry_msgs.msg import PoseStamped, TwistStamped
        from sensor_msgs.msg import JointState

        from crtk_msgs.msg import OperatingState, StringStamped

        kinds = dict(zip(QUERIES, (JointState, PoseStamped, JointState, PoseStamped, TwistStamped), strict=True))
        self.counts = dict.fromkeys(QUERIES, 0)
        self.delays, self.sent, self.obeyed = [], None, None
        self.state, self.position = None, None
        self.joint_state, self.text, self.joints = JointState, StringStamped, joints
        rospy.Subscriber(f"/{name}/operating_state", OperatingState, self.on_state)
        for topic, kind in kinds.items():
            special = {"setpoint_js": self.on_set_point, "measured_js": self.on_measured}
            on_message = special.get(topic, self.counter(topic))
            rospy.Subscriber(f"/{name}/{topic}", kind, on_message, queue_size=1000, tcp_nodelay=True)
        self.servo = rospy.Publisher(f"/{name}/servo_jp", JointState, queue_size=10, tcp_nodelay=True)
        self.command = rospy.Publisher(f"/{name}/state_command", StringStamped, queue_size=10, latch=True)

    def on_state(self, message):
        self.state = message

    def counter(self, topic):
        def count(_message):
            self.counts[topic] += 1

        return count

    def on_set_point(self, message):
        self.counts["setpoint_js"] += 1
        self.position = message.position
        sent = self.sent
        if sent is not None and message.position and abs(message.position[0] - sent[1]) < 1e-12:
            self.obeyed, self.sent = (sent[0], message.header.stamp), None

    def on_measured(self, message):
        self.counts["measured_js"] += 1
        obeyed = self.obeyed
        if obeyed is not None and message.header.stamp >= obeyed[1]:
            self.delays.append(time.perf_counter() - obeyed[0])
            self.obeyed = None

    def send(self, offset):
        target = [self.home[0] + offset, *self.home[1:]]
        if self.sent is None and self.obeyed is None:
            self.sent = (time.perf_counter(), target[0])
        self.servo.publish(self.joint_state(position=target))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0)
    options = parser.parse_args()
    folder = Path(tempfile.mkdtemp())
    master = Master()
    os.environ["ROS_MASTER_URI"], os.environ["ROS_IP"] = master.uri, "127.0.0.1"
    launch = ROOT / "ambf_models/descriptions/launch_dvrk.yaml"
    simulator = Simulator(
        folder, "--launch_file", launch, "-l", "0,1,2,3,4,5,6,7", "--crtk", fast_descriptions(folder),
        master_uri=master.uri, allowed=[r"."],
    )  # fmt: skip
    import rospy

    rospy.init_node("bench_crtk", anonymous=True, disable_rosout=True)
    eventually(lambda: all(f"/{name}/goal_reached" in master.published() for name in ARMS), 60.0, "six arms")
    arms = {name: Served(rospy, name, joints) for name, joints in ARMS.items()}
    for arm in arms.values():
        arm.command.publish(arm.text(string="home"))
    eventually(lambda: all(a.state and a.state.is_homed and not a.state.is_busy for a in arms.values()), 60.0, "homed")
    eventually(lambda: all(a.position for a in arms.values()), 10.0, "set-points")
    for arm in arms.values():
        arm.home = list(arm.position)
        arm.counts = dict.fromkeys(QUERIES, 0)
    stop = time.perf_counter() + options.seconds

    def drive(arm):
        due, i = time.perf_counter(), 0
        while due < stop:
            arm.send(1e-6 * (i % 1000))
            i += 1
            due += 1e-3
            time.sleep(max(0.0, due - time.perf_counter()))
        arm.sent_count = i

    drivers = [threading.Thread(target=drive, args=(arm,)) for arm in arms.values()]
    for driver in drivers:
        driver.start()
    for driver in drivers:
        driver.join()
    rows = []
    for name, arm in arms.items():
        rates = [f"{arm.counts[topic] / options.seconds:.0f}" for topic in QUERIES]
        rows.append([name, f"{arm.sent_count / options.seconds:.0f}", *rates, f"{1e3 * median(arm.delays):.2f}"])
    support.table(rows, ["arm, Hz", "servo_jp", *QUERIES, "servo_jp to measured_js, ms p50"])
    simulator.stop()
    simulator.close()
    master.kill()


if __name__ == "__main__":
    main()
