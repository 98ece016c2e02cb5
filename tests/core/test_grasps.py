"""Sensors and actuators in a world: what a ray sees can be held, and what is held is shown."""

import numpy as np
import pytest
from ambf_core import MODELS, ActuatorMode, World, WorldBatch

SCENE = """
bodies: [BODY hand, BODY cube]
sensors: [SENSOR eye]
actuators: [ACTUATOR grip]
namespace: /test/
BODY hand: {name: hand, mass: 1, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1}, gravity: {x: 0, y: 0, z: 0},
  location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}
BODY cube: {name: cube, mass: 0.1, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1}, gravity: {x: 0, y: 0, z: 0},
  collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0, y: 0, z: 0.8}, orientation: {r: 0, p: 0, y: 0}}}
SENSOR eye: {name: eye, parent: BODY hand, type: Proximity, range: 0.3, success when: present,
  array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 0, y: 0, z: -1}},
    {offset: {x: 0.3, y: 0, z: 0}, direction: {x: 0, y: 0, z: -1}}]}
ACTUATOR grip: {name: grip, type: Constraint, parent: BODY hand, sensor: SENSOR eye}
"""


def test_a_ray_sees_and_an_actuator_holds():
    with World(text=SCENE) as world:
        eye, grip, cube = world.sensor("eye"), world.actuator("grip"), world.body("cube")
        world.step(1)
        state = world.state
        assert state.sensor_triggered[eye] == 1 and state.sensor_success[eye] and not state.sensor_matched[eye]
        assert state.element_body[world.elements[eye]].tolist() == [cube, -1]
        assert state.element_distance == pytest.approx([0.15, 0.3]) and state.element_point[0, 2] == pytest.approx(0.85)
        assert state.actuator_held[grip] == 0 and (state.actuator_bodies == -1).all()
        free = world.snapshot()
        world.commands.set_actuator("grip", ActuatorMode.BODY, "cube")
        world.step(10)
        assert state.actuator_bodies[grip, 0] == cube and state.actuator_held[grip] == 1
        world.set_gravity([0, 0, -9.81])
        held = world.snapshot()
        after = [world.step(50), world.hash()]
        world.commands.set_actuator("grip", ActuatorMode.RELEASE)
        world.step(5)
        assert state.actuator_held[grip] == 0
        world.restore(held)
        assert world.commands.actuator_mode[grip] == ActuatorMode.BODY
        assert [world.step(50), world.hash()] == after
        model = world.load(text=SCENE.replace("/test/", "/other/"), pose=[3, 0, 0, 0, 0, 0, 1])
        world.step(5)
        assert world.state.actuator_bodies[grip, 0] == cube and world.state.actuator_held.tolist() == [1, 0]
        world.unload(model)
        world.remove("cube")
        world.step(5)
        assert world.commands.actuator_mode[grip] == ActuatorMode.RELEASE and world.state.actuator_held[grip] == 0
        world.reset()
        assert world.commands.actuator_mode[grip] == ActuatorMode.NONE
        with pytest.raises(ValueError):
            world.restore(free + "-")


def test_rows_of_commanded_bodies_follow_loading_and_removing():
    with World(text=SCENE) as world:
        grip = world.actuator("grip")
        for mode, row in ((ActuatorMode.BODY, 99), (ActuatorMode.BODY, -1), (ActuatorMode.NONE, 99)):
            world.commands.actuator_mode[grip], world.commands.actuator_body[grip] = mode, row
            model = world.load(text=SCENE.replace("/test/", "/other/"), pose=[3, 0, 0, 0, 0, 0, 1])
            assert (world.commands.actuator_mode[grip], world.commands.actuator_body[grip]) == (mode, row)
            world.unload(model)
        for mode in (ActuatorMode.NONE, ActuatorMode.SENSED):
            world.load(text=SCENE.replace("/test/", f"/{mode.name}/"), pose=[3, 0, 0, 0, 0, 0, 1])
            hand, cube = (f"/{mode.name}/{name}" for name in ("hand", "cube"))
            world.commands.actuator_mode[grip], world.commands.actuator_body[grip] = mode, world.body(cube)
            world.remove(hand)
            assert world.commands.actuator_body[grip] == world.body(cube), "a row that is kept for later"
            world.remove(cube)
            assert (world.commands.actuator_mode[grip], world.commands.actuator_body[grip]) == (mode, -1)


def test_an_actuator_is_commanded_with_a_body_in_mode_body_alone():
    with World(text=SCENE) as world:
        for mode, body in ((ActuatorMode.BODY, None), (ActuatorMode.RELEASE, "cube"), (ActuatorMode.SENSED, 1)):
            with pytest.raises(ValueError, match="mode BODY"):
                world.commands.set_actuator("grip", mode, body)
        assert world.commands.actuator_mode.tolist() == [ActuatorMode.NONE]
        world.load(text=SCENE.replace("/test/", "/other/"), pose=[0.5, 0, 0, 0, 0, 0, 1])
        held = world.state.actuator_bodies[world.actuator("/test/grip")]
        for mode, body, holds in (
            (ActuatorMode.BODY, "/test/cube", "/test/cube"),
            (ActuatorMode.BODY, "/other/cube", "/test/cube"),
            (ActuatorMode.RELEASE, None, None),
            (ActuatorMode.BODY, "/other/cube", "/other/cube"),
        ):
            world.commands.set_actuator("/test/grip", mode, body)
            world.step(5)
            assert held[0] == (-1 if holds is None else world.body(holds)), (mode, body)


def test_refused_commands_to_actuators_move_nothing():
    with World(text=SCENE) as world:
        before = world.hash()
        for mode, body, problem in (
            (5, 0, "actuator_mode\\[0\\] is 5"),
            (1, 7, "actuator_body\\[0\\] is 7"),
            (1, world.body("hand"), "grip': it cannot hold the body that it sits on"),
        ):
            world.commands.actuator_mode[0], world.commands.actuator_body[0] = mode, body
            with pytest.raises(ValueError, match=problem):
                world.step(5)
        assert world.hash() == before


def test_worlds_of_a_batch_grasp_each_for_itself():
    with WorldBatch(text=SCENE, n=3, workers=2) as batch:
        batch.commands.actuator_mode[1:, batch.actuator("grip")] = ActuatorMode.SENSED
        batch.step(5)
        assert batch.state.actuator_held[:, 0].tolist() == [0, 1, 1]
        assert np.equal(batch.state.element_body[:, 0], batch.body("cube")).all()


def test_two_hands_lift_a_sheet_of_tissue_by_their_jaws():
    """What their rays still see high above the plate is what they hold."""
    hands = ("left_hand", "right_hand")
    with World(MODELS / "multi-bodies/soft/cloth_two_hands_tissue.yaml") as world:
        eyes = [world.sensor(f"{hand}_eyes") for hand in hands]
        for lift, jaw in ((-0.1095, 0.03), (-0.1095, 0.004), (0.05, 0.004)):
            for hand in hands:
                world.commands.set_joints([lift, jaw, jaw], joints=[f"{hand}-{joint}" for joint in ("lift", "a", "b")])
            world.step(700)
        assert (world.state.sensor_triggered[eyes] == 3).all()
        assert world.state.element_point[world.elements[eyes[0]], 2].min() > 0.15
        world.commands.set_joints([0.03, 0.03], joints=["left_hand-a", "left_hand-b"])
        world.step(300)
        assert world.state.sensor_triggered[eyes].tolist() == [0, 3], "the left one let go"
