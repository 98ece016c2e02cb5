"""Ranges from which each episode draws parameters of its world (friction, damping, gains, gravity) and what it sees."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from ambf_core import View
from ambf_core.world import PARAMETERS

_GRAVITY = "gravity"  # m/s2; PARAMETERS are of bodies and joints
_DELAY, _NOISE, _VIEW = "delay", "noise", "view"  # of observations: actions, standard deviation, what is added to it
_LONGEST = 1000  # actions
_SHIFTS = {"eye": 3, "at": 3, "field of view": 1}  # numbers: m, m, rad


class Randomization:
    """Ranges as a dict or YAML file: {name of a body or joint: {parameter: [low, high]}, gravity: [low, high],
    delay: [0, 3], noise: [low, high], view: {eye: [low, high], at: .., field of view: ..}}.

    Parameters are World.set_parameter's. Bounds of what is per axis, of gravity, and of places, are lists of x, y, z.
    """

    def __init__(self, ranges: str | Path | Mapping[str, Any], world: Any, view: str | View = "") -> None:
        """Raises ValueError where a range is none, or of what the world does not have."""
        given = yaml.safe_load(Path(ranges).read_text()) if isinstance(ranges, (str, Path)) else ranges
        if not isinstance(given, Mapping):
            raise ValueError(f"randomization: {given!r} is not a map of names to ranges")
        self._ranges: list[tuple[str, str, np.ndarray[Any, Any], np.ndarray[Any, Any]]] = []
        self._seen: list[tuple[str, np.ndarray[Any, Any], np.ndarray[Any, Any]]] = []
        self._view = view
        for name, parameters in given.items():
            if name == _GRAVITY:
                self._ranges.append(("", _GRAVITY, *_bounds(name, parameters, 3, -1e6, 1e6)))
                continue
            if name in (_DELAY, _NOISE, _VIEW):
                self._seen += self._of_what_is_seen(name, parameters)
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
        value: Any
        for name, parameter, low, high in self._ranges:
            value = random.uniform(low, high)
            if parameter == _GRAVITY:
                world.set_gravity(value)
            else:
                world.set_parameter(name, parameter, value)
            drawn[f"{name} {parameter}".strip()] = value if len(value) > 1 else float(value[0])
        for what, low, high in self._seen:
            value = random.integers(low, high, endpoint=True) if what == _DELAY else random.uniform(low, high)
            drawn[what] = value if len(value) > 1 else value[0].item()
        return drawn

    def view(self, drawn: Mapping[str, Any]) -> str | View:
        """What pictures of the episode are taken by."""
        if not isinstance(self._view, View):
            return self._view
        eye, at = (
            tuple((np.array(getattr(self._view, place)) + drawn.get(f"{_VIEW} {place}", 0.0)).tolist())
            for place in ("eye", "at")
        )
        wider = drawn.get(f"{_VIEW} field of view", 0.0)
        return self._view._replace(eye=eye, at=at, field_of_view=self._view.field_of_view + wider)

    def _of_what_is_seen(self, name: str, given: Any) -> list[tuple[str, Any, Any]]:
        if name == _NOISE:
            return [(name, *_bounds(name, given, 1, 0.0, 1e6))]
        if name == _DELAY:
            low, high = _bounds(name, given, 1, 0, _LONGEST)
            if low % 1 or high % 1:
                raise ValueError(f"randomization: delay: {given!r} are not numbers of actions")
            return [(name, low.astype(np.int64), high.astype(np.int64))]
        if not isinstance(self._view, View):
            raise ValueError("randomization: view: pictures of this environment are those of a camera of its files")
        if not isinstance(given, Mapping) or not set(given) <= set(_SHIFTS):
            raise ValueError(f"randomization: view: {given!r} is not a map of {', '.join(_SHIFTS)} to ranges")
        angle = self._view.field_of_view
        least = {"field of view": (0.01 - angle, 3.0 - angle)}
        rows = [
            (f"{_VIEW} {what}", *_bounds(f"view {what}", bounds, _SHIFTS[what], *least.get(what, (-1e3, 1e3))))
            for what, bounds in given.items()
        ]
        widest = {what: np.maximum(np.abs(low), np.abs(high)) for what, low, high in rows}
        moved = widest.get("view eye", np.zeros(3)) + widest.get("view at", np.zeros(3))
        if (moved >= np.abs(np.subtract(self._view.eye, self._view.at))).all():
            raise ValueError("randomization: view: the eye may come to what it looks at")
        return rows


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
