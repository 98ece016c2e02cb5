"""Ghost objects through the public face: topics, handle, list, what they feel, and what is left when things go."""

import pytest
from ambf_client import GhostObject
from harness import eventually

SPHERE = "collision shape: SPHERE, collision geometry: {radius: 0.05}"
GHOSTS = f"""\
adf version: 1.0
namespace: /ambf/env/
bodies: [BODY Hand, BODY Peg]
ghost objects: [GHOST tip, GHOST twin]
BODY Hand: {{name: Hand, mass: 0.0, location: {{position: {{x: 2.0, y: 0.0, z: 0.0}}}}, {SPHERE}}}
BODY Peg: {{name: Peg, mass: 0.0, location: {{position: {{x: 2.0, y: 0.3, z: 0.0}}}}, {SPHERE}}}
GHOST tip: {{name: tip, parent: BODY Hand, location: {{position: {{x: 0.11, y: 0.0, z: 0.0}}}}, {SPHERE}}}
GHOST twin: {{name: twin, parent: BODY Peg, location: {{position: {{x: 0.1, y: 0.0, z: 0.0}}}}, {SPHERE}}}
"""


def test_a_ghost_feels_what_its_parent_carries_it_into(bench, client, master):
    loaded = client.load(text=GHOSTS)
    assert {"/ambf/env/tip", "/ambf/env/twin"} <= set(loaded.objects)
    tip, hand = client.wait_for("tip"), client.wait_for("Hand")
    assert isinstance(tip, GhostObject)
    assert (tip.object_type, tip.body_type) == ("GHOST", "KINEMATIC")
    assert tip.get_identifier() == "/ambf/env/GHOST tip"
    assert tip.get_parent_name() == "BODY Hand"
    assert tip.get_pose().position.x == pytest.approx(0.11)
    assert tip.get_all_sensed_obj_names() == []
    assert tip.get_sensed_obj_name(0) is None
    listed = {each.name: each for each in client.list(loaded).objects}
    assert listed["/ambf/env/tip"].kind == "ghost_object"
    assert listed["/ambf/env/tip"].parent == "/ambf/env/Hand"
    with pytest.raises(TypeError, match="is a ghost object"):
        tip.set_pos(0.0, 0.0, 0.0)

    hand.set_pos(1.95, 0.27, 0.0)
    eventually(lambda: len(tip.get_all_sensed_obj_names()) == 2)
    assert set(tip.get_all_sensed_obj_names()) == {"/ambf/env/BODY Peg", "/ambf/env/GHOST twin"}
    assert tip.get_sensed_obj_name(1) in tip.get_all_sensed_obj_names()

    client.remove("/ambf/env/twin")
    eventually(lambda: tip.get_all_sensed_obj_names() == ["/ambf/env/BODY Peg"])
    client.remove("/ambf/env/Hand")  # the ghost stays where it was
    assert tip.wait_for_next_state()
    assert tip.get_all_sensed_obj_names() == ["/ambf/env/BODY Peg"]
    client.unload(loaded)
    eventually(lambda: not any("tip" in name or "twin" in name for name in master.names()), 5.0, "topics are gone")
