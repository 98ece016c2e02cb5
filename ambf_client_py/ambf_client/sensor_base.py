"""What the handles of all sensors have in common."""

from __future__ import annotations

from enum import Enum

from .base_object import BaseObject


class SensorType(Enum):
    """The kinds of sensors that have different handles, numbered as in AMBF 3.0."""

    RAYTRACER = 1
    CONTACT = 2


class SensorBase(BaseObject):
    """A sensor: it moves with its parent, not by commands."""

    sensor_type = SensorType.RAYTRACER

    def get_type(self) -> SensorType:
        """RAYTRACER: a Sensor; CONTACT: a ContactSensor."""
        return self.sensor_type

    def _start_pose_command(self) -> None:
        raise TypeError(f"{self._name} is a sensor: it moves with its parent, not by commands")
