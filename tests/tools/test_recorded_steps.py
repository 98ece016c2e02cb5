"""Bags of a world that a client steps: every step's states, and the commands that travelled with the requests."""

import math
import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest
from ambf_tools import read_bag
from ambf_tools.record import Recorder
from ambf_tools.recording.engine import Engine, Settings

STEPS = 1000
BOX = "/ambf/env/Box"


@pytest.fixture(autouse=True)
def environment(master, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    monkeypatch.setenv("ROS_IP", "127.0.0.1")


@pytest.fixture
def client(bench, ros):
    from ambf_client import Client

    made = Client()
    made.connect()
    yield made
    made.clean_up()


def start_listener(topic):
    """A process that subscribes and is then suspended."""
    script = f"""
import rospy, sys
from ambf_msgs.msg import RigidBodyState
rospy.init_node("hangs", anonymous=True)
rospy.Subscriber("{topic}", RigidBodyState, lambda _: None, buff_size=1)
rospy.wait_for_message("{topic}", RigidBodyState)
print("listens", flush=True)
rospy.spin()
"""
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "listens\n"
    os.kill(process.pid, signal.SIGSTOP)
    return process


def poses_by_step(bag):
    states = bag.array(f"{BOX}/State", ["sim_step", "pose", "twist"])
    return {int(row[0]): row[1:] for row in states}


def test_a_bag_of_steps_with_commands_is_whole_and_repeats_them_bit_for_bit(tmp_path, client, capfd):
    world, box = client.world, client.wait_for(BOX)
    world.step(0)
    before = world.snapshot("before")
    topics = ["/ambf/env/*/State", "/ambf/env/*/Command"]
    with Recorder(tmp_path / "a.bag", topics, every=1, min_free_bytes=0) as recorder:
        assert recorder.ready(8)
        for n in range(STEPS):
            if n == STEPS // 2:
                box.clear_cmd()
            elif n < STEPS // 2 or n % 100 == 0:
                box.set_force(math.sin(0.01 * n), 0.1, 0.0)
            world.step(1)
    first = before.sim_step + 1
    numbers = np.arange(first, first + STEPS)
    with read_bag.open(tmp_path / "a.bag") as bag:
        found = bag.continuity()
        states = {name: count for name, count in found.items() if name.endswith("/State")}
        assert len(states) == 8
        for name, count in states.items():
            assert (count.every, count.lost, count.not_asked_for) == (1, 0, 0), name
            steps = bag.array(name, ["sim_step"])[:, 0]
            np.testing.assert_array_equal(np.unique(steps[steps >= first]), numbers, name)
        times = bag.columns(f"{BOX}/State", "sim_step")
        np.testing.assert_allclose(np.diff(times["time"]), 0.001 * np.diff(times["sim_step"]), atol=1e-5)
        requests = list(bag.step_commands())
        assert [request.sim_step for request in requests] == list(numbers)
        assert all(request.n == 1 for request in requests)
        assert all(BOX in request.commands for request in requests[: STEPS // 2 + 1])
        recorded = poses_by_step(bag)

    box.clear_cmd()
    world.restore(before)
    with Recorder(tmp_path / "b.bag", [f"{BOX}/State"], every=1, min_free_bytes=0) as recorder:
        assert recorder.ready(2)
        for request in requests:
            world.step(request.n, request.commands, only=True)
    with read_bag.open(tmp_path / "b.bag") as bag:
        repeated = poses_by_step(bag)
    for step in numbers:
        np.testing.assert_array_equal(recorded[step], repeated[step], f"step {step}")


def test_steps_of_one_long_request_are_whole_also_beside_a_listener_that_hangs(tmp_path, client, run_python):
    world = client.world
    world.step(0)
    hangs = start_listener(f"{BOX}/State")
    try:
        with Recorder(tmp_path / "a.bag", ["/ambf/env/*/State"], every=1, min_free_bytes=0, strict=True) as recorder:
            assert recorder.ready(8)
            end = world.step(STEPS * 5).sim_step
    finally:
        hangs.kill()
        hangs.wait()
    with read_bag.open(tmp_path / "a.bag") as bag:
        steps = bag.array(f"{BOX}/State", ["sim_step"])[:, 0]
        assert set(range(end - 5 * STEPS + 1, end + 1)) <= set(steps)
        assert all(count.lost == 0 for count in bag.continuity().values())


def test_receipts_go_on_while_the_last_steps_are_awaited(tmp_path, monkeypatch, master, capsys):
    """A simulation that waits for receipts could not send them."""
    engine = Engine(Settings(path=str(tmp_path / "a.bag"), topics=[f"{BOX}/State"], every=1, min_free_bytes=0))
    received, sent = threading.Event(), []
    monkeypatch.setattr(engine, "_send_receipts", received.set)
    monkeypatch.setattr(engine._sources, "wait_until_sent", lambda: sent.append(received.wait(5.0)))
    engine.stop("it is enough")
    engine.run()
    assert sent == [True]
    assert '"complete": true' in capsys.readouterr().out


def test_every_tenth_step_and_as_published(tmp_path, client, run_python):
    world = client.world
    world.step(0)
    tenth, published = (
        Recorder(tmp_path / f"{name}.bag", [f"{BOX}/State"], every=every, min_free_bytes=0)
        for name, every in (("tenth", 10), ("published", 0))
    )
    with tenth:
        assert tenth.ready(2)
        world.step(500)  # one request
        end = world.step(1).sim_step
    with published:
        assert published.ready(1)
        for _ in range(500):
            world.step(1)
    with read_bag.open(tmp_path / "tenth.bag") as bag:
        steps = bag.array(f"{BOX}/State", ["sim_step"])[:, 0]
        assert set(range(-(-(end - 500) // 10) * 10, end, 10)) <= set(steps)
        count = bag.continuity()[f"{BOX}/State"]
        assert (count.every, count.lost) == (10, 0) and count.not_asked_for > 400
    with read_bag.open(tmp_path / "published.bag") as bag:
        count = bag.continuity()[f"{BOX}/State"]
        assert (count.every, count.lost) == (0, 0) and count.not_asked_for > 100
    checked = run_python("-m", "ambf_tools.cli", "bag", "check", tmp_path / "published.bag").stdout
    assert "not asked for" in checked and "record --every 1" in checked
