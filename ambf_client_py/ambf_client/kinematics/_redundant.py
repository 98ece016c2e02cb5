"""Seven-joint arms with a spherical wrist: MTM (redundant gimbal) and KUKA (spherical shoulder and wrist).

Their one free parameter comes from the seed: the platform angle (joint 4) of the MTM, the place of the elbow on its
circle of the KUKA. `offset` (rad) moves it away from there.
"""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._answer import Candidates
from ._chain import Array, inverse_pose, rotation
from ._remote_center import NOTHING

if TYPE_CHECKING:
    from ._arm import Arm


def euler_zyz(r: Array, sign: float, seed: Array) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """a, b, c with r = Rz(a) Ry(b) Rz(c), b of the given sign; a from the seed (and reported) where b is 0 or pi."""
    free = np.hypot(r[:, 0, 2], r[:, 1, 2]) < NOTHING
    a = np.where(free, seed, np.arctan2(sign * r[:, 1, 2], sign * r[:, 0, 2]))
    rest = rotation(2, -a)[:, :3, :3] @ r
    return a, np.arctan2(rest[:, 0, 2], rest[:, 2, 2]), np.arctan2(rest[:, 1, 0], rest[:, 1, 1]), free


def gimbal(arm: Arm, target: Array, seed: Array, offset: float) -> Candidates:
    """8 solutions with the seed's platform angle: shoulder in front or behind, elbow and gimbal of either sign."""
    last = target @ inverse_pose(arm.tip)
    rows = arm.rows
    l1, l2, bend = rows[1].a, np.hypot(rows[2].a, rows[3].d), np.arctan2(rows[3].d, rows[2].a)
    position = last[:, :3, 3]
    out = np.hypot(position[:, 0], position[:, 1])
    down = -position[:, 2]
    reach = np.hypot(out, down)
    missed = (reach > l1 + l2 + NOTHING) | (reach < abs(l1 - l2) - NOTHING)
    clamped = np.clip(reach, abs(l1 - l2), l1 + l2)
    cos_elbow = np.clip((clamped**2 - l1**2 - l2**2) / (2.0 * l1 * l2), -1.0, 1.0)
    platform = np.clip(seed[:, 3] + offset, arm.lower[3], arm.upper[3])
    free1 = out < NOTHING
    found = []
    for side, elbow, sign in itertools.product((1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)):
        q1 = np.where(free1, seed[:, 0], np.arctan2(side * position[:, 0], -side * position[:, 1]))
        turned = elbow * np.arccos(cos_elbow)
        q2 = np.arctan2(side * out, down) - np.arctan2(l2 * np.sin(turned), l1 + l2 * np.cos(turned))
        q3 = turned - 0.5 * np.pi - bend
        joints = np.stack([q1, q2, q3, platform, *([np.zeros_like(q1)] * 3)], axis=-1)
        carried = arm.frames(joints)[:, 3, :3, :3] @ rotation(0, rows[3].alpha)[:3, :3]
        turn = np.swapaxes(carried, -1, -2) @ last[:, :3, :3]
        a, b, c, free5 = euler_zyz(turn, sign, seed[:, 4] + rows[4].theta)
        joints[:, 4] = a - rows[4].theta
        joints[:, 5] = b - rows[5].theta
        joints[:, 6] = c - rows[6].theta
        free = np.zeros(joints.shape, dtype=bool)
        free[:, 0], free[:, 4] = free1, free5
        found.append((joints, free, missed))
    return Candidates(*(np.stack(part, axis=1) for part in zip(*found, strict=True)))


def _elbow(arm: Arm, reach: Array, seed: Array, offset: float) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Places of elbow and wrist seen from the shoulder, and whether the wrist had to be moved into reach."""
    upper, fore = arm.rows[2].d, arm.rows[4].d
    length = np.linalg.norm(reach, axis=-1)
    missed = (length > upper + fore + NOTHING) | (length < abs(upper - fore) - NOTHING)
    at_shoulder = length < NOTHING
    u = np.where(at_shoulder[:, None], [0.0, 0.0, 1.0], reach / np.where(at_shoulder, 1.0, length)[:, None])
    clamped = np.clip(length, max(abs(upper - fore), NOTHING), upper + fore)
    along = (upper**2 - fore**2 + clamped**2) / (2.0 * clamped)
    beside = np.sqrt(np.maximum((upper - along) * (upper + along), 0.0))
    # A stretched arm: rounding of the reach moves the elbow by its square root. To the wrist this is 1e-14 m.
    beside = np.where(beside < 1e-7, 0.0, beside)
    seeded = arm.frames(seed)[:, 2, :3, :3]
    across = np.zeros_like(u)
    for column in (0, 1, 2):  # the last that is not along u counts: the seed's upper arm
        v = seeded[:, :, column] - u * np.einsum("ij,ij->i", u, seeded[:, :, column])[:, None]
        norm = np.linalg.norm(v, axis=-1)
        clear = norm > (1e-6 if column == 2 else 0.1)
        across[clear] = v[clear] / norm[clear, None]
    turned = across * np.cos(offset) + np.cross(u, across) * np.sin(offset)
    return u * along[:, None] + turned * beside[:, None], u * clamped[:, None], missed


def spherical_shoulder_and_wrist(arm: Arm, target: Array, seed: Array, offset: float) -> Candidates:
    """8 solutions with the elbow as near to the seed's as its circle allows: joints 2, 4 and 6 of either sign."""
    last = target @ inverse_pose(arm.tip)
    rows = arm.rows
    reach = last[:, :3, 3] - rows[6].d * last[:, :3, 2] - np.array([0.0, 0.0, rows[0].d])
    elbow, wrist, missed = _elbow(arm, reach, seed, offset)
    up = elbow / rows[2].d
    fore = (wrist - elbow) / rows[4].d
    side = np.hypot(up[:, 0], up[:, 1])
    found = []
    for sign2, sign4, sign6 in itertools.product((1.0, -1.0), repeat=3):
        free1 = side < NOTHING
        q1 = np.where(free1, seed[:, 0], np.arctan2(sign2 * up[:, 1], sign2 * up[:, 0]))
        q2 = np.arctan2(np.cos(q1) * up[:, 0] + np.sin(q1) * up[:, 1], up[:, 2])
        shoulder = (rotation(2, q1) @ rotation(1, q2))[:, :3, :3]
        m = np.einsum("nji,nj->ni", shoulder, fore)
        free3 = np.hypot(m[:, 0], m[:, 1]) < NOTHING
        q3 = np.where(free3, seed[:, 2], np.arctan2(-sign4 * m[:, 1], -sign4 * m[:, 0]))
        q4 = np.arctan2(-np.cos(q3) * m[:, 0] - np.sin(q3) * m[:, 1], m[:, 2])
        arm_turn = shoulder @ (rotation(2, q3) @ rotation(1, -q4))[:, :3, :3]
        turn = np.swapaxes(arm_turn, -1, -2) @ last[:, :3, :3]
        q5, q6, q7, free5 = euler_zyz(turn, sign6, seed[:, 4])
        no = np.zeros_like(free1)
        found.append(
            (
                np.stack([q1, q2, q3, q4, q5, q6, q7], axis=-1),
                np.stack([free1, no, free3, no, free5, no, no], axis=-1),
                missed,
            )
        )
    return Candidates(*(np.stack(part, axis=1) for part in zip(*found, strict=True)))
