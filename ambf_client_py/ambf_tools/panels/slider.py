"""A slider that shows two values: the knob is what is commanded, the mark below it what is measured."""

import tkinter as tk
from collections.abc import Callable

from ambf_tools.panels import theme

_MARGIN = 10  # pixels at both ends
_HEIGHT = 30


class Slider(tk.Canvas):
    """Commands values between two ends.

    Drag the knob or click beside it; the arrow keys move it by 1 % of the range, with Shift by 0.1 %. on_change is
    called with each value that the user chooses.
    """

    def __init__(self, parent: tk.Misc, lower: float, upper: float, on_change: Callable[[float], None]) -> None:
        super().__init__(
            parent, height=_HEIGHT, width=220, background=theme.CARD, highlightthickness=0, takefocus=1, cursor="hand2"
        )
        self.low, self.high = lower, upper
        self.value: float | None = None  # None: nothing is commanded
        self.measured = float("nan")
        self._on_change = on_change
        self._track = self.create_line(0, 0, 0, 0, width=4, capstyle="round", fill=theme.LINE)
        self._filled = self.create_line(0, 0, 0, 0, width=4, capstyle="round", fill=theme.COMMANDED)
        self._mark = self.create_polygon(0, 0, 0, 0, 0, 0, fill=theme.MEASURED, outline="")
        self._knob = self.create_oval(0, 0, 0, 0, fill=theme.CARD, outline=theme.COMMANDED, width=2)
        self.bind("<Configure>", lambda _: self.draw())
        self.bind("<Button-1>", self._on_mouse)
        self.bind("<B1-Motion>", self._on_mouse)
        for key, share in (("Left", -0.01), ("Right", 0.01), ("Shift-Left", -0.001), ("Shift-Right", 0.001)):
            self.bind(f"<{key}>", lambda _, share=share: self._nudge(share))  # type: ignore[misc]

    def set_range(self, lower: float, upper: float) -> None:
        """Other ends."""
        self.low, self.high = lower, upper
        self.draw()

    def show(self, value: float | None, measured: float) -> None:
        """Shows what is commanded and measured; calls no callback."""
        if (value, measured) == (self.value, self.measured):
            return
        self.value, self.measured = value, measured
        self.draw()

    def position_of(self, value: float) -> float:
        """x of a value, in pixels; values beyond the ends are at the ends."""
        span = self.high - self.low
        share = (value - self.low) / span if span > 0 else 0.5
        return _MARGIN + min(1.0, max(0.0, share)) * (max(self.winfo_width(), 2 * _MARGIN + 1) - 2 * _MARGIN)

    def draw(self) -> None:
        """Puts everything where it belongs."""
        y = 12
        left, right = self.position_of(self.low), self.position_of(self.high)
        self.coords(self._track, left, y, right, y)
        zero = self.position_of(min(max(0.0, self.low), self.high))
        if self.value is None:
            self.coords(self._filled, zero, y, zero, y)
            self.itemconfigure(self._filled, state="hidden")
            x = self.position_of(self.measured) if self.measured == self.measured else zero
            self.itemconfigure(self._knob, outline=theme.FAINT, fill=theme.BACKGROUND)
        else:
            x = self.position_of(self.value)
            self.coords(self._filled, zero, y, x, y)
            self.itemconfigure(self._filled, state="normal")
            self.itemconfigure(self._knob, outline=theme.COMMANDED, fill=theme.CARD)
        self.coords(self._knob, x - 7, y - 7, x + 7, y + 7)
        if self.measured == self.measured:
            m = self.position_of(self.measured)
            self.coords(self._mark, m, y + 8, m - 5, y + 16, m + 5, y + 16)
            self.itemconfigure(self._mark, state="normal")
        else:
            self.itemconfigure(self._mark, state="hidden")

    def _on_mouse(self, event: "tk.Event[tk.Canvas]") -> None:
        self.focus_set()
        width = max(1, self.winfo_width() - 2 * _MARGIN)
        share = min(1.0, max(0.0, (event.x - _MARGIN) / width))
        self._choose(self.low + share * (self.high - self.low))

    def _nudge(self, share: float) -> None:
        start = self.value if self.value is not None else self.measured
        if start == start:
            self._choose(min(self.high, max(self.low, start + share * (self.high - self.low))))

    def _choose(self, value: float) -> None:
        self.value = value
        self.draw()
        self._on_change(value)
