"""Reads bags into numpy arrays and pandas tables, and says whether anything is missing in them.

    with read_bag.open("trial.bag") as bag:
        columns = bag.columns("/ambf/env/psm/baselink/State", ["pose.position", "joint_positions"])
        plt.plot(columns["time"], columns["joint_positions[0]"])
        table = bag.table("/ambf/env/psm/baselink/State")  # needs pandas

"time" is simulation time in s, "wall" wall time in s since the bag's start. Message fields keep their names and units
(see docs/ros.md); parts are joined by dots, elements of arrays stand in brackets; what a std_msgs/String or the like
wraps has the name of its field. Needs rosbag (Debian: python3-rosbag); message definitions come from the bag itself.
"""

import math
import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
import numpy.typing as npt

from ambf_tools.recording.topic_sources import EVERY

__all__ = ["BagError", "Continuity", "RecordedBag", "StepCommands", "Topic", "open"]

Columns = dict[str, npt.NDArray[Any]]


class BagError(RuntimeError):
    """The file is no bag, or an incomplete one."""


@dataclass(frozen=True)
class Topic:
    """What a bag holds of one topic."""

    name: str
    type: str  # e.g. ambf_msgs/RigidBodyState
    messages: int


@dataclass(frozen=True)
class Continuity:
    """Whether a topic was recorded without gaps."""

    messages: int
    lost: int  # that were sent, or asked for by `every`, and are not in the bag
    restarts: int  # times at which a publisher began anew
    typical_stride: int  # simulation steps between two messages, median; 0 where they have none
    largest_stride: int
    every: int = 0  # a state of every so many steps was asked for; 0: states as they were published
    not_asked_for: int = 0  # steps between the first and the last message that nobody asked to record


@dataclass(frozen=True)
class StepCommands:
    """What went with one Step request: world.step(n, commands, only=True) repeats it."""

    sim_step: int  # the first step that obeyed the commands
    n: int  # steps run for it
    commands: dict[str, Any]  # full name of each commanded object -> its message, of ambf_msgs


def open(path: str | Path) -> "RecordedBag":  # noqa: A001 - read_bag.open() reads well
    """Opens a complete bag."""
    return RecordedBag(path)


class RecordedBag:
    """A bag, open for reading."""

    def __init__(self, path: str | Path) -> None:
        import rosbag

        self.path = Path(path).expanduser()
        self._clock: npt.NDArray[np.float64] | None = None  # wall and simulation times of one topic's states
        if not self.path.exists():
            raise BagError(f"there is no {self.path}")
        if not self.path.is_file():  # a device may never end
            raise BagError(f"{self.path} is no bag: it is no file")
        try:
            self._bag = rosbag.Bag(str(self.path))
        except rosbag.ROSBagUnindexedException:
            raise BagError(f"{self.path} was never completed: ambf-cli bag repair {self.path}") from None
        except (rosbag.ROSBagException, struct.error, ValueError) as problem:
            raise BagError(f"{self.path} is no bag: {problem}") from None

    def __enter__(self) -> "RecordedBag":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Closes the file."""
        self._bag.close()

    @property
    def topics(self) -> dict[str, Topic]:
        """What is in the bag, by name."""
        found = self._bag.get_type_and_topic_info().topics
        return {name: Topic(name, info.msg_type, info.message_count) for name, info in sorted(found.items())}

    @property
    def start(self) -> float:
        """Time of the first message, s since 1970; NaN in an empty bag."""
        return float(self._bag.get_start_time()) if self._bag.get_message_count() else math.nan

    @property
    def end(self) -> float:
        """Time of the last message, s since 1970; NaN in an empty bag."""
        return float(self._bag.get_end_time()) if self._bag.get_message_count() else math.nan

    def messages(self, *topics: str) -> Iterator[tuple[str, Any, float]]:
        """(topic, message, s since 1970) in order of time; of all topics where none is named."""
        for name in topics:
            self._known(name)
        for name, message, stamp in self._bag.read_messages(list(topics) or None):
            yield name, message, stamp.to_sec()

    def columns(self, topic: str, fields: Iterable[str] | None = None) -> Columns:
        """One array a number or text in the messages, all of one length, beside "time" and "wall".

        time: simulation time, s. Of messages without one (commands) that of the states around them in the bag; NaN
        where it holds no states. wall: wall time, s since the bag's start. fields: only these and what is below them
        ("pose", "pose.position.x", "joint_positions"). Arrays that grow are filled up with NaN.
        """
        wanted = [fields] if isinstance(fields, str) else list(fields) if fields is not None else None
        count = self._known(topic).messages
        wall, times = np.full(count, np.nan), np.full(count, np.nan)
        found: Columns = {}
        row = 0
        for _, message, stamp in self._bag.read_messages([topic]):
            wall[row] = stamp.to_sec()
            times[row] = getattr(message, "sim_time", math.nan)
            for name, value in _flat(message, "", wanted):
                column = found.get(name)
                if column is None:
                    column = found[name] = _empty_column(value, count)
                elif column.dtype != object and isinstance(value, str):
                    column = found[name] = column.astype(object)
                column[row] = value
            row += 1
        if wanted is not None:
            missing = [name for name in wanted if not any(_is_below(column, name) for column in found)]
            if missing and count:
                raise KeyError(f"{topic} has no field {', '.join(missing)}")
        if row and np.isnan(times[:row]).all():
            times = self._simulated(wall)
        clocks = {"time": times[:row], "wall": (wall - self.start)[:row]}
        return clocks | {name: column[:row] for name, column in found.items()}

    def _simulated(self, wall: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        """The simulation time at each of these wall times, from the topic with the most states."""
        states = [topic for topic in self.topics.values() if _has_step(topic.type)]
        if not states:
            return np.full(len(wall), np.nan)
        if self._clock is None:
            name = max(states, key=lambda topic: topic.messages).name
            read = [(stamp.to_sec(), message.sim_time) for _, message, stamp in self._bag.read_messages([name])]
            self._clock = np.array(read).T
        return np.interp(wall, self._clock[0], self._clock[1])

    def array(self, topic: str, fields: Iterable[str]) -> npt.NDArray[np.float64]:
        """The numbers of these fields as one matrix, a row a message, a column a number. Times: see columns()."""
        columns = self.columns(topic, fields)
        del columns["time"], columns["wall"]
        return np.column_stack([np.asarray(column, dtype=np.float64) for column in columns.values()])

    def table(self, topic: str, fields: Iterable[str] | None = None) -> Any:
        """The same as a pandas DataFrame, indexed by "time", the simulation time in s."""
        try:
            import pandas
        except ImportError:
            raise BagError("tables need pandas: pip install pandas, or use columns()") from None
        return pandas.DataFrame(self.columns(topic, fields)).set_index("time")

    def step_commands(self) -> Iterator[StepCommands]:
        """The Step requests that were recorded, in order: what a client that stepped the world sent with its steps.

        Needs ambf_msgs, whose messages world.step() takes.
        """
        from ambf_client._messages import msg

        topics = [topic.name for topic in self.topics.values() if topic.type == "ambf_msgs/StepCommands"]
        if not topics:
            return
        for _, raw, _ in self._bag.read_messages(topics, raw=True):
            if raw[2] != msg.StepCommands._md5sum:
                raise BagError(f"{self.path.name} holds Step requests of another version of ambf_msgs")
            message = msg.StepCommands().deserialize(raw[1])
            kinds = ("rigid_body", "camera", "light", "actuator", "vehicle")
            lists = [(getattr(message, f"{kind}_names"), getattr(message, f"{kind}_cmds")) for kind in kinds]
            commands = {name: command for names, list_ in lists for name, command in zip(names, list_, strict=True)}
            yield StepCommands(message.sim_step, message.n, commands)

    def continuity(self) -> dict[str, Continuity]:
        """Whether anything is missing, for each topic whose messages are numbered (those that begin with a header).

        What was lost is separate from what was not asked for: where every step's states were asked for (Recorder's
        `every`), each step without a message counts as lost; elsewhere only messages that the publisher sent.
        """
        counts: dict[str, _Count] = {}
        before: dict[int, tuple[int, int]] = {}  # connection -> number and step of the last message
        known: set[tuple[str, str]] = set()  # topics and their publishers
        for topic, raw, _, header in self._bag.read_messages(raw=True, return_connection_header=True):
            kind, data, python_type = raw[0], raw[1], raw[4]
            if not getattr(python_type, "_has_header", False) or len(data) < 16:
                continue
            count = counts.setdefault(topic, _Count())
            count.messages += 1
            every = int(header.get(EVERY, 0))
            count.every = count.every or every
            sequence, _, _, frame_length = struct.unpack_from("<4I", data, 0)
            step = struct.unpack_from("<I", data, 16 + frame_length)[0] if _has_step(kind) else -1
            connection = id(header)  # rosbag keeps one for each
            last = before.get(connection)
            before[connection] = (sequence, step)
            if last is None:
                # What was unloaded and is back is published anew: the skipped numbers were sent to no reader here.
                publisher = (topic, str(header.get("callerid", "")))
                count.restarts += publisher in known
                known.add(publisher)
            elif sequence <= last[0]:
                count.restarts += 1
            else:
                count.add(sequence - last[0], step - last[1] if step > last[1] >= 0 else 0, every)
        return {topic: count.result() for topic, count in sorted(counts.items())}

    def _known(self, topic: str) -> Topic:
        topics = self.topics
        if topic not in topics:
            raise KeyError(f"{self.path.name} has no topic {topic}; it has {', '.join(topics) or 'none'}")
        return topics[topic]


class _Count:
    """Of one topic, for continuity()."""

    def __init__(self) -> None:
        self.messages = self.lost = self.restarts = self.every = self.not_asked_for = 0
        self.strides: list[int] = []

    def add(self, numbers: int, steps: int, every: int) -> None:
        """A message that follows one of the same connection. steps: simulated since that; 0: unknown, or none."""
        lost = steps // every - 1 if every and steps >= every else numbers - 1
        self.lost += lost
        if steps:
            self.strides.append(steps)
            self.not_asked_for += max(0, steps - 1 - lost)

    def result(self) -> Continuity:
        strides = self.strides or [0]
        typical = int(np.median(strides))
        return Continuity(
            self.messages, self.lost, self.restarts, typical, max(strides), self.every, self.not_asked_for
        )


def _has_step(kind: str) -> bool:
    # In all of them the step follows the header, but for the world's.
    return kind.startswith("ambf_msgs/") and kind.endswith("State") and kind != "ambf_msgs/WorldState"


def _is_below(name: str, field: str) -> bool:
    return name == field or name.startswith((field + ".", field + "["))


def _is_wanted(name: str, wanted: list[str] | None) -> bool:
    """Whether a field, or something below it, is asked for."""
    return wanted is None or any(_is_below(name, field) or _is_below(field, name) for field in wanted)


def _flat(value: Any, name: str, wanted: list[str] | None) -> Iterator[tuple[str, Any]]:
    if hasattr(value, "to_sec"):  # times and durations, s
        yield name, value.to_sec()
    elif getattr(value, "__slots__", None) == ["data"]:  # std_msgs/String and the like
        yield from _flat(value.data, name, wanted)
    elif hasattr(value, "__slots__"):
        for part in value.__slots__:
            inner = f"{name}.{part}" if name else part
            if _is_wanted(inner, wanted):
                yield from _flat(getattr(value, part), inner, wanted)
    elif isinstance(value, bytes):
        for index, byte in enumerate(value):
            yield f"{name}[{index}]", byte
    elif isinstance(value, list | tuple):
        for index, element in enumerate(value):
            inner = f"{name}[{index}]"
            if _is_wanted(inner, wanted):
                yield from _flat(element, inner, wanted)
    else:
        yield name, value


def _empty_column(value: Any, count: int) -> npt.NDArray[Any]:
    if isinstance(value, str):
        return np.full(count, "", dtype=object)
    return np.full(count, np.nan)
