"""The kinds of objects: one handle class for each message type of a State topic, registered by the class's own file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeVar

_HandleClass = TypeVar("_HandleClass", bound=type)
_handles: dict[str, Any] = {}  # message type of the State topic, e.g. ambf_msgs/CameraState: handle class


@dataclass(frozen=True)
class StepLists:
    """A kind's lists in the Step service: fields of its request (empty: takes no commands) and of its answer."""

    names: str
    commands: str
    states: str


def register_handle(handle: _HandleClass) -> _HandleClass:
    """Class decorator: objects whose State topic has the type `handle.state_type` get this handle from now on.

    A later registration for the same type replaces the earlier one.
    """
    _handles[handle.state_type._type] = handle  # type: ignore[attr-defined]
    return handle


def handle_classes() -> dict[str, Any]:
    """All handle classes, by the type of their State topic."""
    return dict(_handles)


def handle_class(message_type: str) -> Any:
    """The handle class for the type of a State topic, e.g. ambf_msgs/CameraState; None where none is registered."""
    return _handles.get(message_type)
