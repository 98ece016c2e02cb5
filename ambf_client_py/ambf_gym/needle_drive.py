"""ambf/NeedleDrive-v0: a PSM drives a half-circle needle through soft tissue, from one mark to another."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from ambf_core import MODELS, BodyMode, View, WorldBatch
from numpy.typing import NDArray

from .dvrk import DvrkEnv
from .goals import Expert, Floats, Observation
from .judged import TASKS, UNDONE_M, JudgedEnv
from .task_world import TaskWorld

Vector = NDArray[np.float64]

STRIDE, TURN = 0.001, 0.06  # m and rad of the tip's target an action at most
OPEN, CLOSED = 0.6, 0.0  # rad, opening of the jaw
TOP = np.array([0.4, 0.5141, -0.785])  # m: as the rest here, of ambf_models/scripts/scene_needle_drive.py
RADIUS, ABOVE, JAW = 0.026 / np.pi, 0.0055, 0.0065
SIDE = float(np.sqrt(RADIUS**2 - ABOVE**2))
PAIRS = (-0.005, 0.0, 0.005)  # m, along x
HELD = np.radians(155)  # from the needle's tip to where the jaws hold it, about its middle
LIFTED = 0.012  # m, of the needle's middle above where it is driven, as episodes begin
ASIDE = np.array([0.004, 0.002, 0.002])  # m, at most, where they begin
PARKED = np.array([0.06, 0.0, 0.0])  # m from there: where the needle waits until the jaws are open
LOW, HIGH = TOP + [-0.015, -0.02, -0.003], TOP + [0.03, 0.02, 0.035]  # where targets of the tip may be, m
FIRST = np.array([0.9, 0.0, 0.12, 1.0, 0.0, 0.0])  # the arm, roughly, over the pad


class NeedleDrive(JudgedEnv, DvrkEnv):
    """Actions of 50 ms: the way of the tip's target along x, y, z of the world (at most 1 mm), its turn about them (at
    most 0.06 rad), and the jaw (negative: closed). A target that the arm cannot reach stays what it was.

    Closed jaws hold the needle by an actuator, as `info` says: friction of rigid jaws lets a thin wire turn. Observed:
    the tip's pose and target, the jaw's target (rad), the needle's pose, tip and velocity, whether it is held, and
    which goals are done, in and out of each pair of marks. The tip is on the jaw's axis.

    Goals are seven numbers: the marks where the needle shall go in and come out (m, world), and 1. Achieved are those
    of the pair that the judge calls done, in and out, and 1; before, twice the needle's tip, and 0.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 20}
    files = (MODELS / "multi-bodies/robots/psm.yaml", TASKS / "needle_drive.yaml")
    ground = MODELS / "world/needle_drive_world.yaml"
    arm = robot = "PSM"
    tip = "toolgripper1link"
    view = View(eye=(0.47, 0.41, -0.70), at=(0.405, 0.514, -0.778), field_of_view=0.44)
    task = "/ambf/env/needle_drive/drive"
    steps = 50
    goal_size = 7
    tolerance_m = (0.002, 0.002, 0.002)
    same_m = 0.002
    action_size, observation_size = 7, 35

    def find(self) -> None:
        super().find()
        self._needle = self.world.body("needle")
        self._jaws = [self.world.joint(f"toolpitchlink-toolgripper{half}link") for half in (1, 2)]

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        """The jaws open around where the needle comes, it slides between them, and they close."""
        middle = TOP + [0.0, 0.0, ABOVE + LIFTED]
        needle = np.concatenate([middle + PARKED * [-1, 0, 0], _quaternion(_needle_axes(0.0))])
        world.commands.set_body(self._needle, needle, BodyMode.POSE)
        joints = FIRST
        for share in np.linspace(1.0, 0.0, 21):
            joints = self._reach(_tip_at(middle + share * np.array([0.03, 0.0, 0.0]), 0.0), joints)
            world.commands.set_joints(self._values_of(joints, OPEN), joints=self._rows)
            world.step(50)
        world.step(500)
        for share in np.linspace(1.0, 0.0, 31):
            needle[:3] = middle + share * PARKED * [-1, 0, 0]
            world.commands.set_body(self._needle, needle, BodyMode.POSE)
            world.step(30)
        world.step(300)
        world.commands.set_joints(self._values_of(joints, CLOSED), joints=self._rows)
        world.step(300)
        world.commands.body_mode[..., self._needle] = BodyMode.NONE
        world.step(200)

    def start(self) -> None:
        way = self.np_random.uniform(-ASIDE, ASIDE)
        joints, pose = self._reference()
        pose[:3] += self._turned.T @ way
        self._command(self._arm.inverse(pose, joints)[0])
        self.world.step(300)

    def observe(self) -> Vector:
        state = self.world.state
        needle = state.body_pose[self._needle]
        held = float(state.piece_held_by[self._task.pieces][0] > 0)
        done = state.goal_done[self._task.goals].astype(np.float64)
        parts = [state.body_pose[self._tip], self._target(), [self._opening()], needle, self._needle_tip()]
        return np.concatenate([*parts, state.body_twist[self._needle, :3], [held], done])

    def point(self) -> Vector:
        return self._needle_tip()

    def achieved(self) -> Vector:
        done = self.world.state.goal_done[self._task.goals].reshape(-1, 2).all(axis=1)
        if done.any():
            return np.append(_marks(PAIRS[int(np.argmax(done))]), 1.0)
        return np.append(np.tile(self._needle_tip(), 2), 0.0)

    def is_reached(self, achieved: NDArray[Any], desired: NDArray[Any]) -> NDArray[np.bool_]:
        achieved, desired = np.asarray(achieved, np.float64), np.asarray(desired, np.float64)
        there = (np.abs(achieved[..., :6] - desired[..., :6]) < self.same_m).all(-1)
        return np.asarray(there & ((achieved[..., 6] > 0.5) | (desired[..., 6] < 0.5)))

    def distance(self, achieved: NDArray[Any], desired: NDArray[Any]) -> Vector:
        achieved, desired = np.asarray(achieved, np.float64), np.asarray(desired, np.float64)
        away = np.linalg.norm((achieved - desired)[..., :6], axis=-1)
        return np.asarray(away + UNDONE_M * np.maximum(desired[..., 6] - achieved[..., 6], 0.0))

    def sample_goal(self) -> Vector:
        return np.append(_marks(PAIRS[self.np_random.integers(len(PAIRS))]), 1.0)

    def command(self, action: Floats) -> None:
        part = action.astype(np.float64)
        joints, pose = self._reference()
        target = self._target()
        place = np.clip(target[:3] + STRIDE * part[:3], LOW, HIGH)
        turned = _rotation(TURN * part[3:6]) @ _axes(target[3:])
        pose[:3] = self._turned.T @ (place - self._centre)
        pose[3:] = _quaternion(self._turned.T @ turned)
        reached, why = self._arm.inverse(pose, joints)
        values = self._values_of(reached if why == "solved" else joints, CLOSED if part[6] < 0 else OPEN)
        self.world.commands.set_joints(values, joints=self._rows)

    def expert(self) -> Expert:
        seen: Observation = {}
        plan = _drive(seen)

        def act(observation: Observation) -> Floats:
            seen.update(observation)
            return next(plan)

        return act

    def _info(self, observation: Observation) -> dict[str, Any]:
        return {**super()._info(observation), "assisted_grasp": True}

    def _targets(self, joints: Vector) -> NDArray[np.float32]:
        return self._values_of(joints, self._opening())

    def _opening(self) -> float:
        """Of the jaw, as commanded: the wrist's turn is in both halves, in opposite ways."""
        return float(self.world.commands.joint_value[self._jaws].sum())

    def _values_of(self, joints: Vector, opening: float) -> NDArray[np.float32]:
        return np.array(list(self._arm.to_adf(joints, opening).values()), np.float32)

    def _reach(self, pose: Vector, joints: Vector) -> Vector:
        """Joints for a pose of the tip in the world, near to these."""
        return self._arm.inverse(
            [*(self._turned.T @ (pose[:3] - self._centre)), *_quaternion(self._turned.T @ _axes(pose[3:]))], joints
        )[0]

    def _target(self) -> Vector:
        """The pose of the tip that is commanded, in the world."""
        pose = self._reference()[1]
        turned = _quaternion(self._turned @ _axes(pose[3:]))
        return np.concatenate([self._centre + self._turned @ pose[:3], turned])

    def _needle_tip(self) -> Vector:
        pose = self.world.state.body_pose[self._needle]
        return np.asarray(pose[:3] + RADIUS * _axes(pose[3:])[:, 0])


def _drive(seen: Observation, aside: float = 0.0, above: float = ABOVE) -> Iterator[Floats]:
    """Over the pair of marks, or m beside it, down, around, and wait."""

    def here() -> tuple[Vector, Vector]:
        """The needle's pose, and the target's: what the hand is commanded to, the needle follows."""
        numbers = seen["observation"].astype(np.float64)
        return numbers[15:22], numbers[7:14]

    def towards(middle: Vector, angle: float) -> tuple[Floats, float]:
        """Moves the target as the needle has to move; how far that is, in actions."""
        needle, target = here()
        turn = _needle_axes(angle) @ _axes(needle[3:]).T
        place = middle + turn @ (target[:3] - needle[:3])
        vector = _vector(turn)
        away = max(float(np.abs(place - target[:3]).max()) / STRIDE, float(np.abs(vector).max()) / TURN)
        share = 1.0 / max(1.0, away)
        part = np.concatenate([(place - target[:3]) * share / STRIDE, vector * share / TURN, [-1.0]])
        return part.astype(np.float32), away

    def go(middle: Vector, angle: float, patience: int) -> Iterator[Floats]:
        for _ in range(patience):
            action, away = towards(middle, angle)
            if away < 0.1:
                return
            yield action

    middle = np.array([float(seen["desired_goal"][0]) + aside, TOP[1], TOP[2] + above])
    yield from go(middle + [0.0, 0.0, 0.004], 0.0, 40)
    yield from go(middle, 0.0, 20)
    for angle in np.arange(0.04, 2.75, 0.04):
        yield towards(middle, float(angle))[0]
    while True:
        yield towards(middle, 2.75)[0] * np.float32(0.3)


def _marks(x: float) -> Vector:
    """Where the needle goes in and comes out of a pair: m, world."""
    return np.concatenate([TOP + [x, -SIDE, 0.0], TOP + [x, SIDE, 0.0]])


def _needle_axes(angle: float) -> Vector:
    """Of the needle, its tip at -y of its middle, turned by the angle about x: downward from 0 on."""
    level = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(_rotation(np.array([angle, 0.0, 0.0])) @ level)


def _tip_at(middle: Vector, angle: float) -> Vector:
    """The pose of the arm's tip whose jaws hold a needle there: the jaws along -x, the wire across them."""
    turned = angle - HELD
    out = np.array([0.0, -np.cos(turned), -np.sin(turned)])  # from the needle's middle to the jaws
    z = np.array([-1.0, 0.0, 0.0])
    x = np.cross(out, z)
    place = middle + RADIUS * out - JAW * z
    return np.concatenate([place, _quaternion(np.column_stack([x, np.cross(z, x), z]))])


def _axes(q: Vector) -> Vector:
    x, y, z, w = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _quaternion(axes: Vector) -> Vector:
    """x, y, z, w, by the largest of them."""
    t = np.array([axes[0, 0], axes[1, 1], axes[2, 2], np.trace(axes)])
    i = int(np.argmax(t))
    if i == 3:
        q = np.array([axes[2, 1] - axes[1, 2], axes[0, 2] - axes[2, 0], axes[1, 0] - axes[0, 1], 1 + t[3]])
    else:
        j, k = (i + 1) % 3, (i + 2) % 3
        q = np.zeros(4)
        q[i] = 1 + t[i] - t[j] - t[k]
        q[j], q[k], q[3] = axes[i, j] + axes[j, i], axes[i, k] + axes[k, i], axes[k, j] - axes[j, k]
    return np.asarray(q / np.linalg.norm(q))


def _rotation(vector: Vector) -> Vector:
    angle = float(np.linalg.norm(vector))
    if angle < 1e-12:
        return np.eye(3)
    half = np.sin(angle / 2) * vector / angle
    return _axes(np.append(half, np.cos(angle / 2)))


def _vector(axes: Vector) -> Vector:
    """The axis times the angle (rad) of a turn of less than half a circle."""
    q = _quaternion(axes)
    q = q if q[3] >= 0 else -q
    size = float(np.linalg.norm(q[:3]))
    return np.asarray(q[:3] * (2 * np.arctan2(size, q[3]) / size if size > 1e-12 else 2.0))
