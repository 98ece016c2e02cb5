"""A plot that scrolls: the last seconds of several values, measured (solid) and commanded (dashed)."""

import math
import tkinter as tk
from collections import deque

from ambf_tools.panels import theme

SECONDS = 10.0  # that are shown
_LEFT, _RIGHT, _TOP, _BOTTOM = 56, 12, 12, 24
_LEGEND_LINE = 17  # pixels
_MOST_POINTS = 500  # a curve


class Curve:
    """One value over time."""

    def __init__(self, name: str, colour: str) -> None:
        self.name, self.colour = name, colour
        self.measured: deque[tuple[float, float]] = deque(maxlen=_MOST_POINTS)
        self.commanded: deque[tuple[float, float | None]] = deque(maxlen=_MOST_POINTS)

    def add(self, time: float, measured: float, commanded: float | None) -> None:
        """Values at a time (s); no command: None."""
        self.measured.append((time, measured))
        self.commanded.append((time, commanded))


class LivePlot(tk.Canvas):
    """Draws the curves that were added. The scale follows what is shown."""

    def __init__(self, parent: tk.Misc, unit: str = "") -> None:
        super().__init__(parent, background=theme.CARD, highlightthickness=1, highlightbackground=theme.LINE)
        self.configure(width=400, height=240)
        self.unit = unit
        self.hint = ""  # shown while there is no curve
        self.curves: dict[str, Curve] = {}

    def add_curve(self, name: str) -> Curve:
        """A new curve, in a colour that no other has where possible."""
        used = {curve.colour for curve in self.curves.values()}
        colour = next((c for c in theme.CURVES if c not in used), theme.colour_of(len(self.curves)))
        self.curves[name] = Curve(name, colour)
        return self.curves[name]

    def remove_curve(self, name: str) -> None:
        """Takes a curve off."""
        self.curves.pop(name, None)

    def draw(self, now: float) -> None:
        """Draws everything anew; now: the right edge."""
        self.delete("all")
        width, height = self.winfo_width(), self.winfo_height()
        top = _TOP + _LEGEND_LINE * len(self.curves)
        right, bottom = width - _RIGHT, height - _BOTTOM
        if right - _LEFT < 50 or bottom - top < 50:
            return
        if not self.curves:
            self.create_text(width / 2, height / 2, text=self.hint, fill=theme.FAINT, justify="center")
            return
        low, high = self._range(now)

        def x(time: float) -> float:
            return _LEFT + (1 - (now - time) / SECONDS) * (right - _LEFT)

        def y(value: float) -> float:
            return bottom - (value - low) / (high - low) * (bottom - top)

        for value in ticks(low, high, max(2, int(bottom - top) // 40)):
            self.create_line(_LEFT, y(value), right, y(value), fill="#eceff3")
            self.create_text(_LEFT - 6, y(value), text=f"{value:.4g}", anchor="e", fill=theme.FAINT)
        for seconds in range(0, int(SECONDS) + 1, 2):
            at = x(now - seconds)
            self.create_line(at, top, at, bottom, fill="#eceff3")
            label = f"-{seconds} s" if seconds else "now"
            self.create_text(
                at if seconds else right + 4,
                bottom + 11,
                text=label,
                anchor="center" if seconds else "e",
                fill=theme.FAINT,
            )
        for curve in self.curves.values():
            self._line([(x(t), y(v)) for t, v in curve.commanded if v is not None and now - t < SECONDS], curve, (5, 4))
            self._line([(x(t), y(v)) for t, v in curve.measured if v == v and now - t < SECONDS], curve, ())
        self._legend()

    def _line(self, points: list[tuple[float, float]], curve: Curve, dash: tuple[int, ...]) -> None:
        if len(points) > 1:
            flat = [coordinate for point in points for coordinate in point]
            self.create_line(*flat, fill=curve.colour, width=1 if dash else 2, dash=dash)

    def _range(self, now: float) -> tuple[float, float]:
        values = [v for c in self.curves.values() for t, v in c.measured if v == v and now - t < SECONDS]
        values += [v for c in self.curves.values() for t, v in c.commanded if v is not None and now - t < SECONDS]
        low, high = (min(values), max(values)) if values else (-1.0, 1.0)
        margin = max(0.08 * (high - low), 1e-3, 1e-3 * abs(high))
        return low - margin, high + margin

    def _legend(self) -> None:
        for line, curve in enumerate(self.curves.values()):
            y = _TOP + _LEGEND_LINE * line + 2
            self.create_line(_LEFT, y, _LEFT + 22, y, fill=curve.colour, width=3)
            self.create_text(_LEFT + 30, y, text=theme.elided(curve.name, 44), anchor="w", fill=theme.TEXT)


def ticks(low: float, high: float, count: int) -> list[float]:
    """Round values between the two."""
    raw = (high - low) / max(1, count)
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= raw)
    first = math.ceil(low / step)
    return [round(n * step, 12) for n in range(first, math.floor(high / step) + 1)]
