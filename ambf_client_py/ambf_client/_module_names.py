"""Modules by their names of AMBF 3.0: ambf_client.ambf_rigid_body is ambf_client.rigid_body."""

from __future__ import annotations

import importlib
import sys

_OWN = {
    "ambf_actuator": "actuator",
    "ambf_base_object": "base_object",
    "ambf_camera": "camera",
    "ambf_client": "client",
    "ambf_ghost_object": "ghost_object",
    "ambf_light": "light",
    "ambf_object": "object",
    "ambf_rigid_body": "rigid_body",
    "ambf_vehicle": "vehicle",
    "ambf_world": "world",
}


def offer_names_of_third_generation(package: str) -> None:
    """Makes them importable, as the very same modules: a class is one whatever name it was imported by."""
    for name, own in _OWN.items():
        module = importlib.import_module(f"{package}.{own}")
        sys.modules[f"{package}.{name}"] = module
        setattr(sys.modules[package], name, module)
