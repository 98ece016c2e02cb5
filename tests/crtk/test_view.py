"""PSMs and set-up arms in the view of an ECM: what they report, against where the bodies are."""

import numpy as np
import pytest
from crtk_arm import DESCRIPTIONS, Arm, close_to
from crtk_double import matrix
from geometry_msgs.msg import PoseStamped
from harness import ROOT, SIMULATOR, eventually
from std_msgs.msg import String

from ambf_msgs.msg import CameraState, RigidBodyState

pytestmark = pytest.mark.skipif(not SIMULATOR.exists(), reason=f"no {SIMULATOR.name}")
DVRK = ROOT / "ambf_models/descriptions/launch_dvrk.yaml"
# Where the tips are in bodies of the models: the camera of a straight endoscope, and the jaw's pin.
T_SCOPE_TIP = np.diag([1.0, -1.0, -1.0, 1.0])
T_SCOPE_TIP[2, 3] = -0.371
T_TIP_VIEW = np.eye(4)  # x left, y up in the picture
T_TIP_VIEW[:2, :2] = [[0, 1], [-1, 0]]
T_TIP_CAMERA = np.array([[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1.0]])
T_JAW_TIP = np.eye(4)
T_JAW_TIP[:3, :3] = [[0, -1, 0], [0, 0, 1], [-1, 0, 0]]
# Joints of the set-up arms, as published for a simulated cart; PSM3 stands 0.25 rad aside (docs/models.md).
SET_UP = {
    "PSM1": [0.0007, -0.5892, -0.859, -0.6241, -0.2479, -0.4422],
    "PSM2": [0.0628, 0.0913, 1.9073, -0.1297, 0.4351, 0.0353],
    "PSM3": [-0.0261, -1.8392, 1.3076, 0.6994, 0.1361, 0.3359],
    "ECM": [0.6647, 0.5782, -1.2662, 3.7818 - 2 * np.pi, 0, 0],
}


def test_psms_are_in_the_view_of_the_ecm(start, master, ros):
    files = ",".join(str(DESCRIPTIONS / name) for name in ("psm1.yaml", "ecm.yaml", "suj.yaml"))
    crtk = ["--crtk", files]
    start("--launch_file", DVRK, "-l", "0,1,2,3,4,5", *crtk, allowed=[r"CRTK", r"refused"], master_uri=master.uri)
    last = {"/PSM1/tool_type", "/ECM/endoscope_type", *(f"/SUJ/{name}/goal_reached" for name in SET_UP)}
    eventually(lambda: last <= set(master.published()), 30.0, "the topics")
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
    the_camera_turns_with_the_endoscope(ros, ecm, scope)
    set_up_arms_stand_and_move(ros, T_scope=lambda: matrix(scope.last().pose) @ T_SCOPE_TIP @ T_TIP_VIEW)


def the_camera_turns_with_the_endoscope(ros, ecm, scope):
    """It is at the tip, and along its axes: what is seen is what poses in the view say."""
    camera = ros.listen("/ambf/env/cameras/endoscope/State", CameraState)
    base = ros.listen("/ambf/env/ecm/baselink/State", RigidBodyState)
    straight = matrix(camera.last().pose)
    for kind, up in (("SD_UP", 0.5), ("SD_DOWN", -0.5), ("HD_STRAIGHT", 0.0)):
        ecm.talker("set_endoscope_type", String).publish(kind)

        def looks(up=up):
            away = -matrix(camera.last().pose)[:3, 0]
            T_world_tip = matrix(base.last().pose) @ matrix(ecm.fresh(ecm.measured_cp).pose)
            T_world_camera = matrix(scope.last().pose) @ matrix(camera.last().pose)
            there = np.abs(T_world_camera - T_world_tip @ T_TIP_CAMERA).max() < 5e-4
            return there and np.allclose(away @ straight[:3, 1:3], [0.0, up], atol=1e-6)

        eventually(looks, 10.0, f"the camera is {kind}")


def set_up_arms_stand_and_move(ros, T_scope):
    """Their tips are the bases of the arms that they carry, in the view too; they move these, and hold DISABLED."""
    for name, joints in SET_UP.items():
        arm = Arm(ros, f"SUJ/{name}")
        assert arm.state.state == "DISABLED" and arm.state.is_homed
        measured = arm.fresh(arm.measured_js, close_to(joints, 2e-3))
        local = ros.listen(f"/SUJ/{name}/local/measured_cp", PoseStamped)
        base = ros.listen(f"/ambf/env/{name.lower()}/baselink/State", RigidBodyState)
        assert measured.header.frame_id == ("SUJ/ECM_base" if name == "ECM" else "ECM")
        off = np.linalg.inv(matrix(base.last().pose)) @ matrix(arm.fresh(local).pose) - np.eye(4)
        assert np.abs(off).max() < 2e-3, name
    arm = Arm(ros, "SUJ/PSM1")
    base = ros.listen("/ambf/env/psm1/baselink/State", RigidBodyState)
    before = matrix(base.last().pose)
    arm.command("enable")
    arm.wait(lambda: arm.state.state == "ENABLED", "is enabled")
    goal = [SET_UP["PSM1"][0] + 0.02, *SET_UP["PSM1"][1:]]
    arm.wait_idle_after(lambda: arm.joints("move_jp", goal))
    arm.command("disable")
    arm.wait(lambda: arm.state.state == "DISABLED", "is disabled")
    arm.fresh(arm.measured_js, close_to(goal, 2e-3))
    assert abs(matrix(base.last().pose)[2, 3] - before[2, 3] - 0.02) < 2e-3

    def seen():
        truth = np.linalg.inv(T_scope()) @ matrix(base.last().pose)
        return np.abs(matrix(arm.fresh(arm.measured_cp).pose) - truth).max()

    eventually(lambda: seen() < 1e-3, 5.0, "the base is seen where it is")
    warnings = len(arm.warnings.messages)
    arm.joints("move_jp", SET_UP["PSM1"])
    eventually(lambda: len(arm.warnings.messages) > warnings, 5.0, "refused while its brakes hold")
    arm.fresh(arm.measured_js, close_to(goal, 2e-3))
