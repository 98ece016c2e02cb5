"""ambf_core.WorldBatch: n worlds have the bits of single ones, whatever the number of workers."""

import copy
import os
import signal
import threading
import time

import numpy as np
import pytest
from ambf_core import BodyMode, JointMode, LoadError, World, WorldBatch
from ambf_core.shared import interrupts_deferred


def play(batch, steps=60):
    """Hashes of all worlds after each of some steps; each world has targets of its own."""
    hashes = []
    for i in range(steps):
        if i % 20 == 0:
            batch.commands.set_joints(np.outer(np.arange(batch.n) - 1, [0.25, -0.1 * i]))
        batch.step(3)
        hashes.append(batch.hashes())
    return hashes


@pytest.mark.parametrize("workers", [1, 3])
def test_worlds_of_a_batch_have_the_bits_of_single_ones(scene, workers):
    with WorldBatch(text=scene, n=4, workers=workers) as batch:
        assert batch.state.body_pose.shape == (4, len(batch.bodies), 7) and batch.state.sim_step.shape == (4,)
        address = batch.state.body_pose.ctypes.data
        first = play(batch)
        assert batch.state.body_pose.ctypes.data == address and (batch.state.sim_step == 180).all()
        with World(text=scene) as single:
            for i in range(60):
                if i % 20 == 0:
                    single.commands.set_joints([0.25 * 2, -0.1 * i * 2])
                single.step(3)
                assert single.hash() == first[i][3], i
            assert (single.state.body_pose == batch.state.body_pose[3]).all()
        batch.reset(np.array([True, False, False, True]))
        assert batch.state.sim_step.tolist() == [0, 180, 180, 0]
        assert (batch.commands.joint_mode[0] == JointMode.NONE).all()
        assert (batch.commands.joint_mode[1] == JointMode.POSITION).all()
        batch.reset()
        assert play(batch) == first
        kept = batch.state.body_pose
    assert kept[0, 0, 6] == 1.0, "arrays outlive the batch"


def test_what_is_wrong_in_one_world_moves_none(scene):
    with WorldBatch(text=scene, n=3, workers=2) as batch:
        before = batch.hashes()
        batch.commands.set_joints(0.5)
        batch.commands.joint_value[2, 1] = np.nan
        with pytest.raises(ValueError, match="world 2: command to '/test/upper'|world 2: command to '/test/base'"):
            batch.step(5)
        assert batch.hashes() == before
        for call in (lambda: batch.step(-1), lambda: batch.reset([1, 0, 0]), lambda: batch.set_gravity([np.nan] * 3)):
            with pytest.raises(ValueError):
                call()
        batch.commands.set_joints(0.5)
        box = batch.body("box")
        batch.set_gravity([0, 0, -1.0], np.array([False, False, True]))
        batch.commands.body_mode[1, box] = BodyMode.TWIST
        batch.commands.body_twist[1, box] = [0.5, 0, 0, 0, 0, 0]
        batch.step(100)
        assert batch.state.body_twist[1, box, 0] == pytest.approx(0.5, rel=0.01)
        assert batch.state.body_twist[[0, 2], box, 2] == pytest.approx([-0.98, -0.1], rel=0.02)
    with pytest.raises(RuntimeError, match="closed"):
        batch.step()
    with pytest.raises(LoadError):
        WorldBatch(text="bodies: [", n=2, workers=2)
    with pytest.raises(ValueError):
        WorldBatch(text=scene, n=1, workers=2)


def test_a_view_has_its_own_parameters_and_nothing_that_moves_all_worlds(scene):
    with WorldBatch(text=scene, n=3, workers=2) as batch:
        views = [batch.view(number) for number in range(3)]
        views[1].set_parameter("shoulder", "damping", 0.7)
        views[2].set_parameter("box", "linear damping", 0.2)
        batch.step(1)
        before = views[0].parameter("shoulder", "damping")
        assert before != 0.7 and views[1].parameter("shoulder", "damping") == 0.7
        assert batch.parameter("shoulder", "damping").tolist() == [before, 0.7, before]
        assert views[2].parameter("box", "linear damping") == 0.2 != views[0].parameter("box", "linear damping")
        for each in (views[0], copy.copy(views[0])):
            assert each.bodies == batch.bodies and each.body("box") == batch.body("box")
            for name in ("close", "reset", "restore", "snapshot", "hashes", "n"):
                assert not hasattr(each, name), name
        views[1].step(3)
        assert batch.state.sim_step.tolist() == [1, 4, 1]


def test_a_call_that_cannot_run_leaves_the_batch_whole(scene):
    with WorldBatch(text=scene, n=2, workers=2) as batch:
        for wrong in (1.5, "2", None):
            with pytest.raises(TypeError):
                batch.step(wrong)
        batch.step(np.int64(2))
        assert batch.state.sim_step.tolist() == [2, 2]
        worker = batch._workers[0].process.pid
        os.kill(worker, signal.SIGSTOP)
        other = threading.Thread(target=batch.step, args=(3,))
        try:
            other.start()
            while not batch._busy.locked():
                time.sleep(0.001)
            for call in (batch.step, batch.hashes, batch.reset):
                with pytest.raises(RuntimeError, match="another thread is using this batch"):
                    call()
        finally:
            os.kill(worker, signal.SIGCONT)
            other.join()
        assert batch.state.sim_step.tolist() == [5, 5] and len(set(batch.hashes())) == 1


def interrupted(batch, call):
    """Ctrl-C arrives while a worker has not yet answered."""
    worker, main = batch._workers[0].process, threading.main_thread().ident

    def interrupt():
        while signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            time.sleep(0.001)  # the call has not begun
        signal.pthread_kill(main, signal.SIGINT)
        os.kill(worker.pid, signal.SIGCONT)

    os.kill(worker.pid, signal.SIGSTOP)
    other = threading.Thread(target=interrupt)
    other.start()
    with pytest.raises(KeyboardInterrupt):
        call()
    other.join()


def test_an_interrupt_that_was_held_back_is_not_lost_where_the_call_raises():
    with pytest.raises(KeyboardInterrupt), interrupts_deferred():
        signal.raise_signal(signal.SIGINT)
        raise ValueError
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_many_worlds_see_an_interrupt_as_soon_as_one(scene):
    with WorldBatch(text=scene, n=6, workers=2) as batch:
        batch.commands.set_joints(0.5)
        interrupted(batch, lambda: batch.step(10**7))
        assert (batch.state.sim_step == 333).all()
        batch.step(167)
        with World(text=scene) as single:
            single.commands.set_joints(0.5)
            single.step(500)
            assert batch.hashes() == [single.hash()] * 6


def test_an_interrupt_leaves_all_worlds_at_the_same_step(scene):
    with WorldBatch(text=scene, n=2, workers=2) as batch, World(text=scene) as single:
        for world in (batch, single):
            world.commands.set_joints(0.5)
        interrupted(batch, lambda: batch.step(30))
        interrupted(batch, batch.hashes)
        batch.step(20)
        single.step(30)
        single.step(20)
        assert batch.hashes() == [single.hash()] * 2
        interrupted(batch, lambda: batch.step(10**7))  # not awaited to its end
        assert batch.state.sim_step[0] == batch.state.sim_step[1] == 1050
        interrupted(batch, batch.reset)
        batch.commands.set_joints(0.5)
        batch.step(1500)
        single.reset()
        single.commands.set_joints(0.5)
        single.step(1500)
        assert batch.hashes() == [single.hash()] * 2
        with pytest.raises(RuntimeError, match="close the batch"):
            os.kill(batch._workers[0].process.pid, signal.SIGKILL)
            with pytest.raises(RuntimeError, match="ended with -9"):
                batch.step()
            batch.hashes()


def test_a_worker_that_dies_is_reported_and_none_is_left_behind(scene):
    for call in (WorldBatch.step, WorldBatch.hashes):
        batch = WorldBatch(text=scene, n=2, workers=2)
        os.kill(batch._workers[0].process.pid, 9)
        batch._workers[0].process.wait()
        with pytest.raises(RuntimeError, match="worker of the batch ended with -9"):
            call(batch)
        batch.close()
    batch = WorldBatch(text=scene, n=2, workers=2)
    pid = batch._workers[0].process.pid
    del batch
    end = time.monotonic() + 10
    while os.path.exists(f"/proc/{pid}") and time.monotonic() < end:
        time.sleep(0.02)
    assert not os.path.exists(f"/proc/{pid}")
