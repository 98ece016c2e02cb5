"""Soft bodies through the public face: topics, handle, list, commands, and what is left when they go."""

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

    client.unload(loaded)
    eventually(lambda: not any("Blob" in name for name in master.names()), 5.0, "topics are gone")
