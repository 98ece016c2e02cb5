"""What Object and RigidBody share: wrenches, joints by name or index, and the lists that they ask for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _numbers
from ._generations import takes_ral
from ._joint_names import full_joint_names
from ._messages import Message
from ._say import say
from .base_object import BaseObject
from .handle import Gate
from .services import JointInfo, Listing, RequestRefused, SimulatorUnavailable

JointId = str | int | JointInfo


class JointedObject(BaseObject):
    """A body with joints below it.

    Joints are named by their name (as in get_joint_names, or its unambiguous last part), by their full name or entry in
    Client.list().joints, or by their index in get_joint_names. A joint that does not exist is said, and otherwise left
    out; a list with more values than there are joints raises ValueError.
    """

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
        self._asked_lists = {"publish_children_names": False, "publish_joint_names": False}
        self._asked_lists["publish_joint_positions"] = False
        self._list_world: Callable[[], Listing | None] = lambda: None
        self._full_names: tuple[list[str], dict[str, int]] = ([], {})  # for which joint names; {full name: index}

    # --- joints ----------------------------------------------------------------------------------------------------

    def is_joint_idx_valid(self, joint_idx: int) -> bool:
        """Whether there is a joint of that index; says so if not."""
        count = self.get_num_joints()
        if isinstance(joint_idx, (int, np.integer)) and 0 <= joint_idx < count:
            return True
        say(f"{self._name} has no joint {joint_idx!r}: it has {count}, from 0")
        return False

    def get_joint_idx_from_name(self, joint_name: str) -> int | None:
        """Index of a joint; None, and a message, if there is no such joint."""
        index, problem = self.find_joint(joint_name)
        if index is None:
            say(problem)
        return index

    def find_joint(self, joint_name: str) -> tuple[int | None, str]:
        """(index of a joint or None, why there is none); get_joint_idx_from_name without a message."""
        names = list(self._state.joint_names)
        if joint_name in names:
            return names.index(joint_name), ""
        fits = [i for i, name in enumerate(names) if name.endswith("/" + joint_name)]
        if not fits and "/" in joint_name:
            listed = self._indices_by_full_name(names)
            tail = "/" + joint_name.lstrip("/")
            tails = [i for full, i in listed.items() if ("/" + full).endswith(tail)]
            fits = [listed[joint_name]] if joint_name in listed else tails
        if len(fits) == 1:
            return fits[0], ""
        what = "several joints" if fits else "no joint"
        return None, f"{self._name} has {what} '{joint_name}'; its joints: {names}"

    def _indices_by_full_name(self, names: list[str]) -> dict[str, int]:
        """Asks the simulator, once for each list of joints."""
        for_names, indices = self._full_names
        if for_names != names:
            try:
                listing = self._list_world()
            except (RequestRefused, SimulatorUnavailable):  # of an older generation, or gone
                listing = None
            if listing is None:
                return {}
            indices = full_joint_names(listing, self._topic, names)
            self._full_names = names, indices
        return indices

    def get_joint_name_from_idx(self, joint_idx: int) -> str | None:
        """Name of a joint; None, and a message, if there is no such joint."""
        return str(self._state.joint_names[joint_idx]) if self.is_joint_idx_valid(joint_idx) else None

    def get_num_joints(self) -> int:
        """How many joints there are below the body. 0 until a state with joints has arrived."""
        state = self._state
        return len(state.joint_names) or len(state.joint_positions)

    def get_joint_names(self) -> list[str]:
        """Names of all joints below the body; an index counts in this list."""
        return list(self._state.joint_names)

    def get_joint_pos(self, joint_name_or_idx: JointId) -> float | None:
        """Measured position of a joint (rad or m)."""
        return self._joint_value(joint_name_or_idx, self._state.joint_positions)

    def get_all_joint_pos(self) -> list[float]:
        """Measured positions of all joints (rad or m)."""
        return list(self._state.joint_positions)

    @property
    def joint_names(self) -> list[str]:
        """Names of all joints below the body."""
        return self.get_joint_names()

    @property
    def joint_positions(self) -> NDArray[np.float64]:
        """Measured positions of all joints (rad or m)."""
        return np.array(self._state.joint_positions, dtype=float)

    def _joint_index(self, joint: JointId) -> int | None:
        if isinstance(joint, JointInfo):
            joint = joint.name
        if isinstance(joint, str):
            return self.get_joint_idx_from_name(joint)
        return int(joint) if self.is_joint_idx_valid(joint) else None

    def _joint_value(self, joint: JointId, values: Any) -> float | None:
        index = self._joint_index(joint)
        if index is None or index >= len(values):  # values come a little later than names
            return None
        return float(values[index])

    def _joint_items(self, joints: Any, value: Any, what: str) -> list[tuple[int, float]]:
        """(index, value) of one joint, of a {joint: value}, or of values for all joints from the first on."""
        if value is None and not isinstance(joints, Mapping):
            if isinstance(joints, str | JointInfo) or np.ndim(joints) != 1:
                raise TypeError(f"{what} takes a joint and a value, a dictionary, or values for all joints")
            count = self.get_num_joints()
            if len(joints) > count:
                raise ValueError(f"{what} was given {len(joints)} values; {self._name} has {count} joints")
            return [(i, _numbers.number(joints[i], what)) for i in range(len(joints))]
        pairs: Iterable[tuple[JointId, Any]] = [(joints, value)] if value is not None else joints.items()
        items = []
        for joint, wanted in pairs:
            index = self._joint_index(joint)
            if index is not None:
                items.append((index, _numbers.number(wanted, f"{what} of joint {joint}")))
        return items

    # --- forces ----------------------------------------------------------------------------------------------------

    def get_force_command(self) -> Message:
        """The commanded force (N, world axes)."""
        return self._cmd.wrench.force

    def get_torque_command(self) -> Message:
        """The commanded torque (N m, world axes)."""
        return self._cmd.wrench.torque

    def get_inertia(self) -> Message:
        """Principal moments of inertia as geometry_msgs/Point (kg m2)."""
        return self._state.pInertia

    def get_mass(self) -> float:
        """Mass (kg); 0 for bodies that do not move by forces."""
        return float(self._state.mass)

    def set_force(self, fx: Any, fy: float | None = None, fz: float | None = None) -> None:
        """Commands a force at the centre of mass (N, world axes). Without another call it ends after time_out."""
        force = _numbers.triple(fx, fy, fz, "set_force")
        with self._command_lock:
            self._start_wrench_command()
            f = self._cmd.wrench.force
            f.x, f.y, f.z = force
            self._send_command()

    def set_torque(self, nx: Any, ny: float | None = None, nz: float | None = None) -> None:
        """Commands a torque (N m, world axes). Without another call it ends after time_out."""
        torque = _numbers.triple(nx, ny, nz, "set_torque")
        with self._command_lock:
            self._start_wrench_command()
            n = self._cmd.wrench.torque
            n.x, n.y, n.z = torque
            self._send_command()

    def set_wrench(self, wrench: Any) -> None:
        """Commands force and torque: a Wrench message or [fx, fy, fz, nx, ny, nz] (N, N m, world axes)."""
        if hasattr(wrench, "force"):
            force = _numbers.triple(wrench.force, None, None, "set_wrench")
            torque = _numbers.triple(wrench.torque, None, None, "set_wrench")
            self.wrench_command(*force, *torque)
        else:
            self.wrench_command(*_numbers.sequence(wrench, 6, "set_wrench"))

    def wrench_command(self, fx: float, fy: float, fz: float, nx: float, ny: float, nz: float) -> None:
        """Commands force and torque at once (N, N m, world axes)."""
        force = _numbers.triple(fx, fy, fz, "wrench_command")
        torque = _numbers.triple(nx, ny, nz, "wrench_command")
        with self._command_lock:
            self._start_wrench_command()
            f, n = self._cmd.wrench.force, self._cmd.wrench.torque
            f.x, f.y, f.z = force
            n.x, n.y, n.z = torque
            self._send_command()

    def _start_wrench_command(self) -> None:
        raise NotImplementedError

    def _asking(self) -> Message:
        """A message that asks for lists and commands nothing; None: there is none, a command has to come along."""
        return None

    def _join(self, gate: Gate, list_world: Callable[[], Listing | None]) -> None:
        super()._join(gate, list_world)
        self._list_world = list_world

    def _is_complete(self) -> bool:
        return self.get_num_joints() > 0

    def _on_watchdog(self) -> None:
        f, n = self._cmd.wrench.force, self._cmd.wrench.torque
        if any((f.x, f.y, f.z, n.x, n.y, n.z)):
            self.console_print(self._name)
            f.x = f.y = f.z = n.x = n.y = n.z = 0.0

    # --- lists -----------------------------------------------------------------------------------------------------

    def set_active(self) -> None:
        """Connects the handle and asks for the names of children and joints, and for joint positions."""
        if not self._active:
            for flag in self._asked_lists:
                self._ask(flag, True)
        super().set_active()

    def get_publish_children_name_flag(self) -> bool:
        """Whether the names of children are asked for."""
        return self._asked_lists["publish_children_names"]

    def get_publish_joint_names_flag(self) -> bool:
        """Whether the names of joints are asked for."""
        return self._asked_lists["publish_joint_names"]

    def get_publish_joint_positions_flag(self) -> bool:
        """Whether positions, velocities and efforts of joints are asked for."""
        return self._asked_lists["publish_joint_positions"]

    def set_publish_children_names_flag(self, state: bool) -> None:
        """Asks for the names of children. The simulator grants it for good."""
        self._ask("publish_children_names", state)

    def set_publish_joint_names_flag(self, state: bool) -> None:
        """Asks for the names of joints. The simulator grants it for good."""
        self._ask("publish_joint_names", state)

    def set_publish_joint_positions_flag(self, state: bool) -> None:
        """Asks for positions, velocities and efforts of joints. The simulator grants it for good."""
        self._ask("publish_joint_positions", state)

    # Old spellings, which scripts of the original's tests use.
    set_publish_children_name_flag = set_publish_children_names_flag

    def _ask(self, flag: str, state: bool) -> None:
        with self._command_lock:
            self._asked_lists[flag] = bool(state)
            setattr(self._cmd, flag, bool(state))
            # While the client steps the world, what is commanded goes with the steps: as a message it would act twice.
            sent = self._commanded and not self._gate.stepping
            message = self._cmd if sent else self._asking()
            if message is not None:
                self._send_out(message)

    def _new_command(self) -> Message:
        command = super()._new_command()
        for flag, state in getattr(self, "_asked_lists", {}).items():
            setattr(command, flag, state)
        return command
