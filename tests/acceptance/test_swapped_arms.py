"""A program for the original's arms of the dVRK moves ours the same way: same handles, names, indices, tips."""

import numpy as np
from ambf_client import Client
from harness import ROOT, eventually

ROBOTS = ROOT / "ambf_models/descriptions/multi-bodies/robots"
PSM = {"baselink-yawlink": 0.3, "yawlink-pitchbacklink": 0.3, "pitchendlink-maininsertionlink": 0.12}
ECM = {"baselink-yawlink": -0.3, "yawlink-pitchbacklink": 0.3, "pitchendlink-maininsertionlink": 0.1}
MTM = {
    "TopPanel-OutPitchShoulder": 0.3,
    "OutPitchShoulder-ArmParallel": 0.3,
    "ArmParallel-BottomArm": -0.2,
    "BottomArm-WristPlatform": 0.5,
}
# Arm: (our file, the original's, base, tip's body, targets in rad or m)
ARMS = {
    "PSM": ("psm", "blender-psm", "psm/baselink", "psm/toolgripper1link", PSM),
    "ECM": ("ecm", "blender-ecm", "ecm/baselink", "ecm/toollink", ECM),
    "MTM": ("mtmr", "blender-mtm", "mtm/TopPanel", "mtm/WristRoll", MTM),
}


def moved_by_program(base_name, tip_name, targets):
    """What a program of AMBF 2.0 does: (joint names, positions of the commanded joints, place of the tip)."""
    client = Client()
    client.connect()
    base, tip = client.get_obj_handle(base_name), client.get_obj_handle(tip_name)
    eventually(base.get_joint_names, 5.0, "the names of the joints")
    world = client.get_world_handle()
    for share in np.linspace(0.0, 1.0, 40):
        for joint, target in targets.items():
            base.set_joint_pos(joint, share * target)
        world.step(50)
    world.step(1000)
    now = world.get_sim_step()
    assert tip.wait_for_sim_step(now, 5.0) and base.wait_for_sim_step(now, 5.0)
    place = tip.get_pos()
    answer = base.get_joint_names(), [base.get_joint_pos(joint) for joint in targets], (place.x, place.y, place.z)
    client.clean_up()
    return answer


def test_programs_for_the_originals_arms_move_ours(master, start, ros, compat):
    def run(file, base, tip, wanted, **more):
        simulator = start("--launch_file", compat / "launch.yaml", "-a", file, master_uri=master.uri, **more)
        topics = {f"/ambf/env/{name}/State" for name in (base, tip)}
        eventually(lambda: topics <= set(master.published()), 20.0, "the arm's topics")
        moved = moved_by_program(base, tip, wanted)
        assert simulator.stop()[0] == 0
        return moved

    for arm, (own, original, base, tip, targets) in ARMS.items():
        file = compat / f"multi-bodies/robots/{original}.yaml"
        their_names, their_joints, their_tip = run(file, base, tip, targets, allowed=[rf"{original}\.yaml"])
        # How far the original's pitch gets depends on how its rounded loops jam: ours is sent to where that is.
        reached = dict(zip(targets, their_joints, strict=True))
        our_names, our_joints, our_tip = run(ROBOTS / f"{own}.yaml", base, tip, reached)
        assert our_names[: len(their_names)] == their_names, f"{arm}: joints that are ours come last"
        assert np.abs(np.subtract(our_joints, their_joints)).max() < 1e-3, arm
        assert np.linalg.norm(np.subtract(our_tip, their_tip)) < 0.01, (arm, our_tip, their_tip, their_joints)
