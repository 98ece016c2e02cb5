"""As 3.0's user of CRTK topics: nothing but ral. crtk_launcher.py runs."""

import copy

import numpy as np
from geometry_msgs.msg import PoseStamped
from manager import wait_until
from ros_abstraction_layer import ral
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty

from ambf_msgs.msg import RigidBodyState

ral.parse_argv(["crtk_user.py"])
node = ral("crtk_user")
heard = {}


def listen(topic, kind):
    heard[topic] = []
    return node.subscriber(topic, kind, heard[topic].append)


ends = [listen(f"/CRTK/psm1/{name}", kind) for name, kind in (("measured_js", JointState), ("T_b_w", PoseStamped))]
ends += [listen(f"/CRTK/{name}/measured_cp", PoseStamped) for name in ("psm1", "ecm", "Needle", "Entry1", "Exit4")]
ends += [listen("/CRTK/scene/task_3_setup/ready", Empty), listen("/ambf/env/psm1/baselink/State", RigidBodyState)]
out = {n: node.publisher(f"/CRTK/psm1/{n}", JointState, queue_size=1) for n in ("servo_jp", "move_jp", "jaw/servo_jp")}
out |= {n: node.publisher(f"/CRTK/psm1/{n}", PoseStamped, queue_size=1) for n in ("servo_cp", "move_cp")}
ecm = node.publisher("/CRTK/ecm/servo_jp", JointState, queue_size=1)
init = node.publisher("/CRTK/scene/task_3_setup/init", Empty, queue_size=1)
resets = [node.publisher(f"/ambf/env/World/Command/{name}", Empty) for name in ("Reset", "Reset/Bodies", "ResetBodies")]
node.spin()
wait_until(lambda: all(heard[t] for t in heard if "ready" not in t), "all topics of the launcher are heard")
wait_until(lambda: all(p.get_num_connections() > 0 for p in (*out.values(), ecm, init, *resets[:2])), "and served")
for each in resets:
    each.publish(Empty())
node.create_rate(10).sleep()


def measured():
    return np.array(heard["/CRTK/psm1/measured_js"][-1].position)


def reached(goal, what):
    wait_until(lambda: np.abs(measured() - goal).max() < 3e-3, what)


goal = np.array((0.1, -0.1, 0.12, 0.2, 0.1, 0.0))
out["servo_jp"].publish(JointState(position=goal))
reached(goal, "servo_jp")
true = np.array(heard["/ambf/env/psm1/baselink/State"][-1].joint_positions[:6])
assert 1e-3 < np.abs(true - goal)[:3].max() < 0.1, f"joint errors of the model: {true - goal}"
goal[3] = -0.3
out["move_jp"].publish(JointState(position=goal))
reached(goal, "move_jp")
for name, way in (("servo_cp", 0.004), ("move_cp", -0.006)):
    pose = copy.deepcopy(heard["/CRTK/psm1/measured_cp"][-1])
    pose.pose.position.z += way
    out[name].publish(pose)

    def is_there(pose=pose):
        now = heard["/CRTK/psm1/measured_cp"][-1].pose.position
        wanted = pose.pose.position
        return max(abs(now.x - wanted.x), abs(now.y - wanted.y), abs(now.z - wanted.z)) < 1e-3

    wait_until(is_there, name)
out["jaw/servo_jp"].publish(JointState(position=[0.3]))
wait_until(lambda: abs(heard["/ambf/env/psm1/baselink/State"][-1].joint_positions[6] - 0.3) < 0.02, "jaw/servo_jp")

before = heard["/CRTK/ecm/measured_cp"][-1].pose.position.z
ecm.publish(JointState(position=[0.0, 0.0, 0.01, 0.0]))
wait_until(lambda: abs(heard["/CRTK/ecm/measured_cp"][-1].pose.position.z - before) > 1e-3, "ecm/servo_jp")
init.publish(Empty())
wait_until(lambda: heard["/CRTK/scene/task_3_setup/ready"], "ready")
stamps = [node.to_sec(message) for message in heard["/CRTK/psm1/measured_js"]]
assert stamps == sorted(stamps) and node.to_sec(node.now() - node.create_duration(0.5)) < stamps[-1] + 5.0
print("done", flush=True)
