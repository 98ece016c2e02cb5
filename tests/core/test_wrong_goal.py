"""The control run of the example that trains: who sees a wrong goal reaches next to none. Here, a script acts."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

pytest.importorskip("gymnasium")
import ambf_gym  # noqa: E402

SCRIPT = Path(__file__).resolve().parents[2] / "ambf_client_py/examples/learning/train_psm_reach.py"
NEEDED = {  # what it takes of what ./dev learn installs, none of which is used here
    "torch": ("Tensor",),
    "stable_baselines3": ("SAC", "HerReplayBuffer"),
    "stable_baselines3.common": (),
    "stable_baselines3.common.callbacks": ("BaseCallback",),
    "stable_baselines3.common.torch_layers": ("BaseFeaturesExtractor",),
}


@pytest.fixture
def script(monkeypatch):
    monkeypatch.syspath_prepend(SCRIPT.parent)
    for name, types in NEEDED.items():
        module = ModuleType(name)
        for each in types:
            setattr(module, each, type(each, (), {}))
        monkeypatch.setitem(sys.modules, name, module)
    spec = importlib.util.spec_from_file_location("train_psm_reach", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Goes:
    """To the goal that it sees."""

    def __init__(self):
        self.seen = []
        env = ambf_gym.PsmReach()
        self.act = env.expert()
        env.close()

    def predict(self, observation, deterministic):
        self.seen.append(observation["desired_goal"])
        return self.act(observation), None


def test_who_sees_a_wrong_goal_reaches_none(script):
    right, wrong = Goes(), Goes()
    assert script.reached(right, 8, False) == 1.0
    assert script.reached(wrong, 8, True) < 0.2
    assert len(wrong.seen) == len(right.seen) == 8 * 50
    assert (np.array(wrong.seen[:50]) == wrong.seen[0]).all(), "one goal an episode"
    assert len({each.tobytes() for each in wrong.seen}) == 8
    away = np.linalg.norm(np.array(wrong.seen) - right.seen, axis=1)
    assert (away > 0.003).mean() > 0.8


def test_rewards_are_of_the_goal_that_counts(script):
    env, plain = script.make_env(True), script.make_env(False)
    seen, _ = env.reset(seed=3)
    true, _ = plain.reset(seed=3)
    assert (seen["achieved_goal"] == true["achieved_goal"]).all()
    act = plain.unwrapped.expert()
    for _ in range(50):
        action = act(true)
        seen, reward, _, truncated, info = env.step(action)
        true, expected, *_ = plain.step(action)
        assert reward == expected and env.observation_space.contains(seen)
    assert reward == 0 and info["is_success"] and truncated
    env.close()
    plain.close()
