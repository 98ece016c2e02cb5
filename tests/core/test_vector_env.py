"""Vectors of environments over a WorldBatch equal gymnasium's SyncVectorEnv of single ones in every bit."""

import functools

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import ambf_gym  # noqa: E402
from gymnasium import wrappers  # noqa: E402
from gymnasium.vector import AsyncVectorEnv, AutoresetMode, SyncVectorEnv  # noqa: E402

STEPS = 6
RANGES = {
    "joint1": {"damping": [0.1, 2.0]},
    "link7": {"linear damping": [0.0, 0.2]},
    "gravity": [[0, 0, -9.9], [0, 0, -9]],
}


class ShortReach(ambf_gym.Arm7Reach):
    """Of few steps, and quickly settled."""

    def settle(self, world):
        world.commands.set_joints(0.5)
        world.step(300)


ambf_gym.register("ambf_test/ShortReach-v0", ShortReach, max_episode_steps=STEPS)
ID = "ambf_test/ShortReach-v0"


def same(a, b, where):
    if isinstance(a, tuple):
        a, b = dict(enumerate(a)), dict(enumerate(b))
    if isinstance(a, dict):
        assert a.keys() == b.keys(), where
        for key in a:
            same(a[key], b[key], f"{where} {key}")
    elif isinstance(a, np.ndarray) and a.dtype == object:
        for i, (x, y) in enumerate(zip(a, b, strict=True)):
            same(x, y, f"{where}[{i}]")
    elif isinstance(a, np.ndarray):
        assert a.dtype == b.dtype and a.shape == b.shape and (a == b).all(), where
    else:
        assert a == b, where


@pytest.mark.parametrize(
    ("mode", "ranges"),
    [(AutoresetMode.NEXT_STEP, RANGES), (AutoresetMode.SAME_STEP, None), (AutoresetMode.DISABLED, None)],
)
def test_a_vector_equals_single_environments(mode, ranges):
    random = np.random.default_rng(1)
    ours = gymnasium.make_vec(ID, 3, workers=2, autoreset_mode=mode, randomization=ranges)
    theirs = SyncVectorEnv([lambda: ambf_gym.make(ID, randomization=ranges)] * 3, autoreset_mode=mode)
    assert ours.observation_space == theirs.observation_space and ours.metadata["autoreset_mode"] is mode
    same(ours.reset(seed=[5, 7, 5]), theirs.reset(seed=[5, 7, 5]), "reset")
    assert ours.np_random_seed == theirs.np_random_seed == (5, 7, 5)
    assert ours.get_attr("steps") == theirs.get_attr("steps") == (20, 20, 20)
    same(ours.call("achieved"), theirs.call("achieved"), "call")
    for step in range(2 * STEPS + 3):
        actions = random.uniform(-1, 1, (3, 7)).astype(np.float32)
        got, wanted = ours.step(actions), theirs.step(actions)
        same(got, wanted, f"step {step}")
        ended = got[2] | got[3]
        if mode == AutoresetMode.DISABLED and ended.any():
            with pytest.raises(RuntimeError, match="have ended"):
                ours.step(actions)
        if (mode == AutoresetMode.DISABLED and ended.any()) or step == 2:
            mask = ended if ended.any() else np.array([False, True, False])
            options = [{"reset_mask": mask.copy()} for _ in range(2)]
            same(ours.reset(options=options[0]), theirs.reset(options=options[1]), f"reset after {step}")
    ours.close()
    theirs.close()


def test_bad_input_moves_nothing():
    env = gymnasium.make_vec(ID, 2)
    hashes = env.unwrapped._batch.hashes()
    with pytest.raises(RuntimeError, match="before reset"):
        env.step(np.zeros((2, 7), np.float32))
    with pytest.raises(ValueError, match="first reset"):
        env.reset(options={"reset_mask": np.array([True, False])})
    env.reset(seed=1)
    for options in ({"goal": [0, 1]}, {"gaol": [0, 1, 2]}):
        with pytest.raises(ValueError, match="goal"):
            env.reset(options=options)
    for shape in ((3, 7), (1, 7), (2, 6), (2, 8), (7,), ()):
        with pytest.raises(ValueError, match="shape"):
            env.step(np.zeros(shape, np.float32))
    assert env.unwrapped._batch.hashes() == hashes
    commanded = env.unwrapped.envs[0].world.commands.joint_value.copy()
    with pytest.raises(ValueError, match="finite"):
        env.step(np.array([np.ones(7), np.full(7, np.nan)], np.float32))
    assert (env.unwrapped.envs[0].world.commands.joint_value == commanded).all()
    for options in ({"reset_mask": [True, False]}, {"reset_mask": np.zeros(2, bool)}):
        with pytest.raises(ValueError, match="reset_mask"):
            env.reset(options=options)
    with pytest.raises(ValueError, match="3 seeds"):
        env.reset(seed=[1, 2, 3])
    env.close()
    with pytest.raises(ValueError, match="backend"):
        gymnasium.make_vec(ID, 2, backend="ros")
    for steps in (0, -1):
        with pytest.raises(ValueError, match="max_episode_steps"):
            ambf_gym.GoalVectorEnv(ShortReach, 1, max_episode_steps=steps)


def test_one_whose_constructor_refuses_can_be_closed():
    """As gymnasium 1.2 does with each vector when it is collected, also with those that never came to be."""
    made = []

    class Noted(ambf_gym.GoalVectorEnv):
        def __init__(self, *arguments, **options):
            made.append(self)
            super().__init__(*arguments, **options)

    for options in ({"backend": "ros"}, {"max_episode_steps": 0}, {"workers": 0}, {"reward": "none"}):
        with pytest.raises(ValueError):
            Noted(ShortReach, 1, **options)
        made[-1].close()
    assert len(made) == 4 and all(each.closed for each in made)


def test_parameters_span_their_ranges_and_are_undone():
    env = ShortReach(randomization=RANGES)
    plain = ShortReach()
    drawn = []
    for seed in range(40):
        env.reset(seed=seed)
        drawn.append(env.reset()[1]["randomization"])
        env.world.step(1)
        assert env.world.parameter("joint1", "damping") == drawn[-1]["joint1 damping"]
    damping = [each["joint1 damping"] for each in drawn]
    assert min(damping) < 0.3 and max(damping) > 1.8 and len(set(damping)) == 40
    assert all(-9.9 <= each["gravity"][2] <= -9 for each in drawn)
    options = {"goal": [0.3, 0, 0.5]}
    env.reset(seed=1, options=options)
    plain.reset(seed=1, options=options)
    for each in (env, plain):
        for _ in range(3):
            each.step(np.ones(7, np.float32))
    assert env.world.hash() != plain.world.hash()
    env._randomization = None
    env.reset(seed=1, options=options)
    plain.reset(seed=1, options=options)
    for each in (env, plain):
        each.step(np.ones(7, np.float32))
    assert env.world.hash() == plain.world.hash()
    env.close()
    plain.close()


@pytest.mark.parametrize(
    ("ranges", "problem"),
    [
        ({"joint1": {"damping": [2.0, 1.0]}}, "is not a range"),
        ({"joint1": {"damping": [-1.0, 1.0]}}, "not within 0 to 1e"),
        ({"joint1": {"damping": [0.0, float("nan")]}}, "is not a range"),
        ({"joint1": {"damping": 3}}, "3 is not .low, high."),
        ({"joint1": {"colour": [0, 1]}}, "no parameter 'colour'"),
        ({"joint1": {"friction": [0, 1]}}, "'friction'"),
        ({"elbow9": {"damping": [0, 1]}}, "'elbow9'"),
        ({"gravity": [[0, 0], [0, 0]]}, "is not .low, high."),
        ({"joint1": [0, 1]}, "not a map of parameters"),
        ({"delay": [0.5, 2]}, "not numbers of actions"),
        ({"delay": [-1, 2]}, "not within 0 to 1000"),
        ({"noise": [-0.1, 0.1]}, "not within 0 to 1e"),
        ({"view": {"eye": [0, 0.1]}}, "a camera of its files"),
        ([1, 2], "not a map of names"),
    ],
)
def test_ranges_that_no_world_can_have_are_refused_at_make(ranges, problem):
    with pytest.raises(ValueError, match=problem):
        ShortReach(randomization=ranges)


def test_ranges_are_read_from_yaml(tmp_path):
    (tmp_path / "ranges.yaml").write_text("joint1: {damping: [0.5, 0.5]}\n")
    env = ShortReach(randomization=tmp_path / "ranges.yaml")
    assert env.reset(seed=1)[1]["randomization"] == {"joint1 damping": 0.5}
    env.close()


@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_environments_work_in_processes_of_gymnasium(context):
    makers = [functools.partial(ambf_gym.make, "ambf/Arm7Reach-v0")] * 2
    there, here = AsyncVectorEnv(makers, context=context), SyncVectorEnv(makers)
    same(there.reset(seed=3), here.reset(seed=3), "reset")
    for step in range(2):
        actions = np.full((2, 7), 0.5, np.float32)
        same(there.step(actions), here.step(actions), f"step {step}")
    there.close()
    here.close()


def test_gymnasiums_wrappers_take_an_environment():
    env = ambf_gym.make("ambf_test/ShortReach-v0", reward="dense")
    for wrapper, arguments in (
        (wrappers.RecordEpisodeStatistics, {}),
        (wrappers.RescaleAction, {"min_action": -2.0, "max_action": 2.0}),
        (wrappers.ClipAction, {}),
        (wrappers.FlattenObservation, {}),
        (wrappers.NormalizeObservation, {}),
        (wrappers.NormalizeReward, {}),
        (wrappers.DelayObservation, {"delay": 1}),
        (wrappers.TimeAwareObservation, {}),
        (wrappers.FrameStackObservation, {"stack_size": 3}),
        (wrappers.StickyAction, {"repeat_action_probability": 0.2}),
    ):
        env = wrapper(env, **arguments)
    env.reset(seed=1)
    for step in range(STEPS):
        observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
        assert env.observation_space.contains(observation), step
    assert truncated and info["episode"]["l"] == STEPS and np.isfinite(reward)
    env.close()
