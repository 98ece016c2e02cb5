"""Tasks of a running simulator: the state that belongs to a step, from their topics."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import rospy
from ambf_client import SimulatorUnavailable
from ambf_client._messages import msg
from ambf_core.tasks import Task

_PATIENCE = 10.0  # s of wall time that a state may take


class TaskTopics:
    """When the steps of a request are done each task publishes; at rest it repeats its state (docs/ros.md)."""

    def __init__(self, tasks: Sequence[Task], topics: Mapping[str, str]) -> None:
        """topics: of all objects, by full name. Listens until close()."""
        self._tasks = list(tasks)
        self._newest: dict[str, Any] = {}
        self._news = threading.Condition()
        self._subscribers = [
            rospy.Subscriber(f"{topics[task.name]}/State", msg.TaskState, self._take, callback_args=task.name)
            for task in self._tasks
        ]

    def forget(self) -> None:
        """What came before counts no longer."""
        with self._news:
            self._newest.clear()

    def show(self, sim_step: int, arrays: Mapping[str, np.ndarray[Any, Any]]) -> None:
        """Writes task_..., goal_... and piece_... of that step. Raises SimulatorUnavailable where it does not come."""
        for task in self._tasks:
            state = self._of(task.name, sim_step)
            if tuple(state.goals) != task.goal_names:
                raise ValueError(f"the simulator's {task.name} has other goals: start it with the files of this task")
            done = np.array(state.done, np.bool_)
            arrays["task_success"][task.row], arrays["task_done"][task.row] = state.success, done.sum()
            arrays["task_time"][task.row] = state.time
            arrays["task_counts"][task.row] = state.drops, state.touches, state.hand_overs, state.wrong_order
            arrays["goal_done"][task.goals] = done
            arrays["goal_error"][task.goals] = np.stack([state.distance, state.angle], axis=-1)
            arrays["piece_held_by"][task.pieces] = [_bits(held_by, task.holder_names) for held_by in state.held_by]

    def close(self) -> None:
        """Listens no longer."""
        for each in self._subscribers:
            each.unregister()

    def _take(self, state: Any, name: str) -> None:
        with self._news:
            self._newest[name] = state
            self._news.notify_all()

    def _of(self, name: str, sim_step: int) -> Any:
        end = time.monotonic() + _PATIENCE
        with self._news:
            while name not in self._newest or self._newest[name].sim_step != sim_step:
                if time.monotonic() > end:
                    raise SimulatorUnavailable(f"no state of the task {name} of step {sim_step}")
                self._news.wait(0.5)
            return self._newest[name]


def _bits(names: str, holders: Sequence[str]) -> int:
    """Of "a, b": bit i is set where holder i is one of them."""
    held = [each for each in names.split(", ") if each]
    return sum(1 << i for i, holder in enumerate(holders) if any(f"/{each}".endswith(f"/{holder}") for each in held))
