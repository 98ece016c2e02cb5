"""The answer to a step: states are decoded one by one, when they are read, and mean the same as decoded at once."""

import io

import pytest
from ambf_client._messages import Step, srv
from std_msgs.msg import String

from ambf_msgs.msg import CameraState, Diagnostic, RigidBodyState, WorldState


def serialized(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def body(number, joints):
    state = RigidBodyState(sim_step=7, name=String(f"body {number}"), mass=float(number))
    state.header.frame_id = "w" * number
    state.joint_names = [f"joint {i}" for i in range(joints)]
    state.joint_positions = [0.5 * i for i in range(joints)]
    return state


def answer(**changes):
    states = {"rigid_bodies": [body(1, 3), body(2, 0), body(3, 12)], "cameras": [CameraState(sim_step=7)]}
    world = WorldState(sim_step=7)
    sizes = [len(serialized(s)) for s in (world, *states["rigid_bodies"], *states["cameras"])]
    fields = {"success": True, "sim_step": 7, "sim_time": 0.007, "world": world, "state_sizes": sizes, **states}
    return srv.StepResponse(**{**fields, **changes})


def received(message):
    return Step._response_class().deserialize(serialized(message))


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"message": "there is no object 'x'"},
        {"diagnostics": [Diagnostic(message="careful", line=3)]},
        {"success": False, "message": "refused"},
        {"state_sizes": []},
        {"state_sizes": [1, 2]},
        {"rigid_bodies": [], "cameras": [], "state_sizes": [len(serialized(WorldState()))]},
    ],
)
def test_it_means_what_was_sent(changes):
    sent = answer(**changes)
    got = received(sent)
    for field in set(srv.StepResponse.__slots__) - {"state_sizes"}:
        expected, value = getattr(sent, field), getattr(got, field)
        if isinstance(expected, list):
            assert [serialized(v) for v in expected] == [serialized(v) for v in value], field
        elif hasattr(expected, "serialize"):
            assert serialized(expected) == serialized(value), field
        else:
            assert expected == value, field


def test_only_what_is_read_is_decoded():
    first, second, third = received(answer()).rigid_bodies
    assert [s.sim_step for s in (first, second, third)] == [7, 7, 7]
    assert third.joint_positions[11] == 5.5

    def decoded(state):
        try:
            type(state).__mro__[1].__dict__["joint_names"].__get__(state)
        except AttributeError:
            return False
        return True

    assert [decoded(s) for s in (first, second, third)] == [False, False, True]


@pytest.mark.parametrize("sizes", [[10**9], [0], [0] * 5, [2**32 - 1] * 5])
def test_sizes_that_cannot_be_are_not_believed(sizes):
    sent = answer(state_sizes=sizes)
    got = received(sent)
    assert [b.name.data for b in got.rigid_bodies] == ["body 1", "body 2", "body 3"]
    assert got.world.sim_step == 7
