"""The ROS node of a client, as programs of AMBF 3.0 use it."""

from __future__ import annotations

from typing import Any

import rospy
from ros_abstraction_layer._node import become_node
from ros_abstraction_layer.ros1 import ral as Ros1  # the client is one of ROS 1 whatever ROS_VERSION says

from ._say import say
from .kinds import handle_classes


class Node:
    """A client's `ral`: None until connect(), unless it was given one; clients may share it."""

    def __init__(self, client_name: str, ral: Any) -> None:
        self._client_name = client_name
        self.ral = ral

    def get_ral(self) -> Any:
        """The client's node (ros_abstraction_layer); None until connect()."""
        return self.ral

    def is_shutdown(self) -> bool:
        """Whether the node has ended, or is ending."""
        return bool(rospy.is_shutdown() or rospy.core.is_shutdown_requested())

    def create_rate(self, hz: float) -> rospy.Rate:
        """A rate; its sleep() waits for what is left of each period."""
        return self._connected_ral().create_rate(hz)

    def get_time(self) -> float:
        """The node's clock (s since 1970); simulated time is World.get_sim_time()."""
        layer = self._connected_ral()
        return float(layer.to_sec(layer.now()))

    @property
    def object_types(self) -> list[str]:
        """The kinds of objects that there are handles for: State topics of ambf_msgs, without State."""
        return sorted(kind.rpartition("/")[2].removesuffix("State") for kind in self.msg_related_classes)

    @property
    def msg_related_classes(self) -> dict[str, Any]:
        """The handle classes by the type of their State topic, e.g. ambf_msgs/RigidBodyState."""
        return handle_classes()

    def _become_node(self) -> None:
        if self.ral is not None and not isinstance(self.ral, Ros1):
            raise TypeError(f"a Client's ral must be one of ros_abstraction_layer over ROS 1, not {self.ral!r}")
        become_node(self._client_name, say)
        if self.ral is None:
            self.ral = Ros1(self._client_name)

    def _connected_ral(self) -> Any:
        if self.ral is None:
            raise RuntimeError("the client has no node yet: call connect() first")
        return self.ral
