"""A watchdog: expires when an object has not been commanded for a while."""

from __future__ import annotations

import time
from typing import Any

from ._generations import takes_ral
from ._say import say


class WatchDog:
    """Expires time_out seconds (wall time) after the last acknowledgement; never before the first one."""

    ral: Any = None  # the node of ros_abstraction_layer that it was made with, or its client's

    @takes_ral
    def __init__(self, time_out: float = 0.1) -> None:
        self._time_out = float(time_out)
        self._acknowledged: float | None = None

    def acknowledge_wd(self) -> None:
        """Starts the time anew."""
        self._acknowledged = time.monotonic()

    def is_wd_expired(self) -> bool:
        """Whether time_out seconds have passed since the last acknowledgement."""
        return self._acknowledged is not None and time.monotonic() - self._acknowledged > self._time_out

    def console_print(self, class_name: str) -> None:
        """Says that the watchdog expired, once for each time it does, and rests until acknowledged again."""
        if self._acknowledged is not None:
            say(f"{class_name}: watchdog expired, resetting command")
        self._acknowledged = None

    def set_timeout(self, time_out: float) -> None:
        """Seconds without acknowledgement after which it expires."""
        if not time_out > 0.0:
            raise ValueError(f"a watchdog's time must be positive, not {time_out}")
        self._time_out = float(time_out)
