"""Module of the original client, which gives all its classes."""

from ambf_client import (
    Actuator,
    AmbfEnv,
    BaseObject,
    Camera,
    Client,
    Light,
    Object,
    Observation,
    RigidBody,
    Sensor,
    Vehicle,
    WatchDog,
    World,
)

__all__ = [
    "Actuator",
    "AmbfEnv",
    "BaseObject",
    "Camera",
    "Client",
    "Light",
    "Object",
    "Observation",
    "RigidBody",
    "Sensor",
    "Vehicle",
    "WatchDog",
    "World",
]
