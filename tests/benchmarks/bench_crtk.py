"""Six arms of the whole dVRK over CRTK, each commanded and heard 1000 times a second: the rate of
every topic, and the time from servo_jp to the first measured_js of a frame that has the new set-point. The original has
no CRTK; through its client a command shows in a State after 5.9 ms (p50). Each arm has a program of its own; in Python,
these need more of the machine than the simulator."""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

import support  # first: it makes the tools of the acceptance tests importable

# isort: split
from harness import ROOT, Master, Simulator, eventually

ARMS = ("PSM1", "PSM2", "PSM3", "ECM", "MTMR", "MTML")
QUERIES = ("measured_js", "measured_cp", "setpoint_js", "setpoint_cp", "measured_cv")


def fast_descriptions(folder):
    files = []
    for name in ("psm1", "psm2", "psm3", "ecm", "mtmr", "mtml"):
        text = (ROOT / f"ambf_models/descriptions/crtk/{name}.yaml").read_text()
        file = folder / f"{name}.yaml"
        text = text.replace("../../instruments/", f"{ROOT}/ambf_models/instruments/")  # it is read from elsewhere
        file.write_text(re.sub(r"(\n    base: .*\n)", r"\1    rate: 1000\n", text))
        files.append(str(file))
    return ",".join(files)


class Served:
    """One arm: what is heard of it, and the way from a command to its effect."""

    def __init__(self, rospy, name):
        from geometry_msgs.msg import PoseStamped, TwistStamped
        from sensor_msgs.msg import JointState

        from crtk_msgs.msg import OperatingState, StringStamped

        kinds = dict(zip(QUERIES, (JointState, PoseStamped, JointState, PoseStamped, TwistStamped), strict=True))
        self.counts = dict.fromkeys(QUERIES, 0)
        self.delays, self.sent, self.obeyed = [], None, None
        self.state, self.position = None, None
        self.joint_state, self.text = JointState, StringStamped
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


def drive(name, seconds):
    """One arm, in a process of its own; prints its row."""
    import rospy

    rospy.init_node(f"bench_{name}", anonymous=True, disable_rosout=True)
    arm = Served(rospy, name)
    arm.command.publish(arm.text(string="home"))
    eventually(lambda: arm.state and arm.state.is_homed and not arm.state.is_busy and arm.position, 60.0, "homed")
    arm.home = list(arm.position)
    arm.counts = dict.fromkeys(QUERIES, 0)
    start = due = time.perf_counter()
    sent = 0
    while time.perf_counter() < start + seconds:
        arm.send(1e-6 * (sent % 1000))
        sent += 1
        due = max(due + 1e-3, time.perf_counter() - 1e-3)  # what is late is not made up for
        time.sleep(max(0.0, due - time.perf_counter()))
    passed = time.perf_counter() - start
    rates = [f"{count / passed:.0f}" for count in (sent, *(arm.counts[topic] for topic in QUERIES))]
    print("|".join([name, *rates, f"{1e3 * median(arm.delays):.2f}" if arm.delays else "none"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--arm", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.arm:
        return drive(options.arm, options.seconds)
    folder = Path(tempfile.mkdtemp())
    master = Master()
    os.environ["ROS_MASTER_URI"], os.environ["ROS_IP"] = master.uri, "127.0.0.1"
    launch = ROOT / "ambf_models/descriptions/launch_dvrk.yaml"
    crtk = fast_descriptions(folder)
    arguments = ["--launch_file", launch, "-l", "0,1,2,3,4,5,6,7", "--crtk", crtk]
    simulator = Simulator(folder, *arguments, master_uri=master.uri, allowed=[r"."])
    eventually(lambda: all(f"/{name}/goal_reached" in master.published() for name in ARMS), 60.0, "six arms")
    command = [sys.executable, __file__, "--seconds", str(options.seconds), "--arm"]
    running = [subprocess.Popen([*command, name], stdout=subprocess.PIPE, text=True) for name in ARMS]
    rows = [process.communicate()[0].strip().splitlines()[-1].split("|") for process in running]
    support.table(rows, ["arm, Hz", "servo_jp", *QUERIES, "servo_jp to measured_js, ms p50"])
    simulator.stop()
    simulator.close()
    master.kill()
    return None


if __name__ == "__main__":
    main()
