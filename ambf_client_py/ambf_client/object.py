"""Objects of the older generations (ObjectState, ObjectCmd), and hands of input devices, which have the same."""

from __future__ import annotations

from typing import Any

from . import _numbers, rotations
from ._messages import msg
from .jointed import JointedObject, JointId
from .kinds import register_handle


@register_handle
class Object(JointedObject):
    """An object of AMBF 1.0 or of another server: pose or force control, joints by position or effort.

    Or the hand of an input device ("physical_device_0/left"): set_force pushes it, set_pose pulls it to where its tool
    would have that pose, both until 0.1 s after the last command; joints cannot be commanded.
    """

    object_type = "OBJECT"
    state_type = msg.ObjectState
    command_type = msg.ObjectCmd

    def set_joint_pos(self, joint_name_or_idx: Any, q: float | None = None) -> None:
        """Commands positions (rad or m): of a joint, of several as {joint: value}, or of all as a list or array."""
        self._command_joints(self._joint_items(joint_name_or_idx, q, "set_joint_pos"), True)

    def set_joint_effort(self, joint: Any, effort: float | None = None) -> None:
        """Commands efforts (N m or N): of a joint, of several as {joint: value}, or of all as a list or array."""
        self._command_joints(self._joint_items(joint, effort, "set_joint_effort"), False)

    def pose_command(
        self, px: float, py: float, pz: float, roll: float, pitch: float, yaw: float, *jnt_cmds: float
    ) -> None:
        """Commands a pose (m, rad; the angles applied as "szyx", see RigidBody.pose_command) and joint positions."""
        position = _numbers.triple(px, py, pz, "pose_command")
        angles = _numbers.triple(roll, pitch, yaw, "pose_command")
        joints = [(i, _numbers.number(q, "pose_command")) for i, q in enumerate(jnt_cmds)]
        with self._command_lock:
            self._start_pose_command()
            self._put_position(position)
            self._put_orientation(rotations.quaternion_from_euler(*angles, axes="szyx"))
            for index, value in joints:
                self._put_joint(index, value, True)
            self._send_command()

    def get_joint_command(self, joint_name_or_idx: JointId) -> tuple[str, float] | None:
        """What a joint is commanded: ("position" or "effort", value); None: nothing."""
        index = self._joint_index(joint_name_or_idx)
        with self._command_lock:
            if index is None or index >= len(self._cmd.joint_cmds):
                return None
            kind = "position" if self._cmd.position_controller_mask[index] else "effort"
            return kind, float(self._cmd.joint_cmds[index])

    def _start_wrench_command(self) -> None:
        self._cmd.enable_position_controller = False

    def _command_joints(self, items: list[tuple[int, float]], position: bool) -> None:
        if not items:
            return
        with self._command_lock:
            for index, value in items:
                self._put_joint(index, value, position)
            self._send_command()

    def _put_joint(self, index: int, value: float, position: bool) -> None:
        # This message has no way to leave a joint alone: those before it get an effort of 0.
        missing = index + 1 - len(self._cmd.joint_cmds)
        if missing > 0:
            self._cmd.joint_cmds = [*self._cmd.joint_cmds, *[0.0] * missing]
            self._cmd.position_controller_mask = [*self._cmd.position_controller_mask, *[False] * missing]
        self._cmd.joint_cmds[index] = value
        self._cmd.position_controller_mask[index] = position
