"""Rotations agree with each other and with their definitions."""

import math

import numpy as np
import pytest
from ambf_client import rotations

ANGLES = [(0.0, 0.0, 0.0), (0.3, -0.7, 2.9), (-3.0, 1.2, -0.1), (0.4, math.pi / 2, 0.0), (-1.0, -math.pi / 2, 0.0)]


def about(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    m = np.identity(3)
    m[i, i] = m[j, j] = c
    m[i, j], m[j, i] = -s, s
    return m


@pytest.mark.parametrize("angles", ANGLES)
def test_euler_angles_are_rotations_about_fixed_axes(angles):
    a, b, c = angles
    sxyz = rotations.matrix_from_quaternion(rotations.quaternion_from_euler(a, b, c))
    assert np.allclose(sxyz, about(2, c) @ about(1, b) @ about(0, a))
    szyx = rotations.matrix_from_quaternion(rotations.quaternion_from_euler(a, b, c, "szyx"))
    assert np.allclose(szyx, about(0, c) @ about(1, b) @ about(2, a))


@pytest.mark.parametrize("angles", ANGLES)
def test_there_and_back(angles):
    quaternion = rotations.quaternion_from_euler(*angles)
    again = rotations.quaternion_from_euler(*rotations.rpy_from_quaternion(quaternion))
    assert abs(np.dot(quaternion, again)) == pytest.approx(1.0)
    assert rotations.rpy_from_quaternion(quaternion) == pytest.approx(angles, abs=1e-6)
    from_matrix = rotations.quaternion_from_matrix(rotations.matrix_from_quaternion(quaternion))
    assert abs(np.dot(quaternion, from_matrix)) == pytest.approx(1.0)


def test_half_turns_about_every_axis():
    for axis in range(3):
        matrix = about(axis, math.pi)
        quaternion = rotations.quaternion_from_matrix(matrix)
        assert np.allclose(rotations.matrix_from_quaternion(quaternion), matrix)


def test_unknown_axes_are_refused():
    with pytest.raises(ValueError, match="sxyz"):
        rotations.quaternion_from_euler(0.0, 0.0, 0.0, "rzyz")
