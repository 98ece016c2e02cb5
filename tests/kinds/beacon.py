"""Handles of beacons: an object with a pose that blinks."""

from ambf_client import BaseObject, register_handle
from std_msgs.msg import Float64

from ambf_msgs.msg import SensorState


@register_handle
class Beacon(BaseObject):
    """A beacon. Its pose is in its parent's frame."""

    object_type = "BEACON"
    state_type = SensorState
    command_type = Float64

    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)

    def get_phase(self) -> float:
        """Blinks since the start."""
        return float(self._state.measurement[0])

    def get_rate(self) -> float:
        """Blinks a second."""
        return float(self._state.range[0])

    def set_rate(self, rate_hz: float) -> None:
        """Commands the rate."""
        self.set_command(Float64(rate_hz))
