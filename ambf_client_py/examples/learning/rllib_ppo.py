"""The tip of a PSM learns to go to points: PPO by RLlib, from a dense reward (./dev learn has it).

python3 rllib_ppo.py [--seed 1] [--iterations 40] [--workers 1] [--csv rllib_ppo.csv] [--address HEAD:6379]

Episodes are run by Ray's workers, each with an environment of its own; with an address, on all machines of a cluster.
Prints the return of an episode while it learns, then how many of 100 goals that were never trained the last weights
reach. The csv has a row for each iteration.
"""

import argparse
import csv
import os
import time
from pathlib import Path
from typing import Any

os.environ.setdefault("RAY_worker_niceness", "0")  # at Ray's priority, 15, workers starve beside other work

import ambf_gym
import gymnasium
import numpy as np
import ray
import torch
from psm_policy import ID, UNSEEN, episodes, features
from ray.rllib.algorithms.algorithm import Algorithm
from ray.rllib.algorithms.ppo import PPOConfig
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig
from ray.tune.registry import register_env

REWARD_SCALE = 10.0  # of m: returns then lie within a few tens, which PPO's value function is clipped for
BATCH = 4000  # env steps between two updates: 80 episodes


class OneVector(gymnasium.Wrapper[Any, Any, Any, Any]):
    """features() in place of the dict of goals, and rewards in decimetres."""

    def __init__(self, env: gymnasium.Env[Any, Any]) -> None:
        super().__init__(env)
        size = features(env.observation_space.sample()).shape
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, size, np.float32)

    def reset(self, **options: Any) -> tuple[Any, dict[str, Any]]:
        observation, info = self.env.reset(**options)
        return features(observation), info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        observation, reward, terminated, truncated, info = self.env.step(action)
        return features(observation), REWARD_SCALE * float(reward), terminated, truncated, info


def make_env(context: Any = None) -> gymnasium.Env[Any, Any]:
    """context: RLlib's, of which nothing is used."""
    return OneVector(ambf_gym.make(ID, reward="dense"))


def make_algorithm(seed: int, workers: int) -> Algorithm:
    register_env("psm_reach", make_env)
    config = (
        PPOConfig()
        .environment("psm_reach")
        .env_runners(num_env_runners=workers, rollout_fragment_length="auto", sample_timeout_s=600)
        .learners(num_learners=0)
        .training(
            gamma=0.95,
            lr=1e-3,
            train_batch_size_per_learner=BATCH,
            minibatch_size=250,
            num_epochs=10,
            vf_clip_param=100.0,
            grad_clip=1.0,
        )
        .rl_module(model_config=DefaultModelConfig(fcnet_hiddens=[128, 128], fcnet_activation="tanh"))
        .debugging(seed=seed, log_level="ERROR")
    )
    return config.build_algo()


def reached(algorithm: Algorithm, count: int) -> float:
    """The share of unseen goals that the tip is at when the episode ends; actions are the means."""
    module = algorithm.get_module()

    def act(observation: Any) -> Any:
        with torch.no_grad():
            answer = module.forward_inference({"obs": torch.from_numpy(observation)[None]})["action_dist_inputs"][0]
        return np.clip(answer[: answer.shape[0] // 2].numpy(), -1.0, 1.0)

    env = make_env()
    ends = episodes(env, act, range(UNSEEN, UNSEEN + count))
    env.close()
    return float(np.mean(ends))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--iterations", type=int, default=40, help=f"of {BATCH} env steps each")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--episodes", type=int, default=100, help="unseen goals that the result is judged by")
    parser.add_argument("--csv", type=Path, default=Path("rllib_ppo.csv"))
    parser.add_argument("--address", help="of a cluster's head; without it Ray runs on this machine alone")
    options = parser.parse_args()
    torch.set_num_threads(1)
    here = Path(__file__).resolve().parent
    paths = os.pathsep.join([str(here), os.environ.get("PYTHONPATH", "")])
    ray.init(
        address=options.address,
        include_dashboard=False,
        log_to_driver=False,
        runtime_env={"env_vars": {"PYTHONPATH": paths}},
    )
    algorithm = make_algorithm(options.seed, options.workers)
    begun = time.monotonic()
    with options.csv.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["env steps", "seconds", "return"])
        for number in range(1, options.iterations + 1):
            result = algorithm.train()["env_runners"]
            steps, seconds = number * BATCH, time.monotonic() - begun
            mean = result["episode_return_mean"] / REWARD_SCALE
            rows.writerow([steps, f"{seconds:.1f}", f"{mean:.4f}"])
            print(f"{steps} steps, {seconds:.0f} s: return {mean:.3f} (m, of 50 actions)", flush=True)
    share = reached(algorithm, options.episodes)
    print(f"reached {100 * share:.1f} % of {options.episodes} unseen goals")
    algorithm.stop()
    ray.shutdown()


if __name__ == "__main__":
    main()
