"""Python client of the AMBF simulator: see docs/python.md.

>>> from ambf_client import Client
"""

from .actuator import Actuator
from .base_object import BaseObject
from .camera import Camera
from .client import Client
from .devices import Device, DeviceParameter
from .env import AmbfEnv, Observation
from .handle import Handle
from .kinds import StepLists, register_handle
from .light import Light
from .object import Object
from .rigid_body import RigidBody
from .sensor import Sensor
from .services import Finding, Kept, Listing, Loaded, RequestRefused, SimulatorUnavailable, StepResult
from .vehicle import Vehicle
from .watch_dog import WatchDog
from .world import World

__all__ = [
    "Actuator",
    "AmbfEnv",
    "BaseObject",
    "Camera",
    "Client",
    "Device",
    "DeviceParameter",
    "Finding",
    "Handle",
    "Kept",
    "Light",
    "Listing",
    "Loaded",
    "Object",
    "Observation",
    "RequestRefused",
    "RigidBody",
    "Sensor",
    "SimulatorUnavailable",
    "StepLists",
    "StepResult",
    "Vehicle",
    "WatchDog",
    "World",
    "register_handle",
]
