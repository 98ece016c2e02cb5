"""Rotations as quaternions (x, y, z, w), roll-pitch-yaw angles (rad) and matrices."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

Quaternion4 = tuple[float, float, float, float]
Triple = tuple[float, float, float]

_AXES = {"sxyz": (0, 1, 2), "szyx": (2, 1, 0)}


def multiply(a: Quaternion4, b: Quaternion4) -> Quaternion4:
    """The rotation b followed by a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Quaternion4:
    """Rotations about fixed axes one after the other: "sxyz" x, y, z (roll, pitch, yaw) or "szyx" z, y, x. Radians."""
    if axes not in _AXES:
        raise ValueError(f"axes must be one of {sorted(_AXES)}, not {axes!r}")
    result: Quaternion4 = (0.0, 0.0, 0.0, 1.0)
    for axis, angle in zip(_AXES[axes], (ai, aj, ak), strict=True):
        about = [0.0, 0.0, 0.0, math.cos(angle / 2.0)]
        about[axis] = math.sin(angle / 2.0)
        result = multiply((about[0], about[1], about[2], about[3]), result)
    return result


def matrix_from_quaternion(quaternion: ArrayLike) -> NDArray[np.float64]:
    """3x3 rotation matrix of a quaternion (x, y, z, w), which need not be of unit length."""
    x, y, z, w = (float(v) for v in np.asarray(quaternion, dtype=float).reshape(4))
    n = x * x + y * y + z * z + w * w
    if n == 0.0:
        return np.identity(3)
    s = 2.0 / n
    return np.array(
        [
            [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
        ]
    )


def quaternion_from_matrix(matrix: ArrayLike) -> Quaternion4:
    """Unit quaternion of the rotation in the upper left 3x3 of a matrix."""
    m = np.asarray(matrix, dtype=float)[:3, :3]
    # The largest of the four squares is never small (Shepperd's method).
    squares = [m[0, 0], m[1, 1], m[2, 2], m.trace()]
    k = int(np.argmax(squares))
    if k == 3:
        q = np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1.0 + m.trace()])
    else:
        i, j = (k + 1) % 3, (k + 2) % 3
        q = np.zeros(4)
        q[k] = 1.0 + m[k, k] - m[i, i] - m[j, j]
        q[i] = m[k, i] + m[i, k]
        q[j] = m[k, j] + m[j, k]
        q[3] = m[j, i] - m[i, j]
    q /= np.linalg.norm(q)
    return (float(q[0]), float(q[1]), float(q[2]), float(q[3]))


def rpy_from_quaternion(quaternion: ArrayLike) -> Triple:
    """Roll, pitch, yaw (rad) about the fixed axes x, y, z. At pitch +-90 degrees yaw is taken as 0."""
    m = matrix_from_quaternion(quaternion)
    cos_pitch = math.hypot(m[0, 0], m[1, 0])
    if cos_pitch > 1e-12:
        return math.atan2(m[2, 1], m[2, 2]), math.atan2(-m[2, 0], cos_pitch), math.atan2(m[1, 0], m[0, 0])
    return math.atan2(-m[1, 2], m[1, 1]), math.atan2(-m[2, 0], cos_pitch), 0.0
