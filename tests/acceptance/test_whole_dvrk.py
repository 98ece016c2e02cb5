"""The whole da Vinci Research Kit in one scene, by ROS: every arm on the cart takes commands at the same time."""

import math

import pytest
from ambf_client import Client
from harness import ROOT, eventually

LAUNCH = ROOT / "ambf_models/descriptions/launch_dvrk.yaml"
# Base of an arm: targets of its joints, rad or m
PATIENT_SIDE = {"baselink-yawlink": 0.2, "yawlink-pitchbacklink": -0.15, "pitchendlink-maininsertionlink": 0.08}
MASTER = {"TopPanel-OutPitchShoulder": 0.1, "OutPitchShoulder-ArmParallel": 0.2}
ARMS = {
    **{f"{arm}/baselink": PATIENT_SIDE for arm in ("psm1", "psm2", "psm3", "ecm")},
    "mtm/TopPanel": MASTER,
    "mtml/TopPanel": MASTER,
}


def distance(client, *names):
    """Between the origins of two bodies, m."""
    return math.dist(*(client.wait_for(f"/ambf/env/{name}").position for name in names))


def test_all_arms_of_the_dvrk_move_at_once(master, start, ros):
    simulator = start("--launch_file", LAUNCH, "-l", "0,1,2,3,4,5,6,7,8,9", master_uri=master.uri)
    topics = {f"/ambf/env/{base}/State" for base in ARMS} | {"/ambf/env/baselink/State"}
    eventually(lambda: topics <= set(master.published()), 30.0, "the topics of all arms")
    client = Client()
    client.connect()
    arms = {base: client.get_obj_handle(f"/ambf/env/{base}") for base in ARMS}
    tip = client.wait_for("/ambf/env/psm1/toolgripper1link")
    before = list(tip.position)
    mounted = distance(client, "sujpsm1L5", "psm1/baselink")
    for base, targets in ARMS.items():
        eventually(arms[base].get_joint_names, 5.0, f"the joints of {base}")
        for joint, target in targets.items():
            arms[base].set_joint_pos(joint, target)
    client.world.step(2000)
    for base, targets in ARMS.items():
        for joint, target in targets.items():
            assert arms[base].get_joint_pos(joint) == pytest.approx(target, abs=2e-3), (base, joint)
    assert math.dist(tip.position, before) > 0.02
    # The joint that carries the arm stays closed.
    assert distance(client, "sujpsm1L5", "psm1/baselink") == pytest.approx(mounted, abs=1e-4)
    client.clean_up()
    assert simulator.stop()[0] == 0
