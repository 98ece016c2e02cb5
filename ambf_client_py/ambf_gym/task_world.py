"""What environments use of a world, in this process or over ROS."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from ambf_core import Commands, Picture, State, View
from ambf_core.tasks import Task
from numpy.typing import NDArray


class TaskWorld(Protocol):
    """What environments use of a world, be it in this process or over ROS; World says what each is."""

    state: State
    commands: Commands
    bodies: list[str]
    joints: list[str]
    sensors: list[str]
    actuators: list[str]
    elements: list[slice]
    rows: dict[str, dict[str, int]]
    joint_limits: NDArray[np.float64]
    commandable: NDArray[np.bool_]
    masses: NDArray[np.float64]
    tasks: list[Task]

    def body(self, name: str) -> int: ...
    def joint(self, name: str) -> int: ...
    def sensor(self, name: str) -> int: ...
    def actuator(self, name: str) -> int: ...
    def task(self, name: str) -> Task: ...
    def step(self, n: int = 1) -> None: ...
    def picture(self, camera: str | View = "", width: int = 640, height: int = 480) -> Picture: ...
    def snapshot(self) -> str: ...
    def restore(self, name: str) -> None: ...
    def frozen(self) -> list[str]: ...
    def close(self) -> None: ...
