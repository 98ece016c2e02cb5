"""Thousands of episodes: do ranges hold, does anything grow that is reset, made and closed over and over?

    ./dev shell -- python tests/soak/episodes.py [randomised] [resets] [makes] [--share 0.1]

randomised: 1000 resets of three environments with ranges. Each value fills its range evenly and is what the world
has, no two states are alike, each range by itself makes a difference, and without ranges the same world has the hash of
a plain one. resets: 10 000 of four environments with one action each, 1000 that load a world each; makes: three
environments 1000 times made, moved and closed. There, memory stays within 2 % of what it was after the first hundred,
and no thread and no file is left. --share makes all of it shorter. Ends with 1 where a bar is missed.
"""

import argparse
import multiprocessing
import os
import sys
import time
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import ambf_gym
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/acceptance"), str(ROOT / "tests/benchmarks")]
import support  # noqa: E402

RESETS, LOADS, MAKES = 10_000, 1_000, 1_000
SETTLING, GROWTH = 100, 0.02  # of them after which memory is judged, and by what share it may grow
MOVED = 1e-7  # m by which a body must have moved where one value is another
ACTIONS, DROPPED = 55, 40  # after which it is asked; when the ring is let go
PICTURE = {"observation": "both", "picture_size": (64, 48)}
PARAMETERS = {
    "joint1": {"damping": [0.1, 2.0], "P": [5.0, 20.0]},
    "joint2": {"D": [0.0, 1.0]},
    "link7": {"linear damping": [0.0, 0.2]},
    "gravity": [[-0.1, -0.1, -10.3], [0.1, 0.1, -9.3]],
}
RANGES = {
    "ambf/Arm7Reach-v0": {**PARAMETERS, "delay": [0, 3], "noise": [0.0, 0.01]},
    "ambf/PsmReach-v0": {
        "baselink-yawlink": {"damping": [0.0, 0.2]},
        "pitchendlink-maininsertionlink": {"damping": [0.0, 2.0]},
        "view": {"eye": [[-0.05, -0.05, 0], [0.05, 0.05, 0.05]], "field of view": [-0.1, 0.1]},
    },
    "ambf/RingLift-v0": {
        "ring2": {
            "friction": [0.3, 1.1],
            "restitution": [0.0, 0.5],
            "angular damping": [0.0, 0.3],
            "mass": [0.0015, 0.0025],
            "scale": [0.95, 1.05],
            "color": [[0.5, 0.2, 0.1], [1, 0.8, 0.4]],
        },
        "lights": {"key_light": {"location": [[0.4, 0.3, 1.1], [0.8, 0.7, 1.3]], "cutoff angle": [0.05, 1.4]}},
    },
}
LOADED = {"ring2": {"mass": [0.0015, 0.0025], "scale": [0.95, 1.05]}}


class Case(NamedTuple):
    """What is reset, or made, over and over."""

    name: str
    id: str
    options: dict
    times: int


RESET = (
    Case("Arm7Reach", "ambf/Arm7Reach-v0", {}, RESETS),
    Case("Arm7Reach, parameters drawn", "ambf/Arm7Reach-v0", {"randomization": PARAMETERS}, RESETS),
    Case("PsmReach", "ambf/PsmReach-v0", {}, RESETS),
    Case("PegTransfer", "ambf/PegTransfer-v0", {}, RESETS),
    Case("RingLift, files drawn", "ambf/RingLift-v0", {"randomization": LOADED}, LOADS),
)
MADE = (
    Case("Arm7Reach", "ambf/Arm7Reach-v0", {}, MAKES),
    Case("PsmReach", "ambf/PsmReach-v0", {}, MAKES),
    Case("RingLift, with pictures", "ambf/RingLift-v0", PICTURE, MAKES),
)


# ---- ranges ----


def single(ranges):
    """(name, key, low, high, ranges of it alone) of each range; key is "" where a name has no further ones."""
    for name, given in ranges.items():
        if not isinstance(given, Mapping):
            yield name, "", *given, lambda bounds, name=name: {name: bounds}
        elif name == "lights":
            for light, keys in given.items():
                for key, (low, high) in keys.items():
                    alone = lambda bounds, light=light, key=key: {"lights": {light: {key: bounds}}}  # noqa: E731
                    yield f"light {light}", key, low, high, alone
        else:
            for key, (low, high) in given.items():
                yield name, key, low, high, lambda bounds, name=name, key=key: {name: {key: bounds}}


def spread(values, low, high):
    """How far values, one a row, are from filling a range evenly: the larger gap at an end, and Kolmogorov's distance
    from an even spread, both as shares."""
    values, low, high = np.atleast_2d(np.asarray(values, float).T), np.atleast_1d(low), np.atleast_1d(high)
    gap = distance = 0.0
    for column, least, most in zip(values, low, high, strict=True):
        places = np.sort((column - least) / (most - least))
        if places[0] < 0 or places[-1] > 1:
            return np.inf, np.inf
        steps = np.arange(len(places) + 1) / len(places)
        gap = max(gap, places[0], 1 - places[-1])
        distance = max(distance, np.abs(places - steps[:-1]).max(), np.abs(places - steps[1:]).max())
    return gap, distance


def has(env, name, key, value):
    """Whether the world of this episode has what `info` says, as far as a world can be asked."""
    world = env.world
    if key == "mass":
        return world.masses[world.body(name)] == value
    if key and name.partition(" ")[0] not in ("light", "view") and key not in ("scale", "color"):
        return np.allclose(world.parameter(name, key), value, rtol=1e-12)
    return True


def played(env_type, ranges, seed, pictures):
    """Poses of all bodies and what was seen, of one episode with a goal that does not depend on what is drawn."""
    env = env_type(randomization=ranges, **(PICTURE if pictures else {}))
    random = np.random.default_rng(seed)
    observation, _ = env.reset(seed=seed, options={"goal": [0.02, 0.03, 0.11]})
    act = env.expert()
    poses, seen = [], []
    for step in range(ACTIONS):
        action = random.uniform(-1, 1, env.action_size).astype(np.float32)
        if env_type is ambf_gym.RingLift:  # taken, lifted and dropped
            action = act(observation) if step < DROPPED else np.array([0, 0, 0, 1], np.float32)
        observation = env.step(action)[0]
        poses.append(env.world.state.body_pose[:, :3].copy())
        seen.append(observation["picture"].astype(float) if pictures else observation["observation"])
    env.close()
    return np.array(poses), np.array(seen)


def difference(env_type, name, low, high, alone, seed=5):
    """(m that a body moved, what was seen otherwise) between the two ends of one range."""
    key_of_pictures = name == "view" or name.startswith("light ")
    pictures = key_of_pictures or "color" in str(alone([0, 0]))
    ends = [played(env_type, alone([end, end]), seed, pictures) for end in (low, high)]
    moved = np.linalg.norm(ends[0][0] - ends[1][0], axis=-1).max()
    return moved, np.abs(ends[0][1] - ends[1][1]).max()


def randomised(id, times):
    """(rows for a table, what is wrong) of so many resets with the ranges."""
    env_type, ranges = type(ambf_gym.make(id).unwrapped), RANGES[id]
    env, faults = env_type(randomization=ranges), []
    drawn, hashes, wrong = defaultdict(list), set(), set()
    action = np.full(env.action_size, 0.5, np.float32)
    begun = time.process_time()
    for seed in range(times):
        values = env.reset(seed=seed)[1]["randomization"]
        env.step(action)
        hashes.add(env.world.hash())
        for name, key, *_ in single(ranges):
            value = values[f"{name} {key}".strip()]
            drawn[name, key].append(value)
            if not has(env, name, key, value):
                wrong.add(f"{name} {key}")
    milliseconds = (time.process_time() - begun) / times * 1e3
    faults += [f"{id}: {each} is not what info says" for each in sorted(wrong)]
    unlike = any(isinstance(given, Mapping) and name != "view" for name, given in ranges.items())
    if unlike and len(hashes) < times:
        faults.append(f"{id}: {times - len(hashes)} states were there before")
    env._randomization = None
    plain = env_type()
    for each in (env, plain):
        each.reset(seed=1)
        for _ in range(5):
            each.step(action)
    if env.world.hash() != plain.world.hash():
        faults.append(f"{id}: without ranges the world is not the plain one")
    for each in (env, plain):
        each.close()
    rows = []
    for name, key, low, high, alone in single(ranges):
        values, bounds = np.array(drawn[name, key]), (low, high)
        if name == "delay":  # whole numbers: spread out within their own
            values, bounds = values + np.random.default_rng(1).uniform(0, 1, times), (low, high + 1)
        gap, distance = spread(values, *bounds)
        moved, seen = difference(env_type, name, low, high, alone)
        what = f"{name} {key}".strip()
        # One of a thousand ranges that are drawn evenly would miss either.
        if gap > 7.6 / times or distance > 1.95 / times**0.5:
            faults.append(f"{id}: {what}: values are {gap:.4f} from an end, {distance:.3f} from an even spread")
        physics = name not in ("delay", "noise", "view") and key != "color" and not name.startswith("light ")
        if moved < MOVED if physics else seen == 0:
            faults.append(f"{id}: {what} makes no difference")
        if not physics and moved > 0:
            faults.append(f"{id}: {what} moves bodies")
        effect = f"{moved * 1e3:.4g} mm" if physics else f"{seen:.3g} seen"
        rows.append([id, what, f"{100 * gap:.2f} %", f"{distance:.3f}", effect, f"{milliseconds:.1f}"])
    return rows, faults


# ---- growth ----


def reset_over_and_over(case, times):
    """Numbers of this process after each of `times` resets with one action."""
    env = ambf_gym.make(case.id, **case.options).unwrapped
    action = np.full(env.action_size, 0.5, np.float32)
    for seed in range(times):
        env.reset(seed=seed)
        env.step(action)
        yield support.process_numbers(os.getpid())
    env.close()


def make_over_and_over(case, times):
    """The same, of environments made, moved by one action, and closed."""
    for seed in range(times):
        env = ambf_gym.make(case.id, **case.options)
        env.reset(seed=seed)
        env.step(np.full(env.unwrapped.action_size, 0.5, np.float32))
        env.close()
        yield support.process_numbers(os.getpid())


def growth(over_and_over, case, times):
    """(row for a table, what is wrong) of one case."""
    begun, numbers = time.process_time(), list(over_and_over(case, times))
    milliseconds = (time.process_time() - begun) / times * 1e3
    settled = numbers[min(SETTLING, times) - 1 :]
    first, last = settled[0], settled[-1]
    most = max(each["memory"] for each in settled) / first["memory"] - 1
    more = {what: last[what] - first[what] for what in ("threads", "files")}
    faults = [f"{case.name}: {count} {what} more" for what, count in more.items() if count > 0]
    if most > GROWTH:
        faults.append(f"{case.name}: memory grew by {100 * most:.2f} %")
    memory = f"{first['memory']:.1f}, {last['memory']:.1f}"
    row = [f"{times} x {case.name}", memory, f"{100 * most:+.2f} %", f"{more['threads']}, {more['files']}"]
    return [*row, f"{milliseconds:.1f}"], faults


def of_its_own(function, *arguments):
    """What a function returns in a process of its own, whose memory is that of the case alone."""
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        return pool.apply(function, arguments)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="PART", help="randomised, resets, makes; by default all")
    parser.add_argument("--share", type=float, default=1.0, help="of the resets and environments")
    parser.add_argument("--only", default="", help="a part of the name of what is run")
    options = parser.parse_args(arguments)
    parts = options.parts or ["randomised", "resets", "makes"]
    if not set(parts) <= {"randomised", "resets", "makes"} or not 0 < options.share <= 1:
        parser.error("parts are randomised, resets and makes; --share is above 0, at most 1")
    print(support.machine())
    faults = []
    if "randomised" in parts:
        rows = []
        for id in RANGES:
            if options.only in id:
                more, wrong = of_its_own(randomised, id, max(20, round(1000 * options.share)))
                rows, faults = rows + more, faults + wrong
        head = ["environment", "drawn", "from an end", "from even", "effect", "CPU a reset, ms"]
        support.table(rows, head)
    for part, over_and_over, cases in (("resets", reset_over_and_over, RESET), ("makes", make_over_and_over, MADE)):
        if part in parts:
            rows = []
            for case in cases:
                if options.only in case.name:
                    row, wrong = of_its_own(
                        growth, over_and_over, case, max(2 * SETTLING, round(case.times * options.share))
                    )
                    rows, faults = [*rows, row], faults + wrong
            support.table(rows, [part, "MB after 100, at the end", "most", "threads, files more", "CPU each, ms"])
    for fault in faults:
        print("FAULT:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
