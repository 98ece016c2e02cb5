"""Ghost objects: shapes that feel what overlaps them and push nothing."""

from __future__ import annotations

from typing import Any

from ._generations import takes_ral
from ._messages import msg
from ._say import say
from .base_object import BaseObject
from .kinds import register_handle


@register_handle
class GhostObject(BaseObject):
    """A ghost object. Its pose is in the frame of its parent's centre of mass."""

    object_type = "GHOST"
    state_type = msg.GhostObjectState
    command_type = msg.GhostObjectCmd

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
        self.body_type = "KINEMATIC"

    def get_all_sensed_obj_names(self) -> list[str]:
        """Identifiers (namespace and ADF block) of all that overlaps it: bodies, its parent among them, and ghosts."""
        return [str(each.data) for each in self._state.sensed_objects]

    def get_sensed_obj_name(self, idx: int) -> str | None:
        """One of these identifiers, counted from 0; None where there are fewer."""
        names = self.get_all_sensed_obj_names()
        if 0 <= idx < len(names):
            return names[idx]
        say(f"{self._name} senses {len(names)} objects: there is no object {idx}")
        return None

    def get_pose(self) -> Any:
        """Its pose in the frame of its parent's centre of mass as geometry_msgs/Pose."""
        return self._state.pose

    def _start_pose_command(self) -> None:
        raise TypeError(f"{self._name} is a ghost object: it moves with its parent, not by commands")
