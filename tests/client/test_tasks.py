"""Tasks over ROS: State, the Python handle, List, and a task that is removed."""

import pytest
from ambf_client import Task
from harness import eventually

SCENE = """
bodies: [BODY board, BODY piece]
tasks: [TASK place]
namespace: /ambf/env/
BODY board: {name: board, mass: 0, location: {position: {x: 3, y: 0, z: 1}}}
BODY piece: {name: piece, mass: 0, location: {position: {x: 5, y: 0, z: 1}}}
TASK place:
  name: place
  parent: BODY board
  goals: [{name: on the board, piece: BODY piece, location: {position: {x: 0.1, y: 0, z: 0}},
           position tolerance: 0.01, hold: 0.05}]
"""


def test_a_task_is_done_when_the_piece_stays(bench, client):
    model = client.load(text=SCENE).model
    listed = {each.name: each for each in client.list().objects}
    assert listed["/ambf/env/place"].kind == "task"
    assert listed["/ambf/env/place"].parent == "/ambf/env/board"
    task, piece = client.get_task("place"), client.wait_for("piece")
    assert isinstance(task, Task)
    with pytest.raises(TypeError):
        client.get_task("piece")
    world = client.world
    world.step(20)
    assert not task.wait_for_success(timeout=0.2)
    piece.set_pos(3.1, 0.0, 1.0)
    world.step(49)
    eventually(lambda: task.state.met == [True])
    assert not task.is_done()
    world.step(1)
    assert task.wait_for_success(timeout=10.0)
    assert task.get_goals() == {"on the board": True} and task.get_progress() == 1.0
    assert 0.05 <= task.get_time() <= task.state.success_since  # from loading, and from the start
    assert (task.get_drops(), task.get_touches(), task.get_hand_overs()) == (0, 0, 0)
    assert task.get_holders("piece") == [] and task.get_parent_name() == "/ambf/env/board"
    with pytest.raises(LookupError):
        task.get_holders("board")
    with pytest.raises(TypeError):
        task.set_pos(0.0, 0.0, 0.0)
    assert task.state.pieces == ["/ambf/env/piece"]
    piece.set_pos(4.0, 0.0, 1.0)
    world.step(1)
    eventually(lambda: not task.is_done())
    assert task.state.distance[0] == pytest.approx(0.9)
    world.release()
    client.unload(model)
    eventually(lambda: "/ambf/env/place" not in {each.name for each in client.list().objects})
