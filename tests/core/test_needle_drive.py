"""ambf/NeedleDrive-v0: the expert drives the needle from mark to mark, and what nearly does it pays nothing."""

import numpy as np
import pytest

pytest.importorskip("gymnasium")
import ambf_gym  # noqa: E402
from ambf_gym.needle_drive import _drive  # noqa: E402

RIGHT, LEFT = 0.405, 0.395  # m, x of the outer pairs of marks
OPEN = np.array([0, 0, 0, 0, 0, 0, 1], np.float32)


@pytest.fixture(scope="module")
def env():
    made = ambf_gym.make("ambf/NeedleDrive-v0")
    yield made
    made.close()


def goal(env, x):
    """That of the pair of marks there, whatever the seed."""
    inner = env.unwrapped
    found = next(g for g in (inner.sample_goal() for _ in range(100)) if abs(g[0] - x) < 1e-6)
    return {"goal": found.astype(np.float32)}


def run(env, observation, plan, actions, seen):
    """The last results; each is noted in `seen`: (is_success, in and out of each pair)."""
    for _ in range(actions):
        observation, reward, _, _, info = env.step(plan(observation))
        assert reward == (0.0 if info["is_success"] else -1.0) and info["assisted_grasp"]
        seen.append((info["is_success"], observation["observation"][-6:].astype(bool)))
        if info["is_success"]:
            break
    return observation


def drive(env, x, **how):
    """An expert for this pair of marks, or beside it, in an episode whose goal is the right one."""
    first, _ = env.reset(seed=4, options=goal(env, RIGHT))
    seen = dict(first)
    plan = _drive(seen, aside=x - RIGHT + how.pop("aside", 0.0), **how)

    def act(observation):
        seen.update({**observation, "desired_goal": first["desired_goal"]})
        return next(plan)

    return first, act


def test_the_expert_succeeds_and_who_lets_go_does_not(env):
    observation, _ = env.reset(seed=4, options=goal(env, RIGHT))
    assert observation["observation"][28] == 1, "the jaws hold it"
    act, seen = env.unwrapped.expert(), []
    observation = run(env, observation, act, 100, seen)
    assert seen[-1][0] and seen[-1][1].tolist() == [False, False, False, False, True, True]
    only_in = [done for success, done in seen if done[4] and not done[5]]
    assert len(only_in) > 10, "while it was only in, nothing was paid"
    again, _, _, _, info = env.step(act(observation))
    assert info["is_success"] and again["achieved_goal"][6] == 1
    for _ in range(4):
        observation, _, _, _, info = env.step(OPEN)
    assert not info["is_success"] and observation["achieved_goal"][6] == 0, "nobody holds it"


@pytest.mark.parametrize(
    ("what", "x", "how"),
    [
        ("another pair", LEFT, {}),
        ("beside the marks", RIGHT, {"aside": -0.0022}),
        ("too flat", RIGHT, {"above": 0.007}),
    ],
)
def test_near_misses_pay_nothing(env, what, x, how):
    observation, act = drive(env, x, **how)
    seen = []
    run(env, observation, act, 84, seen)
    assert not any(success for success, _ in seen), what
    assert int(env.unwrapped.world.state.puncture_count) == 2, "it is through"
    done = seen[-1][1].reshape(3, 2).all(axis=1)
    assert done.tolist() == [x == LEFT, False, False]


def test_random_actions_and_none_fail(env):
    for scale in (1.0, 0.0):
        random = np.random.default_rng(1)
        env.reset(seed=1)
        for _ in range(40):
            info = env.step((scale * random.uniform(-1, 1, 7)).astype(np.float32))[4]
            assert not info["is_success"]


def test_goals_count_by_the_verdict_of_the_pair_that_is_meant(env):
    inner = env.unwrapped
    meant, other = goal(env, RIGHT)["goal"], goal(env, LEFT)["goal"]
    tip = np.append(np.tile(meant[3:6], 2), 0.0)
    asked = tip.copy()
    rows = np.array([meant, other, np.append(meant[:6], 0.0), tip])
    assert inner.is_reached(rows, np.tile(meant, (4, 1))).tolist() == [True, False, False, False]
    assert inner.is_reached(tip, asked) and not inner.is_reached(tip + 0.003, asked), "hindsight: where the tip was"
    assert inner.distance(tip, meant) > inner.distance(meant, meant) == 0
