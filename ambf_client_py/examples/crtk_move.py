"""Homes a CRTK arm and moves it there and back, with plain rospy: what a program for a real arm does.

ambf_simulator -l 15 --crtk ambf_models/descriptions/crtk/psm.yaml
python3 crtk_move.py [ARM] [METRES]
"""

import sys
import threading

import rospy
from geometry_msgs.msg import PoseStamped

from crtk_msgs.msg import OperatingState, StringStamped


class Arm:
    def __init__(self, name: str) -> None:
        self.changed = threading.Condition()
        self.state = OperatingState()
        self.was_busy = False
        self.command = rospy.Publisher(f"{name}/state_command", StringStamped, queue_size=10)
        self.move = rospy.Publisher(f"{name}/move_cp", PoseStamped, queue_size=10)
        self.name = name
        rospy.Subscriber(f"{name}/operating_state", OperatingState, self.on_state)

    def on_state(self, message: OperatingState) -> None:
        with self.changed:
            self.state = message
            self.was_busy |= message.is_busy
            self.changed.notify_all()

    def send_and_wait(self, publisher: rospy.Publisher, message: object) -> None:
        """A move or homing has ended once the arm was busy and is idle again."""
        while publisher.get_num_connections() == 0:
            rospy.sleep(0.01)
        with self.changed:
            self.was_busy = False
            publisher.publish(message)
            ended = self.changed.wait_for(lambda: self.was_busy and not self.state.is_busy, 30.0)
        if not ended:
            sys.exit(f"{self.name} does not answer: is the simulator running with --crtk?")

    def set_point(self) -> PoseStamped:
        return rospy.wait_for_message(f"{self.name}/setpoint_cp", PoseStamped, 10.0)


def main() -> None:
    arguments = rospy.myargv(sys.argv)[1:]
    name = arguments[0] if arguments else "PSM1"
    distance = float(arguments[1]) if len(arguments) > 1 else 0.02
    rospy.init_node("crtk_move", anonymous=True)
    arm = Arm(name)
    arm.send_and_wait(arm.command, StringStamped(string="home"))
    print(f"{name} is {arm.state.state}, homed: {arm.state.is_homed}")
    for step in (distance, -distance):
        goal = arm.set_point()
        goal.pose.position.x += step
        arm.send_and_wait(arm.move, goal)
        reached = arm.set_point().pose.position
        print(f"moved by {1000 * step:+.0f} mm to ({reached.x:.4f}, {reached.y:.4f}, {reached.z:.4f}) m")


if __name__ == "__main__":
    main()
