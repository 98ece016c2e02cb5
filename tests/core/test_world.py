"""ambf_core.World: the same bits in every run, arrays that never dangle, and refusals that change nothing."""

import contextlib
import gc
import logging
import os
import threading
import time

import numpy as np
import pytest
from ambf_core import BodyMode, Diverged, JointMode, LoadError, World

BALL = """
bodies: [BODY ball]
namespace: /test/
BODY ball: {name: ball, mass: 1, shape: SPHERE, geometry: {radius: 0.1},
  location: {position: {x: -1, y: 0, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}}
"""


def play(world, steps=150):
    """Hashes after each of some steps under commands that change."""
    hashes = []
    for i in range(steps):
        if i == 10:
            world.commands.set_joints([0.5, -0.25])
        if i == 60:
            world.commands.set_joints(2.0, JointMode.VELOCITY, ["shoulder"])
            world.commands.set_body("box", [0, 0, 30, 0, 0, 0.5], BodyMode.WRENCH)
        if i == 100:
            world.commands.clear()
        world.step(2)
        hashes.append(world.hash())
    return hashes


def test_fresh_worlds_resets_and_snapshots_repeat_every_bit(make_world):
    world = make_world()
    first = play(world)
    assert len(set(first)) == len(first)
    assert play(make_world()) == first
    world.reset()
    assert world.state.sim_step == 0
    assert (world.commands.joint_mode == JointMode.NONE).all()
    assert play(world) == first, "a reset after any history is a fresh world"
    world.commands.set_joints(0.75)
    world.step(20)
    kept = world.snapshot()
    after = [world.step(30), world.hash()]
    world.commands.clear()
    world.step(7)
    world.restore(kept)
    assert world.commands.joint_value[0] == 0.75
    assert [world.step(30), world.hash()] == after
    world.forget(kept)
    with pytest.raises(ValueError, match=kept):
        world.restore(kept)


def test_a_snapshot_keeps_which_motors_are_switched_off(make_world):
    """Mode NONE of a joint means "off" if it was commanded before, which is a part of what a snapshot keeps."""
    world = make_world()
    world.commands.set_joints([0.5, -0.25])
    world.step(300)
    world.commands.joint_mode[world.joint("elbow")] = JointMode.NONE
    world.step(20)
    swinging = world.snapshot()
    after = [world.step(100), world.hash()]
    world.commands.clear()
    world.step(5)
    world.restore(swinging)
    assert [world.step(100), world.hash()] == after
    world.reset()
    still = world.snapshot()
    world.commands.set_joints([0.5], joints=["shoulder"])
    world.step(100)
    after = world.hash()
    world.commands.set_joints([0.5, -0.25])
    world.step(100)
    world.restore(still)
    world.commands.set_joints([0.5], joints=["shoulder"])
    world.step(100)
    assert world.hash() == after


def test_state_is_the_same_read_only_memory_after_each_step(make_world):
    world = make_world(sleeping=False)
    pose, address = world.state.body_pose, world.state.body_pose.ctypes.data
    height = pose[world.body("box"), 2]
    world.step(100)
    assert world.state.body_pose is pose and pose.ctypes.data == address
    assert pose[world.body("box"), 2] == pytest.approx(height - 0.5 * 9.81 * 0.1**2, rel=0.02)
    assert world.state.sim_step == 100 and world.state.sim_time == pytest.approx(0.1)
    assert pose.flags.c_contiguous and pose.dtype == np.float64
    with pytest.raises(ValueError):
        pose[0, 0] = 1.0
    with pytest.raises(AttributeError):
        world.state.body_pose = pose
    world.step(900)
    count = int(world.state.contact_count)
    assert count > 0 and (world.state.contact_bodies[count:] == 0).all()
    assert (world.state.contact_bodies[:count] == world.body("box")).any(axis=1).all()
    assert world.state.contact_impulse.sum() == pytest.approx(2 * 9.81 * 0.001, rel=0.05)
    world.commands.set_body("box", [0, 0, 60, 0, 0, 0], BodyMode.WRENCH)
    world.step(200)
    assert world.state.contact_count == 0 and (world.state.contact_impulse == 0).all()


def test_arrays_never_dangle(make_world):
    world = make_world()
    world.commands.set_joints([0.5, -0.25])
    world.step(200)
    old, old_commands = world.state, world.commands
    kept = old.body_pose.copy()
    model = world.load(text=BALL, pose=[0, 0, 1, 0, 0, 0, 1])
    assert len(world.bodies) == len(kept) + 1 and world.state.body_pose.shape == (len(kept) + 1, 7)
    assert world.state.body_pose[world.body("ball"), 2] == 1.5
    assert (world.commands.joint_value == [0.5, -0.25]).all(), "commands of what is still there go on"
    world.step(100)
    assert (old.body_pose == kept).all() and old_commands is not world.commands
    world.unload(model)
    world.remove("lower")
    assert len(world.joints) == 1 and world.commands.joint_value == [0.5]
    world.step(100)
    state = world.state
    last = state.body_pose.copy()
    world.close()
    del world
    gc.collect()
    assert (state.body_pose == last).all() and (old.body_pose == kept).all()


def test_commands_hold_until_they_are_changed(make_world):
    world = make_world()
    shoulder, elbow = world.joint("shoulder"), world.joint("elbow")
    world.commands.set_joints([0.5, -0.25])
    world.step(2000)  # four times the watchdog of commands on topics
    assert world.state.joint_position == pytest.approx([0.5, -0.25], abs=0.02)
    assert world.state.joint_commanded_mode[shoulder] == JointMode.POSITION
    world.commands.joint_mode[elbow] = JointMode.NONE
    world.step(400)
    assert world.state.joint_position[shoulder] == pytest.approx(0.5, abs=0.02), "still commanded"
    assert world.state.joint_position[elbow] < -0.5, "its motor is off: it swings through"


@pytest.mark.parametrize(
    "spoil, message",
    [
        (lambda c: c.joint_value.__setitem__(0, np.nan), "base"),
        (lambda c: c.joint_mode.__setitem__(0, 7), r"joint_mode\[0\] is 7"),
        (lambda c: c.body_mode.__setitem__(1, 9), r"body_mode\[1\] is 9"),
        (lambda c: (c.set_body("box", [0, 0, 1, 0, 0, 0, 1], BodyMode.POSE), c.body_pose.fill(0.1)), "box"),
    ],
    ids=["nan", "joint mode", "body mode", "quaternion"],
)
def test_a_bad_command_raises_and_changes_nothing(make_world, spoil, message):
    world = make_world()
    world.commands.set_joints(0.1)
    world.step(5)
    before = world.hash()
    spoil(world.commands)
    with pytest.raises(ValueError, match=message):
        world.step(10)
    assert world.hash() == before and world.state.sim_step == 5
    world.commands.clear()
    world.step(1)


def test_wrong_arguments_raise(make_world, tmp_path):
    world = make_world()
    for wrong in ([1.0, 2.0, 3.0], [np.inf, 0.0]):
        with pytest.raises(ValueError):
            world.commands.set_joints(wrong)
    memory = world.commands.joint_value
    world.commands.joint_value = [0.25, 0.5]
    assert world.commands.joint_value is memory and memory.tolist() == [0.25, 0.5]
    for name, error in (("joint_value", ValueError), ("joint_values", AttributeError)):
        with pytest.raises(error):
            setattr(world.commands, name, [1.0, 2.0, 3.0])
    with pytest.raises(LookupError, match="wrist"):
        world.commands.set_joints(0.0, joints=["wrist"])
    with pytest.raises(ValueError):
        world.step(-1)
    with pytest.raises(ValueError):
        World(step=0.0)
    with pytest.raises(LoadError, match=r"bad.yaml:1:\d+: error") as refused:
        (tmp_path / "bad.yaml").write_text("bodies: [")
        world.load(tmp_path / "bad.yaml")
    assert refused.value.findings and world.models[-1] == "text.yaml"
    with pytest.raises(LoadError, match="no_such_world"):
        World(world="no_such_world.yaml")
    with pytest.raises(ValueError, match="nothing"):
        world.unload("nothing")
    with pytest.raises(ValueError, match="friction"):
        world.set_parameter("box", "friction", -1.0)
    with pytest.raises(ValueError, match="colour"):
        world.set_parameter("box", "colour", 1.0)
    world.close()
    world.close()
    with pytest.raises(RuntimeError, match="closed"):
        world.step()


def test_a_second_thread_and_a_forked_process_are_refused(make_world):
    world = make_world()
    started, problems = threading.Event(), []
    deadline = time.monotonic() + 20.0

    def long_run():
        started.set()
        while not problems and time.monotonic() < deadline:
            with contextlib.suppress(RuntimeError):  # it may be the one that is refused
                world.step(2000)

    thread = threading.Thread(target=long_run)
    thread.start()
    started.wait()
    while thread.is_alive() and not problems:
        try:
            world.hash()
        except RuntimeError as error:
            problems.append(str(error))
    thread.join()
    assert problems == ["another thread is using this world"], "the GIL was not released while stepping"
    child = os.fork()
    if child == 0:
        try:
            world.step()
        except RuntimeError as error:
            os._exit(0 if "fork" in str(error) else 2)
        os._exit(1)
    assert os.waitpid(child, 0)[1] == 0
    world.step()


def test_parameters_act_and_a_reset_restores_them(make_world):
    world = make_world()
    assert world.parameter("box", "friction") == 0.5
    world.set_parameter("box", "linear damping", 0.9)  # of the speed, lost a second
    world.set_gravity([0, 0, -1.0])
    world.step(200)
    assert world.parameter("box", "linear damping") == 0.9
    rate = -np.log(1 - 0.9)
    assert world.state.body_twist[world.body("box"), 2] == pytest.approx(-(1 - np.exp(-0.2 * rate)) / rate, rel=0.02)
    world.reset()
    world.step(100)
    assert world.state.body_twist[world.body("box"), 2] == pytest.approx(-0.98, rel=0.01)


def test_divergence_is_reported_and_a_reset_mends_it(make_world, caplog):
    world = make_world()
    world.set_gravity([0, 0, -1e9])
    with caplog.at_level(logging.WARNING, "ambf_core"):
        world.step(10)
    assert "/test/box" in world.frozen() and world.state.frozen_bodies == len(world.frozen())
    assert world.state.body_frozen[world.body("box")] and not world.state.body_frozen[world.body("floor")]
    assert "'/test/box' diverged" in caplog.text

    ball = World(text=BALL)  # alone: nothing else moves
    fresh = ball.hash()
    ball.set_gravity([0, 0, -1e9])
    for _ in range(2):
        with pytest.raises(Diverged) as raised:
            ball.step(10)
        assert raised.value.body == "/test/ball" and ball.state.diverged
    assert np.isfinite(ball.state.body_pose).all()
    ball.reset()
    assert not ball.state.diverged and ball.hash() == fresh
    ball.step()
