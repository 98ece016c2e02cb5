"""Python client of the AMBF simulator: see docs/python.md.

>>> from ambf_client import Client
"""

import importlib
from typing import TYPE_CHECKING, Any

from ._imports import interrupts_held_back

with interrupts_held_back():
    from ._module_names import offer_names_of_third_generation
    from .actuator import Actuator
    from .base_object import BaseObject
    from .camera import Camera
    from .client import Client
    from .contact_sensor import ContactSensor
    from .devices import Device, DeviceParameter
    from .ghost_object import GhostObject
    from .handle import Handle
    from .kinds import StepLists, register_handle
    from .light import Light
    from .object import Object
    from .rigid_body import RigidBody
    from .sensor import Sensor
    from .sensor_base import SensorBase, SensorType
    from .services import Finding, Kept, Listing, Loaded, RequestRefused, SimulatorUnavailable, StepResult
    from .soft_body import SoftBody
    from .task import Task
    from .vehicle import Vehicle
    from .watch_dog import WatchDog
    from .world import World

if TYPE_CHECKING:
    from .env import AmbfEnv, Observation

__all__ = [
    "Actuator",
    "AmbfEnv",
    "BaseObject",
    "Camera",
    "Client",
    "ContactSensor",
    "Device",
    "DeviceParameter",
    "Finding",
    "GhostObject",
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
    "SensorBase",
    "SensorType",
    "SimulatorUnavailable",
    "SoftBody",
    "Task",
    "StepLists",
    "StepResult",
    "Vehicle",
    "WatchDog",
    "World",
    "register_handle",
]

offer_names_of_third_generation(__name__)


def __getattr__(name: str) -> Any:
    """env, and what is in it, when they are asked for: it imports gymnasium, an eighth of a client's start."""
    if name not in ("env", "AmbfEnv", "Observation"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    with interrupts_held_back():
        env = importlib.import_module(f"{__name__}.env")
    return env if name == "env" else getattr(env, name)
