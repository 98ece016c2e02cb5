"""Many environments of one kind over a WorldBatch: physics on several processes, bit-equal to single environments."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import gymnasium
import numpy as np
from ambf_core import WorldBatch
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space, concatenate, create_empty_array
from numpy.typing import NDArray

from .goals import GoalEnv
from .options import goal_of

_HOME = "home"


class GoalVectorEnv(gymnasium.vector.VectorEnv[Any, Any, Any]):
    """What gymnasium's SyncVectorEnv of single ones returns, all autoreset modes and `reset_mask` included."""

    def __init__(
        self,
        env_type: type[GoalEnv],
        num_envs: int = 1,
        max_episode_steps: int | None = None,
        workers: int = 1,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        render_mode: str | None = None,
        **options: Any,
    ) -> None:
        """workers: processes that step worlds, this one among them; options: those of the environment."""
        if options.pop("backend", "core") != "core":
            raise ValueError("a vector of environments has the backend 'core'")
        if max_episode_steps is not None and max_episode_steps < 1:
            raise ValueError(f"max_episode_steps={max_episode_steps}: an episode has at least one step")
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.num_envs, self.render_mode, self._limit = num_envs, render_mode, max_episode_steps
        self._batch = WorldBatch(
            *env_type.files, world=env_type.ground, without=env_type.without, n=num_envs, workers=workers
        )
        try:
            self.envs = [
                env_type(render_mode=render_mode, backend=self._batch.view(number), **options)
                for number in range(num_envs)
            ]
            self.envs[0].settle(self._batch)
            self._batch.snapshot(_HOME)
        except BaseException:
            self._batch.close()
            raise
        self.metadata = {**self.envs[0].metadata, "autoreset_mode": self.autoreset_mode}
        self.single_action_space = self.envs[0].action_space
        self.single_observation_space = self.envs[0].observation_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._seen: list[Any] = [None] * num_envs
        self._observations: Any = create_empty_array(self.single_observation_space, num_envs, np.zeros)
        self._elapsed = np.zeros(num_envs, np.int64)
        self._ended = np.zeros(num_envs, np.bool_)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begins episodes in all, or in those of options["reset_mask"]; seed + i is the seed of number i."""
        seeds: list[int | None] = [None] * self.num_envs
        if seed is not None:
            seeds = [seed + i for i in range(self.num_envs)] if isinstance(seed, int) else list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds for {self.num_envs} environments")
        others = dict(options or {})
        mask = others.pop("reset_mask", np.ones(self.num_envs, np.bool_))
        if not isinstance(mask, np.ndarray) or mask.shape != (self.num_envs,) or mask.dtype != np.bool_:
            raise ValueError(f"reset_mask: {mask!r} is not an array of {self.num_envs} truth values")
        if not mask.any():
            raise ValueError("reset_mask names no environment")
        if any(seen is None for seen in np.array(self._seen, object)[~mask]):
            raise ValueError("the first reset is of all environments")
        goal_of(others, self.envs[0].goal_size)
        infos: dict[str, Any] = {}
        for number, info in self._begin(mask, seeds, others or None):
            infos = self._add_info(infos, info, number)
        return self._shown(), infos

    def step(
        self, actions: Any
    ) -> tuple[Any, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """One action each. Nothing has moved where one of them raises."""
        if self.autoreset_mode == AutoresetMode.DISABLED and self._ended.any():
            raise RuntimeError(f"environments {np.flatnonzero(self._ended).tolist()} have ended: reset them")
        actions = np.asarray(actions)
        if actions.shape != self.action_space.shape:
            raise ValueError(f"actions of shape {actions.shape}, not {self.action_space.shape}")
        due = self._ended & (self.autoreset_mode == AutoresetMode.NEXT_STEP)
        kept = [each.copy() for each in self._batch.commands.arrays()]
        try:
            for number in np.flatnonzero(~due):
                self.envs[number].act(actions[number])
        except BaseException:
            for array, before in zip(self._batch.commands.arrays(), kept, strict=True):
                array[...] = before
            raise
        self._batch.step(self.envs[0].steps)
        rewards = np.zeros(self.num_envs)
        terminations, truncations = np.zeros((2, self.num_envs), np.bool_)
        infos: list[dict[str, Any]] = [{} for _ in self.envs]
        for number in np.flatnonzero(~due):
            outcome = self.envs[number].outcome()
            self._seen[number], rewards[number], terminations[number], truncations[number], infos[number] = outcome
            self._elapsed[number] += 1
            truncations[number] |= self._limit is not None and self._elapsed[number] >= self._limit
        self._ended = terminations | truncations
        merged: dict[str, Any] = {}
        if self.autoreset_mode == AutoresetMode.SAME_STEP:
            due = self._ended.copy()
            for number in np.flatnonzero(due):
                final = {"final_obs": self._seen[number], "final_info": infos[number]}
                merged = self._add_info(merged, final, number)
        if due.any():
            ended = self._ended.copy()
            for number, info in self._begin(due, [None] * self.num_envs, None):
                infos[number] = info
            self._ended = ended & (self.autoreset_mode == AutoresetMode.NEXT_STEP)
        for number, info in enumerate(infos):
            merged = self._add_info(merged, info, number)
        return self._shown(), rewards, terminations, truncations, merged

    def render(self) -> tuple[Any, ...]:
        """Pictures of all of them, as SyncVectorEnv's."""
        return self.call("render")

    def call(self, name: str, *args: Any, **kwargs: Any) -> tuple[Any, ...]:
        """Of each environment the method's result, or the attribute."""
        found = [getattr(each, name) for each in self.envs]
        return tuple(each(*args, **kwargs) if callable(each) else each for each in found)

    def get_attr(self, name: str) -> tuple[Any, ...]:
        """An attribute of each environment."""
        return self.call(name)

    @property
    def np_random_seed(self) -> tuple[int, ...]:  # type: ignore[override]  # as SyncVectorEnv's
        """Of each environment."""
        return self.get_attr("np_random_seed")

    @property  # type: ignore[misc]
    def np_random(self) -> tuple[np.random.Generator, ...]:  # type: ignore[override]  # as SyncVectorEnv's
        """Of each environment."""
        return self.get_attr("np_random")

    def close_extras(self, **options: Any) -> None:
        """Ends the workers."""
        if hasattr(self, "_batch"):  # gymnasium closes one whose constructor refused, too
            self._batch.close()

    def _begin(
        self, mask: NDArray[np.bool_], seeds: list[int | None], options: dict[str, Any] | None
    ) -> list[tuple[int, dict[str, Any]]]:
        self._batch.restore(_HOME, mask)
        self._elapsed[mask], self._ended[mask] = 0, False
        infos = []
        for number in np.flatnonzero(mask):
            self._seen[number], info = self.envs[number].begin(seeds[number], options)
            infos.append((int(number), info))
        return infos

    def _shown(self) -> Any:
        return deepcopy(concatenate(self.single_observation_space, self._seen, self._observations))
