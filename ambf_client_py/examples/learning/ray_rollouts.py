"""Episodes by many processes: Ray's workers, of this machine or of a cluster, each with an environment of its own.

    ./dev learn python ambf_client_py/examples/learning/ray_rollouts.py --workers 2 --episodes 200
    ./dev learn python ambf_client_py/examples/learning/ray_rollouts.py --address 10.0.0.1:6379 --workers 16

An episode is what its seed makes of it, on whatever worker: after one has died, others run what it had not handed in,
and every seed is there once. --kill 20 kills a worker after so many episodes, to see that. Who acts is the
environment's expert, or a policy of train_psm_reach.py (--policy policy.npz). --out writes a line for each episode;
two runs have equal files, however many workers there were.

Ray's own clusters do the rest: `ray start --head` on one machine, `ray start --address=...` on the others, this wheel
in the same Python on each.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import os
import time
from collections import deque
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

import ambf_gym
import numpy as np


class Episode(NamedTuple):
    """How one ended. digest: of all that was seen and done, so of two that are alike in every bit."""

    seed: int
    success: bool
    steps: int
    reward: float
    digest: str


def run(env: Any, make_policy: Callable[[Any], Callable[[Any], Any]], seed: int) -> Episode:
    """The episode of a seed."""
    said = hashlib.sha256()
    observation, info = env.reset(seed=seed)
    act, steps, total, over = make_policy(env.unwrapped), 0, 0.0, False
    while not over:
        action = np.asarray(act(observation), np.float32)
        for each in (*(observation[name] for name in sorted(observation)), action):
            said.update(each.tobytes())
        observation, reward, terminated, truncated, info = env.step(action)
        steps, total, over = steps + 1, total + float(reward), terminated or truncated
    return Episode(seed, bool(info["is_success"]), steps, total, said.hexdigest()[:16])


class Ledger:
    """Which seeds are to be run, which are with whom, and what came back: each seed once, though workers die."""

    def __init__(self, seeds: Iterable[int]) -> None:
        self.waiting = deque(seeds)
        self.out: dict[Any, list[int]] = {}  # seeds that a worker has, by worker
        self.done: dict[int, Episode] = {}
        if len(set(self.waiting)) != len(self.waiting):
            raise ValueError("a seed is there twice")

    @property
    def finished(self) -> bool:
        """Whether every seed's episode is there."""
        return not self.waiting and not self.out

    def hand_out(self, worker: Any, most: int) -> list[int]:
        """Seeds for a worker that has none; an empty list where none is left."""
        if worker in self.out:
            raise ValueError(f"{worker!r} has seeds that it has not handed in")
        seeds = [self.waiting.popleft() for _ in range(min(most, len(self.waiting)))]
        if seeds:
            self.out[worker] = seeds
        return seeds

    def hand_in(self, worker: Any, episodes: Iterable[Episode]) -> None:
        """What a worker has made of its seeds. Raises ValueError where these are not its seeds."""
        made = {each.seed: each for each in episodes}
        if sorted(made) != sorted(self.out.get(worker, [])):
            raise ValueError(f"{worker!r} hands in {sorted(made)} for {sorted(self.out.get(worker, []))}")
        del self.out[worker]
        self.done.update(made)

    def lose(self, worker: Any) -> None:
        """A worker is gone: others shall run what it had, before all else."""
        self.waiting.extendleft(reversed(self.out.pop(worker, [])))


class Runner:
    """In a worker's process: an environment, and who acts in it."""

    def __init__(self, id: str, policy: Callable[[Any], Any] | None) -> None:
        """policy: None: the environment's expert."""
        self.env = ambf_gym.make(id)
        self.make_policy = (lambda env: env.expert()) if policy is None else (lambda env: policy)

    def node(self) -> str:
        """Which of the cluster's nodes it runs on."""
        import ray

        return str(ray.get_runtime_context().get_node_id())

    def run(self, seeds: list[int]) -> list[Episode]:
        """Their episodes."""
        return [run(self.env, self.make_policy, seed) for seed in seeds]


class Crew:
    """Ray's workers and a ledger of what they do."""

    def __init__(self, ledger: Ledger, start: Callable[[], Any], workers: int, batch: int) -> None:
        """start: makes a Runner somewhere; batch: seeds that a worker has at a time. Waits until all are there."""
        import ray

        self.ray, self.ledger, self.start, self.batch = ray, ledger, start, batch
        self.lost, self.most = 0, workers + 10  # workers that died, and may die
        self.actors = dict(enumerate([start() for _ in range(workers)]))
        self.nodes: set[str] = set(ray.get([each.node.remote() for each in self.actors.values()]))
        self.running: dict[Any, int] = {}  # what is awaited, and from whom

    def work(self, kill_after: int = 0) -> None:
        """Runs all. kill_after: kills a worker that is at work, once so many episodes are there.

        Raises RuntimeError where workers die over and over.
        """
        for number in self.actors:
            self._employ(number)
        while self.running:
            (ready, *_), _ = self.ray.wait(list(self.running), num_returns=1)
            number = self.running.pop(ready)
            try:
                self.ledger.hand_in(number, self.ray.get(ready))
            except self.ray.exceptions.RayActorError as error:
                self.lost += 1
                if self.lost > self.most:
                    raise RuntimeError(f"{self.lost} workers have died") from error
                self.ledger.lose(number)
                self.actors[number] = self.start()
            if 0 < kill_after <= len(self.ledger.done) and self.running:
                kill_after = 0
                self.ray.kill(self.actors[next(iter(self.running.values()))])
            self._employ(number)

    def _employ(self, number: int) -> None:
        seeds = self.ledger.hand_out(number, self.batch)
        if seeds:
            self.running[self.actors[number].run.remote(seeds)] = number


def main(arguments: list[str] | None = None) -> dict[int, Episode]:
    """The program; the episodes by seed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--id", default="ambf/PsmReach-v0", help="of an environment")
    parser.add_argument("--episodes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0, help="of the first episode")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--batch", type=int, default=5, help="episodes that a worker runs before it hands them in")
    parser.add_argument("--policy", type=Path, help="policy.npz of train_psm_reach.py; by default the expert")
    parser.add_argument("--address", help="of a cluster, or auto; by default Ray is started here for this run")
    parser.add_argument("--kill", type=int, default=0, help="kill a worker after so many episodes")
    parser.add_argument("--out", type=Path, help="CSV of the episodes")
    options = parser.parse_args(arguments)
    if min(options.episodes, options.workers, options.batch) < 1:
        parser.error("--episodes, --workers, --batch: at least one")
    import ray

    policy = None
    if options.policy is not None:
        import psm_policy

        ray.cloudpickle.register_pickle_by_value(psm_policy)  # workers elsewhere do not have this file
        policy = psm_policy.Policy.load(options.policy)
    cpus = None if options.address else max(options.workers, os.cpu_count() or 1)
    ray.init(address=options.address, num_cpus=cpus, include_dashboard=False if options.address is None else None)
    remote = ray.remote(num_cpus=1, max_restarts=0)(Runner)
    ledger = Ledger(range(options.seed, options.seed + options.episodes))
    try:
        crew = Crew(ledger, lambda: remote.remote(options.id, policy), options.workers, options.batch)
        begun = time.monotonic()
        crew.work(options.kill)
        seconds = time.monotonic() - begun
    finally:
        ray.shutdown()
    episodes = [ledger.done[seed] for seed in sorted(ledger.done)]
    if options.out is not None:
        with options.out.open("w", newline="") as file:
            csv.writer(file).writerows([Episode._fields, *episodes])
    steps = sum(each.steps for each in episodes)
    print(f"{options.workers} workers on {len(crew.nodes)} nodes; {crew.lost} died")
    print(f"{len(episodes)} episodes, {steps} env steps in {seconds:.1f} s: {steps / seconds:.0f} env steps/s")
    print(f"success: {100 * np.mean([each.success for each in episodes]):.1f} %")
    return ledger.done


if __name__ == "__main__":
    main()
