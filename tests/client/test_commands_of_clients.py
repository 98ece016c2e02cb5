"""What setters take and when they send: arrays beside lists, joints by dictionary, at once and until cleared."""

import time

import numpy as np
import pytest
from ambf_client import Client
from harness import eventually

from ambf_msgs.msg import RigidBodyCmd


def heard(ros, name, kind=RigidBodyCmd):
    """The commands to an object, as everybody can hear them."""
    return ros.listen(f"/ambf/env/{name}/Command", kind)


def test_vectors_are_three_numbers_or_one_sequence_or_array(bench, client):
    table = client.wait_for("Table")
    for given in ((1.0, 2.0, 3.0), ([2.0, 3.0, 4.0],), (np.array([3.0, 4.0, 5.0]),)):
        table.set_pos(*given)
        wanted = list(given) if len(given) == 3 else list(given[0])
        eventually(lambda w=wanted: table.position.tolist() == w)
    for wrong in ((1.0, 2.0), ([1.0, 2.0],), ("left",), (float("nan"), 0.0, 0.0)):
        with pytest.raises((TypeError, ValueError)):
            table.set_pos(*wrong)
    with pytest.raises(ValueError):
        table.set_rot([0.0, 0.0, 0.0, 0.0])
    assert table.position.tolist() == [3.0, 4.0, 5.0]


def test_poses_are_messages_arrays_or_matrices(bench, client):
    table = client.wait_for("Table")
    table.set_pose(np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]))
    eventually(lambda: table.get_pose() == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]))
    matrix = table.matrix
    assert np.allclose(matrix[:3, :3] @ matrix[:3, :3].T, np.identity(3))
    table.set_pose([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    eventually(lambda: np.allclose(table.orientation, [0.0, 0.0, 0.0, 1.0]))
    table.set_pose(matrix)
    eventually(lambda: np.allclose(table.matrix, matrix))
    assert np.allclose(table.rpy, [0.4, 0.5, 0.6])


def test_a_position_alone_keeps_the_orientation(bench, client):
    table = client.wait_for("Table")
    table.set_rpy(0.0, 0.0, 1.0)  # and the position stays
    eventually(lambda: table.get_rpy()[2] == pytest.approx(1.0))
    assert table.position == pytest.approx([0.0, -1.0, 0.0])
    table.clear_cmd()
    table.set_pos(0.5, 0.0, 0.0)
    eventually(lambda: table.position[0] == 0.5)
    assert table.get_rpy()[2] == pytest.approx(1.0)


def test_joints_by_dictionary_and_array(bench, client):
    base = client.wait_for("Base")
    base.set_joint_pos({"turn": 0.3, 1: 0.04})
    eventually(lambda: np.allclose(base.joint_positions, [0.3, 0.04], atol=0.005))
    assert base.get_joint_command("turn") == ("position", pytest.approx(0.3))
    base.set_joint_pos(np.array([-0.2, -0.04]))
    eventually(lambda: np.allclose(base.joint_positions, [-0.2, -0.04], atol=0.005))
    base.set_joint_vel([0.2, 0.0])
    eventually(lambda: base.joint_velocities[0] == pytest.approx(0.2, abs=0.02))
    base.clear_joint("turn")
    assert base.get_joint_command("turn") is None
    assert base.get_joint_command("lift")[0] == "velocity"
    with pytest.raises(ValueError):
        base.set_joint_pos({"turn": float("inf")})
    with pytest.raises(TypeError):
        base.set_joint_pos("turn")


def test_a_setter_sends_at_once_and_the_client_goes_on_sending(bench, ros):
    client = Client()
    client.connect(default_publish_rate=4)
    commands = heard(ros, "Box")
    box = client.wait_for("Box")
    eventually(lambda: box._pub.get_num_connections() == 2)
    time.sleep(0.3)
    # Nothing was commanded: all that is said, once to each listener, is what lists are wanted.
    assert [(c.cartesian_cmd_type, list(c.joint_cmds)) for c in commands.messages] in ([], [(-1, [])])
    commands.messages.clear()
    commands.times.clear()
    sent = time.monotonic()
    box.set_linear_vel(0.1, 0.0, 0.0)
    eventually(lambda: commands.messages)
    assert commands.times[0] - sent < 0.2  # before the next turn at 4 Hz
    eventually(lambda: len(commands.messages) >= 8)
    assert len(commands.messages) / (commands.times[-1] - sent) == pytest.approx(4.0, rel=0.4)
    # Beyond the simulator's watchdog of 0.5 s.
    assert box.linear_velocity[0] == pytest.approx(0.1)
    box.clear_cmd()
    eventually(lambda: commands.messages[-1].cartesian_cmd_type == -1)
    count = len(commands.messages)
    time.sleep(0.8)
    assert len(commands.messages) == count
    client.clean_up()


def test_only_the_wrench_ends_with_the_clients_watchdog(bench, client, ros):
    commands = heard(ros, "Base")
    base = client.wait_for("Base")
    eventually(lambda: base._pub.get_num_connections() == 2)
    base.set_joint_pos("lift", 0.05)
    base.set_force(1.0, 2.0, 3.0)
    eventually(lambda: commands.messages and commands.messages[-1].wrench.force.y == 2.0)
    eventually(lambda: commands.messages[-1].wrench.force.y == 0.0)
    time.sleep(0.7)
    assert list(commands.messages[-1].joint_cmds_types) == [-1, 1]
    assert base.get_joint_pos("lift") == pytest.approx(0.05, abs=0.005)


def test_reading_disturbs_nobody(bench, client, ros):
    """The original commanded a zero force to whatever was read."""
    box = client.wait_for("Box")
    box.set_linear_vel(0.2, 0.0, 0.0)
    eventually(lambda: box.linear_velocity[0] == pytest.approx(0.2))
    base = client.wait_for("Base")
    base.set_joint_vel("turn", 0.2)
    eventually(lambda: base.joint_velocities[0] == pytest.approx(0.2, abs=0.02))
    speeds = []
    reader = Client()
    reader.connect()
    handles = [reader.wait_for("Box"), reader.wait_for("Base")]
    end = time.monotonic() + 1.0
    while time.monotonic() < end:
        handles[0].wait_for_next_state()
        speeds.append((handles[0].linear_velocity[0], handles[1].joint_velocities[0]))
    assert np.allclose([s[0] for s in speeds], 0.2, atol=1e-3)
    assert np.allclose([s[1] for s in speeds], 0.2, atol=0.05)
    reader.clean_up()


def test_joint_names_are_there_with_the_handle(bench, client):
    base = client.get_obj_handle("Base")
    assert base.joint_names == ["turn", "lift"]
    assert base.joint_positions.shape == (2,)
    assert client.get_obj_handle("Box").joint_names == []


def test_commands_of_whole_messages(bench, client):
    table = client.wait_for("Table")
    command = RigidBodyCmd(cartesian_cmd_type=RigidBodyCmd.TYPE_POSITION)
    command.pose.orientation.w = 1.0
    command.pose.position.z = 0.7
    table.set_command(command)
    eventually(lambda: table.position[2] == 0.7)
    table.set_pos(0.0, 0.0, 0.8)
    assert command.pose.position.z == 0.7  # the caller's message is the caller's
    with pytest.raises(TypeError):
        client.wait_for("eye").set_command(command)
