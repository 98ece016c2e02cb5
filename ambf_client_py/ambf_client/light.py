"""Lights."""

from ._generations import takes_ral
from ._messages import msg
from .base_object import BaseObject
from .kinds import StepLists, register_handle


@register_handle
class Light(BaseObject):
    """A light. Its pose is in its parent's frame; it shines along its x axis."""

    object_type = "LIGHT"
    state_type = msg.LightState
    command_type = msg.LightCmd
    step_lists = StepLists("light_names", "light_cmds", "lights")

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
