"""What train_psm_reach.py has learned, by numpy alone: for programs that have no torch, such as those of ROS.

POLICY=psm_reach/policy.npz python -m ambf_gym.play ambf/PsmReach-v0 --policy psm_policy.py
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

ID = "ambf/PsmReach-v0"
UNSEEN = 1_000_000  # seeds from here on are never trained with
Floats = NDArray[np.float32]
Observation = dict[str, Any]
Act = Callable[[Observation], Any]


class Policy:
    """A perceptron: of an observation, the way of the tip's target."""

    def __init__(self, weights: list[Floats]) -> None:
        """weights: of each layer the matrix (inputs, outputs) and what is added."""
        self.weights = weights

    @classmethod
    def load(cls, file: str | Path) -> Policy:
        """As save() wrote it."""
        with np.load(file) as saved:
            return cls([saved[f"arr_{k}"] for k in range(len(saved.files))])

    def save(self, file: str | Path) -> None:
        """As numpy's .npz."""
        np.savez(file, *self.weights)

    def __call__(self, observation: Observation) -> Floats:
        """The action, of one observation or of many (one a row)."""
        values = features(observation)
        for k in range(0, len(self.weights), 2):
            values = values @ self.weights[k] + self.weights[k + 1]
            values = np.maximum(values, 0) if k < len(self.weights) - 2 else np.tanh(values)
        return np.asarray(values, np.float32)


def features(observation: Observation) -> Any:
    """What networks see, of arrays of numpy or of torch: the way to the goal, in centimetres, the joints, and the tip's
    target. Raw, all of these are within a few hundredths, which networks would learn slowly."""
    way = 100 * (observation["desired_goal"] - observation["achieved_goal"])
    seen = observation["observation"]
    parts = [way, seen[..., :-3], 20 * seen[..., -3:]]
    if isinstance(way, np.ndarray):
        return np.concatenate(parts, axis=-1)
    import torch

    return torch.cat(parts, dim=-1)


class WrongGoal(gymnasium.Wrapper[Any, Any, Any, Any]):
    """Another goal of the same kind is seen in place of the episode's; rewards and success are of the latter."""

    def reset(self, **options: Any) -> tuple[Any, dict[str, Any]]:
        observation, info = self.env.reset(**options)
        self._seen = self.unwrapped.sample_goal().astype(np.float32)  # type: ignore[attr-defined]
        return {**observation, "desired_goal": self._seen.copy()}, info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        observation, reward, terminated, truncated, info = self.env.step(action)
        return {**observation, "desired_goal": self._seen.copy()}, reward, terminated, truncated, info


def episodes(env: gymnasium.Env[Any, Any], act: Act, seeds: range) -> list[bool]:
    """Which episodes end with the tip at the goal."""
    successes = []
    for seed in seeds:
        observation, info = env.reset(seed=seed)
        over = False
        while not over:
            observation, _, terminated, truncated, info = env.step(act(observation))
            over = terminated or truncated
        successes.append(bool(info["is_success"]))
    return successes


def make_policy(env: Any) -> Policy:
    """For ambf_gym.play: the policy that the variable POLICY names."""
    return Policy.load(os.environ.get("POLICY", "psm_reach/policy.npz"))
