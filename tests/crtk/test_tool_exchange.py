"""Instruments that set_tool_type exchanges in the model while all runs, and what is refused."""

import subprocess

import numpy as np
import pytest
from ambf_client import Client
from ambf_client.kinematics import load_arm
from crtk_arm import DESCRIPTIONS, PSM, Arm, close_to
from crtk_double import matrix
from harness import ROOT, SIMULATOR, eventually
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty, String

from ambf_msgs.msg import RigidBodyState

pytestmark = pytest.mark.skipif(not SIMULATOR.exists(), reason=f"no {SIMULATOR.name}")
LND, PROGRASP, SCISSORS = "LARGE_NEEDLE_DRIVER:400006", "PROGRASP_FORCEPS:400093", "CURVED_SCISSORS"
AWAY, BACK = [0.2, -0.1, 0.15, 0.5, 0.2, -0.3], [0.1, 0.0, 0.13, 0.3, -0.1, 0.1]
T_JAW_TIP = np.eye(4)
T_JAW_TIP[:3, :3] = [[0, -1, 0], [0, 0, 1], [-1, 0, 0]]


@pytest.fixture
def folder(tmp_path):
    """The description and its instruments, to be spoilt."""
    (tmp_path / "instruments").mkdir()
    for file in (ROOT / "ambf_models/instruments").iterdir():
        text = file.read_text().replace("../meshes", str(ROOT / "ambf_models/meshes"))
        (tmp_path / "instruments" / file.name).write_text(text)
    text = (DESCRIPTIONS / "psm.yaml").read_text().replace("../../instruments", "instruments")
    (tmp_path / "psm.yaml").write_text(text)
    return tmp_path


@pytest.fixture
def psm(start, master, ros, folder):
    allowed = [r"CRTK", r"refused", r"names no object"]  # the last: the model goes while its tool does
    simulator = start("-l", PSM, "--crtk", folder / "psm.yaml", allowed=allowed, master_uri=master.uri)
    eventually(lambda: "/PSM1/tool_type" in master.published(), 30.0, "the arm's topics")
    arm = Arm(ros, "PSM1")
    arm.tool = ros.listen("/PSM1/tool_type", String)
    arm.home()
    arm.joints("servo_jp", AWAY)
    arm.fresh(arm.measured_js, close_to(AWAY, 2e-5))
    yield arm
    simulator.stop()


def exchange(arm, tool):
    arm.talker("set_tool_type", String).publish(tool)
    arm.tool.next(lambda message: message.data == tool, 20.0)


def refused(arm, tool, said):
    before, heard = arm.tool.last().data, len(arm.warnings.messages)
    arm.talker("set_tool_type", String).publish(tool)
    eventually(lambda: any(said in m.data for m in arm.warnings.messages[heard:]), 10.0, said)
    assert arm.tool.last().data == before
    arm.wait_idle_after(lambda: arm.joints("move_jp", AWAY))


def off_tip(arm, ros):
    """How far the bodies have the tip from where the arm says (m)."""
    base = ros.listen("/ambf/env/psm/baselink/State", RigidBodyState).last()
    jaw = ros.listen("/ambf/env/psm/toolgripper1link/State", RigidBodyState)

    def off():
        tip = np.linalg.inv(matrix(base.pose)) @ matrix(jaw.last().pose) @ T_JAW_TIP
        return np.abs(matrix(arm.fresh(arm.measured_cp).pose)[:3, 3] - tip[:3, 3]).max()

    return off


def test_the_model_gets_the_tool_and_the_arm_goes_on(psm, ros):
    jaw = ros.listen("/PSM1/jaw/measured_js", JointState)
    for tool in (PROGRASP, LND):
        states = len(psm.states)
        before = np.array(psm.fresh(psm.measured_js).position)
        exchange(psm, tool)
        off = off_tip(psm, ros)
        eventually(lambda off=off: off() < 1e-4, 10.0, "the model's tip is where its kinematics have it")
        assert np.abs(np.array(psm.fresh(psm.measured_js).position) - before).max() < np.radians(0.01)
        assert {message.state for message in psm.states[states:]} <= {"ENABLED"}
        psm.joints("jaw/servo_jp", [-2.0])
        psm.fresh(jaw, close_to([load_arm("PSM", tool).jaw.lower], 0.03))
        psm.joints("servo_jp", BACK if tool == PROGRASP else AWAY)
        psm.fresh(psm.measured_js, close_to(BACK if tool == PROGRASP else AWAY, 2e-5))
    with Client() as client:
        names = [model.name for model in client.list().models]
        assert [name for name in names if name.startswith(("prograsp", "scissors", "lnd"))] == ["lnd.yaml"], names


def test_what_cannot_be_exchanged_is_said_and_the_arm_goes_on(psm, ros, folder):
    requested = ros.listen("/PSM1/tool_type_request", Empty)
    refused(psm, "A_HAMMER", "there is no tool")
    requested.last()
    (folder / "instruments/prograsp.yaml").unlink()
    refused(psm, PROGRASP, "prograsp.yaml")
    text = (folder / "instruments/scissors.yaml").read_text()
    (folder / "instruments/scissors.yaml").write_text(text.replace("BODY pitch end link", "BODY of nothing"))
    refused(psm, SCISSORS, "BODY of nothing")
    # The model goes while its tool does.
    with Client() as client:
        model = next(each for each in client.list().models if each.name.startswith("psm"))
        psm.talker("set_tool_type", String).publish("MARYLAND_BIPOLAR")
        client.unload(model)
        psm.wait(lambda: psm.state.state == "FAULT", "is at fault")
        client.load(str(ROOT / "ambf_models/descriptions/multi-bodies/robots/psm.yaml"))
        eventually(lambda: psm.command("enable") or psm.state.state == "ENABLED", 20.0, "it is there again")


def test_mistakes_in_instruments_have_a_place(tmp_path, folder):
    file = folder / "psm.yaml"
    right = file.read_text()
    for wrong, found in (
        (right.replace("scissors.yaml", "sissors.yaml"), "cannot read instruments/sissors.yaml"),
        (right.replace("CURVED_SCISSORS", "CURVED_SISSORS"), "did you mean 'CURVED_SCISSORS'?"),
        (right.replace("instruments/scissors.yaml", "psm.yaml"), "a description of CRTK arms"),
    ):
        file.write_text(wrong)
        checked = subprocess.run([SIMULATOR, "--check", file], capture_output=True, text=True, check=False)
        assert checked.returncode == 1 and found in checked.stdout, checked.stdout
        assert "psm.yaml:1" in checked.stdout and "[PSM1: instruments]" in checked.stdout, checked.stdout
