"""The original's example of sensors and actuators over ROS: its files and the calls of its users' scripts as they are.

An arm picks up a box by what its sensor sees, carries it and puts it down; commands travel by topics, while the world
is stepped.
"""

import numpy as np
import pytest
import scenes
from harness import eventually

from ambf_msgs.srv import Step

ARM = "multi-bodies/robots/blender-kuka-lbr-med.yaml"
EXAMPLE = "../examples/sensors_actuators_example"
HOME = (0.0, 0.4, 0.0, -1.0, 0.0, 0.5, 0.0)
AWAY = (0.5, *HOME[1:])
# What old files are warned of; no command is lost.
ALLOWED = [r"^(?!.*refused).*(warning|warn)\b", r"watchdog", r"expired", r"'/ambf/env/.*' has ended"]


def rotated(quaternion, vector):
    u, w = np.array(quaternion[:3]), quaternion[3]
    return np.asarray(vector) + 2.0 * np.cross(u, np.cross(u, vector) + w * np.asarray(vector))


@pytest.fixture(params=[(0, 1, 2), (1, 0, 2)], ids=["arm_first", "tool_first"])
def simulator(request, compat, tmp_path, master, start):
    scenes.write(tmp_path)
    world = tmp_path / "world.yaml"
    world.write_text(world.read_text().replace("z: 0.0}\nlights", "z: -9.81}\nlights"))
    assert "-9.81" in world.read_text()
    launch = tmp_path / "launch.yaml"
    launch.write_text(
        f"world config: ./world.yaml\ncolor config: ./colors.yaml\nmultibody configs:\n"
        f"  - {compat / ARM}\n  - {compat / EXAMPLE / 'sensors_actuators.yaml'}\n  - {compat / EXAMPLE / 'box.yaml'}\n"
    )
    order = ",".join(map(str, request.param))
    made = start("--launch_file", launch, "-l", order, master_uri=master.uri, allowed=ALLOWED)
    made.wait_loaded(3)
    yield made
    made.stop()


def test_an_old_script_picks_up_carries_and_puts_down_what_the_sensor_sees(simulator, ros):
    from ambf_client import Client

    client = Client()
    client.connect()
    for name in ("tip_actuator0", "tip_sensor_array", "base", "Link7", "Box"):
        eventually(lambda n=name: n in " ".join(client.get_obj_names()), what=f"{name} in {client.get_obj_names()}")
    grip, eye = client.get_obj_handle("tip_actuator0"), client.get_obj_handle("tip_sensor_array")
    base, tip, box = (client.get_obj_handle(name) for name in ("base", "Link7", "Box"))
    step = ros.service("/ambf/env/World/Step", Step)

    def until(condition, what, *actions):
        """Steps, and commands as scripts do, in each turn."""

        def turn():
            for action in actions:
                action()
            assert step(n=20).success
            return condition()

        # No faster than the wall: commands come by topic, and the watchdog counts simulated time.
        return eventually(turn, 60.0, what, interval=0.02)

    def arm_to(joints):
        def act():
            for index, value in enumerate(joints):
                base.set_joint_pos(index, value)

        return act

    def is_at(joints):
        return lambda: np.allclose(base.get_all_joint_pos()[:7], joints, atol=0.01)

    def pose(handle):
        p, q = handle.get_pos(), handle.get_rot()
        return np.array([p.x, p.y, p.z]), (q.x, q.y, q.z, q.w)

    def in_tip():
        (place, turned), (at, _) = pose(tip), pose(box)
        return rotated((*(-np.array(turned[:3])), turned[3]), at - place)

    until(is_at(HOME), "the arm is at home", arm_to(HOME))
    place, turned = pose(tip)

    def box_before_the_sensor():
        at = place + rotated(turned, (0.0, 0.0, 0.19))
        box.set_pos(*at)
        box.set_rot(list(turned))

    until(lambda: all(eye.is_triggered(i) for i in range(4)), "the sensor sees it", arm_to(HOME), box_before_the_sensor)
    assert eye.get_count() == 4
    assert eye.get_sensed_object(0).endswith("Box")
    assert not grip.is_actuated()

    def hold():
        grip.actuate_from_sensor_data("Proximity0")

    until(grip.is_actuated, "it holds", arm_to(HOME), box_before_the_sensor, hold)
    box.clear_cmd()
    held, start = in_tip(), pose(box)[0]
    until(is_at(AWAY), "the arm has turned", arm_to(AWAY), hold)
    assert np.linalg.norm(pose(box)[0] - start) > 0.02
    assert np.linalg.norm(in_tip() - held) < 2e-3
    grip.deactuate()
    until(lambda: not grip.is_actuated(), "it lets go", arm_to(AWAY))
    height = pose(box)[0][2]
    until(lambda: pose(box)[0][2] < height - 0.02, "the box falls", arm_to(AWAY))
    client.clean_up()
