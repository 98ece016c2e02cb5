"""Tasks of a world: their names, and which rows of the arrays are theirs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .arrays import find


@dataclass(frozen=True)
class Task:
    """One task: its goals, pieces and holders in the order of their rows and bits."""

    name: str  #: full name
    row: int  #: of state.task_...
    goals: slice  #: rows of state.goal_...
    pieces: slice  #: rows of state.piece_...
    goal_names: tuple[str, ...]
    piece_names: tuple[str, ...]
    holder_names: tuple[str, ...]


class TasksOfWorld:
    """What a World offers for tasks."""

    tasks: list[Task]  #: by row of state.task_...
    rows: dict[str, dict[str, int]]

    def task(self, name: str) -> Task:
        """A task by its full name, or the only one that contains it. Raises LookupError."""
        return self.tasks[find(self.rows["tasks"], name)]


def tasks_of(structure: dict[str, Any]) -> list[Task]:
    """From (name, goals, pieces, holders) of each, in their order; leaves their names in the structure."""
    tasks: list[Task] = []
    goal = piece = 0
    for row, (name, goals, pieces, holders) in enumerate(structure["tasks"]):
        own = slice(goal, goal + len(goals)), slice(piece, piece + len(pieces))
        tasks.append(Task(name, row, *own, tuple(goals), tuple(pieces), tuple(holders)))
        goal, piece = own[0].stop, own[1].stop
    structure["tasks"] = [task.name for task in tasks]
    return tasks


def rows_of(tasks: Sequence[Task]) -> dict[str, int]:
    """How many goals and pieces they have in all."""
    return {"goals": tasks[-1].goals.stop, "pieces": tasks[-1].pieces.stop} if tasks else {"goals": 0, "pieces": 0}
