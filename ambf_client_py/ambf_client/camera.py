"""Cameras."""

from ._messages import msg
from .base_object import BaseObject
from .kinds import StepLists, register_handle


@register_handle
class Camera(BaseObject):
    """A camera. Its pose is in its parent's frame: x looks backwards out of the picture, y to the right, z up."""

    object_type = "CAMERA"
    state_type = msg.CameraState
    command_type = msg.CameraCmd
    has_pictures = True
    step_lists = StepLists("camera_names", "camera_cmds", "cameras")

    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
