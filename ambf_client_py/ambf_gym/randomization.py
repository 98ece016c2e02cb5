"""Ranges from which each episode draws parameters of its world: friction, damping, gains, gravity."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from ambf_core.world import PARAMETERS

_GRAVITY = "gravity"  # m/s2; PARAMETERS are of bodies and joints


class Randomization:
    """Ranges as a dict or YAML file: {name of a body or joint: {parameter: [low, high]}, gravity: [low, high]}.

    Parameters are World.set_parameter's. Bounds of what is per axis, and of gravity, are lists of x, y, z.
    """

    def __init__(self, ranges: str | Path | Mapping[str, Any], world: Any) -> None:
        """Raises ValueError where a range is none, or of what the world does not have."""
        given = yaml.safe_load(Path(ranges).read_text()) if isinstance(ranges, (str, Path)) else ranges
        if not isinstance(given, Mapping):
            raise ValueError(f"randomization: {given!r} is not a map of names to ranges")
        self._ranges: list[tuple[str, str, np.ndarray[Any, Any], np.ndarray[Any, Any]]] = []
        for name, parameters in given.items():
            if name == _GRAVITY:
                self._ranges.append(("", _GRAVITY, *_bounds(name, parameters, 3, -1e6, 1e6)))
                continue
            if not isinstance(parameters, Mapping):
                raise ValueError(f"randomization: '{name}': {parameters!r} is not a map of parameters to ranges")
            for parameter, bounds in parameters.items():
                if parameter not in PARAMETERS:
                    raise ValueError(f"randomization: '{name}': there is no parameter '{parameter}'")
                world.parameter(name, parameter)  # raises where this object has none
                row = PARAMETERS[parameter]
                checked = _bounds(f"{name} {parameter}", bounds, 3 if row.per_axis else 1, row.min, row.max)
                self._ranges.append((name, parameter, *checked))

    def apply(self, world: Any, random: np.random.Generator) -> dict[str, Any]:
        """Draws and sets all; what was drawn, by "name parameter"."""
        drawn: dict[str, Any] = {}
        for name, parameter, low, high in self._ranges:
            value = random.uniform(low, high)
            if parameter == _GRAVITY:
                world.set_gravity(value)
            else:
                world.set_parameter(name, parameter, value)
            drawn[f"{name} {parameter}".strip()] = value if len(value) > 1 else float(value[0])
        return drawn


def _bounds(what: str, given: Any, size: int, least: float, most: float) -> tuple[Any, Any]:
    try:
        low, high = (np.broadcast_to(np.asarray(each, np.float64), (size,)) for each in given)
    except (TypeError, ValueError):
        raise ValueError(f"randomization: {what}: {given!r} is not [low, high]") from None
    if not (np.isfinite(low).all() and np.isfinite(high).all() and (low <= high).all()):
        raise ValueError(f"randomization: {what}: {given!r} is not a range")
    if (low < least).any() or (high > most).any():
        raise ValueError(f"randomization: {what}: {given!r} is not within {least:g} to {most:g}")
    return low, high
