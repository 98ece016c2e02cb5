"""Soft bodies: meshes whose vertices are nodes."""

from __future__ import annotations

from typing import Any

from . import _numbers
from ._generations import takes_ral
from ._messages import msg
from .base_object import BaseObject
from .kinds import register_handle


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
