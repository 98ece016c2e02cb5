"""The message types, and a way to receive them without decoding those that nobody looks at."""

from __future__ import annotations

import importlib
import struct
from functools import cache
from typing import Any

try:
    # Generated code without types.
    msg: Any = importlib.import_module("ambf_msgs.msg")
    srv: Any = importlib.import_module("ambf_msgs.srv")
    if not hasattr(msg, "RigidBodyState"):  # the source folder of that name, seen from the top of the source tree
        raise ImportError("these are only the definitions")
except ImportError as error:  # the usual first stumble: say what to do
    raise ImportError(
        "ambf_client needs the ROS package ambf_msgs, which building or installing AMBF makes: run "
        "'. PREFIX/share/ambf/setup.sh' of the installation, or './dev shell' in the source tree"
    ) from error

__all__ = ["Message", "Stamp", "deferred", "msg", "srv", "stamp_of"]

Message = Any  # ROS messages are generated, without types
Stamp = tuple[int, int]  # seconds, nanoseconds since 1970

_STAMP = struct.Struct("<4xII")  # std_msgs/Header: sequence, seconds, nanoseconds


@cache
def deferred(kind: type) -> Any:
    """The message type `kind`, decoded only when one of its fields is first read.

    Decoding costs several times what receiving does, and of 1000 states a second few are ever read. In all other
    respects it is a `kind`: rospy gives the same object to all subscribers of a process.
    """

    class Deferred(kind):  # type: ignore[misc]
        __slots__ = ["_buffer"]

        def __init__(self) -> None:
            """Skips building a whole empty message."""

        def deserialize(self, str: bytes) -> Deferred:  # the generated code's name for it
            self._buffer = str
            return self

        def stamp(self) -> Stamp:
            """Of its header, without decoding the rest."""
            secs, nsecs = _STAMP.unpack_from(self._buffer)
            return secs, nsecs

        def __getattr__(self, name: str) -> Any:  # only called for what is not there yet
            if name not in fields:
                raise AttributeError(name)
            message = kind().deserialize(self._buffer)
            for field in fields:
                setattr(self, field, getattr(message, field))
            return getattr(message, name)

    fields: list[str] = list(kind.__slots__)  # type: ignore[attr-defined]
    Deferred.__slots__ = fields  # what generated code, printing and comparing go by
    Deferred.__name__ = kind.__name__
    return Deferred


def stamp_of(message: Message) -> Stamp:
    """When the simulator made that state."""
    if hasattr(type(message), "stamp"):
        stamp: Stamp = message.stamp()
        return stamp
    return message.header.stamp.secs, message.header.stamp.nsecs
