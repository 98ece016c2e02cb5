"""Messages as text: templates to fill in, and YAML into a message."""

import io
import re
import struct
import time
from collections.abc import Iterator
from typing import Any

import genpy
import yaml

Message = Any  # ROS messages are generated, without types

_MAX_CHARACTERS = 300  # of a reported problem
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
        raise TextError(f"not a {kind._type}: {' '.join(str(problem).split())[:_MAX_CHARACTERS]}") from None
    return message


def _yaml_problem(problem: yaml.YAMLError) -> str:
    mark = getattr(problem, "problem_mark", None)
    what = getattr(problem, "problem", None) or str(problem)
    where = f"line {mark.line + 1}, column {mark.column + 1}: " if mark is not None else ""
    return f"not YAML: {where}{what}"
