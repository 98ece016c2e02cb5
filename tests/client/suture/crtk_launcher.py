"""As 3.0's CRTK launcher: arms with joint errors, endoscope and scene as topics, 120 times a second."""

import argparse

import numpy as np
from arms import ECM, PSM, Scene
from geometry_msgs.msg import PoseStamped
from manager import SimulationManager, angles_of, frame
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty
from tf_function import euler_from_quaternion, quaternion_from_euler


def to_message(matrix, frame_id, stamp):
    message = PoseStamped()
    message.header.stamp, message.header.frame_id = stamp, frame_id
    position, orientation = message.pose.position, message.pose.orientation
    position.x, position.y, position.z = matrix[:3, 3]
    orientation.x, orientation.y, orientation.z, orientation.w = quaternion_from_euler(*angles_of(matrix))
    return message


def from_message(message):
    p, q = message.pose.position, message.pose.orientation
    return frame((p.x, p.y, p.z), euler_from_quaternion((q.x, q.y, q.z, q.w)))


class PSMTopics:
    def __init__(self, ral, prefix, arm):
        self.arm = arm
        out = {"measured_js": JointState, "measured_cp": PoseStamped, "T_b_w": PoseStamped}
        self.out = {name: ral.publisher(f"{prefix}/{name}", kind, queue_size=1) for name, kind in out.items()}
        handlers = {
            "servo_jp": (JointState, lambda m: arm.servo_jp(m.position)),
            "move_jp": (JointState, lambda m: arm.move_jp(m.position)),
            "servo_jv": (JointState, lambda m: arm.servo_jv(m.velocity)),
            "jaw/servo_jp": (JointState, lambda m: arm.set_jaw_angle(m.position[0])),
            "servo_cp": (PoseStamped, lambda m: arm.servo_cp(from_message(m))),
            "move_cp": (PoseStamped, lambda m: arm.move_cp(from_message(m))),
        }
        self.subscribers = [ral.subscriber(f"{prefix}/{n}", k, f, queue_size=1) for n, (k, f) in handlers.items()]

    def publish(self, stamp):
        state = JointState(name=self.arm.get_joint_names()[:6], position=self.arm.measured_jp())
        state.velocity, state.header.stamp = self.arm.measured_jv(), stamp
        self.out["measured_js"].publish(state)
        self.out["measured_cp"].publish(to_message(self.arm.measured_cp(), f"{self.arm.name}/baselink", stamp))
        self.out["T_b_w"].publish(to_message(self.arm.get_T_b_w(), "world", stamp))


class ECMTopics:
    def __init__(self, ral, prefix, ecm):
        self.ecm = ecm
        self.js = ral.publisher(f"{prefix}/measured_js", JointState, queue_size=1)
        self.cp = ral.publisher(f"{prefix}/measured_cp", PoseStamped, queue_size=1)
        self.servo = ral.subscriber(
            f"{prefix}/servo_jp", JointState, lambda m: ecm.servo_jp(np.array(m.position)), queue_size=1
        )

    def publish(self, stamp):
        state = JointState(name=[f"j{i}" for i in range(4)], position=self.ecm.measured_jp())
        state.header.stamp = stamp
        self.js.publish(state)
        self.cp.publish(to_message(self.ecm.measured_cp(), "world", stamp))


class SceneTopics:
    def __init__(self, ral, prefix, scene, arm):
        self.bodies = {"Needle": scene.needle, **scene.holes}
        self.out = {n: ral.publisher(f"{prefix}/{n}/measured_cp", PoseStamped, queue_size=1) for n in self.bodies}
        self.ready = ral.publisher("/CRTK/scene/task_3_setup/ready", Empty, queue_size=1)

        def set_up(_):
            scene.task_3_setup_init(arm)
            self.ready.publish(Empty())

        self.init = ral.subscriber("/CRTK/scene/task_3_setup/init", Empty, set_up, queue_size=1)

    def publish(self, stamp):
        for name, publisher in self.out.items():
            publisher.publish(to_message(self.bodies[name].get_pose(), "world", stamp))


parser = argparse.ArgumentParser()
for flag in ("--one", "--two", "--ecm", "--scene"):
    parser.add_argument(flag, type=lambda text: text.lower() == "true", default=True)
parser.add_argument("--ns", default="/CRTK")
parser.add_argument("--rate", type=float, default=120.0)
options = parser.parse_args()

manager = SimulationManager("crtk_interface")
node = manager.get_ral()
arms = {n: PSM(manager, n, add_joint_errors=True) for n, on in (("psm1", options.one), ("psm2", options.two)) if on}
served = [PSMTopics(node, f"{options.ns}/{name}", arm) for name, arm in arms.items()]
if options.ecm:
    served.append(ECMTopics(node, f"{options.ns}/ecm", ECM(manager, "CameraFrame")))
if options.scene and "psm2" in arms:
    served.append(SceneTopics(node, options.ns, Scene(manager), arms["psm2"]))
print("serving", flush=True)
rate = manager.create_rate(options.rate)
while not manager.is_shutdown():
    for each in served:
        each.publish(manager.get_time_msg())
    rate.sleep()
