"""Bags that we write, read by rosbag."""

import io
import time

import pytest
import rosbag
from ambf_tools.recording.bag_writer import BagWriter, Chunk
from ambf_tools.recording.engine import Link, take_messages
from ambf_tools.recording.topic_sources import Source, matches

from ambf_msgs.msg import RigidBodyState, WorldCmd


def tcpros(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    data = buffer.getvalue()
    return len(data).to_bytes(4, "little") + data


def header_of(kind):
    return {
        "type": kind._type,
        "md5sum": kind._md5sum,
        "message_definition": kind._full_text,
        "callerid": "/someone",
    }


def link_for(writer, topic, kind):
    header = header_of(kind)
    return Link(Source(topic, "http://somewhere", header, None), writer.channel(topic, header))


def state(sequence, stamp_ns):
    message = RigidBodyState(sim_step=sequence)
    message.header.seq = sequence
    message.header.stamp.secs, message.header.stamp.nsecs = divmod(stamp_ns, 1_000_000_000)
    return message


def write_bag(path, chunks=3, messages=50):
    """A bag with that many states; returns the time of the first."""
    now = time.time_ns()
    writer = BagWriter(path)
    link = link_for(writer, "/a/State", RigidBodyState)
    for c in range(chunks):
        chunk = Chunk()
        numbers = range(c * messages, (c + 1) * messages)
        data = b"".join(tcpros(state(n, now + n * 1_000_000)) for n in numbers)
        assert take_messages(link, data, chunk, now)
        writer.write(chunk)
    return writer, now


def test_rosbag_reads_what_was_written(tmp_path):
    writer, now = write_bag(tmp_path / "a.bag")
    assert writer.close() == 0
    with rosbag.Bag(str(tmp_path / "a.bag")) as bag:
        assert bag.get_message_count() == 150
        read = list(bag.read_messages("/a/State"))
    assert [message.sim_step for _, message, _ in read] == list(range(150))
    assert [stamp.to_nsec() for _, _, stamp in read] == [now + n * 1_000_000 for n in range(150)]  # of the headers


def test_messages_that_arrive_in_pieces_are_put_together(tmp_path):
    writer = BagWriter(tmp_path / "a.bag")
    link = link_for(writer, "/a/State", RigidBodyState)
    now = time.time_ns()
    data = b"".join(tcpros(state(n, now)) for n in range(40))
    chunk = Chunk()
    for at in range(0, len(data), 7):
        assert take_messages(link, data[at : at + 7], chunk, now)
    writer.write(chunk)
    writer.close()
    assert link.messages == 40 and link.lost == 0 and link.rest == b""
    with rosbag.Bag(str(tmp_path / "a.bag")) as bag:
        assert [message.header.seq for _, message, _ in bag.read_messages()] == list(range(40))


def test_missing_numbers_are_counted_as_lost_and_a_restart_is_not(tmp_path):
    writer = BagWriter(tmp_path / "a.bag")
    link = link_for(writer, "/a/State", RigidBodyState)
    now, chunk = time.time_ns(), Chunk()
    for n in (5, 6, 9, 10, 0, 1, 2):
        take_messages(link, tcpros(state(n, now)), chunk, now)
    assert (link.messages, link.lost) == (7, 2)


@pytest.mark.parametrize("stamp", [0, 10**18])
def test_absurd_stamps_give_way_to_the_time_of_receipt(tmp_path, stamp):
    writer = BagWriter(tmp_path / "a.bag")
    link = link_for(writer, "/a/State", RigidBodyState)
    now, chunk = time.time_ns(), Chunk()
    take_messages(link, tcpros(state(0, stamp)), chunk, now)
    writer.write(chunk)
    writer.close()
    with rosbag.Bag(str(tmp_path / "a.bag")) as bag:
        assert [stamp.to_nsec() for _, _, stamp in bag.read_messages()] == [now]


def test_messages_without_a_header_have_the_time_of_receipt(tmp_path):
    writer = BagWriter(tmp_path / "a.bag")
    link = link_for(writer, "/w/Command", WorldCmd)
    now, chunk = time.time_ns(), Chunk()
    take_messages(link, tcpros(WorldCmd(True, False, 3)) + tcpros(WorldCmd(True, True, 4)), chunk, now)
    writer.write(chunk)
    writer.close()
    with rosbag.Bag(str(tmp_path / "a.bag")) as bag:
        read = list(bag.read_messages())
    assert [message.n_skip_steps for _, message, _ in read] == [3, 4]
    assert {stamp.to_nsec() for _, _, stamp in read} == {now}
    assert link.lost == 0


def test_whatever_a_crash_cuts_off_the_rest_is_readable_after_repair(tmp_path):
    from ambf_tools.record import repair

    writer, _ = write_bag(tmp_path / "whole.bag")
    whole = writer.active_path.read_bytes()  # as it lies on disk before it is closed
    third = len(whole) // 3
    for number, (size, kept) in enumerate([(len(whole), 150), (len(whole) - 100, 100), (2 * third, 50)]):
        cut = tmp_path / f"cut{number}.bag.active"
        cut.write_bytes(whole[:size])
        done = repair(cut)
        assert done == tmp_path / f"cut{number}.bag" and not cut.exists()
        with rosbag.Bag(str(done)) as bag:
            steps = [message.sim_step for _, message, _ in bag.read_messages()]
        # The messages of the chunk that was cut are gone, no other.
        assert len(steps) >= kept and steps == list(range(len(steps)))


@pytest.mark.parametrize(
    ("topic", "fits"),
    [
        ("/a/State", True),
        ("/b/one/State", True),
        ("/b/one/Command", False),
        ("/c/x9/State", True),
        ("/c/x/State", False),
    ],
)
def test_topics_are_chosen_by_name_shell_pattern_and_regular_expression(topic, fits):
    assert matches(topic, ["/a/State"], ["/b/*/State", r"re:/c/x\d/State"]) == fits
