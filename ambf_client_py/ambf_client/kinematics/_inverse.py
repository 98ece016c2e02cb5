"""Open chains with their inverse: checks of what is asked, in batches, and the numeric solution of any chain."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _numeric
from ._answer import INVALID, Answer
from ._chain import Array, Axes


@dataclass
class Chain(Axes):
    """An open chain. Joint vectors are arrays (..., n) of m and rad, poses (..., 4, 4) in the chain's base frame."""

    def inverse(self, pose: ArrayLike, seed: ArrayLike | None = None) -> Answer:
        """Joints that reach poses (..., 4, 4), nearest to the seed (..., n; home if None); see Answer.

        Redundant arms keep the seed's platform angle (MTM) or elbow (KUKA) where limits allow, else the nearest one
        that they allow, sought in steps of 5 degrees. Chains without closed form are solved numerically.
        """
        target, start, shape, bad = self._batch(pose, seed)
        answer = self._closest(target, start)
        answer.status[bad] = INVALID
        answer.joint[bad] = -1
        for values in (answer.excess, answer.distance, answer.angle, answer.free):
            values[bad] = 0
        answer.joints[bad] = start[bad]
        return answer.reshaped(shape)

    def _closest(self, target: Array, seed: Array) -> Answer:
        return _numeric.solve(self, target, seed)

    def _batch(
        self, pose: ArrayLike, seed: ArrayLike | None
    ) -> tuple[Array, Array, tuple[int, ...], NDArray[np.bool_]]:
        """Poses (N, 4, 4) and seeds (N, n) with values that can be used, the batch's shape, and which were bad."""
        target = np.asarray(pose, dtype=float)
        if target.shape[-2:] != (4, 4):
            raise ValueError(f"poses are 4x4 matrices, not of shape {target.shape}")
        start = self._checked(self.home if seed is None else seed)
        shape = np.broadcast_shapes(target.shape[:-2], start.shape[:-1])
        target = np.array(np.broadcast_to(target, (*shape, 4, 4))).reshape(-1, 4, 4)
        start = np.array(np.broadcast_to(start, (*shape, len(self.lower)))).reshape(-1, len(self.lower))
        bad = ~np.isfinite(target).all(axis=(-1, -2)) | ~np.isfinite(start).all(axis=-1)
        target[bad] = np.identity(4)
        r = target[:, :3, :3]
        square = np.abs(r @ np.swapaxes(r, -1, -2) - np.identity(3)).max(axis=(-1, -2))
        bad |= (square > 1e-6) | (np.linalg.det(r) < 0.0) | (np.abs(target[:, :3, 3]).max(axis=-1) > 1e6)
        target[bad] = np.identity(4)
        start[bad & ~np.isfinite(start).all(axis=-1)] = self.home
        return target, np.clip(start, self.lower, self.upper), shape, bad
