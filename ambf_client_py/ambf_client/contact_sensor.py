"""Contact sensors: what touches the body that they sit on."""

from __future__ import annotations

from typing import Any

from ._generations import takes_ral
from ._messages import msg
from ._say import say
from .kinds import register_handle
from .sensor_base import SensorBase, SensorType


@register_handle
class ContactSensor(SensorBase):
    """A contact sensor. Its events are numbered from 0: one for each object that touches its parent."""

    object_type = "CONTACT_SENSOR"
    state_type = msg.ContactSensorState
    command_type = msg.ContactSensorCmd
    sensor_type = SensorType.CONTACT

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)

    def get_num_contact_events(self) -> int:
        """How many objects touch its parent."""
        return len(self._state.contact_events)

    def get_all_contact_event(self) -> list[Any]:
        """All events (ambf_msgs/ContactEvent): the object's identifier, and its contact points in world axes (m)."""
        return list(self._state.contact_events)

    def get_contact_event(self, idx: int) -> Any:
        """One of these events; None where there are fewer."""
        events = self._state.contact_events
        if 0 <= idx < len(events):
            return events[idx]
        say(f"{self._name} has {len(events)} contact events: there is no event {idx}")
        return None

    def get_all_contact_object_names(self) -> list[str]:
        """Identifiers (namespace and ADF block) of all that touches its parent."""
        return [str(event.object_name.data) for event in self._state.contact_events]

    def get_contact_object_name(self, idx: int) -> str | None:
        """Identifier of the object of one event; None where there are fewer."""
        event = self.get_contact_event(idx)
        return None if event is None else str(event.object_name.data)
