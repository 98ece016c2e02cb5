"""Reads recordings of inputs (ambf_simulator --record-input) into numpy arrays.

    trial = read_input.read("trial.ambfin")
    left = trial.device("Left")
    plt.plot(left.samples["time"], left.samples["position"])       # the hand in U, m
    plt.plot(left.set_points["time"], left.set_points["position"])  # REF in W, m

Times are in s since the start of the recording. docs/input_recordings.md describes the format. A recording that was cut
off is read up to there. Checksums are not verified: ambf_simulator --replay-input does that.
"""

import struct
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

__all__ = ["Device", "InputError", "InputRecording", "read"]

MAGIC, VERSION = b"AMBFINP\n", 4
SCENE, PHYSICS, FIRST_DEVICE = 0, 1, 2  # streams
SESSION, DEVICE, CHANGE, GAP, END = 1, 2, 3, 4, 5
TAKE, PUBLISHED, SET_POINT, CYCLE = 21, 22, 40, 60
CHANGES = ("world", "load", "unload", "remove", "set parent", "reset parents", "snapshot", "restore", "forget", "start")
REQUESTS = {
    24: "pause", 25: "reset", 26: "parameter", 27: "push", 28: "gravity", 29: "hold", 30: "lens", 31: "beam",
    32: "pick", 42: "command", 48: "command",
}  # fmt: skip
FIRST_DEVICE_SOURCE = 5

_HEAD = struct.Struct("<IHH")
_CYCLE = struct.Struct("<QqQHBB")
_SAMPLE = struct.Struct("<q8dQ2B")
_SET_POINT = struct.Struct("<7d12ddQ3BdQq")
_PUBLISHED = struct.Struct("<QqQIB")
_OBEYED = struct.Struct("<IQIIBq")

Columns = dict[str, npt.NDArray[Any]]


class InputError(RuntimeError):
    """The file is no recording of inputs, or of another version."""


@dataclass
class Device:
    """An input device, and what its cycles saw and posted."""

    name: str
    number: int
    period: float  # s, of its cycles
    cycles: Columns = field(default_factory=dict)  # time, cycle, frame
    samples: Columns = field(default_factory=dict)  # time, stamp, position, orientation, jaw, buttons, ready
    # time, cycle, step (the first one that obeyed it; 0: none), position, orientation, jaw, engaged, pulls, period
    set_points: Columns = field(default_factory=dict)


@dataclass
class InputRecording:
    """A session as it was recorded."""

    path: str
    launch_file: str
    device_file: str
    start: float  # s since 1970
    devices: list[Device]
    frames: Columns  # time, sequence, sim_step, state_hash
    changes: list[tuple[str, str]]  # of the scene: what, and the file or name
    requests: dict[str, int]  # how many of each kind steps obeyed
    problem: str  # what is missing; empty: nothing

    def device(self, name: str) -> Device:
        """The device of this name."""
        for device in self.devices:
            if device.name == name:
                return device
        raise KeyError(f"no device '{name}', but {', '.join(d.name for d in self.devices) or 'none'}")

    @property
    def seconds(self) -> float:
        """From the start to the last frame."""
        return float(self.frames["time"][-1]) if len(self.frames["time"]) else 0.0


class _Bytes:
    """Reads members of a record one after the other."""

    def __init__(self, data: bytes) -> None:
        self.data, self.at = data, 0

    def take(self, form: str) -> Any:
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values if len(values) != 1 else values[0]

    def bytes(self) -> bytes:
        count = self.take("I")
        if count > len(self.data) - self.at:
            raise InputError("a record ends too early")
        self.at += count
        return self.data[self.at - count : self.at]

    def text(self) -> str:
        return self.bytes().decode(errors="replace")


class _DeviceRows:
    """Rows of one device while the file is read."""

    def __init__(self) -> None:
        self.cycles: list[tuple[Any, ...]] = []
        self.samples: list[tuple[Any, ...]] = []
        self.set_points: list[tuple[Any, ...]] = []
        self.obeyed: list[tuple[int, int]] = []  # when the set-point was posted, and the step

    def add(self, data: bytes) -> None:
        cycle, now_ns, frame, _held, _forces, _reading = _CYCLE.unpack_from(data)
        self.cycles.append((now_ns, cycle, frame))
        at = _CYCLE.size + 1
        if data[at - 1]:
            self.samples.append((now_ns, *_SAMPLE.unpack_from(data, at)))
            at += _SAMPLE.size
        at += 4 + struct.unpack_from("<I", data, at)[0]  # why it is not ready
        if data[at]:
            self.set_points.append((now_ns, cycle, *_SET_POINT.unpack_from(data, at + 1)))

    def into(self, device: Device, start_ns: int) -> None:
        cycles = np.array(self.cycles, dtype=np.int64).reshape(-1, 3)
        device.cycles = {
            "time": (cycles[:, 0] - start_ns) / 1e9,
            "cycle": cycles[:, 1],
            "frame": cycles[:, 2],
        }
        rows = self.samples
        device.samples = {
            "time": np.array([(row[0] - start_ns) / 1e9 for row in rows]),
            "stamp": np.array([(row[1] - start_ns) / 1e9 for row in rows]),
            "position": np.array([row[2:5] for row in rows]).reshape(-1, 3),
            "orientation": np.array([row[5:9] for row in rows]).reshape(-1, 4),
            "jaw": np.array([row[9] if row[11] else np.nan for row in rows]),
            "buttons": np.array([row[10] for row in rows], dtype=np.uint64),
            "ready": np.array([bool(row[12]) for row in rows], dtype=bool),
        }
        rows = self.set_points
        device.set_points = {
            "time": np.array([(row[0] - start_ns) / 1e9 for row in rows]),
            "cycle": np.array([row[1] for row in rows], dtype=np.int64),
            "step": self._steps(np.array([row[0] for row in rows], dtype=np.int64)),
            "position": np.array([row[2:5] for row in rows]).reshape(-1, 3),
            "orientation": np.array([row[5:9] for row in rows]).reshape(-1, 4),
            "jaw": np.array([row[26] for row in rows]),
            "engaged": np.array([bool(row[24]) for row in rows], dtype=bool),
            "pulls": np.array([bool(row[23]) for row in rows], dtype=bool),
            "period": np.array([row[21] for row in rows]),
        }

    def _steps(self, times_ns: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
        """Of each set-point: the newest one at the time of posting is the one that was obeyed."""
        steps = np.zeros(len(times_ns), dtype=np.int64)
        for posted_ns, step in self.obeyed:
            place = int(np.searchsorted(times_ns, posted_ns, side="right")) - 1
            if place >= 0 and steps[place] == 0:
                steps[place] = step
        return steps


class _Steps:
    """Which step comes next: known from each frame, counted between two."""

    def __init__(self) -> None:
        self.done = 0
        self.waiting: list[tuple[_DeviceRows, int]] = []

    def take(self, with_step: bool) -> None:
        if not with_step:
            return
        self.done += 1
        for rows, posted_ns in self.waiting:
            rows.obeyed.append((posted_ns, self.done))
        self.waiting.clear()


def read(path: str | Path) -> InputRecording:
    """The whole file."""
    data = Path(path).expanduser().read_bytes()
    if data[: len(MAGIC)] != MAGIC:
        raise InputError(f"'{path}' is no recording of inputs (ambf_simulator --record-input makes them)")
    version = struct.unpack_from("<I", data, len(MAGIC))[0] if len(data) >= len(MAGIC) + 4 else 0
    if version != VERSION:
        raise InputError(f"'{path}' is a recording of version {version}; this program reads version {VERSION}")
    return _Reading(str(path)).read(memoryview(data)[len(MAGIC) + 4 :])


class _Reading:
    """One pass over the records of a file."""

    def __init__(self, path: str) -> None:
        self.out = InputRecording(path, "", "", 0.0, [], {}, [], {}, "")
        self.start_ns = 0
        self.rows: dict[int, _DeviceRows] = {}
        self.frames: list[tuple[int, int, int, int]] = []
        self.steps = _Steps()
        self.requests: Counter[str] = Counter()
        self.session = self.ended = False

    def read(self, data: memoryview) -> InputRecording:
        at = 0
        while len(data) - at >= _HEAD.size + 4:
            size, kind, stream = _HEAD.unpack_from(data, at)
            if size > len(data) - at - _HEAD.size - 4:
                break
            try:
                self.record(kind, stream, bytes(data[at + _HEAD.size : at + _HEAD.size + size]))
            except (struct.error, IndexError) as problem:
                raise InputError(f"'{self.out.path}' is damaged at byte {at}: {problem}") from None
            at += _HEAD.size + size + 4
        if not self.session:
            raise InputError(f"'{self.out.path}' ends before it begins")
        if not self.out.problem and not self.ended:
            self.out.problem = f"it was cut off: {len(data) - at} bytes at its end are no whole record"
        return self.finished()

    def record(self, kind: int, stream: int, data: bytes) -> None:
        if kind == CYCLE:
            self.rows_of(stream - FIRST_DEVICE).add(data)
        elif kind == TAKE:
            self.steps.take(bool(data[8]))
        elif kind == PUBLISHED:
            frame, now_ns, state_hash, step, _throttled = _PUBLISHED.unpack_from(data)
            self.frames.append((now_ns, frame, step, state_hash))
            self.steps.done = step
        elif kind == SET_POINT:
            _slot, _hold, _index, _generation, source, posted_ns = _OBEYED.unpack_from(data)
            self.steps.waiting.append((self.rows_of(source - FIRST_DEVICE_SOURCE), posted_ns))
        elif kind in REQUESTS:
            self.requests[REQUESTS[kind]] += 1
        elif kind == SESSION:
            self.read_session(_Bytes(data))
        elif kind == DEVICE:
            self.read_device(_Bytes(data))
        elif kind == CHANGE:
            self.read_change(_Bytes(data))
        elif kind == GAP:
            self.out.problem = "it has a gap: records that found no room"
        elif kind == END:
            self.ended = True

    def rows_of(self, number: int) -> _DeviceRows:
        return self.rows.setdefault(number, _DeviceRows())

    def read_session(self, data: _Bytes) -> None:
        self.out.launch_file = data.text()
        data.text(), data.text()  # namespace, solver
        self.out.device_file = data.text()
        data.bytes()  # the device file itself
        for _ in range(data.take("I")):
            data.take("i")  # -l
        for _ in range(data.take("I")):
            data.bytes()  # -a
        data.take("3i3Bd")
        self.start_ns, system_ns = data.take("2q")
        self.out.start = system_ns / 1e9
        self.session = True

    def read_device(self, data: _Bytes) -> None:
        number, name, period = data.take("H"), data.text(), data.take("d")
        self.out.devices.append(Device(name, number, period))

    def read_change(self, data: _Bytes) -> None:
        kind = data.take("B")
        path, _text, _prefix, name = data.text(), data.bytes(), data.text(), data.text()
        self.out.changes.append((CHANGES[kind] if kind < len(CHANGES) else str(kind), path or name))

    def finished(self) -> InputRecording:
        frames = self.frames
        self.out.frames = {
            "time": np.array([(row[0] - self.start_ns) / 1e9 for row in frames]),
            "sequence": np.array([row[1] for row in frames], dtype=np.int64),
            "sim_step": np.array([row[2] for row in frames], dtype=np.int64),
            "state_hash": np.array([row[3] for row in frames], dtype=np.uint64),
        }
        for device in self.out.devices:
            self.rows_of(device.number).into(device, self.start_ns)
        self.out.requests = dict(self.requests)
        return self.out
