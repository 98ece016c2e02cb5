"""Accuracy and speed of kinematics: 10^5 joint vectors of each arm over its whole range, 10^4 poses outside of it.

One joint in five is at a limit; a tenth of the vectors is 1e-3 (m or rad) from a singular pose. Ends with 1 when
FK(IK(T)) misses T by 1e-9, Jacobians miss differences by 1e-6, C++ and Python differ by 1e-12, a refusal names the
wrong reason, or anything is not finite.
"""

import argparse
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import support

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "kinematics"))
from ambf_client import kinematics as kin  # noqa: E402
from ambf_client.kinematics._chain import rotation_vector  # noqa: E402
from ambf_client.rotations import matrix_from_quaternion, quaternion_from_matrix  # noqa: E402
from joint_samples import random_joints  # noqa: E402

VALUES = support.ROOT / "build/bin/ambf_kinematics_values"
ARMS = [
    *(("PSM", tool) for tool in ("LARGE_NEEDLE_DRIVER:400006", "PROGRASP_FORCEPS:400093")),
    *(("ECM", "STRAIGHT"), ("MTML", ""), ("MTMR", "")),
    *(("LBR_MED_14", ""), ("LBR_IIWA_14", ""), ("LWR_4", "")),
    *((name, tool) for name in ("RAVEN_LEFT", "RAVEN_RIGHT") for tool in ("RAVEN_GRASPER", "LARGE_NEEDLE_DRIVER")),
]
CPP_SHARE = 10  # of the vectors that C++ computes as well: each is a line of text


def near_singular(arm, q):
    """Moves a tenth of the vectors to 1e-3 from where joints become free, and those that are nearer."""
    rng = np.random.default_rng(5)
    rows = np.arange(0, len(q), 10)
    side = np.where(rng.random(len(rows)) < 0.5, -1e-3, 1e-3)
    if arm.solver == "spherical_shoulder_and_wrist":
        for joint in (1, 3, 5):
            q[rows[joint // 2 :: 3], joint] = side[joint // 2 :: 3]
            q[np.abs(q[:, joint]) < 1e-3, joint] = 1e-3
    elif arm.solver == "remote_center" and len(arm.lower) == 6:
        center = -arm.rows[2].d - arm.rows[3].d
        q[rows, 2] = np.clip(center + side, arm.lower[2], arm.upper[2])
        half = rows[::2]  # axis 6 through the remote centre
        q[half, 2] = np.clip(center - arm.rows[5].a + side[::2], arm.lower[2], arm.upper[2])
        q[half, 4] = 0.0
    return q


def jacobian_error(arm, q):
    worst, h = 0.0, 1e-6
    for j in range(len(arm.lower)):
        step = h * np.eye(len(arm.lower))[j]
        a, b = arm.forward(q - step), arm.forward(q + step)
        linear, angular = (b - a)[:, :3, 3] / (2 * h), rotation_vector(a[:, :3, :3], b[:, :3, :3]) / (2 * h)
        worst = max(worst, np.abs(np.concatenate([linear, angular], -1) - arm.jacobian(q)[:, :, j]).max())
    return worst


def languages_differ_by(arm, q):
    """C++ answers forward and inverse of some vectors: largest differences of poses (matrices) and joints."""
    head = f"{arm.name} {arm.tool or '-'} "
    poses = arm.forward(q)
    words = [[*p[:3, 3], *quaternion_from_matrix(p)] for p in poses]
    targets = np.array([matrix_from_quaternion(w[3:]) for w in words])
    poses[:, :3, :3] = targets
    lines = ["forward " + head + " ".join(map(repr, map(float, v))) for v in q]
    lines += ["inverse " + head + " ".join(map(repr, map(float, [*w, *v]))) for w, v in zip(words, q, strict=True)]
    done = subprocess.run([VALUES], input="\n".join(lines), capture_output=True, text=True, check=True)
    answers = [line.split() for line in done.stdout.splitlines()]
    forward = np.array(answers[: len(q)], dtype=float)
    rotations = np.array([matrix_from_quaternion(v[3:]) for v in forward])
    apart = np.abs(rotations - arm.forward(q)[:, :3, :3]).max(), np.abs(forward[:, :3] - arm.forward(q)[:, :3, 3]).max()
    python = arm.inverse(poses, q)
    inverse = answers[len(q) :]
    same = [a[0] == s for a, s in zip(inverse, python.status, strict=True)]
    joints = np.array([a[5:] for a in inverse], dtype=float)
    return max(apart), np.abs(joints - python.joints).max() if all(same) else np.inf


def wrong_refusals(arm, count):
    """How many of so many poses outside get the wrong answer."""
    rng = np.random.default_rng(7)
    if arm.solver == "remote_center" and len(arm.lower) == 6:
        wrong = 0
        joints = [j for j in range(6) if arm.upper[j] - arm.lower[j] < 2 * np.pi]
        for joint in joints:
            q = arm.lower + (arm.upper - arm.lower) * (0.2 + 0.6 * rng.random((count // len(joints), 6)))
            q[:, 2] = arm.upper[2] - 0.01
            q[:, joint] = arm.upper[joint] + (0.001 + 0.05 * rng.random(len(q)))
            answer = arm.inverse(arm.forward(q))
            wrong += np.sum((answer.status != kin.OUT_OF_LIMITS) | (answer.joint != joint))
        return int(wrong)
    q = random_joints(arm, count, seed=9)
    pose = arm.forward(q)
    beyond = 0.001 + rng.random(count)
    if arm.solver == "remote_center":  # a shaft that does not point away from the remote centre
        tilt = kin.load_arm("ECM", "UP").tip
        answer = arm.inverse(pose @ tilt, q)
        good = (answer.distance < 1e-9) & (np.abs(answer.angle - np.radians(30.0)) < 1e-9)
        return int(np.sum((answer.status != kin.UNREACHABLE) | ~good))
    if arm.solver == "gimbal":
        shoulder, reach = np.zeros(3), arm.rows[1].a + np.hypot(arm.rows[2].a, arm.rows[3].d)
        wrist = pose[:, :3, 3]
    else:
        shoulder, reach = np.array([0.0, 0.0, arm.rows[0].d]), arm.rows[2].d + arm.rows[4].d
        wrist = pose[:, :3, 3] - arm.rows[6].d * pose[:, :3, 2]
    away = (wrist - shoulder) / np.linalg.norm(wrist - shoulder, axis=-1)[:, None]
    pose[:, :3, 3] += shoulder + away * (reach + beyond)[:, None] - wrist
    answer = arm.inverse(pose, q)
    # Where limits let the orientation be held, no nearer position exists.
    too_near = (answer.distance < beyond - 1e-9) & (answer.angle < 1e-9)
    return int(np.sum((answer.status != kin.UNREACHABLE) | too_near))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--vectors", type=int, default=100_000)
    parser.add_argument("--outside", type=int, default=10_000)
    given = parser.parse_args()
    print(f"{'arm and tool':32} FK(IK(T)) J        FK C++   IK C++   wrong  IK per s (Python)")
    failed = False
    for name, tool in ARMS:
        arm = kin.load_arm(name, tool)
        q = near_singular(arm, random_joints(arm, given.vectors))
        pose = arm.forward(q)
        begin = time.perf_counter()
        answer = arm.inverse(pose, q if len(arm.lower) == 7 else None)
        rate = len(q) / (time.perf_counter() - begin)
        missing = np.max(kin.pose_difference(arm.forward(answer.joints), pose))
        jacobian = jacobian_error(arm, q[::10])
        forward, inverse = languages_differ_by(arm, q[:: max(1, CPP_SHARE)])
        wrong = int(np.sum(~answer.reached)) + wrong_refusals(arm, given.outside)
        finite = all(np.all(np.isfinite(v)) for v in (answer.joints, answer.distance, answer.angle))
        good = missing < 1e-9 and jacobian < 1e-6 and forward < 1e-12 and inverse < 1e-12 and wrong == 0 and finite
        failed |= not good
        print(
            f"{(name + ' ' + tool)[:32]:32} {missing:.1e}  {jacobian:.1e}  {forward:.1e}  {inverse:.1e}  {wrong:5d}  "
            f"{rate:8.0f}{'' if good else '   FAILED'}"
        )
    sys.exit(failed)


if __name__ == "__main__":
    main()
