"""A client of one CRTK arm that waits exactly as CRTK clients do, by whatever rospy's clock is: for programs of their
own (rospy follows one clock a process). `last_busy` is when the last message that says busy arrived; of states that are
not newer than the last one only that is noted."""

import threading
import time

import numpy as np
import rospy
from geometry_msgs.msg import PoseStamped, TwistStamped, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Empty, Float64MultiArray, String

from crtk_msgs.msg import OperatingState, StringStamped

QUERIES = {
    "measured_js": JointState,
    "measured_cp": PoseStamped,
    "measured_cv": TwistStamped,
    "setpoint_js": JointState,
    "setpoint_cp": PoseStamped,
    "goal_js": JointState,
    "local/measured_cp": PoseStamped,
    "body/jacobian": Float64MultiArray,
    "spatial/jacobian": Float64MultiArray,
    "body/measured_cf": WrenchStamped,
    "goal_reached": Bool,
    "warning": String,
}
COMMANDS = {
    "state_command": StringStamped,
    "servo_jp": JointState,
    "servo_jr": JointState,
    "servo_jf": JointState,
    "servo_cp": PoseStamped,
    "servo_cv": TwistStamped,
    "move_jp": JointState,
    "move_cp": PoseStamped,
    "body/servo_cf": WrenchStamped,
    "set_base_frame": PoseStamped,
    "hold": Empty,
}


def until(condition, seconds=20.0, what=""):
    """The value of condition() once it is true; wall time."""
    end = time.monotonic() + seconds
    while True:
        value = condition()
        if value:
            return value
        assert time.monotonic() < end, f"not within {seconds} s: {what}"
        time.sleep(0.002)


class Double:
    def __init__(self, name, patience):
        self.name, self.patience = name, patience
        self.data = OperatingState()
        self.last_busy = rospy.Time.now()
        self.event = threading.Condition()
        self.states = []
        self.heard = {topic: [] for topic in QUERIES}
        rospy.Subscriber(f"/{name}/operating_state", OperatingState, self.on_state, queue_size=10)
        for topic, kind in QUERIES.items():
            rospy.Subscriber(f"/{name}/{topic}", kind, self.heard[topic].append, queue_size=1000, tcp_nodelay=True)
        self.talkers = {
            topic: rospy.Publisher(f"/{name}/{topic}", kind, queue_size=100, tcp_nodelay=True)
            for topic, kind in COMMANDS.items()
        }
        until(lambda: self.states, patience, "the latched state")
        for topic, talker in self.talkers.items():
            until(lambda talker=talker: talker.get_num_connections() > 0, patience, f"{topic} is heard")

    def on_state(self, message):
        now = rospy.Time.now()
        with self.event:
            if message.is_busy and now > self.last_busy:
                self.last_busy = now
            if message.header.stamp > self.data.header.stamp:
                self.data = message
                self.states.append(message)
            self.event.notify_all()

    def wait(self, condition, what):
        with self.event:
            assert self.event.wait_for(condition, self.patience), f"{self.name}: {what}: {self.data}"

    # ---- What users call.

    def state_command(self, text):
        self.talkers["state_command"].publish(StringStamped(string=text))

    def enable(self):
        self.state_command("enable")
        self.wait(lambda: self.data.state == "ENABLED", "is enabled")

    def home(self):
        self.state_command("home")
        self.wait(lambda: self.data.is_homed and not self.data.is_busy, "is homed")

    def state(self, text, wanted):
        self.state_command(text)
        self.wait(lambda: self.data.state == wanted, f"{text} leads to {wanted}")

    def move(self, topic, message):
        """Sends a move and waits for its end: busy, received after it was sent, and then idle."""
        start = rospy.Time.now()
        self.talkers[topic].publish(message)
        self.wait(lambda: self.last_busy > start, f"{topic} is busy")
        self.wait(lambda: self.last_busy > start and not self.data.is_busy, f"{topic} is idle again")

    def move_jp(self, position):
        self.move("move_jp", joints(position))

    def servo_jp(self, position):
        self.talkers["servo_jp"].publish(joints(position))

    def last(self, topic, condition=lambda message: True):
        """The newest message, once it fits and came after this call."""
        before = len(self.heard[topic])
        seen = self.heard[topic]
        until(lambda: len(seen) > before and condition(seen[-1]), self.patience, f"{self.name}/{topic}")
        return seen[-1]

    def set_point(self, wanted=None, tolerance=1e-9):
        def fits(message):
            return wanted is None or (len(message.position) and near(message.position, wanted, tolerance))

        return np.array(self.last("setpoint_js", fits).position)

    def warned(self, text, since):
        heard = self.heard["warning"]
        return until(lambda: [m.data for m in heard[since:] if text in m.data], self.patience, f"a warning: {text}")


def near(a, b, tolerance):
    return len(a) == len(b) and np.abs(np.subtract(a, b)).max() <= tolerance


def joints(position=(), **fields):
    return JointState(position=list(position), **fields)


def matrix(pose):
    q, p = pose.orientation, pose.position
    x, y, z, w = q.x, q.y, q.z, q.w
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = [p.x, p.y, p.z]
    return made
