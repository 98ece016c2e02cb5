"""Topics watched for people: the newest message as rows, a few times a second, of any type and however fast."""

import contextlib
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

import genpy.dynamic
import rospy

from .listing import message_class
from .texts import rows

_RATE_OVER = 2.0  # s


class Watch:
    """Watches one topic. take() is for one thread, messages arrive on another."""

    def __init__(self, topic: str) -> None:
        self.topic = topic
        self._lock = threading.Lock()
        self._newest: Any = None
        self._count = 0
        self._counts: deque[tuple[float, int]] = deque()  # when, how many until then
        self._classes: dict[str, Any] = {}  # by checksum
        # Any type: nobody knows it before the first message. Of what waits only the newest is read.
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._arrived, queue_size=1, tcp_nodelay=True)

    def close(self) -> None:
        """Ends it."""
        self._subscriber.unregister()

    def _arrived(self, message: Any) -> None:
        with self._lock:
            self._newest = message
            self._count += 1

    def take(self) -> dict[str, Any] | None:
        """The newest message since the last call, as an event; None: there is none."""
        with self._lock:
            message, self._newest, count = self._newest, None, self._count
        now = time.monotonic()
        self._counts.append((now, count))
        while now - self._counts[0][0] > _RATE_OVER:
            self._counts.popleft()
        if message is None:
            return None
        since, before = self._counts[0]
        header = message._connection_header
        kind = header.get("type", "")
        event = {"event": "message", "topic": self.topic, "type": kind, "count": count, "bytes": len(message._buff)}
        # Over less than that it would be a guess.
        event["rate"] = round((count - before) / (now - since), 2) if now - since > 0.5 else 0.0
        try:
            event["rows"] = rows(self._class_of(kind, header)().deserialize(message._buff))
        except Exception as problem:  # of whoever sent it: nothing of it may end the watch
            event |= {"rows": [], "error": f"cannot be read: {' '.join(str(problem).split())}"}
        return event

    def _class_of(self, kind: str, header: Any) -> Any:
        """The class that fits what the sender says it sends; made from its definition where it is not installed."""
        checksum = header.get("md5sum", "")
        if checksum not in self._classes:
            found = None
            with contextlib.suppress(LookupError):
                found = message_class(kind)
            if found is None or found._md5sum != checksum:
                found = genpy.dynamic.generate_dynamic(kind, header.get("message_definition", ""))[kind]
            self._classes[checksum] = found
        return self._classes[checksum]


class Watches:
    """The topics watched now; tells `emit` of what comes, at most so often."""

    def __init__(self, emit: Callable[[dict[str, Any]], None], period: float = 0.1) -> None:
        self._emit, self._period = emit, period
        self._lock = threading.Lock()
        self._watches: dict[str, Watch] = {}
        threading.Thread(target=self._run, name="watching", daemon=True).start()

    def set(self, topics: list[str]) -> None:
        """Watches these, and no others."""
        with self._lock:
            for topic in [each for each in self._watches if each not in topics]:
                self._watches.pop(topic).close()
            for topic in topics:
                if topic not in self._watches:
                    self._watches[topic] = Watch(topic)

    def topics(self) -> list[str]:
        """Those watched now."""
        with self._lock:
            return list(self._watches)

    def _run(self) -> None:
        while True:
            time.sleep(self._period)
            with self._lock:
                events = [event for watch in self._watches.values() if (event := watch.take()) is not None]
            for event in events:
                self._emit(event)
