"""`ral` over ROS 2 (rclpy). Untested: Debian 12, which AMBF is built and tested on, has no ROS 2."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable
from typing import Any

try:
    import rclpy
    import rclpy.executors
    import rclpy.qos
    import rclpy.time
    import rclpy.utilities
except ImportError as error:
    raise ImportError("ROS_VERSION is 2, but there is no rclpy: set ROS_VERSION=1 for ROS 1", name="rclpy") from error

from ._layer import Layer

__all__ = ["ral"]

_JOIN_S = 1.0


class ral(Layer):  # noqa: N801 - the name that scripts of AMBF 3.0 import
    """A node of ROS 2; each has one of its own, children share their parent's."""

    def __init__(self, node_name: str, namespace: str = "", node: Any = None) -> None:
        """namespace: of all topics and services. node: an rclpy node to use instead of a new one."""
        if node is None:
            with contextlib.suppress(RuntimeError):  # initialised before, e.g. by parse_argv
                rclpy.init()
            node = rclpy.create_node(node_name)
        super().__init__(node_name, namespace, node)
        self._executor: Any = None
        self._thread: threading.Thread | None = None

    @staticmethod
    def ros_version() -> int:
        """2."""
        return 2

    @staticmethod
    def parse_argv(argv: list[str]) -> list[str]:
        """Initialises rclpy with the arguments; returns those that are not of ROS."""
        rclpy.init(args=argv)
        return list(rclpy.utilities.remove_ros_args(argv))

    # --- time ------------------------------------------------------------------------------------------------------

    def now(self) -> Any:
        """The node's clock as rclpy.time.Time."""
        return self._node.get_clock().now()

    def now_msg(self) -> Any:
        """The node's clock as builtin_interfaces/Time."""
        return self.now().to_msg()

    def to_sec(self, t: Any) -> float:
        """Seconds of a time, a duration or what get_timestamp takes."""
        t = self.get_timestamp(t)
        return t.sec + 1e-9 * t.nanosec if hasattr(t, "nanosec") else 1e-9 * float(t.nanoseconds)

    def create_duration(self, s: float) -> Any:
        """A duration of that many seconds."""
        return rclpy.time.Duration(seconds=s)

    def create_rate(self, hz: float) -> Any:
        """A rate; its sleep() waits for what is left of each period, while the node spins."""
        return self._node.create_rate(hz)

    def create_time(self) -> Any:
        """Time zero."""
        return rclpy.time.Time()

    # --- running ---------------------------------------------------------------------------------------------------

    def spin(self) -> None:
        """Starts calling back in a daemon thread, and returns."""
        if self._thread is not None:
            return
        self._executor = rclpy.executors.MultiThreadedExecutor()
        self._executor.add_node(self._node)
        self._thread = threading.Thread(target=self._executor.spin, name="ral", daemon=True)
        self._thread.start()

    def spin_and_execute(self, function: Callable[..., Any], *arguments: Any) -> None:
        """Spins, calls function(*arguments), then ends the node."""
        self.spin()
        function(*arguments)
        self.shutdown()

    def shutdown(self) -> None:
        """Ends ROS in this process, and waits for the thread of spin."""
        rclpy.try_shutdown()
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join(_JOIN_S)
        self._thread = None

    def on_shutdown(self, callback: Callable[[], None]) -> None:
        """callback() is called when ROS ends in this process."""
        rclpy.get_default_context().on_shutdown(callback)

    def is_shutdown(self) -> bool:
        """Whether ROS has ended in this process."""
        return not rclpy.ok()

    # --- topics and services ---------------------------------------------------------------------------------------

    def publisher(
        self, topic: str, msg_type: Any, queue_size: int = 10, latch: bool = False, *args: Any, **kwargs: Any
    ) -> Any:
        """A publisher that keeps the last queue_size messages; latch: for those who come later, too."""
        quality, name = _quality(queue_size, latch), self._add_namespace_to(topic)
        self._ends.append(self._node.create_publisher(msg_type, name, quality, *args, **kwargs))
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
    ) -> Any:
        """A subscription; latch: to what a latching publisher sent before, too."""
        quality, name = _quality(queue_size, latch), self._add_namespace_to(topic)
        self._ends.append(self._node.create_subscription(msg_type, name, callback, quality, *args, **kwargs))
        return self._ends[-1]

    def service_client(self, name: str, srv_type: Any) -> Any:
        """A client of the service."""
        return self._node.create_client(srv_type, self._add_namespace_to(name))

    def get_topic_name(self, pubsub: Any) -> str:
        """The name of a publisher's or subscriber's topic."""
        return str(pubsub.topic_name)

    def get_published_topics(self) -> list[list[Any]]:
        """All topics as [name, type]."""
        return [[name, types[0]] for name, types in self._node.get_topic_names_and_types()]

    # --- inside ----------------------------------------------------------------------------------------------------

    def _shared_node(self) -> Any:
        return self._node

    def _is_connected(self, end: Any) -> bool:
        name = self.get_topic_name(end)
        publishes = hasattr(end, "get_subscription_count")
        return bool(end.get_subscription_count() if publishes else self._node.count_publishers(name))


def _quality(queue_size: int, latch: bool) -> Any:
    durability = rclpy.qos.DurabilityPolicy
    return rclpy.qos.QoSProfile(
        history=rclpy.qos.HistoryPolicy.KEEP_LAST,
        depth=queue_size,
        durability=durability.TRANSIENT_LOCAL if latch else durability.VOLATILE,
    )
