"""A client of CRTK arms that waits as CRTK's own client does, and where the shipped descriptions are."""

import threading

import rospy
from geometry_msgs.msg import PoseStamped
from harness import ROOT, SLOWNESS, eventually
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, String

from crtk_msgs.msg import OperatingState, StringStamped

DESCRIPTIONS = ROOT / "ambf_models/descriptions/crtk"
PSM, ECM, MTMR = "15", "16", "17"  # places of the shipped launch file
PATIENCE = 20.0  # s; a move of the tests takes 2


class Arm:
    """An arm's topics. Moves wait for busy, received after they were sent, and then for idle (CRTK's wait logic)."""

    def __init__(self, ros, name):
        self.ros, self.name = ros, name
        self._changed = threading.Condition()
        self.states = []  # (time of arrival, message) of those that are not older than the newest
        self._busy_at = rospy.Time(0)
        self.open("operating_state", OperatingState, self._on_state)
        self.measured_js = ros.listen(f"/{name}/measured_js", JointState)
        self.setpoint_js = ros.listen(f"/{name}/setpoint_js", JointState)
        self.measured_cp = ros.listen(f"/{name}/measured_cp", PoseStamped)
        self.setpoint_cp = ros.listen(f"/{name}/setpoint_cp", PoseStamped)
        self.warnings = ros.listen(f"/{name}/warning", String)
        self.reached = ros.listen(f"/{name}/goal_reached", Bool)
        self._talkers = {}
        eventually(lambda: self.states, 10.0, "the latched state")

    def open(self, topic, kind, callback):
        subscriber = rospy.Subscriber(f"/{self.name}/{topic}", kind, callback, queue_size=10)
        self.ros.open.append(subscriber)

    def _on_state(self, message):
        with self._changed:
            if message.is_busy:
                self._busy_at = rospy.Time.now()
            if not self.states or message.header.stamp > self.states[-1].header.stamp:
                self.states.append(message)
            self._changed.notify_all()

    @property
    def state(self):
        return self.states[-1]

    def wait(self, condition, what):
        with self._changed:
            assert self._changed.wait_for(condition, PATIENCE * SLOWNESS), f"{self.name}: {what}: {self.state}"

    def talker(self, topic, kind):
        if topic not in self._talkers:
            self._talkers[topic] = self.ros.talk(f"/{self.name}/{topic}", kind)
        return self._talkers[topic]

    def command(self, text):
        self.talker("state_command", StringStamped).publish(StringStamped(string=text))

    def joints(self, topic, position=(), **fields):
        self.talker(topic, JointState).publish(JointState(position=list(position), **fields))

    def pose(self, topic, pose):
        self.talker(topic, PoseStamped).publish(PoseStamped(pose=pose))

    def home(self):
        self.command("home")
        self.wait(lambda: self.state.is_homed and not self.state.is_busy, "is homed")
        assert self.state.state == "ENABLED"

    def wait_idle_after(self, send):
        """Sends a move and waits for its end."""
        start = rospy.Time.now()
        send()
        self.wait(lambda: self._busy_at > start and not self.state.is_busy, "busy, then idle")

    def fresh(self, listener, condition=lambda message: True):
        """The first message from now on that fits."""
        return listener.next(condition, PATIENCE)


def close_to(wanted, tolerance=5e-3):
    return lambda message: (
        len(message.position) == len(wanted)
        and max(abs(a - b) for a, b in zip(message.position, wanted, strict=True)) < tolerance
    )
