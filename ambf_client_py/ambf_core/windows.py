"""The simulator's window on worlds of this process. OpenGL is loaded with it."""

from __future__ import annotations

import logging
import weakref
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .world import World

_LEVELS = (logging.INFO, logging.WARNING, logging.ERROR)
_log = logging.getLogger("ambf_core")


class Window:
    """Shows worlds, with the views, layers, panel and keys of docs/keys.md; worlds never change by it.

    One at a time in a process; it needs a display. It answers while the program computes. Views that users move and
    lights that they change are the window's own: pictures, states and hashes are what they are without it. What would
    change the world is refused, in the window.
    """

    def __init__(self, world: World) -> None:
        """Raises RuntimeError where none can be opened, with the reason."""
        import _ambf_view

        self._native: Any = world.look(_ambf_view.Window)
        self._end = weakref.finalize(self, self._native.close)  # at the end of the process, too
        self._report()

    def show(self, world: World, seconds: float = 0.0) -> None:
        """Shows the newest step of a world, the one before or another one; returns when it is over.

        So many seconds long at the window's speed, counted from the end of the one before; while users have paused the
        window, until they step by hand or go on. Once the window is closed nothing waits.
        """
        if self.closed:
            return
        world.look(lambda frame: self._native.show(frame, seconds))
        self._native.wait()
        self._report()

    @property
    def closed(self) -> bool:
        """By its user, by close(), or because the display is gone."""
        return bool(self._native.closed())

    def take_reset(self) -> bool:
        """Whether a user has asked for a reset since the last call."""
        return bool(self._native.take_reset())

    def close(self) -> None:
        """Closes it. Twice is fine."""
        self._end()

    def _report(self) -> None:
        for severity, text in self._native.take_log():
            _log.log(_LEVELS[severity], "%s", text)
