"""Commands and states of bodies between arrays and messages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from ambf_client._messages import msg
from ambf_core import ActuatorMode, BodyMode, Commands, JointMode

_CMD = msg.RigidBodyCmd
_TYPES = {
    BodyMode.NONE: _CMD.TYPE_FORCE,  # of zero
    BodyMode.WRENCH: _CMD.TYPE_FORCE,
    BodyMode.POSE: _CMD.TYPE_POSITION,
    BodyMode.TWIST: _CMD.TYPE_VELOCITY,
}
Entries = Sequence[tuple[int, int]]  # a body's joints in a message, and their rows


def command_of(commands: Commands, row: int, led: Entries, always: bool) -> Any:
    """What is commanded to a body and the joints that it leads; None if nothing is, unless always."""
    mode = BodyMode(int(commands.body_mode[row]))
    entries = [each for each in led if commands.joint_mode[each[1]] != JointMode.NONE]
    if mode == BodyMode.NONE and not entries and not always:
        return None
    out = _CMD(cartesian_cmd_type=_TYPES[mode], publish_joint_names=True)
    if mode == BodyMode.WRENCH:
        _write_vectors(commands.body_wrench[row], out.wrench.force, out.wrench.torque)
    elif mode == BodyMode.TWIST:
        _write_vectors(commands.body_twist[row], out.twist.linear, out.twist.angular)
    elif mode == BodyMode.POSE:
        _write_vectors(commands.body_pose[row], out.pose.position)
        q = out.pose.orientation
        q.x, q.y, q.z, q.w = commands.body_pose[row, 3:].tolist()
    size = max((entry for entry, _ in led), default=-1) + 1
    out.joint_cmds, out.joint_cmds_types = [0.0] * size, [-1] * size
    for entry, joint in entries:
        out.joint_cmds[entry] = float(commands.joint_value[joint])
        out.joint_cmds_types[entry] = int(commands.joint_mode[joint])
    return out


def check_commands(
    commands: Commands, rows: Mapping[str, Mapping[str, int]], shown: Sequence[int], led: Mapping[int, Entries]
) -> None:
    """Raises ValueError for a command that ROS does not carry: it shall not be dropped silently."""
    joints = {joint for entries in led.values() for _, joint in entries}
    for kind, modes, none, carried in (
        ("bodies", commands.body_mode, BodyMode.NONE, set(shown)),
        ("joints", commands.joint_mode, JointMode.NONE, joints),
        ("actuators", commands.actuator_mode, ActuatorMode.NONE, set()),
    ):
        for row in np.flatnonzero(modes != none):
            if int(row) not in carried:
                raise ValueError(f"command to '{list(rows[kind])[row]}': {kind} like it have none over ROS")


def show_body(arrays: Mapping[str, np.ndarray[Any, Any]], row: int, body: Any, led: Entries) -> None:
    """Writes a body's state, and those of the joints that it leads."""
    p, q, v, w = body.pose.position, body.pose.orientation, body.twist.linear, body.twist.angular
    arrays["body_pose"][row] = p.x, p.y, p.z, q.x, q.y, q.z, q.w
    arrays["body_twist"][row] = v.x, v.y, v.z, w.x, w.y, w.z
    for entry, joint in led:
        arrays["joint_position"][joint] = body.joint_positions[entry]
        arrays["joint_velocity"][joint] = body.joint_velocities[entry]
        arrays["joint_effort"][joint] = body.joint_efforts[entry]


def _write_vectors(numbers: Any, *vectors: Any) -> None:
    for vector, part in zip(vectors, numbers[: 3 * len(vectors)].reshape(-1, 3).tolist(), strict=True):
        vector.x, vector.y, vector.z = part
