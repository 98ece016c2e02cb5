"""ambf/BiPegTransfer-v0: a ring of the peg board goes from hand to hand in the air, then onto another peg."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from ambf_core import BodyMode, WorldBatch
from numpy.typing import NDArray

from .goals import Expert, Floats, Observation
from .judged import TASKS, JudgedEnv
from .peg_board import CLOSED, ON_BOARD, OPEN, PEGS, PegBoardEnv
from .task_world import TaskWorld

SIDES = ("left", "right")
STRIDE, TURN = 0.01, 0.1  # m and rad of a hand's target an action at most
STARTS = np.array([[0.0, -0.1, 0.15], [0.0, 0.1, 0.15]])  # of the grippers' pins, m: beside the board
LOW, HIGH = np.array([-0.08, -0.12, 0.035]), np.array([0.08, 0.12, 0.2])  # where targets may be, m
MOST = 0.6  # rad: so far a target may be turned
WALL = 0.009  # m from a ring's middle to the wall that is held
PIN = 0.017  # m from there up to the pin of the gripper that holds it
ABOVE = 0.1  # m: no peg is in the way
LEAN = 0.35  # rad: so far each hand leans outward in the hand-over, or their bodies would meet


class BiPegTransfer(JudgedEnv):
    """Actions of 100 ms: of the left hand, then of the right one, the way of the gripper's target along x, y, z, its
    turn about x, and the jaw (negative: closed).

    Observed of each hand: its position, target (m) and the target's roll (rad), both jaws (rad), velocity (m/s). Of the
    ring: pose, velocity, its place relative to each hand; who holds it (0 or 1 each) by the judge.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 10}
    files = (*PegBoardEnv.files, TASKS / "any_peg.yaml")
    ground = PegBoardEnv.ground
    without = tuple(name for name in PegBoardEnv.without if not name.startswith("left_"))
    robot = "peg_board_grippers"
    task = "/ambf/env/any_peg_handed"
    steps = 100
    action_size, observation_size = 10, 42

    def find(self) -> None:
        super().find()
        self._ring = self.world.body("ring2")
        self._hands = [self.world.body(f"{side}_gripper") for side in SIDES]
        self._jaws = [[self.world.joint(f"{side}_gripper-jaw_{jaw}") for jaw in "ab"] for side in SIDES]

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        for hand, start, jaws in zip(self._hands, STARTS, self._jaws, strict=True):
            world.commands.set_body(hand, [*start, 0, 0, 0, 1], BodyMode.POSE)
            world.commands.set_joints(OPEN, joints=jaws)
        world.step(1000)

    def observe(self) -> NDArray[np.float64]:
        state, commands = self.world.state, self.world.commands
        ring, parts = state.body_pose[self._ring], []
        for hand, jaws in zip(self._hands, self._jaws, strict=True):
            at, target = state.body_pose[hand, :3], commands.body_pose[hand]
            parts += [at, target[:3], [_roll(target)], state.joint_position[jaws], state.body_twist[hand, :3]]
        held = int(state.piece_held_by[self._task.pieces][0])
        near = [ring[:3] - state.body_pose[hand, :3] for hand in self._hands]
        return np.concatenate([*parts, ring, state.body_twist[self._ring, :3], *near, [held & 1, held >> 1 & 1]])

    def point(self) -> NDArray[np.float64]:
        return self.world.state.body_pose[self._ring, :3]

    def sample_goal(self) -> NDArray[np.float64]:
        return np.array([*self.np_random.choice(PEGS), ON_BOARD, 1.0])

    def command(self, action: Floats) -> None:
        commands, parts = self.world.commands, action.astype(np.float64).reshape(2, 5)
        for hand, jaws, part in zip(self._hands, self._jaws, parts, strict=True):
            target = commands.body_pose[hand]
            roll = np.clip(_roll(target) + TURN * part[3], -MOST, MOST)
            target[:3] = np.clip(target[:3] + STRIDE * part[:3], LOW, HIGH)
            target[3:] = np.sin(roll / 2), 0, 0, np.cos(roll / 2)
            commands.joint_value[jaws] = CLOSED if part[4] < 0 else OPEN

    def expert(self) -> Expert:
        plan = _Plan()

        def act(observation: Observation) -> Floats:
            plan.seen = observation
            return next(plan.actions)

        return act


class _Plan:
    """The left hand picks the ring, both lean and pass it on, the right one puts it down."""

    def __init__(self) -> None:
        self.seen: Observation = {}
        self.wide = [True, True]  # is open
        self.actions = self._all()

    def numbers(self, first: int, count: int) -> NDArray[np.float64]:
        return self.seen["observation"][first : first + count].astype(np.float64)

    def target(self, hand: int) -> NDArray[np.float64]:
        """x, y, z, roll."""
        return self.numbers(12 * hand + 3, 4)

    @property
    def ring(self) -> NDArray[np.float64]:
        return self.numbers(24, 3)

    def act(self, **aims: NDArray[np.float64]) -> Floats:
        """Brings targets of hands nearer to these, in straight lines."""
        action = np.zeros((2, 5))
        for hand, side in enumerate(SIDES):
            if side in aims:
                way = (aims[side] - self.target(hand)) / [STRIDE, STRIDE, STRIDE, TURN]
                action[hand, :4] = way / max(1.0, np.abs(way).max())
            action[hand, 4] = 1.0 if self.wide[hand] else -1.0
        return action.ravel().astype(np.float32)

    def go(self, hand: int, place: NDArray[np.float64], roll: float = 0.0) -> Iterator[Floats]:
        aim = np.array([*place, roll])
        while np.abs(aim - self.target(hand)).max() > 1e-5:
            yield self.act(**{SIDES[hand]: aim})
        yield from self.wait(2)

    def wait(self, actions: int) -> Iterator[Floats]:
        for _ in range(actions):
            yield self.act()

    def jaws(self, hand: int, wide: bool) -> Iterator[Floats]:
        self.wide[hand] = wide
        yield from self.wait(3)

    def _all(self) -> Iterator[Floats]:
        left, right = 0, 1
        x, y, z = self.ring
        over = np.array([x, y - WALL, ABOVE])
        yield from self.go(left, over)
        yield from self.go(left, np.array([x, y - WALL, z + PIN]))
        yield from self.jaws(left, wide=False)
        yield from self.go(left, over)
        high = np.array([0.0, -WALL, ABOVE + 0.03])
        yield from self.go(left, high)
        yield from self.go(left, high, LEAN)
        # The wall opposite to the left hand's: along the ring's own y, where that points away from it.
        x, y, z, qx, qy, qz, qw = self.numbers(24, 7)
        across = np.array([1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz + qx * qw)])
        across *= np.sign(across[0]) / np.linalg.norm(across)
        axis = np.array([0.0, np.sin(LEAN), np.cos(LEAN)])  # of the right hand, which leans the other way
        pin = np.array([x, y, z]) + WALL * np.array([0.0, *across]) + PIN * axis
        far = pin + 0.04 * axis
        yield from self.go(right, np.array([0.0, 0.1, far[2]]))
        yield from self.go(right, far, -LEAN)
        yield from self.go(right, pin, -LEAN)
        yield from self.jaws(right, wide=False)
        yield from self.jaws(left, wide=True)
        back = self.target(left)[:3] + 0.04 * np.array([0.0, -np.sin(LEAN), np.cos(LEAN)])
        yield from self.go(left, back, LEAN)
        yield from self.go(left, STARTS[left])
        held, goal = self.ring - self.target(right)[:3], self.seen["desired_goal"].astype(np.float64)
        over = np.array([*(goal[:2] - held[:2]), ABOVE + 0.02])
        yield from self.go(right, over, -LEAN)
        yield from self.go(right, over)
        held = self.ring - self.target(right)[:3]
        over = np.array([*(goal[:2] - held[:2]), ABOVE])
        yield from self.go(right, over)
        yield from self.go(right, np.array([*over[:2], goal[2] + 0.003 - held[2]]))
        yield from self.jaws(right, wide=True)
        yield from self.go(right, over)
        while True:
            yield self.act()


def _roll(pose: NDArray[np.float64]) -> float:
    return float(2 * np.arctan2(pose[3], pose[6]))
