"""Bags as arrays and tables."""

from io import BytesIO

import numpy as np
import pytest
import rosbag
import rospy
from ambf_tools import read_bag
from ambf_tools.recording.bag_writer import BagWriter, Chunk
from ambf_tools.recording.engine import Link, take_messages
from ambf_tools.recording.topic_sources import Source

from ambf_msgs.msg import RigidBodyState, WorldCmd

STATE = "/ambf/env/arm/State"


@pytest.fixture
def path(tmp_path):
    """100 states whose list of joints grows from 1 to 2, and two commands without a header."""
    target = tmp_path / "a.bag"
    with rosbag.Bag(str(target), "w") as bag:
        for n in range(100):
            message = RigidBodyState(sim_step=n * 2 if n < 50 else n * 2 + 3)
            message.name.data = "arm"
            message.sim_time = 5.0 + 0.002 * n
            message.header.seq = n if n < 80 else n + 5
            message.header.stamp = rospy.Time(1000 + n // 10, (n % 10) * 100_000_000)
            message.pose.position.x = 0.1 * n
            message.joint_positions = [float(n)] if n < 10 else [float(n), -float(n)]
            message.joint_names = ["one", "two"]
            bag.write(STATE, message, message.header.stamp)
        for n in range(2):
            bag.write("/ambf/env/World/Command", WorldCmd(True, bool(n), 3), rospy.Time(1020 + n))
    return target


def test_topics_and_times(path):
    with read_bag.open(path) as bag:
        assert {name: topic.messages for name, topic in bag.topics.items()} == {
            STATE: 100,
            "/ambf/env/World/Command": 2,
        }
        assert bag.topics[STATE].type == "ambf_msgs/RigidBodyState"
        assert (bag.start, bag.end) == (1000.0, 1021.0)


def test_columns_have_the_fields_names(path):
    with read_bag.open(path) as bag:
        columns = bag.columns(STATE)
    np.testing.assert_allclose(columns["time"], 5.0 + 0.002 * np.arange(100), atol=1e-6)
    np.testing.assert_allclose(columns["wall"], np.arange(100) * 0.1, atol=1e-9)
    np.testing.assert_allclose(columns["pose.position.x"], 0.1 * np.arange(100))
    np.testing.assert_allclose(columns["header.stamp"], 1000 + 0.1 * np.arange(100))
    assert set(columns["joint_names[1]"]) == {"two"} and set(columns["name"]) == {"arm"}
    assert {len(column) for column in columns.values()} == {100}


def test_commands_have_the_simulation_time_of_the_states_around_them(path):
    with rosbag.Bag(str(path), "a") as bag:
        bag.write("/other", WorldCmd(), rospy.Time(1004, 950_000_000))
    with read_bag.open(path) as bag:
        assert bag.columns("/other")["time"] == pytest.approx([5.0 + 0.002 * 49.5])
        commands = bag.columns("/ambf/env/World/Command")
    assert list(commands["wall"]) == [20.0, 21.0] and commands["time"] == pytest.approx([5.198, 5.198])


def test_without_states_there_is_no_simulation_time(tmp_path):
    with rosbag.Bag(str(tmp_path / "b.bag"), "w") as bag:
        bag.write("/other", WorldCmd(), rospy.Time(1000))
    with read_bag.open(tmp_path / "b.bag") as bag:
        assert np.isnan(bag.columns("/other")["time"]).all()


def test_lists_that_grow_are_filled_up(path):
    with read_bag.open(path) as bag:
        columns = bag.columns(STATE, ["joint_positions"])
    assert set(columns) == {"time", "wall", "joint_positions[0]", "joint_positions[1]"}
    assert np.isnan(columns["joint_positions[1]"][:10]).all()
    np.testing.assert_array_equal(columns["joint_positions[1]"][10:], -np.arange(10.0, 100.0))


def test_only_the_fields_asked_for(path):
    with read_bag.open(path) as bag:
        assert set(bag.columns(STATE, "pose.position.x")) == {"time", "wall", "pose.position.x"}
        matrix = bag.array(STATE, ["pose.position", "sim_step"])
        assert matrix.shape == (100, 4) and matrix[99, 0] == 201 and matrix[99, 1] == pytest.approx(9.9)
        with pytest.raises(KeyError, match="no field twist.lin"):
            bag.columns(STATE, ["pose", "twist.lin"])


def test_tables(path):
    pytest.importorskip("pandas")
    with read_bag.open(path) as bag:
        table = bag.table(STATE, ["pose.position", "joint_positions"])
    assert list(table.columns[:4]) == ["wall", *(f"pose.position.{axis}" for axis in "xyz")]
    assert table.index.name == "time" and table["joint_positions[1]"].count() == 90


def test_gaps_are_found(path):
    with read_bag.open(path) as bag:
        assert bag.continuity() == {STATE: read_bag.Continuity(100, 5, 0, 2, 5, 0, 101)}


def write_states(path, rows, **declared):
    """rows: (sequence number, step) of each state, as one publisher sent them."""
    writer, chunk = BagWriter(path), Chunk()
    header = {"type": RigidBodyState._type, "md5sum": RigidBodyState._md5sum, "callerid": "/simulator", **declared}
    header["message_definition"] = RigidBodyState._full_text
    link = Link(Source(STATE, "http://simulator", header, None), writer.channel(STATE, header))
    for sequence, step in rows:
        message, buffer = RigidBodyState(sim_step=step), BytesIO()
        message.header.seq = sequence
        message.serialize(buffer)
        assert take_messages(link, len(buffer.getvalue()).to_bytes(4, "little") + buffer.getvalue(), chunk, 10**9)
    writer.write(chunk)
    writer.close()


@pytest.mark.parametrize(
    ("every", "rows", "lost", "not_asked_for"),
    [
        ("0", [(1, 10), (2, 20), (5, 50)], 2, 36),  # as published: 2 of 38 steps were sent, and lost
        ("1", [(1, 10), (2, 11), (3, 14), (6, 17), (7, 17)], 4, 0),  # left out by the simulator, or lost on the way
        ("10", [(1, 7), (2, 10), (3, 20), (4, 40)], 1, 29),
        ("1", [(1, 10), (2, 3), (4, 5)], 1, 0),  # a reset
    ],
)
def test_what_was_lost_is_told_from_what_was_not_asked_for(tmp_path, every, rows, lost, not_asked_for):
    write_states(tmp_path / "b.bag", rows, ambf_every=every)
    with read_bag.open(tmp_path / "b.bag") as bag:
        found = bag.continuity()[STATE]
    assert (found.every, found.lost, found.not_asked_for) == (int(every), lost, not_asked_for)


def test_messages_in_order(path):
    with read_bag.open(path) as bag:
        seen = list(bag.messages())
    assert [stamp for _, _, stamp in seen] == sorted(stamp for _, _, stamp in seen) and len(seen) == 102


@pytest.mark.parametrize("content", [b"", b"not a bag", b"#ROSBAG V2.0\n", b"#ROSBAG V2.0\n" + bytes(100)])
def test_what_is_no_bag_is_said_to_be_none(tmp_path, content):
    (tmp_path / "x.bag").write_bytes(content)
    with pytest.raises(read_bag.BagError, match="is no bag|never completed"):
        read_bag.open(tmp_path / "x.bag")


def test_unknown_topics_are_answered_with_those_that_are_there(path):
    with read_bag.open(path) as bag, pytest.raises(KeyError, match="World/Command"):
        bag.columns("/nothing")


def test_an_object_that_was_unloaded_and_is_back_lost_nothing(tmp_path):
    """Its node publishes the same topic anew; others may have listened before the recorder was connected again."""
    writer, chunk = BagWriter(tmp_path / "b.bag"), Chunk()
    said = {"type": RigidBodyState._type, "md5sum": RigidBodyState._md5sum, "callerid": "/simulator"}
    said["message_definition"] = RigidBodyState._full_text
    for numbers in (range(20), [*range(50, 60), *range(63, 70)]):
        link = Link(Source(STATE, "http://simulator", said, None), writer.channel(STATE, said))
        for number in numbers:
            message, buffer = RigidBodyState(sim_step=number), BytesIO()
            message.header.seq = number
            message.serialize(buffer)
            data = len(buffer.getvalue()).to_bytes(4, "little") + buffer.getvalue()
            assert take_messages(link, data, chunk, 10**9)
    writer.write(chunk)
    writer.close()
    with read_bag.open(tmp_path / "b.bag") as bag:
        assert bag.continuity() == {STATE: read_bag.Continuity(37, 3, 1, 1, 4, 0, 0)}
