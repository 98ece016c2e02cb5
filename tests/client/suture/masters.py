"""As 3.0's teleoperation: a master's topics move an arm, 200 times a second. The test is the master."""

import sys

from arms import PSM
from geometry_msgs.msg import PoseStamped
from manager import SimulationManager
from sensor_msgs.msg import JointState, Joy

manager = SimulationManager("mtm_psm_pair")
node = manager.get_ral()
psm = PSM(manager, "psm1")
psm.servo_jp((0.0, 0.0, 0.12, 0.0, 0.0, 0.0))
psm.wait_for((0.0, 0.0, 0.12, 0.0, 0.0, 0.0))
newest = {"clutch": True, "jaw": 0.5}
ends = [
    node.subscriber("/MTMR/measured_cp", PoseStamped, lambda m: newest.__setitem__("cp", m.pose.position), 1),
    node.subscriber("/MTMR/gripper/measured_js", JointState, lambda m: newest.__setitem__("jaw", m.position[0]), 1),
    node.subscriber("/footpedals/clutch", Joy, lambda m: newest.__setitem__("clutch", bool(m.buttons[0])), 1),
]
print("serving", flush=True)
rate, last, goal = manager.create_rate(200), None, psm.measured_cp()
while not manager.is_shutdown():
    at = newest.get("cp")
    if at is not None:
        if last is not None and not newest["clutch"]:
            goal[:3, 3] += (at.x - last.x, at.y - last.y, at.z - last.z)
            psm.servo_cp(goal)
        last = at
    psm.set_jaw_angle(newest["jaw"])
    rate.sleep()
sys.exit(0)
