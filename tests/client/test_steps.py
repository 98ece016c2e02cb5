"""World.step: returns with the state of that very step in every handle, loses and doubles nothing, repeats itself."""

import random
import struct
import threading
import time

import numpy as np
import pytest
from ambf_client import Client, RequestRefused
from harness import eventually
from rospy.impl import tcpros_pubsub

from ambf_msgs.msg import RigidBodyCmd, WorldState


def test_every_handle_shows_the_very_step(bench, client):
    world = client.world
    handles = [client.wait_for(name) for name in ("Box", "Base", "Plate", "eye", "sun")]
    at = world.step(0).sim_step
    for n in (1, 2, 50, 1, 300):
        at += n
        result = world.step(n)
        assert result.sim_step == at
        assert result.sim_time == pytest.approx(at * 0.001)
        assert [h.get_sim_step() for h in handles] == [at] * len(handles)
        assert world.get_sim_step() == at
        time.sleep(0.03)  # what comes by topics meanwhile changes nothing
        assert [h.get_sim_step() for h in handles] == [at] * len(handles)
    assert world.is_stepping()
    late = client.wait_for("Table")  # got while the world waits
    assert late.get_sim_step() == at


def test_commands_go_with_the_step_and_hold(bench, client):
    world, box = client.world, client.wait_for("Box")
    world.step(0)
    push = RigidBodyCmd(cartesian_cmd_type=RigidBodyCmd.TYPE_FORCE)
    push.wrench.force.x = 2.0  # 1 m/s2
    for i in range(5):
        world.step(10, {"Box": push} if i == 0 else None)
        assert box.linear_velocity[0] == pytest.approx(0.01 * (i + 1), rel=1e-3)
    time.sleep(0.3)  # the client's watchdog counts no thinking time
    world.step(700)
    assert box.linear_velocity[0] == pytest.approx(0.75, rel=1e-3)
    box.set_force(0.0, 0.0, 0.0)
    world.step(10)
    assert box.linear_velocity[0] == pytest.approx(0.75, rel=1e-3)
    with pytest.raises(LookupError, match="Fox"):
        world.step(1, {"Fox": push})
    with pytest.raises(ValueError):
        world.step(-1)


def test_forces_count_once_when_stepping_begins_and_ends(bench, client):
    world, box = client.world, client.wait_for("Box")
    box.set_force(2.0, 0.0, 0.0)  # by topic
    world.step(0)
    speed = box.linear_velocity[0]
    world.step(100)
    assert box.linear_velocity[0] == pytest.approx(speed + 0.1, rel=0.02)
    before, step = box.linear_velocity[0], box.get_sim_step()
    world.release()
    end = time.monotonic() + 0.4
    while time.monotonic() < end:
        box.set_force(2.0, 0.0, 0.0)
        time.sleep(0.01)
    seconds = (box.get_sim_step() - step) * 0.001
    assert box.linear_velocity[0] - before == pytest.approx(seconds, rel=0.1)


def test_release_lets_the_world_run_and_commands_go_by_topics_again(bench, client):
    world, base = client.world, client.wait_for("Base")
    base.set_joint_pos("turn", 0.2)
    at = world.step(10).sim_step
    time.sleep(0.2)
    assert world.step(0).sim_step == at
    world.release()
    assert not world.is_stepping()
    assert world.wait_for_sim_step(at + 800, 5.0)
    assert base.get_joint_pos("turn") == pytest.approx(0.2, abs=0.01)  # held beyond the watchdog
    # The old clock works after the new steps.
    world.enable_throttling(True)
    world.set_num_step_skips(7)
    world.update()
    eventually(lambda: world.wait_for_next_state() and _waits(world))
    at = world.get_sim_step()
    world.update()
    assert world.wait_for_sim_step(at + 7)
    time.sleep(0.1)
    assert world.get_sim_step() == at + 7


def _waits(world):
    at = world.get_sim_step()
    return world.wait_for_next_state() and world.get_sim_step() == at


def test_one_steps_and_all_see(bench, client, ros):
    watcher = Client()
    watcher.connect()
    seen = watcher.wait_for("Box")
    world_states = ros.listen("/ambf/env/World/State", WorldState)
    at = client.world.step(0).sim_step
    for _ in range(20):
        at = client.world.step(3).sim_step
        assert seen.wait_for_sim_step(at, 5.0)
        assert seen.get_sim_step() == at
    world_states.next(lambda m: m.sim_step == at)
    watcher.clean_up()


def test_several_threads_and_clients_may_step(bench, client):
    other = Client()
    other.connect()
    begin = client.world.step(0).sim_step
    results = []

    def run(world):
        for _ in range(200):
            results.append(world.step(2).sim_step)

    threads = [threading.Thread(target=run, args=(c.world,)) for c in (client, client, other)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(results) == list(range(begin + 2, begin + 2 * 600 + 1, 2))
    assert client.world.step(0).sim_step == begin + 1200
    other.clean_up()


def test_forces_count_once_when_a_handle_is_asked_for_again(bench, client):
    world, box = client.world, client.wait_for("Box")
    assert box.wait_for_connection(20.0)
    box.set_force(2.0, 0.0, 0.0)
    world.step(0)
    before = box.linear_velocity[0]
    assert client.wait_for("Box") is box
    box.set_publish_joint_names_flag(True)
    time.sleep(0.1)  # what was sent arrives
    world.step(100)
    assert box.linear_velocity[0] - before == pytest.approx(0.1, rel=0.02)


def bits(handle):
    """The measured state, exactly."""
    values = [*handle.position, *handle.orientation]
    if hasattr(handle, "linear_velocity"):
        values += [*handle.linear_velocity, *handle.angular_velocity]
        values += [*handle.joint_positions, *handle.joint_velocities]
    return struct.pack(f"{len(values)}d", *values)


def drive(client, steps, seed, delays):
    """A closed loop that thinks at random; the states of every step, bit for bit."""
    world, base, box = client.world, client.wait_for("Base"), client.wait_for("Box")
    choose, wait = random.Random(seed), random.Random()
    at, history = world.step(0).sim_step, []
    for i in range(steps):
        base.set_joint_pos("turn", choose.uniform(-0.3, 0.3))
        base.set_joint_effort("lift", choose.uniform(-1.0, 1.0))
        box.wrench_command(choose.uniform(-1.0, 1.0), base.get_joint_pos("turn"), 0.0, 0.0, 0.0, 0.01)
        at += 1
        assert world.step(1).sim_step == at
        assert base.get_sim_step() == at
        assert box.get_sim_step() == at
        history.append(bits(base) + bits(box))
        if delays and i % 50 == 0:
            time.sleep(wait.choice((0.0, 0.001, 0.02)))
        if delays and i == steps // 2:
            time.sleep(1.2)  # longer than every watchdog
    return history


def differing(a, b):
    """The steps at which two histories differ."""
    return [i for i, (x, y) in enumerate(zip(a, b, strict=True)) if x != y]


def test_same_commands_same_states_bit_for_bit(bench, client):
    world = client.world
    world.step(0)
    kept = world.snapshot("begin")
    first = drive(client, 1500, 7, delays=True)
    for handle in (client.wait_for("Base"), client.wait_for("Box")):
        handle.clear_cmd()
    back = world.restore("begin")
    assert back.sim_step == kept.sim_step
    assert differing(drive(client, 1500, 7, delays=False), first) == []
    world.restore("begin")
    assert len(differing(drive(client, 100, 8, delays=False), first[:100])) > 90  # it does depend on the commands


@pytest.mark.timeout(900)
def test_steps_at_random_times_are_all_run_once(bench, client):
    wait = random.Random()
    world, base = client.world, client.wait_for("Base")
    at = world.step(0).sim_step
    seen = []
    for i in range(25_000):
        base.set_joint_vel("turn", 0.1 if i % 2 else -0.1)
        at += 1
        result = world.step(1)
        if result.sim_step != at or base.get_sim_step() != at:
            seen.append((at, result.sim_step, base.get_sim_step()))
            break
        if wait.random() < 0.002:
            time.sleep(wait.uniform(0.0, 0.02))
        if i in (8_000, 17_000):
            time.sleep(1.3)
    assert seen == []


@pytest.mark.parametrize("wrong", [10**12, 2**32, -1, 1.5, True, "3", None])
def test_numbers_of_steps_that_make_no_sense_run_nothing(bench, client, wrong):
    at = client.world.step(0).sim_step
    with pytest.raises(ValueError, match="number of steps must be an integer from 0 to 4294967295"):
        client.world.step(wrong)
    with pytest.raises(ValueError, match="must be an integer from 1 to 100"):
        client.world.set_num_step_skips(wrong)
    assert client.world.step(np.int64(2)).sim_step == at + 2


def test_what_the_simulator_refuses_is_raised(bench, client):
    bench.allowed.append("refused")
    box = client.wait_for("Box")
    client.world.step(0)
    command = RigidBodyCmd(cartesian_cmd_type=9)
    at = client.world.step(0).sim_step
    with pytest.raises(RequestRefused, match="cartesian_cmd_type"):
        client.world.step(1, {box: command})
    box.clear_cmd()
    assert client.world.step(1).sim_step == at + 1


def test_the_world_is_released_when_the_client_ends(bench, ros):
    state = ros.listen("/ambf/env/World/State", WorldState)
    with Client() as client:
        at = client.world.step(1).sim_step
    state.next(lambda m: m.sim_step > at + 100, what="the world runs again")


def test_a_release_right_before_the_end_arrives(bench, ros, monkeypatch):
    """Also where rospy's sending threads do not come to run before the topic closes, as on a loaded machine."""
    run = tcpros_pubsub.QueuedConnection._run

    def run_late(connection):
        time.sleep(1.0)
        run(connection)

    monkeypatch.setattr(tcpros_pubsub.QueuedConnection, "_run", run_late)
    state = ros.listen("/ambf/env/World/State", WorldState)
    with Client() as client:
        at = client.world.step(1).sim_step
        client.world.release()
    state.next(lambda m: m.sim_step > at + 100, what="the world runs again")


def test_a_handle_that_was_closed_greets_nobody(bench, client):
    """Two clients of one process share their topics, and what listens to them."""
    other = Client()
    other.connect()
    other.wait_for("Box").set_linear_vel(0.3, 0.0, 0.0)
    assert client.wait_for("Box").get_name() == "/ambf/env/Box"
    closed = other._objects.handle("/ambf/env/Box")
    other.clean_up()
    sent = []
    for greeter in list(client.wait_for("Box")._pub.impl.subscriber_listeners):
        greeter.peer_subscribe("", sent.append, sent.append)
    assert closed.is_commanded()
    assert [message.cartesian_cmd_type for message in sent] == [-1]


def test_resets_between_steps_are_done_before_the_next_step(bench, client):
    world, box = client.world, client.wait_for("Box")
    box.set_linear_vel(1.0, 0.0, 0.0)
    world.step(100)
    assert box.position[0] > 0.05
    box.clear_cmd()
    world.reset()
    assert world.step(1).sim_step == 1
    assert abs(box.position[0]) < 0.01
