"""Environments of ambf_gym: how often experts, random and constant actions succeed, and env steps a CPU second.

Bars: experts at least 95 % with randomised parameters (PsmReach 100 %); random actions below 5 %, none below 2 %,
constant ones below 10 %. Pictures of 84 x 84: at least 30 env steps a second.
"""

import argparse
import time

import ambf_gym
import numpy as np
import support

MOTORS = {"baselink-yawlink": {"damping": [0.0, 0.2]}, "pitchendlink-maininsertionlink": {"damping": [0.0, 2.0]}}
RANGES = {
    "ambf/PsmReach-v0": MOTORS,
    "ambf/EcmReach-v0": MOTORS,
    "ambf/EcmTrack-v0": MOTORS,
    "ambf/Arm7Reach-v0": {"joint2": {"damping": [0.5, 2.0]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/RingLift-v0": {"ring2": {"friction": [0.7, 1.1]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/PegTransfer-v0": {"ring2": {"friction": [0.7, 1.1]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/BiPegTransfer-v0": {"ring2": {"friction": [0.7, 1.1]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/NeedlePick-v0": {"needle": {"friction": [1.2, 1.8]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/NeedleRegrasp-v0": {"needle": {"friction": [1.2, 1.8]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/TissueRetract-v0": {"gravity": [[0, 0, -10.3], [0, 0, -9.3]], "bead": {"mass": [0.0003, 0.002]}},
    "ambf/RingWire-v0": {"/ambf/env/ring_wire/ring": {"friction": [0.1, 0.3], "linear damping": [0.4, 0.6]}},
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


def drawing_rate(id):
    """Env steps a second of this clock, each with a picture of 84 x 84, drawn by the processor."""
    env = ambf_gym.make(id, observation="pictures")
    still = np.zeros(env.unwrapped.action_size, np.float32)
    env.reset(seed=1)
    started = time.monotonic()
    for _ in range(40):
        env.step(still)
    rate = 40 / (time.monotonic() - started)
    env.close()
    return rate


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--episodes", type=int, default=200)
    parser.add_argument("--only", help="one environment")
    options = parser.parse_args()
    print(support.machine())
    rows, figures = [], {}
    for id, ranges in RANGES.items():
        if options.only not in (None, id):
            continue
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
        shares = [f"{100 * each:.1f} %" for each in (expert, chance, still, same)]
        rows.append([id, *shares, f"{rate:.0f}", f"{drawing_rate(id):.0f}"])
        figures[f"{id}, env steps"] = (rate, "rate")
        print(rows[-1], flush=True)
    head = ["environment", "expert", "random", "no action", "best constant", "env steps a CPU second", "with pictures"]
    support.record("gym", rows, head, figures)


if __name__ == "__main__":
    main()
