"""Publishes on a topic, once or at a rate, and calls a service. This process must be a ROS node."""

import contextlib
import threading
import time
from typing import Any

import rospy
from rosgraph.names import is_legal_name
from std_msgs.msg import Header

from .listing import service_class
from .texts import TextError, fill

CONNECT_TIMEOUT = 3.0  # s


class Sender:
    """Publishes on one topic, from a thread of its own. Raises ValueError when it cannot."""

    def __init__(self, topic: str, kind: Any) -> None:
        self.topic, self.kind = topic, kind
        self.rate, self.count = 0.0, 0
        self._message: Any = None
        self._changed = threading.Condition()
        if not is_legal_name(topic):  # the master would refuse it, again and again
            raise ValueError(f"'{topic}' is no name of a topic: letters, digits, _ and / may be in it")
        try:
            self._publisher = rospy.Publisher(topic, kind, queue_size=10, tcp_nodelay=True)
        except (rospy.ROSException, ValueError) as problem:
            raise ValueError(f"cannot publish on {topic}: {problem}") from None
        threading.Thread(target=self._run, name=f"publishing {topic}", daemon=True).start()

    def once(self, message: Any, listeners: int) -> str:
        """Publishes it once, after a connection or a timeout; reports in words what came of it."""
        self.repeat(None, 0.0)
        deadline = time.monotonic() + (CONNECT_TIMEOUT if listeners else 0.0)
        while self._publisher.get_num_connections() < 1 and time.monotonic() < deadline:
            time.sleep(0.005)
        self._send(message)
        heard = self._publisher.get_num_connections()
        if heard:
            return f"published to {heard} listener{'s' if heard > 1 else ''}"
        return "published, but " + ("who is said to listen does not answer" if listeners else "nobody listens")

    def repeat(self, message: Any, rate: float) -> None:
        """Publishes it at `rate` (Hz) until the next call; 0: stops."""
        with self._changed:
            self._message, self.rate = message, rate
            self._changed.notify()

    def _send(self, message: Any) -> None:
        with contextlib.suppress(rospy.ROSException):  # closed in between
            self._publisher.publish(message)
            self.count += 1

    def _run(self) -> None:
        next_time = 0.0
        while True:
            with self._changed:
                now = time.monotonic()
                if self.rate <= 0 or next_time > now:
                    self._changed.wait(min(next_time - now, 1.0) if self.rate > 0 else None)
                    continue
                message, period = self._message, 1.0 / self.rate
            next_time = max(next_time + period, now)  # what came too late is not made up for
            if isinstance(getattr(message, "header", None), Header):
                message.header.stamp = rospy.Time.from_sec(time.time())
            self._send(message)


def call(service: str, kind: str, text: str) -> Any:
    """Calls a service with YAML; its answer, however long it takes. Raises ConnectionError, TextError, LookupError."""
    found = service_class(kind)
    request = fill(found._request_class, text)
    try:
        return rospy.ServiceProxy(service, found)(request)
    except (rospy.ServiceException, rospy.ROSException) as problem:
        raise ConnectionError(f"{service} failed: {problem}") from None


__all__ = ["CONNECT_TIMEOUT", "Sender", "TextError", "call"]
