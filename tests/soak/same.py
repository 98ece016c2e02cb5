"""Is a world the same at each of 10 000 steps, wherever and after whatever it runs?

    ./dev shell -- python tests/soak/same.py [--share 0.1] [--only PART]

A run is some episodes of an environment with contacts, randomised, with resets between them; of each step of physics
its state_hash goes into a digest, and so does all that each action returns.
processes: three fresh ones give one digest. beside: so does the fifth of eight worlds that take turns in one process,
the others being different ones. history: a reset in an environment that has run other episodes gives the episode of a
fresh one. workers: eight worlds of a batch have equal hashes on one worker and on four. Ends with 1 where one differs.
"""

import argparse
import hashlib
import json
import subprocess
import sys
from pathlib import Path

import ambf_gym
import gymnasium
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/acceptance"), str(ROOT / "tests/benchmarks")]
import support  # noqa: E402

STEPS = 10_000
ACTIONS = 25  # an episode: the ring is grasped and carried by then
RANGES = {
    "ambf/PegTransfer-v0": {"ring2": {"friction": [0.7, 1.1]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
    "ambf/PsmReach-v0": {"baselink-yawlink": {"damping": [0.0, 0.2]}},
    "ambf/NeedlePick-v0": {"needle": {"friction": [1.2, 1.8]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]},
}
OTHERS = ("Arm7Reach", "PsmReach", "EcmReach", "RingLift", "RingWire", "NeedlePick", "TissueRetract")


def episode(env, seed, actions=ACTIONS, hashed=1):
    """Yields the digest of one after each action; hashed: a state hash of every so many steps."""
    inner, digest = env.unwrapped, hashlib.sha256()

    def seen(observation, *more):
        for name in sorted(observation):
            digest.update(np.ascontiguousarray(observation[name]).tobytes())
        digest.update(json.dumps(more, default=str, sort_keys=True).encode())

    observation, info = inner.reset(seed=seed)
    seen(observation, info)
    act = inner.expert()
    for _ in range(actions):
        inner.act(act(observation))
        for _ in range(inner.steps // hashed):
            inner.world.step(hashed)
            digest.update(inner.world.hash().to_bytes(8, "little"))
        observation, *outcome = inner.outcome()
        seen(observation, *outcome)
        yield digest.hexdigest()


def run(id, steps):
    """Yields the digest so far after each action of as many episodes as have so many steps."""
    env = ambf_gym.make(id, randomization=RANGES.get(id))
    whole = hashlib.sha256()
    for seed in range(max(1, steps // (ACTIONS * env.unwrapped.steps))):
        last = ""
        for last in episode(env, seed):
            yield last
        whole.update(last.encode())
    env.close()
    yield whole.hexdigest()


def last_of(digests):
    *_, last = digests
    return last


def fresh(*arguments):
    """What this program prints in a process of its own."""
    done = subprocess.run([sys.executable, __file__, *map(str, arguments)], capture_output=True, text=True, check=True)
    return done.stdout.split()[-1]


def processes(id, steps):
    """Digests of three fresh processes."""
    return [fresh("--digest", id, steps) for _ in range(3)]


def beside(id, steps):
    """The digest of a run among seven others, one action each in turns."""
    others = [ambf_gym.make(f"ambf/{name}-v0").unwrapped for name in OTHERS]
    random = np.random.default_rng(1)
    for number, other in enumerate(others):
        other.reset(seed=number)
    digests = []
    for turn, digest in enumerate(run(id, steps)):
        digests.append(digest)
        for other in others:
            if turn % 50 == 49:
                other.reset()
            other.act(random.uniform(-1, 1, other.action_size))
            other.world.step(other.steps)
    for other in others:
        other.close()
    return digests[-1]


def after_history(id, steps):
    """Digests of one episode, by an environment that ran others, and by a fresh one."""
    env = ambf_gym.make(id, randomization=RANGES.get(id))
    random = np.random.default_rng(2)
    for seed in range(100, 100 + max(2, steps // 5000)):
        env.reset(seed=seed)
        for _ in range(int(random.integers(1, 40))):
            env.step(random.uniform(-1, 1, env.unwrapped.action_size).astype(np.float32))
    used = last_of(episode(env, 7))
    env.close()
    return [used, fresh("--episode", id, 7)]


def on_workers(id, steps):
    """Digests of the hashes of eight worlds of a batch, on one worker and on four."""
    digests = []
    for workers in (1, 4):
        envs = gymnasium.make_vec(f"ambf_gym:{id}", num_envs=8, workers=workers, randomization=RANGES.get(id))
        random, digest = np.random.default_rng(3), hashlib.sha256()
        envs.reset(seed=3)
        inner = envs.envs[0]
        for action in range(max(1, steps // inner.steps)):
            if action % ACTIONS == ACTIONS - 1:
                envs.reset()
            envs.step(random.uniform(-1, 1, envs.action_space.shape).astype(np.float32))
            digest.update(repr(envs._batch.hashes()).encode())
        envs.close()
        digests.append(digest.hexdigest())
    return digests


PARTS = ("processes", "beside", "history", "workers")


def compare(part, id, steps):
    """Digests that shall be equal."""
    if part == "processes":
        return processes(id, steps)
    if part == "beside":
        return [fresh("--digest", id, steps), beside(id, steps)]
    return after_history(id, steps) if part == "history" else on_workers(id, steps)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--share", type=float, default=1.0, help="of the steps")
    parser.add_argument("--only", choices=PARTS)
    parser.add_argument("--id", choices=RANGES)
    parser.add_argument("--digest", nargs=2, metavar=("ID", "STEPS"), help="only print that of one run")
    parser.add_argument("--episode", nargs=2, metavar=("ID", "SEED"), help="only print that of one episode")
    options = parser.parse_args(arguments)
    if options.digest:
        print(last_of(run(options.digest[0], int(options.digest[1]))))
        return 0
    if options.episode:
        env = ambf_gym.make(options.episode[0], randomization=RANGES.get(options.episode[0]))
        print(last_of(episode(env, int(options.episode[1]))))
        env.close()
        return 0
    print(support.machine())
    rows, steps = [], round(STEPS * options.share)
    for id in RANGES if options.id is None else [options.id]:
        for part in PARTS if options.only is None else [options.only]:
            digests = compare(part, id, steps)
            rows.append([id, part, steps, "same" if len(set(digests)) == 1 else "DIFFERENT", digests[0][:12]])
            print(*rows[-1], flush=True)
    support.table(rows, ["environment", "part", "steps", "outcome", "digest"])
    return int(any(row[3] != "same" for row in rows))


if __name__ == "__main__":
    sys.exit(main())
