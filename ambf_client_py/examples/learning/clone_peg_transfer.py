"""A small network learns to transfer rings from a recorded data set of the expert: behaviour cloning, by numpy alone.

    ./dev shell -- python ambf_client_py/examples/learning/clone_peg_transfer.py [--episodes 60] [--epochs 150]
        [--judged 50] [--data FOLDER] [--model clone.npz]

Records the expert's episodes as a data set (or reads the one that is there), fits actions to what was seen, and prints
the clone's rate beside the expert's, on seeds that were not recorded. All begin with some random actions, so that no
two are alike. The clone is also a policy for play:

    CLONE=clone.npz python3 -m ambf_gym.play ambf/PegTransfer-v0 --policy clone_peg_transfer.py
"""

import argparse
import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from ambf_tools import dataset
from numpy.typing import NDArray

ID = "ambf/PegTransfer-v0"
RANGES = {"ring2": {"friction": [0.7, 1.1]}, "gravity": [[0, 0, -10.3], [0, 0, -9.3]]}
ASIDE = 5  # random actions that begin an episode; nobody learns from them
UNSEEN = 1_000_000  # seeds from here on are never recorded
Numbers = NDArray[np.float64]
Policy = Callable[[dict[str, Any]], NDArray[Any]]


def begin_aside(make_policy: Callable[[Any], Policy]) -> Callable[[Any], Policy]:
    """The same policy, after some random actions by the episode's own generator."""

    def make(env: Any) -> Policy:
        left = [env.np_random.uniform(-1, 1, env.action_size) for _ in range(ASIDE)]
        for action in left:
            action[-1] = 1.0
        policy: Policy | None = None

        def act(observation: dict[str, Any]) -> NDArray[Any]:
            nonlocal policy
            if left:
                return np.asarray(left.pop())
            policy = policy or make_policy(env)
            return policy(observation)

        return act

    return make


def features(observation: NDArray[Any], goal: NDArray[Any]) -> Numbers:
    """What the network sees of one row, or of many: positions in centimetres, and their differences finely, too.

    The columns are those that PegBoardEnv describes.
    """
    seen, place = np.asarray(observation, np.float64), np.asarray(goal, np.float64)[..., :3]
    gripper, target, jaws, ring = seen[..., 0:3], seen[..., 3:6], seen[..., 6:8], seen[..., 8:11]
    ways = np.concatenate([ring - target, place - ring, target - gripper, place - target], axis=-1)
    heights = target[..., 2:3]
    parts = [100 * ways, np.tanh(ways / 0.004), 100 * (heights - 0.07), 10 * (jaws - 0.1), 10 * seen[..., 18:24]]
    return np.concatenate(parts, axis=-1)


class Clone:
    """A perceptron with two hidden layers; it sees the newest row and the one before."""

    def __init__(self, weights: list[Numbers]) -> None:
        self.weights = weights

    def layers(self, inputs: Numbers) -> list[Numbers]:
        """Of each layer what it gives on; the last one are actions."""
        out = [inputs]
        for k in range(0, len(self.weights), 2):
            values = out[-1] @ self.weights[k] + self.weights[k + 1]
            out.append(np.tanh(values) if k < len(self.weights) - 2 else values)
        return out

    def make_policy(self, env: Any) -> Policy:
        before: list[Numbers] = []

        def act(observation: dict[str, Any]) -> NDArray[Any]:
            now = features(observation["observation"], observation["desired_goal"])
            inputs = np.concatenate([now, before[-1] if before else now])
            before[:] = [now]
            return np.asarray(np.clip(self.layers(inputs[None])[-1][0], -1, 1), np.float32)

        return act


def rows_of(data: dataset.Dataset) -> tuple[Numbers, Numbers]:
    """Inputs and actions of all episodes that succeeded."""
    inputs, actions = [], []
    for episode in data.episodes:
        if episode.success:
            columns = episode.columns
            now = features(columns["observation.state"], columns["observation.desired_goal"])[ASIDE:]
            inputs.append(np.concatenate([now, np.concatenate([now[:1], now[:-1]])], axis=1))
            actions.append(columns["action"][ASIDE:].astype(np.float64))
    return np.concatenate(inputs), np.concatenate(actions)


def fit(inputs: Numbers, actions: Numbers, epochs: int, width: int = 128, seed: int = 0) -> Clone:
    """Least squares by Adam, with a step size that falls to 0."""
    random = np.random.default_rng(seed)
    sizes = [inputs.shape[1], width, width, actions.shape[1]]
    weights: list[Numbers] = []
    for fan_in, fan_out in zip(sizes[:-1], sizes[1:], strict=True):
        weights += [random.normal(0, fan_in**-0.5, (fan_in, fan_out)), np.zeros(fan_out)]
    clone = Clone(weights)
    means, squares = [np.zeros_like(each) for each in weights], [np.zeros_like(each) for each in weights]
    batch, updates = 128, 0
    total = epochs * (len(inputs) // batch)
    for _ in range(epochs):
        order = random.permutation(len(inputs))
        for first in range(0, len(inputs) - batch + 1, batch):
            chosen = order[first : first + batch]
            layers = clone.layers(inputs[chosen])
            slope = (layers[-1] - actions[chosen]) / batch
            updates += 1
            size = 2e-3 * (1 - updates / (total + 1))
            for k in reversed(range(0, len(weights), 2)):
                slopes = [layers[k // 2].T @ slope, slope.sum(0)]
                slope = (slope @ weights[k].T) * (1 - layers[k // 2] ** 2)
                for n, each in zip((k, k + 1), slopes, strict=True):
                    means[n] += 0.1 * (each - means[n])
                    squares[n] += 0.001 * (each**2 - squares[n])
                    mean, square = means[n] / (1 - 0.9**updates), squares[n] / (1 - 0.999**updates)
                    weights[n] -= size * mean / (np.sqrt(square) + 1e-8)
    return clone


def rate(make_policy: Callable[[Any], Policy], episodes: int) -> float:
    """The share of unseen episodes that end in success."""
    judged = dataset.record(ID, episodes, UNSEEN, begin_aside(make_policy), randomization=RANGES)
    return float(np.mean([episode.success for episode in judged.episodes]))


def load(path: str | Path) -> Clone:
    """A clone that was saved."""
    with np.load(path) as saved:
        return Clone([saved[f"arr_{k}"] for k in range(len(saved.files))])


def make_policy(env: Any) -> Policy:
    """For ambf_gym.play: the clone that the variable CLONE names."""
    return load(os.environ.get("CLONE", "clone.npz")).make_policy(env)


def expert(env: Any) -> Policy:
    """The environment's own policy."""
    return env.expert()  # type: ignore[no-any-return]


def main(arguments: list[str] | None = None) -> tuple[float, float]:
    """The program; the rates of the clone and of the expert."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--episodes", type=int, default=60, help="to record and to learn from")
    parser.add_argument("--epochs", type=int, default=150)
    parser.add_argument("--judged", type=int, default=50, help="episodes that both are judged by")
    parser.add_argument("--data", type=Path, default=Path("peg_transfer_expert"), help="a folder")
    parser.add_argument("--model", type=Path, default=Path("clone.npz"))
    options = parser.parse_args(arguments)
    started = time.monotonic()
    if not options.data.exists():
        recorded = dataset.record(ID, options.episodes, policy=begin_aside(expert), randomization=RANGES)
        dataset.write(recorded, options.data, "lerobot-2.1")
    inputs, actions = rows_of(dataset.read(options.data))
    print(f"{len(inputs)} rows of {options.data}, {time.monotonic() - started:.0f} s")
    clone = fit(inputs, actions, options.epochs)
    error = float(np.sqrt(np.mean((clone.layers(inputs)[-1] - actions) ** 2)))
    np.savez(options.model, *clone.weights)
    print(f"fitted to {error:.3f} of an action, {time.monotonic() - started:.0f} s")
    rates = rate(clone.make_policy, options.judged), rate(expert, options.judged)
    print(f"clone: {100 * rates[0]:.1f} %, expert: {100 * rates[1]:.1f} % of {options.judged} unseen episodes")
    print(f"{time.monotonic() - started:.0f} s")
    return rates


if __name__ == "__main__":
    main()
