"""Measures how old states are when a Python program gets them, and how long a command takes to show (dissertation
§3.10).

Probes are loaded into the running simulation, far away and touching nothing, and unloaded afterwards: static bodies,
which reach their commanded pose in the next step. So it can be measured in any scene, and says what that scene's
programs get. One way: from the completion of a simulation step (the stamp in the state's header) to the callback in
Python. Round trip: from publishing a command in Python to the callback with the first state that shows it.
"""

import argparse
import contextlib
import random
import signal
import struct
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ambf_tools.progress import bar

if TYPE_CHECKING:
    from ambf_tools.cli.output import Output
    from ambf_tools.cli.simulation import Simulation

__all__ = ["Measurement", "draw", "measure"]

NONE = float("nan")  # nothing was measured

Times = npt.NDArray[np.float64]  # s

_PROBE = """\
BODY Probe{0}:
  name: Probe{0}
  mass: 0.0
  location: {{position: {{x: 0.0, y: {1}, z: 1000.0}}, orientation: {{r: 0.0, p: 0.0, y: 0.0}}}}
  shape: BOX
  geometry: {{x: 0.01, y: 0.01, z: 0.01}}
"""
_SETTLE = 0.7  # s: connections, and the change to the higher rate
_SILENCE = 0.7  # s: longer than the watchdog, so that the simulator publishes at its lower rate again
_SILENT_TRIES = 8


@dataclass
class Measurement:
    """Latencies of one setting, in seconds."""

    objects: int
    queue: int  # of the subscribers
    rate: float  # states a second and object that arrived
    one_way: Times = field(default_factory=lambda: np.zeros(0))
    round_trip: Times = field(default_factory=lambda: np.zeros(0))
    after_silence: Times = field(default_factory=lambda: np.zeros(0))  # round trips of first commands

    def summary(self) -> dict[str, float]:
        """Percentiles in milliseconds."""
        found: dict[str, float] = {"objects": self.objects, "queue": self.queue, "states_per_second": self.rate}
        for name, values in (("one_way", self.one_way), ("round_trip", self.round_trip)):
            for text, share in (("p50", 50), ("p99", 99), ("max", 100)):
                found[f"{name}_{text}_ms"] = float(np.percentile(values, share)) * 1e3 if len(values) else NONE
        found["after_silence_ms"] = float(np.median(self.after_silence)) * 1e3 if len(self.after_silence) else NONE
        return found


class _Probe:
    """One body: commands go out with a number as its x, states come in with it."""

    def __init__(self, topic: str, queue: int) -> None:
        import rospy
        from ambf_client._messages import msg

        self.ages: list[float] = []
        self.trips: list[float] = []
        self.recording = False
        self.answered = threading.Event()
        self._position_at = 0
        self._sent: dict[float, int] = {}
        self._last = 0.0
        self._command = msg.RigidBodyCmd(cartesian_cmd_type=msg.RigidBodyCmd.TYPE_POSITION)
        self._command.pose.position.z = 1000.0
        self._command.pose.orientation.w = 1.0
        self.talk = rospy.Publisher(topic + "/Command", msg.RigidBodyCmd, queue_size=queue, tcp_nodelay=True)
        self._hear = rospy.Subscriber(
            topic + "/State", rospy.AnyMsg, self._on_state, queue_size=queue, tcp_nodelay=True
        )

    def send(self, value: float) -> None:
        """Commands x = value."""
        self._command.pose.position.x = value
        self.answered.clear()
        self._sent[value] = time.time_ns()
        self.talk.publish(self._command)

    def close(self) -> None:
        """Closes the topics."""
        self._hear.unregister()
        self.talk.unregister()

    def _on_state(self, message: Any) -> None:
        now = time.time_ns()
        data = message._buff
        seconds, nanoseconds = struct.unpack_from("<II", data, 4)
        if self.recording:
            self.ages.append((now - seconds * 1_000_000_000 - nanoseconds) * 1e-9)
        (x,) = struct.unpack_from("<d", data, self._position_at or self._find_position(data))
        if x != self._last:
            self._last = x
            sent = self._sent.pop(x, None)
            if sent is not None:
                if self.recording:
                    self.trips.append((now - sent) * 1e-9)
                self.answered.set()

    def _find_position(self, data: bytes) -> int:
        # header, sim_step, identifier and name, wall_time, sim_time, mass, pInertia, pose: only strings vary in length.
        at = 12
        for skip in (4, 0, 0):  # behind frame_id: sim_step
            at += 4 + struct.unpack_from("<I", data, at)[0] + skip
        self._position_at = at + 3 * 4 + 3 * 8
        return self._position_at


@contextlib.contextmanager
def _probes(simulation: "Simulation", count: int, queue: int) -> Iterator[list[_Probe]]:
    blocks = "".join(_PROBE.format(n, 0.1 * n) for n in range(count))
    names = ", ".join(f"BODY Probe{n}" for n in range(count))
    text = f"adf version: 1.0\nnamespace: /ambf/latency/\nbodies: [{names}]\n{blocks}"
    loaded = simulation.services.load(text=text)
    probes: list[_Probe] = []
    try:
        topics = {each.name: each.topic for each in simulation.services.list(loaded.model).objects}
        probes += [_Probe(topics[name], queue) for name in loaded.objects]
        deadline = time.monotonic() + 10.0
        while any(probe.talk.get_num_connections() == 0 for probe in probes) and time.monotonic() < deadline:
            time.sleep(0.01)
        yield probes
    finally:
        for probe in probes:
            probe.close()
        simulation.services.unload(loaded.model)


def measure(simulation: "Simulation", objects: int, queue: int, rate: float, seconds: float) -> Measurement:
    """Commands `objects` probes in turns, `rate` commands a second in all, and times what comes back.

    queue: of the subscribers and publishers in Python.
    """
    with _probes(simulation, objects, queue) as probes:
        _send(probes, rate, _SETTLE)
        for probe in probes:
            probe.recording = True
        began = time.monotonic()
        _send(probes, rate, seconds)
        elapsed = time.monotonic() - began
        for probe in probes:
            probe.recording = False
        ages = np.array([age for probe in probes for age in probe.ages])
        trips = np.array([trip for probe in probes for trip in probe.trips])
        silent = [trip for trip in (_after_silence(probes[0]) for _ in range(_SILENT_TRIES)) if trip is not None]
        return Measurement(objects, queue, len(ages) / elapsed / objects, ages, trips, np.array(silent))


def _send(probes: list[_Probe], rate: float, seconds: float) -> None:
    begin = due = time.monotonic()
    number = 0
    while due - begin < seconds:
        number += 1
        probes[number % len(probes)].send(time.monotonic())  # any number that was not sent before
        # Not in step with the simulation: all phases of its 1 ms turn are met alike.
        due = max(due + random.uniform(0.5, 1.5) / rate, time.monotonic() - 0.01)
        time.sleep(max(0.0, due - time.monotonic()))
    time.sleep(0.1)


def _after_silence(probe: _Probe) -> float | None:
    time.sleep(_SILENCE)
    probe.trips.clear()
    probe.recording = True
    probe.send(time.monotonic())
    probe.answered.wait(1.0)
    probe.recording = False
    return probe.trips[0] if probe.trips else None


def draw(measurements: list[Measurement], path: str | Path) -> None:
    """Histograms as a picture: a row a number of objects, a column a direction, a colour a queue size."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    counts = sorted({each.objects for each in measurements})
    figure, axes = pyplot.subplots(len(counts), 2, figsize=(11, 2.6 * len(counts) + 0.8), squeeze=False)
    colors = ("#2a6fbb", "#e07b39", "#4b9e5f", "#8a63b8")
    for row, count in zip(axes, counts, strict=True):
        for axis, (title, name) in zip(row, (("one way", "one_way"), ("round trip", "round_trip")), strict=True):
            chosen = [each for each in measurements if each.objects == count]
            everything = np.concatenate([getattr(each, name) for each in chosen]) * 1e3
            if not len(everything):
                continue
            top = max(1e-3, float(np.percentile(everything, 99.5)))
            bins = np.linspace(0.0, top, 80)
            for color, each in zip(colors, chosen, strict=False):
                values = getattr(each, name) * 1e3
                if not len(values):
                    continue
                p50, p99 = np.percentile(values, (50, 99))
                label = f"queue {each.queue}: p50 {p50:.2f}, p99 {p99:.2f} ms"
                axis.hist(np.clip(values, 0, top), bins, histtype="stepfilled", alpha=0.45, color=color, label=label)
                axis.axvline(p50, color=color, linewidth=1.2)
                axis.axvline(min(p99, top), color=color, linewidth=1.0, linestyle=":")
            axis.set_title(f"{title}, {count} object{'s' if count > 1 else ''}", fontsize=10)
            axis.set_yscale("log")
            axis.set_xlim(0.0, top)
            axis.set_xlabel("ms", fontsize=9)
            axis.set_ylabel("messages", fontsize=9)
            axis.grid(alpha=0.25)
            axis.legend(fontsize=8, loc="upper right", framealpha=0.9)
    figure.suptitle("Latency between the simulator and Python (solid: median, dotted: 99 %)", fontsize=12)
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    pyplot.close(figure)


def latency_command(options: argparse.Namespace, output: "Output") -> None:
    """ambf-cli latency"""
    from ambf_tools.cli.output import number, table
    from ambf_tools.cli.simulation import Simulation

    simulation = Simulation(options.ns)
    settings = [(count, queue) for count in options.objects for queue in options.queues]
    measurements = []
    for end in (signal.SIGTERM, signal.SIGHUP):  # these, too, shall leave no probes behind
        if signal.getsignal(end) is signal.SIG_DFL:
            signal.signal(end, signal.default_int_handler)
    with bar(len(settings), not output.as_json, unit="setting") as progress:
        for count, queue in settings:
            measurements.append(measure(simulation, count, queue, options.rate, options.seconds))
            progress.update(1)
    rows = []
    for each in measurements:
        s = each.summary()
        triple = (" / ".join(number(s[f"{name}_{p}_ms"], 2) for p in ("p50", "p99", "max")) for name in _DIRECTIONS)
        rows.append((each.objects, each.queue, f"{each.rate:.0f}", *triple, number(s["after_silence_ms"], 2)))
    head = ["objects", "queue", "states/s", "one way p50/p99/max ms", "round trip p50/p99/max ms", "after silence ms"]
    lines = table(head, rows)
    if options.png:
        try:
            draw(measurements, options.png)
            lines.append(f"histograms: {options.png}")
        except ImportError:
            lines.append("no histograms: they need matplotlib (pip install matplotlib)")
    output.result([each.summary() for each in measurements], lines)


_DIRECTIONS = ("one_way", "round_trip")
