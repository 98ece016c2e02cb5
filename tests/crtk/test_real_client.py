"""CRTK's own Python client moves our arms: its example programs, unchanged."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from crtk_arm import DESCRIPTIONS, MTMR, PSM, Arm, close_to
from harness import ROOT, SIMULATOR, SLOWNESS, eventually

CLIENTS = Path(os.environ.get("AMBF_CLIENTS_DIR", ROOT.parent / "shared/clients"))
CLIENT = CLIENTS / "crtk_python_client"
pytestmark = pytest.mark.skipif(not SIMULATOR.exists(), reason=f"no {SIMULATOR.name}")
# Enables, homes and moves as a user's program does.
PROGRAM = """
import sys, crtk, numpy
class Arm:
    def __init__(self, ral):
        self.utils = crtk.utils(self, ral)
        for name in ("operating_state", "measured_js", "measured_cp", "measured_cv", "setpoint_js", "setpoint_cp",
                     "servo_jp", "servo_jr", "servo_jf", "servo_cp", "move_jp", "move_jr", "move_cp", "hold", "free",
                     "forward_kinematics", "inverse_kinematics"):
            getattr(self.utils, "add_" + name)()
ral = crtk.ral("ours", sys.argv[1])
arm = Arm(ral)
ral.check_connections(10.0)
assert arm.enable(20) and arm.home(20), "enable, home"
start = arm.setpoint_jp(wait_timeout=2.0)[0]
goal = numpy.copy(start)
goal[0] += 0.1
assert arm.move_jp(goal).wait(), "move_jp"
assert abs(arm.measured_jp()[0][0] - goal[0]) < 0.01
assert arm.move_jp(goal).wait(timeout=5.0), "to where it is"
assert arm.move_jp(start).wait()
"""


@pytest.mark.parametrize(
    ("place", "file", "name", "scripts"),
    [
        (PSM, "psm.yaml", "PSM1", ["crtk_move_cp_example.py", "crtk_servo_jp_example.py"]),
        (MTMR, "mtmr.yaml", "MTMR", ["crtk_move_cp_example.py", "crtk_servo_cp_example.py"]),
    ],
)
def test_programs_of_the_crtk_client_run_unchanged(place, file, name, scripts, start, master, ros, tmp_path):
    if not CLIENT.is_dir():
        pytest.skip("no crtk_python_client (set AMBF_CLIENTS_DIR)")
    pytest.importorskip("PyKDL", reason="the CRTK client needs Debian's python3-pykdl")
    import crtk_msgs.msg

    built = str(Path(crtk_msgs.msg.__file__).parents[2])
    path = os.pathsep.join([str(CLIENT / "src"), built, *filter(None, [os.environ.get("PYTHONPATH")])])
    env = dict(os.environ, ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1", ROS_VERSION="1", PYTHONPATH=path)

    def run(*command):
        done = subprocess.run(
            [sys.executable, *map(str, command)], env=env, capture_output=True, text=True, timeout=90 * SLOWNESS
        )
        assert done.returncode == 0, f"{command[-2:]}: {done.stdout}{done.stderr}"

    start("-l", place, "--crtk", DESCRIPTIONS / file, master_uri=master.uri)
    eventually(lambda: f"/{name}/measured_js" in master.published(), 30.0, "the arm's topics")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    run(program, name)
    arm = Arm(ros, name)
    rest = list(arm.fresh(arm.measured_js).position)
    for script in scripts:
        moves = len(arm.measured_js.messages)
        run(CLIENT / "scripts" / script, name)
        seen = [message.position for message in arm.measured_js.messages[moves:]]
        assert max(abs(p - r) for position in seen for p, r in zip(position, rest, strict=True)) > 0.02, script
    arm.fresh(arm.measured_js, close_to(rest, 0.02))
