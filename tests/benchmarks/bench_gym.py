"""Environments of ambf_gym: how often experts, random and constant actions succeed, and env steps a CPU second.

Bars: experts at least 95 % with randomised parameters; random actions below 5 %, none below 2 %, constant ones below
10 %.
"""

import argparse
import time

import ambf_gym
import numpy as np
import support

RANGES = {
    "ambf/Arm7Reach-v0": {"joint2": {"damping": [0.5, 2.0]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/RingLift-v0": {"ring2": {"friction": [0.7, 1.1]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/PegTransfer-v0": {"ring2": {"friction": [0.7, 1.1]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
}


def constants(size):
    """Actions that never change: all the same way, and each axis alone."""
    return [*np.eye(size), *-np.eye(size), np.ones(size), -np.ones(size)]


def success(env, make_policy, episodes):
    """Share of episodes that end in success, and env steps a CPU second."""
    reached = steps = 0
    started = time.process_time()
    for seed in range(episodes):
        observation, info = env.reset(seed=seed)
        act, over = make_policy(env.unwrapped, seed), False
        while not over:
            observation, _, terminated, truncated, info = env.step(np.asarray(act(observation), np.float32))
            over, steps = terminated or truncated, steps + 1
        reached += info["is_success"]
    return reached / episodes, steps / (time.process_time() - started)


def random_policy(env, seed):
    generator = np.random.default_rng(seed)
    return lambda observation: generator.uniform(-1, 1, env.action_size)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--episodes", type=int, default=200)
    options = parser.parse_args()
    print(support.machine())
    rows, figures = [], {}
    for id, ranges in RANGES.items():
        env = ambf_gym.make(id, randomization=ranges)
        size = env.unwrapped.action_size
        expert, rate = success(env, lambda inner, seed: inner.expert(), options.episodes)
        chance, _ = success(env, random_policy, options.episodes)
        still, _ = success(env, lambda inner, seed: lambda observation: np.zeros(inner.action_size), options.episodes)
        same = max(
            success(env, lambda inner, seed, a=action: lambda observation: a, max(1, options.episodes // 10))[0]
            for action in constants(size)
        )
        env.close()
        rows.append([id, *(f"{100 * each:.1f} %" for each in (expert, chance, still, same)), f"{rate:.0f}"])
        figures[f"{id}, env steps"] = (rate, "rate")
        print(rows[-1], flush=True)
    head = ["environment", "expert", "random", "no action", "best constant", "env steps a CPU second"]
    support.record("gym", rows, head, figures)


if __name__ == "__main__":
    main()
