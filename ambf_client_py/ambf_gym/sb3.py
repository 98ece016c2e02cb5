"""Vectors of these environments as stable-baselines3 takes them; it does not take gymnasium's."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv

from .vector import GoalVectorEnv


class Sb3VecEnv(VecEnv):  # type: ignore[misc]  # stable-baselines3 may be absent where types are checked
    """Environments over a WorldBatch: what DummyVecEnv of single ones returns, from `workers` processes."""

    def __init__(self, id: str, num_envs: int, workers: int = 1, **options: Any) -> None:
        """options: those of the environment."""
        self.render_mode = options.get("render_mode")
        self._inner: GoalVectorEnv = gymnasium.make_vec(  # type: ignore[assignment]
            id, num_envs, workers=workers, autoreset_mode=AutoresetMode.SAME_STEP, **options
        )
        super().__init__(num_envs, self._inner.single_observation_space, self._inner.single_action_space)
        self._actions: Any = None

    def reset(self) -> Any:
        """Begins episodes by the seeds that seed() has set."""
        seen, infos = self._inner.reset(seed=list(self._seeds) if any(s is not None for s in self._seeds) else None)
        self.reset_infos = self._split(infos)
        self._reset_seeds()
        self._reset_options()
        return seen

    def step_async(self, actions: NDArray[Any]) -> None:
        """Keeps them for step_wait()."""
        self._actions = actions

    def step_wait(self) -> tuple[Any, NDArray[np.float32], NDArray[np.bool_], list[dict[str, Any]]]:
        """Observations (those of the next episode where one has ended), rewards, whether it ended, infos."""
        seen, rewards, terminated, truncated, merged = self._inner.step(self._actions)
        infos = self._split(merged)
        for number in np.flatnonzero(terminated | truncated):
            ended = infos[number]
            infos[number] = {**ended["final_info"], "terminal_observation": ended["final_obs"]}
            self.reset_infos[number] = {k: v for k, v in ended.items() if k not in ("final_info", "final_obs")}
        for number, info in enumerate(infos):
            info["TimeLimit.truncated"] = bool(truncated[number] and not terminated[number])
        return seen, rewards.astype(np.float32), terminated | truncated, infos

    def close(self) -> None:
        """Ends the workers."""
        self._inner.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """Of the environments, bare of wrappers."""
        return [getattr(self._inner.envs[number], attr_name) for number in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Of the environments."""
        for number in self._get_indices(indices):
            setattr(self._inner.envs[number], attr_name, value)

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **options: Any) -> list[Any]:
        """What a method of the environments returns, such as compute_reward for hindsight replay."""
        chosen = self._get_indices(indices)
        return [getattr(self._inner.envs[number], method_name)(*args, **options) for number in chosen]

    def env_is_wrapped(self, wrapper_class: type, indices: Any = None) -> list[bool]:
        """None is."""
        return [False for _ in self._get_indices(indices)]

    def get_images(self) -> Sequence[Any]:
        """Pictures, in the render mode "rgb_array"."""
        return self._inner.render()

    def _split(self, merged: dict[str, Any]) -> list[dict[str, Any]]:
        """Infos of each environment, from gymnasium's arrays with masks."""
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for name, values in merged.items():
            if name.startswith("_"):
                continue
            for number in _present(merged.get(f"_{name}"), self.num_envs):
                value = values[number] if not isinstance(values, dict) else _part(values, number)
                infos[number][name] = value.item() if isinstance(value, np.generic) else value
        return infos


def _present(mask: NDArray[np.bool_] | None, count: int) -> Iterable[int]:
    return range(count) if mask is None else np.flatnonzero(mask).tolist()


def _part(values: dict[str, Any], number: int) -> dict[str, Any]:
    """What a dict of arrays has of one environment."""
    return {
        name: _part(each, number) if isinstance(each, dict) else each[number]
        for name, each in values.items()
        if not name.startswith("_") and (values.get(f"_{name}") is None or values[f"_{name}"][number])
    }
