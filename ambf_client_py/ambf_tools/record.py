"""Records topics into bag files, without losing a message.

    with Recorder("trial.bag", ["/ambf/env/psm/*/State"], every=1) as recorder:
        recorder.ready()
        ...
    print(recorder.status.messages, recorder.status.lost, recorder.status.missing)

The recording runs in a process of its own, so that a busy script cannot hold it up. A bag is written as
NAME.bag.active and gets its name when it is complete; whatever kills the recording process, repair() makes a complete
bag of what is there. A message's time in the bag is the stamp of its header (when the simulator completed that step)
where it has one, else the time at which it was received.
"""

import contextlib
import datetime
import json
import math
import os
import re
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import Any

from ambf_tools.recording.disk_space import free_bytes, readable_bytes
from ambf_tools.recording.topic_sources import is_pattern, matches

__all__ = ["Recorder", "RecordingError", "Status", "bag_name", "free_bytes", "readable_bytes", "repair"]

GIBIBYTE = 1 << 30
STEP_COMMANDS = "*/World/StepCommands"
_START_TIMEOUT = 20.0  # s
_STOP_TIMEOUT = 120.0  # s: a slow disk has to take what waits


class RecordingError(RuntimeError):
    """A recording could not be started, or died."""


@dataclass(frozen=True)
class Status:
    """How a recording fares."""

    running: bool = False
    seconds: float = 0.0  # since the start
    messages: int = 0
    lost: int = 0  # messages that publishers sent and that did not arrive, by their sequence numbers
    bytes: int = 0  # on disk
    free_bytes: int = 0
    connections: int = 0  # publishers that are listened to
    master: bool = False  # whether the ROS master answers
    topics: dict[str, tuple[int, int]] = field(default_factory=dict)  # topic -> (messages, lost)
    failures: dict[str, str] = field(default_factory=dict)  # topic -> why its publisher cannot be reached
    missing: tuple[str, ...] = ()  # names and patterns that were asked for and of which nothing has come
    reason: str = ""  # why it ended
    complete: bool = False  # the bag is whole and has its name
    cut_short: bool = False  # the disk ended it: what came afterwards is in no bag


def bag_name(subject: str, study: str, date: datetime.datetime | None = None) -> str:
    """SUBJECT_STUDY_2026-11-21-15-04-05.bag; what file names should not hold becomes a dash."""
    parts = [re.sub(r"[^\w.+-]+", "-", part.strip(), flags=re.UNICODE).strip("-.") for part in (subject, study)]
    if not all(parts):
        raise ValueError("subject and study must have a name")
    stamp = (date or datetime.datetime.now()).strftime("%Y-%m-%d-%H-%M-%S")
    return "_".join([*parts, stamp]) + ".bag"


def unused(path: Path) -> Path:
    """The path, with a number where a bag of that name exists, complete or not."""
    number, candidate = 1, path
    while candidate.exists() or candidate.with_name(candidate.name + ".active").exists():
        number += 1
        candidate = path.with_name(f"{path.stem}_{number}{path.suffix}")
    return candidate


class Recorder:
    """One recording. Start and stop it once; make another for the next.

    path: the bag; a number is added where it exists already. See also bag_name().
    topics: full names, waited for when they have no publisher yet; shell patterns ("/ambf/env/*/State") and regular
        expressions after "re:", whose new topics join in.
    patterns: more of them.
    every: 1 records every step's states, and with them the commands that travel with Step requests; n: those of steps
        whose number is a multiple of n. 0: states as they are published, at their rates.
    strict: stop(), or the end of the with block, raises RecordingError when nothing came of something that was asked
        for, or when messages were lost.
    min_free_bytes: recording does not start with less space, and ends by itself when less is left.
    duration: seconds after which it ends by itself; 0: never.
    report_missing: whether what never came is reported on standard error at the end; Status.missing has it anyway.
    on_end: called, from a thread, with the last Status when it ended, for whatever reason.
    """

    def __init__(
        self,
        path: str | Path,
        topics: Iterable[str] = (),
        patterns: Iterable[str] = (),
        *,
        every: int = 0,
        strict: bool = False,
        min_free_bytes: int = GIBIBYTE,
        duration: float = 0.0,
        on_end: Callable[[Status], None] | None = None,
        report_missing: bool = True,
    ) -> None:
        path = Path(path).expanduser().absolute()
        self.path = unused(path if path.suffix == ".bag" else path.with_name(path.name + ".bag"))
        self.status = Status()
        self._strict = strict
        self._asked = [*_names(topics), *_names(patterns)]
        for name in self._asked:
            _check_name(name)
        if not self._asked:
            raise ValueError("nothing to record: name topics or patterns")
        if not (math.isfinite(duration) and duration >= 0.0):
            raise ValueError(f"the duration must be a number of seconds from 0, not {duration}")
        if not isinstance(every, int) or not 0 <= every < 1 << 32:
            raise ValueError(f"every must be a number of steps, or 0 for states as they are published, not {every!r}")
        self._settings: dict[str, Any] = {
            "topics": [name for name in self._asked if not is_pattern(name)],
            "patterns": [name for name in self._asked if is_pattern(name)] + ([STEP_COMMANDS] if every else []),
            "min_free_bytes": min_free_bytes,
            "duration": duration,
            "every": every,
        }
        self._judged = False
        self._report_missing = report_missing
        self._on_end = on_end
        self._process: subprocess.Popen[str] | None = None
        self._finished = threading.Event()  # not a join: one that Ctrl-C interrupts may take the thread for ended
        self._changed = threading.Condition()
        self._messages_of_process: list[str] = []

    @property
    def pid(self) -> int:
        """The recording process; 0 when there is none."""
        return self._process.pid if self._process and self._process.poll() is None else 0

    def start(self) -> "Recorder":
        """Starts; returns when the bag is open. Topics are connected within half a second after that: see ready()."""
        if self._process is not None:
            raise RecordingError("a recorder starts once; make another")
        self.path.parent.mkdir(parents=True, exist_ok=True)
        free, needed = free_bytes(self.path.parent), self._settings["min_free_bytes"]
        if free < needed:
            raise RecordingError(
                f"{self.path.parent} has {readable_bytes(free)} free, less than the {readable_bytes(needed)} asked for"
            )
        environment = dict(os.environ)
        package_root = str(Path(__file__).resolve().parents[1])
        environment["PYTHONPATH"] = os.pathsep.join(p for p in (package_root, os.environ.get("PYTHONPATH")) if p)
        self._process = subprocess.Popen(
            [
                sys.executable,
                "-m",
                "ambf_tools.recording.engine",
                json.dumps({"path": str(self.path), **self._settings}),
            ],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=environment,
            start_new_session=True,  # Ctrl-C goes to our parent, which then stops the recording
        )
        threading.Thread(target=self._follow, daemon=True).start()
        threading.Thread(target=self._collect_errors, daemon=True).start()
        if not self._wait(lambda status: status.running or bool(status.reason), _START_TIMEOUT):
            self._process.kill()
            raise RecordingError("the recording process did not start in time")
        if not self.status.running and not self.status.complete:
            raise RecordingError(f"{self.path}: {self.status.reason}")
        return self

    def ready(self, connections: int = 1, timeout: float = 10.0) -> bool:
        """Waits until that many publishers are listened to."""
        return self._wait(lambda status: status.connections >= connections, timeout)

    def wait(self, timeout: float | None = None) -> bool:
        """Waits until the recording ended by itself. False when it did not in time."""
        return self._process is None or self._finished.wait(timeout)

    def stop(self) -> Status:
        """Ends the recording; returns when the bag is complete. Harmless when it ended already."""
        if self._process is not None:
            if self._process.stdin is not None:
                with contextlib.suppress(OSError):
                    self._process.stdin.close()
            if not self.wait(_STOP_TIMEOUT):
                self._process.kill()
                self.wait(_STOP_TIMEOUT)
        self._judge()
        return self.status

    def _judge(self) -> None:
        """Reports once, at the end, what never came."""
        if self._judged or self._process is None:
            return
        self._judged = True
        missing = f"nothing came of {', '.join(self.status.missing)}" if self.status.missing else ""
        lost = f"{self.status.lost} messages were lost" if self.status.lost else ""
        if self._strict and (missing or lost):
            raise RecordingError(f"{self.path}: {'; '.join(filter(None, (missing, lost)))}")
        if missing and self._report_missing:
            print(f"[ambf_tools] {self.path}: {missing}", file=sys.stderr, flush=True)

    def __enter__(self) -> "Recorder":
        return self.start()

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._strict = self._strict and kind is None  # what ended the block counts more
        self.stop()

    def _wait(self, condition: Callable[[Status], bool], timeout: float) -> bool:
        with self._changed:
            return self._changed.wait_for(
                lambda: condition(self.status) or (self._ended() and not self.status.running), timeout
            ) and condition(self.status)

    def _ended(self) -> bool:
        return self._process is not None and self._process.poll() is not None and bool(self.status.reason)

    def _follow(self) -> None:
        assert self._process is not None and self._process.stdout is not None
        for line in self._process.stdout:
            with contextlib.suppress(json.JSONDecodeError):
                self._take(json.loads(line))
        self._process.wait()
        with self._changed:
            if not self.status.reason:
                time.sleep(0.05)  # its last words
                words = self._messages_of_process[-1].strip() if self._messages_of_process else ""
                code = self._process.returncode
                how = f"signal {-code}" if code < 0 else (words or f"exit code {code}")
                self._set(running=False, reason=f"the recording process died ({how}); repair() the bag")
            self._changed.notify_all()
        self._finished.set()
        if self._on_end is not None:
            self._on_end(self.status)

    def _collect_errors(self) -> None:
        assert self._process is not None and self._process.stderr is not None
        for line in self._process.stderr:
            self._messages_of_process.append(line)
            del self._messages_of_process[:-50]

    def _take(self, line: dict[str, Any]) -> None:
        names = ("seconds", "messages", "lost", "bytes", "free_bytes", "connections", "master", "failures")
        values = {name: line[name] for name in names}
        values["topics"] = {topic: (counts[0], counts[1]) for topic, counts in line["topics"].items()}
        came = [topic for topic, (count, _) in values["topics"].items() if count]
        values["missing"] = tuple(
            name for name in self._asked if not any(matches(topic, [name], [name]) for topic in came)
        )
        values["running"] = line["event"] != "stopped"
        if line["event"] == "stopped":
            values["complete"], values["cut_short"] = line["complete"], line["cut_short"]
            values["reason"] = "; ".join(part for part in (line["reason"], line["note"]) if part)
        with self._changed:
            self._set(**values)
            self._changed.notify_all()

    def _set(self, **values: Any) -> None:
        self.status = Status(**{**self.status.__dict__, **values})


def _check_name(name: str) -> None:
    if name.startswith("re:"):
        try:
            re.compile(name[3:])
        except re.error as problem:
            raise ValueError(f"'{name}' is no regular expression: {problem}") from None
    elif not is_pattern(name) and not re.fullmatch(r"(/[A-Za-z_]\w*)+", name, flags=re.ASCII):
        raise ValueError(f"'{name}' can be no topic: full names begin with / and hold letters, digits, _ and /")


def _names(values: Iterable[str]) -> list[str]:
    return [values] if isinstance(values, str) else list(values)


def repair(path: str | Path, on_progress: Callable[[int, int], None] | None = None) -> Path:
    """Makes a complete bag of one whose recording was killed. May be repeated when it was itself cut short.

    path: NAME.bag.active, or NAME.bag. on_progress: called with bytes done and bytes in all. Returns the complete bag.
    Needs rosbag (Debian: python3-rosbag).
    """
    import rosbag

    path = Path(path).expanduser().absolute()
    if not path.exists() and path.with_name(path.name + ".active").exists():
        path = path.with_name(path.name + ".active")
    size = path.stat().st_size
    with rosbag.Bag(str(path), "a", allow_unindexed=True) as bag:
        for position in bag.reindex():
            if on_progress is not None:
                on_progress(position, size)
    if path.suffix != ".active":
        return path
    target = path.with_suffix("")
    number = 1
    while target.exists():
        number += 1
        target = path.with_name(f"{path.with_suffix('').stem}_{number}.bag")
    return path.rename(target)
