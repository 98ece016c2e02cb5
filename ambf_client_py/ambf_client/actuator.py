"""Actuators: constraints that hold a body and let it go again."""

from __future__ import annotations

from typing import Any

from . import _numbers
from ._generations import takes_ral
from ._messages import msg
from .base_object import BaseObject
from .kinds import StepLists, register_handle


@register_handle
class Actuator(BaseObject):
    """An actuator on a body, which can hold another one."""

    object_type = "ACTUATOR"
    state_type = msg.ActuatorState
    command_type = msg.ActuatorCmd
    step_lists = StepLists("actuator_names", "actuator_cmds", "actuators")

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)

    def actuate(self, obj_name: str, pose: Any = None) -> None:
        """Holds the body of that name: where it is, or with `pose` (see set_pose) as the actuator's place in it."""
        with self._command_lock:
            command = self._cmd
            command.actuate = True
            command.use_sensor_data = False
            command.sensor_identifier.data = ""
            command.body_name.data = obj_name
            command.use_offset = pose is not None
            if pose is not None:
                (p, q), offset = _numbers.pose(pose, "actuate"), command.body_offset
                offset.position.x, offset.position.y, offset.position.z = p
                offset.orientation.x, offset.orientation.y, offset.orientation.z, offset.orientation.w = q
            self._send_command()

    def actuate_from_sensor_data(self, sensor_identifer: str) -> None:
        """Holds whatever the sensor of that identifier senses."""
        with self._command_lock:
            command = self._cmd
            command.actuate = True
            command.use_sensor_data = True
            command.sensor_identifier.data = sensor_identifer
            command.body_name.data = ""
            command.use_offset = False
            self._send_command()

    def deactuate(self) -> None:
        """Lets go."""
        with self._command_lock:
            self._cmd.actuate = False
            self._cmd.use_sensor_data = False
            self._cmd.sensor_identifier.data = ""
            self._cmd.body_name.data = ""
            self._send_command()

    def is_actuated(self) -> bool:
        """Whether it holds something."""
        return bool(self._state.actuated)

    def _start_pose_command(self) -> None:
        raise TypeError(f"{self._name} is an actuator: it moves with its parent, not by commands")
