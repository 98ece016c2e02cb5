"""One line of a panel: a name, a mode, a slider, numbers, and whether it is plotted."""

import math
import tkinter as tk
from collections.abc import Callable
from dataclasses import dataclass
from tkinter import ttk

from ambf_tools.panels import theme
from ambf_tools.panels.plot import Curve
from ambf_tools.panels.slider import Slider


@dataclass(frozen=True)
class Mode:
    """A way to command a value."""

    name: str  # as in the list of modes
    unit: str
    lower: float
    upper: float
    strict: bool = False  # the ends are limits of the model: nothing beyond them is commanded


OFF = "off"


class ValueRow(ttk.Frame):
    """A value that can be commanded in one of several modes, or left alone ("off").

    on_command(mode, value) is called for each choice of the user; mode OFF: let go of it. The slider covers the mode's
    range; numbers typed beyond it widen it, unless its ends are limits of the model.
    """

    def __init__(
        self,
        parent: tk.Misc,
        name: str,
        modes: list[Mode],
        on_command: Callable[[str, float], None],
        on_plot: Callable[["ValueRow", bool], None],
        keeps_off: bool = True,
    ) -> None:
        super().__init__(parent, style="Card.TFrame")
        self.name = name
        self.modes = {mode.name: mode for mode in modes}
        self.mode = OFF
        self.value: float | None = None
        self.measured = math.nan
        self.curve: Curve | None = None
        self._on_command = on_command
        self.columnconfigure(2, weight=1)
        self._label = ttk.Label(self, text=theme.elided(name, 28), style="Card.TLabel", width=22, anchor="w")
        self._label.grid(row=0, column=0, padx=(10, 4), sticky="w")
        names = [*([OFF] if keeps_off else []), *self.modes]
        self.mode_box = ttk.Combobox(self, values=names, state="readonly", width=8)
        self.mode_box.grid(row=0, column=1, padx=4)
        self.mode_box.bind("<<ComboboxSelected>>", lambda _: self.set_mode(self.mode_box.get()))
        first = modes[0]
        self.slider = Slider(self, first.lower, first.upper, self._on_slider)
        self.slider.grid(row=0, column=2, sticky="ew", padx=4)
        self.entry = ttk.Entry(self, width=9, justify="right")
        self.entry.grid(row=0, column=3, padx=4)
        self.entry.bind("<Return>", lambda _: self._on_entry())
        self.entry.bind("<FocusOut>", lambda _: self._show_entry())
        self._unit = ttk.Label(self, text=first.unit, style="FaintCard.TLabel", width=5)
        self._unit.grid(row=0, column=4)
        self._measured = ttk.Label(self, text="–", style="Card.TLabel", width=9, anchor="e", foreground=theme.MEASURED)
        self._measured.grid(row=0, column=5, padx=4)
        self._limits = ttk.Label(self, style="FaintCard.TLabel", width=13, anchor="center")
        self._limits.grid(row=0, column=6)
        # Without a variable of Tk's: those complain when another thread collects them.
        self.plot_box = ttk.Checkbutton(
            self,
            text="plot",
            style="Card.TCheckbutton",
            command=lambda: on_plot(self, self.plot_box.instate(["selected"])),
        )
        self.plot_box.state(["!alternate", "!selected"])
        self.plot_box.grid(row=0, column=7, padx=(4, 10))
        self._shown_text = "–"
        self.set_mode(names[0], notify=False)

    def set_mode(self, name: str, notify: bool = True) -> None:
        """Changes the mode; what is commanded then is what is measured (position), or nothing (others)."""
        self.mode = name
        self.mode_box.set(name)
        mode = self.modes.get(name) or next(iter(self.modes.values()))
        self._unit.configure(text=mode.unit)
        self._limits.configure(text=f"{theme.short(mode.lower)} … {theme.short(mode.upper)}")
        self.slider.set_range(mode.lower, mode.upper)
        if name == OFF:
            self.value = None
            if notify:
                self._on_command(OFF, 0.0)
        elif notify:
            first = next(iter(self.modes)) == name and self.measured == self.measured
            self.command(min(mode.upper, max(mode.lower, self.measured)) if first else 0.0)
        self._show_entry()
        self.slider.show(self.value, self._measured_if_comparable())

    def command(self, value: float) -> None:
        """Commands a value in the present mode, or in the first one if it was off."""
        if self.mode == OFF:
            self.set_mode(next(iter(self.modes)), notify=False)
        mode = self.modes[self.mode]
        if mode.strict:
            value = min(mode.upper, max(mode.lower, value))
        self.value = value
        lower, upper = self.slider.low, self.slider.high
        if not lower <= value <= upper:
            self.slider.set_range(min(lower, value), max(upper, value))
        self._show_entry()
        self.slider.show(value, self._measured_if_comparable())
        self._on_command(self.mode, value)

    def zero(self) -> None:
        """Commands zero, or the limit next to it."""
        mode = self.modes.get(self.mode) or next(iter(self.modes.values()))
        self.command(min(mode.upper, max(mode.lower, 0.0)))

    def hold(self) -> None:
        """Commands the position that is measured now."""
        if self.measured == self.measured:
            self.set_mode(next(iter(self.modes)), notify=False)
            self.command(self.measured)

    def release(self) -> None:
        """Commands nothing any more."""
        if self.mode != OFF:
            self.set_mode(OFF)

    def update_measured(self, position: float, in_mode: float) -> None:
        """position: for the first mode, and for hold; in_mode: the value that belongs to the present one."""
        self.measured = position
        shown = position if self.mode == OFF else in_mode
        text = theme.readable(shown)
        if text != self._shown_text:
            self._shown_text = text
            self._measured.configure(text=text)
        self.slider.show(self.value, shown)

    def _measured_if_comparable(self) -> float:
        return self.measured if self.mode in (OFF, next(iter(self.modes))) else math.nan

    def _on_slider(self, value: float) -> None:
        self.command(value)

    def _on_entry(self) -> None:
        try:
            value = float(self.entry.get().replace(",", "."))
        except ValueError:
            value = math.nan
        if math.isfinite(value):
            self.command(value)
        else:
            self.bell()
        self._show_entry()

    def _show_entry(self) -> None:
        self.entry.delete(0, "end")
        if self.value is not None:
            self.entry.insert(0, theme.readable(self.value))
