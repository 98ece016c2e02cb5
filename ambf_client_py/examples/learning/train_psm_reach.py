"""The tip of a PSM learns to go to points: SAC with hindsight replay, by stable-baselines3 (./dev learn has it).

python3 train_psm_reach.py [--seed 1] [--steps 20000] [--folder psm_reach] [--wrong-goal]

Writes curve.csv and curve.png (success while it learns), model.zip, policy.npz (the same, without torch), and prints
how many of 200 goals that were never trained the last weights reach. --replay model.zip only does the latter.
--wrong-goal is the control run: what learns and what is judged sees another goal than the one that counts, and so
reaches next to none.
"""

import argparse
import csv
import time
from pathlib import Path
from typing import Any

import ambf_gym
import gymnasium
import numpy as np
import torch
from psm_policy import ID, UNSEEN, Policy, WrongGoal, episodes, features
from stable_baselines3 import SAC, HerReplayBuffer
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.torch_layers import BaseFeaturesExtractor


def make_env(wrong_goal: bool) -> gymnasium.Env[Any, Any]:
    env = ambf_gym.make(ID)
    return WrongGoal(env) if wrong_goal else env


class Features(BaseFeaturesExtractor):  # type: ignore[misc]
    """What the networks see: features()."""

    def __init__(self, observation_space: gymnasium.spaces.Dict) -> None:
        super().__init__(observation_space, features_dim=3 + gymnasium.spaces.flatdim(observation_space["observation"]))

    def forward(self, observations: dict[str, torch.Tensor]) -> torch.Tensor:
        seen: torch.Tensor = features(observations)
        return seen


class Curve(BaseCallback):  # type: ignore[misc]
    """Keeps how each episode of the training ended: a row of steps, seconds, success and return."""

    def __init__(self) -> None:
        super().__init__()
        self.rows: list[tuple[int, float, int, float]] = []
        self.begun = time.monotonic()

    def _on_step(self) -> bool:
        for info in self.locals["infos"]:
            if "episode" in info:
                seconds = time.monotonic() - self.begun
                self.rows.append((self.num_timesteps, seconds, int(info["is_success"]), info["episode"]["r"]))
                if len(self.rows) % 20 == 0:
                    share = np.mean([row[2] for row in self.rows[-20:]])
                    print(f"{self.num_timesteps} steps, {seconds:.0f} s: {100 * share:.0f} % of 20", flush=True)
        return True


def make_model(seed: int, wrong_goal: bool) -> SAC:
    torch.set_num_threads(1)
    return SAC(
        "MultiInputPolicy",
        gymnasium.wrappers.RecordEpisodeStatistics(make_env(wrong_goal)),
        replay_buffer_class=HerReplayBuffer,
        replay_buffer_kwargs={"n_sampled_goal": 4, "goal_selection_strategy": "future"},
        policy_kwargs={"net_arch": [128, 128], "features_extractor_class": Features},
        learning_rate=1e-3,
        gamma=0.95,
        batch_size=256,
        learning_starts=1000,
        seed=seed,
    )


def reached(model: SAC, count: int, wrong_goal: bool) -> float:
    """The share of unseen goals that the tip is at when the episode ends."""
    env = make_env(wrong_goal)
    ends = episodes(env, lambda seen: model.predict(seen, deterministic=True)[0], range(UNSEEN, UNSEEN + count))
    env.close()
    return float(np.mean(ends))


def export(model: SAC, file: Path) -> None:
    """Writes the policy for those without torch. Raises RuntimeError where that one would act otherwise."""
    layers = [*(each for each in model.actor.latent_pi if hasattr(each, "weight")), model.actor.mu]
    policy = Policy([part.detach().numpy() for layer in layers for part in (layer.weight.T, layer.bias)])
    seen = model.replay_buffer.sample(200).observations
    rows = {name: each.numpy() for name, each in seen.items()}
    with torch.no_grad():
        away = np.abs(policy(rows) - model.actor(seen, deterministic=True).numpy()).max()
    if away > 1e-4:
        raise RuntimeError(f"by numpy the policy acts otherwise, by {away}")
    policy.save(file)


def write_curve(rows: list[tuple[int, float, int, float]], folder: Path) -> None:
    with (folder / "curve.csv").open("w", newline="") as file:
        csv.writer(file).writerows([("steps", "seconds", "success", "return"), *rows])
    try:
        import matplotlib

        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        return
    steps, success = np.array([row[0] for row in rows]), np.array([row[2] for row in rows], float)
    window = min(20, len(success))
    figure, axes = pyplot.subplots(figsize=(6, 4), layout="constrained")
    axes.plot(steps[window - 1 :], np.convolve(success, np.ones(window) / window, "valid"))
    axes.set(xlabel="steps", ylabel=f"success, mean of {window} episodes", ylim=(-0.02, 1.02), title=ID)
    axes.grid(alpha=0.3)
    figure.savefig(folder / "curve.png", dpi=120)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--steps", type=int, default=20_000)
    parser.add_argument("--folder", type=Path, default=Path("psm_reach"))
    parser.add_argument("--episodes", type=int, default=200, help="unseen goals that the result is judged by")
    parser.add_argument("--replay", type=Path, help="a model to judge instead of training one")
    parser.add_argument("--wrong-goal", action="store_true", help="control: see another goal than the one that counts")
    options = parser.parse_args()
    if options.replay is not None:
        model = SAC.load(options.replay, env=ambf_gym.make(ID))
    else:
        options.folder.mkdir(parents=True, exist_ok=True)
        model, curve = make_model(options.seed, options.wrong_goal), Curve()
        model.learn(options.steps, callback=curve, log_interval=None)
        model.save(options.folder / "model.zip")
        export(model, options.folder / "policy.npz")
        write_curve(curve.rows, options.folder)
        seconds, busy = time.monotonic() - curve.begun, time.process_time()
        print(f"seed {options.seed}: {options.steps} steps in {seconds:.0f} s, {busy:.0f} s of them of a processor")
    share = reached(model, options.episodes, options.wrong_goal)
    print(f"reached {100 * share:.1f} % of {options.episodes} unseen goals")


if __name__ == "__main__":
    main()
