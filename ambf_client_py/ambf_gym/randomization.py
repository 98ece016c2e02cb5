"""Ranges from which each episode draws parameters of its world (friction, damping, gains, gravity) and what it sees."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from ambf_core import View, World
from ambf_core.world import PARAMETERS

from .changed_world import BODY_KEYS, LIGHT_KEYS, ChangedWorld, Key

_GRAVITY = "gravity"  # m/s2; PARAMETERS are of bodies and joints
_DELAY, _NOISE, _VIEW = "delay", "noise", "view"  # of observations: actions, standard deviation, what is added to it
_BODIES, _LIGHTS = "bodies", "lights"
_Row = tuple[str, str, str]  # bodies or lights, which one, key of its block
_LONGEST = 1000  # actions
_SHIFTS = {"eye": 3, "at": 3, "field of view": 1}  # numbers: m, m, rad


class Randomization:
    """Ranges as a dict or YAML file: {name of a body or joint: {parameter: [low, high]}, gravity: [low, high],
    lights: {name: {location: [low, high], ..}}, delay: [0, 3], noise: [low, high],
    view: {eye: [low, high], at: .., field of view: ..}}.

    Parameters are World.set_parameter's, and those of a file: mass (kg), scale and color of bodies. Bounds of what is
    per axis, of gravity, of places and of colours are lists of x, y, z (r, g, b).
    """

    def __init__(
        self,
        ranges: str | Path | Mapping[str, Any],
        world: Any,
        view: str | View = "",
        files: Sequence[str | os.PathLike[str]] = (),
        ground: str | os.PathLike[str] | None = None,
        without: Sequence[str] = (),
    ) -> None:
        """files, ground, without: what the world was loaded from.

        Raises ValueError where a range is none, or of what the world does not have.
        """
        given = yaml.safe_load(Path(ranges).read_text()) if isinstance(ranges, (str, Path)) else ranges
        if not isinstance(given, Mapping):
            raise ValueError(f"randomization: {given!r} is not a map of names to ranges")
        self._ranges: list[tuple[str, str, np.ndarray[Any, Any], np.ndarray[Any, Any]]] = []
        self._seen: list[tuple[str, np.ndarray[Any, Any], np.ndarray[Any, Any]]] = []
        self._in_text: dict[_Row, tuple[Any, Any, str]] = {}  # low, high, what info calls it
        self._view = view
        self._files = (files, ground, without)
        self._changed: ChangedWorld | None = None
        for name, parameters in given.items():
            if name == _GRAVITY:
                self._ranges.append(("", _GRAVITY, *_bounds(name, parameters, 3, -1e6, 1e6)))
                continue
            if name in (_DELAY, _NOISE, _VIEW):
                self._seen += self._of_what_is_seen(name, parameters)
                continue
            if not isinstance(parameters, Mapping):
                raise ValueError(f"randomization: '{name}': {parameters!r} is not a map of parameters to ranges")
            if name == _LIGHTS:
                for light, keys in parameters.items():
                    self._of_text(_LIGHTS, light, keys, LIGHT_KEYS, world)
                continue
            keys = {key: bounds for key, bounds in parameters.items() if key in BODY_KEYS}
            if keys:
                self._of_text(_BODIES, name, keys, BODY_KEYS, world)
            for parameter, bounds in parameters.items():
                if parameter in BODY_KEYS:
                    continue
                if parameter not in PARAMETERS:
                    raise ValueError(f"randomization: '{name}': there is no parameter '{parameter}'")
                world.parameter(name, parameter)  # raises where this object has none
                row = PARAMETERS[parameter]
                checked = _bounds(f"{name} {parameter}", bounds, 3 if row.per_axis else 1, row.min, row.max)
                self._ranges.append((name, parameter, *checked))
        for bound in (0, 1) if self._in_text else ():  # refused now rather than in some reset
            self._load({row: bounds[bound] for row, (*bounds, _) in self._in_text.items()}).close()

    @property
    def changes_files(self) -> bool:
        """Whether episodes need worlds that are loaded for them."""
        return bool(self._in_text)

    @property
    def changes_lights(self) -> bool:
        """Whether the world file is among them."""
        return any(kind == _LIGHTS for kind, _, _ in self._in_text)

    def load(self, random: np.random.Generator, over_ros: Any = None) -> tuple[dict[str, Any], Any]:
        """Draws what files say, and loads them so; what was drawn, and the world that apply() goes on with.

        over_ros: a RosWorld, which loads them in the place of what it has.
        """
        values = {row: random.uniform(low, high) for row, (low, high, _) in self._in_text.items()}
        drawn = {self._in_text[row][2]: value if len(value) > 1 else float(value[0]) for row, value in values.items()}
        if over_ros is None:
            return drawn, self._load(values)
        assert self._changed is not None
        over_ros.load_instead(self._changed.texts(self._of(values)[_BODIES]))
        return drawn, over_ros

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

    def _of_text(self, kind: str, name: str, given: Any, keys: Mapping[str, Key], world: Any) -> None:
        where = f"randomization: {kind}: '{name}'" if kind == _LIGHTS else f"randomization: '{name}'"
        if not isinstance(given, Mapping) or not given or not set(given) <= set(keys):
            raise ValueError(f"{where}: {given!r} is not a map of {', '.join(keys)} to ranges")
        rows = []
        for key, bounds in given.items():
            label = f"{'light ' if kind == _LIGHTS else ''}{name} {key}"
            low, high = _bounds(label, bounds, keys[key].size, keys[key].min, keys[key].max)
            if key == "direction" and (low <= 0).all() and (high >= 0).all():
                raise ValueError(f"{where}: direction: {bounds!r} has no direction in its middle")
            rows.append((key, (low, high, label)))
        full = name
        try:
            self._changed = self._changed or ChangedWorld(*self._files)
            if kind == _LIGHTS:
                self._changed.check_light(name)
            else:
                full = world.bodies[world.body(name)]
                self._changed.check_body(full, given)
        except (ValueError, LookupError, yaml.YAMLError) as error:
            raise ValueError(f"{where}: {error}") from None
        for key, row in rows:
            if (kind, full, key) in self._in_text:
                raise ValueError(f"{where}: {key}: {self._in_text[kind, full, key][2]} is the same")
            self._in_text[kind, full, key] = row

    def _of(self, values: Mapping[_Row, Any]) -> dict[str, dict[str, dict[str, Any]]]:
        """By bodies or lights, and names."""
        of: dict[str, dict[str, dict[str, Any]]] = {_BODIES: {}, _LIGHTS: {}}
        for (kind, name, key), value in values.items():
            of[kind].setdefault(name, {})[key] = value
        return of

    def _load(self, values: Mapping[_Row, Any]) -> World:
        of = self._of(values)
        assert self._changed is not None
        return self._changed.load(of[_BODIES], of[_LIGHTS])

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
