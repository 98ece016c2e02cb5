"""The boards of the dissertation's studies: those of the original's files, with pieces that stay on their pegs."""

import math
import os
from pathlib import Path

import numpy as np
import pytest
from own_files import MODELS, load

BOARDS = ("puzzle4", "puzzle5")
COMPAT = Path(os.environ.get("AMBF_COMPAT_DIR", MODELS.parents[1] / "shared/compat"))


def turn(orientation):
    """Rotation matrix of roll, pitch, yaw."""
    r, p, y = (orientation[axis] for axis in "rpy")
    cr, sr, cp, sp, cy, sy = (f(a) for a in (r, p, y) for f in (math.cos, math.sin))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


@pytest.mark.parametrize("name", BOARDS)
def test_names_order_masses_and_places_are_those_of_the_original(name):
    path = COMPAT / f"ambf_models/descriptions/multi-bodies/puzzles/{name}.yaml"
    if not path.exists():
        pytest.skip("the original's models are not here")
    ours, theirs = load(MODELS / f"studies/{name}.yaml"), load(path)
    assert ours["namespace"] == theirs["namespace"]
    for kind in ("bodies", "joints"):
        assert ours[kind] == theirs[kind]
        assert [ours[block]["name"] for block in ours[kind]] == [theirs[block]["name"] for block in theirs[kind]]
    for joint in ours["joints"]:
        assert all(ours[joint][key] == theirs[joint][key] for key in ("type", "parent", "child"))
    for body in ours["bodies"]:
        mine, other = ours[body], theirs[body]
        assert mine["mass"] == other["mass"]
        here, there = (np.array([*each["location"]["position"].values()]) for each in (mine, other))
        assert np.abs(here - there).max() < 0.010, body
        away = turn(mine["location"]["orientation"]).T @ turn(other["location"]["orientation"])
        assert np.trace(away) > 1.0 + 2.0 * math.cos(math.radians(1.0)), body


@pytest.mark.parametrize("name", BOARDS)
def test_pieces_come_to_rest_about_their_pegs(name):
    from ambf_core import World

    world = World(MODELS / f"studies/{name}.yaml", world=MODELS / "studies/world.yaml")
    before = world.state.body_pose.copy()
    world.step(2500)
    pose = world.state.body_pose
    pieces = [each for each in load(MODELS / f"studies/{name}.yaml")["bodies"] if "Puzzle" in each]
    assert len(pieces) == 6
    for piece in pieces:
        body = world.body(piece.removeprefix("BODY "))
        assert pose[body, 2] == pytest.approx(-1.102, abs=0.005), "its lower side lies on the base"
        assert np.abs(pose[body, :2] - before[body, :2]).max() < 0.07, "about its peg"
    resting = pose.copy()
    world.step(500)
    assert np.abs(world.state.body_pose - resting).max() < 1e-3
