"""What users may say of an environment, and of a reset."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = NDArray[np.float32]


def check_options(backend: object, render_mode: str | None, reward: str, observation: str, delay: object) -> None:
    """Raises ValueError for what no environment has. backend: a name, or a world of a batch."""
    if isinstance(backend, str) and backend not in ("core", "ros"):
        raise ValueError(f"backend={backend!r}: 'core' or 'ros'")
    if reward not in ("sparse", "dense"):
        raise ValueError(f"reward={reward!r}: 'sparse' or 'dense'")
    if observation not in ("state", "pictures", "both"):
        raise ValueError(f"observation={observation!r}: 'state', 'pictures' or 'both'")
    if render_mode not in (None, "rgb_array", "human"):
        raise ValueError(f"render_mode={render_mode!r}: 'rgb_array', 'human' or None")
    if render_mode == "human" and not isinstance(backend, str):
        raise ValueError("render_mode='human': the worlds of a vector have no window; a single environment has one")
    if isinstance(delay, bool) or not isinstance(delay, int) or delay < 0:
        raise ValueError(f"delay={delay!r}: a number of actions")
    if backend == "ros" and (render_mode == "rgb_array" or observation != "state"):
        raise ValueError("pictures: over ROS they come from the topics of the simulator's cameras")


def noise_of(noise: ArrayLike, size: int) -> NDArray[np.float64]:
    """Standard deviations: one, or `size` of them. Raises ValueError."""
    out = np.asarray(noise, np.float64)
    if out.shape not in ((), (size,)) or not np.isfinite(out).all() or (out < 0).any():
        raise ValueError(f"noise={noise!r}: a standard deviation, or {size} of them")
    return out


def goal_of(options: Mapping[str, Any] | None, size: int) -> Floats | None:
    """The goal that options of a reset name. Raises ValueError for one that is none, and for other options."""
    further = [name for name in options or {} if name != "goal"]
    if further:
        raise ValueError(f"options: {', '.join(map(repr, further))}: there is only 'goal'")
    given = (options or {}).get("goal")
    if given is None:
        return None
    what = "a point" if size == 3 else f"{size} finite numbers"
    try:
        goal = np.array(given, dtype=np.float32)
    except (TypeError, ValueError):
        raise ValueError(f"goal: {given!r} is not {what}") from None
    if goal.shape != (size,) or not np.isfinite(goal).all():
        raise ValueError(f"goal: {given!r} is not {what}")
    return goal
