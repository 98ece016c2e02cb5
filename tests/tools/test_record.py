"""The recorder against live simulators: nothing lost, and a bag whatever happens."""

import datetime
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import rosbag
from ambf_tools import read_bag, record
from ambf_tools.record import Recorder, RecordingError, bag_name, repair
from harness import ROOT, eventually

STATES = "/ambf/env/Cube*/State"


@pytest.fixture(autouse=True)
def environment(master, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    monkeypatch.setenv("ROS_IP", "127.0.0.1")


def recorder(tmp_path, *topics, **more):
    return Recorder(tmp_path / "bags/trial.bag", topics, **{"min_free_bytes": 0, **more})


def test_every_message_at_a_thousand_hertz_is_in_the_bag(tmp_path, cubes):
    simulator = cubes(20)
    recording = recorder(tmp_path, patterns=[STATES]).start()
    assert recording.ready(20)
    time.sleep(3.0)
    status = recording.stop()
    assert status.complete and status.lost == 0 and simulator.running()
    with read_bag.open(recording.path) as bag:
        topics = bag.continuity()
        messages = sum(topic.messages for topic in topics.values())
        assert len(topics) == 20 and messages == status.messages
        assert all(topic.lost == 0 and topic.restarts == 0 and topic.typical_stride == 1 for topic in topics.values())
        # All topics show the same steps: what is missing in one was not simulated at that rate by the simulator either.
        # From the moment on in which the last of them was found: on a busy machine that takes a second.
        steps = [bag.array(name, ["sim_step"])[:, 0] for name in topics]
        first, last = max(each[0] for each in steps), min(each[-1] for each in steps)
        lengths = [((first <= each) & (each <= last)).sum() for each in steps]
        assert min(lengths) > 0.8 * max(lengths)


def test_three_hundred_topics_at_their_usual_rate(tmp_path, cubes):
    cubes(300, 50)
    recording = recorder(tmp_path, patterns=[STATES]).start()
    assert recording.ready(300, 30)
    time.sleep(2.0)
    status = recording.stop()
    assert status.lost == 0 and len([t for t, (n, _) in status.topics.items() if n > 10]) == 300


def test_a_recorder_that_is_held_up_loses_nothing(tmp_path, cubes):
    cubes(5)
    recording = recorder(tmp_path, patterns=[STATES]).start()
    assert recording.ready(5)
    time.sleep(0.5)
    os.kill(recording.pid, signal.SIGSTOP)
    time.sleep(1.0)  # a subscriber's usual queue would have dropped nine tenths of that
    os.kill(recording.pid, signal.SIGCONT)
    time.sleep(0.5)
    status = recording.stop()
    assert status.lost == 0
    with read_bag.open(recording.path) as bag:
        assert all(topic.lost == 0 for topic in bag.continuity().values())


def test_the_bag_of_a_killed_recorder_is_repaired(tmp_path, cubes):
    cubes(3)
    ends = []
    recording = recorder(tmp_path, patterns=[STATES], on_end=ends.append).start()
    assert recording.ready(3)
    time.sleep(2.0)
    before = recording.status.messages
    os.kill(recording.pid, signal.SIGKILL)
    assert recording.wait(10)
    assert "signal 9" in recording.status.reason and not recording.status.complete and len(ends) == 1
    with pytest.raises(read_bag.BagError, match="there is no"):
        read_bag.open(recording.path)
    with pytest.raises(read_bag.BagError, match="repair"):
        read_bag.open(str(recording.path) + ".active")
    progress = []
    assert repair(recording.path, lambda done, size: progress.append((done, size))) == recording.path
    assert progress
    with read_bag.open(recording.path) as bag:
        topics = bag.continuity()
        kept = sum(topic.messages for topic in topics.values())
        assert all(topic.lost == 0 for topic in topics.values())
    assert kept > 0.3 * before  # all but the last second


def test_a_recorder_whose_program_dies_completes_its_bag(tmp_path, cubes):
    cubes(2)
    script = f"""
import os, sys, time
sys.path.insert(0, {str(ROOT / "ambf_client_py")!r})
from ambf_tools.record import Recorder
r = Recorder({str(tmp_path / "orphan.bag")!r}, patterns=["{STATES}"], min_free_bytes=0).start()
r.ready(2); time.sleep(0.5); print(r.pid, flush=True); time.sleep(60)
"""
    program = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert int(program.stdout.readline()) > 0
    program.kill()
    program.wait()
    eventually((tmp_path / "orphan.bag").exists, 10, "the bag is completed")
    with read_bag.open(tmp_path / "orphan.bag") as bag:
        assert len(bag.topics) == 2


def test_killed_simulator_ends_nothing_and_the_next_one_is_recorded_too(tmp_path, cubes, master):
    first = cubes(2)
    recording = recorder(tmp_path, patterns=[STATES]).start()
    assert recording.ready(2)
    time.sleep(0.5)
    first.stop(signal.SIGKILL)
    eventually(lambda: recording.status.connections == 0, 10, "the recorder notices")
    first.allowed.append(".*")
    at_death = recording.status.messages
    cubes(2)
    eventually(lambda: recording.status.messages > at_death + 200, 20, "the next simulator is recorded")
    status = recording.stop()
    assert status.complete and status.lost == 0
    with read_bag.open(recording.path) as bag:
        assert sum(topic.messages for topic in bag.topics.values()) == status.messages


def test_rosbag_reindex_repairs_it_too(tmp_path, cubes):
    cubes(2)
    recording = recorder(tmp_path, patterns=[STATES]).start()
    assert recording.ready(2)
    eventually(lambda: recording.status.messages > 1000, 30, "much is recorded")
    os.kill(recording.pid, signal.SIGKILL)
    assert recording.wait(10)
    (tmp_path / "bags/trial.bag.active").rename(tmp_path / "killed.bag")
    subprocess.run(["rosbag", "reindex", "-q", tmp_path / "killed.bag"], check=True)
    with read_bag.open(tmp_path / "killed.bag") as bag:
        assert all(topic.lost == 0 and topic.messages > 100 for topic in bag.continuity().values())


def test_topics_that_come_later_join_in(tmp_path, bench, ros):
    from ambf_msgs.srv import Load

    recording = recorder(tmp_path, patterns=["/late/*/State"]).start()
    time.sleep(0.7)
    assert recording.status.connections == 0
    load = ros.service("/ambf/env/World/Load", Load)
    assert load(path=str(tmp_path / "model.yaml"), name_prefix="late").success
    assert recording.ready(5)
    time.sleep(0.5)
    status = recording.stop()
    assert status.messages > 5 and all(topic.startswith("/late/") for topic in status.topics)


def test_it_ends_by_itself_after_its_duration(tmp_path, bench):
    recording = recorder(tmp_path, "/ambf/env/World/State", duration=0.5).start()
    assert recording.wait(10)
    assert recording.status.complete and "time" in recording.status.reason
    assert recording.stop().complete


def test_it_does_not_start_without_space(tmp_path):
    with pytest.raises(RecordingError, match="free, less than"):
        recorder(tmp_path, "/a", min_free_bytes=1 << 60).start()
    assert not list((tmp_path / "bags").glob("*"))


def test_running_out_of_space_ends_it_with_a_complete_bag(tmp_path, cubes, monkeypatch):
    """A disk that refuses, imitated by a limit on the size of files."""
    cubes(20)
    limit = 3 << 20
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    recording = recorder(tmp_path, patterns=[STATES])
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, hard))
    try:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        recording.start()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert recording.wait(30), "it ends by itself"
    assert "the disk refused" in recording.status.reason and recording.status.complete
    assert recording.path.stat().st_size <= limit
    with read_bag.open(recording.path) as bag:
        topics = bag.continuity()
    assert sum(topic.messages for topic in topics.values()) > 1000
    assert all(topic.lost == 0 for topic in topics.values())


@pytest.mark.skipif(os.geteuid() != 0, reason="mounting a small disk needs root")
def test_full_disk(tmp_path, cubes):
    small = tmp_path / "small"
    small.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", small], capture_output=True).returncode:
        pytest.skip("this system lets nobody mount")
    try:
        cubes(20)
        recording = Recorder(small / "a.bag", patterns=[STATES], min_free_bytes=0).start()
        assert recording.wait(30)
        assert "No space left" in recording.status.reason and recording.status.complete
        with read_bag.open(recording.path) as bag:
            assert all(topic.lost == 0 for topic in bag.continuity().values())
    finally:
        subprocess.run(["umount", small], check=True)


def test_too_little_space_ends_it_in_time(tmp_path, bench, monkeypatch):
    free = record.free_bytes(tmp_path)
    recording = recorder(tmp_path, "/ambf/env/World/State", min_free_bytes=free - (2 << 20)).start()
    (tmp_path / "large").write_bytes(b"." * (16 << 20))
    assert recording.wait(20)
    assert "are free" in recording.status.reason and recording.status.complete


def test_names_hold_subject_study_and_date_and_nothing_is_overwritten(tmp_path):
    date = datetime.datetime(2026, 11, 21, 15, 4, 5)
    assert bag_name("Ann Lee", "1a: SISO/pick", date) == "Ann-Lee_1a-SISO-pick_2026-11-21-15-04-05.bag"
    assert bag_name("Zoë", "x", date).startswith("Zoë_x_")
    for bad in ("", "  ", "../.."):
        with pytest.raises(ValueError, match="must have a name"):
            bag_name(bad, "study")
    (tmp_path / "a.bag").write_text("here")
    (tmp_path / "a_2.bag.active").write_text("here too")
    assert Recorder(tmp_path / "a.bag", ["/t"]).path == tmp_path / "a_3.bag"


def test_a_recorder_needs_something_to_record(tmp_path):
    with pytest.raises(ValueError, match="nothing to record"):
        Recorder(tmp_path / "a.bag")
    with pytest.raises(ValueError, match=r"'re:\(/a' is no regular expression: .*(unterminated|missing)"):
        Recorder(tmp_path / "a.bag", patterns=["re:(/a"])
    for never in (-1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="duration must be"):
            Recorder(tmp_path / "a.bag", ["/a"], duration=never)


def test_one_list_takes_names_and_patterns_and_says_what_never_came(tmp_path, bench, capfd):
    given = ["/ambf/env/Box/State", "/ambf/env/*/State", "/never", "/nowhere/*", "re:/ambf/env/(Box|Base)/State"]
    with Recorder(tmp_path / "a.bag", given, min_free_bytes=0) as recording:
        assert recording.ready(8)
        eventually(lambda: len(recording.status.missing) == 2, 5)
    assert recording.status.missing == ("/never", "/nowhere/*")
    assert "nothing came of /never, /nowhere/*" in capfd.readouterr().err
    strict = {"strict": True, "min_free_bytes": 0}
    with pytest.raises(RecordingError, match="nothing came of /never"), Recorder(tmp_path / "b", ["/never"], **strict):
        pass
    with pytest.raises(KeyError), Recorder(tmp_path / "c", ["/never"], **strict):
        raise KeyError  # what ended the block counts more


@pytest.mark.parametrize("name", ["", "/", "Box/State", "/a b", "/a//b", "/a/", "/1", "/ä", "/a-b"])
def test_a_name_that_no_topic_can_have_is_refused(tmp_path, name):
    with pytest.raises(ValueError, match="can be no topic"):
        Recorder(tmp_path / "a.bag", [name])


def test_without_a_master_it_waits_for_one(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "http://127.0.0.1:1")
    recording = recorder(tmp_path, "/a").start()
    time.sleep(0.8)
    assert recording.status.running and not recording.status.master
    status = recording.stop()
    assert status.complete
    with rosbag.Bag(str(recording.path)) as bag:
        assert bag.get_message_count() == 0


def test_a_master_that_dies_and_returns_changes_nothing(tmp_path, own_master, start, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", own_master.uri)
    import scenes

    launch = scenes.write(tmp_path, scenes.cubes(2))
    start("--launch_file", launch, "-l", "0", master_uri=own_master.uri, allowed=[".*"])
    recording = recorder(tmp_path, patterns=[STATES]).start()
    assert recording.ready(2, 20)
    own_master.kill()
    eventually(lambda: not recording.status.master, 10)
    before = recording.status.messages
    eventually(lambda: recording.status.messages > before + 20, 10, "messages go on")
    own_master.start()
    eventually(lambda: recording.status.master, 10)
    time.sleep(3.0)  # everybody registers again
    assert recording.stop().lost == 0
    assert Path(recording.path).exists()
