"""Our models for the original's places that are neither robots nor boards of the studies: they do what the original's
do."""

import math

import numpy as np
import pytest
from ambf_client.rotations import quaternion_from_matrix
from ambf_core import BodyMode, JointMode, World
from own_files import DESCRIPTIONS, MODELS, load
from test_studies import STUDIES, turn

ORIGINAL = MODELS / "original"


def test_the_screwdriver_turns_the_disc_when_its_tips_are_between_the_blocks():
    file, task = STUDIES / "screwdriver_env.yaml", DESCRIPTIONS / "tasks/screwdriver_env.yaml"
    world = World(file, task, world=STUDIES / "screwdriver_env_world.yaml")
    handle, disc, joint = world.body("SDHandle"), world.body("Cylinder"), world.joint("FixedBase-Cylinder")
    goals = world.task("turn_the_disc").goals
    middle = world.state.body_pose[disc, :3].copy()
    tilted = turn(load(file)["BODY FixedBase"]["location"]["orientation"])
    above = 0.368 + 0.417 + 0.0575 + 0.01  # of the handle's frame, its tips 10 mm over the disc

    def hold(height, angle):
        """The handle is the only thing that is held."""
        c, s = math.cos(angle), math.sin(angle)
        turned = quaternion_from_matrix(tilted @ [[c, -s, 0], [s, c, 0], [0, 0, 1]])
        world.commands.set_body(handle, [*(middle + tilted[:, 2] * height), *turned], BodyMode.POSE)
        world.step(10)

    for angle in np.linspace(0.0, 1.0, 60):
        hold(above + 0.3, angle)
    assert abs(world.state.joint_position[joint]) < 0.02, "above the blocks it turns nothing"
    for height in np.linspace(above + 0.3, above, 100):
        hold(height, 0.0)
    for _ in range(30):
        hold(above, 0.0)
    assert world.state.goal_done[goals].tolist() == [True, False, False]
    for angle in np.linspace(0.0, math.pi, 250):
        hold(above, angle)
    for _ in range(30):
        hold(above, math.pi)
    assert abs(world.state.joint_position[joint]) == pytest.approx(math.pi, abs=0.15)
    assert world.state.goal_done[goals].all()


def test_the_threads_of_the_knots_hang_between_their_mounts():
    world = World(STUDIES / "knot_env.yaml", world=STUDIES / "knot_env_world.yaml")
    before = world.state.body_pose.copy()
    world.step(1500)
    pose = world.state.body_pose
    ends = [world.body(f"BeadRAttach{end}") for end in ("Left", "Left_001", "Right", "Right_001")]
    assert np.abs(pose[ends, :3] - before[ends, :3]).max() < 0.01, "the ends stay where they are fixed"
    middles = [world.body("BeadR_005"), world.body("BeadR_005_001")]
    sag = before[middles, 2] - pose[middles, 2]
    assert ((sag > 0.0) & (sag < 0.4)).all(), "what is between them sags and lies nowhere"
    assert np.abs(pose[:, :2] - before[:, :2]).max() < 0.05


def test_the_second_car_stands_on_its_springs_and_drives_on_the_textured_ground():
    ground, car = ORIGINAL / "textured_ground.yaml", ORIGINAL / "toy_car2.yaml"
    world = World(ground, car, world=DESCRIPTIONS / "world/original_world.yaml")
    chassis = world.body("Chassis")
    wheels = [world.joint(f"Shock{strut}-Wheel{wheel}") for strut, wheel in (("BL", "BR"), ("BR", "BL"))]
    world.step(1500)
    x, _, z = world.state.body_pose[chassis, :3]
    assert -1.2 < z < -1.0 and np.abs(world.state.body_twist[chassis]).max() < 0.02, "it stands"
    world.commands.set_joints(np.full(2, -4.0), joints=wheels, mode=JointMode.VELOCITY)
    world.step(1500)
    assert world.state.body_pose[chassis, 0] - x > 0.3, "forwards: the axes look to the right"
    assert world.state.body_pose[chassis, 2] == pytest.approx(z, abs=0.05)


def test_sophie_stands_and_the_parallel_structure_keeps_its_shape():
    sophie, links = ORIGINAL / "sophie.yaml", ORIGINAL / "parallel_structure.yaml"
    world = World(sophie, world=DESCRIPTIONS / "world/original_world.yaml")
    trunk = world.body("Body")
    world.step(2500)
    pose = world.state.body_pose[trunk]
    up = 1.0 - 2.0 * (pose[3] ** 2 + pose[4] ** 2)
    assert up > 0.9 and -1.45 < pose[2] < -1.0, "on its feet"
    world = World(links, world=DESCRIPTIONS / "world/original_world.yaml")
    world.step(500)
    across = world.state.joint_position[[world.joint(name) for name in ("l1-l2", "l2-l3", "l3-l4")]]
    assert np.isfinite(across).all() and np.abs(across).max() < 1.05
