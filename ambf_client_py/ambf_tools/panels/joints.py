"""The panel of joints: all joints of one or several robots, in groups, with search and a plot."""

import math
import time
import tkinter as tk
from collections.abc import Callable
from dataclasses import dataclass, field
from tkinter import ttk
from typing import Any

from ambf_tools.panels import theme
from ambf_tools.panels.plot import LivePlot
from ambf_tools.panels.scrolled import ScrolledFrame
from ambf_tools.panels.value_row import OFF, Mode, ValueRow

# Ranges of what has no limits in the model.
_ANGLE, _LENGTH = math.pi, 0.5  # rad, m
_TURN_RATE, _SPEED = 2.0, 0.5  # rad/s, m/s
_TORQUE, _FORCE = 10.0, 50.0  # N m, N


@dataclass
class Robot:
    """A body with joints below it."""

    name: str
    handle: Any  # ambf_client.RigidBody
    limits: dict[str, tuple[float, float]] = field(default_factory=dict)  # by the joint's name
    sliding: set[str] = field(default_factory=set)  # prismatic ones


def modes_of(robot: Robot, joint: str) -> list[Mode]:
    """How a joint can be commanded, and in which ranges."""
    sliding = joint in robot.sliding
    reach = _LENGTH if sliding else _ANGLE
    lower, upper = robot.limits.get(joint, (-reach, reach))
    speed, effort = (_SPEED, _FORCE) if sliding else (_TURN_RATE, _TORQUE)
    return [
        Mode("position", "m" if sliding else "rad", lower, upper, strict=joint in robot.limits),
        Mode("velocity", "m/s" if sliding else "rad/s", -speed, speed),
        Mode("effort", "N" if sliding else "N m", -effort, effort),
    ]


class Group:
    """The joints of one robot: a heading that folds, and their rows."""

    def __init__(self, parent: tk.Misc, robot: Robot, on_plot: Callable[["Group", ValueRow, bool], None]) -> None:
        self.robot = robot
        self.open = True
        self.frame = ttk.Frame(parent)
        head = ttk.Frame(self.frame)
        head.pack(fill="x", pady=(10, 4))
        self._arrow = ttk.Label(head, text="▾", style="Group.TLabel", width=2, cursor="hand2")
        self._arrow.pack(side="left")
        title = ttk.Label(head, text=robot.name, style="Group.TLabel", cursor="hand2")
        title.pack(side="left")
        self._count = ttk.Label(head, style="Faint.TLabel")
        self._count.pack(side="left", padx=8)
        for widget in (self._arrow, title):
            widget.bind("<Button-1>", lambda _: self.fold())
        for text, action in (("Release", self.release), ("Hold", self.hold), ("Zero", self.zero)):
            ttk.Button(head, text=text, style="Small.TButton", command=action).pack(side="right", padx=2)
        self._body = ttk.Frame(self.frame, style="Card.TFrame", padding=(0, 4))
        self._body.pack(fill="x")
        self.rows: list[ValueRow] = []
        self._shown: list[ValueRow] = []
        for index, name in enumerate(robot.handle.get_joint_names()):
            row = ValueRow(
                self._body,
                name.rpartition("/")[2],
                modes_of(robot, name),
                lambda mode, value, index=index: self._command(index, mode, value),  # type: ignore[misc]
                lambda row, on: on_plot(self, row, on),
            )
            self.rows.append(row)
        self.filter("")

    def fold(self) -> None:
        """Opens or closes the group."""
        self.open = not self.open
        self._arrow.configure(text="▾" if self.open else "▸")
        self._layout()

    def filter(self, words: str) -> bool:
        """Shows the rows whose names contain all words; False when there is none."""
        parts = words.lower().split()
        whole = self.robot.name.lower()
        self._shown = [row for row in self.rows if all(part in f"{whole} {row.name}".lower() for part in parts)]
        few = f"{len(self._shown)} of " if len(self._shown) != len(self.rows) else ""
        self._count.configure(text=f"{few}{len(self.rows)} joint{'' if len(self.rows) == 1 else 's'}")
        self._layout()
        return bool(self._shown)

    def zero(self) -> None:
        """Commands zero to all rows that are shown."""
        for row in self._shown:
            row.zero()

    def hold(self) -> None:
        """Commands what is measured."""
        for row in self._shown:
            row.hold()

    def release(self) -> None:
        """Lets go."""
        for row in self._shown:
            row.release()

    def update(self) -> None:
        """Shows the newest state."""
        handle = self.robot.handle
        positions = handle.get_all_joint_pos()
        columns = {
            "position": positions,
            "velocity": handle.get_all_joint_vel(),
            "effort": handle.get_all_joint_effort(),
        }
        for index, row in enumerate(self.rows):
            if index < len(positions):
                column = columns.get(row.mode, positions)
                row.update_measured(positions[index], column[index] if index < len(column) else math.nan)

    @property
    def commanded(self) -> int:
        """How many joints are commanded."""
        return sum(1 for row in self.rows if row.value is not None)

    def _layout(self) -> None:
        for row in self.rows:
            row.pack_forget()
        for row in self._shown if self.open else []:
            row.pack(fill="x")
        if not self.open:
            self._body.configure(height=1)

    def _command(self, index: int, mode: str, value: float) -> None:
        handle = self.robot.handle
        if mode == OFF and not self.commanded:
            handle.clear_cmd()  # and nothing is sent any more
        elif mode == OFF:
            handle.clear_joint(index)
        else:
            setter = {"position": "set_joint_pos", "velocity": "set_joint_vel", "effort": "set_joint_effort"}[mode]
            getattr(handle, setter)(index, value)


class JointsTab(ttk.Frame):
    """All groups, the search field and the plot."""

    def __init__(self, parent: tk.Misc, robots: list[Robot]) -> None:
        super().__init__(parent, padding=12)
        bar = ttk.Frame(self)
        bar.pack(fill="x")
        ttk.Label(bar, text="Search").pack(side="left")
        self.search = ttk.Entry(bar, width=28)
        self.search.pack(side="left", padx=8)
        self.search.bind("<KeyRelease>", lambda _: self._filter())
        ttk.Label(bar, text="○ commanded", foreground=theme.COMMANDED).pack(side="left", padx=(16, 6))
        ttk.Label(bar, text="▲ measured", foreground=theme.MEASURED).pack(side="left", padx=6)
        ttk.Button(bar, text="Release all", command=lambda: self._all("release")).pack(side="right", padx=3)
        ttk.Button(bar, text="Zero all", command=lambda: self._all("zero")).pack(side="right", padx=3)
        hold = ttk.Button(bar, text="Hold all", style="Accent.TButton", command=lambda: self._all("hold"))
        hold.pack(side="right", padx=3)
        panes = ttk.PanedWindow(self, orient="horizontal")
        panes.pack(fill="both", expand=True, pady=(8, 0))
        scrolled = ScrolledFrame(panes, 940)
        panes.add(scrolled, weight=1)
        self.plot = LivePlot(panes)
        self.plot.hint = "Tick “plot” beside a joint.\n\nSolid: measured   Dashed: commanded"
        panes.add(self.plot, weight=1)
        self.groups = [Group(scrolled.inside, robot, self._on_plot) for robot in robots]
        self._nothing = ttk.Label(scrolled.inside, text="No joint fits.", style="Faint.TLabel")
        self._filter()

    def update_values(self) -> None:
        """Shows the newest states; called some 25 times a second."""
        now = time.monotonic()
        for group in self.groups:
            group.update()
            for row in group.rows:
                if row.curve is not None:
                    shown = row.slider.measured if row.mode != OFF else row.measured
                    row.curve.add(now, shown, row.value)
        if self.winfo_ismapped():
            self.plot.draw(now)

    @property
    def commanded(self) -> int:
        """How many joints are commanded."""
        return sum(group.commanded for group in self.groups)

    def row(self, name: str) -> ValueRow:
        """The row of a joint, by its last part."""
        return next(row for group in self.groups for row in group.rows if row.name == name)

    def release(self) -> None:
        """Lets go of everything, also of what the search hides."""
        for group in self.groups:
            for row in group.rows:
                row.release()

    def _all(self, action: str) -> None:
        for group in self.groups:
            getattr(group, action)()

    def _filter(self) -> None:
        words = self.search.get()
        found = False
        for group in self.groups:
            group.frame.pack_forget()
            if group.filter(words):
                group.frame.pack(fill="x", padx=(0, 8))
                found = True
        self._nothing.pack_forget()
        if not found:
            self._nothing.pack(pady=30)

    def _on_plot(self, group: Group, row: ValueRow, on: bool) -> None:
        several = len(self.groups) > 1
        name = f"{group.robot.name.partition('/')[0]}: {row.name}" if several else row.name
        if on:
            row.curve = self.plot.add_curve(name)
        else:
            row.curve = None
            self.plot.remove_curve(name)
