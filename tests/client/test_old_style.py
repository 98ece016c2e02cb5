"""Scripts of the original's users, unchanged: every documented public method, as they call it, against a simulator.

What the simulator does not simulate yet (sensors, actuators, vehicles, objects of the first generation) answers from a
server in this process, which publishes the same messages.
"""

import functools
import importlib
import inspect
import math
import threading
import time

import ambf_client
import pytest
import rospy
from documented import PUBLIC, methods
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3, Wrench
from harness import eventually
from std_msgs.msg import String

from ambf_msgs import msg

CALLED = set()


def recording(function):
    @functools.wraps(function)
    def call(self, *arguments, **named):
        CALLED.update((each.__name__, function.__name__) for each in type(self).__mro__)
        return function(self, *arguments, **named)

    return call


@pytest.fixture(autouse=True, scope="module")
def record_calls():
    """Notes which documented methods are called, by the class of the object."""
    with pytest.MonkeyPatch.context() as patch:
        for class_name in PUBLIC:
            owner = getattr(ambf_client, class_name)
            for name in methods(PUBLIC[class_name]):
                patch.setattr(owner, name, recording(inspect.getattr_static(owner, name)))
        yield


@pytest.mark.parametrize("class_name", PUBLIC)
def test_names_arguments_and_defaults_are_those_of_the_original(class_name):
    for name, arguments in methods(PUBLIC[class_name]).items():
        function = inspect.getattr_static(getattr(ambf_client, class_name), name)
        own = list(inspect.signature(function).parameters.values())[1:]
        for (argument, default), parameter in zip(arguments, own, strict=False):
            assert argument.lstrip("*") == parameter.name, f"{class_name}.{name}"
            assert argument.startswith("*") == (parameter.kind == parameter.VAR_POSITIONAL)
            if default is not None:
                expected = None if default == "None" else type(parameter.default)(default.strip("'"))
                assert parameter.default == expected, f"{class_name}.{name}({argument})"
        assert len(own) >= len(arguments), f"{class_name}.{name} takes {len(own)} arguments"
        for parameter in own[len(arguments) :]:  # ours beyond are optional
            assert parameter.default is not inspect.Parameter.empty, f"{class_name}.{name}({parameter.name})"


@pytest.mark.parametrize(
    "module, names",
    [
        ("ambf_client", ["Client"]),
        ("ambf_world", ["World"]),
        ("ambf_object", ["Object"]),
        ("ambf_rigid_body", ["RigidBody"]),
        ("ambf_base_object", ["BaseObject"]),
        ("ambf_camera", ["Camera"]),
        ("ambf_light", ["Light"]),
        ("ambf_sensor", ["Sensor"]),
        ("ambf_actuator", ["Actuator"]),
        ("ambf_vehicle", ["Vehicle"]),
        ("ambf_env", ["AmbfEnv", "Observation"]),
        ("watch_dog", ["WatchDog"]),
        ("ambf_comm", [*PUBLIC]),
    ],
)
def test_old_module_names_give_the_classes(module, names):
    for name in names:
        assert getattr(importlib.import_module(module), name) is getattr(ambf_client, name)


def test_client_methods(bench, ros, capsys):
    from ambf_client import Client

    client = Client("old_script")
    client.create_objs_from_rostopics(publish_rate=120)
    client.start()
    client.set_publish_rate(rate=200)
    client.refresh()
    names = client.get_obj_names()
    assert "World" in names
    assert {"/ambf/env/Box", "/ambf/env/cameras/eye", "/ambf/env/lights/sun"} <= set(names)
    assert client.get_common_namespace() == "/ambf/env/"
    assert client.get_world_handle() is client.get_obj_handle("World")
    box = client.get_obj_handle(a_name="Box")
    assert box is client.get_obj_handle("/ambf/env/Box")
    assert box.is_active()
    assert client.get_obj_pose(a_name="Box") == pytest.approx([0.0, 1.0, 0.0, 0.0, 0.0, 0.0], abs=1e-6)
    client.set_obj_cmd("Box", fx=4.0, fy=0.0, fz=0.0, nx=0.0, ny=0.0, nz=0.0)
    eventually(lambda: box.get_linear_vel().x > 0.05, what="the box is pushed")
    capsys.readouterr()
    client.print_active_topics()
    assert "/ambf/env/Box/State" in capsys.readouterr().out
    client.print_summary()
    assert "RigidBody (5)" in capsys.readouterr().out
    client.clean_up()
    assert not box.is_active()


def test_a_name_that_fits_nothing_or_several_gives_none_and_says_why(bench, client, capsys):
    assert client.get_obj_handle("Fox") is None
    assert "no object 'Fox'" in capsys.readouterr().err
    assert client.get_obj_handle("e") is None
    said = capsys.readouterr().err
    assert "fits several" in said
    assert "/ambf/env/Table" in said
    assert client.get_obj_handle("Tab").get_name() == "/ambf/env/Table"  # any unambiguous part will do


def test_base_object_methods_of_a_camera_and_a_light(bench, client):
    camera = client.get_obj_handle("cameras/eye")
    light = client.get_obj_handle("sun")
    for handle, kind in ((camera, ambf_client.Camera), (light, ambf_client.Light)):
        assert type(handle) is kind
        assert isinstance(handle, ambf_client.BaseObject)
        assert kind("name", time_out=0.2).get_name() == "name"
    assert [camera.get_pos().x, camera.get_pos().z] == [3.0, 1.0]
    assert camera.get_children_names() == []
    assert camera.get_num_of_children() == 0
    assert camera.get_parent_name() == ""
    camera.set_pos(px=1.0, py=2.0, pz=3.0)
    eventually(lambda: camera.get_pos() == Point(1.0, 2.0, 3.0))
    camera.set_rpy(roll=0.1, pitch=0.2, yaw=0.3)
    eventually(lambda: camera.get_rpy() == pytest.approx((0.1, 0.2, 0.3)))
    camera.set_rot(quat=[0.0, 0.0, 1.0, 0.0])
    eventually(lambda: camera.get_rot() == Quaternion(0.0, 0.0, 1.0, 0.0))
    assert camera.get_rot_command() == Quaternion(0.0, 0.0, 1.0, 0.0)
    assert camera.get_pos_command() == Point(1.0, 2.0, 3.0)
    light.set_pose(pose=Pose(Point(0.0, 1.0, 2.0), Quaternion(0.0, 1.0, 0.0, 0.0)))
    eventually(lambda: light.get_pose()[:3] == pytest.approx([0.0, 1.0, 2.0]))


def test_base_object_methods_of_a_body(bench, client):
    body = client.get_obj_handle("Base")
    assert body.is_active()
    body.set_active()
    eventually(lambda: body.get_num_of_children() == 2)
    assert sorted(name.rpartition("/")[2] for name in body.get_children_names()) == ["Plate", "Slide"]
    step = body.get_sim_step()
    eventually(lambda: body.get_sim_step() > step + 20)
    assert body.get_identifier() == "Base" or body.get_identifier().endswith("Base")
    assert body.get_parent_name() == ""
    assert body.get_msg_header() is not None
    assert abs(body.get_msg_time_stamp().to_sec() - time.time()) < 5.0
    number = body.get_msg_seq_num()
    eventually(lambda: body.get_msg_seq_num() > number)
    assert body.get_msg_frame_id() == ""
    body.set_name(name="mine")
    assert body.get_name() == "mine"
    state = msg.RigidBodyState()
    state.sim_step = 77
    body.set_inactive()
    body.ros_cb(data=state)
    assert body.get_sim_step() == 77
    body.run_publisher()
    base = ambf_client.BaseObject("nothing", time_out=0.3)
    assert not base.is_active()


def test_watch_dog_methods(capsys):
    dog = ambf_client.WatchDog(time_out=0.05)
    assert not dog.is_wd_expired()
    dog.acknowledge_wd()
    assert not dog.is_wd_expired()
    time.sleep(0.08)
    assert dog.is_wd_expired()
    dog.console_print(class_name="Thing")
    dog.console_print(class_name="Thing")
    assert capsys.readouterr().err.count("Thing") == 1
    dog.set_timeout(time_out=10.0)
    dog.acknowledge_wd()
    assert not dog.is_wd_expired()


def test_rigid_body_motion(bench, client):
    box = client.get_obj_handle("Box")
    table = client.get_obj_handle("Table")
    assert isinstance(box, ambf_client.RigidBody)
    assert box.get_inertia().x == pytest.approx(2.0 * 0.01 / 6.0)
    table.set_pos(px=1.0, py=2.0, pz=0.5)
    eventually(lambda: table.get_pos() == Point(1.0, 2.0, 0.5))
    assert table.get_pos_command() == Point(1.0, 2.0, 0.5)
    table.set_rpy(roll=0.3, pitch=-0.2, yaw=1.0)
    eventually(lambda: table.get_rpy() == pytest.approx((0.3, -0.2, 1.0)))
    table.set_rot(quat=[0.0, 0.0, 0.0, 1.0])
    eventually(lambda: table.get_rpy() == pytest.approx((0.0, 0.0, 0.0)))
    assert table.get_rot_command() == Quaternion(0.0, 0.0, 0.0, 1.0)
    table.set_pose(pose=Pose(Point(0.0, -1.0, 0.0), Quaternion(1.0, 0.0, 0.0, 0.0)))
    eventually(lambda: table.get_pose() == pytest.approx([0.0, -1.0, 0.0, math.pi, 0.0, 0.0], abs=1e-6))
    # The original's pose_command takes its angles about z, y and x.
    table.pose_command(px=0.0, py=-2.0, pz=0.0, roll=0.3, pitch=0.0, yaw=0.0)
    eventually(lambda: table.get_pose() == pytest.approx([0.0, -2.0, 0.0, 0.0, 0.0, 0.3], abs=1e-6))
    table.set_pose(Pose(Point(0.0, -2.0, 5.0), Quaternion(0.0, 0.0, 0.0, 1.0)))
    eventually(lambda: table.get_pos().z == 5.0)

    box.set_linear_vel(vx=0.5, vy=0.0, vz=0.0)
    eventually(lambda: box.get_linear_vel().x == pytest.approx(0.5))
    box.set_angular_vel(ax=0.0, ay=0.0, az=0.4)
    eventually(lambda: box.get_angular_vel().z == pytest.approx(0.4))
    assert box.get_linear_velocity_command() == Vector3(0.5, 0.0, 0.0)
    assert box.get_angular_velocity_command() == Vector3(0.0, 0.0, 0.4)
    box.set_twist(twist=Twist(Vector3(0.0, 0.1, 0.0), Vector3()))
    eventually(lambda: box.get_linear_vel().y == pytest.approx(0.1))
    box.velocity_command(vx=0.0, vy=0.0, vz=0.2, ax=0.0, ay=0.0, az=0.0)
    eventually(lambda: box.get_linear_vel().z == pytest.approx(0.2))
    box.velocity_command(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    eventually(lambda: box.get_linear_vel() == Vector3(0.0, 0.0, 0.0))


def test_rigid_body_forces(bench, client):
    box = client.get_obj_handle("Box")
    lateral = Wrench(Vector3(0.0, 4.0, 0.0), Vector3())
    force, torque = box.get_force_command, box.get_torque_command
    pushes = [
        (lambda: box.set_force(fx=4.0, fy=0.0, fz=0.0), lambda: box.get_linear_vel().x, force, "x"),
        (lambda: box.set_torque(nx=0.0, ny=0.01, nz=0.0), lambda: box.get_angular_vel().y, torque, "y"),
        (lambda: box.set_wrench(wrench=lateral), lambda: box.get_linear_vel().y, force, "y"),
        (lambda: box.wrench_command(fx=0.0, fy=0.0, fz=4.0, nx=0.0, ny=0.0, nz=0.0),
         lambda: box.get_linear_vel().z, force, "z"),
    ]  # fmt: skip
    for push, speed, command, axis in pushes:
        before = speed()
        push()
        assert getattr(command(), axis) > 0.0
        eventually(lambda b=before, s=speed: s() > b + 0.02)
    # The client's watchdog takes back the wrench, and only that, after 0.1 s.
    eventually(lambda: box.get_force_command() == Vector3(0.0, 0.0, 0.0), 2.0)
    assert box.get_torque_command() == Vector3(0.0, 0.0, 0.0)


def test_rigid_body_joints(bench, client, capsys):
    base = client.get_obj_handle("Base")
    assert base.get_publish_children_name_flag()
    assert base.get_publish_joint_names_flag()
    assert base.get_publish_joint_positions_flag()
    for setter in (
        base.set_publish_children_names_flag,
        base.set_publish_joint_names_flag,
        base.set_publish_joint_positions_flag,
    ):
        setter(state=True)
    assert base.get_num_joints() == 2
    assert base.get_joint_names() == ["turn", "lift"]
    assert base.is_joint_idx_valid(joint_idx=1)
    assert not base.is_joint_idx_valid(joint_idx=2)
    assert base.get_joint_idx_from_name(joint_name="lift") == 1
    assert base.get_joint_name_from_idx(joint_idx=0) == "turn"
    base.set_joint_pos(joint_name_or_idx="turn", p=0.4)
    eventually(lambda: base.get_joint_pos(joint_name_or_idx=0) == pytest.approx(0.4, abs=0.01))
    base.set_joint_pos(1, 0.05)
    eventually(lambda: base.get_all_joint_pos() == pytest.approx([0.4, 0.05], abs=0.01))
    base.set_multiple_joint_pos(p_list=[0.1, -0.05], index_list=[0, 1])
    eventually(lambda: base.get_all_joint_pos() == pytest.approx([0.1, -0.05], abs=0.01))
    # Values are looked up by the index of the joint.
    base.set_multiple_joint_pos([99.0, 0.02], [1])
    eventually(lambda: base.get_all_joint_pos() == pytest.approx([0.1, 0.02], abs=0.01))
    base.set_joint_vel(joint_name_or_idx=0, v=0.5)
    eventually(lambda: base.get_joint_vel(joint_name_or_idx="turn") == pytest.approx(0.5, abs=0.02))
    base.set_multiple_joint_vel(v_list=[-0.5, 0.0], index_list=[0, 1])
    eventually(lambda: base.get_all_joint_vel()[0] == pytest.approx(-0.5, abs=0.02))
    base.set_joint_vel("turn", 0.0)
    eventually(lambda: base.get_joint_vel("turn") == pytest.approx(0.0, abs=0.02))
    base.set_joint_effort(joint_name_or_idx="turn", f=0.05)
    eventually(lambda: base.get_joint_vel("turn") > 0.2)
    base.set_multiple_joint_effort(f_list=[-0.1], index_list=[0])
    eventually(lambda: base.get_joint_vel("turn") < 0.0)
    assert isinstance(base.get_joint_effort(joint_name_or_idx="turn"), float)
    assert len(base.get_all_joint_effort()) == 2
    base.resize_joint_cmd_array(req_len=2)
    capsys.readouterr()
    assert base.get_joint_pos("elbow") is None
    assert "elbow" in capsys.readouterr().err
    base.set_joint_pos(7, 0.0)
    assert "no joint 7" in capsys.readouterr().err


def test_a_joint_never_commanded_is_left_alone(bench, client):
    base = client.get_obj_handle("Base")
    base.set_joint_vel("turn", 0.3)
    eventually(lambda: base.get_joint_vel("turn") == pytest.approx(0.3, abs=0.02))
    base.clear_cmd()
    other = ambf_client.Client()
    other.connect()
    # Joint 1 alone: the original sent an effort of zero to joint 0 with it, which frees it.
    handle = other.get_obj_handle("Base")
    handle.set_joint_pos(1, 0.03)
    assert list(handle._cmd.joint_cmds_types) == [-1, 1]
    eventually(lambda: handle.get_joint_pos(1) == pytest.approx(0.03, abs=0.005))
    other.clean_up()


def test_world_methods_and_the_old_step_clock(bench, client):
    world = client.get_world_handle()
    assert isinstance(world, ambf_client.World)
    world.set_active()
    assert world.is_active()
    with pytest.raises(ValueError):
        world.set_num_step_skips(0)
    with pytest.raises(ValueError):
        world.set_num_step_skips(101)
    box = client.get_obj_handle("Box")
    world.enable_throttling(data=True)
    world.set_num_step_skips(n=5)
    world.update()
    eventually(lambda: world.wait_for_next_state(0.5) and _waits(world))
    step = world.get_sim_step()
    for _ in range(20):
        world.update()
        step += 5
        assert world.wait_for_sim_step(step, 5.0)
        assert world.get_sim_step() == step
    assert box.wait_for_sim_step(step)
    assert box.get_sim_step() == step
    world.run_publisher()  # no toggle
    time.sleep(0.1)
    assert world.get_sim_step() == step
    world.clear_cmd()
    world.update()
    assert world.wait_for_sim_step(step + 100, 5.0)

    box.set_linear_vel(1.0, 0.0, 0.0)
    eventually(lambda: box.get_pos().x > 0.1)
    box.clear_cmd()
    world.reset_bodies()
    eventually(lambda: abs(box.get_pos().x) < 1e-6)
    before = world.get_sim_step()
    world.reset()
    eventually(lambda: world.get_sim_step() < before)
    name = world.get_name()
    assert name == "/ambf/env/World"
    world.set_name(name="mine")
    assert world.get_name() == "mine"
    state = msg.WorldState()
    state.sim_step = 5
    other = ambf_client.World(a_name="/nowhere/World")
    other.ros_cb(data=state)
    assert other.get_sim_step() == 5


def _waits(world):
    at = world.get_sim_step()
    return world.wait_for_next_state() and world.get_sim_step() == at


class Server:
    """Publishes a state 100 times a second and keeps the commands."""

    def __init__(self, name, state, command):
        self.state, self.commands = state, []
        self.publisher = rospy.Publisher(f"{name}/State", type(state), queue_size=1)
        self.subscriber = rospy.Subscriber(f"{name}/Command", command, self.commands.append)
        self.ending = threading.Event()
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _run(self):
        while not self.ending.wait(0.01):
            self.state.sim_step += 1
            self.publisher.publish(self.state)

    def last(self, condition=lambda command: True):
        eventually(lambda: self.commands and condition(self.commands[-1]), what=f"a command, not {self.commands[-1:]}")
        return self.commands[-1]

    def close(self):
        self.ending.set()
        self.thread.join()
        self.publisher.unregister()
        self.subscriber.unregister()


@pytest.fixture
def serve(ros):
    servers = []

    def make(*arguments):
        servers.append(Server(*arguments))
        return servers[-1]

    yield make
    for server in servers:
        server.close()


def test_object_methods(serve, client):
    state = msg.ObjectState(children_names=["a"], joint_names=["one", "two"], joint_positions=[0.5, 0.25])
    state.pInertia.z = 3.0
    state.pose.orientation.w = 1.0
    server = serve("/ambf/env/old", state, msg.ObjectCmd)
    thing = client.wait_for("old")
    assert type(thing) is ambf_client.Object
    assert ambf_client.Object("name", time_out=0.1).get_name() == "name"
    assert thing.is_joint_idx_valid(joint_idx=1)
    assert thing.get_joint_idx_from_name(joint_name="two") == 1
    assert thing.get_joint_name_from_idx(joint_idx=0) == "one"
    assert thing.get_joint_pos(joint_name_or_idx="two") == 0.25
    assert thing.get_all_joint_pos() == [0.5, 0.25]
    assert thing.get_num_joints() == 2
    assert thing.get_joint_names() == ["one", "two"]
    assert thing.get_inertia().z == 3.0
    assert thing.get_publish_children_name_flag()
    assert thing.get_publish_joint_names_flag()
    assert thing.get_publish_joint_positions_flag()
    thing.set_active()
    thing.set_publish_children_names_flag(state=False)
    thing.set_publish_joint_names_flag(state=True)
    thing.set_publish_joint_positions_flag(state=True)
    thing.set_joint_pos(joint_name_or_idx="two", q=0.7)
    sent = server.last(lambda c: len(c.joint_cmds) == 2)
    assert sent.joint_cmds[1] == pytest.approx(0.7)
    assert list(sent.position_controller_mask) == [False, True]
    assert (sent.publish_children_names, sent.publish_joint_names) == (False, True)
    thing.set_joint_effort(joint=0, effort=1.5)
    assert server.last(lambda c: c.joint_cmds[0] == 1.5).position_controller_mask[0] is False
    thing.set_force(fx=1.0, fy=2.0, fz=3.0)
    assert server.last(lambda c: c.wrench.force.y == 2.0).enable_position_controller is False
    assert thing.get_force_command() == Vector3(1.0, 2.0, 3.0)
    thing.set_torque(nx=1.0, ny=0.0, nz=0.5)
    assert thing.get_torque_command() == Vector3(1.0, 0.0, 0.5)
    server.last(lambda c: c.wrench.torque.z == 0.5)
    server.last(lambda c: c.wrench.force.y == 0.0)  # the watchdog
    thing.set_wrench(wrench=Wrench(Vector3(0.0, 0.0, 9.0), Vector3()))
    server.last(lambda c: c.wrench.force.z == 9.0)
    thing.wrench_command(fx=8.0, fy=0.0, fz=0.0, nx=0.0, ny=0.0, nz=0.0)
    server.last(lambda c: c.wrench.force.x == 8.0)
    thing.pose_command(0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 0.11, 0.22)
    sent = server.last(lambda c: c.enable_position_controller)
    assert sent.pose.position == Point(0.1, 0.2, 0.3)
    assert sent.joint_cmds == pytest.approx([0.11, 0.22])


def test_sensor_methods(serve, client):
    state = msg.SensorState(count=2, triggered=[True, False], range=[0.5], measurement=[0.25, 0.0])
    state.sensed_objects = [String("Box"), String("")]
    state.parent_name.data = "Base"
    state.pose.position.x = 0.1
    serve("/ambf/env/sensors/eyes", state, msg.SensorCmd)
    sensor = client.wait_for("eyes")
    assert type(sensor) is ambf_client.Sensor
    assert ambf_client.Sensor("name", time_out=0.1).get_count() == 0
    assert sensor.get_count() == 2
    assert sensor.is_triggered(idx=0) is True
    assert sensor.is_triggered(idx=1) is False
    assert [sensor.get_range(idx=0), sensor.get_range(idx=1)] == [0.5, 0.5]
    assert sensor.get_measurement(idx=0) == 0.25
    assert sensor.get_all_measurements() == [0.25, 0.0]
    assert sensor.get_sensed_object(idx=0) == "Box"
    assert sensor.get_parent() == "Base"
    assert sensor.get_pose().position.x == 0.1
    assert sensor.is_triggered(5) is None


def test_actuator_methods(serve, client):
    server = serve("/ambf/env/actuators/grip", msg.ActuatorState(), msg.ActuatorCmd)
    grip = client.wait_for("grip")
    assert type(grip) is ambf_client.Actuator
    assert ambf_client.Actuator("name", time_out=0.1).get_name() == "name"
    grip.actuate(obj_name="Box")
    sent = server.last(lambda c: c.actuate)
    assert (sent.body_name.data, sent.use_offset, sent.use_sensor_data) == ("Box", False, False)
    grip.actuate("Box", pose=Pose(Point(0.1, 0.0, 0.0), Quaternion(0.0, 0.0, 0.0, 1.0)))
    assert server.last(lambda c: c.use_offset).body_offset.position.x == 0.1
    grip.actuate_from_sensor_data(sensor_identifer="eyes")
    assert server.last(lambda c: c.use_sensor_data).sensor_identifier.data == "eyes"
    grip.deactuate()
    server.last(lambda c: not c.actuate)


def test_vehicle_methods(serve, client):
    server = serve("/ambf/env/rover", msg.VehicleState(wheel_count=4), msg.VehicleCmd)
    rover = client.wait_for("rover")
    assert type(rover) is ambf_client.Vehicle
    assert ambf_client.Vehicle("name", time_out=0.1).get_wheel_count() == 0
    assert rover.get_wheel_count() == 4
    assert rover.check_wheel_count(idx=3)
    assert not rover.check_wheel_count(idx=4)
    rover.initialize_wheel_cmds()
    rover.set_steered_wheel_indices(indices=[0, 1])
    rover.set_powered_wheel_indices(indices=[2, 3])
    rover.set_vehicle_steering(val=0.3)
    assert server.last(lambda c: any(c.wheel_steering)).wheel_steering == pytest.approx([0.3, 0.3, 0.0, 0.0])
    rover.set_vehicle_steering_ackerman(val=0.2)
    server.last(lambda c: c.wheel_steering[0] == pytest.approx(0.2))
    rover.set_vehicle_power(val=10.0)
    assert list(server.last(lambda c: any(c.wheel_power)).wheel_power) == [0.0, 0.0, 10.0, 10.0]
    rover.set_vehicle_brake(val=2.0)
    assert list(server.last(lambda c: any(c.wheel_brake)).wheel_brake) == [2.0] * 4
    rover.set_wheel_steering(idx=3, val=0.5)
    rover.set_wheel_power(idx=0, val=1.0)
    rover.set_wheel_brake(idx=1, val=0.0)
    sent = server.last(lambda c: c.wheel_brake[1] == 0.0)
    assert (sent.wheel_steering[3], sent.wheel_power[0]) == (0.5, 1.0)


def test_every_documented_method_was_called():
    """The last of this file. AmbfEnv has a file of its own."""
    documented = {(c, m) for c in PUBLIC for m in methods(PUBLIC[c]) if c not in ("AmbfEnv", "Observation")}
    assert documented - CALLED == set()
