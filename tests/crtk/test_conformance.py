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


# Those that stand clear of each other share a simulator, each with a client of its own, all at once.
TOGETHER = [("PSM1", "ECM", "MTMR"), ("MINE",)]


def description(name):
    from ambf_client.kinematics import load_arm

    _, kinematics, base, _ = ARMS[name]
    slides = load_arm(kinematics).prismatic
    speed, change = ([(v / 5.0 if s else v) for s in slides] for v in (3.0, ACCELERATION))
    gripper = ", gripper: {joint: WristRoll-Gripper1, scale: 2, closed below: 0.26}" if name == "MTMR" else ""
    return (
        f"{name}: {{kinematics: {kinematics}, base: {base}, rate: 250, max velocity: {speed}, "
        f"max acceleration: {change}{gripper}}}"
    )


@pytest.mark.parametrize("names", TOGETHER, ids="-".join)
@pytest.mark.parametrize(("factor", "clock"), [(0.2, "simulated"), (1.0, "wall"), (5.0, "simulated")])
def test_arms_keep_all_rows(names, factor, clock, start, own_master, tmp_path):
    file = tmp_path / "arms.yaml"
    file.write_text(f"crtk arms: {{{', '.join(description(name) for name in names)}}}")
    pace = [] if factor == 1.0 else ["-t", "true", "-s", factor]
    pace += ["--clock"] if clock == "simulated" else []
    places = ",".join(ARMS[name][0] for name in names)
    start("-l", places, "--crtk", file, *pace, allowed=[r"CRTK", r"refused"], master_uri=own_master.uri)
    topics = {f"/{name}/goal_reached" for name in names}
    eventually(lambda: topics <= set(own_master.published()), 30.0, "the arms' topics")
    env = dict(os.environ, ROS_MASTER_URI=own_master.uri, ROS_IP="127.0.0.1")
    env["PYTHONPATH"] = os.pathsep.join([str(HERE), *filter(None, sys.path)])
    clients = []
    for name in names:
        _, kinematics, _, part = ARMS[name]
        arguments = [name, kinematics, part, factor, ACCELERATION, PATIENCE * SLOWNESS, clock]
        command = [sys.executable, str(HERE / "conformance_program.py"), *map(str, arguments)]
        clients.append(subprocess.Popen(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True))
    try:
        for name, client in zip(names, clients, strict=True):
            output, errors = client.communicate(timeout=120 * SLOWNESS)
            assert client.returncode == 0 and output.endswith("all rows hold\n"), f"{name}: {output}{errors}"
    finally:
        for client in clients:
            client.kill()
            client.wait()
