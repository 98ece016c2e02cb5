"""Inverse of any open chain: damped least squares (Levenberg-Marquardt) within limits, from several starts."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._answer import OUT_OF_LIMITS, SINGULAR, SOLVED, UNREACHABLE, Answer, ranges, wrapped
from ._chain import Array, Axes, pose_difference, rotation_vector

ITERATIONS = 120
REACHED = 1e-10  # distance (m) and angle (rad) of a solution
STARTS = 8
_FREE = 1e-8  # a singular value (per joint range) below this leaves joints free


def _error(chain: Axes, joints: Array, target: Array) -> Array:
    pose = chain.forward(joints)
    turned = rotation_vector(pose[..., :3, :3], target[..., :3, :3])
    return np.concatenate([target[..., :3, 3] - pose[..., :3, 3], turned], axis=-1)


def descend(chain: Axes, target: Array, start: Array, limited: bool) -> Array:
    """Joint vectors of locally least error, one for each pose; clipped to limits in each iteration if `limited`."""
    width = ranges(chain)
    joints = np.clip(start, chain.lower, chain.upper)
    error = _error(chain, joints, target)
    damping = np.full(len(target), 1e-3)
    active = np.ones(len(target), dtype=bool)
    for _ in range(ITERATIONS):
        active &= np.linalg.norm(error, axis=-1) > 1e-15
        rows = np.flatnonzero(active)
        if not len(rows):
            break
        j = chain.jacobian(joints[rows]) * width
        gradient = np.einsum("nij,ni->nj", j, error[rows])
        if limited:  # joints at a limit that would move beyond are held
            at = np.where(gradient > 0.0, joints[rows] >= chain.upper, joints[rows] <= chain.lower)
            j = np.where(at[:, None, :], 0.0, j)
            gradient = np.where(at, 0.0, gradient)
        normal = np.einsum("nij,nik->njk", j, j)
        normal[:, range(len(width)), range(len(width))] += damping[rows, None]
        moved = joints[rows] + width * np.linalg.solve(normal, gradient[..., None])[..., 0]
        if limited:
            moved = np.clip(moved, chain.lower, chain.upper)
        after = _error(chain, moved, target[rows])
        better = np.linalg.norm(after, axis=-1) < np.linalg.norm(error[rows], axis=-1)
        joints[rows[better]] = moved[better]
        error[rows[better]] = after[better]
        damping[rows] = np.where(better, np.maximum(damping[rows] * 0.03, 1e-16), damping[rows] * 8.0)
        active[rows[damping[rows] > 1e3]] = False
    return joints


def starts(chain: Axes, seed: Array) -> list[Array]:
    """The seed, home, and points spread over the limits (a Halton sequence), the same in each call."""
    made = [seed, np.broadcast_to(chain.home, seed.shape)]
    low, high = np.clip(chain.lower, -np.pi, np.pi), np.clip(chain.upper, -np.pi, np.pi)
    primes = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53)
    for k in range(1, STARTS - 1):
        made.append(
            np.broadcast_to(
                [lo + _halton(k, primes[i % 16]) * (hi - lo) for i, (lo, hi) in enumerate(zip(low, high, strict=True))],
                seed.shape,
            )
        )
    return made


def _halton(index: int, base: int) -> float:
    value, digit = 0.0, 1.0 / base
    while index:
        value += digit * (index % base)
        index //= base
        digit /= base
    return value


def solve(chain: Axes, target: Array, seed: Array) -> Answer:
    """As Arm.inverse, for (N, 4, 4) and (N, n)."""
    best = np.clip(seed, chain.lower, chain.upper)
    distance, angle = pose_difference(chain.forward(best), target)
    status = np.full(len(target), UNREACHABLE, dtype="<U13")
    joint = np.full(len(target), -1)
    excess = np.zeros(len(target))
    todo = np.ones(len(target), dtype=bool)
    for limited in (True, False):
        for start in starts(chain, seed):
            rows = np.flatnonzero(todo)
            if not len(rows):
                break
            found = descend(chain, target[rows], start[rows], limited)
            joints = wrapped(chain, found, seed[rows])
            legal = np.clip(joints, chain.lower, chain.upper)
            d, a = pose_difference(chain.forward(found), target[rows])
            reached = np.maximum(d, a) < REACHED
            beyond = np.maximum(np.abs(joints - legal) / ranges(chain), 0.0)
            solved = reached & (np.max(beyond, axis=-1) < 1e-10)
            d, a = pose_difference(chain.forward(legal), target[rows])
            nearer = solved | (d + a < distance[rows] + angle[rows])
            best[rows[nearer]], distance[rows[nearer]], angle[rows[nearer]] = legal[nearer], d[nearer], a[nearer]
            status[rows[solved]], joint[rows[solved]], excess[rows[solved]] = SOLVED, -1, 0.0
            outside = rows[reached & ~solved]
            status[outside] = OUT_OF_LIMITS
            worst = np.argmax(beyond[reached & ~solved], axis=-1)
            joint[outside] = worst
            excess[outside] = np.abs(joints - legal)[reached & ~solved, worst]
            todo[rows[reached]] = False
    free = _free(chain, best) & (status == SOLVED)[:, None]
    status[np.any(free, axis=-1)] = SINGULAR
    return Answer(status, best, joint, excess, distance, angle, free)


def _free(chain: Axes, joints: Array) -> NDArray[np.bool_]:
    """Joints that can move while the tip rests, in chains without redundancy."""
    made = np.zeros(joints.shape, dtype=bool)
    if joints.shape[-1] > 6:
        return made
    _, values, directions = np.linalg.svd(chain.jacobian(joints) * ranges(chain))
    rows = values[:, -1] < _FREE
    made[rows] = np.abs(directions[rows, -1]) > 1e-3
    return made
