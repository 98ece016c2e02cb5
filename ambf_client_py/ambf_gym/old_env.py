"""ambf/AmbfEnv-v0: the seven actions and thirteen observations of the original's AmbfEnv, in a world that repeats."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from ambf_core import BodyMode, WorldBatch
from gymnasium import spaces
from numpy.typing import NDArray

from .goals import Expert, Floats
from .peg_board import HIGH, JAWS, LOW, OPEN, START, PegBoardEnv
from .task_world import TaskWorld

TURN = 0.5  # rad, of roll, pitch and yaw at most
LOWEST, HIGHEST = np.array([*LOW, -TURN, -TURN, -TURN, 0.0]), np.array([*HIGH, TURN, TURN, TURN, OPEN])
COST_OF_ACTION = 4.0  # the original's


class AmbfEnv(PegBoardEnv):
    """Actions of 20 ms: where the gripper shall be, x, y, z, roll, pitch, yaw (m, rad), and its jaws (rad), each from
    -1, the low end of what it may be, to 1, the high one.

    Observed is one vector, no dict of goals: x, y, z, roll, pitch, yaw of the gripper and of the board, and how many
    steps the action took. The reward is the original's: how much nearer the gripper came to the board (m), less 4
    times the square of what is commanded (m, rad). It ends with its limit of time; success is to be within 60 mm.
    """

    steps = 20
    action_size, observation_size = 7, 13
    threshold_m = 0.06
    metadata = {**PegBoardEnv.metadata, "render_fps": 50}

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        if self._observed == "both":
            self.close()
            raise ValueError("observation='both': this environment has one vector, 'state', or 'pictures'")
        self.observation_space = cast(spaces.Dict, self.observation_space)["observation"]

    def find(self) -> None:
        super().find()
        self._board = self.world.body("peg_board")
        self._spent = 0.0  # square of what is commanded

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        super().settle(world)
        world.commands.set_joints(0.0, joints=JAWS)
        world.step(200)

    def start(self) -> None:
        self._away, self._taken = self._distance(), 0

    def observe(self) -> NDArray[np.float64]:
        pose = self.world.state.body_pose
        return np.concatenate([_six(pose[self._gripper]), _six(pose[self._board]), [self._taken]])

    def achieved(self) -> NDArray[np.float64]:
        return self.world.state.body_pose[self._gripper, :3]

    def sample_goal(self) -> NDArray[np.float64]:
        return self.world.state.body_pose[self._board, :3]

    def command(self, action: Floats) -> None:
        wanted = LOWEST + (HIGHEST - LOWEST) * (action.astype(np.float64) + 1.0) / 2.0
        self.world.commands.set_body(self._gripper, [*wanted[:3], *_quaternion(*wanted[3:6])], BodyMode.POSE)
        self.world.commands.joint_value[self._jaws] = np.float32(wanted[6])
        self._spent, self._taken = float(wanted @ wanted), self.steps

    def begin(self, seed: int | None, options: dict[str, Any] | None) -> tuple[Any, dict[str, Any]]:
        observation, info = super().begin(seed, options)
        return observation["observation"], info

    def outcome(self) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        observation, reward, terminated, truncated, info = super().outcome()
        return observation["observation"], reward, terminated, truncated, info

    @property
    def compute_reward(self) -> Any:
        """There is none, which is how programs know environments with goals from others."""
        raise AttributeError("the reward of AmbfEnv is no function of goals")

    def expert(self) -> Expert:
        target = np.array([0.0, float(START[1]), LOW[2], 0, 0, 0, 0])
        action = np.clip(2.0 * (target - LOWEST) / (HIGHEST - LOWEST) - 1.0, -1.0, 1.0).astype(np.float32)
        return lambda observation: action.copy()

    def _reward(self, observation: Any, info: Any) -> float:
        before, self._away = self._away, self._distance()
        return before - self._away - COST_OF_ACTION * self._spent

    def _distance(self) -> float:
        return float(np.linalg.norm(self.achieved() - self.sample_goal()))


def _six(pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """x, y, z, roll, pitch, yaw: of turns about the fixed x, y and z, in this order."""
    x, y, z, w = pose[3:]
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1.0, 1.0))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return np.array([*pose[:3], roll, pitch, yaw])


def _quaternion(roll: float, pitch: float, yaw: float) -> NDArray[np.float64]:
    c, s = np.cos(np.array([roll, pitch, yaw]) / 2), np.sin(np.array([roll, pitch, yaw]) / 2)
    return np.array(
        [
            s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
            c[0] * s[1] * c[2] + s[0] * c[1] * s[2],
            c[0] * c[1] * s[2] - s[0] * s[1] * c[2],
            c[0] * c[1] * c[2] + s[0] * s[1] * s[2],
        ]
    )
