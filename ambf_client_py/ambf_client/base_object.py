"""What all objects have in common: a pose to read and, for most, to command."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _numbers, rotations
from ._generations import takes_ral
from ._messages import Message
from .handle import Handle
from .kinds import StepLists


class BaseObject(Handle):
    """An object of the simulation.

    Poses are those of the object's frame: in the world for bodies, in the parent for cameras, lights and sensors.
    Lengths are metres, angles radians, times seconds.
    """

    object_type = "BASE_OBJECT"
    step_lists: StepLists | None = None  # None: the Step service has no lists for this kind
    has_pictures = False  # True: a camera; pictures and points are in the optical axes of its frame
    commands_add_up = False  # True: the simulator adds commands of several sources (topic, steps), as forces

    @takes_ral
    def __init__(self, a_name: str, time_out: float) -> None:
        """a_name: the object's topics without /State and /Command. time_out: of the client's watchdog, s."""
        super().__init__(a_name, time_out)
        self.body_type = ""

    def get_identifier(self) -> str:
        """The identifier of the object's ADF block; empty where it has none."""
        return str(self._state.identifier.data)

    def get_parent_name(self) -> str:
        """Name of the parent; empty for the world and for kinds that have none."""
        parent = getattr(self._state, "parent_name", None)
        return str(parent.data) if parent is not None else ""

    def get_num_of_children(self) -> int:
        """How many children the object has; 0 for kinds that have none."""
        return len(self.get_children_names())

    def get_children_names(self) -> list[str]:
        """Names of all bodies that hang on this one by joints."""
        return list(getattr(self._state, "children_names", ()))

    def get_pos(self) -> Message:
        """Position as geometry_msgs/Point (m). As an array: `position`."""
        return self._state.pose.position

    def get_rot(self) -> Message:
        """Orientation as geometry_msgs/Quaternion. As an array: `orientation`."""
        return self._state.pose.orientation

    def get_rpy(self) -> rotations.Triple:
        """Roll, pitch, yaw about the fixed axes x, y, z (rad)."""
        return rotations.rpy_from_quaternion(self.orientation)

    def get_pose(self) -> Any:
        """[x, y, z, roll, pitch, yaw] (m, rad). As a matrix: `matrix`."""
        position = self._state.pose.position
        return [position.x, position.y, position.z, *self.get_rpy()]

    @property
    def position(self) -> NDArray[np.float64]:
        """Position x, y, z (m)."""
        p = self._state.pose.position
        return np.array((p.x, p.y, p.z))

    @property
    def orientation(self) -> NDArray[np.float64]:
        """Orientation as a quaternion x, y, z, w."""
        q = self._state.pose.orientation
        return np.array((q.x, q.y, q.z, q.w))

    @property
    def rpy(self) -> NDArray[np.float64]:
        """Roll, pitch, yaw about the fixed axes x, y, z (rad)."""
        return np.array(self.get_rpy())

    @property
    def matrix(self) -> NDArray[np.float64]:
        """The pose as a 4x4 matrix that takes points of the object's frame to the world (or the parent)."""
        result = np.identity(4)
        result[:3, :3] = rotations.matrix_from_quaternion(self.orientation)
        result[:3, 3] = self.position
        return result

    def get_pos_command(self) -> Message:
        """The commanded position as geometry_msgs/Point (m)."""
        return self._cmd.pose.position

    def get_rot_command(self) -> Message:
        """The commanded orientation as geometry_msgs/Quaternion."""
        return self._cmd.pose.orientation

    def set_pos(self, px: Any, py: float | None = None, pz: float | None = None) -> None:
        """Commands a position (m): three numbers, or one list, array or Point.

        The commanded orientation stays as it is; the first time it is taken from the state.
        """
        position = _numbers.triple(px, py, pz, "set_pos")
        with self._command_lock:
            self._start_pose_command()
            self._put_position(position)
            self._send_command()

    def set_rpy(self, roll: Any, pitch: float | None = None, yaw: float | None = None) -> None:
        """Commands an orientation by roll, pitch, yaw about the fixed axes x, y, z (rad); see set_rot."""
        angles = _numbers.triple(roll, pitch, yaw, "set_rpy")
        self.set_rot(rotations.quaternion_from_euler(*angles))

    def set_rot(self, quat: Any) -> None:
        """Commands an orientation: a quaternion [x, y, z, w] or a Quaternion message.

        The commanded position stays as it is; the first time it is taken from the state.
        """
        orientation = _numbers.quaternion(quat, "set_rot")
        with self._command_lock:
            self._start_pose_command()
            self._put_orientation(orientation)
            self._send_command()

    def set_pose(self, pose: Any) -> None:
        """Commands a pose: a Pose message, [x, y, z, qx, qy, qz, qw], [x, y, z, r, p, y] or a 4x4 matrix (m, rad)."""
        position, orientation = _numbers.pose(pose, "set_pose")
        with self._command_lock:
            self._start_pose_command()
            self._put_position(position)
            self._put_orientation(orientation)
            self._send_command()

    # --- for subclasses --------------------------------------------------------------------------------------------

    def _sent_with_steps(self) -> bool:
        # The Step service has no place for commands of other kinds: they go on their topics always.
        return self.step_lists is not None and super()._sent_with_steps()

    def _new_command(self) -> Message:
        command = super()._new_command()
        if hasattr(command, "pose"):
            command.pose.orientation.w = 1.0
        return command

    def _start_pose_command(self) -> None:
        """Makes the command one of a pose; what is not commanded yet is as it is now."""
        if not self._pose_commanded and self.has_state():
            self._put_position(tuple(self.position))
            self._put_orientation(tuple(self.orientation))
        self._pose_commanded = True
        self._cmd.enable_position_controller = True

    def _put_position(self, position: Any) -> None:
        p = self._cmd.pose.position
        p.x, p.y, p.z = position

    def _put_orientation(self, orientation: Any) -> None:
        q = self._cmd.pose.orientation
        q.x, q.y, q.z, q.w = orientation
