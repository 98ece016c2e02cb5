"""Proximity sensors: single rays and arrays of them."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import rospy

from ._generations import takes_ral
from ._messages import msg
from ._say import say
from .kinds import StepLists, register_handle
from .sensor_base import SensorBase

_CONNECTING_S = 2.0


@register_handle
class Sensor(SensorBase):
    """A sensor with one or more elements (rays), numbered from 0."""

    object_type = "SENSOR"
    state_type = msg.SensorState
    command_type = msg.SensorCmd
    step_lists = StepLists("", "", "sensors")

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
        self._events: Any = None

    def on_event(self, callback: Callable[[Any], None]) -> None:
        """Calls callback(event) with an ambf_msgs/SensorEvent for each edge from now on, in order.

        Of sensors with `matching key` or `success when`. Returns when the simulator knows it, or after 2 s.
        """
        if self._events is not None:
            self._events.unregister()
        # All of them are kept until the callback has seen them: none is lost.
        self._events = rospy.Subscriber(self._topic + "/Events", msg.SensorEvent, callback, queue_size=None)
        deadline = time.monotonic() + _CONNECTING_S
        while self._events.get_num_connections() == 0 and time.monotonic() < deadline and not rospy.is_shutdown():
            time.sleep(0.001)

    def set_inactive(self) -> None:
        """Closes the handle's topics."""
        if self._events is not None:
            self._events.unregister()
        self._events = None
        super().set_inactive()

    def open_topics(self) -> list[tuple[str, str, bool]]:
        """The open topics as (name, type, whether this side publishes)."""
        events = [] if self._events is None or not self._events.type else [self._events]
        return super().open_topics() + [(end.resolved_name, end.type, False) for end in events]

    def get_count(self) -> int:
        """How many elements the sensor has."""
        return int(self._state.count)

    def is_triggered(self, idx: int) -> bool | None:
        """Whether an element senses something."""
        return bool(self._state.triggered[idx]) if self._valid(idx, self._state.triggered) else None

    def get_range(self, idx: int) -> float | None:
        """How far an element looks (m). Where only one range is given, it is that of all."""
        ranges = self._state.range
        if len(ranges) == 1 and 0 <= idx < self.get_count():
            idx = 0
        return float(ranges[idx]) if self._valid(idx, ranges) else None

    def get_measurement(self, idx: int) -> float | None:
        """0 when nothing is within range, towards 1 the nearer it is (1 - distance / range)."""
        return float(self._state.measurement[idx]) if self._valid(idx, self._state.measurement) else None

    def get_all_measurements(self) -> list[float]:
        """The measurements of all elements."""
        return list(self._state.measurement)

    def get_sensed_object(self, idx: int) -> str | None:
        """Name of the body that an element senses; empty when it senses none."""
        objects = self._state.sensed_objects
        return str(objects[idx].data) if self._valid(idx, objects) else None

    def get_parent(self) -> str:
        """Name of the body on which the sensor is mounted."""
        return self.get_parent_name()

    def get_pose(self) -> Any:
        """The sensor's pose in its parent's frame as geometry_msgs/Pose."""
        return self._state.pose

    def _valid(self, idx: int, values: Any) -> bool:
        if 0 <= idx < len(values):
            return True
        say(f"{self._name} has no element {idx}: it has {self.get_count()}, from 0")
        return False
