"""Vectors for stable-baselines3, which CI lacks (./dev learn has it): what DummyVecEnv of single ones returns."""

import functools

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
pytest.importorskip("stable_baselines3")
import ambf_gym  # noqa: E402
from ambf_gym.sb3 import Sb3VecEnv  # noqa: E402
from stable_baselines3.common.env_checker import check_env  # noqa: E402
from stable_baselines3.common.vec_env import DummyVecEnv, SubprocVecEnv, VecMonitor  # noqa: E402

ID = "ambf/PsmReach-v0"


def test_it_is_what_single_environments_return_over_the_end_of_episodes():
    ours, theirs = Sb3VecEnv(ID, 3, workers=2), DummyVecEnv([lambda: ambf_gym.make(ID)] * 3)
    random = np.random.default_rng(1)
    for each in (ours, theirs):
        each.seed(5)
    a, b = ours.reset(), theirs.reset()
    for step in range(52):
        for key in b:
            assert (a[key] == b[key]).all() and a[key].dtype == b[key].dtype, (step, key)
        actions = random.uniform(-1, 1, (3, 3)).astype(np.float32)
        (a, *mine), (b, *other) = ours.step(actions), theirs.step(actions)
        assert (mine[0] == other[0]).all() and mine[0].dtype == other[0].dtype and (mine[1] == other[1]).all(), step
        for one, two in zip(mine[2], other[2], strict=True):
            assert one.keys() == two.keys()
            assert one["is_success"] == two["is_success"]
            for key in two.get("terminal_observation", ()):
                assert (one["terminal_observation"][key] == two["terminal_observation"][key]).all()
    goals = np.zeros((4, 3), np.float32)
    assert (ours.env_method("compute_reward", goals, goals, [{}] * 4, indices=[0])[0] == 0.0).all()
    assert VecMonitor(ours).reset()["observation"].shape == (3, 17)
    for each in (ours, theirs):
        each.close()


@pytest.mark.parametrize("how", ["fork", "spawn", "forkserver"])
def test_its_own_vector_of_processes_takes_single_ones(how):
    """Worlds are made in the processes that step them: a fork after it has none of its own."""
    theirs = SubprocVecEnv([functools.partial(ambf_gym.make, ID)] * 2, start_method=how)
    ours = DummyVecEnv([functools.partial(ambf_gym.make, ID)] * 2)
    random = np.random.default_rng(1)
    for each in (theirs, ours):
        each.seed(5)
    a, b = theirs.reset(), ours.reset()
    for _ in range(52):
        assert all((a[key] == b[key]).all() for key in b)
        actions = random.uniform(-1, 1, (2, 3)).astype(np.float32)
        (a, *mine), (b, *other) = theirs.step(actions), ours.step(actions)
        assert (mine[0] == other[0]).all() and (mine[1] == other[1]).all()
    for each in (theirs, ours):
        each.close()


@pytest.mark.parametrize("id", [each for each in gymnasium.registry if each.startswith("ambf/")])
def test_its_checker_passes_without_a_warning(id, recwarn):
    env = ambf_gym.make(id)
    check_env(env.unwrapped, warn=True, skip_render_check=True)
    env.close()
    assert [str(each.message) for each in recwarn if "gymnasium" not in str(each.category)] == []
