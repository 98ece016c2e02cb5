"""ambf/Arm7Reach-v0: the tip of arm7 shall be at a point. Actions move joint targets, success is within 10 mm."""

from __future__ import annotations

import numpy as np
from ambf_core import MODELS, WorldBatch
from numpy.typing import NDArray

from .goals import Expert, Floats, GoalEnv, Observation
from .task_world import TaskWorld

HOME = np.array([0.0, 0.5, 0.0, -1.2, 0.0, 0.7, 0.0])  # rad: bent, so that the tip can go all ways
STRIDE = 0.05  # rad of a joint's target an action at most
AXES = np.array([[0, 0, 1], [0, 1, 0], [0, 0, 1], [0, -1, 0], [0, 0, 1], [0, 1, 0], [0, 0, 1]])  # in link1 .. link7


class Arm7Reach(GoalEnv):
    """50 actions of 20 ms. Observed: 7 joint angles (rad), 7 speeds (rad/s), 7 targets (rad).

    Goals lie within 80 mm of the tip's first place along each axis, and never within 20 mm of it.
    """

    files = (MODELS / "multi-bodies/robots/arm7.yaml",)
    ground = MODELS / "world/arm7_world.yaml"
    robot = "arm7"
    action_size, observation_size = 7, 21

    def find(self) -> None:
        self._low, self._high = self.world.joint_limits.T
        self._links = [self.world.body(f"link{i}") for i in range(1, 8)]
        self._tip = self._links[-1]

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        world.commands.set_joints(HOME.astype(np.float32))
        world.step(1500)

    def observe(self) -> NDArray[np.float64]:
        state = self.world.state
        return np.concatenate([state.joint_position, state.joint_velocity, self.world.commands.joint_value])

    def achieved(self) -> NDArray[np.float64]:
        return self.world.state.body_pose[self._tip, :3]

    def sample_goal(self) -> NDArray[np.float64]:
        while True:
            away = self.np_random.uniform(-0.08, 0.08, 3)
            if np.linalg.norm(away) > 0.02:
                return self.achieved() + away

    def command(self, action: Floats) -> None:
        targets = self.world.commands.joint_value + STRIDE * action
        # As messages carry them: the same actions give the same states over ROS.
        self.world.commands.set_joints(np.clip(targets, self._low, self._high).astype(np.float32))

    def expert(self) -> Expert:
        def act(observation: Observation) -> Floats:
            """Damped least squares by the Jacobian of the arm as it stands."""
            away = observation["desired_goal"].astype(np.float64) - observation["achieved_goal"]
            pose = self.world.state.body_pose[self._links]
            turned = np.cross(pose[:, 3:6], AXES)
            axes = AXES + 2 * (pose[:, 6:] * turned + np.cross(pose[:, 3:6], turned))
            jacobian = np.cross(axes, self.achieved() - pose[:, :3])
            square = jacobian.T @ jacobian + 1e-4 * np.eye(3)
            strides = jacobian @ np.linalg.solve(square, away) / STRIDE
            return np.asarray(np.clip(strides, -1, 1), np.float32)

        return act
