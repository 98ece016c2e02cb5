"""Episodes recorded from an environment of ambf_gym."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .episodes import ACTION, DONE, REWARD, STATE, SUCCESS, Dataset, DatasetError, Episode, plain

Policy = Callable[[dict[str, Any]], NDArray[Any]]
# Of parts of observations; others: observation.<part>.
_NAMES = {"observation": STATE, "picture": "observation.images.view"}


def record(
    environment: str, episodes: int, seed: int = 0, policy: str | Callable[[Any], Policy] = "expert", **options: Any
) -> Dataset:
    """Runs episodes with the seeds `seed`, `seed` + 1, ... of an id of ambf_gym.

    policy: "expert", "random" (by a generator of the same seed), or what makes one of the environment for each episode;
    options: of the environment. Actions are recorded as they act: within -1 to 1.
    """
    import ambf_gym

    if options.get("observation", "state") not in ("state", "both"):
        raise ValueError("observation: data sets want numbers: 'state', or with pictures 'both'")
    env = ambf_gym.make(environment, **options)
    inner: Any = env.unwrapped
    words = (inner.__doc__ or environment).strip().splitlines()[0]
    fps = round(1.0 / (inner.steps * 0.001))
    dataset = Dataset(fps, words, str(inner.robot), environment, plain(options))
    try:
        for number in range(seed, seed + episodes):
            observation, info = env.reset(seed=number)
            act = _policy_of(policy, inner, number)
            rows: list[dict[str, Any]] = []
            over = False
            while not over:
                action = np.clip(np.asarray(act(observation), np.float32), -1, 1)
                row = {_NAMES.get(name, f"observation.{name}"): value for name, value in observation.items()}
                row["observation.sim_step"] = np.int64(inner.world.state.sim_step)
                observation, reward, terminated, truncated, after = env.step(action)
                over = terminated or truncated
                row |= {ACTION: action, REWARD: np.float32(reward), DONE: over, SUCCESS: bool(after["is_success"])}
                rows.append(row)
            columns = {name: np.array([row[name] for row in rows]) for name in rows[0]}
            dataset.episodes.append(Episode(columns, number, plain(info.get("randomization", {}))))
    finally:
        env.close()
    return dataset


def replay(dataset: Dataset, number: int) -> bool:
    """Whether the actions of an episode, from its seed on, give the recorded observations and rewards again."""
    import ambf_gym

    if not dataset.environment:
        raise DatasetError("a data set without an environment cannot be replayed")
    episode = dataset.episodes[number]
    env = ambf_gym.make(dataset.environment, **dataset.options)
    try:
        observation, _ = env.reset(seed=episode.seed)
        for row in range(len(episode)):
            for name, value in observation.items():
                if not np.array_equal(episode.columns[_NAMES.get(name, f"observation.{name}")][row], value):
                    return False
            observation, reward, *_ = env.step(episode.columns[ACTION][row])
            if np.float32(reward) != episode.columns[REWARD][row]:
                return False
        return True
    finally:
        env.close()


def _policy_of(policy: str | Callable[[Any], Policy], env: Any, seed: int) -> Policy:
    if policy == "expert":
        return env.expert()  # type: ignore[no-any-return]
    if policy == "random":
        random = np.random.default_rng(seed)
        return lambda observation: random.uniform(-1, 1, env.action_size)
    if isinstance(policy, str):
        raise ValueError(f"policy={policy!r}: 'expert', 'random', or a function")
    return policy(env)
