"""Every row of what CRTK clients count on, for each kind of arm, slow, in real time and fast, by either clock."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from harness import SIMULATOR, SLOWNESS, eventually

pytestmark = pytest.mark.skipif(not SIMULATOR.exists(), reason=f"no {SIMULATOR.name}")
HERE = Path(__file__).parent
ARMS = {  # place in the shipped launch file, kinematics, base, one of the bodies that it cannot do without
    "PSM1": ("15", "PSM", "/ambf/env/psm/BODY base link", "/ambf/env/psm/BODY tool pitch link"),
    "ECM": ("16", "ECM", "/ambf/env/ecm/BODY base link", "/ambf/env/ecm/BODY main insertion link"),
    "MTMR": ("17", "MTMR", "/ambf/env/mtm/BODY Top Panel", "/ambf/env/mtm/BODY WristPitch"),
    "MINE": ("20", "LBR_MED_14", "/ambf/env/BODY base", "/ambf/env/BODY Link4"),
}
ACCELERATION = 15.0
PATIENCE = 20.0  # s for what takes tenths


def description(name, kinematics, base):
    from ambf_client.kinematics import load_arm

    slides = load_arm(kinematics).prismatic
    speed, change = ([(v / 5.0 if s else v) for s in slides] for v in (3.0, ACCELERATION))
    gripper = ", gripper: {joint: WristRoll-Gripper1, scale: 2, closed below: 0.26}" if name == "MTMR" else ""
    return (
        f"crtk arms: {{{name}: {{kinematics: {kinematics}, base: {base}, rate: 250, max velocity: {speed}, "
        f"max acceleration: {change}{gripper}}}}}"
    )


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize(("factor", "clock"), [(0.2, "simulated"), (1.0, "wall"), (5.0, "simulated")])
def test_an_arm_keeps_all_rows(name, factor, clock, start, own_master, tmp_path):
    place, kinematics, base, part = ARMS[name]
    file = tmp_path / "arms.yaml"
    file.write_text(description(name, kinematics, base))
    pace = [] if factor == 1.0 else ["-t", "true", "-s", factor]
    pace += ["--clock"] if clock == "simulated" else []
    start("-l", place, "--crtk", file, *pace, allowed=[r"CRTK", r"refused"], master_uri=own_master.uri)
    eventually(lambda: f"/{name}/goal_reached" in own_master.published(), 30.0, "the arm's topics")
    env = dict(os.environ, ROS_MASTER_URI=own_master.uri, ROS_IP="127.0.0.1")
    env["PYTHONPATH"] = os.pathsep.join([str(HERE), *filter(None, sys.path)])
    arguments = [name, kinematics, part, factor, ACCELERATION, PATIENCE * SLOWNESS, clock]
    done = subprocess.run(
        [sys.executable, str(HERE / "conformance_program.py"), *map(str, arguments)],
        env=env,
        capture_output=True,
        text=True,
        timeout=120 * SLOWNESS,
        check=False,
    )
    assert done.returncode == 0 and done.stdout.endswith("all rows hold\n"), f"{done.stdout}{done.stderr}"
