"""Wheeled vehicles."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from . import _numbers
from ._generations import takes_ral
from ._messages import msg
from ._say import say
from .base_object import BaseObject
from .kinds import StepLists, register_handle


@register_handle
class Vehicle(BaseObject):
    """A vehicle. Wheels are numbered from 0; which of them steer and which are driven has to be said first."""

    object_type = "VEHICLE"
    state_type = msg.VehicleState
    command_type = msg.VehicleCmd
    step_lists = StepLists("vehicle_names", "vehicle_cmds", "vehicles")

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
        self._steered: list[int] = []
        self._powered: list[int] = []

    def get_wheel_count(self) -> int:
        """How many wheels the vehicle has. 0 until its state has arrived."""
        return int(self._state.wheel_count)

    def check_wheel_count(self, idx: int) -> bool:
        """Whether there is a wheel of that index; says so if not."""
        if 0 <= idx < self.get_wheel_count():
            return True
        say(f"{self._name} has no wheel {idx}: it has {self.get_wheel_count()}, from 0")
        return False

    def set_steered_wheel_indices(self, indices: Iterable[int]) -> None:
        """Says which wheels set_vehicle_steering turns."""
        self._steered = [i for i in map(int, indices) if self.check_wheel_count(i)]

    def set_powered_wheel_indices(self, indices: Iterable[int]) -> None:
        """Says which wheels set_vehicle_power drives."""
        self._powered = [i for i in map(int, indices) if self.check_wheel_count(i)]

    def initialize_wheel_cmds(self) -> None:
        """Makes the commands as long as the vehicle has wheels, all zero."""
        with self._command_lock:
            count = self.get_wheel_count()
            for values in ("wheel_steering", "wheel_power", "wheel_brake"):
                setattr(self._cmd, values, [0.0] * count)

    def set_vehicle_steering(self, val: float) -> None:
        """Steering angle of all steered wheels (rad)."""
        self._put("wheel_steering", dict.fromkeys(self._steered, val))

    def set_vehicle_steering_ackerman(self, val: float) -> None:
        """The same as set_vehicle_steering."""
        self.set_vehicle_steering(val)

    def set_vehicle_power(self, val: float) -> None:
        """Engine force of all powered wheels (N)."""
        self._put("wheel_power", dict.fromkeys(self._powered, val))

    def set_vehicle_brake(self, val: float) -> None:
        """Brake of all wheels (N, up to the file's max brake power)."""
        self._put("wheel_brake", dict.fromkeys(range(self.get_wheel_count()), val))

    def set_wheel_steering(self, idx: int, val: float) -> None:
        """Steering angle of one wheel (rad)."""
        if self.check_wheel_count(idx):
            self._put("wheel_steering", {idx: val})

    def set_wheel_power(self, idx: int, val: float) -> None:
        """Engine force of one wheel (N)."""
        if self.check_wheel_count(idx):
            self._put("wheel_power", {idx: val})

    def set_wheel_brake(self, idx: int, val: float) -> None:
        """Brake of one wheel (N, up to the file's max brake power)."""
        if self.check_wheel_count(idx):
            self._put("wheel_brake", {idx: val})

    def set_handbrake(self, on: bool) -> None:
        """Takes away all drive and brakes all wheels as hard as they can."""
        with self._command_lock:
            self._cmd.brake = bool(on)
            self._send_command()

    def set_chassis_wrench(self, force: Any, torque: Any = (0.0, 0.0, 0.0)) -> None:
        """Commands a force and torque on the chassis (N, N m)."""
        f, n = _numbers.triple(force, None, None, "force"), _numbers.triple(torque, None, None, "torque")
        with self._command_lock:
            wrench = self._cmd.chassis_wrench
            wrench.force.x, wrench.force.y, wrench.force.z = f
            wrench.torque.x, wrench.torque.y, wrench.torque.z = n
            self._send_command()

    def _start_pose_command(self) -> None:
        raise TypeError(f"{self._name} is a vehicle: it is driven, not put at poses")

    def _put(self, values: str, wanted: dict[int, float]) -> None:
        checked = {i: _numbers.number(v, values) for i, v in wanted.items()}
        with self._command_lock:
            if len(self._cmd.wheel_power) != self.get_wheel_count():
                self.initialize_wheel_cmds()
            for index, value in checked.items():
                getattr(self._cmd, values)[index] = value
            self._send_command()
