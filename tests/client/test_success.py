"""Tasks that sensors judge: a piece on its place by matching keys, every edge as an event, success that ends."""

from harness import eventually

from ambf_msgs.msg import SensorEvent

# A plate with a sensor that looks up, and two pieces with sensors that look down; only one has the plate's key.
PEGS = """
bodies: [BODY plate, BODY round, BODY square]
sensors: [SENSOR hole, SENSOR foot, SENSOR other]
namespace: /ambf/env/
BODY plate: {name: plate, mass: 0.0, location: {position: {x: 3, y: 0, z: 1}}, collision shape: BOX,
             collision geometry: {x: 0.2, y: 0.2, z: 0.02}}
BODY round: {name: round, mass: 0.0, location: {position: {x: 4, y: 0, z: 1.04}}, collision shape: BOX,
             collision geometry: {x: 0.05, y: 0.05, z: 0.05}}
BODY square: {name: square, mass: 0.0, location: {position: {x: 5, y: 0, z: 1.04}}, collision shape: BOX,
              collision geometry: {x: 0.05, y: 0.05, z: 0.05}}
SENSOR hole: {name: hole, parent: BODY plate, range: 0.05, matching key: round, success when: matched, hold: 0.01,
              array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: 1}}]}
SENSOR foot: {name: foot, parent: BODY round, range: 0.05, matching key: round,
              array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: -1}}]}
SENSOR other: {name: other, parent: BODY square, range: 0.05, matching key: square,
               array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: -1}}]}
"""
HOLE = "/ambf/env/hole"


def test_the_right_piece_on_its_place_is_a_success(bench, client):
    model = client.load(text=PEGS).model
    world = client.world
    hole, round_piece, square = (client.wait_for(name) for name in ("hole", "round", "square"))
    events = []
    hole.on_event(events.append)
    world.step(20)
    assert world.get_success() == {HOLE: False}

    square.set_pos(3.0, 0.0, 1.04)  # the wrong piece
    world.step(20)
    assert not world.wait_for_success(hole, timeout=0.3)
    square.set_pos(5.0, 0.0, 1.04)
    round_piece.set_pos(3.0, 0.0, 1.04)
    world.step(9)
    assert world.get_success() == {HOLE: False}  # not held long enough
    world.step(1)
    assert world.wait_for_success(hole)
    assert world.wait_for_success()  # all tasks
    round_piece.set_rpy(3.1415926, 0.0, 0.0)  # upside down
    world.step(1)
    eventually(lambda: world.get_success() == {HOLE: False})
    round_piece.set_rpy(0.0, 0.0, 0.0)
    world.step(20)
    assert world.wait_for_success(hole)
    round_piece.set_pos(4.0, 0.0, 1.04)  # lifted again
    world.step(1)
    eventually(lambda: world.get_success() == {HOLE: False})

    what = {SensorEvent.SENSED: "sensed", SensorEvent.MATCHED: "matched", SensorEvent.SUCCESS: "success"}
    expected = [
        ("sensed", True, "square"),
        ("sensed", False, "square"),
        ("sensed", True, "round"),
        ("matched", True, "round"),
        ("success", True, "round"),
        ("matched", False, "round"),
        ("success", False, "round"),
        ("matched", True, "round"),
        ("success", True, "round"),
        ("sensed", False, "round"),
        ("matched", False, "round"),
        ("success", False, "round"),
    ]
    eventually(lambda: len(events) >= len(expected))
    assert [(what[e.what], bool(e.begins), e.object.removeprefix("/ambf/env/")) for e in events] == expected
    assert {e.key for e in events} == {"round"}
    steps = [e.sim_step for e in events]
    assert steps == sorted(steps)

    del events[:]
    for i in range(1000):  # an edge each step
        round_piece.set_pos(3.0 if i % 2 == 0 else 4.0, 0.0, 1.04)
        world.step(1)
    sensed = [e for e in events if e.what == SensorEvent.SENSED]
    eventually(lambda: len([e for e in events if e.what == SensorEvent.SENSED]) == 1000)
    sensed = [e for e in events if e.what == SensorEvent.SENSED]
    assert [bool(e.begins) for e in sensed] == [True, False] * 500

    round_piece.set_pos(3.0, 0.0, 1.04)
    world.step(20)
    assert world.wait_for_success(hole)
    client.remove("round")
    world.step(1)
    eventually(lambda: world.get_success() == {HOLE: False})
    client.unload(model)
    world.step(1)
    eventually(lambda: world.get_success() == {})
