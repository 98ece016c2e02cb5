"""Tasks that sensors judge: the newest message of World/Success, and waiting for one."""

from __future__ import annotations

import threading
from typing import Any

import rospy

from ._messages import Message, msg


class SuccessWatch:
    """Listens to a world's Success topic from the first question on. The topic is latched: an answer comes at once."""

    def __init__(self, world_topic: str) -> None:
        """world_topic: the world's topics without /State."""
        self._topic = world_topic + "/Success"
        self._changed = threading.Condition()
        self._newest: Message | None = None
        self._sub: Any = None

    def open(self) -> None:
        """Subscribes; nothing when it has already."""
        with self._changed:
            if self._sub is None:
                self._sub = rospy.Subscriber(self._topic, msg.WorldSuccess, self._accept, queue_size=10)

    def close(self) -> None:
        """Ends listening; the next open() begins anew."""
        with self._changed:
            if self._sub is not None:
                self._sub.unregister()
            self._sub = self._newest = None

    def open_topics(self) -> list[tuple[str, str, bool]]:
        """The open topic as (name, type, whether this side publishes)."""
        return [] if self._sub is None or not self._sub.type else [(self._sub.resolved_name, self._sub.type, False)]

    def newest(self, timeout: float) -> dict[str, bool]:
        """Each sensor with a task by its full name, and whether it is done. Empty: none within timeout seconds."""
        self.open()
        with self._changed:
            self._changed.wait_for(lambda: self._newest is not None, timeout)
            return self._by_name()

    def wait(self, name: str | None, timeout: float) -> bool:
        """Waits until the task of this sensor is done, without a name all. False: not within timeout seconds."""
        self.open()
        with self._changed:
            return self._changed.wait_for(lambda: self._is_done(name), timeout)

    def _accept(self, message: Message) -> None:
        with self._changed:
            self._newest = message
            self._changed.notify_all()

    def _by_name(self) -> dict[str, bool]:
        if self._newest is None:
            return {}
        return {name: bool(done) for name, done in zip(self._newest.names, self._newest.success, strict=True)}

    def _is_done(self, name: str | None) -> bool:
        if name is None:
            return self._newest is not None and bool(self._newest.all)
        return self._by_name().get(name, False)
