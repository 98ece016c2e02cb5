"""Kinematics of the arms that AMBF knows, compiled: what `ambf_client.kinematics` computes, fit for every step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import _ambf_core
import numpy as np
from numpy.typing import ArrayLike, NDArray


class Arm:
    """An arm with a tool. Joints are rad and m, poses positions (m) and quaternions x y z w in the arm's base frame."""

    names: list[str]  #: of the joints
    tool: str
    lower: NDArray[np.float64]  #: limits
    upper: NDArray[np.float64]
    home: NDArray[np.float64]

    def __init__(self, name: str, tool: str = "") -> None:
        """An empty tool is the arm's default one. Raises KeyError for names that do not exist; see arm_names()."""
        self._native = _ambf_core.Arm(name, tool)
        self.names, self.tool = self._native.names, self._native.tool
        self.lower, self.upper = np.array(self._native.lower), np.array(self._native.upper)
        self.home = np.array(self._native.home)

    def forward(self, joints: ArrayLike) -> NDArray[np.float64]:
        """The pose (7,) of the tip."""
        return np.array(self._native.forward(_numbers(joints)))

    def inverse(self, pose: ArrayLike, seed: ArrayLike) -> tuple[NDArray[np.float64], str]:
        """Joints that bring the tip there, nearest to the seed, and the status (docs/kinematics.md).

        They are within limits; unless the status is "solved" or "singular", they only come near.
        """
        joints, status = self._native.inverse(_pose_numbers(pose), _numbers(seed))
        return np.array(joints), status

    def reach(
        self, pose: ArrayLike, seed: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """What an ADF model is commanded so that the tip goes there, the jaw closed: the values of to_adf() for the
        joints of inverse(), rounded to float32 as messages carry them; the arm's joints and the tip's pose there."""
        values, joints, reached = self._native.reach(_pose_numbers(pose), _numbers(seed))
        return np.array(values), np.array(joints), np.array(reached)

    def jacobian(self, joints: ArrayLike, frame: str = "spatial") -> NDArray[np.float64]:
        """(6, joints): linear, then angular velocity of the tip, along the base's ("spatial") or its axes ("body")."""
        if frame not in ("spatial", "body"):
            raise ValueError(f"frame={frame!r}: 'spatial' or 'body'")
        return np.array(self._native.jacobian(_numbers(joints), frame == "body")).reshape(6, -1)

    def to_adf(self, joints: ArrayLike, opening: float = 0.0) -> dict[str, float]:
        """Positions of an ADF model's joints by name, for joints of the arm and its jaw's opening (rad)."""
        return self._native.to_adf(_numbers(joints), float(opening))

    def from_adf(self, positions: Mapping[str, float]) -> tuple[NDArray[np.float64], float]:
        """Joints of the arm and its jaw's opening. Raises KeyError where a name is missing."""
        joints, opening = self._native.from_adf({name: float(value) for name, value in positions.items()})
        return np.array(joints), opening


def arm_names() -> list[str]:
    """Names of the arms that are known."""
    return _ambf_core.arm_names()


def _numbers(values: ArrayLike) -> Sequence[float]:
    numbers: list[float] = np.asarray(values, np.float64).ravel().tolist()
    return numbers


def _pose_numbers(pose: ArrayLike) -> Sequence[float]:
    numbers = _numbers(pose)
    if len(numbers) != 7:
        raise ValueError(f"pose={pose!r}: not a position and a quaternion")
    return numbers
