"""Worlds whose ADF is changed before it is loaded: masses, scales and colours of bodies, and lights."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
import yaml
from ambf_core import World
from numpy.typing import NDArray


class Key(NamedTuple):
    """What of a block may be drawn: how many numbers, and what the loader takes."""

    size: int
    min: float
    max: float


# kg, times the file's meshes, red green blue.
BODY_KEYS = {"mass": Key(1, 1e-9, 1e9), "scale": Key(1, 1e-9, 1e6), "color": Key(3, 0.0, 1.0)}
# m and direction in the parent's frame, rad, none.
LIGHT_KEYS = {
    "location": Key(3, -1e3, 1e3),
    "direction": Key(3, -1e3, 1e3),
    "cutoff angle": Key(1, 1e-3, np.pi),
    "spot exponent": Key(1, 0.0, 1e3),
}
_FILES_OF_WORLD = (("environment",), ("skybox", "path"), ("shaders", "path"))  # relative to the world file
_Edit = tuple[int, int, str]  # the text from here to there becomes this
_Values = Mapping[str, NDArray[np.float64]]  # by key of a block


class ChangedWorld:
    """The files of an environment, as text in which values are replaced; comments and lines stay as they are."""

    def __init__(
        self,
        files: Sequence[str | os.PathLike[str]],
        ground: str | os.PathLike[str] | None,
        without: Sequence[str],
    ) -> None:
        """files, ground (the world file), without: as of World."""
        self._files = [_Adf(Path(each)) for each in files]
        self._ground = None if ground is None else _Adf(Path(ground))
        self._without = without

    def check_body(self, name: str, keys: Mapping[str, Any]) -> None:
        """name: a full one. Raises ValueError where keys of it cannot be changed."""
        for file in self._files:
            if name in file.bodies:
                if "mass" in keys and _number(file.bodies[name], "mass", 1.0) == 0:
                    raise ValueError("mass: it is static")
                return
        raise ValueError("it is in none of the files of the environment")

    def check_light(self, name: str) -> None:
        """Raises ValueError where the world file has no such light."""
        known = [] if self._ground is None else list(self._ground.lights)
        if name not in known:
            raise ValueError(f"there is no such light; the world file has {', '.join(known) or 'none'}")

    def texts(self, bodies: Mapping[str, _Values]) -> list[str | None]:
        """Of each file, with these values, by full names of bodies; None where it is as it was."""
        texts: list[str | None] = []
        for file in self._files:
            edits: list[_Edit] = []
            for name in bodies.keys() & file.bodies.keys():
                edits += _of_body(file.bodies[name], bodies[name])
            texts.append(file.changed(edits) if edits else None)
        return texts

    def load(self, bodies: Mapping[str, _Values], lights: Mapping[str, _Values]) -> World:
        """A world with these values, by full names of bodies and names of lights. Raises LoadError."""
        world = self._load_ground(lights)
        try:
            for file, text in zip(self._files, self.texts(bodies), strict=True):
                world.load(file.path, text=text)
            for name in self._without:
                world.remove(name)
            if self._without:
                world.reset()  # as World does
        except BaseException:
            world.close()
            raise
        return world

    def _load_ground(self, lights: Mapping[str, _Values]) -> World:
        if self._ground is None or not lights:
            return World(world=None if self._ground is None else self._ground.path)
        edits = list(_absolute(self._ground))
        for name, values in lights.items():
            for key, value in values.items():
                edits += _put(self._ground.lights[name], key, _flow(value))
        with TemporaryDirectory() as folder:  # world files are read from files alone
            file = Path(folder) / self._ground.path.name
            file.write_text(self._ground.changed(edits), encoding="utf-8")
            return World(world=file)


class _Adf:
    """A file's text, and where its blocks are in it."""

    def __init__(self, path: Path) -> None:
        self.path, self._text = path, path.read_text(encoding="utf-8")
        root = yaml.compose(self._text, Loader=yaml.SafeLoader)
        if not isinstance(root, yaml.MappingNode):
            raise ValueError(f"'{path}' is not ADF")
        self.root = root
        self.bodies: dict[str, yaml.MappingNode] = {}  # by full name
        self.lights: dict[str, yaml.MappingNode] = {}
        space = _word(self.root, "namespace", "/")
        for key, block in self._listed("bodies"):
            own = _word(block, "namespace", "")
            full = f"{own if own.startswith('/') else space + own}/{_name(block, key)}"
            self.bodies[re.sub("/+", "/", full)] = block
        for key, block in self._listed("lights"):
            self.lights[_name(block, key)] = block

    def changed(self, edits: Sequence[_Edit]) -> str:
        """The text after these edits, which do not overlap."""
        parts, done = [], 0
        for start, end, text in sorted(edits, key=lambda edit: edit[:2]):
            parts += [self._text[done:start], text]
            done = end
        return "".join([*parts, self._text[done:]])

    def _listed(self, kind: str) -> list[tuple[str, yaml.MappingNode]]:
        names = _find(self.root, kind)
        listed = {each.value for each in names.value} if isinstance(names, yaml.SequenceNode) else set()
        return [(key.value, _checked(key, block)) for key, block in self.root.value if key.value in listed]


def _of_body(block: yaml.MappingNode, values: _Values) -> Iterator[_Edit]:
    """A heavier body has the inertia of its mass, a larger one that of its size, too, if the file says what it is."""
    heavier = larger = 1.0
    if "mass" in values:
        yield from _put(block, "mass", _flow(values["mass"]))
        heavier = float(values["mass"][0]) / _number(block, "mass", 1.0)
    if "scale" in values:
        yield from _put(block, "scale", _flow(values["scale"]))
        larger = float(values["scale"][0]) / _number(block, "scale", 1.0)
        offset = _find(block, "inertial offset")
        place = None if offset is None else _find(offset, "position")
        if place is not None:
            yield from _times(place, larger)
    inertia = _find(block, "inertia")
    if inertia is not None:
        yield from _times(inertia, heavier * larger**2)
    if "color" in values:
        color = "{{r: {!r}, g: {!r}, b: {!r}".format(*values["color"].tolist())
        one, parts = _find(block, "color rgba"), _find(block, "color components")
        if one is None and parts is not None:
            yield from _put(parts, "diffuse", color + "}")
        else:
            opaque = 1.0 if one is None else _number(one, "a", 1.0)
            yield from _put(block, "color rgba", f"{color}, a: {opaque!r}}}")


def _times(numbers: yaml.MappingNode, factor: float) -> Iterator[_Edit]:
    if factor != 1.0:
        for key, value in numbers.value:
            yield from _put(numbers, key.value, repr(float(value.value) * factor))


def _absolute(file: _Adf) -> Iterator[_Edit]:
    """Of paths in a world file: it is read from another folder."""
    for *above, key in _FILES_OF_WORLD:
        block: Any = _find(file.root, above[0]) if above else file.root
        if block is not None and _find(block, key) is not None:
            yield from _put(block, key, f'"{(file.path.parent / _word(block, key, "")).resolve()}"')


def _put(block: yaml.MappingNode, key: str, text: str) -> Iterator[_Edit]:
    """Sets a key of a block to a text on one line."""
    value = _find(block, key)
    if value is None:
        first = block.value[0][0].start_mark
        text += ", " if block.flow_style else "\n" + " " * first.column
        yield first.index, first.index, f"{key}: {text}"
        return
    if isinstance(value, yaml.CollectionNode) and not value.flow_style:  # it ends where the next key begins
        text += "\n" + " " * value.end_mark.column
    yield value.start_mark.index, value.end_mark.index, text


def _find(block: yaml.Node, key: str) -> Any:
    pairs = block.value if isinstance(block, yaml.MappingNode) else []
    return next((_checked(each, value) for each, value in pairs if each.value == key), None)


def _checked(key: yaml.Node, value: Any) -> Any:
    if value.start_mark.index < key.start_mark.index:
        raise ValueError(f"'{key.value}' is an alias: a change would be one of other blocks, too")
    return value


def _word(block: yaml.Node, key: str, default: str) -> str:
    node = _find(block, key)
    return default if node is None else str(node.value)


def _name(block: yaml.Node, key: str) -> str:
    """As the loader calls it."""
    return _word(block, "name", re.sub("^(BODY|JOINT) ", "", key)).replace(" ", "")


def _number(block: yaml.Node, key: str, default: float) -> float:
    return float(_word(block, key, repr(default)))


def _flow(value: NDArray[np.float64]) -> str:
    numbers = value.tolist()
    return repr(numbers[0]) if len(numbers) == 1 else "{{x: {!r}, y: {!r}, z: {!r}}}".format(*numbers)
