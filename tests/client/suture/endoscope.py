"""As 3.0's control of the endoscope: its body and the cameras on it are moved by poses."""

import numpy as np
from arms import ECM, Camera
from manager import SimulationManager, wait_until

manager = SimulationManager("ecm_control")
ecm = ECM(manager, "CameraFrame")
begin = ecm.get_T_c_w()
goal = begin.copy()
goal[:3, 3] += (0.004, 0.0, 0.006)
ecm.servo_cp(goal)
wait_until(ecm.has_pose_changed, "all steps are sent")
wait_until(lambda: np.abs(ecm.measured_cp() - goal).max() < 1e-3, "the endoscope is there")
ecm.servo_cp(begin)
wait_until(lambda: np.abs(ecm.measured_cp() - begin).max() < 1e-3, "and back")
camera = Camera(manager, "cameraL")
before = camera.measured_cp()
camera.move_cv((0.0, 0.0, 0.05), 0.1)
wait_until(lambda: abs(np.linalg.norm((camera.measured_cp() - before)[:3, 3]) - 0.005) < 1e-4, "the camera moved")
camera.move_cp(before)
wait_until(lambda: np.abs(camera.measured_cp() - before).max() < 1e-4, "and back")
print("done", flush=True)
