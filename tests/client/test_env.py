"""AmbfEnv, the original's learning environment, under Python 3."""

import importlib.util

import numpy as np
import pytest
import scenes
from documented import documented
from harness import eventually

SCENE = scenes.model(
    {"PegBase": scenes.box("PegBase", 0.0, (0.0, 0.0, 0.0)), "Peg": scenes.box("Peg", 0.0, (1.0, 0.0, 0.0))}
)

GYMNASIUM = importlib.util.find_spec("gymnasium") is not None
original = pytest.mark.skipif(GYMNASIUM, reason="with gymnasium it is a gymnasium.Env")
pytestmark = pytest.mark.usefixtures("called")


@pytest.fixture
def env(tmp_path, master, start, ros):
    start("--launch_file", scenes.write(tmp_path, SCENE), "-l", "0", master_uri=master.uri)
    eventually(lambda: "/ambf/env/Peg/State" in master.published(), 20.0)
    from ambf_comm import AmbfEnv

    made = AmbfEnv()
    made.make(a_name="Peg")
    yield made
    made.close()


@original
def test_actions_observations_and_rewards(env):
    assert env.action_space.shape == (7,)
    assert env.observation_space.shape == (13,)
    assert env.action_space.contains(env.action_space.sample())
    np.testing.assert_array_equal(env.action_space.low, [-30, -30, -30, -2, -2, -2, 0])
    np.testing.assert_array_equal(env.action_space.high, [30, 30, 30, 2, 2, 2, 1])
    first = env.reset()
    assert first.shape == (13,)
    assert first == pytest.approx([0.0] * 12 + [5.0], abs=1e-9)
    observation, reward, done, info = env.step([0.3, 0.0, 0.4, 0.0, 0.0, 0.0, 0.0])
    # A static body is where it was told in the step after the command.
    assert observation[:3] == pytest.approx([0.3, 0.0, 0.4])
    assert observation[6:12] == pytest.approx([0.0] * 6)
    assert observation[12] == 5.0
    assert reward == pytest.approx(-0.5 - 4.0 * 0.25)
    assert done is False
    assert info["sim_step"] == env.obj_handle.get_sim_step()
    _, nearer, _, _ = env.step(np.zeros(7))
    assert nearer == pytest.approx(0.5)
    again = env.obs.cur_observation()
    assert again[1] == nearer
    far, _, _, _ = env.step([1000.0, 0.0, 0.0, 0.0, 0.0, 0.0, 9.0])
    assert far[0] == 30.0  # cut to the limits
    with pytest.raises(ValueError):
        env.step([0.0] * 6)


@pytest.mark.skipif(not GYMNASIUM, reason="gymnasium is not installed")
def test_with_gymnasium_it_is_an_environment_that_passes_its_checker(env):
    from gymnasium import Env
    from gymnasium.utils.env_checker import check_env

    assert isinstance(env, Env)
    with pytest.warns(UserWarning):  # of spaces without bounds, as the original's
        check_env(env, skip_render_check=True)


def test_the_base_is_an_argument(env):
    with pytest.raises(TimeoutError, match=r"no object 'Board'.*make\(name, base\).*peg-transfer"):
        env.make("Peg", "Board", timeout=0.1)
    env.make("PegBase", base="Peg")
    env.reset()
    assert env.obs.state[6:9] == pytest.approx([1.0, 0.0, 0.0])


def test_the_number_of_steps_an_action_takes(env):
    env.skip_sim_steps(num=20)
    env.reset()
    step = env.obj_handle.get_sim_step()
    for i in range(1, 6):
        assert env.step(np.zeros(7))[0][12] == 20.0
        assert env.obj_handle.get_sim_step() == step + 20 * i


def test_without_throttling_it_runs_in_real_time(env):
    env.reset()
    env.set_throttling_enable(check=False)
    for _ in range(5):
        assert env.step(np.zeros(7))[0][12] >= 5.0
    assert env.world_handle.wait_for_sim_step(env.world_handle.get_sim_step() + 200)
    env.render(mode="human")


def test_every_documented_method_was_called(called):
    """The last of this file."""
    assert documented(__name__) - called == set()
