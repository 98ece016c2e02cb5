"""Environments of ambf_gym: how often experts, random and constant actions succeed, and env steps a CPU second.

Bars: experts at least 95 % with randomised parameters (PsmReach 100 %); random actions below 5 %, none below 2 %,
constant ones below 10 %. Pictures of 84 x 84: at least 30 env steps a second. A reset takes at most 5 % of an episode's
time, and physics at least 0.8 of that of env.step (the rest is Python). --costs: only these two.
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
    "ambf/NeedleDrive-v0": {
        "gravity": [[0, 0, -10.3], [0, 0, -9.3]],
        "/ambf/env/needle_drive/needle": {"linear damping": [0.2, 0.4]},
    },
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


def costs(id, episodes=5):
    """Of an episode's CPU time the share of its reset; and of that of env.step the share of physics."""
    env, random = ambf_gym.make(id), np.random.default_rng(1)
    inner, limit = env.unwrapped, env.spec.max_episode_steps
    advance, inside = inner.world.step, []

    def step(n=1):
        begun = time.process_time()
        advance(n)
        inside.append(time.process_time() - begun)

    inner.world.step = step
    reset = steps = physics = 0.0
    for seed in range(episodes):
        times = [time.process_time()]
        env.reset(seed=seed)
        times.append(time.process_time())
        inside.clear()
        for _ in range(limit):
            env.step(random.uniform(-1, 1, inner.action_size).astype(np.float32))
        times.append(time.process_time())
        reset, steps = np.array([reset, steps]) + np.diff(times)
        physics += sum(inside)
    env.close()
    return reset / (reset + steps), physics / steps


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
    parser.add_argument("--constants", type=int, default=20, help="of each constant action; 0: as many as of others")
    parser.add_argument("--only", help="one environment")
    parser.add_argument("--picture", metavar="FILE", help="draw the table, too (matplotlib)")
    parser.add_argument("--costs", action="store_true", help="only what resets and env.step take")
    options = parser.parse_args()
    print(support.machine())
    rows, figures = [], {}
    for id, ranges in RANGES.items():
        if options.only not in (None, id):
            continue
        reset, physics = costs(id)
        if options.costs:
            print(
                f"{id}: reset {100 * reset:.1f} % of an episode, physics {physics:.2f} of env.step",
                flush=True,
            )
            continue
        env = ambf_gym.make(id, randomization=ranges)
        size = env.unwrapped.action_size
        expert, rate = success(env, lambda inner, seed: inner.expert(), options.episodes)
        chance, _ = success(env, random_policy, options.episodes)
        print(f"{id}: expert {expert}, random {chance}", flush=True)  # it takes minutes
        still, _ = success(env, lambda inner, seed: lambda observation: np.zeros(inner.action_size), options.episodes)
        same = max(
            success(env, lambda inner, seed, a=action: lambda observation: a, options.constants or options.episodes)[0]
            for action in constants(size)
        )
        env.close()
        shares = [f"{100 * each:.1f} %" for each in (expert, chance, still, same)]
        shares += [f"{rate:.0f}", f"{drawing_rate(id):.0f}"]
        rows.append([id, *shares, f"{100 * reset:.1f} %", f"{physics:.2f}"])
        figures[f"{id}, env steps"] = (rate, "rate")
        print(rows[-1], flush=True)
    head = ["environment", "expert", "random", "no action", "best constant", "env steps a CPU second", "with pictures"]
    head += ["reset, of an episode", "physics, of env.step"]
    if rows:
        support.record("gym", rows, head, figures)
    if rows and options.picture:
        support.plot(rows, head, options.picture)


if __name__ == "__main__":
    main()
