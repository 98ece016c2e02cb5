"""Noise and delay of observations, and the program that plays episodes."""

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import ambf_gym  # noqa: E402
from ambf_gym import play  # noqa: E402

ID = "ambf/EcmReach-v0"


def seen(seed=2, steps=4, **options):
    """Observations, goals reached and rewards of an episode."""
    env = ambf_gym.make(ID, **options)
    rows, rewards = [env.reset(seed=seed)[0]], []
    for _ in range(steps):
        observation, reward, *_ = env.step(np.ones(3, np.float32))
        rows.append(observation)
        rewards.append(reward)
    env.close()
    return np.array([row["observation"] for row in rows]), np.array([row["achieved_goal"] for row in rows]), rewards


def test_a_delay_shows_what_was_seen_before():
    plain, reached, rewards = seen(reward="dense")
    late, same, again = seen(reward="dense", delay=2)
    assert (late[2:] == plain[:-2]).all() and (late[:2] == plain[0]).all()
    assert (reached == same).all() and rewards == again, "goals and rewards are not late"


def test_noise_is_as_large_as_asked_and_repeats():
    plain, reached, _ = seen(steps=30)
    deviations = np.zeros(plain.shape[1])
    deviations[:3] = 0.01
    noisy, same, _ = seen(steps=30, noise=deviations)
    assert (noisy[:, 3:] == plain[:, 3:]).all() and (reached == same).all()
    assert 0.007 < (noisy - plain)[:, :3].std() < 0.013
    assert (seen(steps=30, noise=deviations)[0] == noisy).all(), "the same seed, the same noise"
    assert (seen(steps=30, noise=0.0)[0] == plain).all()


SEEN = {
    "delay": [0, 3],
    "noise": [0.0, 0.01],
    "view": {"eye": [[-0.05, -0.05, 0], [0.05, 0.05, 0.05]], "field of view": [-0.1, 0.1]},
}


def test_what_is_seen_is_drawn_for_each_episode():
    """Delay, noise and view span their ranges; states, and what is seen without them, are those of the plain world."""
    env = ambf_gym.make(ID, randomization=SEEN, observation="both", picture_size=(32, 32)).unwrapped
    plain = ambf_gym.make(ID, observation="both", picture_size=(32, 32)).unwrapped
    action, goal, drawn, pictures = np.ones(3, np.float32), {"goal": plain.reset(seed=1)[0]["desired_goal"]}, [], []
    truth = [plain.reset(seed=1, options=goal)[0]] + [plain.step(action)[0] for _ in range(4)]
    for seed in range(25):
        rows, info = [], None
        observation, info = env.reset(seed=seed, options=goal)
        rows = [observation] + [env.step(action)[0] for _ in range(4)]
        drawn.append(info["randomization"])
        pictures.append(observation["picture"])
        late = 4 - drawn[-1]["delay"]
        spread = (rows[4]["observation"] - truth[late]["observation"]).std()
        assert spread < 2 * drawn[-1]["noise"] + 1e-6 and (spread > 0.3 * drawn[-1]["noise"])
        assert (rows[4]["achieved_goal"] == truth[4]["achieved_goal"]).all()
    assert {each["delay"] for each in drawn} == {0, 1, 2, 3}
    for what, low, high in (("noise", 0.0, 0.01), ("view field of view", -0.1, 0.1)):
        values = [each[what] for each in drawn]
        assert low <= min(values) < 0.8 * low + 0.2 * high and 0.2 * low + 0.8 * high < max(values) <= high
    eyes = np.array([each["view eye"] for each in drawn])
    assert (eyes.min(0) < [-0.03, -0.03, 0.01]).all() and (eyes.max(0) > [0.03, 0.03, 0.04]).all()
    assert len({each.tobytes() for each in pictures}) == 25 and not any(
        (each == truth[0]["picture"]).all() for each in pictures
    )
    assert (env.reset(seed=7, options=goal)[0]["picture"] == pictures[7]).all(), "the same seed, the same pixels"
    env.step(action)
    plain.reset(seed=3, options=goal)
    plain.step(action)
    assert env.world.hash() == plain.world.hash()
    env.close()
    plain.close()


@pytest.mark.parametrize(("id", "size"), [("ambf/PsmReach-v0", 6), ("ambf/EcmReach-v0", 4)])
def test_actions_may_be_joints(id, size):
    """Each number moves its joint and the others stay; the expert reaches goals by them; vectors take them, too."""
    env = ambf_gym.make(id, action="joints")
    inner = env.unwrapped
    assert env.action_space.shape == (size,)
    env.reset(seed=1)
    for number in range(size):
        before = inner._commanded()
        env.step(np.eye(size, dtype=np.float32)[number] * 0.5)
        moved = inner._commanded() - before
        wanted = np.eye(size)[number] * 0.5 * inner.joint_strides[number]
        np.testing.assert_allclose(moved, wanted, atol=1e-6)  # by messages' 32 bits
    for seed in range(3):
        observation, _ = env.reset(seed=seed)
        act, over = inner.expert(), False
        while not over:
            observation, _, _, over, info = env.step(act(observation))
        assert info["is_success"], seed
    env.close()
    many = gymnasium.make_vec(f"ambf_gym:{id}", num_envs=2, action="joints")
    assert many.action_space.shape == (2, size)
    many.close()


def test_other_actions_are_refused():
    with pytest.raises(ValueError, match="'tip' or 'joints'"):
        ambf_gym.make("ambf/PsmReach-v0", action="torques")


WRONG_VIEWS = [
    ({"view": {"up": [0, 1]}}, "not a map of eye"),
    ({"view": {"field of view": [-1.0, 0.0]}}, "not within"),
    ({"view": {"at": [[-2, -2, -2], [2, 2, 2]]}}, "may come to"),
]


@pytest.mark.parametrize(("ranges", "problem"), WRONG_VIEWS)
def test_views_that_show_nothing_are_refused(ranges, problem):
    with pytest.raises(ValueError, match=problem):
        ambf_gym.make(ID, randomization=ranges)


WRONG = [{"noise": -1.0}, {"noise": [1.0, 2.0]}, {"noise": np.inf}, {"delay": -1}, {"delay": 0.5}]


@pytest.mark.parametrize("options", WRONG)
def test_wrong_options_are_refused(options):
    with pytest.raises(ValueError, match=next(iter(options))):
        ambf_gym.make(ID, **options)


def test_play_says_how_episodes_ended(tmp_path, capsys):
    assert play.main([ID, "--episodes", "2", "--seed", "5"]) == 0
    said = capsys.readouterr().out
    assert said.count("success after 50 actions") == 2 and "seed 6" in said and "100.0 % of 2 episodes" in said
    policy = tmp_path / "mine.py"
    policy.write_text("def make_policy(env):\n    return lambda observation: [0] * env.action_size\n")
    assert play.main([ID, "--policy", str(policy), "--episodes", "1"]) == 0
    assert "failure after 50 actions, return -50.00" in capsys.readouterr().out
    dataset = pytest.importorskip("ambf_tools.dataset")
    pytest.importorskip("pyarrow")
    assert play.main([ID, "--expert", "--episodes", "2", "--record", str(tmp_path / "data")]) == 0
    data = dataset.read(tmp_path / "data")
    assert len(data.episodes) == 2 and dataset.check(tmp_path / "data") == [] and dataset.replay(data, 1)


def test_play_refuses_what_it_cannot_run(tmp_path, capsys):
    empty = tmp_path / "empty.py"
    empty.write_text("")
    for arguments, problem in (
        (["ambf/Nothing-v0"], "Nothing"),
        ([ID, "--policy", "nowhere.py"], "no such file"),
        ([ID, "--policy", str(empty)], "make_policy"),
    ):
        assert play.main(arguments) == 2
        assert problem in capsys.readouterr().err
