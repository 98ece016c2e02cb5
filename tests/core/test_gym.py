"""ambf_gym: what gymnasium's checker wants, episodes that repeat, rewards that are functions of the goals."""

import os
import warnings

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import ambf_gym  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402

DVRK = ("ambf/PsmReach-v0", "ambf/EcmReach-v0", "ambf/EcmTrack-v0")
NEEDLES = ("ambf/NeedlePick-v0", "ambf/NeedleRegrasp-v0")
OLD = "ambf/AmbfEnv-v0"
PADS = ("ambf/NeedleDrive-v0",)  # what succeeds there: test_needle_drive.py
JUDGED = ("ambf/PegTransfer-v0", "ambf/BiPegTransfer-v0", "ambf/RingWire-v0", "ambf/TissueRetract-v0", *NEEDLES)
IDS = ("ambf/Arm7Reach-v0", "ambf/RingLift-v0", *JUDGED, *DVRK)


@pytest.fixture
def env():
    made = ambf_gym.make("ambf/Arm7Reach-v0")
    yield made
    made.close()


def episode(env, seed, steps=50):
    random = np.random.default_rng(seed)
    trace = [env.reset(seed=seed)]
    for _ in range(steps):
        trace.append(env.step(random.uniform(-1, 1, 7).astype(np.float32)))
    return trace


@pytest.mark.parametrize("id", (*IDS, *PADS, OLD))
@pytest.mark.parametrize("observation", ["state", "both"])
def test_gymnasiums_checker_passes_without_a_warning(id, observation):
    """It draws in all render modes. The window is opened for one of them only, as each takes a second of CPU."""
    seen = "pictures" if id == OLD else "both"
    drawn = {} if observation == "state" else {"observation": seen, "render_mode": "rgb_array"}
    made = ambf_gym.make(id, **drawn)
    if id != OLD or not os.environ.get("DISPLAY"):
        made.unwrapped.metadata = {**made.metadata, "render_modes": ["rgb_array"]}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(made.unwrapped, skip_close_check=True, skip_render_check=not drawn)
    made.close()


@pytest.mark.parametrize("id", IDS)
def test_experts_succeed_and_random_or_constant_actions_do_not(id):
    """tests/benchmarks/bench_gym.py runs 200 seeds, all constant actions and none."""
    made = ambf_gym.make(id)
    policies = {
        "expert": lambda env, random: env.expert(),
        "random": lambda env, random: lambda observation: random.uniform(-1, 1, env.action_size),
        "down": lambda env, random: lambda observation: -np.ones(env.action_size),
    }
    for name, policy in policies.items():
        for seed in range(10 if id in DVRK else 1 if id in JUDGED else 2):
            observation, info = made.reset(seed=seed)
            act, over = policy(made.unwrapped, np.random.default_rng(seed)), False
            while not over:
                observation, reward, _, over, info = made.step(act(observation).astype(np.float32))
            assert info["is_success"] == (name == "expert") == (reward == 0.0), (name, seed)
    made.close()


def test_the_originals_environment_has_its_actions_observations_and_rewards():
    """Its expert comes near the board; what is commanded costs, and coming nearer pays."""
    env = ambf_gym.make(OLD)
    assert env.action_space.shape == (7,) and env.observation_space.shape == (13,)
    assert np.isfinite([env.observation_space.low, env.observation_space.high]).all()
    observation, _ = env.reset(seed=1)
    act, away, over = env.unwrapped.expert(), np.linalg.norm(observation[:3] - observation[6:9]), False
    while not over:
        observation, reward, _, over, info = env.step(act(observation))
        before, away = away, float(np.linalg.norm(observation[:3] - observation[6:9]))
        assert observation[12] == env.unwrapped.steps
        assert reward == pytest.approx(before - away - 4 * env.unwrapped._spent, abs=1e-6)
    assert info["is_success"] and away < 0.06
    high = np.zeros(7, np.float32)
    high[[2, 3, 4, 5]] = 1, 0.4, -0.3, 0.2
    for _ in range(40):
        observation = env.step(high)[0]
    assert observation[[2, 3, 4, 5]] == pytest.approx([0.15, 0.2, -0.15, 0.1], abs=0.02)
    with pytest.raises(ValueError, match="one vector"):
        ambf_gym.AmbfEnv(observation="both")
    env.close()


def test_goals_of_a_psm_fill_their_box_and_keep_away_from_the_start():
    """Uniform in x and y within 50 mm, z from -160 to -80 mm of the remote centre; success is within 3 mm."""
    env = ambf_gym.PsmReach()
    centre = env.world.state.body_pose[env.world.body("baselink"), :3]
    start, goals = env.reset(seed=1)[0]["achieved_goal"], []
    for _ in range(60):
        goals.append(env.reset()[0]["desired_goal"])
    goals = np.array(goals) - centre
    assert (np.abs(goals - [0, 0, -0.12]) <= [0.0501, 0.0501, 0.0401]).all()
    assert (np.ptp(goals, axis=0) > [0.08, 0.08, 0.065]).all()
    assert np.linalg.norm(goals + centre - start, axis=1).min() > 0.0099
    assert env.steps * 0.001 == 0.02 and ambf_gym.make("ambf/PsmReach-v0").spec.max_episode_steps == 50
    for away, reached in ((0.0029, True), (0.0031, False)):
        assert env.is_reached(start, start + np.array([0, away, 0])) == reached
    env.step(np.ones(3, np.float32))
    for _ in range(29):  # as far as targets go, and no further
        env.step(np.ones(3, np.float32))
    assert env.achieved() - centre == pytest.approx([0.06, 0.06, -0.07], abs=1e-3)
    tool = env.world.state.body_pose[env.world.body("toolrolllink"), 3:]
    assert np.isfinite(tool).all()
    env.close()


def test_a_judges_verdict_counts_for_the_place_that_is_meant():
    """Places alone, which hindsight replay asks for, have tolerances; a peg beside it, or no verdict, pays nothing."""
    env = ambf_gym.PegTransfer
    goal = np.array([0.0, 0.026, 0.029, 1.0])
    cases = (
        (([0.002, 0.002, 0.003], 1.0, 1.0), True),
        (([0.002, 0.002, 0.003], 0.0, 1.0), False),
        (([0.0, 0.031, 0.0], 1.0, 1.0), False),
        (([0.004, 0.004, 0.003], 0.0, 0.0), True),
        (([0.0, 0.0, 0.0041], 1.0, 0.0), False),
        (([0.0, 0.0051, 0.0], 1.0, 0.0), False),
    )
    for (away, verdict, asked), reached in cases:
        achieved, desired = np.array([*(goal[:3] + away), verdict]), np.array([*goal[:3], asked])
        assert env.is_reached(env, achieved, desired) == reached, (away, verdict, asked)
    many = [np.array([[*(goal[:3] + away), verdict], goal]) for (away, verdict, _), _ in cases]
    assert env.is_reached(env, np.concatenate(many), np.tile(goal, (12, 1)))[1::2].all()


def test_a_ring_that_is_still_held_on_its_peg_pays_nothing():
    """The judge wants it let go for half a second: five actions; what pays is a function of the goals."""
    env = ambf_gym.make("ambf/PegTransfer-v0", reward="dense")
    observation, _ = env.reset(seed=1)
    act, rows, rewards, over = env.unwrapped.expert(), [], [], False
    while not over:
        observation, reward, _, over, info = env.step(act(observation))
        rows.append((observation["achieved_goal"], observation["desired_goal"], info["is_success"]))
        rewards.append(reward)
    achieved, desired, success = (np.array(column) for column in zip(*rows, strict=True))
    near = (np.abs(achieved - desired)[:, :3] < ambf_gym.PegTransfer.tolerance_m).all(1)
    assert np.argmax(success) - np.argmax(near) >= 5 and (success == (near & (achieved[:, 3] == 1))).all()
    assert (env.unwrapped.compute_reward(achieved, desired, [{}] * len(rewards)) == rewards).all()
    assert -0.15 < rewards[np.argmax(near)] < -0.09 and rewards[-1] > -0.005
    env.close()


def test_a_ring_that_cuts_the_bends_touches_the_wire_and_fails():
    env = ambf_gym.make("ambf/RingWire-v0")
    env.reset(seed=1)
    for _ in range(60):
        info = env.step(np.array([0, 1, 0, 0, 0], np.float32))[4]
    assert info["touches"] > 0 and not info["is_success"]
    env.close()


def test_a_flap_follows_jaws_that_hold_it_and_no_others():
    """The same ways of the gripper with open jaws leave it where it lies; a reset lays it back to the bit."""
    env, bead, begun, actions = ambf_gym.make("ambf/TissueRetract-v0"), {}, [], []
    for jaw in ("closes", "stays open"):
        observation, _ = env.reset(seed=2)
        begun.append(observation)
        act = env.unwrapped.expert()
        for k in range(24):
            if jaw == "closes":
                actions.append(act(observation))
            observation, _, _, _, info = env.step(np.array([*actions[k][:3], 1.0 if "open" in jaw else actions[k][3]]))
        bead[jaw] = observation["achieved_goal"], info["is_success"]
    env.close()
    assert all((begun[0][key] == begun[1][key]).all() for key in begun[0])
    assert bead["closes"][1] and bead["closes"][0][2] > 0.025 and bead["closes"][0][3] == 1.0
    assert not bead["stays open"][1] and bead["stays open"][0][2] < 0.018 and bead["stays open"][0][3] == 0.0


def test_an_episode_repeats_after_any_history_and_ends_by_time(env):
    first = episode(env, 3)
    episode(env, 4, 7)
    again = episode(env, 3)
    other = ambf_gym.make("ambf/Arm7Reach-v0")
    fresh = episode(other, 3)
    other.close()
    for a, b, c in zip(first, again, fresh, strict=True):
        for key in a[0]:
            assert (a[0][key] == b[0][key]).all() and (a[0][key] == c[0][key]).all()
        assert a[1:] == b[1:] == c[1:]
    assert [bool(each[3]) for each in first[1:]] == [False] * 49 + [True]
    assert not any(each[2] for each in first[1:])


def test_rewards_are_functions_of_goals_and_random_actions_earn_little(env):
    successes, achieved, wanted, rewards = 0, [], [], []
    for seed in range(6):
        trace = episode(env, seed)
        successes += trace[-1][4]["is_success"]
        for observation, reward, *_ in trace[1:]:
            achieved.append(observation["achieved_goal"])
            wanted.append(observation["desired_goal"])
            rewards.append(reward)
    inner = env.unwrapped
    batch = inner.compute_reward(np.array(achieved), np.array(wanted), [{}] * len(rewards))
    assert batch.tolist() == rewards and successes == 0
    assert inner.compute_reward(np.zeros(3), np.array([0.0, 0.0, 0.009]), {}) == 0.0
    assert inner.compute_reward(np.zeros(3), np.array([0.0, 0.0, 0.011]), {}) == -1.0
    at_start = env.reset(seed=1)[0]["achieved_goal"]
    assert env.reset(options={"goal": at_start})[1]["is_success"] is True


def test_bad_input_raises_and_divergence_truncates(env):
    inner = env.unwrapped
    fresh = ambf_gym.Arm7Reach()
    with pytest.raises(RuntimeError, match="before reset"):
        fresh.step(np.zeros(7, np.float32))
    fresh.close()
    env.reset(seed=1)
    for wrong in (np.zeros(6, np.float32), np.full(7, np.nan, np.float32)):
        with pytest.raises(ValueError):
            inner.step(wrong)
    with pytest.raises(ValueError, match="backend"):
        ambf_gym.make("ambf/Arm7Reach-v0", backend="telepathy")
    inner.world.set_gravity([0, 0, -1e15])
    _, _, terminated, truncated, info = inner.step(np.zeros(7, np.float32))
    assert truncated is True and terminated is False and info["diverged"] in inner.world.bodies
    env.reset(seed=1)
    assert inner.step(np.zeros(7, np.float32))[3] is False
    for options, problem in (
        ({"goal": [1, 2]}, "not a point"),
        ({"goal": [1, 2, np.inf]}, "not a point"),
        ({"goal": "there"}, "not a point"),
        ({"gaol": [0, 0, 1]}, "'gaol'"),
    ):
        before = inner.world.hash()
        with pytest.raises(ValueError, match=problem):
            env.reset(options=options)
        assert inner.world.hash() == before
        with pytest.raises(RuntimeError, match="before reset"):
            inner.step(np.zeros(7, np.float32))
        env.reset(seed=1)
