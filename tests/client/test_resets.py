"""World.reset between steps waits for its own reset: against states as they arrive, without a simulator."""

import threading

import pytest
from ambf_client import SimulatorUnavailable
from ambf_client import world as world_module
from ambf_client._messages import msg
from ambf_client.world import World


class Topic:
    """A reset topic on which a simulator answers with states of the given steps, one after the other."""

    def __init__(self, world, steps):
        self._world, self._steps = world, steps

    def get_num_connections(self):
        return 1

    def publish(self, _):
        threading.Thread(target=self._answer).start()

    def _answer(self):
        for number, step in enumerate(self._steps):
            self._world.ros_cb(state_of(step, 101 + number))


def state_of(step, seconds):
    state = msg.WorldState(sim_step=step)
    state.header.stamp.secs = seconds
    return state


def world_that_is_stepped(at_step):
    world = World("/ambf/env/World")
    world._gate.stepping = True
    world._accept_step(state_of(at_step, 100))
    shown = []
    world.step = lambda n: shown.append((n, world.get_sim_step()))
    return world, shown


def test_a_late_state_is_not_taken_for_the_reset():
    world, shown = world_that_is_stepped(1234)
    world._reset_pub = Topic(world, [1234, 1234, 0])
    world.reset()
    assert shown == [(0, 0)]


def test_a_reset_of_bodies_keeps_the_step():
    world, shown = world_that_is_stepped(1234)
    world._reset_bodies_pub = Topic(world, [1233, 1234])
    world.reset_bodies()
    assert shown == [(0, 1234)]


def test_a_reset_that_does_not_come_raises(monkeypatch):
    monkeypatch.setattr(world_module, "_RESET_TIME", 0.05)
    world, shown = world_that_is_stepped(1234)
    world._reset_pub = Topic(world, [1234])
    with pytest.raises(SimulatorUnavailable, match="was not reset within"):
        world.reset()
    assert shown == []
