"""`ral` over ROS 1 (rospy)."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from typing import Any

import rospy

from ._layer import Layer
from ._node import become_node

__all__ = ["ral"]

_PUBLISHER, _SUBSCRIBER = (list(inspect.signature(each).parameters) for each in (rospy.Publisher, rospy.Subscriber))


class ral(Layer):  # noqa: N801 - the name that scripts of AMBF 3.0 import
    """A node of ROS 1. There may be several in a process: they share its one rospy node, named by the first.

    Names of topics and services lose '/' at both ends; then '/', the namespace and '/' come before them.
    """

    def __init__(self, node_name: str, namespace: str = "", node: Any = None) -> None:
        """node_name: a number is added. namespace: of all topics and services. node: a ral, whose node is shared."""
        super().__init__(node_name, namespace, node)
        if node is None:
            become_node(node_name, _report)

    @staticmethod
    def ros_version() -> int:
        """1."""
        return 1

    @staticmethod
    def parse_argv(argv: list[str]) -> list[str]:
        """The arguments without those of ROS (name:=value)."""
        return list(rospy.myargv(argv))

    # --- time ------------------------------------------------------------------------------------------------------

    def now(self) -> rospy.Time:
        """The node's clock."""
        return rospy.Time.now()

    def now_msg(self) -> rospy.Time:
        """The node's clock as a field of a message."""
        return rospy.Time.now()

    def to_sec(self, t: Any) -> float:
        """Seconds of a time, a duration or what get_timestamp takes."""
        return float(self.get_timestamp(t).to_sec())

    def create_duration(self, s: float) -> rospy.Duration:
        """A duration of that many seconds."""
        return rospy.Duration(s)

    def create_rate(self, hz: float) -> rospy.Rate:
        """A rate; its sleep() waits for what is left of each period."""
        return rospy.Rate(hz)

    def create_time(self) -> rospy.Time:
        """Time zero."""
        return rospy.Time()

    # --- running ---------------------------------------------------------------------------------------------------

    def spin(self) -> None:
        """Returns at once: rospy calls back in threads of its own."""

    def spin_and_execute(self, function: Callable[..., Any], *arguments: Any) -> None:
        """Calls function(*arguments), then ends the node."""
        self.spin()
        function(*arguments)
        rospy.signal_shutdown("ral.spin_and_execute is done")

    def shutdown(self) -> None:
        """Ends the node, which all layers of the process share, and raises RuntimeError, as it does in 3.0."""
        rospy.signal_shutdown("ral.shutdown was called")
        raise RuntimeError(f"ral.shutdown() of '{self.node_name()}' was called")

    def on_shutdown(self, callback: Callable[[], None]) -> None:
        """callback() is called when the node ends."""
        rospy.on_shutdown(callback)

    def is_shutdown(self) -> bool:
        """Whether the node has ended, or is ending."""
        return bool(rospy.is_shutdown() or rospy.core.is_shutdown_requested())

    # --- topics and services ---------------------------------------------------------------------------------------

    def publisher(
        self, topic: str, msg_type: Any, queue_size: int = 10, latch: bool = False, *args: Any, **kwargs: Any
    ) -> rospy.Publisher:
        """A rospy.Publisher; further arguments are rospy's."""
        _check_known("publisher", kwargs, _PUBLISHER)
        name = self._add_namespace_to(topic)
        self._ends.append(rospy.Publisher(name, msg_type, *args, queue_size=queue_size, latch=latch, **kwargs))
        return self._ends[-1]

    def subscriber(
        self,
        topic: str,
        msg_type: Any,
        callback: Callable[..., None],
        queue_size: int = 10,
        latch: bool = False,
        *args: Any,
        **kwargs: Any,
    ) -> rospy.Subscriber:
        """A rospy.Subscriber; further arguments are rospy's. latch: of ROS 2, here the publisher's choice."""
        _check_known("subscriber", kwargs, _SUBSCRIBER)
        name = self._add_namespace_to(topic)
        self._ends.append(rospy.Subscriber(name, msg_type, callback, *args, queue_size=queue_size, **kwargs))
        return self._ends[-1]

    def service_client(self, name: str, srv_type: Any) -> rospy.ServiceProxy:
        """A function that calls the service."""
        return rospy.ServiceProxy(self._add_namespace_to(name), srv_type)

    def get_topic_name(self, pubsub: Any) -> str:
        """The full name of a publisher's or subscriber's topic."""
        return str(pubsub.name)

    def get_published_topics(self) -> list[list[str]]:
        """All topics that somebody publishes as [name, type]."""
        return [list(each) for each in rospy.get_published_topics()]

    # --- inside ----------------------------------------------------------------------------------------------------

    def _shared_node(self) -> Any:
        return self

    def _is_connected(self, end: Any) -> bool:
        return bool(end.get_num_connections() > 0)


def _check_known(method: str, given: dict[str, Any], known: list[str]) -> None:
    unknown = sorted(set(given) - set(known))
    if unknown:
        raise TypeError(f"ral.{method}: there is no argument {', '.join(unknown)}; known: {', '.join(known)}")


def _report(message: str) -> None:
    print(f"[ral] {message}", file=sys.stderr, flush=True)
