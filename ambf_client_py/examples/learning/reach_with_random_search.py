#!/usr/bin/env python3
"""Teaches an arm to reach: joint targets that bring the tip of arm7 to a goal, found by random search in many worlds.

Needs neither ROS nor a simulator: the worlds run in this process, and in as many others as --workers says.

    ./dev shell -- python ambf_client_py/examples/learning/reach_with_random_search.py --workers 2
"""

import argparse
import time

import numpy as np
from ambf_core import MODELS, WorldBatch
from ambf_core.arrays import Floats

ARM = MODELS / "multi-bodies/robots/arm7.yaml"
GROUND = MODELS / "world/arm7_world.yaml"
EPISODE = 600  # steps of 1 ms


def distances(batch: WorldBatch, tip: int, targets: Floats, goal: Floats) -> Floats:
    """How far from the goal (m) each world's tip is at the end of an episode with those joint targets."""
    batch.reset()
    batch.commands.set_joints(targets)
    batch.step(EPISODE)
    return np.asarray(np.linalg.norm(batch.state.body_pose[:, tip, :3] - goal, axis=1))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--worlds", type=int, default=16)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    random = np.random.default_rng(options.seed)

    with WorldBatch(ARM, world=GROUND, n=options.worlds, workers=options.workers) as batch:
        tip = len(batch.bodies) - 1
        low, high = np.clip(batch.joint_limits, -2.0, 2.0).T
        # A goal that can be reached: where the tip comes with some other targets.
        batch.commands.set_joints(random.uniform(0.5 * low, 0.5 * high))
        batch.step(EPISODE)
        goal = batch.state.body_pose[0, tip, :3].copy()

        best, spread = np.zeros(len(batch.joints)), 0.5
        started = time.monotonic()
        for number in range(options.rounds):
            tried = np.clip(best + spread * random.standard_normal((batch.n, len(best))), low, high)
            tried[0] = best
            far = distances(batch, tip, tried, goal)
            best = tried[far.argmin()]
            spread *= 0.8
            print(f"round {number + 1}: {1000 * far.min():.1f} mm from the goal")
        steps = options.rounds * batch.n * EPISODE
        print(f"{steps} steps, {steps / (time.monotonic() - started):.0f} a second")


if __name__ == "__main__":
    main()
