"""Module of AMBF 3.0: the classes of all sensors."""

from .contact_sensor import ContactSensor
from .sensor import Sensor
from .sensor_base import SensorBase, SensorType

__all__ = ["ContactSensor", "Sensor", "SensorBase", "SensorType"]
