"""Soft bodies: meshes whose vertices are nodes."""

from __future__ import annotations

import importlib
import threading
import time
from typing import Any

import numpy as np
import rospy
from numpy.typing import NDArray

from . import _numbers
from ._generations import takes_ral
from ._messages import msg
from .base_object import BaseObject
from .kinds import register_handle

_CONNECTING_S = 2.0


@register_handle
class SoftBody(BaseObject):
    """A soft body. Its pose is that of the centre of its nodes; a commanded pose carries its fixed nodes."""

    object_type = "SOFT_BODY"
    state_type = msg.SoftBodyState
    command_type = msg.SoftBodyCmd

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
        self.body_type = "DYNAMIC"
        self._further = threading.Condition()
        self._nodes: Any = None  # the newest messages of /Nodes and /Topology
        self._topology: Any = None
        self._subscribers: dict[str, Any] = {}
        self._forces: Any = None

    def get_mass(self) -> float:
        """Mass of the nodes that are not fixed (kg). 0 until its state has arrived."""
        return float(self._state.mass)

    def set_force(self, fx: Any, fy: float | None = None, fz: float | None = None) -> None:
        """Commands a force on all of it (N, world axes). Without another call it ends after time_out."""
        force = _numbers.triple(fx, fy, fz, "set_force")
        with self._command_lock:
            self._cmd.enable_position_controller = False
            f = self._cmd.wrench.force
            f.x, f.y, f.z = force
            self._send_command()

    def get_nodes(self, timeout: float = 2.0) -> NDArray[np.float64]:
        """Where its nodes are: n x 3, m, world axes. The first call subscribes and waits for them.

        Later calls give the newest that came (at most 100 a second). Empty: none came within timeout seconds.
        """
        self._subscribe("Nodes", importlib.import_module("sensor_msgs.msg").PointCloud2, timeout)
        cloud = self._nodes
        if cloud is None:
            return np.zeros((0, 3))
        return np.frombuffer(cloud.data, np.float32).reshape(-1, 3).astype(np.float64)

    def get_faces(self, timeout: float = 2.0) -> NDArray[np.int64]:
        """Triangles of its surface: m x 3 numbers of nodes. Empty where it has none, or none came within timeout."""
        return self._numbers_of("triangles", 3, timeout)

    def get_lines(self, timeout: float = 2.0) -> NDArray[np.int64]:
        """Links that are no edge of a triangle: m x 2 numbers of nodes."""
        return self._numbers_of("lines", 2, timeout)

    def get_fixed_nodes(self, timeout: float = 2.0) -> list[int]:
        """The nodes that only pose commands move."""
        return [int(node) for node in self._numbers_of("fixed", 1, timeout)[:, 0]]

    def set_node_forces(self, nodes: Any, forces: Any) -> None:
        """Forces on nodes (N, world axes): a number and a force each, besides the other commands.

        Sent once: the simulator's watchdog (0.5 s) ends them unless they are set again. Empty lists end them at once.
        """
        numbers = [int(node) for node in nodes]
        vectors = np.asarray(forces, np.float64).reshape(-1, 3)
        if len(numbers) != len(vectors):
            raise ValueError(f"set_node_forces: {len(numbers)} nodes, but {len(vectors)} forces")
        message = msg.SoftBodyForces(nodes=numbers)
        vector = importlib.import_module("geometry_msgs.msg").Vector3
        message.forces = [vector(*_numbers.triple(each, None, None, "set_node_forces")) for each in vectors]
        if self._forces is None:
            self._forces = rospy.Publisher(
                self._topic + "/NodeForces", msg.SoftBodyForces, queue_size=1, tcp_nodelay=True
            )
            deadline = time.monotonic() + _CONNECTING_S
            while self._forces.get_num_connections() == 0 and time.monotonic() < deadline and not rospy.is_shutdown():
                time.sleep(0.001)
        message.header.stamp = rospy.Time.now()
        self._forces.publish(message)

    def set_inactive(self) -> None:
        """Closes the handle's topics."""
        ends = [*self._subscribers.values(), self._forces]
        self._subscribers = {}
        self._forces = None
        for end in ends:
            if end is not None:
                end.unregister()
        super().set_inactive()

    def open_topics(self) -> list[tuple[str, str, bool]]:
        """The open topics as (name, type, whether this side publishes)."""
        ends = [(end, False) for end in self._subscribers.values()] + [(self._forces, True)]
        return super().open_topics() + [
            (end.resolved_name, end.type, publishes) for end, publishes in ends if end is not None and end.type
        ]

    def _numbers_of(self, field: str, width: int, timeout: float) -> NDArray[np.int64]:
        self._subscribe("Topology", msg.SoftBodyTopology, timeout)
        values = getattr(self._topology, field, ())
        return np.array(values, np.int64).reshape(-1, width)

    def _subscribe(self, topic: str, kind: Any, timeout: float) -> None:
        """Subscribes once, and waits for the first message."""
        field = "_" + topic.lower()

        def take(message: Any) -> None:
            with self._further:
                setattr(self, field, message)
                self._further.notify_all()

        with self._further:
            if topic not in self._subscribers:
                self._subscribers[topic] = rospy.Subscriber(
                    f"{self._topic}/{topic}", kind, take, queue_size=1, tcp_nodelay=True
                )
            self._further.wait_for(lambda: getattr(self, field) is not None, timeout)
