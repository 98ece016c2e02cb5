"""ambf/TissueRetract-v0: a gripper takes the free edge of a flap of soft tissue and turns it back."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from ambf_core import MODELS, BodyMode, WorldBatch
from numpy.typing import NDArray

from .goals import Expert, Floats, Observation
from .judged import TASKS, JudgedEnv
from .task_world import TaskWorld

JAWS = ("right_gripper-jaw_a", "right_gripper-jaw_b")
OPEN, CLOSED = float(np.float32(0.22)), 0.0  # rad, each jaw; as messages carry them
STRIDE = 0.01  # m of the gripper's target an action at most
START = np.array([0.0, 0.0, 0.09])  # of the gripper's pin, m
LOW, HIGH = np.array([-0.06, -0.05, 0.034]), np.array([0.06, 0.05, 0.12])  # where the target may be, m
ASIDE = np.array([0.03, 0.03, 0.01])  # m from START, at most, where episodes begin
GOALS = np.array([[-0.015, -0.012, 0.03], [0.012, 0.012, 0.048]])  # of the bead, m: low and high
INSIDE = 0.009  # m from the bead to where the expert takes the flap
REACH = 0.022  # m from the bead up to the gripper's pin there: the jaws' tips reach into the flap


class TissueRetract(JudgedEnv):
    """Actions of 100 ms: the way of the gripper's target along x, y, z, and the jaw (negative: closed).

    Jaws that close hold the tissue between them (an actuator, docs/soft_bodies.md). Observed: the gripper's position
    and target (m), both jaws (rad), the pose of the bead in the flap's free edge, its place relative to the gripper,
    and both velocities (m/s). The goal is where the bead shall be: the flap follows.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 10}
    files = (TASKS / "tissue_retract.yaml",)
    ground = MODELS / "world/ring_wire_world.yaml"
    robot = "peg_board_gripper"
    task = "/ambf/env/tissue_retract/retract"
    same_m = 0.005
    tolerance_m = (0.005, 0.005, 0.005)
    steps = 100
    action_size, observation_size = 4, 24

    def find(self) -> None:
        super().find()
        self._gripper, self._bead = self.world.body("right_gripper"), self.world.body("bead")
        self._jaws = [self.world.joint(name) for name in JAWS]

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        world.commands.set_body("right_gripper", [*START, 0, 0, 0, 1], BodyMode.POSE)
        world.commands.set_joints(OPEN, joints=JAWS)
        world.step(1000)

    def start(self) -> None:
        self.world.commands.body_pose[self._gripper, :3] = START + self.np_random.uniform(-ASIDE, ASIDE)
        self.world.step(120)  # near enough: where it begins is drawn, and an action goes on from its target

    def observe(self) -> NDArray[np.float64]:
        state = self.world.state
        gripper, bead = state.body_pose[self._gripper, :3], state.body_pose[self._bead]
        target = self.world.commands.body_pose[self._gripper, :3]
        speeds = state.body_twist[[self._gripper, self._bead], :3]
        return np.concatenate(
            [gripper, target, state.joint_position[self._jaws], bead, bead[:3] - gripper, speeds.ravel()]
        )

    def point(self) -> NDArray[np.float64]:
        return self.world.state.body_pose[self._bead, :3]

    def sample_goal(self) -> NDArray[np.float64]:
        return np.append(self.np_random.uniform(*GOALS), 1.0)

    def command(self, action: Floats) -> None:
        commands = self.world.commands
        target = commands.body_pose[self._gripper]
        target[:3] = np.clip(target[:3] + STRIDE * action[:3].astype(np.float64), LOW, HIGH)
        commands.joint_value[self._jaws] = CLOSED if action[3] < 0 else OPEN

    def expert(self) -> Expert:
        seen: Observation = {}

        def target() -> NDArray[np.float64]:
            return seen["observation"][3:6].astype(np.float64)

        def bead() -> NDArray[np.float64]:
            return seen["achieved_goal"][:3].astype(np.float64)

        def towards(place: NDArray[np.float64], jaw: float) -> Floats:
            way = (place - target()) / STRIDE
            return np.array([*(way / max(1.0, float(np.abs(way).max()))), jaw], np.float32)

        def go(place: NDArray[np.float64], jaw: float, patience: int) -> Iterator[Floats]:
            while np.abs(place - target()).max() > 1e-5:
                yield towards(place, jaw)
            for _ in range(patience):
                yield towards(place, jaw)

        def plan() -> Iterator[Floats]:
            edge = bead() + [-INSIDE, 0.0, REACH]
            yield from go(edge + [0.0, 0.0, 0.015], 1.0, 2)
            yield from go(edge, 1.0, 2)
            yield from go(edge, -1.0, 4)
            while True:  # up first, then over: the flap turns about its hinge
                away = seen["desired_goal"][:3].astype(np.float64) - bead()
                if away[2] > 0.01:
                    away[0] *= 0.3
                yield towards(target() + 0.6 * away, -1.0)

        actions = plan()

        def act(observation: Observation) -> Floats:
            seen.update(observation)
            return next(actions)

        return act
