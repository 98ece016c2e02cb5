"""A ring on the peg board and a gripper above it. It is grasped by friction between the jaws, as in the default scene.

ambf/RingLift-v0: the ring shall be at a point in the air. ambf/PegTransfer-v0: it shall be on another peg.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from ambf_core import MODELS, BodyMode, WorldBatch
from numpy.typing import NDArray

from .goals import Expert, Floats, GoalEnv, Observation
from .judged import TASKS, JudgedEnv
from .task_world import TaskWorld

JAWS = ("right_gripper-jaw_a", "right_gripper-jaw_b")
OPEN, CLOSED = float(np.float32(0.22)), 0.0  # rad, each jaw; as messages carry them
STRIDE = 0.01  # m of the gripper's target an action at most
START = np.array([0.0, 0.0, 0.1])  # of the gripper's pin, m: over all pegs
LOW, HIGH = np.array([-0.08, -0.09, 0.035]), np.array([0.08, 0.09, 0.15])  # where the target may be, m
PEGS = np.array([[-0.03, 0.031], [-0.03, 0.057], [0.0, 0.026], [0.0, 0.062], [0.03, 0.031], [0.03, 0.057]])  # x, y, m
ON_BOARD = 0.029  # m: where a ring lies
OTHERS = ("triangle1", "triangle4", "triangle5", "ring3", "ring6", "left_jaw_a", "left_jaw_b", "left_gripper")


class PegBoardEnv(GoalEnv):
    """Actions of 100 ms: the way of the gripper's target along x, y, z, and the jaw (negative: closed).

    Observed: the gripper's position, velocity and target (m, m/s), both jaws (rad), the ring's position, orientation,
    velocity, and position relative to the gripper.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 10}
    files: tuple[Path, ...] = (MODELS / "multi-bodies/puzzles/peg_transfer.yaml",)
    ground = MODELS / "world/peg_transfer_world.yaml"
    without = (*OTHERS, *(f"hole{i}" for i in range(1, 7)), *(f"goal{i}" for i in range(7, 13)))
    robot = "peg_board_gripper"
    steps = 100
    action_size, observation_size = 4, 24

    def find(self) -> None:
        self._gripper, self._ring = self.world.body("right_gripper"), self.world.body("ring2")
        self._jaws = [self.world.joint(name) for name in JAWS]

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        world.commands.set_body("right_gripper", [*START, 0, 0, 0, 1], BodyMode.POSE)
        world.commands.set_joints(OPEN, joints=JAWS)
        world.step(1000)

    def observe(self) -> NDArray[np.float64]:
        state = self.world.state
        gripper, ring = state.body_pose[self._gripper, :3], state.body_pose[self._ring]
        target = self.world.commands.body_pose[self._gripper, :3]
        speeds = state.body_twist[[self._gripper, self._ring], :3]
        jaws = state.joint_position[self._jaws]
        return np.concatenate([gripper, target, jaws, ring, ring[:3] - gripper, speeds.ravel()])

    def achieved(self) -> NDArray[np.float64]:
        return self.world.state.body_pose[self._ring, :3]

    def command(self, action: Floats) -> None:
        commands = self.world.commands
        target = commands.body_pose[self._gripper]
        target[:3] = np.clip(target[:3] + STRIDE * action[:3].astype(np.float64), LOW, HIGH)
        commands.joint_value[self._jaws] = CLOSED if action[3] < 0 else OPEN

    def expert(self) -> Expert:
        plan = _Plan(self._after_grasp)

        def act(observation: Observation) -> Floats:
            plan.seen = observation
            return next(plan.actions)

        return act

    def _after_grasp(self, plan: _Plan) -> Iterator[Floats]:
        raise NotImplementedError


class RingLift(PegBoardEnv):
    """ambf/RingLift-v0: the ring comes within 10 mm of a point in the air."""

    def sample_goal(self) -> NDArray[np.float64]:
        return self.np_random.uniform([-0.05, -0.05, 0.08], [0.05, 0.05, 0.12])

    def _after_grasp(self, plan: _Plan) -> Iterator[Floats]:
        while True:
            yield plan.towards(plan.goal - plan.ring + plan.gripper, closed=True)


class PegTransfer(JudgedEnv, PegBoardEnv):
    """ambf/PegTransfer-v0: the ring lies on one of the six pegs at the other side, let go for half a second."""

    files = (*PegBoardEnv.files, TASKS / "any_peg.yaml")
    task = "/ambf/env/any_peg"

    def sample_goal(self) -> NDArray[np.float64]:
        return np.array([*self.np_random.choice(PEGS), ON_BOARD, 1.0])

    def _after_grasp(self, plan: _Plan) -> Iterator[Floats]:
        held = plan.ring - plan.gripper
        over = np.array([*(plan.goal - held)[:2], START[2]])
        yield from plan.go(over, closed=True)
        low = np.array([*over[:2], plan.goal[2] + _Plan.REACH + 0.003])
        yield from plan.go(low, closed=True)
        yield from plan.wait(4, closed=False)
        yield from plan.go(over, closed=False)
        while True:
            yield plan.stay(closed=False)


class _Plan:
    """How a ring is picked off its peg: one jaw goes into the hole, the other outside; then what the task wants."""

    RADIUS = 0.009  # m of the ring, to the middle of its tube
    REACH = 0.017  # m from the ring's middle up to the gripper's pin: the tips of the jaws reach below the tube

    def __init__(self, after_grasp: Callable[[_Plan], Iterator[Floats]]) -> None:
        self.seen: Observation = {}
        self.actions = self._all(after_grasp)

    @property
    def gripper(self) -> NDArray[np.float64]:
        return self.seen["observation"][0:3].astype(np.float64)

    @property
    def target(self) -> NDArray[np.float64]:
        return self.seen["observation"][3:6].astype(np.float64)

    @property
    def ring(self) -> NDArray[np.float64]:
        return self.seen["achieved_goal"][:3].astype(np.float64)

    @property
    def goal(self) -> NDArray[np.float64]:
        return self.seen["desired_goal"][:3].astype(np.float64)

    def towards(self, place: NDArray[np.float64], closed: bool) -> Floats:
        """The action that brings the target nearer, in a straight line."""
        way = (place - self.target) / STRIDE
        way /= max(1.0, float(np.abs(way).max()))
        return np.array([*way, -1.0 if closed else 1.0], np.float32)

    def stay(self, closed: bool) -> Floats:
        return self.towards(self.target, closed)

    def wait(self, actions: int, closed: bool) -> Iterator[Floats]:
        for _ in range(actions):
            yield self.stay(closed)

    def go(self, place: NDArray[np.float64], closed: bool) -> Iterator[Floats]:
        while np.abs(place - self.target).max() > 1e-5:
            yield self.towards(place, closed)
        yield from self.wait(2, closed)

    def _all(self, after_grasp: Callable[[_Plan], Iterator[Floats]]) -> Iterator[Floats]:
        x, y, z = self.ring
        side = y - self.RADIUS
        over = np.array([x, side, START[2]])
        yield from self.go(over, closed=False)
        yield from self.go(np.array([x, side, z + self.REACH]), closed=False)
        yield from self.wait(3, closed=True)
        yield from self.go(over, closed=True)
        yield from after_grasp(self)
