"""Scripts of the original's users, unchanged: the handles of what no simulator of ours simulates, method by method.

Sensors, actuators, vehicles and objects of the first generation answer from a server in this process, which publishes
the same messages.
"""

import threading

import ambf_client
import pytest
import rospy
from documented import documented
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3, Wrench
from harness import eventually
from std_msgs.msg import String

from ambf_msgs import msg

pytestmark = pytest.mark.usefixtures("called")


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


def test_every_documented_method_was_called(called):
    """The last of this file."""
    assert documented(__name__) - called == set()
