"""C++ and Python compute the same: FK, Jacobians and IK of every arm and tool, 1e-12."""

import subprocess

import numpy as np
import pytest
from harness import ROOT

pytest.importorskip("rospy")
from ambf_client import kinematics as kin  # noqa: E402
from ambf_client.rotations import matrix_from_quaternion, quaternion_from_matrix  # noqa: E402
from joint_samples import random_joints  # noqa: E402

VALUES = ROOT / "build/bin/ambf_kinematics_values"
pytestmark = pytest.mark.skipif(not VALUES.exists(), reason=f"no {VALUES}")
ALL = [(name, tool) for name in kin.arm_names() for tool in kin.tool_names(name) or ["-"]]


def ask(lines):
    """What the C++ program answers, one list of words a line."""
    text = "\n".join(" ".join([*words, *(repr(float(v)) for v in values)]) for words, values in lines)
    done = subprocess.run([VALUES], input=text, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return [line.split() for line in done.stdout.splitlines()]


def matrix(position, quaternion):
    pose = np.identity(4)
    pose[:3, :3], pose[:3, 3] = matrix_from_quaternion(quaternion), position
    return pose


def test_forward_and_jacobians():
    lines, wanted = [], []
    for name, tool in ALL:
        arm = kin.load_arm(name, tool.strip("-"))
        for q in random_joints(arm, 20):
            lines += [([what, name, tool], q) for what in ("forward", "spatial", "body")]
            wanted += [arm.forward(q), arm.jacobian(q), arm.jacobian(q, "body")]
    for (words, _), answer, value in zip(lines, ask(lines), wanted, strict=True):
        got = np.array(answer, dtype=float)
        got = matrix(got[:3], got[3:]) if words[0] == "forward" else got.reshape(value.shape)
        assert np.abs(got - value).max() < 1e-12, words


def test_inverse_in_and_out_of_reach():
    lines, wanted = [], []
    for name, tool in ALL:
        arm = kin.load_arm(name, tool.strip("-"))
        count = (2 if name.startswith("SUJ") else 10) if arm.solver == "numeric" else 30
        q = random_joints(arm, count)
        poses = arm.forward(q)
        poses[: 0 if name.startswith("SUJ") else 3, :3, 3] *= 3.0  # numeric searches for nothing take seconds
        seeds = q + 0.01 * (arm.home - q)
        for pose, seed in zip(poses, seeds, strict=True):
            quaternion = quaternion_from_matrix(pose)
            lines.append((["inverse", name, tool], [*pose[:3, 3], *quaternion, *seed]))
            wanted.append((arm, arm.inverse(matrix(pose[:3, 3], quaternion), seed)))
    for (words, _), answer, (arm, python) in zip(lines, ask(lines), wanted, strict=True):
        assert answer[0] == python.status and int(answer[1]) == python.joint, (words, answer, python)
        got = np.array(answer[2:], dtype=float)
        # What a numeric search finds where there is no solution depends on rounding.
        close = 1e-12 if arm.solver != "numeric" else 1e-9 if python.reached else 1e-2
        assert np.abs(got[3:] - python.joints).max() < close, (words, answer, python)
        assert np.abs(got[:3] - [python.excess, python.distance, python.angle]).max() < close
