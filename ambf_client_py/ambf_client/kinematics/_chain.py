"""Axes of open chains: forward kinematics and Jacobians of batches of joint vectors."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def rotation(axis: int, angle: float | Array) -> Array:
    """4x4 rotations by angles (rad, any shape) about the axis x (0), y (1) or z (2)."""
    c, s = np.cos(angle), np.sin(angle)
    made = np.zeros((*np.shape(angle), 4, 4))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    made[..., axis, axis] = made[..., 3, 3] = 1.0
    made[..., i, i] = made[..., j, j] = c
    made[..., i, j] = -s
    made[..., j, i] = s
    return made


def translation(x: float, y: float, z: float) -> Array:
    """4x4 translation (m)."""
    made = np.identity(4)
    made[:3, 3] = x, y, z
    return made


def inverse_pose(pose: Array) -> Array:
    """Inverse of rigid 4x4 transforms (any batch)."""
    made = np.zeros_like(pose)
    made[..., :3, :3] = np.swapaxes(pose[..., :3, :3], -1, -2)
    made[..., :3, 3] = -np.einsum("...ij,...j->...i", made[..., :3, :3], pose[..., :3, 3])
    made[..., 3, 3] = 1.0
    return made


def pose_difference(a: Array, b: Array) -> tuple[Array, Array]:
    """Distance (m) and angle (rad) between rigid 4x4 transforms (any batch)."""
    distance = np.linalg.norm(a[..., :3, 3] - b[..., :3, 3], axis=-1)
    return distance, np.linalg.norm(rotation_vector(a[..., :3, :3], b[..., :3, :3]), axis=-1)


def rotation_vector(a: Array, b: Array) -> Array:
    """Rotation from a to b as a vector (rad) in the frame that both are expressed in; exact for small angles."""
    r = b @ np.swapaxes(a, -1, -2)
    twice_sin = np.stack([r[..., 2, 1] - r[..., 1, 2], r[..., 0, 2] - r[..., 2, 0], r[..., 1, 0] - r[..., 0, 1]], -1)
    norm: Array = np.linalg.norm(twice_sin, axis=-1)
    angle = np.arctan2(norm, np.trace(r, axis1=-2, axis2=-1) - 1.0)
    small = norm < 1e-9
    made: Array = twice_sin * np.where(small, 0.5, angle / np.where(small, 1.0, norm))[..., None]
    half_turn = small & (angle > 1.0)
    if np.any(half_turn):  # a column of r + 1 is along the axis
        columns = np.swapaxes(r + np.identity(3), -1, -2)
        longest = np.argmax(np.linalg.norm(columns, axis=-1), axis=-1)
        axis = np.take_along_axis(columns, longest[..., None, None], axis=-2)[..., 0, :]
        axis = axis / np.linalg.norm(axis, axis=-1)[..., None]
        made = np.where(half_turn[..., None], axis * np.pi, made)
    return made


@dataclass(frozen=True)
class Step:
    """One moving axis: motion along or about z after a fixed transform from the frame before."""

    before: Array  # 4x4
    joint: int  # index in the joint vector
    prismatic: bool = False
    ratio: float = 1.0  # motion = ratio x joint position


@dataclass
class Axes:
    """Axes of an open chain, each moved by one entry of the joint vector: what a Chain has without its inverse.

    Lengths in m, angles in rad. Joint vectors are arrays (..., n): any batch shape; poses are (..., 4, 4) in the
    chain's base frame.
    """

    steps: list[Step]
    lower: Array
    upper: Array
    tip: Array = field(default_factory=lambda: np.identity(4))  # in the frame of the last axis
    home: Array = field(default_factory=lambda: np.zeros(0))  # where a search starts; the middle of the limits
    names: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.lower = np.asarray(self.lower, dtype=float)
        self.upper = np.asarray(self.upper, dtype=float)
        if len(self.home) == 0:
            self.home = np.clip(0.5 * (self.lower + self.upper), -np.pi, np.pi)
        self.home = np.clip(self.home, self.lower, self.upper)
        self.prismatic = np.zeros(len(self.lower), dtype=bool)
        for step in self.steps:
            self.prismatic[step.joint] |= step.prismatic
        self.period = np.array([self._period(joint) for joint in range(len(self.lower))])

    def frames(self, joints: ArrayLike) -> Array:
        """Frame of every axis after its motion, (..., axes, 4, 4)."""
        q = self._checked(joints)
        pose = np.broadcast_to(np.identity(4), (*q.shape[:-1], 4, 4))
        made = []
        for step in self.steps:
            motion = step.ratio * q[..., step.joint]
            if step.prismatic:
                moved = np.broadcast_to(np.identity(4), (*q.shape[:-1], 4, 4)).copy()
                moved[..., 2, 3] = motion
            else:
                moved = rotation(2, motion)
            pose = pose @ (step.before @ moved)
            made.append(pose)
        return np.stack(made, axis=-3)

    def forward(self, joints: ArrayLike) -> Array:
        """Pose of the tip, (..., 4, 4)."""
        made: Array = self.frames(joints)[..., -1, :, :] @ self.tip
        return made

    def jacobian(self, joints: ArrayLike, frame: str = "spatial") -> Array:
        """(..., 6, n): the tip's linear (m/s), then angular velocity (rad/s) for unit joint velocities.

        Both frames mean the point at the tip: "spatial" along the base's axes, "body" along the tip's.
        """
        if frame not in ("spatial", "body"):
            raise ValueError(f"frame must be 'spatial' or 'body', not {frame!r}")
        q = self._checked(joints)
        frames = self.frames(q)
        tip = frames[..., -1, :, :] @ self.tip
        made = np.zeros((*q.shape[:-1], 6, q.shape[-1]))
        for i, step in enumerate(self.steps):
            axis = frames[..., i, :3, 2] * step.ratio
            if step.prismatic:
                made[..., :3, step.joint] += axis
            else:
                made[..., :3, step.joint] += np.cross(axis, tip[..., :3, 3] - frames[..., i, :3, 3])
                made[..., 3:, step.joint] += axis
        if frame == "body":
            to_tip = np.swapaxes(tip[..., :3, :3], -1, -2)
            made[..., :3, :] = to_tip @ made[..., :3, :]
            made[..., 3:, :] = to_tip @ made[..., 3:, :]
        return made

    def _period(self, joint: int) -> float:
        """Joint motion (rad) after which the chain has the same pose again; 0: none, or more than 12 turns."""
        if self.prismatic[joint]:
            return 0.0
        turns = np.arange(1, 13)
        ratios = np.array([step.ratio for step in self.steps if step.joint == joint])
        axis_turns = np.multiply.outer(turns, ratios)
        repeats = np.all(np.abs(axis_turns - np.round(axis_turns)) < 1e-12, axis=-1)
        return float(2.0 * np.pi * turns[repeats][0]) if np.any(repeats) else 0.0

    def _checked(self, joints: ArrayLike) -> Array:
        q = np.asarray(joints, dtype=float)
        if q.ndim == 0 or q.shape[-1] != len(self.lower):
            raise ValueError(f"joint vectors have {len(self.lower)} entries here, not {q.shape[-1:]}")
        return q
