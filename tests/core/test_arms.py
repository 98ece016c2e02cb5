"""ambf_core.Arm computes what ambf_client.kinematics does."""

import numpy as np
import pytest
from ambf_core import Arm, arm_names

kinematics = pytest.importorskip("ambf_client.kinematics")


def pose_matrix(pose):
    x, y, z, w = pose[3:]
    out = np.eye(4)
    out[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    out[:3, 3] = pose[:3]
    return out


@pytest.mark.parametrize(("name", "tool"), [("PSM", ""), ("PSM", "PROGRASP_FORCEPS:400093"), ("ECM", ""), ("MTMR", "")])
def test_both_languages_agree(name, tool):
    here, there = Arm(name, tool), kinematics.load_arm(name, tool or None)
    assert here.names == there.names and here.tool == there.tool
    assert (here.lower == there.lower).all() and (here.upper == there.upper).all() and (here.home == there.home).all()
    random = np.random.default_rng(1)
    for joints in random.uniform(0.8 * there.lower, 0.8 * there.upper, (5, len(there.lower))):
        pose = here.forward(joints)
        assert pose_matrix(pose) == pytest.approx(there.forward(joints), abs=1e-12)
        found, status = here.inverse(pose, joints)
        assert status == "solved" and found == pytest.approx(joints, abs=1e-7)
        for frame in ("spatial", "body"):
            assert here.jacobian(joints, frame) == pytest.approx(there.jacobian(joints, frame), abs=1e-12)
        if there.adf_joints:
            positions = here.to_adf(joints, 0.2)
            assert positions == pytest.approx(there.to_adf(joints, 0.2), abs=1e-14)
            again, opening = here.from_adf(positions)
            assert again == pytest.approx(joints, abs=1e-12)
            assert opening == pytest.approx(0.2 if there.adf_jaw else 0.0, abs=1e-12)


@pytest.mark.parametrize("name", ["PSM", "ECM"])
def test_reach_is_its_parts_to_the_bit(name):
    arm = Arm(name)
    names = list(arm.to_adf(arm.home))
    random = np.random.default_rng(2)
    for joints in random.uniform(0.8 * arm.lower, 0.8 * arm.upper, (20, len(arm.lower))):
        pose = arm.forward(joints)
        values, meant, reached = arm.reach(pose, arm.home)
        wanted = np.array(list(arm.to_adf(arm.inverse(pose, arm.home)[0]).values()), np.float32)
        assert (values == wanted).all()
        assert (meant == arm.from_adf(dict(zip(names, wanted, strict=True)))[0]).all()
        assert (reached == arm.forward(meant)).all()


def test_names_and_bad_input():
    assert arm_names() == kinematics.arm_names()
    for wrong in (("HAND", ""), ("PSM", "SPOON")):
        with pytest.raises(KeyError, match=wrong[1] or wrong[0]):
            Arm(*wrong)
    arm = Arm("PSM")
    for joints in (arm.home[:5], np.full(6, np.nan)):
        with pytest.raises(ValueError, match="6 joints"):
            arm.forward(joints)
    for by_pose in (arm.inverse, arm.reach):
        with pytest.raises(ValueError, match="quaternion"):
            by_pose([0, 0, 0.1], arm.home)
    with pytest.raises(ValueError, match="frame"):
        arm.jacobian(arm.home, "tool")
    with pytest.raises(KeyError, match="not all"):
        arm.from_adf({"base link-yaw link": 0.0})
    assert arm.inverse([1, 0, 0, 0, 0, 0, 1], arm.home)[1] == "out_of_limits"
