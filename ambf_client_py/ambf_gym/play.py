"""Runs episodes of an environment under a policy, and says how they ended: python -m ambf_gym.play ID.

    python -m ambf_gym.play ambf/PsmReach-v0 --expert
    python -m ambf_gym.play ambf/PsmReach-v0 --policy model.zip --backend ros
    python -m ambf_gym.play ambf/PsmReach-v0 --policy mine.py --record folder

With --watch it is to be seen, as fast as it would be: in a window of its own, or over ROS (--backend ros) in those of
the simulator that runs. In its own window Ctrl+P pauses, Space then goes on by one action, Alt+R begins the next
episode, and closing it ends the program; docs/keys.md has all keys. --record writes a data set (docs/datasets.md).
"""

from __future__ import annotations

import argparse
import runpy
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import ambf_gym

Policy = Callable[[dict[str, Any]], Any]
Maker = Callable[[Any], Policy]  # of the environment, for an episode that begins


def policy_of(source: str | None, environment: Any) -> Maker:
    """The expert's (None), that of a Python file with `make_policy(env)`, or a model of stable-baselines3 (.zip)."""
    if source is None:
        return lambda env: env.expert()
    if not Path(source).is_file():
        raise ValueError(f"{source}: there is no such file")
    if source.endswith(".py"):
        made = runpy.run_path(source).get("make_policy")
        if not callable(made):
            raise ValueError(f"{source} has no function make_policy(env)")
        return made  # type: ignore[no-any-return]
    from stable_baselines3 import SAC

    model = SAC.load(source, env=environment)
    return lambda env: lambda observation: model.predict(observation, deterministic=True)[0]


def play(environment: Any, make_policy: Maker, episodes: int, seed: int, say: Callable[[str], Any] = print) -> float:
    """The share of episodes that end in success; those that somebody ends in the window do not count."""
    successes = played = 0
    window = environment.unwrapped.window
    for number in range(seed, seed + episodes):
        observation, info = environment.reset(seed=number)
        act, steps, total, over = make_policy(environment.unwrapped), 0, 0.0, False
        while not over:
            action = np.asarray(act(observation), np.float32)
            observation, reward, terminated, truncated, info = environment.step(action)
            steps, total, over = steps + 1, total + reward, terminated or truncated
            if window is not None and window.closed:
                say("the window was closed")
                return successes / max(1, played)
        if "window_reset" in info:
            say(f"seed {number}: ended in the window after {steps} actions")
            continue
        successes, played = successes + info["is_success"], played + 1
        end = "success" if info["is_success"] else f"diverged: {info['diverged']}" if "diverged" in info else "failure"
        say(f"seed {number}: {end} after {steps} actions, return {total:.2f}")
    return successes / max(1, played)


def main(arguments: list[str] | None = None) -> int:
    """The program; its exit code is 2 for what it cannot do."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("id", help="of an environment, such as ambf/PsmReach-v0")
    who = parser.add_mutually_exclusive_group()
    who.add_argument("--expert", action="store_true", help="the environment's own policy; so it is without --policy")
    who.add_argument("--policy", help="a Python file with make_policy(env), or a model of stable-baselines3 (.zip)")
    parser.add_argument("--episodes", type=int, default=5)
    parser.add_argument("--seed", type=int, default=0, help="of the first episode; the others follow")
    parser.add_argument("--backend", choices=("core", "ros"), default="core")
    parser.add_argument("--watch", action="store_true", help="in a window, where actions take their time")
    parser.add_argument("--record", type=Path, help="a folder that does not exist yet, for a data set of the episodes")
    options = parser.parse_args(arguments)
    if options.episodes < 1:
        parser.error("--episodes: at least one")
    if options.watch and options.record is not None:
        parser.error("--watch: not while recording")
    try:
        environment = ambf_gym.make(options.id, backend=options.backend, render_mode="human" if options.watch else None)
    except Exception as error:
        print(f"{options.id}: {error}", file=sys.stderr)
        return 2
    try:
        made = policy_of(options.policy, environment)
        if options.record is None:
            share = play(environment, made, options.episodes, options.seed)
        else:
            environment.close()
            from ambf_tools import dataset

            recorded = dataset.record(options.id, options.episodes, options.seed, made, backend=options.backend)
            dataset.write(recorded, options.record, "lerobot-2.1")
            share = float(np.mean([episode.columns["next.success"][-1] for episode in recorded.episodes]))
    except (ValueError, ImportError) as error:
        print(error, file=sys.stderr)
        return 2
    finally:
        environment.close()
    print(f"{options.id}: {100 * share:.1f} % of {options.episodes} episodes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
