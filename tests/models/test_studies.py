"""Our scenes for the original's: the boards of the dissertation's studies with pieces that stay on their pegs, and what
else its launch file has that no robot is."""

import math
import os
from pathlib import Path

import numpy as np
import pytest
from own_files import MODELS, load

BOARDS = ("puzzle4", "puzzle5")
STUDIES = MODELS / "studies"
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


# Ours, and the file of the original below its multi-bodies.
SWAPPED = {
    **{f"studies/{name}": f"puzzles/{name}" for name in ("puzzle1", "puzzle2", *BOARDS)},
    "studies/screwdriver_env": "environments/ScrewDriverEnv/env",
    "studies/knot_env": "environments/KnotEnv/env",
    "original/parallel_structure": "puzzles/parallel_structure",
    "original/toy_car2": "robots/blender-toy-car2",
    "original/sophie": "robots/sophie",
    "original/textured_ground": "environments/TexturedGround/env",
}


@pytest.mark.parametrize("name", SWAPPED)
def test_names_order_masses_and_places_are_those_of_the_original(name):
    path = COMPAT / f"ambf_models/descriptions/multi-bodies/{SWAPPED[name]}.yaml"
    if not path.exists():
        pytest.skip("the original's models are not here")
    ours, theirs = load(MODELS / f"{name}.yaml"), load(path)
    assert ours["namespace"] == theirs["namespace"]
    for kind in ("bodies", "joints"):
        assert ours.get(kind, []) == theirs[kind]
        assert [ours[block]["name"] for block in theirs[kind]] == [theirs[block]["name"] for block in theirs[kind]]
    for joint in theirs["joints"]:
        mine, other = ours[joint], theirs[joint]
        assert all(mine[key] == other[key] for key in ("type", "parent", "child"))
        assert mine.get("passive", False) == other.get("passive", False)
    for body in ours["bodies"]:
        mine, other = ours[body], theirs[body]
        assert mine["mass"] == other["mass"]
        assert mine.get("passive", False) == other.get("passive", False)
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


def carry(world, body, stations):
    """From where it is, upright, in straight lines of 1.5 s."""
    from ambf_core import BodyMode

    place = world.state.body_pose[body, :3].copy()
    for station in stations:
        for share in np.linspace(0, 1, 151)[1:]:
            at = (1 - share) * place + share * np.array(station)
            world.commands.set_body(body, [*at, 0, 0, 0, 1], BodyMode.POSE)
            world.step(10)
        place = np.array(station)


def test_the_plate_of_study_b_goes_over_the_pegs_of_its_base_and_lies_there():
    from ambf_core import BodyMode, World

    task = MODELS / "descriptions/tasks/puzzle1.yaml"
    world = World(STUDIES / "puzzle1.yaml", task, world=STUDIES / "study_b_world.yaml")
    plate, base = world.body("CenterPuzzle"), world.body("PuzzleBase")
    goals = world.task("over_the_pegs").goals
    before = world.state.body_pose.copy()
    world.step(1500)
    moved = np.abs(world.state.body_pose[:, :2] - before[:, :2]).max()
    assert moved < 0.01 and np.abs(world.state.body_twist).max() < 1e-3, "all of it stands on the table"
    x, y, z = world.state.body_pose[base, :3]
    carry(world, plate, [(1.0, 0.0, 0.0), (x, y, 0.0), (x, y, z + 0.35)])
    assert not world.state.goal_done[goals].any()
    carry(world, plate, [(x, y, z + 0.21)])
    world.commands.body_mode[plate] = BodyMode.NONE
    world.step(1500)
    assert world.state.body_pose[plate, :3] == pytest.approx([x, y, z + 0.2], abs=0.006), "on the base, over its pegs"
    assert world.state.goal_done[goals].all()
    for across in ([15, 0, 0], [0, 15, 0]):  # along y its handles, which hang down, would hold it too
        world.commands.set_body(plate, [*across, 0, 0, 0], BodyMode.WRENCH)
        world.step(500)
    away = world.state.body_pose[plate, :2] - world.state.body_pose[base, :2]
    assert np.abs(away).max() < 0.05, "the pegs hold it, friction alone would not"


def test_pieces_of_the_practice_scene_go_into_their_cavities_below_the_lid():
    from ambf_core import BodyMode, World

    task = MODELS / "descriptions/tasks/puzzle2.yaml"
    world = World(STUDIES / "puzzle2.yaml", task, world=STUDIES / "practice_world.yaml")
    goals = world.task("each_in_its_cavity").goals
    lid = world.joint("Mold_A-MoldHinge")
    clasps = [world.joint(f"Mold_A-HandleBase{side}") for side in ("Left", "Right")]

    def turn(joints, to):
        begun = world.state.joint_position[joints].copy()
        for share in np.linspace(0, 1, 151)[1:]:
            world.commands.set_joints((1 - share) * begun + share * np.array(to), joints=joints)
            world.step(10)

    world.step(500)
    turn(clasps, [0.9, -0.9])
    turn([lid], [1.8])
    mould = world.state.body_pose[world.body("Mold_A"), :3].copy()
    pieces = [block for block in load(task)["TASK each_in_its_cavity"]["goals"]]
    for goal in pieces:
        piece = world.body(goal["piece"].removeprefix("BODY "))
        at = mould + [*goal["location"]["position"].values()]
        above = world.state.body_pose[piece, :2]
        carry(world, piece, [(*above, 0.0), (*at[:2], 0.0), (*at[:2], at[2] + 0.06)])
        world.step(200)
        world.commands.body_mode[piece] = BodyMode.NONE
        world.step(600)
    assert world.state.goal_done[goals].all() and len(pieces) == 7
    turn([lid], [0.0])
    assert world.state.joint_position[lid] == pytest.approx(0.0, abs=0.02), "there is room below the lid"
    assert world.state.goal_done[goals].all()
