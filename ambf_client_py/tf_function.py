"""Rotations as AMBF 3.0 names them: quaternions (x, y, z, w), angles in radians."""

from __future__ import annotations

from typing import Any

import numpy as np
from ambf_client import rotations
from numpy.typing import ArrayLike, NDArray

__all__ = ["euler_from_quaternion", "quaternion_from_euler"]

# Rotations about moving axes are those about fixed ones in the opposite order.
_REVERSED = {"rxyz": "szyx", "rzyx": "sxyz"}
_AXES = ("sxyz", "szyx", *_REVERSED)


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> NDArray[np.float64]:
    """The quaternion of three rotations one after the other, about fixed (s) or moving (r) axes of these names."""
    if _known(axes) in _REVERSED:
        ai, ak = ak, ai
    return np.array(rotations.quaternion_from_euler(ai, aj, ak, _REVERSED.get(axes, axes)))


def euler_from_quaternion(quaternion: ArrayLike, axes: str = "sxyz") -> tuple[float, float, float]:
    """The three angles; see quaternion_from_euler."""
    if _REVERSED.get(_known(axes), axes) == "sxyz":
        ai, aj, ak = rotations.rpy_from_quaternion(quaternion)
    else:  # z, y, x: those of the inverse rotation about x, y, z, in the opposite direction
        x, y, z, w = (float(v) for v in np.asarray(quaternion, dtype=float).reshape(4))
        ak, aj, ai = (-angle for angle in rotations.rpy_from_quaternion((-x, -y, -z, w)))
    return (ak, aj, ai) if axes in _REVERSED else (ai, aj, ak)


def _known(axes: Any) -> Any:
    if axes not in _AXES:
        raise ValueError(f"axes must be one of {', '.join(sorted(_AXES))}, not {axes!r}")
    return axes
