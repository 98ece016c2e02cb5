"""SIGINT, SIGTERM and SIGHUP end the program cleanly in every state, and leave nothing behind (PR8)."""

import os
import signal
import time

import pytest
import scenes
from harness import SLOWNESS, WORLD_NAMES, Master, eventually

SIGNALS = [(signal.SIGINT, 0), (signal.SIGTERM, 143)]
HANG_UP = (signal.SIGHUP, 129)


@pytest.fixture(autouse=True)
def _hang_ups_arrive():
    """Whatever started these tests may have ignored SIGHUP, and what is started inherits that."""
    before = signal.signal(signal.SIGHUP, signal.SIG_DFL)
    yield
    signal.signal(signal.SIGHUP, before)


@pytest.mark.parametrize(("with_signal", "expected"), [*SIGNALS, HANG_UP])
def test_while_running(tmp_path, start, own_master, with_signal, expected):
    simulator = start("--launch_file", scenes.write(tmp_path), "-l", "0", master_uri=own_master.uri)
    eventually(lambda: "/ambf/env/Slide/Command" in own_master.names(), 20.0, "topics")
    code, seconds = simulator.stop(with_signal)
    assert code == expected
    assert own_master.names() == set()
    assert seconds < 1.0 * SLOWNESS


@pytest.mark.parametrize(("with_signal", "expected"), SIGNALS)
def test_while_it_starts(tmp_path, start, own_master, with_signal, expected):
    """At many moments from the first instruction on."""
    launch = scenes.write(tmp_path, scenes.cubes(300))
    for delay_ms in (30, 60, 100, 150, 250, 400):
        simulator = start("--launch_file", launch, "-l", "0", master_uri=own_master.uri)
        time.sleep(delay_ms * 0.001 * SLOWNESS)
        code, _ = simulator.stop(with_signal)
        # Before it could take the signal over, the system ends it: nothing was begun then.
        assert code == expected or (code == -with_signal and not simulator.log()), simulator.log()
        eventually(lambda: own_master.names() == set(), 2.0, "nothing is left behind")


def test_a_terminal_that_closes_may_say_so_twice(tmp_path, start, own_master):
    """The kernel and the shell both do; only the first counts, and nothing is left behind."""
    simulator = start("--launch_file", scenes.write(tmp_path), "-l", "0", master_uri=own_master.uri)
    eventually(lambda: "/ambf/env/Slide/Command" in own_master.names(), 20.0, "topics")
    for _ in range(5):
        simulator.process.send_signal(signal.SIGHUP)
        time.sleep(0.002)
    assert simulator.stop(signal.SIGHUP)[0] == 129
    assert own_master.names() == set()


def test_with_nohup_it_outlives_its_terminal(tmp_path, start):
    signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does for what it starts
    simulator = start("--launch_file", scenes.write(tmp_path), "-l", "0", "--no-ros")
    simulator.wait_loaded()
    simulator.process.send_signal(signal.SIGHUP)
    time.sleep(0.5)
    assert simulator.running()
    assert simulator.stop(signal.SIGTERM)[0] == 143


@pytest.mark.parametrize(("with_signal", "expected"), [*SIGNALS, HANG_UP])
def test_without_a_master(tmp_path, start, with_signal, expected):
    uri = f"http://127.0.0.2:{Master(running=False).port}"
    simulator = start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0"), master_uri=uri, allowed=["Going on without topics"]
    )
    simulator.wait_log("Going on without topics")
    assert simulator.stop(with_signal)[0] == expected


@pytest.mark.parametrize(("with_signal", "expected"), SIGNALS)
def test_when_the_master_has_died(tmp_path, start, own_master, with_signal, expected):
    simulator = start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0"), master_uri=own_master.uri, allowed=["does not answer"]
    )
    # All of the bench's: what is still being registered complains about a master that is gone.
    eventually(lambda: len(own_master.names()) == 2 * 7 + WORLD_NAMES, 20.0, "topics")
    own_master.kill()
    assert simulator.stop(with_signal)[0] == expected


@pytest.mark.parametrize(("with_signal", "expected"), SIGNALS)
def test_while_it_waits_for_a_step_clock(bench, ros, with_signal, expected):
    from ambf_msgs.msg import WorldCmd, WorldState

    state = ros.listen("/ambf/env/World/State", WorldState)
    ros.talk("/ambf/env/World/Command", WorldCmd).publish(WorldCmd(True, False, 1))
    state.last()
    state.next(lambda m: state.messages[-2].sim_step == m.sim_step, what="it waits")
    assert bench.stop(with_signal)[0] == expected


def test_during_a_step_request_without_end(bench, ros):
    import threading

    from ambf_msgs.srv import Step

    step = ros.service("/ambf/env/World/Step", Step)
    answers = []

    def ask():
        try:
            answers.append(step(n=4_000_000_000))
        except Exception as error:  # the connection ends with the simulator
            answers.append(error)

    asker = threading.Thread(target=ask)
    asker.start()
    time.sleep(0.3)
    code, seconds = bench.stop()
    assert code == 0
    assert seconds < 2.0 * SLOWNESS
    asker.join(10.0)
    assert answers


def threads_of(simulator):
    return len(os.listdir(f"/proc/{simulator.pid}/task"))


def test_three_hundred_objects_need_no_more_threads_than_one_and_their_topics_are_gone_within_a_second(
    tmp_path, start, own_master
):
    def started(cubes):
        launch = scenes.write(tmp_path, scenes.cubes(cubes))
        simulator = start("--launch_file", launch, "-l", "0", master_uri=own_master.uri)
        eventually(lambda: len(own_master.names()) == 2 * (cubes + 2) + WORLD_NAMES, 30.0, "all topics")
        return simulator

    one = started(1)
    needed = threads_of(one)
    one.stop()
    assert own_master.names() == set()
    many = started(300)
    threads = threads_of(many)
    assert threads < needed + 10  # none belongs to an object
    assert threads <= 20 + (5 if SLOWNESS > 1 else 0)  # sanitizers have their own
    code, seconds = many.stop()
    assert code == 0
    assert own_master.names() == set()
    assert seconds < 4.0 * SLOWNESS  # 0.4 s on a quiet machine, 1.8 on a busy one


def test_a_second_signal_ends_it_at_once(tmp_path, start):
    simulator = start("--launch_file", scenes.write(tmp_path), "-l", "0", "--no_ros")
    simulator.wait_loaded()
    for _ in range(5):
        if simulator.running():
            simulator.process.send_signal(signal.SIGINT)
        time.sleep(0.001)
    assert simulator.process.wait(10) in (0, 130)
