"""Environments whose success is the verdict of a task's judge (docs/tasks.md), in this process and over ROS."""

from __future__ import annotations

from typing import Any

import numpy as np
from ambf_core import MODELS
from numpy.typing import NDArray

from .goals import GoalEnv, Observation

TASKS = MODELS / "tasks"
UNDONE_M = 0.1  # what a goal that is not done takes off a dense reward


class JudgedEnv(GoalEnv):
    """Goals are four numbers: a point (m, world), and 1: the judge shall call it done. 0 asks for the place alone.

    So rewards are functions of the goals, success is the judge's, and hindsight replay, which wants what was reached,
    learns from places that a piece was carried to.
    """

    task = ""  # a task of the files
    goal_size = 4
    tolerance_m = (0.005, 0.005, 0.004)  # of a place, along x, y, z
    same_m = 0.012  # the judge's places are farther from one another: which one is meant

    def find(self) -> None:
        super().find()
        self._task = self.world.task(self.task)

    def point(self) -> NDArray[np.float64]:
        """Where the piece is: m, world."""
        return super().achieved()

    def is_done(self) -> bool:
        """The judge's verdict on the place where the piece is: one of the goals of the task is done."""
        return bool(self.world.state.goal_done[self._task.goals].any())

    def achieved(self) -> NDArray[np.float64]:
        return np.append(self.point(), float(self.is_done()))

    def is_reached(self, achieved: NDArray[Any], desired: NDArray[Any]) -> NDArray[np.bool_]:
        """Where the last number of `desired` is 1, that of `achieved` says it, if that place is meant."""
        away = np.abs(np.asarray(achieved, np.float64) - np.asarray(desired, np.float64))[..., :3]
        done = (np.asarray(achieved)[..., 3] > 0.5) & (away < self.same_m).all(-1)
        there = (away < self.tolerance_m).all(-1)
        return np.asarray(np.where(np.asarray(desired)[..., 3] > 0.5, done, there))

    def distance(self, achieved: NDArray[Any], desired: NDArray[Any]) -> NDArray[np.float64]:
        achieved, desired = np.asarray(achieved, np.float64), np.asarray(desired, np.float64)
        undone = np.maximum(desired[..., 3] - achieved[..., 3], 0.0)
        return np.asarray(super().distance(achieved[..., :3], desired[..., :3]) + UNDONE_M * undone)

    def _info(self, observation: Observation) -> dict[str, Any]:
        drops, touches, hand_overs, _ = self.world.state.task_counts[self._task.row].tolist()
        return {**super()._info(observation), "drops": drops, "touches": touches, "hand_overs": hand_overs}
