"""Known arms in Python: published poses, inverse of forward, refusals, singular poses, Jacobians."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from harness import COMPAT

pytest.importorskip("rospy")
from ambf_client import kinematics as kin  # noqa: E402
from ambf_client.kinematics._chain import rotation, rotation_vector  # noqa: E402
from ambf_client.rotations import matrix_from_quaternion  # noqa: E402
from joint_samples import random_joints  # noqa: E402

POSES = yaml.safe_load((Path(__file__).parent / "check_poses.yaml").read_text())
# One tool for each set of numbers.
ARMS = [
    *(("PSM", tool) for tool in ("LARGE_NEEDLE_DRIVER:400006", "PROGRASP_FORCEPS:400093", "MARYLAND_BIPOLAR")),
    *(("ECM", tool) for tool in ("STRAIGHT", "UP", "DOWN")),
    *((name, None) for name in ("MTML", "MTMR", "LBR_MED_14", "LBR_IIWA_14", "LWR_4")),
    *((name, tool) for name in ("RAVEN_LEFT", "RAVEN_RIGHT") for tool in ("RAVEN_GRASPER", "LARGE_NEEDLE_DRIVER")),
]
REDUNDANT = ("gimbal", "spherical_shoulder_and_wrist")


@pytest.mark.parametrize("given", POSES, ids=lambda g: f"{g['arm']}-{g['joints']}")
def test_published_poses(given):
    arm = kin.load_arm(given["arm"], given["tool"] or None)
    pose = arm.forward(given["joints"])
    assert np.abs(pose[:3, 3] - given["position"]).max() < 1e-6
    wanted = np.identity(4)
    wanted[:3, :3] = matrix_from_quaternion(given["quaternion"])
    wanted[:3, 3] = pose[:3, 3]
    assert kin.pose_difference(pose, wanted)[1] < 2e-6


@pytest.mark.parametrize(("name", "tool"), ARMS)
def test_inverse_leads_back_over_the_whole_range(name, tool):
    arm = kin.load_arm(name, tool)
    q = random_joints(arm, 1000)
    pose = arm.forward(q)
    answer = arm.inverse(pose, q if arm.solver in REDUNDANT else None)
    assert set(answer.status) == {"solved"}
    assert np.maximum(*kin.pose_difference(arm.forward(answer.joints), pose)).max() < 1e-9
    assert np.all((answer.joints >= arm.lower) & (answer.joints <= arm.upper))
    assert np.abs(arm.inverse(pose, q).joints - q).max() < 1e-6


@pytest.mark.parametrize(("name", "tool"), ARMS)
def test_jacobians_are_differences(name, tool):
    arm = kin.load_arm(name, tool)
    q, h = random_joints(arm, 50), 1e-6
    spatial, body = arm.jacobian(q), arm.jacobian(q, "body")
    to_tip = np.swapaxes(arm.forward(q)[:, :3, :3], -1, -2)
    for j in range(len(arm.lower)):
        step = h * np.eye(len(arm.lower))[j]
        before, after = arm.forward(q - step), arm.forward(q + step)
        linear = (after - before)[:, :3, 3] / (2 * h)
        angular = rotation_vector(before[:, :3, :3], after[:, :3, :3]) / (2 * h)
        assert np.abs(spatial[:, :, j] - np.concatenate([linear, angular], axis=-1)).max() < 1e-6
        in_tip = [np.einsum("nij,nj->ni", to_tip, v) for v in (linear, angular)]
        assert np.abs(body[:, :, j] - np.concatenate(in_tip, axis=-1)).max() < 1e-6


def test_wrist_behind_the_remote_centre_and_a_thousandth_from_singular():
    arm = kin.load_arm("PSM")
    wrist_at_center = 0.4318 - 0.4162
    insertions = [0.0, wrist_at_center - 1e-3, wrist_at_center + 1e-3, wrist_at_center - 0.0091 - 1e-3]
    for insertion in [*insertions, wrist_at_center - 0.0091 + 1e-3]:
        q = random_joints(arm, 200)
        q[:, 2] = insertion
        q[:100, 4] = 0.0
        pose = arm.forward(q)
        answer = arm.inverse(pose)
        assert np.all(answer.reached)
        assert np.maximum(*kin.pose_difference(arm.forward(answer.joints), pose)).max() < 1e-9


def test_tip_on_the_remote_centre_is_singular():
    arm = kin.load_arm("PSM")
    pose = np.identity(4)
    pose[:3, :3] = arm.forward(arm.home)[:3, :3]
    answer = arm.inverse(pose, [0.1, 0.1, 0.1, 0.2, 0.3, 0.4])
    assert answer.status == "singular" and answer.reached
    assert list(np.flatnonzero(answer.free)) == [5] and answer.joints[5] == pytest.approx(0.4)
    assert np.linalg.norm(arm.forward(answer.joints)[:3, 3]) < 1e-9


def test_stretched_arm_and_wrist_keep_the_seed_s_angles():
    arm = kin.load_arm("LBR_MED_14")
    for q in ([0.0] * 7, [0.3, 0.8, 0.2, 0.0, 0.4, 0.7, -0.5], [0.3, 0.8, 0.2, 1.0, 0.4, 0.0, -0.5]):
        answer = arm.inverse(arm.forward(q), q)
        assert answer.status == "singular"
        assert np.abs(answer.joints - q).max() < 1e-6


@pytest.mark.parametrize("name", ["PSM", "RAVEN_LEFT", "RAVEN_RIGHT", "ECM"])
def test_joint_beyond_its_limit_is_named(name):
    arm = kin.load_arm(name)
    rng = np.random.default_rng(3)
    for joint in range(len(arm.lower)):
        if arm.upper[joint] - arm.lower[joint] > 2 * np.pi:
            continue  # a roll that a whole turn brings back
        inside = arm.lower + (arm.upper - arm.lower) * (0.2 + 0.6 * rng.random((100, len(arm.lower))))
        inside[:, 2] = arm.upper[2] - 0.01  # far from where other branches are legal
        beyond = 0.01 + 0.05 * rng.random(100)
        inside[:, joint] = arm.upper[joint] + beyond
        answer = arm.inverse(arm.forward(inside))
        assert set(answer.status) == {"out_of_limits"} and set(answer.joint) == {joint}
        assert np.abs(answer.excess - beyond).max() < 1e-9
        assert np.all(answer.joints <= arm.upper + 1e-12) and np.all(answer.distance + answer.angle > 1e-3)


def test_what_cannot_be_reached_is_answered_with_the_nearest():
    arm = kin.load_arm("LBR_MED_14")
    q = np.array([0.3, 0.8, 0.2, 0.0, 0.4, 0.7, -0.5])
    pose = arm.forward(q)
    shoulder = np.array([0.0, 0.0, 0.3595])
    wrist = pose[:3, 3] - 0.126 * pose[:3, 2]
    pose[:3, 3] += 0.1 * (wrist - shoulder) / np.linalg.norm(wrist - shoulder)
    answer = arm.inverse(pose, q)
    assert answer.status == "unreachable" and answer.distance == pytest.approx(0.1, abs=1e-9) and answer.angle < 1e-9
    assert not answer.reached

    ecm = kin.load_arm("ECM")
    pose = ecm.forward(ecm.home)
    tilted = pose.copy()
    tilted[:3, :3] = pose[:3, :3] @ kin.load_arm("ECM", "UP").tip[:3, :3]
    answer = ecm.inverse(tilted)
    assert answer.status == "unreachable" and answer.distance < 1e-12
    assert answer.angle == pytest.approx(np.radians(30.0), abs=1e-9)

    mtm = kin.load_arm("MTMR")
    far = mtm.forward(mtm.home)
    far[:3, 3] *= 3.0
    answer = mtm.inverse(far)
    assert answer.status == "unreachable" and answer.distance > np.linalg.norm(far[:3, 3]) - 0.2794 - 0.3945


def test_roll_stays_near_the_seed_over_its_whole_range():
    arm = kin.load_arm("PSM")
    q = arm.home.copy()
    for roll in np.radians(np.concatenate([np.arange(0, 260, 5), np.arange(260, -261, -5)])):
        answer = arm.inverse(arm.forward([*q[:3], roll, 0.2, 0.1]), q)
        assert answer.status == "solved" and answer.joints[3] == pytest.approx(roll, abs=1e-9)
        q = answer.joints


def test_platform_angle_and_elbow_come_from_the_seed():
    mtm = kin.load_arm("MTMR")
    q = np.array([0.1, 0.2, 0.0, 0.5, 0.4, 0.1, 0.3])
    seed = q.copy()
    seed[3] = 0.7
    answer = mtm.inverse(mtm.forward(q), seed)
    assert answer.status == "solved" and answer.joints[3] == pytest.approx(0.7)
    # A platform that would need a yaw of the wrist beyond its limit is turned as far as needed.
    seed[3] = -1.0
    answer = mtm.inverse(mtm.forward(q), seed)
    assert answer.status == "solved" and -1.0 < answer.joints[3] < 0.5


def test_raven_has_eight_solutions():
    arm = kin.load_arm("RAVEN_LEFT")
    pose = arm.forward([0.8, 1.6, 0.45, -0.6, -0.5, 0.3])
    joints, legal = arm.solutions(pose)
    assert joints.shape == (8, 6) and legal.sum() >= 1
    assert np.maximum(*kin.pose_difference(arm.forward(joints), pose)).max() < 1e-9
    differences = np.abs(joints[:, None] - joints[None]).max(axis=-1) + np.eye(8)
    assert differences.min() > 1e-3


def test_bad_input_is_answered_and_never_nan():
    for name in set(kin.arm_names()) - {"SUJ_PSM2", "SUJ_PSM3", "SUJ_ECM"}:  # which are as SUJ_PSM1
        arm = kin.load_arm(name)
        poses = np.tile(arm.forward(arm.home), (5, 1, 1))
        poses[0, 0, 3] = np.nan
        poses[1, 2, 3] = np.inf
        poses[2, :3, :3] = 0.0
        poses[3, :3, 3] = 0.0  # the base's origin: whatever it is, it is finite
        answer = arm.inverse(poses)
        assert list(answer.status[:3]) == ["invalid"] * 3 and answer.status[4] in ("solved", "singular")
        assert np.all(np.isfinite(answer.joints)) and np.all(np.isfinite([answer.distance, answer.angle]))
        assert arm.inverse(poses[4], np.full(len(arm.lower), np.nan)).status == "invalid"
        with pytest.raises(ValueError, match="entries"):
            arm.forward([0.0])


def test_batches_of_any_shape_equal_single_answers():
    arm = kin.load_arm("PSM")
    pose = arm.forward(random_joints(arm, 6)).reshape(2, 3, 4, 4)
    answer = arm.inverse(pose)
    assert answer.joints.shape == (2, 3, 6) and answer.status.shape == (2, 3)
    for one, alone in zip(answer, pose.reshape(6, 4, 4), strict=True):
        assert np.array_equal(one.joints, arm.inverse(alone).joints)


def test_snake_tool_and_any_chain_are_solved_numerically():
    arm = kin.load_arm("PSM", "NEEDLE_DRIVER_5MM:400117")
    q = np.array([0.2, -0.1, 0.15, 0.4, 0.3, -0.5])
    answer = arm.inverse(arm.forward(q))
    assert answer.status == "solved" and np.abs(answer.joints - q).max() < 1e-8
    far = arm.forward(q)
    far[:3, 3] *= 5.0
    answer = arm.inverse(far)
    assert not answer.reached and answer.distance > 0.1
    beyond = arm.forward([0.2, -0.1, 0.26, 0.4, 0.3, -0.5])
    answer = arm.inverse(beyond)
    assert answer.status == "out_of_limits" and answer.joint == 2 and answer.excess == pytest.approx(0.02, abs=1e-8)


@pytest.mark.parametrize("ratio", [0.5, 1.5, 2.0, 1.0 / 3.0, 0.618])
def test_answers_reach_the_pose_whatever_the_ratios(ratio):
    """A joint that moves its axes by half: whole turns of the joint are no whole turns of the axes."""
    before = [np.identity(4), rotation(0, 1.2), rotation(1, 0.9)]
    before[1][:3, 3], before[2][:3, 3] = (0.3, 0.0, 0.0), (0.0, 0.2, 0.0)
    chain = kin.Chain([kin.Step(pose, i, ratio=ratio) for i, pose in enumerate(before)], [-25.0] * 3, [25.0] * 3)
    q = np.array([0.4, -0.5, 0.3])
    away = np.array([0.0, 6.0, -12.0, 18.0])[:, None] * [1.0, 0.0, -1.0]
    pose = np.broadcast_to(chain.forward(q), (4, 4, 4))
    answer = chain.inverse(pose, q + away)
    assert np.all(answer.reached)
    assert np.maximum(*kin.pose_difference(chain.forward(answer.joints), pose)).max() < 1e-9


def test_joints_of_adf_models_there_and_back():
    for name in kin.arm_names():
        arm = kin.load_arm(name)
        if not arm.adf_joints:
            continue
        opening = 0.5 if arm.adf_jaw else 0.0
        q = random_joints(arm, 1)[0]
        again, jaw = arm.from_adf(arm.to_adf(q, opening))
        assert again == pytest.approx(q) and jaw == pytest.approx(opening)


# Model, root link and tip of the chain.
MODELS = {
    "PSM": ("blender-psm.yaml", "base link", "tool gripper1 link"),
    "ECM": ("blender-ecm.yaml", "base link", "tool link"),
    "MTMR": ("blender-mtm.yaml", "Top Panel", "WristRoll"),
    "LBR_MED_14": ("blender-kuka-lbr-med.yaml", "base", "Link7"),
}


@pytest.mark.skipif(not COMPAT.is_dir(), reason=f"no {COMPAT}")
@pytest.mark.parametrize("name", MODELS)
def test_signs_and_offsets_of_adf_joints_are_those_of_the_original_s_models(name):
    file, root, tip = MODELS[name]
    arm = kin.load_arm(name)
    chain = kin.chain_of_adf(COMPAT / "ambf_models/descriptions/multi-bodies/robots" / file, root, tip)

    def turned(q):
        # The pitch of a parallelogram: its crank, the bottom link and the end link turn by q2, -q2, q2.
        loop = {"pitch back link-pitch bottom link": -q[1], "pitch bottom link-pitch end link": q[1]}
        positions = arm.to_adf(q, 0.0) | loop | {"yaw link-pitch back link": q[1]}
        return chain.forward([positions[joint] for joint in chain.names])

    home = np.zeros(len(arm.lower))
    for q in 0.5 * random_joints(arm, 50):
        model, table = turned(q) @ np.linalg.inv(turned(home)), arm.forward(q) @ np.linalg.inv(arm.forward(home))
        # Their axes are off by up to 1 degree each.
        assert np.linalg.norm(rotation_vector(model[:3, :3], table[:3, :3])) < np.radians(2.0)


def test_names_that_do_not_exist_are_answered_with_those_that_do():
    with pytest.raises(KeyError, match="PSM"):
        kin.load_arm("PSM9")
    with pytest.raises(KeyError, match="PROGRASP"):
        kin.load_arm("PSM", "SPOON")
