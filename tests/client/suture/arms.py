"""Arms, endoscope and cameras as programs of AMBF 3.0 make them of handles, with their grasp logic and joint errors."""

import threading
import time
from pathlib import Path

import numpy as np
from ambf_client.kinematics import chain_of_adf
from manager import inverse, wait_until
from ros_abstraction_layer import ral
from sensor_msgs.msg import ChannelFloat32

ADF = Path(__file__).resolve().parents[3] / "ambf_models/suturing"
JAW_HELD = 0.05  # rad: commanded below, what the ghosts feel is held
PREFIXES = ("Needle", "Thread", "Puzzle")


class JointErrorsModel:
    """Constant errors of the first three joints, as encoders of real arms have them. Makes a ral of its own."""

    def __init__(self, arm_name, num_joints):
        self._ral = ral(f"{arm_name}_errors_model")
        self._errors = np.zeros(num_joints)
        topic = f"/ambf/env/{arm_name}/errors_model/set_errors"
        self._sub = self._ral.subscriber(topic, ChannelFloat32, self._set, queue_size=1)

    def _set(self, message):
        self._errors[: len(message.values)] = message.values

    def randomize(self):
        self._errors[:3] = np.random.default_rng(3).uniform(-1.0, 1.0, 3) * np.radians((5.0, 5.0, 0.0))
        self._errors[2] = 0.004  # m

    def add_to_joints(self, q, joint_mask):
        return np.asarray(q) + self._errors * joint_mask

    def remove_from_joints(self, q, joint_mask):
        return np.asarray(q) - self._errors * joint_mask


class PSM:
    mask = np.array((1, 1, 1, 0, 0, 0))

    def __init__(self, simulation_manager, name, add_joint_errors=False, detect_tool_id=True, tool_id=400006):
        self.simulation_manager, self.name = simulation_manager, name
        self.base = simulation_manager.get_obj_handle(f"{name}/baselink", required=True)
        self.tool_id = int(tool_id)
        if detect_tool_id:
            topic = simulation_manager.get_obj_handle(f"{name}/tool_id", required=True).get_ros_name()
            self.tool_id = int(topic.replace("_", "/").split("/")[-1])
        for target in ("target_ik", "palm_joint_ik", "target_fk"):
            assert simulation_manager.get_obj_handle(f"{name}_{target}") is None
        self.ghosts = [simulation_manager.get_obj_handle(f"{name}/{side}_finger_ghost") for side in ("left", "right")]
        self.actuator = simulation_manager.get_obj_handle(f"{name}/Actuator0")
        self.grasped = False
        self._chain = chain_of_adf(ADF / f"{name}.yaml", "baselink", "toolyawlink")
        self._errors = JointErrorsModel(name, 6)
        if add_joint_errors:
            self._errors.randomize()
        self._thread = None
        wait_until(lambda: len(self.base.get_all_joint_pos()) >= 8, "joint positions are published")
        self.set_jaw_angle(0.5)

    def get_tool_id(self):
        return self.tool_id

    def get_rostopic_name(self):
        return self.base.get_ros_name()

    def get_joint_names(self):
        return self.base.get_joint_names()

    def get_lower_limits(self):
        return self._chain.lower

    def get_upper_limits(self):
        return self._chain.upper

    def get_T_b_w(self):
        return self.base.get_pose()

    def get_T_w_b(self):
        return inverse(self.get_T_b_w())

    def measured_jp(self):
        true = [self.base.get_joint_pos(i) for i in range(6)]
        return self._errors.remove_from_joints(true, self.mask)

    def measured_jv(self):
        return np.array([self.base.get_joint_vel(i) for i in range(6)])

    def measured_cp(self):
        return self._chain.forward(self.measured_jp())

    def get_ik_solution(self, T_t_b):
        return self._chain.inverse(T_t_b, self.measured_jp())

    def servo_jp(self, jp):
        for i, q in enumerate(self._errors.add_to_joints(jp, self.mask)):
            self.base.set_joint_pos(i, q)

    def servo_jv(self, jv):
        for i, v in enumerate(jv):
            self.base.set_joint_vel(i, v)

    def servo_cp(self, T_t_b):
        self.servo_jp(self.get_ik_solution(T_t_b).joints)

    def move_jp(self, jp_cmd, execute_time=0.5, control_rate=120):
        start, goal = self.measured_jp(), np.asarray(jp_cmd)

        def run():
            rate = self.simulation_manager.create_rate(control_rate)
            for part in np.linspace(0.0, 1.0, max(2, int(execute_time * control_rate))):
                self.servo_jp(start + part * (goal - start))
                rate.sleep()

        self._thread = threading.Thread(target=run)
        self._thread.start()

    def move_cp(self, T_t_b, execute_time=0.5, control_rate=120):
        self.move_jp(self.get_ik_solution(T_t_b).joints, execute_time, control_rate)

    def wait_for(self, jp, tolerance=2e-3):
        if self._thread is not None:
            self._thread.join()
        wait_until(lambda: np.abs(self.measured_jp() - jp).max() < tolerance, f"{self.name} is at {jp}")

    def set_jaw_angle(self, jaw_angle):
        for joint in (6, 7):
            self.base.set_joint_pos(joint, jaw_angle)
        self.run_grasp_logic(jaw_angle)

    def run_grasp_logic(self, jaw_angle):
        if jaw_angle >= JAW_HELD:
            self.actuator.deactuate()
            self.grasped = False
            return
        if self.grasped:
            return
        names = [name for ghost in self.ghosts for name in ghost.get_all_sensed_obj_names()]
        for prefix in PREFIXES:
            fits = [name for name in names if prefix in name]
            if fits:
                self.actuator.actuate(fits[0])
                self.grasped = True


class ECM:
    """The endoscope: a static body that is commanded in small steps."""

    step_m = 0.002

    def __init__(self, simulation_manager, name):
        self.simulation_manager = simulation_manager
        self.camera_handle = simulation_manager.get_obj_handle(name, required=True)
        self._start = self.camera_handle.get_pose()
        self._moved = False
        self._thread = None

    def measured_cp(self):
        return self.camera_handle.get_pose()

    get_T_c_w = measured_cp

    def measured_jp(self):
        return np.zeros(4)

    def has_pose_changed(self):
        return self._moved

    def servo_cp(self, T_c_w):
        begin = self.measured_cp()
        way = T_c_w[:3, 3] - begin[:3, 3]
        count = max(1, int(np.ceil(np.linalg.norm(way) / self.step_m)))

        def run():
            rate = self.simulation_manager.create_rate(100)
            for i in range(1, count + 1):
                pose = T_c_w.copy()
                pose[:3, 3] = begin[:3, 3] + i / count * way
                self.camera_handle.set_pose(pose)
                rate.sleep()
            self._moved = True

        if self._thread is not None:
            self._thread.join()
        self._thread = threading.Thread(target=run)
        self._thread.start()

    def servo_jp(self, jp):
        """Only the insertion, along the camera's own z."""
        pose = self._start.copy()
        pose[:3, 3] -= jp[2] * pose[:3, 2]
        self.servo_cp(pose)


class Camera:
    """A camera of the world, by its pose in its parent."""

    def __init__(self, simulation_manager, name):
        self.camera_handle = simulation_manager.get_obj_handle(name, required=True)

    def measured_cp(self):
        return self.camera_handle.get_pose()

    def move_cp(self, T_c_w):
        self.camera_handle.set_pose(T_c_w)

    def move_cv(self, linear, dt):
        pose = self.measured_cp()
        pose[:3, 3] += pose[:3, :3] @ np.asarray(linear) * dt
        self.move_cp(pose)


class Scene:
    grip = (0.0, -0.0102, 0.0)  # between the fingers, in toolyawlink's frame (m)
    base_in_needle = np.array((-0.00951, 0.00103, 0.0))

    def __init__(self, simulation_manager):
        self.simulation_manager = simulation_manager
        self.needle = simulation_manager.get_obj_handle("Needle", required=True)
        names = [f"{kind}{i}" for kind in ("Entry", "Exit") for i in range(1, 5)]
        self.holes = {name: simulation_manager.get_obj_handle(f"phantom/{name}", required=True) for name in names}

    def needle_measured_cp(self):
        return self.needle.get_pose()

    def task_3_setup_init(self, psm):
        jp = np.array((-0.4, -0.22, 0.139, -1.64, -0.37, -0.11))
        psm.set_jaw_angle(0.8)
        psm.servo_jp(jp)
        psm.wait_for(jp)
        wrist = self.simulation_manager.get_obj_handle(f"{psm.name}/toolyawlink", required=True)
        rate = self.simulation_manager.create_rate(100)
        for before in np.linspace(0.010, 0.0, 40):
            self.needle.set_pose(self._gripped(wrist.get_pose(), before))
            rate.sleep()
        begin = self.needle.get_sim_time()
        wait_until(lambda: self.needle.get_sim_time() > begin + 0.5, "the needle has come into the jaw")
        for _ in range(30):
            psm.set_jaw_angle(0.0)
            time.sleep(0.01)
        wait_until(lambda: psm.set_jaw_angle(0.0) or psm.grasped, "the ghosts feel the needle")  # on a slow machine
        wait_until(psm.actuator.is_actuated, "the needle is held")
        self.needle.set_force((0.0, 0.0, 0.0))  # ends the pose command
        self.needle.set_torque((0.0, 0.0, 0.0))

    def _gripped(self, T_w_wrist, before):
        pose = T_w_wrist.copy()
        grip = T_w_wrist @ (*self.grip[:1], self.grip[1] - before, self.grip[2], 1.0)
        pose[:3, 3] = grip[:3] - pose[:3, :3] @ self.base_in_needle
        return pose
