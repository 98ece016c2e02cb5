"""Tasks in ambf_core: names, rows and arrays, for one world and for many; the judge is that of the simulator."""

import numpy as np
import pytest
from ambf_core import BodyMode, World, WorldBatch

SCENE = """
bodies: [BODY board, BODY piece, BODY other, BODY hand]
tasks: [TASK first, TASK second]
namespace: /test/
BODY board: {name: board, mass: 0}
BODY piece: {name: piece, mass: 0, location: {position: {x: 5, y: 0, z: 0}}}
BODY other: {name: other, mass: 0, location: {position: {x: 6, y: 0, z: 0}}}
BODY hand: {name: hand, mass: 0}
TASK first: {name: first, goals: [{name: home, piece: BODY piece, position tolerance: 0.01, hold: 0.1}]}
TASK second:
  name: second
  holders: [BODY hand]
  order: listed
  goals:
  - {name: a, piece: BODY other, place: BODY board, position tolerance: 0.01}
  - {name: b, piece: BODY piece, location: {position: {x: 1, y: 0, z: 0}}, position tolerance: 0.01}
"""


def test_arrays_say_what_is_done():
    with World(text=SCENE) as world:
        assert [task.name for task in world.tasks] == ["/test/first", "/test/second"]
        second = world.task("second")
        assert (second.row, second.goal_names, second.piece_names, second.holder_names) == (
            1,
            ("a", "b"),
            ("other", "piece"),
            ("hand",),
        )
        world.step(1)
        state = world.state
        np.testing.assert_allclose(state.goal_error[:, 0], [5.0, 6.0, 4.0])
        world.commands.set_body("piece", [0, 0, 0, 0, 0, 0, 1], BodyMode.POSE)
        world.step(99)
        assert not state.task_success[0]
        world.step(1)
        assert state.task_success.tolist() == [True, False] and state.goal_done.tolist() == [True, False, False]
        assert state.task_time[0] == pytest.approx(0.101)
        world.commands.set_body("piece", [1, 0, 0, 0, 0, 0, 1], BodyMode.POSE)
        world.step(1)
        assert not state.task_success[0]
        assert state.task_counts[second.row].tolist() == [0, 0, 0, 1]  # b before a
        world.commands.set_body("other", [0, 0, 0, 0, 0, 0, 1], BodyMode.POSE)
        world.step(1)
        assert state.task_done.tolist() == [0, 1] and state.piece_held_by[second.pieces].tolist() == [0, 0]
        world.reset()
        assert state.task_done.tolist() == [0, 0] and state.task_counts.sum() == 0
        with pytest.raises(LookupError):
            world.task("third")


def test_many_worlds_have_tasks_of_their_own():
    with WorldBatch(text=SCENE, n=2) as batch:
        batch.commands.body_mode[1, batch.body("piece")] = BodyMode.POSE
        batch.commands.body_pose[1, batch.body("piece")] = [0, 0, 0, 0, 0, 0, 1]
        batch.step(110)
        assert batch.state.task_success[:, batch.task("first").row].tolist() == [False, True]
