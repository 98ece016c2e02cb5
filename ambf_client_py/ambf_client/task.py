"""Tasks: pieces and where they belong, judged by the simulator in every step."""

from __future__ import annotations

import time
from typing import Any

from ._generations import takes_ral
from ._messages import msg
from .base_object import BaseObject
from .kinds import register_handle


@register_handle
class Task(BaseObject):
    """A task. Its pose is in its parent's frame; places of goals that name no object are in that frame, too."""

    object_type = "TASK"
    state_type = msg.TaskState
    command_type = msg.TaskCmd

    @takes_ral
    def __init__(self, a_name: str, time_out: float = 0.1) -> None:
        super().__init__(a_name, time_out)
        self.body_type = "KINEMATIC"

    @property
    def state(self) -> Any:
        """The newest ambf_msgs/TaskState."""
        return self._state

    def is_done(self) -> bool:
        """Whether all goals are done."""
        return bool(self._state.success)

    def get_progress(self) -> float:
        """The share of goals that are done, 0 to 1."""
        return float(self._state.progress)

    def get_time(self) -> float:
        """Simulated time from loading or the last reset to the first success, or to now (s)."""
        return float(self._state.time)

    def get_goals(self) -> dict[str, bool]:
        """Each goal by its name, and whether it is done."""
        return {str(name): bool(done) for name, done in zip(self._state.goals, self._state.done, strict=True)}

    def get_drops(self) -> int:
        """How often a piece was dropped."""
        return int(self._state.drops)

    def get_touches(self) -> int:
        """How often a piece touched what it must not."""
        return int(self._state.touches)

    def get_hand_overs(self) -> int:
        """How often a piece was handed over."""
        return int(self._state.hand_overs)

    def get_holders(self, piece: str) -> list[str]:
        """Names of those who hold a piece (full name, or the part behind its namespace). Raises LookupError."""
        for name, holders in zip(self._state.pieces, self._state.held_by, strict=True):
            if name == piece or name.rsplit("/", 1)[-1] == piece:
                return [each for each in str(holders).split(", ") if each]
        raise LookupError(f"{self._name} has no piece {piece!r}: it has {', '.join(self._state.pieces)}")

    def wait_for_success(self, timeout: float = 60.0) -> bool:
        """Waits until all goals are done. False: not within timeout seconds (wall time).

        Not for a script that steps the world: it reads is_done() after each step.
        """
        deadline = time.monotonic() + timeout
        while not self.is_done():
            if time.monotonic() > deadline:
                return False
            time.sleep(0.005)
        return True

    def get_pose(self) -> Any:
        """Its pose in its parent's frame as geometry_msgs/Pose."""
        return self._state.pose

    def _start_pose_command(self) -> None:
        raise TypeError(f"{self._name} is a task: it obeys no commands")


class TaskAccess:
    """What a client offers for tasks."""

    def get_task(self, name: Any, timeout: float = 10.0) -> Task:
        """The handle of a task, as wait_for gives it. Raises TypeError where the name is no task's."""
        handle = self.wait_for(name, timeout)  # type: ignore[attr-defined]
        if not isinstance(handle, Task):
            raise TypeError(f"'{handle.get_name()}' is no task")
        return handle
