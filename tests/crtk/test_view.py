"""PSMs in the view of an ECM: what both report, against where the bodies are."""

import numpy as np
import pytest
from crtk_arm import DESCRIPTIONS, Arm, close_to
from crtk_double import matrix
from harness import ROOT, SIMULATOR, eventually

from ambf_msgs.msg import RigidBodyState

pytestmark = pytest.mark.skipif(not SIMULATOR.exists(), reason=f"no {SIMULATOR.name}")
DVRK = ROOT / "ambf_models/descriptions/launch_dvrk.yaml"
# Where the tips are in bodies of the models: the camera of a straight endoscope, and the jaw's pin.
T_SCOPE_TIP = np.diag([1.0, -1.0, -1.0, 1.0])
T_SCOPE_TIP[2, 3] = -0.371
T_TIP_VIEW = np.eye(4)  # x left, y up in the picture
T_TIP_VIEW[:2, :2] = [[0, 1], [-1, 0]]
T_JAW_TIP = np.eye(4)
T_JAW_TIP[:3, :3] = [[0, -1, 0], [0, 0, 1], [-1, 0, 0]]


def test_psms_are_in_the_view_of_the_ecm(start, master, ros):
    files = ",".join(str(DESCRIPTIONS / name) for name in ("psm1.yaml", "ecm.yaml"))
    start("--launch_file", DVRK, "-l", "0,1,2,3,4,5", "--crtk", files, allowed=[r"CRTK"], master_uri=master.uri)
    eventually(lambda: {"/PSM1/tool_type", "/ECM/endoscope_type"} <= set(master.published()), 30.0, "the topics")
    psm, ecm = Arm(ros, "PSM1"), Arm(ros, "ECM")
    scope = ros.listen("/ambf/env/ecm/toollink/State", RigidBodyState)
    jaw = ros.listen("/ambf/env/psm1/toolgripper1link/State", RigidBodyState)
    psm.home(), ecm.home()
    # Both move: the ECM alone changes what the PSM reports.
    goal = [0.1, 0.05, 0.1, 0.2]
    ecm.wait_idle_after(lambda: ecm.joints("move_jp", goal))
    ecm.fresh(ecm.measured_js, close_to(goal, 2e-3))

    def seen():
        T_world_view = matrix(scope.last().pose) @ T_SCOPE_TIP @ T_TIP_VIEW
        truth = np.linalg.inv(T_world_view) @ matrix(jaw.last().pose) @ T_JAW_TIP
        return np.abs(matrix(psm.fresh(psm.measured_cp).pose)[:3, 3] - truth[:3, 3]).max()

    eventually(lambda: seen() < 5e-4, 5.0, "the jaw's pin is seen where it is")
    assert psm.fresh(psm.measured_cp).header.frame_id == psm.fresh(psm.measured_js).header.frame_id == "ECM"
    # Along the view's own axes: 15 mm to the left and 10 mm away.
    wanted = psm.fresh(psm.setpoint_cp).pose
    wanted.position.x += 0.015
    wanted.position.z += 0.010
    psm.wait_idle_after(lambda: psm.pose("move_cp", wanted))
    off = matrix(psm.fresh(psm.measured_cp).pose) - matrix(wanted)
    assert np.abs(off[:3, 3]).max() < 5e-4
    eventually(lambda: seen() < 5e-4, 5.0, "the jaw's pin is where it was sent")
