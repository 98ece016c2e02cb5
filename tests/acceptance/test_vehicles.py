"""Vehicles from outside: the client drives one; topics, steps, lists, refusals; wheels that come later."""

import math

import pytest
import rospy
import scenes
from ambf_client import Client
from geometry_msgs.msg import Vector3, Wrench
from harness import BENCH_ALLOWED, eventually

from ambf_msgs.msg import RigidBodyState, VehicleCmd, VehicleState
from ambf_msgs.srv import Step

PLACES = {"w0": (0.3, 0.2), "w1": (0.3, -0.2), "w2": (-0.3, 0.2), "w3": (-0.3, -0.2)}
MASS, BASE = 20.0, 0.6


def wheel(name):
    x, y = PLACES[name]
    part = "mesh: wheel.obj" if name == "w3" else f"body: BODY {name}"
    return (
        f"    - {{{part}, radius: 0.1, friction: 1, roll influence: 0.2, offset: {{x: {x}, y: {y}, z: 0}}, "
        "suspension: {stiffness: 60, damping: 6, compression: 6, rest length: 0.15}, "
        "steering limits: {low: -0.4, high: 0.4}, max engine power: 30, max brake power: 60}\n"
    )


CAR = (
    "adf version: 1.0\nnamespace: /ambf/env/\nhigh resolution path: ./\nvehicles: [VEHICLE car]\n"
    "VEHICLE car:\n  name: car\n  chassis: BODY chassis\n  wheels:\n" + "".join(map(wheel, PLACES))
)
PARTS = """\
adf version: 1.0
namespace: /ambf/env/
gravity: {x: 0.0, y: 0.0, z: -9.81}
bodies: [BODY floor, BODY chassis, BODY w0, BODY w1, BODY w2]
BODY floor: {name: floor, mass: 0, collision shape: PLANE, collision geometry: {normal: {x: 0, y: 0, z: 1}, offset: 0}}
BODY chassis: {name: chassis, mass: 20, location: {position: {x: 0, y: 0, z: 0.209}}, collision shape: BOX,
               collision geometry: {x: 0.7, y: 0.3, z: 0.1}, damping: {linear: 0, angular: 0}}
""" + "".join(
    f"BODY {name}: {{name: {name}, mass: 1, location: {{position: {{x: 0, y: {n}, z: 3}}}}, collision shape: SPHERE, "
    "collision geometry: {radius: 0.1}}\n"
    for n, name in enumerate(("w0", "w1", "w2"), start=2)
)
TRIANGLE = "v 0 0 0.1\nv 0.1 0 0\nv 0 0.02 -0.1\nf 1 2 3\n"


@pytest.fixture
def simulator(tmp_path, master, start):
    (tmp_path / "wheel.obj").write_text(TRIANGLE)
    launch = scenes.write(tmp_path, CAR)
    (tmp_path / "parts.yaml").write_text(PARTS)
    made = start("--launch_file", launch, "-l", "0", master_uri=master.uri, allowed=BENCH_ALLOWED)
    made.wait_loaded()
    yield made
    made.stop()


@pytest.fixture
def client(simulator):
    with Client() as made:
        yield made


def heading(pose):
    q = pose.orientation
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))


def test_the_client_drives_a_vehicle_whose_parts_come_later(simulator, client, ros, tmp_path):
    car = client.wait_for("car")
    state = ros.listen("/ambf/env/car/State", VehicleState)
    waiting = state.last()
    assert (waiting.wheel_count, len(waiting.wheel_offsets), waiting.mass) == (4, 4, 0.0)
    client.load(str(tmp_path / "parts.yaml"))
    ready = state.next(lambda m: m.mass > 0.0)
    assert ready.mass == MASS
    assert (ready.name.data, ready.identifier.data) == ("car", "/ambf/env/VEHICLE car")
    eventually(lambda: abs(state.last().pose.position.z - 0.209) < 2e-3, what="it stands on its wheels")
    hub = state.last().wheel_offsets[3].position
    assert (hub.x, hub.y) == pytest.approx((-0.3, -0.2), abs=1e-6)
    listed = {each.name: each for each in client.list().objects}
    assert listed["/ambf/env/car"].kind == "vehicle"
    assert listed["/ambf/env/car"].parent == "/ambf/env/chassis"

    assert car.get_wheel_count() == 4
    car.set_steered_wheel_indices([0, 1])
    car.set_powered_wheel_indices([0, 1, 2, 3])
    car.set_vehicle_power(10.0)
    moving = state.next(lambda m: m.pose.position.x > 0.3, what="it drives")
    w0 = ros.listen("/ambf/env/w0/State", RigidBodyState).last()
    assert w0.pose.position.x > 0.3 + moving.pose.position.x - 0.01, "its body is the wheel"
    car.set_vehicle_steering(0.3)
    state.next(lambda m: heading(m.pose) > 0.2, what="it turns left")
    car.set_vehicle_power(0.0)
    car.set_handbrake(True)

    def stands():
        first = state.last().pose.position
        later = state.next(lambda m: m.sim_step > 0).pose.position
        return math.dist((first.x, first.y), (later.x, later.y)) < 1e-6

    eventually(stands, what="it brakes")
    with pytest.raises(TypeError):
        car.set_pos(0.0, 0.0, 0.0)


def test_steps_drive_and_repeat_and_senseless_commands_are_refused(simulator, client, ros, tmp_path):
    simulator.allowed += [r"command to '.*' refused", r"refused: command to 'car'", r"and \d+ more refused"]
    client.load(str(tmp_path / "parts.yaml"))
    step = ros.service("/ambf/env/World/Step", Step)

    def drive(n, **values):
        return step(n=n, vehicle_names=["car"], vehicle_cmds=[VehicleCmd(**values)], wanted_states=["car"])

    nan, infinity = float("nan"), float("inf")
    for values, reason in (
        ({"wheel_power": [nan]}, "wheel_power is not finite"),
        ({"wheel_steering": [0.0, infinity]}, "wheel_steering is not finite"),
        ({"wheel_brake": [1e30]}, "wheel_brake is not finite, beyond 1e9 N"),
        ({"wheel_brake": [0.0] * 1000}, "beyond 127 wheels"),
        ({"chassis_wrench": Wrench(Vector3(nan, 0.0, 0.0), Vector3())}, "chassis_wrench is not finite"),
    ):
        answer = drive(1, **values)
        assert not answer.success and reason in answer.message
    assert drive(500).success
    client.world.snapshot("standing")

    def way():
        begin = step(n=0, wanted_states=["/ambf/env/car"]).vehicles[0].pose.position.x
        for _ in range(10):
            answer = drive(100, wheel_power=[10.0] * 4)
        return answer.vehicles[0].pose.position.x - begin

    first = way()
    assert first == pytest.approx(0.5 * 4 * 10.0 / MASS, rel=0.05), "half of F / m in a second"
    client.world.restore("standing")
    assert way() == first
    assert set(client.remove("/ambf/env/car")) == {"/ambf/env/car", "/ambf/env/wheel3_of_car"}
    eventually(lambda: "/ambf/env/car/State" not in dict(rospy.get_published_topics()))
