"""The thread of the suturing scene: its forty links stay together while the needle is pulled."""

import itertools
from pathlib import Path

import numpy as np
import yaml
from ambf_client.rotations import matrix_from_quaternion
from ambf_core import BodyMode, World

SUTURING = Path(__file__).resolve().parents[2] / "ambf_models/suturing"
FILES = ("phantom.yaml", "ghosts.yaml", *(f"{part}psm{arm}.yaml" for arm in "12" for part in ("", "ghosts_actuators_")))
SPEED = 0.1  # m/s
WAY = ((0.0, 0.0, 0.03), (0.04, 0.0, 0.0), (-0.08, 0.0, 0.0), (0.0, 0.05, 0.0))  # of the needle, m
GAP = 1e-4  # m


def links(model):
    """(parent, its pivot, child, its pivot) of every joint of the thread."""
    for joint in (model[name] for name in model["joints"] if "Thread" in name):
        pivots = [[joint[f"{side} pivot"][axis] for axis in "xyz"] for side in ("parent", "child")]
        yield joint["parent"].removeprefix("BODY "), pivots[0], joint["child"].removeprefix("BODY "), pivots[1]


def test_every_link_is_at_its_neighbour_while_the_needle_is_pulled():
    joints = list(links(yaml.safe_load((SUTURING / "phantom.yaml").read_text())))
    assert len(joints) == 40
    world = World(*(SUTURING / name for name in FILES), world=SUTURING / "world.yaml")

    def place(body, pivot):
        pose = world.state.body_pose[world.body(f"/ambf/env/phantom/{body}")]
        return pose[:3] + matrix_from_quaternion(pose[3:]) @ pivot

    needle = world.body("/ambf/env/phantom/Needle")
    target, gaps = world.state.body_pose[needle].copy(), []
    begin = target[:3].copy()
    for way, part in itertools.product(WAY, range(10)):
        steps = int(100 * np.linalg.norm(way) / SPEED)
        for _ in range(steps // 5):
            target[:3] += np.array(way) / 10 / (steps // 5)
            world.commands.set_body(needle, target, BodyMode.POSE)
            world.step(5)
        gaps.append(max(np.linalg.norm(place(a, pa) - place(b, pb)) for a, pa, b, pb in joints))
        assert np.isfinite(gaps[-1]), part
    assert np.linalg.norm(world.state.body_pose[needle, :3] - begin - np.sum(WAY, axis=0)) < 0.01, "it follows"
    assert max(gaps) < GAP
    world.close()
