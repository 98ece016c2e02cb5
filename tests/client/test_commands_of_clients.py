"""What setters take and when they send: arrays beside lists, joints by dictionary, at once and until cleared."""

import time

import numpy as np
import pytest
import scenes
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
    for wrong in ((1.0, 2.0), ([1.0, 2.0],), ("left",), (float("nan"), 0.0, 0.0), (1e10, 0.0, 0.0)):
        with pytest.raises((TypeError, ValueError)):
            table.set_pos(*wrong)
    with pytest.raises(ValueError):
        table.set_rot([0.0, 0.0, 0.0, 0.0])
    assert table.position.tolist() == [3.0, 4.0, 5.0]


def test_numbers_that_no_message_can_carry_are_refused(bench, client):
    base = client.wait_for("Base")
    for setter in (base.set_joint_pos, base.set_joint_vel, base.set_joint_effort):
        with pytest.raises(ValueError, match="between -1e[+]09 and 1e[+]09, not 1e[+]39"):
            setter("turn", 1e39)
    assert base.get_joint_command("turn") is None


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


def test_a_list_longer_than_there_are_joints_is_refused_whole(bench, client, capsys):
    base = client.wait_for("Base")
    capsys.readouterr()
    for setter in (base.set_joint_pos, base.set_joint_vel, base.set_joint_effort):
        with pytest.raises(ValueError, match="100 values; /ambf/env/Base has 2 joints"):
            setter([0.1] * 100)
    assert capsys.readouterr().err == ""
    assert not base.is_commanded()
    base.set_joint_pos([0.1])  # the first ones, as documented
    assert base.get_joint_command(0) == ("position", 0.1) and base.get_joint_command(1) is None


def test_joints_go_by_their_full_names_too(bench, client, capsys):
    """As lists have them: with prefixes before them, and numbers behind those that were taken."""
    for prefix, x in (("", 5.0), ("/left", 10.0)):
        client.load(text=scenes.BENCH, name_prefix=prefix, pose=[x, 0, 0, 0, 0, 0])
    bases = {name: client.wait_for(name) for name in ("/ambf/env/Base", "/ambf/env/Base1", "/left/ambf/env/Base")}
    parents = {joint.parent: joint for joint in client.list().joints}
    capsys.readouterr()
    value = 0.0
    for name, base in bases.items():
        turn = parents[name]
        value += 0.1
        base.set_joint_pos(turn.name, value)
        assert base.get_joint_command("turn") == base.get_joint_command(turn) == ("position", value)
        eventually(lambda base=base, turn=turn, value=value: abs(base.get_joint_pos(turn.name) - value) < 0.01)
        assert base.get_joint_pos(turn) == pytest.approx(value, abs=0.02)
        assert base.get_joint_idx_from_name(turn.name) == 0
        base.set_joint_pos({turn: 0.0})
        assert base.get_joint_command("turn") == ("position", 0.0)
        base.clear_joint(turn.name)
        assert base.get_joint_command("turn") is None
    assert parents["/ambf/env/Base1"].name == "/ambf/env/turn1"
    assert bases["/ambf/env/Base"].get_joint_pos("env/lift") is not None
    assert capsys.readouterr().err == ""
    # Those of others are not its own, though their last parts are the same.
    assert bases["/ambf/env/Base1"].get_joint_pos("/ambf/env/turn") is None
    assert "no joint '/ambf/env/turn'" in capsys.readouterr().err


def bench_with_joints(turn, lift, passive=""):
    """The bench, its joints called so."""
    text = scenes.BENCH
    for old, new in (("turn", turn), ("lift", lift)):
        text = text.replace(f"JOINT {old}", f"JOINT {new}")
        text = text.replace(f"name: {old}\n", f"name: {new}\n" + ("  passive: true\n" if new == passive else ""))
    return text


@pytest.mark.parametrize("turn, lift, passive", [("j1", "j11", ""), ("j1", "j21", "j21"), ("j1", "j12", "j12")])
def test_numbers_in_names_of_joints_do_not_mix_them_up(bench, client, turn, lift, passive):
    """A second copy has numbers behind its full names; passive joints are in lists, but not in states."""
    for _ in range(2):
        client.load(text=bench_with_joints(turn, lift, passive), name_prefix="/arm")
    by_parent = {joint.parent: joint.name for joint in client.list().joints}
    for number in ("", "1"):
        base = client.wait_for(f"/arm/ambf/env/Base{number}")
        names = base.get_joint_names()
        assert names == [name for name in (turn, lift) if name != passive]
        found = {
            turn: base.get_joint_idx_from_name(by_parent[f"/arm/ambf/env/Base{number}"]),
            lift: base.get_joint_idx_from_name(by_parent[f"/arm/ambf/env/Plate{number}"]),
        }
        assert found == {name: names.index(name) if name in names else None for name in (turn, lift)}, by_parent


def test_a_full_name_of_which_it_is_not_sure_names_no_joint(bench, client):
    client.load(text=bench_with_joints("j", "other"), name_prefix="/arm")
    client.load(text=bench_with_joints("j1", "other"), name_prefix="/arm")
    client.load(text=bench_with_joints("j", "j2", passive="j"), name_prefix="/arm")
    # Its j became j2, which is passive, and its j2 became j21. Which of them may be commanded, no list says.
    joints = {joint.parent: joint.name for joint in client.list().joints}
    base = client.wait_for("/arm/ambf/env/Base2")
    assert base.get_joint_names() == ["j2"]
    assert base.get_joint_idx_from_name(joints["/arm/ambf/env/Base2"]) is None
    assert base.get_joint_idx_from_name("j2") == 0


def test_what_makes_no_sense_is_refused_with_words(bench, client):
    box = client.wait_for("Box")
    for call, wrong in ((box.set_twist, [1, 2, 3]), (box.set_twist, 5), (box.set_wrench, [1.0] * 7)):
        with pytest.raises(ValueError, match=f"{call.__name__} takes 6 numbers"):
            call(wrong)
    assert not box.is_commanded()
    box.set_twist(np.array([[0.1, 0, 0], [0, 0, 0.2]]))
    assert box.get_linear_velocity_command().x == 0.1 and box.get_angular_velocity_command().z == 0.2
    for call in (client.get_obj_handle, client.wait_for):
        with pytest.raises(TypeError, match="named by text.* 5"):
            call(5)
    listed = next(each for each in client.list().objects if each.name == "/ambf/env/Box")
    assert client.get_obj_handle(listed) is client.get_obj_handle(box) is box


@pytest.mark.alone
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
