"""Joint vectors that tests and the benchmark of kinematics try."""

import numpy as np


def random_joints(arm, count, seed=1):
    """Over the whole range; each joint at a limit in one of five."""
    rng = np.random.default_rng(seed)
    shape = (count, len(arm.lower))
    inside = arm.lower + (arm.upper - arm.lower) * rng.random(shape)
    limit = np.where(rng.random(shape) < 0.5, arm.lower, arm.upper)
    return np.where(rng.random(shape) < 0.2, limit, inside)
