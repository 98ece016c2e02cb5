"""Threads and needles through the public face: nodes and topology of a thread, what carries, pulls and holds it, and
what a needle's state says while it goes into tissue and out of it."""

import numpy as np
import pytest
from ambf_client import Actuator, SoftBody
from harness import eventually

SCENE = """\
adf version: 1.0
namespace: /ambf/env/
bodies: [BODY Post, BODY Tool]
soft bodies: [SOFT Suture, SOFT Pad]
actuators: [ACTUATOR clamp, ACTUATOR needle]
BODY Post: {name: Post, mass: 0.0, location: {position: {x: 6.01, y: 0.0, z: 1.0}}, collision shape: BOX,
            collision geometry: {x: 0.01, y: 0.01, z: 0.01}}
SOFT Suture:
  name: Suture
  location: {position: {x: 6.0, y: 0.0, z: 1.1}}
  tissue: {kind: thread, points: [{x: 0, y: 0, z: 0}, {x: 0, y: 0, z: -0.1}], radius: 0.0005, density: 1000,
           element size: 0.01, regions: [{sphere: 0.001, fixed: true}]}
ACTUATOR clamp: {name: clamp, type: Constraint, parent: BODY Post, hardness: 500}
SOFT Pad:
  name: Pad
  collision shape: BOX
  collision geometry: {x: 0.04, y: 0.04, z: 0.02}
  location: {position: {x: 7.0, y: 0.0, z: 1.0}}
  tissue: {young modulus: 20000, element size: 0.01,
           regions: [{box: {x: 0.1, y: 0.1, z: 0.002}, location: {position: {x: 0, y: 0, z: -0.01}}, fixed: true}]}
BODY Tool: {name: Tool, mass: 0.05, location: {position: {x: 7.0, y: 0.0, z: 1.0315}}, gravity: {x: 0, y: 0, z: 0},
            collision shape: SPHERE, collision geometry: {radius: 0.005}, inertia: {ix: 1e-4, iy: 1e-4, iz: 1e-4}}
ACTUATOR needle: {name: needle, type: Needle, parent: BODY Tool, puncture force: 0.1, friction: 5,
                  arc: [{x: 0, y: 0, z: -0.02}, {x: 0, y: 0, z: 0}]}
"""


def test_threads_and_needles_are_seen_and_commanded(bench, client):
    bench.allowed += [r"nothing for 0.5 s"]  # where the machine is slow
    client.world.step(0)  # the world waits for our steps
    loaded = client.load(text=SCENE)
    suture, clamp, needle = (client.wait_for(name) for name in ("Suture", "clamp", "needle"))
    assert isinstance(suture, SoftBody) and isinstance(needle, Actuator)
    client.world.step(1)
    assert suture.get_nodes() == pytest.approx(np.array([(6.0, 0.0, 1.1 - 0.01 * k) for k in range(11)]), abs=1e-5), (
        "from one end to the other"
    )
    assert suture.get_lines().tolist() == [[k, k + 1] for k in range(10)] and len(suture.get_faces()) == 0
    assert suture.get_fixed_nodes() == [0]
    whole = 1000.0 * np.pi * 0.0005**2 * 0.1
    assert suture.get_mass() == pytest.approx(0.95 * whole, rel=1e-5), "half a segment hangs on what is fixed"
    assert suture.get_pos().z == pytest.approx(1.05, abs=1e-4)

    def nodes_after(steps, wanted):
        """The nodes, once those that came are as they are wanted."""
        client.world.step(steps)
        eventually(lambda: wanted(suture.get_nodes()), 5.0, f"as wanted, not {suture.get_nodes().tolist()}")
        return suture.get_nodes()

    for step in range(20):
        suture.set_pos(6.0, 0.0, 1.101 + 0.001 * step)
        client.world.step(10)
    carried = nodes_after(100, lambda nodes: nodes[0, 2] > 1.1199)
    assert carried[10, 2] == pytest.approx(1.02, abs=1e-3), "the rest came along, as long as before"
    clamp.actuate("Suture")
    client.world.step(10)
    assert clamp.is_actuated()
    held = int(np.argmin(np.linalg.norm(suture.get_nodes() - (6.01, 0.0, 1.0), axis=1)))
    before = suture.get_nodes()[held]
    suture.set_node_forces([5], [[0.0, 0.05, 0.0]])
    pulled = nodes_after(100, lambda nodes: nodes[5, 1] > 0.005)
    assert pulled[0] == pytest.approx((6.0, 0.0, 1.12), abs=1e-4)
    assert np.linalg.norm(pulled[held] - before) < 1e-3, "it holds"
    suture.set_node_forces([], [])
    clamp.deactuate()
    client.world.step(10)
    assert not clamp.is_actuated()

    tool = client.wait_for("Tool")
    assert not needle.is_actuated()

    def moved(force, steps):
        for _ in range(steps // 10):
            tool.set_force(0.0, 0.0, force)
            client.world.step(10)
        return needle.is_actuated()

    assert needle.get_force() == pytest.approx((0.0, 0.0, 0.0)) and needle.get_bites() == 0
    assert moved(-0.15, 200), "through the surface of the pad, and in it"
    eventually(lambda: needle.get_force()[2] < -0.05, 5.0, "the force on the pad")
    assert needle.get_stitches() == needle.get_tied() == 0, "it has no thread"
    assert tool.get_pos().z < 1.029
    assert not moved(0.6, 200), "and out again"
    client.unload(loaded)
