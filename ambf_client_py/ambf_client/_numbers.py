"""Checked numbers from whatever users have at hand: scalars, lists, arrays, ROS messages."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .rotations import Quaternion4, Triple, quaternion_from_euler, quaternion_from_matrix

_MOST = 1e9  # also fits into the messages' single precision


def number(value: Any, what: str) -> float:
    """A finite float, none of astronomy; the simulator would refuse the whole command otherwise."""
    result = float(value)
    if not math.isfinite(result):
        raise ValueError(f"{what} must be a finite number, not {value}")
    if abs(result) > _MOST:
        raise ValueError(f"{what} must be between -{_MOST:g} and {_MOST:g}, not {value}")
    return result


def triple(x: Any, y: Any, z: Any, what: str) -> Triple:
    """Three numbers, given one by one or as one sequence, array or message with x, y and z."""
    if y is None and z is None:
        x, y, z = (x.x, x.y, x.z) if hasattr(x, "x") else sequence(x, 3, what)
    elif y is None or z is None:
        raise TypeError(f"{what} takes three numbers or one sequence of three")
    return number(x, what), number(y, what), number(z, what)


def quaternion(value: Any, what: str) -> Quaternion4:
    """A unit quaternion x, y, z, w from a sequence or a message; it is normalised."""
    parts = (value.x, value.y, value.z, value.w) if hasattr(value, "w") else sequence(value, 4, what)
    x, y, z, w = (number(part, what) for part in parts)
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    if norm < 1e-6:
        raise ValueError(f"{what} must not be a quaternion of zeros")
    return x / norm, y / norm, z / norm, w / norm


def pose(value: Any, what: str) -> tuple[Triple, Quaternion4]:
    """Position and orientation from a Pose message, 7 numbers (x, y, z, quaternion), 6 (x, y, z, r, p, y) or a 4x4."""
    if hasattr(value, "orientation"):
        return triple(value.position, None, None, what), quaternion(value.orientation, what)
    array = np.asarray(value, dtype=float)
    if not np.isfinite(array).all():
        raise ValueError(f"{what} must be of finite numbers, not {value}")
    if array.shape == (4, 4):
        return (float(array[0, 3]), float(array[1, 3]), float(array[2, 3])), quaternion_from_matrix(array)
    if array.shape == (7,):
        return triple(array[:3], None, None, what), quaternion(array[3:], what)
    if array.shape == (6,):
        r, p, y = (float(angle) for angle in array[3:])
        return triple(array[:3], None, None, what), quaternion_from_euler(r, p, y)
    raise ValueError(f"{what} must be a Pose, 6 or 7 numbers or a 4x4 matrix, not of shape {array.shape}")


def sequence(value: Any, length: int, what: str) -> list[Any]:
    """So many numbers, from a list or an array of any shape."""
    values = list(np.asarray(value, dtype=float).ravel())
    if len(values) != length:
        raise ValueError(f"{what} takes {length} numbers, not {len(values)}")
    return values
