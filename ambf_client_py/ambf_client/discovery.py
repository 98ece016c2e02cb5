"""Watches which objects there are, and keeps this process known to the master."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable

import rospy

from ._master import Master, MasterSilent, View
from ._say import say

_PERIOD = 0.25  # s between looks, at least
_PATIENCE = 3  # looks in a row that a busy master may leave unanswered
_SHARE = 0.05  # of one processor at most, for looking


class Discovery:
    """Looks at the master now and then, in a thread of its own, and reports changes.

    topics() gives what this process has open, as (topic, type, publishes); changed(added, removed) is called with
    topics without /State.
    """

    def __init__(
        self,
        master: Master,
        topics: Callable[[], Iterable[tuple[str, str, bool]]],
        changed: Callable[[View, list[str], list[str]], None],
    ) -> None:
        self._master = master
        self._topics = topics
        self._changed = changed
        self._view = View()
        self._lost = False
        self._slow_answers = 0
        self._missing: set[tuple[str, str, bool]] = set()
        self._looking = threading.RLock()
        self._wake = threading.Event()
        self._stop = False
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Starts looking by itself."""
        if self._thread is None:
            self._stop = False
            self._thread = threading.Thread(target=self._run, name="ambf_client discovery", daemon=True)
            self._thread.start()

    def stop(self) -> None:
        """Stops looking."""
        self._stop = True
        self._wake.set()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(1.0)
        self._thread = None

    def look(self) -> View:
        """Looks now, and reports changes before it returns."""
        with self._looking:
            try:
                view = self._master.look()
            except MasterSilent as error:
                self._slow_answers = self._slow_answers + 1 if error.slow else 0
                if not self._lost and (not error.slow or self._slow_answers >= _PATIENCE):
                    self._lost = True
                    say(f"the ROS master does not answer ({error}); what is connected goes on, waiting for it")
                return self._view
            except LookupError:  # something vanished while we looked; next time
                return self._view
            self._slow_answers = 0
            if self._lost:
                self._lost = False
                say(f"the ROS master is back at {self._master.uri}")
            self._register(view)
            old, self._view = self._view.objects, view
            added = sorted(name for name, kind in view.objects.items() if old.get(name) != kind)
            removed = sorted(name for name in old if name not in view.objects)
            if added or removed:
                self._changed(view, added, removed)
            return view

    def _register(self, view: View) -> None:
        """A master that was started anew does not know us."""
        me, api = rospy.get_name(), rospy.get_node_uri()
        missing = set()
        for topic in self._topics():
            name, kind, publishes = topic
            known = view.publishers if publishes else view.subscribers
            if api is None or me in known.get(name, ()):
                continue
            missing.add(topic)
            # Missing once, it may have been opened while we looked, and rospy be registering it.
            if topic in self._missing:
                try:
                    self._master.register_again(api, name, kind, publishes)
                except (LookupError, OSError):
                    break  # at the next look
        self._missing = missing

    def _run(self) -> None:
        while not self._stop and not rospy.is_shutdown():
            begin = time.monotonic()
            self.look()
            self._wake.wait(max(_PERIOD, (time.monotonic() - begin) / _SHARE))
            self._wake.clear()
