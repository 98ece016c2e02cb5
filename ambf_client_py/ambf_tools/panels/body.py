"""The panel of bodies: pose, velocity or force of one object, with a plot."""

import math
import time
import tkinter as tk
from collections.abc import Callable
from tkinter import ttk
from typing import Any

from ambf_tools.panels.plot import LivePlot
from ambf_tools.panels.value_row import OFF, Mode, ValueRow

_REACH, _SPEED, _TURN_RATE, _FORCE, _TORQUE = 2.0, 0.5, 2.0, 20.0, 2.0  # m, m/s, rad/s, N, N m
_NAMES = ("x", "y", "z", "roll", "pitch", "yaw")
_HOW = {
    OFF: "Left alone.",
    "pose": "Held at a pose by its controller; static bodies go there at once. Position in m, angles in rad.",
    "velocity": "Moved at a velocity, world axes, m/s and rad/s.",
    "force": "Pushed at its centre of mass, world axes, N and N m. What is measured of it are positions.",
}


def _modes(turning: bool) -> list[Mode]:
    reach, speed, force = (math.pi, _TURN_RATE, _TORQUE) if turning else (_REACH, _SPEED, _FORCE)
    return [
        Mode("pose", "rad" if turning else "m", -reach, reach),
        Mode("velocity", "rad/s" if turning else "m/s", -speed, speed),
        Mode("force", "N m" if turning else "N", -force, force),
    ]


class BodyTab(ttk.Frame):
    """Commands one object at a time. get_handle(name) gives its handle."""

    def __init__(self, parent: tk.Misc, names: list[str], get_handle: Callable[[str], Any]) -> None:
        super().__init__(parent, padding=12)
        self.handle: Any = None
        self.mode = OFF
        self._names, self._get_handle = names, get_handle
        bar = ttk.Frame(self)
        bar.pack(fill="x")
        ttk.Label(bar, text="Object").pack(side="left")
        self.choice = ttk.Combobox(bar, values=names, width=48)
        self.choice.pack(side="left", padx=8)
        self.choice.bind("<<ComboboxSelected>>", lambda _: self.choose(self.choice.get()))
        self.choice.bind("<Return>", lambda _: self._on_typed())
        self.choice.bind("<KeyRelease>", lambda _: self._on_key())
        for text, action, style in (
            ("Release", self.release, "TButton"),
            ("Zero", self.zero, "TButton"),
            ("Hold", self.hold, "Accent.TButton"),
        ):
            ttk.Button(bar, text=text, style=style, command=action).pack(side="right", padx=3)
        self._how = ttk.Label(self, text=_HOW[OFF], style="Faint.TLabel")
        self._how.pack(fill="x", pady=(8, 4))
        card = ttk.Frame(self, style="Card.TFrame", padding=(0, 6))
        card.pack(fill="x")
        self.rows = [
            ValueRow(card, name, _modes(index > 2), self._command, self._on_plot) for index, name in enumerate(_NAMES)
        ]
        for row in self.rows:
            row.pack(fill="x", pady=1)
        self.plot = LivePlot(self)
        self.plot.hint = "Tick “plot” beside a value.\n\nSolid: measured   Dashed: commanded"
        self.plot.pack(fill="both", expand=True, pady=(10, 0))

    def choose(self, name: str) -> None:
        """Another object; the one before is let go."""
        self.release()
        self.handle = self._get_handle(name)
        self.choice.set(name)
        can = [mode.name for mode in _modes(False)] if hasattr(self.handle, "set_twist") else ["pose"]
        for row in self.rows:
            row.mode_box.configure(values=[OFF, *can])
        self.update_values()

    def hold(self) -> None:
        """Commands the pose that is measured."""
        if self.handle is not None:
            self._enter("pose")
            self._send()

    def zero(self) -> None:
        """Commands the mode's zero; in pose mode that is the world's origin."""
        if self.handle is None:
            return
        mode = self.mode if self.mode != OFF else "pose"
        self._enter(mode)
        for row in self.rows:
            row.value = 0.0
            row.slider.show(0.0, row.slider.measured)
            row._show_entry()
        self._send()

    def release(self) -> None:
        """Lets go of the object."""
        self._enter(OFF)
        if self.handle is not None:
            self.handle.clear_cmd()

    @property
    def commanded(self) -> int:
        """1 if the object is commanded."""
        return int(self.mode != OFF)

    def update_values(self) -> None:
        """Shows the newest state; called some 25 times a second."""
        if self.handle is None:
            return
        pose = list(self.handle.get_pose())
        twist = pose
        if hasattr(self.handle, "linear_velocity"):
            twist = [*self.handle.linear_velocity, *self.handle.angular_velocity]
        now = time.monotonic()
        for index, row in enumerate(self.rows):
            in_mode = {"velocity": twist[index], "force": math.nan}.get(self.mode, pose[index])
            row.update_measured(pose[index], in_mode)
            if row.curve is not None:
                comparable = self.mode != "force"
                row.curve.add(now, in_mode if comparable else pose[index], row.value if comparable else None)
        if self.mode == "force":
            self._send()  # a force ends 0.1 s after it was last set
        if self.winfo_ismapped():
            self.plot.draw(now)

    def _command(self, mode: str, value: float) -> None:
        if self.handle is None:
            self._enter(OFF)
        elif mode == OFF:
            self.release()
        else:
            self._enter(mode)
            self._send()

    def _enter(self, mode: str) -> None:
        """All six values share a mode; those just joining begin with what is measured, or with nothing."""
        changed, self.mode = mode != self.mode, mode
        self._how.configure(text=_HOW[mode])
        for row in self.rows:
            if row.mode != mode:
                row.set_mode(mode, notify=False)
            if mode == OFF:
                row.value = None
            elif row.value is None or (changed and mode != "pose" and abs(row.value) < 1e-12):
                row.value = row.measured if mode == "pose" else 0.0
            row.slider.show(row.value, row.measured if mode in (OFF, "pose") else math.nan)
            row._show_entry()

    def _send(self) -> None:
        values = [row.value or 0.0 for row in self.rows]
        if self.mode == "pose":
            self.handle.set_pose(values)
        elif self.mode == "velocity":
            self.handle.set_twist(values)
        elif self.mode == "force":
            self.handle.set_wrench(values)

    def _on_key(self) -> None:
        words = self.choice.get().lower().split()
        self.choice.configure(values=[name for name in self._names if all(word in name.lower() for word in words)])

    def _on_typed(self) -> None:
        fits = list(self.choice["values"])
        if len(fits) == 1 or self.choice.get() in self._names:
            self.choose(self.choice.get() if self.choice.get() in self._names else fits[0])
        else:
            self.bell()

    def _on_plot(self, row: ValueRow, on: bool) -> None:
        if on:
            row.curve = self.plot.add_curve(row.name)
        else:
            row.curve = None
            self.plot.remove_curve(row.name)
