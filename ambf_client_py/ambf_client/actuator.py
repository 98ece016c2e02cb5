"""Actuators: constraints that hold a body and let it go again."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import rospy
from numpy.typing import NDArray

from . import _numbers
from ._generations import takes_ral
from ._messages import msg
from .base_object import BaseObject
from .kinds import StepLists, register_handle


@register_handle
class Actuator(BaseObject):
    """An actuator on a body, which can hold another one."""

    object_type = "ACTUATOR"
    state_type = msg.ActuatorState
    command_type = msg.ActuatorCmd
    step_lists = StepLists("actuator_names", "actuator_cmds", "actuators")

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
        self._arrived = threading.Condition()
        self._forces: Any = None  # the newest message of /forces
        self._forces_subscriber: Any = None

    def actuate(self, obj_name: str, pose: Any = None) -> None:
        """Holds the body of that name: where it is, or with `pose` (see set_pose) as the actuator's place in it."""
        with self._command_lock:
            command = self._cmd
            command.actuate = True
            command.use_sensor_data = False
            command.sensor_identifier.data = ""
            command.body_name.data = obj_name
            command.use_offset = pose is not None
            if pose is not None:
                (p, q), offset = _numbers.pose(pose, "actuate"), command.body_offset
                offset.position.x, offset.position.y, offset.position.z = p
                offset.orientation.x, offset.orientation.y, offset.orientation.z, offset.orientation.w = q
            self._send_command()

    def actuate_from_sensor_data(self, sensor_identifer: str) -> None:
        """Holds whatever the sensor of that identifier senses."""
        with self._command_lock:
            command = self._cmd
            command.actuate = True
            command.use_sensor_data = True
            command.sensor_identifier.data = sensor_identifer
            command.body_name.data = ""
            command.use_offset = False
            self._send_command()

    def deactuate(self) -> None:
        """Lets go."""
        with self._command_lock:
            self._cmd.actuate = False
            self._cmd.use_sensor_data = False
            self._cmd.sensor_identifier.data = ""
            self._cmd.body_name.data = ""
            self._send_command()

    def is_actuated(self) -> bool:
        """Whether it holds something."""
        return bool(self._state.actuated)

    def get_force(self, timeout: float = 2.0) -> NDArray[np.float64]:
        """The force (N, world axes) on all that it holds, pulls, cuts or sews.

        The first call of this, get_bites(), get_stitches() and get_tied() subscribes, and waits up to timeout seconds;
        later ones give the newest that came. Zeros where none came.
        """
        message = self._get_forces(timeout)
        return np.zeros(3) if message is None else np.array((message.force.x, message.force.y, message.force.z))

    def get_bites(self, timeout: float = 2.0) -> int:
        """How often a needle's thread goes into tissue and comes out of it."""
        return int(getattr(self._get_forces(timeout), "bites", 0))

    def get_stitches(self, timeout: float = 2.0) -> int:
        """In how many places of tissue a needle's thread is, those within included."""
        return int(getattr(self._get_forces(timeout), "stitches", 0))

    def get_tied(self, timeout: float = 2.0) -> int:
        """In how many of these places it is in a knot, and slides no more."""
        return int(getattr(self._get_forces(timeout), "tied", 0))

    def set_inactive(self) -> None:
        """Closes the handle's topics."""
        subscriber, self._forces_subscriber = self._forces_subscriber, None
        if subscriber is not None:
            subscriber.unregister()
        super().set_inactive()

    def open_topics(self) -> list[tuple[str, str, bool]]:
        """The open topics as (name, type, whether this side publishes)."""
        end = self._forces_subscriber
        own = [] if end is None or not end.type else [(end.resolved_name, end.type, False)]
        return super().open_topics() + own

    def _get_forces(self, timeout: float) -> Any:
        def take(message: Any) -> None:
            with self._arrived:
                self._forces = message
                self._arrived.notify_all()

        with self._arrived:
            if self._forces_subscriber is None:
                self._forces_subscriber = rospy.Subscriber(
                    self._topic + "/forces", msg.ActuatorForces, take, queue_size=1, tcp_nodelay=True
                )
            self._arrived.wait_for(lambda: self._forces is not None, timeout)
            return self._forces

    def _start_pose_command(self) -> None:
        raise TypeError(f"{self._name} is an actuator: it moves with its parent, not by commands")
