"""The message types, and a way to receive them without decoding those that nobody looks at."""

from __future__ import annotations

import importlib
import struct
from functools import cache
from itertools import islice
from typing import Any

try:
    # Generated code without types.
    msg: Any = importlib.import_module("ambf_msgs.msg")
    srv: Any = importlib.import_module("ambf_msgs.srv")
    if not hasattr(msg, "RigidBodyState"):  # the source folder of that name, seen from the top of the source tree
        raise ImportError("these are only the definitions")
except ImportError as error:  # the usual first stumble
    if error.name is not None and error.name.partition(".")[0] != "ambf_msgs":
        raise ImportError(
            f"ambf_client needs the Python module {error.name}, which comes with ROS (Debian: apt install "
            "python3-rospy python3-geometry-msgs); './dev deps' in the source tree installs all of it",
            name=error.name,
        ) from error
    raise ImportError(
        "ambf_client needs the ROS package ambf_msgs, which building or installing AMBF makes: run "
        "'. PREFIX/share/ambf/setup.sh' of the installation, or './dev shell' in the source tree"
    ) from error

__all__ = ["Message", "Stamp", "Step", "deferred", "msg", "srv", "stamp_of"]

Message = Any  # ROS messages are generated, without types
Stamp = tuple[int, int]  # seconds, nanoseconds since 1970

_HEADER = struct.Struct("<4xIII")  # std_msgs/Header: sequence, seconds, nanoseconds, characters of frame_id
_NUMBER = struct.Struct("<I")  # uint32, the number of characters or elements
_STEP = struct.Struct("<IdI")  # ambf_msgs/Step: sim_step, sim_time, number of sizes
_FIELDS = list(zip(srv.StepResponse.__slots__, srv.StepResponse._slot_types, strict=True))
_STATES = {  # fields of its answer that follow the sizes, in this order: message type, e.g. of ambf_msgs/CameraState[]
    name: getattr(msg, kind.rpartition("/")[2].removesuffix("[]"))
    for name, kind in _FIELDS[srv.StepResponse.__slots__.index("state_sizes") + 1 :]
}


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
            secs, nsecs, _ = _HEADER.unpack_from(self._buffer)
            return secs, nsecs

        def __getattr__(self, name: str) -> Any:  # only called for what is not there yet
            if name not in fields:
                raise AttributeError(name)
            if name == "sim_step" and step_comes_first:
                (step,) = _NUMBER.unpack_from(self._buffer, _HEADER.size + _HEADER.unpack_from(self._buffer)[2])
                setattr(self, name, step)
                return step
            message = kind().deserialize(self._buffer)
            for field in fields:
                setattr(self, field, getattr(message, field))
            return getattr(message, name)

    fields: list[str] = list(kind.__slots__)  # type: ignore[attr-defined]
    step_comes_first = fields[:2] == ["header", "sim_step"]
    Deferred.__slots__ = fields  # what generated code, printing and comparing go by
    Deferred.__name__ = kind.__name__
    return Deferred


class StepAnswer(srv.StepResponse):  # type: ignore[misc]
    """The answer to a step. Each of its states is decoded only when one of its fields is first read.

    An arm's answer holds a dozen states, and decoding them all costs as much as several steps.
    """

    def __init__(self) -> None:
        """Skips building a whole empty message."""

    def deserialize(self, str: bytes) -> StepAnswer:  # the generated code's name for it
        try:
            whole = self._split(str)
        except struct.error:
            whole = False
        if not whole:
            super().__init__()
            super().deserialize(str)
        return self

    def _split(self, answer: bytes) -> bool:
        """Finds the states by their sizes. False: it holds what must be decoded, or sizes that do not fit."""
        characters: int = _NUMBER.unpack_from(answer, 1)[0]
        (findings,) = _NUMBER.unpack_from(answer, 5 + characters)
        if not answer[0] or findings:
            return False
        self.success = True
        self.message = answer[5 : 5 + characters].decode()
        self.diagnostics: list[Message] = []
        at: int = 9 + characters
        self.sim_step, self.sim_time, count = _STEP.unpack_from(answer, at)
        at += _STEP.size
        self.state_sizes = struct.unpack_from(f"<{count}I", answer, at)
        at += 4 * count
        sizes = iter(self.state_sizes)
        for field, kind in _STATES.items():
            number = 1
            if field != "world":
                (number,) = _NUMBER.unpack_from(answer, at)
                at += 4
            states = []
            for size in islice(sizes, number):
                states.append(deferred(kind)().deserialize(answer[at : at + size]))
                at += size
            if len(states) != number:
                return False
            setattr(self, field, states if field != "world" else states[0])
        return at == len(answer)


class Step(srv.Step):  # type: ignore[misc]
    """The Step service with that answer."""

    _response_class = StepAnswer


def stamp_of(message: Message) -> Stamp:
    """When the simulator made that state."""
    if hasattr(type(message), "stamp"):
        stamp: Stamp = message.stamp()
        return stamp
    return message.header.stamp.secs, message.header.stamp.nsecs
