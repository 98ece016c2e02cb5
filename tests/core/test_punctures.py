"""Where needles go through tissue, as arrays, and as goals of a task: a needle that is led by pose."""

import numpy as np
import pytest
from ambf_core import MODELS, BodyMode, World

FILES = (MODELS / "multi-bodies/robots/psm.yaml", MODELS / "tasks/needle_drive.yaml")
TOP, ABOVE, SIDE = np.array([0.4, 0.5141, -0.785]), 0.0055, 0.00618  # of ambf_models/scripts/scene_needle_drive.py
HALF_TURN = np.sqrt(0.5)


def pose(x, height, angle):
    """The needle's middle over the pad, its tip at +y turned by the angle about x: downward from 0 on."""
    about_z, about_x = np.array([0, 0, -HALF_TURN, HALF_TURN]), np.array([np.sin(angle / 2), 0, 0, np.cos(angle / 2)])
    (ax, ay, az, aw), (bx, by, bz, bw) = about_x, about_z
    turned = [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
    return np.concatenate([TOP + [x, 0, height], turned])


@pytest.fixture(scope="module")
def world():
    with World(*FILES, world=MODELS / "world/psm_world.yaml") as made:
        made.commands.set_body("needle", pose(0, 0.03, 0.0), BodyMode.POSE)
        made.step(300)
        yield made


def lead(world, start, end, actions):
    for share in np.linspace(0, 1, actions + 1)[1:]:
        world.commands.set_body("needle", pose(*(np.array(start) + share * (np.subtract(end, start)))), BodyMode.POSE)
        world.step(10)
    world.step(100)


def test_punctures_are_rows_and_goals_of_the_judge(world):
    state, task = world.state, world.task("drive")
    assert state.puncture_count == 0 and (state.puncture_needle[1:] <= 0).all()
    lead(world, (0, 0.03, 0.0), (0, ABOVE, 0.0), 40)
    lead(world, (0, ABOVE, 0.0), (0, ABOVE, 1.4), 60)
    assert state.puncture_count == 1 and not state.puncture_out[0]
    assert state.puncture_needle[0] == world.actuator("stitch")
    lead(world, (0, ABOVE, 1.4), (0, ABOVE, 2.75), 60)
    assert state.puncture_count == 2 and state.puncture_out[:2].tolist() == [False, True]
    assert np.abs(state.puncture_rest[:2] - [[0, -SIDE, 0.004], [0, SIDE, 0.004]]).max() < 0.001, "pad's frame"
    assert np.abs(state.puncture_point[:2] - TOP - [[0, -SIDE, 0], [0, SIDE, 0]]).max() < 0.001, "world"
    assert 0 < np.linalg.norm(state.puncture_force[:2], axis=1).max() < 1
    assert (state.puncture_rest[2:] == 0).all()
    named = dict(zip(task.goal_names, state.goal_error[task.goals, 0], strict=True))
    assert named["in 1"] < 0.001 > named["out 1"] and 0.004 < named["in 0"] < 0.006
    assert not state.goal_done[task.goals].any(), "nobody holds it"
    with pytest.raises(ValueError):
        state.puncture_rest[0] = 0
    lead(world, (0, ABOVE, 2.75), (0, ABOVE, 0.0), 100)
    assert state.puncture_count == 0 and (state.puncture_rest == 0).all(), "drawn back, they are undone"
