"""Rigid bodies: pose, velocity or force control, and their joints."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _numbers, rotations
from ._messages import Message, msg
from .jointed import JointedObject, JointId
from .kinds import StepLists, register_handle

FORCE, POSITION, VELOCITY = msg.RigidBodyCmd.TYPE_FORCE, msg.RigidBodyCmd.TYPE_POSITION, msg.RigidBodyCmd.TYPE_VELOCITY
NONE = -1  # leaves the body, or the joint, alone


@register_handle
class RigidBody(JointedObject):
    """A rigid body. The last Cartesian setter decides whether a force, a pose or a velocity is commanded.

    Joints are commanded one by one; those never commanded are left alone. set_pose places a static body at once; others
    are moved to the pose by their controller.
    """

    object_type = "RIGID_BODY"
    state_type = msg.RigidBodyState
    command_type = msg.RigidBodyCmd
    step_lists = StepLists("rigid_body_names", "rigid_body_cmds", "rigid_bodies")
    commands_add_up = True
    _commanded_names: list[str] = []  # of the joints that the command's entries are of; replaced, never changed

    # --- measured --------------------------------------------------------------------------------------------------

    def get_linear_vel(self) -> Message:
        """Velocity of the centre of mass as geometry_msgs/Vector3 (m/s, world axes)."""
        return self._state.twist.linear

    def get_angular_vel(self) -> Message:
        """Angular velocity as geometry_msgs/Vector3 (rad/s, world axes)."""
        return self._state.twist.angular

    @property
    def linear_velocity(self) -> NDArray[np.float64]:
        """Velocity of the centre of mass (m/s, world axes)."""
        v = self._state.twist.linear
        return np.array((v.x, v.y, v.z))

    @property
    def angular_velocity(self) -> NDArray[np.float64]:
        """Angular velocity (rad/s, world axes)."""
        v = self._state.twist.angular
        return np.array((v.x, v.y, v.z))

    @property
    def wrench(self) -> NDArray[np.float64]:
        """Force and torque of the joints with `enable feedback` on the body (N, N m, the body's axes)."""
        f, n = self._state.wrench.force, self._state.wrench.torque
        return np.array((f.x, f.y, f.z, n.x, n.y, n.z))

    def get_joint_vel(self, joint_name_or_idx: JointId) -> float | None:
        """Measured velocity of a joint (rad/s or m/s)."""
        return self._joint_value(joint_name_or_idx, self._state.joint_velocities)

    def get_joint_effort(self, joint_name_or_idx: JointId) -> float | None:
        """Measured effort of a joint (N m or N)."""
        return self._joint_value(joint_name_or_idx, self._state.joint_efforts)

    def get_all_joint_vel(self) -> list[float]:
        """Measured velocities of all joints (rad/s or m/s)."""
        return list(self._state.joint_velocities)

    def get_all_joint_effort(self) -> list[float]:
        """Measured efforts of all joints (N m or N)."""
        return list(self._state.joint_efforts)

    @property
    def joint_velocities(self) -> NDArray[np.float64]:
        """Measured velocities of all joints (rad/s or m/s)."""
        return np.array(self._state.joint_velocities, dtype=float)

    @property
    def joint_efforts(self) -> NDArray[np.float64]:
        """Measured efforts of all joints (N m or N)."""
        return np.array(self._state.joint_efforts, dtype=float)

    # --- commanded -------------------------------------------------------------------------------------------------

    def get_linear_velocity_command(self) -> Message:
        """The commanded velocity (m/s, world axes)."""
        return self._cmd.twist.linear

    def get_angular_velocity_command(self) -> Message:
        """The commanded angular velocity (rad/s, world axes)."""
        return self._cmd.twist.angular

    def get_joint_command(self, joint_name_or_idx: JointId) -> tuple[str, float] | None:
        """What a joint is commanded: ("position", "velocity" or "effort", value); None: it is left alone."""
        index = self._joint_index(joint_name_or_idx)
        with self._command_lock:
            if index is None or index >= len(self._cmd.joint_cmds) or self._cmd.joint_cmds_types[index] == NONE:
                return None
            kind = {FORCE: "effort", POSITION: "position", VELOCITY: "velocity"}[self._cmd.joint_cmds_types[index]]
            return kind, float(self._cmd.joint_cmds[index])

    def set_linear_vel(self, vx: Any, vy: float | None = None, vz: float | None = None) -> None:
        """Commands a velocity (m/s, world axes)."""
        velocity = _numbers.triple(vx, vy, vz, "set_linear_vel")
        with self._command_lock:
            self._cmd.cartesian_cmd_type = VELOCITY
            v = self._cmd.twist.linear
            v.x, v.y, v.z = velocity
            self._send_command()

    def set_angular_vel(self, ax: Any, ay: float | None = None, az: float | None = None) -> None:
        """Commands an angular velocity (rad/s, world axes)."""
        velocity = _numbers.triple(ax, ay, az, "set_angular_vel")
        with self._command_lock:
            self._cmd.cartesian_cmd_type = VELOCITY
            v = self._cmd.twist.angular
            v.x, v.y, v.z = velocity
            self._send_command()

    def set_twist(self, twist: Any) -> None:
        """Commands both velocities: a Twist message or [vx, vy, vz, ax, ay, az] (m/s, rad/s, world axes)."""
        if hasattr(twist, "linear"):
            linear = _numbers.triple(twist.linear, None, None, "set_twist")
            angular = _numbers.triple(twist.angular, None, None, "set_twist")
            self.velocity_command(*linear, *angular)
        else:
            self.velocity_command(*_numbers.sequence(twist, 6, "set_twist"))

    def velocity_command(self, vx: float, vy: float, vz: float, ax: float, ay: float, az: float) -> None:
        """Commands both velocities (m/s, rad/s, world axes)."""
        linear = _numbers.triple(vx, vy, vz, "velocity_command")
        angular = _numbers.triple(ax, ay, az, "velocity_command")
        with self._command_lock:
            self._cmd.cartesian_cmd_type = VELOCITY
            v, a = self._cmd.twist.linear, self._cmd.twist.angular
            v.x, v.y, v.z = linear
            a.x, a.y, a.z = angular
            self._send_command()

    def pose_command(
        self, px: float, py: float, pz: float, roll: float, pitch: float, yaw: float, *jnt_cmds: float
    ) -> None:
        """Commands a pose, and positions of the first joints (m, rad).

        The angles are applied as the original did: roll about z, then pitch about y, then yaw about x ("szyx"). That is
        not what set_rpy does.
        """
        position = _numbers.triple(px, py, pz, "pose_command")
        angles = _numbers.triple(roll, pitch, yaw, "pose_command")
        joints = [(i, _numbers.number(q, "pose_command")) for i, q in enumerate(jnt_cmds)]
        with self._command_lock:
            self._start_pose_command()
            self._put_position(position)
            self._put_orientation(rotations.quaternion_from_euler(*angles, axes="szyx"))
            self.resize_joint_cmd_array(len(joints))
            for index, value in joints:
                self._put_joint(index, value, POSITION)
            self._send_command()

    def set_command(self, command: Message) -> None:
        """Makes a whole RigidBodyCmd the command; it is sent at once and kept being sent."""
        with self._command_lock:
            self._commanded_names = list(self._state.joint_names)
            super().set_command(command)
            self._cmd.joint_cmds = [float(v) for v in self._cmd.joint_cmds]
            types = [int(t) for t in self._cmd.joint_cmds_types]
            # Missing types mean effort.
            self._cmd.joint_cmds_types = types + [FORCE] * (len(self._cmd.joint_cmds) - len(types))

    def resize_joint_cmd_array(self, req_len: int, compress_cmd_array: bool = False) -> None:
        """Makes room for commands of the first req_len joints; new entries leave their joints alone.

        compress_cmd_array: also drops the entries beyond them.
        """
        with self._command_lock:
            if compress_cmd_array:
                self._cmd.joint_cmds = self._cmd.joint_cmds[:req_len]
                self._cmd.joint_cmds_types = self._cmd.joint_cmds_types[:req_len]
            missing = req_len - len(self._cmd.joint_cmds)
            if missing > 0:
                self._cmd.joint_cmds = [*self._cmd.joint_cmds, *[0.0] * missing]
            missing = req_len - len(self._cmd.joint_cmds_types)
            if missing > 0:
                self._cmd.joint_cmds_types = [*self._cmd.joint_cmds_types, *[NONE] * missing]

    def set_joint_pos(self, joint_name_or_idx: Any, p: float | None = None) -> None:
        """Commands positions (rad or m): of a joint, of several as {joint: value}, or of all as a list or array."""
        self._command_joints(self._joint_items(joint_name_or_idx, p, "set_joint_pos"), POSITION)

    def set_joint_vel(self, joint_name_or_idx: Any, v: float | None = None) -> None:
        """Commands velocities (rad/s, m/s): of a joint, of several as {joint: value}, or of all as a list or array."""
        self._command_joints(self._joint_items(joint_name_or_idx, v, "set_joint_vel"), VELOCITY)

    def set_joint_effort(self, joint_name_or_idx: Any, f: float | None = None) -> None:
        """Commands efforts (N m or N): of a joint, of several as {joint: value}, or of all as a list or array."""
        self._command_joints(self._joint_items(joint_name_or_idx, f, "set_joint_effort"), FORCE)

    def set_multiple_joint_pos(self, p_list: Any, index_list: Any) -> None:
        """Commands positions of the joints in index_list; joint i gets p_list[i] (rad or m)."""
        self._command_joints(self._picked(p_list, index_list, "set_multiple_joint_pos"), POSITION)

    def set_multiple_joint_vel(self, v_list: Any, index_list: Any) -> None:
        """Commands velocities of the joints in index_list; joint i gets v_list[i] (rad/s or m/s)."""
        self._command_joints(self._picked(v_list, index_list, "set_multiple_joint_vel"), VELOCITY)

    def set_multiple_joint_effort(self, f_list: Any, index_list: Any) -> None:
        """Commands efforts of the joints in index_list; joint i gets f_list[i] (N m or N)."""
        self._command_joints(self._picked(f_list, index_list, "set_multiple_joint_effort"), FORCE)

    def clear_joint(self, joint_name_or_idx: JointId) -> None:
        """Ends commanding one joint: it is left alone from now on."""
        index = self._joint_index(joint_name_or_idx)
        with self._command_lock:
            if index is not None and index < len(self._cmd.joint_cmds):
                self._put_joint(index, 0.0, NONE)
                self._send_command()

    # --- inside ----------------------------------------------------------------------------------------------------

    def _new_command(self) -> Message:
        command = super()._new_command()
        command.cartesian_cmd_type = NONE
        return command

    def _current_command(self) -> Message:
        with self._command_lock:  # steps ask without it
            self._follow_joints()
            return self._cmd

    def _follow_joints(self) -> None:
        """Joints keep their commands when others before them in the list go or come; of those that go, they end."""
        names = list(self._state.joint_names)
        if names == self._commanded_names or not names:
            return
        commands = list(zip(self._cmd.joint_cmds, self._cmd.joint_cmds_types, strict=False))
        before, self._commanded_names = self._commanded_names, names
        if not commands or not before:
            return
        by_name = dict(zip(_distinct(before), commands, strict=False))
        self._cmd.joint_cmds, self._cmd.joint_cmds_types = [], []
        for index, name in enumerate(_distinct(names)):
            if by_name.get(name, (0.0, NONE))[1] != NONE:
                self.resize_joint_cmd_array(index + 1)
                self._put_joint(index, *by_name[name])

    def _letting_go(self) -> Message:
        # One that asks for lists and commands nothing changes nothing.
        command = self._new_command()
        for flag in self._asked_lists:
            setattr(command, flag, False)
        return command

    def _greeting(self) -> Message:
        return super()._greeting() if self._commanded and not self._gate.stepping else self._asking()

    def _asking(self) -> Message:
        return self._new_command() if any(self._asked_lists.values()) else None

    def _start_pose_command(self) -> None:
        if not self._pose_commanded and self.has_state():
            self._put_position(tuple(self.position))
            self._put_orientation(tuple(self.orientation))
        self._pose_commanded = True
        self._cmd.cartesian_cmd_type = POSITION

    def _start_wrench_command(self) -> None:
        self._cmd.cartesian_cmd_type = FORCE

    def _command_joints(self, items: list[tuple[int, float]], kind: int) -> None:
        if not items:
            return
        with self._command_lock:
            self._follow_joints()
            self.resize_joint_cmd_array(1 + max(index for index, _ in items))
            for index, value in items:
                self._put_joint(index, value, kind)
            self._send_command()

    def _put_joint(self, index: int, value: float, kind: int) -> None:
        self._cmd.joint_cmds[index] = value
        self._cmd.joint_cmds_types[index] = kind

    def _picked(self, values: Any, indices: Any, what: str) -> list[tuple[int, float]]:
        return [(int(i), _numbers.number(values[i], what)) for i in indices if self.is_joint_idx_valid(i)]


def _distinct(names: list[str]) -> list[tuple[str, int]]:
    """Each name with its number among those of the same name."""
    return [(name, names[:i].count(name)) for i, name in enumerate(names)]
