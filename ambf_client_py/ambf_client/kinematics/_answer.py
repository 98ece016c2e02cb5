"""What inverse kinematics answers, and the choice among several solutions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._chain import Array, Axes, pose_difference

SOLVED = "solved"
SINGULAR = "singular"
OUT_OF_LIMITS = "out_of_limits"
UNREACHABLE = "unreachable"
INVALID = "invalid"

_SLACK = 1e-10  # of limits (rad, m): a solution at a limit is often rounded to just outside
_TIE = 1e-9  # candidates equally far from the seed: the first counts


@dataclass
class Answer:
    """Answers for a batch of poses; fields have the batch's shape. Values are always finite.

    `status` of each pose:

    - "solved": `joints` reach the pose within their limits.
    - "singular": they do, but the pose leaves some of them free (`free`); these are as in the seed.
    - "out_of_limits": only joints beyond their limits reach it. `joint` is the one that is furthest beyond, relative to
      its range, `excess` how far (rad or m).
    - "unreachable": no joint positions reach it, even without limits.
    - "invalid": pose or seed is not finite, or the pose is no rigid transform.

    Unless solved or singular, `joints` are within limits and lead to the nearest pose that was found: the solution
    without limits, clipped. `distance` (m) and `angle` (rad) are what is then missing; 0 within rounding if solved.
    """

    status: NDArray[np.str_]
    joints: Array
    joint: NDArray[np.int64]  # -1: none
    excess: Array
    distance: Array
    angle: Array
    free: NDArray[np.bool_]  # (..., n)

    @property
    def reached(self) -> NDArray[np.bool_]:
        """Whether `joints` reach the pose: solved or singular."""
        made: NDArray[np.bool_] = (self.status == SOLVED) | (self.status == SINGULAR)
        return made

    def reshaped(self, shape: tuple[int, ...]) -> Answer:
        """The same answers as a batch of another shape."""
        n = self.joints.shape[-1]
        return Answer(
            self.status.reshape(shape),
            self.joints.reshape(*shape, n),
            self.joint.reshape(shape),
            self.excess.reshape(shape),
            self.distance.reshape(shape),
            self.angle.reshape(shape),
            self.free.reshape(*shape, n),
        )

    def __iter__(self) -> Iterator[Answer]:
        """The answers one by one, each with an empty batch shape."""
        flat = self.reshaped((self.status.size,))
        for i in range(self.status.size):
            yield Answer(
                flat.status[i],
                flat.joints[i],
                flat.joint[i],
                flat.excess[i],
                flat.distance[i],
                flat.angle[i],
                flat.free[i],
            )


@dataclass
class Candidates:
    """Solutions of a batch without limits: joints (N, C, n); which joints the pose leaves free; which miss the pose."""

    joints: Array
    free: NDArray[np.bool_]  # (N, C, n)
    missed: NDArray[np.bool_]  # (N, C)

    def only(self, chosen: NDArray[np.bool_]) -> Candidates:
        """Those of some poses of the batch."""
        return Candidates(self.joints[chosen], self.free[chosen], self.missed[chosen])


def wrapped(chain: Axes, joints: Array, seed: Array) -> Array:
    """Whole periods added: within limits as near to the seed as possible, else as near to the limits as possible.

    A period is a turn of every axis that the joint moves: more than one of its own where a ratio is a fraction.
    """
    turn = np.where(chain.period > 0.0, chain.period, 1.0)
    near = joints + turn * np.round((seed - joints) / turn)
    below = near - turn * np.ceil((near - chain.upper - _SLACK) / turn)
    above = near + turn * np.ceil((chain.lower - near - _SLACK) / turn)
    made = np.where(near > chain.upper + _SLACK, below, np.where(near < chain.lower - _SLACK, above, near))
    # No whole period fits: the side that exceeds less.
    other = made + np.where(made < chain.lower, turn, -turn)
    worse = _excess(chain, made) > np.abs(_excess(chain, other)) + _SLACK
    return np.where(chain.period > 0.0, np.where(worse, other, made), joints)


def _excess(chain: Axes, joints: Array) -> Array:
    excess: Array = np.maximum(np.maximum(chain.lower - joints, joints - chain.upper), 0.0)
    return np.where(excess <= _SLACK, 0.0, excess)


def ranges(chain: Axes) -> Array:
    """Widths of the joints' ranges, 1 where there is none: what makes rad and m comparable."""
    width = chain.upper - chain.lower
    return np.where(np.isfinite(width) & (width > 0.0), width, 1.0)


def choose(chain: Axes, target: Array, seed: Array, found: Candidates) -> Answer:
    """The legal candidate nearest to the seed; where there is none, the nearest to the limits."""
    width = ranges(chain)
    joints = wrapped(chain, found.joints, seed[:, None, :])
    excess = _excess(chain, joints)
    relative = excess / width
    beyond = np.linalg.norm(relative, axis=-1)
    clipped = np.clip(joints, chain.lower, chain.upper)
    cost = np.linalg.norm((clipped - seed[:, None, :]) / width, axis=-1)
    illegal = beyond > 0.0
    cost = np.where(illegal, 1e3 * (1.0 + beyond), cost)
    if np.any(found.missed):  # of missed ones the nearest, legal ones first: an ECM keeps the position
        distance, angle = pose_difference(chain.forward(clipped), target[:, None])
        cost = np.where(found.missed, 1e6 * (1.0 + 1e3 * beyond + distance + angle), cost)
    best = np.zeros(len(target), dtype=int)
    least = cost[:, 0].copy()
    for c in range(1, cost.shape[1]):
        better = cost[:, c] < least - _TIE * (1.0 + least)
        best[better] = c
        least[better] = cost[better, c]
    rows = np.arange(len(target))
    free = found.free[rows, best]
    status = np.full(len(target), SOLVED, dtype="<U13")
    status[np.any(free, axis=-1)] = SINGULAR
    status[illegal[rows, best]] = OUT_OF_LIMITS
    status[found.missed[rows, best]] = UNREACHABLE
    at_limit = status == OUT_OF_LIMITS
    joint = np.where(at_limit, np.argmax(relative[rows, best], axis=-1), -1)
    chosen = clipped[rows, best]
    distance, angle = pose_difference(chain.forward(chosen), target)
    return Answer(
        status,
        chosen,
        joint,
        np.where(at_limit, excess[rows, best, joint], 0.0),
        distance,
        angle,
        free & (status == SINGULAR)[:, None],
    )
