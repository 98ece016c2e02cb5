"""The arrays of a world: what it shows and what it obeys.

Rows of `body_...` are World.bodies, and so with joints, sensors, actuators and tasks. Rows of `element_...` are those
of all sensors in their order (rays); World.elements says which ones are whose, and World.tasks which rows of `goal_...`
and `piece_...` are a task's. All are contiguous, and the same memory after each step: copy what you want to keep.
Loading, unloading and removing make new arrays; old ones keep their values.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import _ambf_core
import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats: TypeAlias = NDArray[np.float64]
Bytes: TypeAlias = NDArray[np.int8]
Ints: TypeAlias = NDArray[np.int32]
Memory: TypeAlias = tuple[list[NDArray[Any]], list[NDArray[Any]]]  # of state and commands


class JointMode(enum.IntEnum):
    """What Commands.joint_value means for a joint."""

    NONE = -1  # not commanded: its motor is off
    EFFORT = 0  # N m about, or N along its axis
    POSITION = 1  # rad or m
    VELOCITY = 2  # rad/s or m/s


class BodyMode(enum.IntEnum):
    """Which array of Commands a body obeys."""

    NONE = 0
    WRENCH = 1
    POSE = 2
    TWIST = 3


class ActuatorMode(enum.IntEnum):
    """What an actuator does."""

    NONE = -1  # what its trigger says; without one: nothing
    RELEASE = 0  # it holds nothing
    BODY = 1  # it holds the body in that row, where it is
    SENSED = 2  # it holds what its sensor senses


class State:
    """One instant of a world. Read-only."""

    sim_time: Floats  #: s of simulated time
    sim_step: NDArray[np.int64]  #: steps since loading or the last reset
    diverged: NDArray[np.bool_]  #: the world has stopped (see Diverged); the other arrays show its last good step
    frozen_bodies: Ints  #: bodies that diverged, or hang on one that did, and stand still
    body_pose: Floats  #: (bodies, 7) position in m and quaternion x y z w of the body's frame, in the world's
    body_twist: Floats  #: (bodies, 6) of the centre of mass, world axes: m/s, rad/s
    body_reaction: Floats  #: (bodies, 6) sum of the reactions of joints with feedback, body axes: N, N m
    body_frozen: NDArray[np.bool_]  #: (bodies,) which ones frozen_bodies counts
    joint_position: Floats  #: (joints,) rad or m, measured
    joint_velocity: Floats  #: (joints,) rad/s or m/s, measured
    joint_effort: Floats  #: (joints,) N m or N, measured; 0 where the joint's feedback is off
    joint_commanded: Floats  #: (joints,) the value in force
    joint_commanded_mode: Bytes  #: (joints,) a JointMode: what joint_commanded means
    contact_count: Ints  #: rows of contact_... in use; those behind are zeros
    contact_bodies: Ints  #: (1024, 2) rows of bodies A and B
    contact_point: Floats  #: (1024, 3) m, on B, in the world
    contact_normal: Floats  #: (1024, 3) from B to A, world axes
    contact_distance: Floats  #: (1024,) m, negative where they penetrate
    contact_impulse: Floats  #: (1024,) N s along the normal in the last step
    contact_friction: Floats  #: (1024, 3) N s on A in the last step, world axes
    sensor_triggered: NDArray[np.int64]  #: (sensors,) elements that sense something
    sensor_matched: NDArray[np.bool_]  #: (sensors,) it and a sensor of the same key sense each other's bodies
    sensor_success: NDArray[np.bool_]  #: (sensors,) its task is done ("success when")
    sensor_reading: Floats  #: (sensors, 6) its axes. IMU: m/s2, rad/s; Force Torque: N, N m; others: zeros
    element_body: Ints  #: (elements,) row of the body that it senses; -1: none
    element_distance: Floats  #: (elements,) m from the ray's start; its length where it senses nothing
    element_point: Floats  #: (elements, 3) m, world
    element_force: Floats  #: (elements, 3) N on the body that it senses in the last step, world axes
    actuator_held: Ints  #: (actuators,) number of bodies that it holds
    actuator_bodies: Ints  #: (actuators, 16) their rows; -1: none
    actuator_force: Floats  #: (actuators, 3) N on what it holds in the last step, world axes
    puncture_count: Ints  #: rows of puncture_... in use: those behind are zeros, their needle -1 or 0
    puncture_needle: Ints  #: (48 each needle,) row of the actuator whose needle, or its thread, goes through there
    puncture_out: NDArray[np.bool_]  #: (48 each needle,) the tip came out there; else it went in. The oldest first
    puncture_point: Floats  #: (48 each needle, 3) m, world: where the needle or its thread goes through the surface
    puncture_rest: Floats  #: (48 each needle, 3) m, where that is in the tissue as loaded, in the soft body's frame
    puncture_force: Floats  #: (48 each needle, 3) N on the tissue in the last step, world axes
    task_success: NDArray[np.bool_]  #: (tasks,) all its goals are done
    task_done: Ints  #: (tasks,) number of goals that are done
    task_time: Floats  #: (tasks,) s from loading or the last reset to its first success, or to now
    task_counts: Ints  #: (tasks, 4) drops, touches, hand-overs, goals met out of order
    goal_done: NDArray[np.bool_]  #: (goals,) World.tasks says which ones are whose
    goal_error: Floats  #: (goals, 2) m and rad between piece and place
    piece_held_by: NDArray[np.int64]  #: (pieces,) bit i: holder i of the task holds it

    def __init__(self, arrays: Sequence[NDArray[Any]]) -> None:
        """arrays: memory of all fields, in their order."""
        for field, memory in zip(_ambf_core.STATE_FIELDS, arrays, strict=True):
            shown = memory.view()
            shown.flags.writeable = False
            object.__setattr__(self, field[0], shown)

    @staticmethod
    def fields() -> list[str]:
        """Names of all arrays, in the order of their memory."""
        return [field[0] for field in _ambf_core.STATE_FIELDS]

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"state.{name} is what the world shows; commands are what it obeys")


class Commands:
    """What a world obeys from its next step on, until it is changed. Write or assign to the arrays, or use the methods.

    As in the simulator's Step service: pose, twist and wrench of a body exclude each other, joints are independent of
    it and of each other. A value that is not finite, a quaternion far from length 1 or an unknown mode makes the next
    step raise ValueError, and nothing moves. reset() ends all commands.
    """

    joint_mode: Bytes  #: (joints,) a JointMode each; passive joints take none
    joint_value: Floats  #: (joints,) N m, N; rad, m; rad/s, m/s
    body_mode: Bytes  #: (bodies,) a BodyMode each
    body_wrench: Floats  #: (bodies, 6) force and torque at the centre of mass, world axes: N, N m
    body_pose: Floats  #: (bodies, 7) position in m and quaternion x y z w of the body's frame, in the world's
    body_twist: Floats  #: (bodies, 6) of the centre of mass, world axes: m/s, rad/s
    actuator_mode: Bytes  #: (actuators,) an ActuatorMode each
    actuator_body: Ints  #: (actuators,) row of the body to hold in mode BODY
    _rows: Mapping[str, Mapping[str, int]]

    def __init__(self, arrays: Sequence[NDArray[Any]], rows: Mapping[str, Mapping[str, int]]) -> None:
        """arrays: memory of all fields, in their order; rows: World.rows."""
        object.__setattr__(self, "_rows", rows)
        for field, memory in zip(_ambf_core.COMMAND_FIELDS, arrays, strict=True):
            object.__setattr__(self, field[0], memory)

    def __setattr__(self, name: str, value: ArrayLike) -> None:
        """Assigning to an array writes into it: the world reads this memory, and no other array."""
        if not isinstance(getattr(self, name, None), np.ndarray):
            raise AttributeError(f"commands have no array '{name}'")
        getattr(self, name)[...] = value

    def set_joints(
        self, values: ArrayLike, mode: JointMode = JointMode.POSITION, joints: Sequence[int | str] | None = None
    ) -> None:
        """Commands the joints (rows or names; None: all), one value each or one for all of them."""
        columns = self._columns("joints", joints, self.joint_value.shape[-1])
        numbers = self._checked(values, (*self.joint_value.shape[:-1], len(columns)))
        places = np.array(columns, np.intp)  # once: numpy takes longer for lists
        self.joint_value[..., places] = numbers
        self.joint_mode[..., places] = mode

    def set_body(self, body: int | str, values: ArrayLike, mode: BodyMode) -> None:
        """Commands a body (row or name): 6 numbers of a wrench or twist, or 7 of a pose."""
        arrays = {BodyMode.WRENCH: self.body_wrench, BodyMode.POSE: self.body_pose, BodyMode.TWIST: self.body_twist}
        if mode not in arrays:
            raise ValueError(f"no values go with {mode!r}: use clear()")
        (row,) = self._columns("bodies", [body], self.body_mode.shape[-1])
        target = arrays[mode]
        target[..., row, :] = self._checked(values, target[..., row, :].shape)
        self.body_mode[..., row] = mode

    def set_actuator(self, actuator: int | str, mode: ActuatorMode, body: int | str | None = None) -> None:
        """Commands an actuator (row or name); body: what it shall hold in mode BODY, and in no other mode.

        What already holds something keeps it in mode BODY: a step with RELEASE comes before another body.
        """
        if (mode == ActuatorMode.BODY) != (body is not None):
            raise ValueError(f"{mode!r} with body={body!r}: a body goes with mode BODY, and with no other")
        (row,) = self._columns("actuators", [actuator], self.actuator_mode.shape[-1])
        if body is not None:
            (self.actuator_body[..., row],) = self._columns("bodies", [body], self.body_mode.shape[-1])
        self.actuator_mode[..., row] = mode

    def arrays(self) -> list[NDArray[Any]]:
        """All of them."""
        return [getattr(self, field[0]) for field in _ambf_core.COMMAND_FIELDS]

    def clear(self) -> None:
        """Nothing is commanded any more."""
        self.joint_mode[...] = JointMode.NONE
        self.body_mode[...] = BodyMode.NONE
        self.actuator_mode[...] = ActuatorMode.NONE

    def _columns(self, kind: str, wanted: Sequence[int | str] | None, count: int) -> list[int]:
        if wanted is None:
            return list(range(count))
        return [find(self._rows[kind], each) if isinstance(each, str) else each for each in wanted]

    @staticmethod
    def _checked(values: ArrayLike, shape: tuple[int, ...]) -> Floats:
        numbers = np.asarray(values, dtype=np.float64)
        if not np.isfinite(numbers).all():
            raise ValueError(f"values must be finite: {values!r}")
        if numbers.shape == shape:
            return numbers
        try:
            return np.broadcast_to(numbers, shape)
        except ValueError:
            raise ValueError(f"values of shape {numbers.shape} do not fit {shape}") from None


def find(rows: Mapping[str, int], name: str) -> int:
    """The row with this full name, or with the only one that contains it. Raises LookupError."""
    if name in rows:
        return rows[name]
    found = [each for each in rows if each.endswith("/" + name)] or [each for each in rows if name in each]
    if len(found) != 1:
        raise LookupError(f"'{name}' fits {', '.join(found) if found else 'none of ' + ', '.join(rows)}")
    return rows[found[0]]


def shapes(fields: Sequence[tuple[str, str, int, str]], counts: Mapping[str, int]) -> list[tuple[tuple[int, ...], str]]:
    """Shape and type of each field's array for one world."""
    out: list[tuple[tuple[int, ...], str]] = []
    for _, rows, columns, element in fields:
        first = () if rows == "one" else (counts[rows],)
        out.append(((*first, columns) if columns > 1 else first, element))
    return out


def allocate(counts: Mapping[str, int]) -> Memory:
    """Arrays of one world's state and commands."""

    def zeros(fields: Sequence[tuple[str, str, int, str]]) -> list[NDArray[Any]]:
        return [np.zeros(shape, element) for shape, element in shapes(fields, counts)]

    return zeros(_ambf_core.STATE_FIELDS), zeros(_ambf_core.COMMAND_FIELDS)


def carry_over(
    old: Commands, old_rows: dict[str, dict[str, int]], new: Commands, new_rows: dict[str, dict[str, int]]
) -> None:
    """Writes what was commanded before the structure changed into new arrays, by name."""
    for field, kind, _, _ in _ambf_core.COMMAND_FIELDS:
        kept = [(new_rows[kind][name], row) for name, row in old_rows[kind].items() if name in new_rows[kind]]
        if kept:
            to, source = (list(each) for each in zip(*kept, strict=True))
            getattr(new, field)[to] = getattr(old, field)[source]
    bodies = list(old_rows["bodies"])
    for name in old_rows["actuators"].keys() & new_rows["actuators"].keys():  # rows of bodies have changed
        row = new_rows["actuators"][name]
        held = int(new.actuator_body[row])
        if not 0 <= held < len(bodies):
            continue  # step() reports it where it counts
        new.actuator_body[row] = new_rows["bodies"].get(bodies[held], -1)
        if new.actuator_body[row] < 0 and new.actuator_mode[row] == ActuatorMode.BODY:
            new.actuator_mode[row] = ActuatorMode.RELEASE
