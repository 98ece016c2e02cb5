"""As 3.0's interface by methods: resets, both arms, endoscope, scene, the setup of a task, its report."""

import time

import numpy as np
from arms import ECM, PSM, Scene
from manager import SimulationManager, inverse, wait_until
from std_msgs.msg import Bool

manager = SimulationManager("method_api")
world = manager.get_world_handle()
world.reset()
time.sleep(0.5)
arms = {name: PSM(manager, name) for name in ("psm1", "psm2")}
ecm, scene = ECM(manager, "CameraFrame"), Scene(manager)
assert [arm.get_tool_id() for arm in arms.values()] == [400006, 400006]
assert len(scene.holes) == 8 and scene.holes["Entry1"].get_ros_name() == "/ambf/env/phantom/Entry1"

psm = arms["psm2"]
scene.task_3_setup_init(psm)
wrist = manager.get_obj_handle("psm2/toolyawlink")
held = inverse(wrist.get_pose()) @ scene.needle_measured_cp()
print("held", flush=True)

goal = psm.measured_cp()  # by kinematics, in the base; against what the simulation says
assert np.abs(goal - psm.get_T_w_b() @ wrist.get_pose()).max() < 3e-3
goal[:3, 3] += (0.004, 0.003, -0.005)
psm.move_cp(goal, execute_time=0.3)
psm.wait_for(psm.get_ik_solution(goal).joints)
now = psm.get_T_w_b() @ wrist.get_pose()
assert np.abs(now[:3, 3] - goal[:3, 3]).max() < 2e-3, now
wait_until(
    lambda: np.abs(inverse(wrist.get_pose()) @ scene.needle_measured_cp() - held)[:3, 3].max() < 5e-4,
    "the needle follows the jaw",
)
psm.set_jaw_angle(0.5)
wait_until(lambda: not psm.actuator.is_actuated(), "the needle is released")

ral = manager.get_ral()
report = ral.publisher("/surgical_robotics_challenge/completion_report/team/task3/", Bool, queue_size=1, latch=True)
assert ral.get_topic_name(report) == "/surgical_robotics_challenge/completion_report/team/task3"
report.publish(Bool(True))
assert ecm.measured_jp().tolist() == [0.0] * 4 and not manager.is_shutdown()
world.reset_bodies()
print("done", flush=True)
