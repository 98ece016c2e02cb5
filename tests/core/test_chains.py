"""Chains of ADF files say where the bodies of a simulated world are."""

import numpy as np
import pytest

ambf_core = pytest.importorskip("ambf_core")
kinematics = pytest.importorskip("ambf_client.kinematics")

BODY = "{{name: {name}, mass: {mass}, shape: BOX, geometry: {{x: 0.1, y: 0.1, z: 0.1}}, location: {where}}}"
NOWHERE = "{position: {x: 0, y: 0, z: 0}, orientation: {r: 0, p: 0, y: 0}}"
SCENE = f"""
bodies: [BODY a, BODY b, BODY c, BODY d]
joints: [JOINT ab, JOINT bc, JOINT cd]
BODY a: {BODY.format(name="a", mass=0, where=NOWHERE)}
BODY b: {BODY.format(name="b", mass=1, where=NOWHERE)}
BODY c: {BODY.format(name="c", mass=1, where=NOWHERE)}
BODY d: {BODY.format(name="d", mass=1, where=NOWHERE)}
JOINT ab: {{parent: BODY a, child: BODY b, type: revolute, parent pivot: {{x: 0.1, y: 0.2, z: 0.3}},
  child pivot: {{x: 0, y: 0.1, z: -0.2}}, parent axis: {{x: 0.6, y: 0, z: 0.8}}, child axis: {{x: 0, y: 1, z: 0}},
  joint offset: 0.5, offset: 0.2, joint limits: {{low: -1, high: 1}}}}
JOINT bc: {{name: slide, parent: BODY b, child: BODY c, type: prismatic, parent pivot: {{x: 0, y: 0.2, z: 0}},
  child pivot: {{x: 0.1, y: 0, z: 0}}, parent axis: {{x: 0, y: 0, z: 1}}, child axis: {{x: 6.0e-6, y: 8.0e-6, z: -1}},
  joint offset: 0.05, offset: 0.3, joint limits: {{low: -0.2, high: 0.2}}}}
JOINT cd: {{name: last, parent: BODY c, child: BODY d, type: revolute, parent pivot: {{x: 0, y: 0, z: 0.3}},
  child pivot: {{x: 0, y: 0, z: 0}}, parent axis: {{x: 1, y: 0, z: 0}}, child axis: {{x: -1, y: 1.0e-3, z: 0}},
  joint offset: -0.4, joint limits: {{low: 1, high: -1}}}}
"""


def test_poses_follow_from_joint_positions(tmp_path):
    file = tmp_path / "chain.yaml"
    file.write_text(SCENE)
    chain = kinematics.chain_of_adf(file, "a", "d")
    assert chain.names == ["JOINT ab", "slide", "last"]
    assert chain.lower[0] == -1.0 and np.isinf(chain.lower[2]), "reversed limits are none"
    with ambf_core.World(file) as world:
        world.set_gravity([0.0, 0.0, 0.0])
        row = [next(i for i, name in enumerate(world.bodies) if name.split("/")[-1] == body) for body in "ad"]
        world.step(300)
        base, tip = (world.state.body_pose[i] for i in row)
        assert base[:3] == pytest.approx([0.0, 0.0, 0.0])
        pose = chain.forward(world.state.joint_position)
        assert pose[:3, 3] == pytest.approx(tip[:3], abs=1e-4)
        x, y, z, w = tip[3:]
        column = [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)]
        assert pose[:3, 0] == pytest.approx(column, abs=1e-4)


@pytest.mark.parametrize(
    ("change", "error", "text"),
    [
        (("parent axis: {x: 1, y: 0, z: 0}", "parent axis: {x: 0, y: 0, z: 0}"), ValueError, "no length"),
        (None, ValueError, "moves"),
    ],
)
def test_what_is_no_chain_is_refused(tmp_path, change, error, text):
    file = tmp_path / "chain.yaml"
    file.write_text(SCENE.replace(*change) if change else SCENE)
    with pytest.raises(error, match=text):
        kinematics.chain_of_adf(file, "a", "d" if change else "a")
