"""Messages as text: templates to fill in, YAML into a message, and a message as rows that can be read."""

import io
import math
import re
import struct
import time
from collections.abc import Callable, Iterator
from typing import Any

import genpy
import yaml

Message = Any  # ROS messages are generated, without types
Row = list[Any]  # [name, value] or [name, value, [rows below]]

_MOST_ELEMENTS = 32  # of an array, in rows
_MOST_VALUES = 6  # of an array, in one line
_MOST_ROWS = 400  # of a message
_MOST_CHARACTERS = 300  # of a string
_COMPACT = 4  # fields that fit into one line
_HEADERS = ("std_msgs/Header", "Header", "roslib/Header")


class TextError(ValueError):
    """Why a text is no such message, in one line."""


# --- templates -------------------------------------------------------------------------------------------------------


def template(kind: Any) -> str:
    """The message type as YAML with its default values, to be filled in."""
    lines = list(_template_lines(kind(), ""))
    constants = [
        f"{name}={value}"
        for name, value in vars(kind).items()
        if name.isupper() and isinstance(value, int | float | str)
    ]
    if constants:
        lines.append("# constants: " + ", ".join(constants))
    return "\n".join(lines) + "\n" if lines else ""


def _template_lines(message: Message, indent: str) -> Iterator[str]:
    for name, kind in zip(message.__slots__, message._slot_types, strict=True):
        value = getattr(message, name)
        if kind in _HEADERS:
            yield f"{indent}{name}: auto"
        elif isinstance(value, genpy.Message) and not _is_compact(value):
            yield f"{indent}{name}:"
            yield from _template_lines(value, indent + "  ")
        elif isinstance(value, list | bytes):
            yield f"{indent}{name}: {_flow(value)}  # {_array_hint(kind)}"
        else:
            yield f"{indent}{name}: {_flow(value)}"


def _array_hint(kind: str) -> str:
    element = kind.partition("[")[0]
    if "/" not in element:
        return kind
    found = genpy.message.get_message_class(element)
    return f"{kind}: {_flow(found())}" if found is not None else kind


def _is_compact(message: Message) -> bool:
    return len(message.__slots__) <= _COMPACT and all("/" not in k and "[" not in k for k in message._slot_types)


def _flow(value: Any) -> str:
    """A value in one line of YAML."""
    if isinstance(value, genpy.Message | genpy.rostime.TVal):
        kind = getattr(value, "_type", "")
        if kind in _HEADERS:
            return "auto"
        if kind == "geometry_msgs/Quaternion":
            return "{x: 0.0, y: 0.0, z: 0.0, w: 1.0}"  # four zeros are no orientation
        return "{" + ", ".join(f"{name}: {_flow(getattr(value, name))}" for name in value.__slots__) + "}"
    if isinstance(value, bytes):
        return str(list(value))
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_flow, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"'{value}'" if isinstance(value, str) else str(value)


# --- YAML into a message ---------------------------------------------------------------------------------------------


class _Loader(yaml.SafeLoader):
    """Takes 1e-3 as the number it is; YAML 1.1 wants 1.0e-3."""


_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float", re.compile(r"^[-+]?[0-9]+(\.[0-9]*)?[eE][-+]?[0-9]+$"), list("-+0123456789")
)


def fill(kind: Any, text: str) -> Message:
    """A message of that type from YAML: fields by name, or all values in order. What is not named stays at its default.
    `auto` fills a header, `now` a time. Raises TextError."""
    try:
        values = yaml.load(text, Loader=_Loader)
    except yaml.YAMLError as problem:
        raise TextError(_yaml_problem(problem)) from None
    message = kind()
    now = genpy.Time.from_sec(time.time())
    keys: dict[str, Any] = {"now": now}
    if any(each in _HEADERS for each in kind._slot_types) or "auto" in text:
        from std_msgs.msg import Header

        keys["auto"] = Header(stamp=now)
    if values is None:
        values = {}
    try:
        genpy.message.fill_message_args(message, values if isinstance(values, list) else [values], keys=keys)
        message._check_types()
        message.serialize(io.BytesIO())  # not all that has the right type can be sent: 1e300 as a float32, times
    except (
        OverflowError,
        genpy.MessageException,
        genpy.SerializationError,
        struct.error,
        ValueError,
        TypeError,
        AttributeError,
    ) as problem:
        raise TextError(f"not a {kind._type}: {' '.join(str(problem).split())[:_MOST_CHARACTERS]}") from None
    return message


def _yaml_problem(problem: yaml.YAMLError) -> str:
    mark = getattr(problem, "problem_mark", None)
    what = getattr(problem, "problem", None) or str(problem)
    where = f"line {mark.line + 1}, column {mark.column + 1}: " if mark is not None else ""
    return f"not YAML: {where}{what}"


# --- a message as rows -----------------------------------------------------------------------------------------------


def rows(message: Message) -> list[Row]:
    """What a message holds, for people: long arrays and strings are shortened."""
    left = [_MOST_ROWS]
    return _rows(zip(message.__slots__, (getattr(message, name) for name in message.__slots__), strict=True), left)


def _rows(named: Any, left: list[int]) -> list[Row]:
    made: list[Row] = []
    for name, value in named:
        if left[0] <= 0:
            made.append(["...", "more than can be shown"])
            break
        left[0] -= 1
        made.append(_row(name, value, left))
    return made


def _row(name: str, value: Any, left: list[int]) -> Row:
    if isinstance(value, genpy.rostime.TVal):
        return [name, f"{value.secs}.{value.nsecs:09d}"]
    if isinstance(value, genpy.Message):
        if value.__slots__ == ["data"] and _is_compact(value):  # std_msgs/String and the like
            return [name, _short(value.data)]
        if value._type in _HEADERS:
            return [name, _short(value.stamp), [[each, _short(getattr(value, each))] for each in value.__slots__]]
        if _is_compact(value) and value.__slots__:
            return [name, "  ".join(f"{each} {_short(getattr(value, each))}" for each in value.__slots__)]
        return [name, "", _rows(((each, getattr(value, each)) for each in value.__slots__), left)]
    if isinstance(value, bytes):
        return [name, _series(list(value[:_MOST_VALUES]), len(value), str)]
    if isinstance(value, list | tuple):
        return _array(name, value, left)
    return [name, _short(value)]


def _array(name: str, values: Any, left: list[int]) -> Row:
    if not values:
        return [name, "empty"]
    plain = not isinstance(values[0], genpy.Message)
    text = _series(values[:_MOST_VALUES], len(values), _short) if plain else f"{len(values)} elements"
    if plain and len(values) == 1:
        return [name, text]
    below = _rows(((f"[{i}]", value) for i, value in enumerate(values[:_MOST_ELEMENTS])), left)
    if len(values) > _MOST_ELEMENTS:
        below.append(["...", f"{len(values) - _MOST_ELEMENTS} more"])
    return [name, text, below]


def _series(first: Any, count: int, text: Callable[[Any], str]) -> str:
    shown = ", ".join(map(text, first))
    return shown if count <= len(first) else f"{shown}, ... ({count} values)"


def _short(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        if math.isfinite(value) and abs(value) < 1e-9:  # what solvers leave of a zero
            return "0"
        return f"{value:.6g}"
    if isinstance(value, str):
        if not value:
            return "''"
        return value if len(value) <= _MOST_CHARACTERS else f"{value[:_MOST_CHARACTERS]}... ({len(value)} characters)"
    return f"{value.secs}.{value.nsecs:09d}" if isinstance(value, genpy.rostime.TVal) else str(value)
