"""One world of a batch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arrays import Commands, Memory, State
from .pictures import Picture, View

if TYPE_CHECKING:
    from .batch import WorldBatch

# What is World's of all worlds.
COMMON = {"bodies", "joints", "joint_limits", "commandable", "masses", "models", "sensors", "elements", "actuators"}
COMMON |= {"cameras", "tasks", "body", "joint", "sensor", "actuator", "task", "counts", "rows"}


class WorldView:
    """One world of a batch: its state and commands, and what does not step it."""

    def __init__(self, batch: WorldBatch, number: int, memory: Memory) -> None:
        self._batch, self._only = batch, np.arange(batch.n) == number
        self._number = number
        self.state, self.commands = State(memory[0]), Commands(memory[1], batch.rows)

    def __getattr__(self, name: str) -> Any:
        """Names, rows and limits: COMMON."""
        if name in COMMON:
            return getattr(self._batch, name)
        raise AttributeError(f"WorldView has no '{name}'")

    def step(self, n: int = 1) -> None:
        """Steps this world alone; a world that diverges says so in `state.diverged`."""
        self._batch._all("advance", (n,), [self._number])

    def picture(self, camera: str | View = "", width: int = 640, height: int = 480, **wanted: bool) -> Picture:
        """As World's."""
        return self._batch.pictures(camera, width, height, worlds=self._only, **wanted)[0]

    def set_parameter(self, name: str, parameter: str, value: ArrayLike) -> None:
        """As World's."""
        self._batch.set_parameter(name, parameter, value, self._only)

    def parameter(self, name: str, parameter: str) -> float | NDArray[np.float64]:
        """As World's."""
        value: float | NDArray[np.float64] = self._batch._all("parameter", (name, parameter), [self._number])[0]
        return value

    def set_gravity(self, gravity: ArrayLike) -> None:
        """As World's."""
        self._batch.set_gravity(gravity, self._only)

    def frozen(self) -> list[str]:
        """As World's."""
        return self._batch.frozen()[self._number]
