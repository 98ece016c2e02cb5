"""Arms whose shaft passes through the base's origin: PSM and Raven II (six joints, 8 solutions), ECM (four joints).

Axes 1 and 2 point the shaft, axis 3 slides along it, axis 4 rolls it; all of them meet in the remote centre. With a
wrist, axis 5 meets the shaft at a right angle and axis 6 is at a right angle to axis 5, at distance a from it. Position
and orientation separate as seen from the tip: the remote centre lies in the plane through the shaft at a right angle to
axis 5, which gives joint 6, then the insertion, joint 5, the direction of the shaft, joints 1 and 2, and the roll. The
idea is of Hwang et al., arXiv 2012.12844; theirs knows only the branch with the wrist in front of the remote centre.
"""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._answer import Candidates
from ._chain import Array, inverse_pose, rotation

if TYPE_CHECKING:
    from ._arm import Arm

NOTHING = 1e-10  # a length (m) or the sine of an angle that gives no direction
TOLERANCE = 1e-9  # rad by which a pose may be off what four joints can reach


def _direction(
    arm: Arm, k: Array, sign: float, seed: Array
) -> tuple[Array, Array, NDArray[np.bool_], NDArray[np.bool_]]:
    """theta 1 and 2 that point the shaft along the unit vectors k; whether theta 1 is free; whether there are none."""
    alpha1, alpha2, alpha3 = (arm.rows[i].alpha for i in range(3))
    c1, s1, c2, s2, c3, s3 = (f(a) for a in (alpha1, alpha2, alpha3) for f in (np.cos, np.sin))
    kx, ky, kz = k[:, 0], c1 * k[:, 1] + s1 * k[:, 2], -s1 * k[:, 1] + c1 * k[:, 2]
    cos2 = (c2 * c3 - kz) / (s2 * s3)
    none = np.abs(cos2) > 1.0 + NOTHING
    cos2 = np.clip(cos2, -1.0, 1.0)
    sin2 = sign * np.sqrt((1.0 - cos2) * (1.0 + cos2))
    x, y = s3 * sin2, -c2 * s3 * cos2 - s2 * c3
    free = np.hypot(x, y) < NOTHING
    theta1 = np.where(free, seed[:, 0] + arm.rows[0].theta, np.arctan2(ky, kx) - np.arctan2(y, x))
    return theta1, np.arctan2(sin2, cos2), free, none


def _shaft_frame(arm: Arm, theta1: Array, theta2: Array) -> Array:
    """Rotation of frame 3 from the angles of rows 1 and 2."""
    turned = rotation(0, arm.rows[0].alpha) @ rotation(2, theta1) @ rotation(0, arm.rows[1].alpha) @ rotation(2, theta2)
    fixed = rotation(0, arm.rows[2].alpha) @ rotation(2, arm.rows[2].theta)
    made: Array = (turned @ fixed)[:, :3, :3]
    return made


def with_wrist(arm: Arm, target: Array, seed: Array) -> Candidates:
    """All 8 solutions without limits: remote centre on either side of axis 6, insertion and theta 2 of either sign."""
    last = target @ inverse_pose(arm.tip)
    rows = arm.rows
    e5, e6, a = np.sin(rows[4].alpha), np.sin(rows[5].alpha), rows[5].a
    center = inverse_pose(last)[:, :3, 3]  # the remote centre in frame 6
    h = np.hypot(center[:, 0], center[:, 1])
    found = []
    for side, sign, sign2 in itertools.product((-1.0, 1.0), (1.0, -1.0), (1.0, -1.0)):
        free6 = h < NOTHING
        away = np.arctan2(center[:, 1], center[:, 0])
        theta6 = np.where(free6, seed[:, 5] + rows[5].theta, (np.pi if side < 0.0 else 0.0) - away)
        x = a + side * h
        length = sign * np.hypot(x, center[:, 2])
        free5 = np.abs(length) < NOTHING
        theta5 = np.where(free5, seed[:, 4] + rows[4].theta, np.arctan2(-x * sign * e5, e6 * center[:, 2] * sign * e5))
        wrist = rotation(0, rows[4].alpha) @ rotation(2, theta5) @ rotation(0, rows[5].alpha) @ rotation(2, theta6)
        shaft = last[:, :3, :3] @ np.swapaxes(wrist[:, :3, :3], -1, -2)  # frame 4
        theta1, theta2, free1, missed = _direction(arm, shaft[:, :, 2], sign2, seed)
        rolled = np.swapaxes(_shaft_frame(arm, theta1, theta2), -1, -2) @ shaft
        theta4 = np.arctan2(rolled[:, 1, 0], rolled[:, 0, 0])
        no = np.zeros_like(free1)
        found.append(
            (
                np.stack(
                    [
                        theta1 - rows[0].theta,
                        theta2 - rows[1].theta,
                        length - rows[2].d - rows[3].d,
                        theta4 - rows[3].theta,
                        theta5 - rows[4].theta,
                        theta6 - rows[5].theta,
                    ],
                    axis=-1,
                ),
                np.stack([free1, no, no, no, free5, free6], axis=-1),
                missed,
            )
        )
    return Candidates(*(np.stack(part, axis=1) for part in zip(*found, strict=True)))


def without_wrist(arm: Arm, target: Array, seed: Array) -> Candidates:
    """4 solutions: insertion of either sign, theta 2 of either sign. The shaft must point away from the centre."""
    last = target @ inverse_pose(arm.tip)
    rows = arm.rows
    r = np.linalg.norm(last[:, :3, 3], axis=-1)
    at_center = r < NOTHING
    away = np.where(at_center[:, None], last[:, :3, 2], last[:, :3, 3] / np.where(at_center, 1.0, r)[:, None])
    found = []
    for sign, sign2 in itertools.product((1.0, -1.0), (1.0, -1.0)):
        k = away * sign
        theta1, theta2, free1, missed = _direction(arm, k, sign2, seed)
        rolled = np.swapaxes(_shaft_frame(arm, theta1, theta2), -1, -2) @ last[:, :3, :3]
        theta4 = np.arctan2(rolled[:, 1, 0] - rolled[:, 0, 1], rolled[:, 0, 0] + rolled[:, 1, 1])
        z = last[:, :3, 2]
        off = np.arctan2(np.linalg.norm(np.cross(z, k), axis=-1), np.einsum("ij,ij->i", z, k))
        no = np.zeros_like(free1)
        found.append(
            (
                np.stack(
                    [
                        theta1 - rows[0].theta,
                        theta2 - rows[1].theta,
                        sign * r - rows[2].d - rows[3].d,
                        theta4 - rows[3].theta,
                    ],
                    axis=-1,
                ),
                np.stack([free1, no, no, no], axis=-1),
                missed | (off > TOLERANCE),
            )
        )
    return Candidates(*(np.stack(part, axis=1) for part in zip(*found, strict=True)))
