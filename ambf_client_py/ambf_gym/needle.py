"""A curved needle on the mat of the peg board: ambf/NeedlePick-v0 lifts it, ambf/NeedleRegrasp-v0 hands it over."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from ambf_core import BodyMode, WorldBatch
from numpy.typing import NDArray

from .goals import Expert, Floats, Observation
from .judged import TASKS, JudgedEnv
from .peg_board import CLOSED, OPEN, PegBoardEnv
from .task_world import TaskWorld

STRIDE, TURN = 0.01, 0.2  # m and rad of a hand's target an action at most
LOW, HIGH = np.array([-0.1, -0.12, 0.025]), np.array([0.1, 0.12, 0.2])  # where targets of pins may be, m
MOST_ROLL, MOST_YAW = 0.6, 2.0  # rad
ABOVE = 0.06  # m
TIP = 0.0194  # m from a needle up to the pin of the gripper that holds it
ON_MAT = 0.0066  # m: where the needle's middle lies


class NeedleEnv(JudgedEnv):
    """Actions of 100 ms: of each hand the way of its target along x, y, z (at most 10 mm), its turns (at most 0.2 rad),
    and the jaw (negative: closed).

    Observed of each hand: its position, target (m), the target's roll and yaw (rad), both jaws (rad), velocity (m/s),
    and whether it holds the needle, by the judge. Of the needle: pose, velocity, its middle relative to each hand.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 10}
    files = (*PegBoardEnv.files, TASKS / "needle_board.yaml")
    ground = PegBoardEnv.ground
    steps = 100
    same_m = 0.005  # of the point that is asked for
    tolerance_m = (0.005, 0.005, 0.005)
    sides: tuple[str, ...] = ()
    leans = False  # hands turn about x, too
    starts: tuple[tuple[float, float, float], ...] = ()  # of their pins, m

    def find(self) -> None:
        super().find()
        self._needle = self.world.body("needle")
        self._hands = [self.world.body(f"{side}_gripper") for side in self.sides]
        self._jaws = [[self.world.joint(f"{side}_gripper-jaw_{jaw}") for jaw in "ab"] for side in self.sides]

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        for hand, place, jaws in zip(self._hands, self.starts, self._jaws, strict=True):
            world.commands.set_body(hand, [*place, 0, 0, 0, 1], BodyMode.POSE)
            world.commands.set_joints(OPEN, joints=jaws)
        world.step(1000)

    def start(self) -> None:
        """The needle comes to a place of its own, and is let go there."""
        x, y, yaw = self.np_random.uniform([-0.02, -0.02, -1.2], [0.02, 0.02, 1.2])
        pose = [x, y, ON_MAT + 0.001, 0, 0, np.sin(yaw / 2), np.cos(yaw / 2)]
        self.world.commands.set_body(self._needle, pose, BodyMode.POSE)
        self.world.step(180)  # there within 0.1 mm
        self.world.commands.body_mode[self._needle] = BodyMode.NONE
        self.world.step(40)  # on the mat within 0.02 mm

    def observe(self) -> NDArray[np.float64]:
        state, commands = self.world.state, self.world.commands
        needle, parts = state.body_pose[self._needle], []
        held = int(state.piece_held_by[self._task.pieces][0])
        for k, (hand, jaws) in enumerate(zip(self._hands, self._jaws, strict=True)):
            at, target = state.body_pose[hand, :3], commands.body_pose[hand]
            holds = [float(held >> k & 1)]
            parts += [at, target[:3], _turns(target), state.joint_position[jaws], state.body_twist[hand, :3], holds]
        near = [needle[:3] - state.body_pose[hand, :3] for hand in self._hands]
        return np.concatenate([*parts, needle, state.body_twist[self._needle, :3], *near])

    def point(self) -> NDArray[np.float64]:
        return self.world.state.body_pose[self._needle, :3]

    def sample_goal(self) -> NDArray[np.float64]:
        return np.append(self.np_random.uniform([-0.04, -0.04, 0.05], [0.04, 0.04, 0.1]), 1.0)

    def command(self, action: Floats) -> None:
        commands, parts = self.world.commands, action.astype(np.float64).reshape(len(self._hands), -1)
        for hand, jaws, part in zip(self._hands, self._jaws, parts, strict=True):
            target = commands.body_pose[hand]
            roll, yaw = _turns(target) + TURN * (part[3:5] if self.leans else np.array([0.0, part[3]]))
            roll, yaw = np.clip(roll, -MOST_ROLL, MOST_ROLL) / 2, np.clip(yaw, -MOST_YAW, MOST_YAW) / 2
            target[:3] = np.clip(target[:3] + STRIDE * part[:3], LOW, HIGH)
            # The hand leans about x, and turns about its own axis.
            target[3:] = (
                np.sin(roll) * np.cos(yaw),
                -np.sin(roll) * np.sin(yaw),
                np.cos(roll) * np.sin(yaw),
                np.cos(roll) * np.cos(yaw),
            )
            commands.joint_value[jaws] = CLOSED if part[-1] < 0 else OPEN

    def expert(self) -> Expert:
        plan = _Plan(len(self.sides), self.leans)
        actions = self._plan(plan)

        def act(observation: Observation) -> Floats:
            plan.seen = observation
            return next(actions)

        return act

    def _plan(self, plan: _Plan) -> Iterator[Floats]:
        raise NotImplementedError


class NeedlePick(NeedleEnv):
    """ambf/NeedlePick-v0: the right gripper holds the needle's middle at a point in the air."""

    without = (*PegBoardEnv.without, "ring2", "pegs", "peg_board")
    robot = "peg_board_gripper"
    task = "/ambf/env/needle_pick"
    sides = ("right",)
    starts = ((0.0, 0.0, 0.1),)
    action_size, observation_size = 5, 27

    def _plan(self, plan: _Plan) -> Iterator[Floats]:
        yield from plan.pick(0, 0.0)
        yield from plan.carry(0)


class NeedleRegrasp(NeedleEnv):
    """ambf/NeedleRegrasp-v0: the left gripper lifts the needle, the right one takes it in the air and holds it."""

    without = (*(each for each in PegBoardEnv.without if not each.startswith("left_")), "ring2", "pegs", "peg_board")
    robot = "peg_board_grippers"
    task = "/ambf/env/needle_regrasp"
    sides = ("left", "right")
    leans = True
    starts = ((0.0, -0.1, 0.15), (0.0, 0.1, 0.15))
    action_size, observation_size = 12, 44
    END = 0.65  # of the needle, from its middle to an end: where hands hold it
    LEAN = 0.35  # rad: so far each hand leans outward, or their bodies would meet

    def _plan(self, plan: _Plan) -> Iterator[Floats]:
        left, right, lean = 0, 1, self.LEAN
        yield from plan.pick(left, -self.END)
        # The wire's other end shall be along x, and nearer to the right hand: then leaning keeps it across both.
        here, there = plan.wire(-self.END)[0], plan.wire(self.END)
        heading, away = np.arctan2(there[1][1], there[1][0]), there[0] - here
        turns = [turn for turn in (-heading, np.pi - heading) if np.sin(turn) * away[0] + np.cos(turn) * away[1] > 0]
        yaw = float((plan.target(left)[4] + turns[0] + np.pi) % (2 * np.pi) - np.pi)
        middle = np.array([0.0, -0.006, ABOVE + 0.06])
        yield from plan.go(left, middle, 0.0, yaw)
        yield from plan.go(left, middle, lean, yaw)
        axis = np.array([0.0, np.sin(lean), np.cos(lean)])  # of the right hand
        far = plan.wire(self.END)[0] + (TIP + 0.04) * axis
        yield from plan.go(right, np.array([far[0], 0.1, far[2]]), -lean, 0.0)
        for further in (0.001, 0.002, 0.003):  # until it has it: a needle that is held at one place turns a little
            at, along = plan.wire(self.END)
            turned = _half_turn(float(np.arctan2(along[1], along[0])))
            yield from plan.go(right, at + (TIP + 0.04) * axis, -lean, turned)
            yield from plan.go(right, at + (TIP - further) * axis, -lean, turned)
            yield from plan.jaws(right, wide=False)
            if plan.holds(right):
                break
            yield from plan.jaws(right, wide=True)
        yield from plan.jaws(left, wide=True)
        back = plan.target(left)[:3] + 0.04 * np.array([0.0, -np.sin(lean), np.cos(lean)])
        yield from plan.go(left, back, lean, yaw)
        yield from plan.go(left, np.array(self.starts[left]), 0.0, 0.0)
        yield from plan.carry(right)


class _Plan:
    """What experts do with hands and the needle, in the order of calls."""

    RADIUS, HALF = 0.012, np.radians(70)  # of the needle's arc (ambf_models/scripts/scene_needle.py)

    def __init__(self, hands: int, leans: bool) -> None:
        self.seen: Observation = {}
        self.wide = [True] * hands
        self._leans = leans

    def target(self, hand: int) -> NDArray[np.float64]:
        """x, y, z, roll, yaw."""
        return self.seen["observation"][14 * hand + 3 : 14 * hand + 8].astype(np.float64)

    def holds(self, hand: int) -> bool:
        return bool(self.seen["observation"][14 * hand + 13] > 0.5)

    def needle(self) -> NDArray[np.float64]:
        """Its pose."""
        first = 14 * len(self.wide)
        return self.seen["observation"][first : first + 7].astype(np.float64)

    def wire(self, share: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """A place on the needle, from -1 (base) to 1 (tip), and the direction towards its tip there: in the world."""
        angle, pose = self.HALF * share, self.needle()
        at = self.RADIUS * np.array([np.sin(angle), np.cos(angle) - 1.0, 0.0])
        along = np.array([np.cos(angle), -np.sin(angle), 0.0])
        return pose[:3] + _turned(pose[3:], at), _turned(pose[3:], along)

    def act(self, aims: dict[int, NDArray[np.float64]]) -> Floats:
        """Brings targets of hands nearer to these, in straight lines."""
        action = np.zeros((len(self.wide), 6 if self._leans else 5))
        for hand, wide in enumerate(self.wide):
            if hand in aims:
                way = (aims[hand] - self.target(hand)) / [STRIDE, STRIDE, STRIDE, TURN, TURN]
                way /= max(1.0, float(np.abs(way).max()))
                action[hand, :-1] = way if self._leans else way[[0, 1, 2, 4]]
            action[hand, -1] = 1.0 if wide else -1.0
        return action.ravel().astype(np.float32)

    def go(self, hand: int, place: NDArray[np.float64], roll: float, yaw: float) -> Iterator[Floats]:
        aim = np.array([*place, roll, yaw])
        while np.abs(aim - self.target(hand)).max() > 1e-5:
            yield self.act({hand: aim})
        yield from self.wait(2)

    def wait(self, actions: int) -> Iterator[Floats]:
        for _ in range(actions):
            yield self.act({})

    def jaws(self, hand: int, wide: bool) -> Iterator[Floats]:
        self.wide[hand] = wide
        yield from self.wait(4)

    def pick(self, hand: int, share: float) -> Iterator[Floats]:
        """From the mat, across the wire there."""
        at, along = self.wire(share)
        yaw = _half_turn(float(np.arctan2(along[1], along[0])))
        over = np.array([at[0], at[1], ABOVE])
        yield from self.go(hand, over, 0.0, yaw)
        yield from self.go(hand, np.array([at[0], at[1], at[2] + TIP]), 0.0, yaw)
        yield from self.jaws(hand, wide=False)
        yield from self.go(hand, over, 0.0, yaw)

    def carry(self, hand: int) -> Iterator[Floats]:
        """The needle's middle to the goal, for ever."""
        while True:
            away = self.seen["desired_goal"][:3].astype(np.float64) - self.needle()[:3]
            yield self.act({hand: self.target(hand) + [*away, 0.0, 0.0]})


def _half_turn(angle: float) -> float:
    """Jaws are the same upside down: an angle within a quarter turn."""
    return float((angle + np.pi / 2) % np.pi - np.pi / 2)


def _turns(pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Roll about x, then yaw about the own axis (rad)."""
    x, _, z, w = pose[3:]
    return np.array([2 * np.arctan2(x, w), 2 * np.arctan2(z, w)])


def _turned(q: NDArray[np.float64], vector: NDArray[np.float64]) -> NDArray[np.float64]:
    once = np.cross(q[:3], vector)
    return np.asarray(vector + 2 * (q[3] * once + np.cross(q[:3], once)))
