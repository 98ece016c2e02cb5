"""Arms of arms.yaml: a chain with its closed-form inverse, limits, tools, couplings and its joints in ADF models."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _redundant, _remote_center
from ._answer import OUT_OF_LIMITS, Answer, Candidates, choose, wrapped
from ._chain import Array
from ._inverse import Chain

_SEARCH_STEP = np.radians(5.0)


@dataclass(frozen=True)
class Row:
    """A row of the Denavit-Hartenberg table (m, rad); the joint's motion is added to theta, or d if prismatic."""

    joint: int
    alpha: float
    a: float
    d: float
    theta: float
    ratio: float = 1.0


@dataclass(frozen=True)
class AdfJoint:
    """How a joint of an ADF model moves: DH position = sign x ADF position + offset."""

    name: str
    sign: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class JawHalf:
    """A joint of an ADF model that is half of a jaw: ADF position = wrist x the arm's last joint + opening / 2."""

    name: str
    wrist: float


@dataclass(frozen=True)
class Jaw:
    """The jaw beside the arm's joints: its opening (rad)."""

    name: str
    lower: float
    upper: float
    max_effort: float


@dataclass
class Arm(Chain):
    """An arm with one of its tools. Joint vectors are (..., n), poses (..., 4, 4) in the arm's base frame."""

    name: str = ""
    tool: str = ""
    solver: str = "numeric"
    rows: list[Row] = field(default_factory=list)
    max_effort: Array = field(default_factory=lambda: np.zeros(0))  # Nm, N
    jaw: Jaw | None = None
    coupling: Array | None = None  # joints (roll.., jaw; all of an MTM) = coupling @ disks or motors
    adf_joints: list[AdfJoint] = field(default_factory=list)
    adf_jaw: list[JawHalf] = field(default_factory=list)

    def solutions(self, pose: ArrayLike, seed: ArrayLike | None = None) -> tuple[Array, NDArray[np.bool_]]:
        """All closed-form solutions (..., C, n), whole turns as near to the seed as limits allow, and which are legal.

        Raven and PSM have 8, ECM 4; MTM and KUKA 8 for the seed's platform angle or elbow. A chain without closed form
        raises ValueError.
        """
        if self.solver == "numeric":
            raise ValueError(f"{self.name} with {self.tool} has no closed-form solutions")
        target, start, shape, bad = self._batch(pose, seed)
        found = self._candidates(target, start, 0.0)
        joints = wrapped(self, found.joints, start[:, None, :])
        inside = np.all((joints >= self.lower - 1e-10) & (joints <= self.upper + 1e-10), axis=-1)
        legal = inside & ~found.missed & ~bad[:, None]
        return joints.reshape(*shape, *joints.shape[1:]), legal.reshape(*shape, -1)

    def _candidates(self, target: Array, seed: Array, offset: float) -> Candidates:
        if self.solver == "remote_center":
            wrist = len(self.lower) == 6
            solve = _remote_center.with_wrist if wrist else _remote_center.without_wrist
            return solve(self, target, seed)
        redundant = _redundant.gimbal if self.solver == "gimbal" else _redundant.spherical_shoulder_and_wrist
        return redundant(self, target, seed, offset)

    def _closest(self, target: Array, seed: Array) -> Answer:
        if self.solver == "numeric":
            return super()._closest(target, seed)
        answer = choose(self, target, seed, self._candidates(target, seed, 0.0))
        if self.solver == "remote_center":
            return answer
        reach = np.radians(300.0) if self.solver == "gimbal" else np.pi
        for k in range(1, int(reach / _SEARCH_STEP + 0.5) + 1):
            for offset in (k * _SEARCH_STEP, -k * _SEARCH_STEP):
                rows = np.flatnonzero(answer.status == OUT_OF_LIMITS)
                if not len(rows):
                    return answer
                other = choose(self, target[rows], seed[rows], self._candidates(target[rows], seed[rows], offset))
                self._replace(answer, rows, other)
        return answer

    @staticmethod
    def _replace(answer: Answer, rows: NDArray[np.int64], other: Answer) -> None:
        """Takes over what of `other` is within limits."""
        legal = other.reached
        for name in ("status", "joints", "joint", "excess", "distance", "angle", "free"):
            getattr(answer, name)[rows[legal]] = getattr(other, name)[legal]

    def from_adf(self, positions: Mapping[str, float]) -> tuple[Array, float]:
        """Joint vector and jaw opening (rad; 0 without jaw) of an ADF model's joint positions by name."""
        q = [j.sign * positions[j.name] + j.offset for j in self.adf_joints]
        halves = [positions[half.name] for half in self.adf_jaw]
        if halves:
            q.append(float(np.mean([half.wrist * p for half, p in zip(self.adf_jaw, halves, strict=True)])))
        return np.array(q), float(sum(halves))

    def to_adf(self, joints: ArrayLike, opening: float = 0.0) -> dict[str, float]:
        """Positions of an ADF model's joints by name for one joint vector and jaw opening (rad)."""
        q = self._checked(joints)
        made = {j.name: float(j.sign * (q[i] - j.offset)) for i, j in enumerate(self.adf_joints)}
        for half in self.adf_jaw:
            made[half.name] = float(half.wrist * q[-1] + 0.5 * opening)
        return made
