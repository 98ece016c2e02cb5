"""Data sets from bags: streams of several rates brought to one, with the actions that people or programs commanded."""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ambf_tools import read_bag

from .episodes import ACTION, DONE, REWARD, STATE, SUCCESS, Dataset, DatasetError, Episode

_STEP = "observation.sim_step"
_SLACK = 1e-4  # s: messages carry the simulated time in 32 bits


@dataclass(frozen=True)
class Stream:
    """Numbers of one topic. fields: parts of its messages, e.g. "pose.position" or "joint_positions"."""

    topic: str
    fields: tuple[str, ...]

    @classmethod
    def of(cls, words: str) -> Stream:
        """From "TOPIC:FIELD,FIELD"."""
        topic, colon, fields = words.partition(":")
        if not colon or not all((topic, *fields.split(","))):
            raise DatasetError(f"'{words}': TOPIC:FIELD,.. is wanted, e.g. /ambf/env/arm/base/State:joint_positions")
        return cls(topic, tuple(fields.split(",")))


@dataclass
class _Rows:
    """What a stream has: times, s of simulated time and s since the bag's start, and a row of values each."""

    time: NDArray[np.float64]
    wall: NDArray[np.float64]
    values: Any  # an array, or pictures that are not read yet
    names: list[str]

    def restarts(self) -> NDArray[np.float64]:
        """When its time fell, as it does where the world is reset; s since the bag's start."""
        return self.wall[1:][np.diff(self.time) < 0]

    def parts(self, restarts: NDArray[np.float64]) -> list[_Rows]:
        """Those between the restarts of the world's clock: in each the longest stretch in which time does not fall.

        The streams of a bag notice a restart one after another, each by its own time.
        """
        own = self.restarts()
        cuts = np.searchsorted(self.wall, own if len(own) == len(restarts) else restarts)
        found = []
        for rows in np.split(np.arange(len(self.time)), cuts):
            chosen = max(np.split(rows, np.flatnonzero(np.diff(self.time[rows]) < 0) + 1), key=len)
            values = self.values[chosen] if isinstance(self.values, np.ndarray) else [self.values[i] for i in chosen]
            found.append(_Rows(self.time[chosen], self.wall[chosen], values, self.names))
        return found


def from_bags(
    bags: Iterable[str | Path],
    fps: int,
    state: Sequence[Stream],
    action: Sequence[Stream],
    pictures: Mapping[str, str] | None = None,
    verdict: str | None = None,
    success: bool | None = None,
    task: str = "",
    robot: str = "",
) -> Dataset:
    """An episode a bag, or several where its world was reset in between. Raises DatasetError.

    fps: rows a second of simulated time. state, action: streams that are put behind each other, in their own units;
    pictures: topics of rgb8 or JPEG pictures by the last part of their column's name. A row at time t holds the last
    state and picture up to t and the last command before t + 1 / fps. verdict: topic of a task's State, which says the
    success; without it, success says it for all rows. The reward is 0 with success and -1 without. What is too short
    for a row is no episode: Dataset.left_out says so.
    """
    if (verdict is None) == (success is None):
        raise DatasetError("either the topic of a verdict or a success for all episodes is wanted")
    if not state or not action or fps < 1:
        raise DatasetError("at least one stream of states, one of actions and a rate above 0 are wanted")
    paths = [Path(each) for each in bags]
    streams = [f"{each.topic}:{','.join(each.fields)}" for each in (*state, *action)]
    options: dict[str, Any] = {"bags": [each.name for each in paths], "streams": streams}
    made = Dataset(fps, task or "a recording", robot, "", options)
    for path in paths:
        try:
            with read_bag.open(path) as bag:
                _add(made, bag, state, action, dict(pictures or {}), verdict, bool(success))
        except read_bag.BagError as problem:
            raise DatasetError(str(problem)) from None
    return made


def _add(
    made: Dataset,
    bag: read_bag.RecordedBag,
    state: Sequence[Stream],
    action: Sequence[Stream],
    pictures: dict[str, str],
    verdict: str | None,
    success: bool,
) -> None:
    states = [_numbers(bag, each) for each in state]
    actions = [_numbers(bag, each) for each in action]
    steps = _numbers(bag, Stream(state[0].topic, ("sim_step",)))
    films = {name: _pictures(bag, topic, state[0].topic) for name, topic in pictures.items()}
    judged = _numbers(bag, Stream(verdict, ("success",))) if verdict else None
    names = {
        column: [name for each in rows for name in each.names] for column, rows in ((STATE, states), (ACTION, actions))
    }
    if made.episodes and names != made.names:
        raise DatasetError(f"{bag.path} has {names}, and the bags before it {made.names}")
    made.names = names
    before = len(made.episodes)
    # A reset sets the simulated time back: an episode ends there.
    restarts = states[0].restarts()
    observed, commanded = ([each.parts(restarts) for each in rows] for rows in (states, actions))
    stepped, shown = steps.parts(restarts), {name: each.parts(restarts) for name, each in films.items()}
    verdicts = judged.parts(restarts) if judged else None
    for number in range(len(restarts) + 1):
        episode = _episode(
            made.fps,
            [each[number] for each in observed],
            [each[number] for each in commanded],
            stepped[number],
            {name: each[number] for name, each in shown.items()},
            verdicts[number] if verdicts else None,
            success,
        )
        if episode is None:
            why = "has no time at which there are all streams, for a row"
            made.left_out.append(f"{bag.path.name}: part {number} {why}")
        else:
            made.episodes.append(episode)
    if len(made.episodes) == before:
        raise DatasetError(f"{bag.path} has no time at which there are all streams, for at least one row")


def _episode(
    fps: int,
    states: list[_Rows],
    actions: list[_Rows],
    steps: _Rows,
    films: dict[str, _Rows],
    judged: _Rows | None,
    success: bool,
) -> Episode | None:
    observed = [*states, steps, *films.values(), *([judged] if judged else [])]
    if not all(len(each.time) for each in (*observed, *actions)):
        return None
    start = max(each.time[0] for each in (*observed, *actions))
    end = min(each.time[-1] for each in observed)
    count = int((end - start + _SLACK) * fps)  # rows whose next one is there, too
    if count < 1:
        return None
    times = start + np.arange(count + 1) / fps

    def last(rows: _Rows, when: NDArray[np.float64]) -> NDArray[np.int64]:
        return np.maximum(np.searchsorted(rows.time, when + _SLACK, side="right") - 1, 0)

    columns: dict[str, NDArray[Any]] = {
        STATE: np.hstack([each.values[last(each, times[:-1])] for each in states]).astype(np.float32),
        ACTION: np.hstack([each.values[last(each, times[1:] - 2 * _SLACK)] for each in actions]).astype(np.float32),
        _STEP: steps.values[last(steps, times[:-1]), 0].astype(np.int64),
    }
    for name, film in films.items():
        shown = [film.values[index] for index in last(film, times[:-1])]
        columns[f"observation.images.{name}"] = np.array([_decoded(each) for each in shown])
    done = judged.values[last(judged, times[1:]), 0] > 0 if judged else np.full(count, success)
    columns |= {REWARD: np.where(done, 0, -1).astype(np.float32), SUCCESS: np.asarray(done, np.bool_)}
    columns[DONE] = np.arange(count) == count - 1
    return Episode(columns)


def _numbers(bag: read_bag.RecordedBag, stream: Stream) -> _Rows:
    try:
        columns = bag.columns(stream.topic, stream.fields)
    except KeyError as problem:
        raise DatasetError(str(problem.args[0])) from None
    time, wall = columns.pop("time"), columns.pop("wall")
    for name, column in columns.items():
        if column.dtype == object:
            raise DatasetError(f"{stream.topic}: '{name}' is no number")
        bad = np.flatnonzero(~np.isfinite(column))
        if len(bad):
            raise DatasetError(f"{stream.topic}: '{name}' is no number in message {bad[0]}")
    if len(time) and not np.isfinite(time).all():
        raise DatasetError(f"{bag.path} has no states that say the simulated time of {stream.topic}")
    values = np.column_stack(list(columns.values())) if columns else np.zeros((len(time), 0))
    short = stream.topic.removeprefix("/ambf/env/").removesuffix("/State").removesuffix("/Command")
    return _Rows(time, wall, values, [f"{short}.{name}" for name in columns])


def _pictures(bag: read_bag.RecordedBag, topic: str, clock: str) -> _Rows:
    """With the times of the states that have their stamps: when it arrived says little of when it was taken."""
    if topic not in bag.topics:
        raise DatasetError(f"{bag.path.name} has no topic {topic}; it has {', '.join(bag.topics)}")
    states = bag.columns(clock, ["header.stamp"])
    messages = [message for _, message, _ in bag.messages(topic)]
    stamps = [message.header.stamp.to_sec() for message in messages]
    time, wall = (
        np.interp(stamps, states["header.stamp"], states[of]) if messages and len(states[of]) else np.zeros(0)
        for of in ("time", "wall")
    )
    return _Rows(time, wall, messages[: len(time)], [])


def _decoded(message: Any) -> NDArray[np.uint8]:
    """A picture (height, width, 3) of sensor_msgs/Image or sensor_msgs/CompressedImage."""
    if hasattr(message, "format"):
        try:
            from PIL import Image
        except ImportError:
            raise DatasetError("compressed pictures need PIL: pip install pillow") from None
        return np.array(Image.open(io.BytesIO(message.data)).convert("RGB"))
    if message.encoding not in ("rgb8", "bgr8"):
        raise DatasetError(f"pictures of the encoding {message.encoding}: rgb8, bgr8 or JPEG are wanted")
    rows = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, : 3 * message.width]
    picture = rows.reshape(message.height, message.width, 3)
    return picture if message.encoding == "rgb8" else picture[..., ::-1]
