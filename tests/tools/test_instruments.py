"""ambf-cli tool gives a PSM of a running simulator another instrument."""

import json

from harness import ROOT, eventually

PSM = ROOT / "ambf_models/descriptions/multi-bodies/robots/psm.yaml"


def test_a_running_simulator_takes_it_from_the_command_line(master, start, cli):
    start("-a", PSM, master_uri=master.uri)
    eventually(lambda: "/ambf/env/psm/baselink/State" in master.published(), 20.0, "the PSM")

    done = json.loads(cli("tool", "PSM1", "prograsp", "--json").stdout)
    assert done["tool"] == "PROGRASP_FORCEPS:400093" and "/ambf/env/psm/toolrolllink" in done["removed"]
    joints = json.loads(cli("joints", "psm/baselink", "--json").stdout)
    assert "toolpitchlink-toolgripper1link" in json.dumps(joints)
    again = json.loads(cli("tool", "psm", "scissors", "--json").stdout)
    assert again["instrument"] == "scissors" and again["model"] != done["model"]
    assert "spoon" in cli("tool", "PSM1", "spoon", code=1).stderr
