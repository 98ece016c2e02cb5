"""Cameras."""

from __future__ import annotations

import importlib
import threading
from typing import Any

import numpy as np
import rospy
from numpy.typing import NDArray
from ros_abstraction_layer._interrupt import raise_if_interrupted

from ._generations import takes_ral
from ._messages import Message, Stamp, msg, stamp_of
from .base_object import BaseObject
from .kinds import StepLists, register_handle

_FIRST_PICTURE = 10.0  # s: the simulator sets up its drawing when the first picture is wanted


class _Stream:
    """One topic of pictures; keeps the newest."""

    def __init__(self, topic: str) -> None:
        kind = importlib.import_module("sensor_msgs.msg").Image
        self._arrived = threading.Condition()
        self._newest: Message = None
        self.subscriber: Any = rospy.Subscriber(topic, kind, self._take, queue_size=1, buff_size=1 << 24)

    def _take(self, picture: Message) -> None:
        with self._arrived:
            self._newest = picture
            self._arrived.notify_all()

    def wait_for(self, stamp: Stamp, timeout: float) -> Message:
        """The newest picture, once there is one of that time or later; None: not within timeout seconds."""
        with self._arrived:
            shown = self._arrived.wait_for(
                lambda: self._newest is not None and stamp_of(self._newest) >= stamp, timeout
            )
            return self._newest if shown else None


@register_handle
class Camera(BaseObject):
    """A camera. Its pose is in its parent's frame: x looks backwards out of the picture, y to the right, z up."""

    object_type = "CAMERA"
    state_type = msg.CameraState
    command_type = msg.CameraCmd
    has_pictures = True
    step_lists = StepLists("camera_names", "camera_cmds", "cameras")

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
        self._streams: dict[str, _Stream] = {}

    def image(self, timeout: float = _FIRST_PICTURE) -> NDArray[np.uint8]:
        """What the camera sees, as [row, column, (red, green, blue)] from the upper left, 0 to 255.

        Of the moment that the handle's state shows, or later: after a step, of that step. Waits up to timeout seconds,
        and raises TimeoutError where no such picture comes. The camera's file must say `publish image: true`.
        """
        picture = self._picture("ImageData", "publish image", timeout)
        rows = np.frombuffer(picture.data, np.uint8).reshape(picture.height, picture.step)
        return rows[:, : 3 * picture.width].reshape(picture.height, picture.width, 3).copy()

    def depth(self, timeout: float = _FIRST_PICTURE) -> NDArray[np.float32]:
        """How far what the camera sees is ahead of it, along its axis, as [row, column] in m; NaN where nothing is.

        When, and what it raises: see image(). The camera's file must say `publish depth: true`.
        """
        picture = self._picture("depth/ImageData", "publish depth", timeout)
        rows = np.frombuffer(picture.data, ">f4" if picture.is_bigendian else "<f4")
        return rows.reshape(picture.height, picture.step // 4)[:, : picture.width].astype(np.float32)

    def set_inactive(self) -> None:
        """Closes the handle's topics."""
        for stream in self._streams.values():
            stream.subscriber.unregister()
        self._streams.clear()
        super().set_inactive()

    def open_topics(self) -> list[tuple[str, str, bool]]:
        """The open topics as (name, type, whether this side publishes)."""
        streams = [stream.subscriber for stream in self._streams.values()]
        return [*super().open_topics(), *((each.resolved_name, each.type, False) for each in streams if each.type)]

    def _picture(self, topic: str, key: str, timeout: float) -> Message:
        if topic not in self._streams:
            self._streams[topic] = _Stream(f"{self._topic}/{topic}")
        picture = self._streams[topic].wait_for(stamp_of(self._state), timeout)
        if picture is None:
            raise_if_interrupted()
            raise TimeoutError(
                f"{self._topic}/{topic} sent no picture of the state's time within {timeout:g} s. Does the camera's "
                f"file say `{key}: true`?"
            )
        return picture
