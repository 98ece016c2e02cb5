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
def deferred(kind: type) -> type:
    """A message type that rospy receives as `kind`, but that is decoded only when .decoded() is first called.

    Decoding costs several times what receiving does, and at 1000 states a second few are ever read.
    """

    class Deferred(kind):  # type: ignore[misc]
        __slots__ = ["_buffer", "_message"]

        def __init__(self) -> None:  # skips building a whole empty message
            self._message: Message = None

        def deserialize(self, str: bytes) -> Deferred:  # the generated code's name for it
            self._buffer = str
            return self

        def decoded(self) -> Message:
            if self._message is None:
                self._message = kind().deserialize(self._buffer)
            return self._message

        def stamp(self) -> Stamp:
            secs, nsecs = _STAMP.unpack_from(self._buffer)
            return secs, nsecs

    Deferred.__name__ = kind.__name__
    return Deferred


def stamp_of(message: Message) -> Stamp:
    """When the simulator made that state."""
    if hasattr(message, "decoded"):
        stamp: Stamp = message.stamp()
        return stamp
    return message.header.stamp.secs, message.header.stamp.nsecs
