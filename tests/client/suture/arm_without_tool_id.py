"""As 3.0's tests of an arm: made without its tool's body, its inverse kinematics, its limits."""

import numpy as np
from arms import PSM
from manager import SimulationManager

manager = SimulationManager("psm_test")
psm = PSM(manager, "psm1", detect_tool_id=False, tool_id=400006)
assert psm.get_tool_id() == 400006
assert psm.get_rostopic_name() == "/ambf/env/psm1/baselink"
assert len(psm.get_joint_names()) == 8
assert np.abs(psm.get_upper_limits()[:2] - (1.588, 0.925)).max() < 0.02
for q in np.random.default_rng(5).uniform(-0.4, 0.4, (5, 6)) + (0.0, 0.0, 0.5, 0.0, 0.0, 0.0):
    q[2] = 0.1 + 0.02 * q[2]
    found = psm._chain.inverse(psm._chain.forward(q), q + 0.05)
    assert found.reached and np.abs(psm._chain.forward(found.joints) - psm._chain.forward(q)).max() < 1e-6
psm.servo_jp((0.1, 0.1, 0.11, 0.3, -0.2, 0.1))
psm.wait_for((0.1, 0.1, 0.11, 0.3, -0.2, 0.1))
assert np.abs(psm.measured_cp() - psm.get_T_w_b() @ manager.get_obj_handle("psm1/toolyawlink").get_pose()).max() < 3e-3
print("done", flush=True)
