"""Soft bodies through the public face: topics, handle, list, commands, and what is left when they go."""

import numpy as np
import pytest
from ambf_client import SoftBody
from harness import eventually

BLOB = """\
adf version: 1.0
namespace: /ambf/env/
soft bodies: [SOFT Blob]
SOFT Blob:
  name: Blob
  shape: BOX
  geometry: {x: 0.1, y: 0.1, z: 0.1}
  collision shape: BOX
  collision geometry: {x: 0.1, y: 0.1, z: 0.1}
  mass: 0.8
  location: {position: {x: 3.0, y: 0.0, z: 0.5}}
  config: {kDP: 0.05, kMT: 0.1, piterations: 4, fixed nodes: [0, 1, 2, 3]}
"""


def test_a_soft_body_is_loaded_pushed_carried_and_removed(bench, client, master):
    loaded = client.load(text=BLOB)
    assert "/ambf/env/Blob" in loaded.objects
    blob = client.wait_for("Blob")
    assert isinstance(blob, SoftBody)
    assert blob.get_identifier() == "/ambf/env/SOFT Blob"
    assert blob.get_mass() == pytest.approx(0.4), "half of its nodes are fixed"
    listed = {each.name: each for each in client.list(loaded).objects}
    assert listed["/ambf/env/Blob"].kind == "soft_body"
    assert blob.get_pos().x == pytest.approx(3.0, abs=0.02)

    blob.set_pos(3.0, 0.0, 0.8)
    eventually(lambda: blob.get_pos().z > 0.7)
    blob.set_force(0.0, 0.0, 1.0)
    assert blob.wait_for_next_state()

    assert ("/ambf/env/Blob/Command", "ambf_msgs/SoftBodyCmd", True) in blob.open_topics()
    client.unload(loaded)
    eventually(lambda: not any("Blob" in name for name in master.names()), 5.0, "topics are gone")


SHEET = """\
adf version: 1.0
namespace: /ambf/env/
soft bodies: [SOFT Cube]
SOFT Cube:
  name: Cube
  collision shape: BOX
  collision geometry: {x: 0.1, y: 0.1, z: 0.1}
  mass: 0.8
  location: {position: {x: 5.0, y: 0.0, z: 1.5}}
  config: {kDP: 0.05, kMT: 0.1, piterations: 4, fixed nodes: [0]}
"""


def test_nodes_are_seen_and_pulled_one_by_one(bench, client):
    loaded = client.load(text=SHEET)
    cube = client.wait_for("Cube")
    nodes = cube.get_nodes()
    assert nodes.shape == (8, 3)
    assert np.allclose(nodes.mean(axis=0)[:2], (5.0, 0.0), atol=0.15)
    assert cube.get_fixed_nodes() == [0]
    faces = cube.get_faces()
    assert faces.shape == (12, 3) and faces.max() == 7
    assert cube.get_lines().shape == (0, 2)
    assert any(name.endswith("/Nodes") for name, _, _ in cube.open_topics())

    free = int(np.argmax(np.linalg.norm(nodes - nodes[0], axis=1)))
    start = cube.get_nodes()

    def pulled():
        cube.set_node_forces([free], [[0.0, 0.0, 40.0]])
        now = cube.get_nodes()
        return now[free, 2] > now[0, 2] + 0.05

    eventually(pulled, 5.0, "a force on one node lifts it above what holds it")
    assert np.allclose(cube.get_nodes()[0], start[0], atol=1e-6), "the fixed node stays"
    with pytest.raises(ValueError, match="2 nodes, but 1 forces"):
        cube.set_node_forces([1, 2], [[0.0, 0.0, 1.0]])
    cube.set_node_forces([], [])
    cube.set_inactive()
    client.unload(loaded)


def test_wrong_forces_on_nodes_are_refused_and_named(bench, client, ros):
    from geometry_msgs.msg import Vector3

    from ambf_msgs.msg import SoftBodyForces

    bench.allowed += [r"command to '.*Cube' refused", r"and \d+ more refused", r"watchdog", r"expired"]
    loaded = client.load(text=SHEET)
    client.wait_for("Cube")
    forces = ros.talk("/ambf/env/Cube/NodeForces", SoftBodyForces)
    far = [Vector3(0.0, 0.0, 1e12)]
    for nodes, vectors, why in (
        ([1, 2], [Vector3(0.0, 0.0, 1.0)], "2 nodes and 1 forces"),
        ([8], [Vector3(0.0, 0.0, 1.0)], "there is no node 8: the body has 8, from 0"),
        ([1], far, "the force on node 1 is not finite or beyond 1e9 N"),
        ([1], [Vector3(0.0, float("nan"), 0.0)], "the force on node 1 is not finite or beyond 1e9 N"),
        ([1] * 9, far * 9, "9 forces for 8 nodes: give each node one"),
    ):
        seen = bench.log().count(why)

        def named(nodes=nodes, vectors=vectors, why=why, seen=seen):
            forces.publish(SoftBodyForces(nodes=nodes, forces=vectors))
            return bench.log().count(why) > seen

        # Of several refusals within a second the first is told with its words, the others are counted.
        eventually(named, 10.0, why, interval=0.3)
    client.unload(loaded)
