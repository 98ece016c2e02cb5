"""ambf/RingWire-v0: a ring is led along a bent wire without touching it; the task's judge counts touches."""

from __future__ import annotations

import numpy as np
from ambf_core import MODELS, BodyMode, WorldBatch
from numpy.typing import NDArray

from .goals import Expert, Floats, Observation
from .judged import TASKS, JudgedEnv
from .task_world import TaskWorld

HALF, HEIGHT, WAVE, SIDE = 0.080, 0.095, 0.020, 0.012  # m, of the wire (ambf_models/scripts/scene_ring_wire.py)
START, END = 0.06, 0.94  # of its length
STRIDE, TURN = 0.003, 0.15  # m and rad of the ring's target an action at most
LOW, HIGH = np.array([-0.05, -0.09, 0.05]), np.array([0.05, 0.09, 0.14])  # where the target may be, m
LEAN = 1.2  # rad: so far the target may be turned
ASIDE = 0.003  # m from the wire, along each axis, at most, where episodes begin


def place(t: float) -> NDArray[np.float64]:
    """Of the wire, m; t is 0 at its left end, 1 at its right one."""
    return np.array([SIDE * np.sin(2 * np.pi * t), HALF * (2 * t - 1), HEIGHT + WAVE * np.sin(3 * np.pi * t)])


def turn(t: float) -> NDArray[np.float64]:
    """Roll and yaw (rad) that bring the ring's axis, its y, along the wire."""
    x, y, z = SIDE * 2 * np.pi * np.cos(2 * np.pi * t), 2 * HALF, WAVE * 3 * np.pi * np.cos(3 * np.pi * t)
    return np.array([np.arctan2(z, np.hypot(x, y)), np.arctan2(-x, y)])


class RingWire(JudgedEnv):
    """Actions of 50 ms: the way of the ring's target along x, y, z, and its turn in roll and yaw.

    Observed: the ring's pose, velocity (m/s, rad/s) and target (m, roll, yaw), the share of stations that it passed,
    and whether it touched the wire. Its goal is the wire's end, by way of all stations, without a touch.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 20}
    files = (TASKS / "ring_wire.yaml",)
    ground = MODELS / "world/ring_wire_world.yaml"
    robot = "ring"
    task = "/ambf/env/ring_wire/lead"
    tolerance_m = (0.006, 0.006, 0.006)
    steps = 50
    action_size, observation_size = 5, 20

    def find(self) -> None:
        super().find()
        self._ring = self.world.body("/ambf/env/ring_wire/ring")
        self._stations = len(self._task.goal_names)

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        world.commands.set_body(self._ring, self._pose(place(START), turn(START)), BodyMode.POSE)
        world.step(1000)

    def start(self) -> None:
        aside = self.np_random.uniform(-ASIDE, ASIDE, 3)
        self._aim(place(START) + aside, turn(START))
        self.world.step(200)

    def observe(self) -> NDArray[np.float64]:
        state = self.world.state
        judged = [state.task_done[self._task.row] / self._stations, float(self._touched())]
        return np.concatenate([state.body_pose[self._ring], state.body_twist[self._ring], *self._target(), judged])

    def point(self) -> NDArray[np.float64]:
        return self.world.state.body_pose[self._ring, :3]

    def is_done(self) -> bool:
        return bool(self.world.state.task_success[self._task.row]) and not self._touched()

    def sample_goal(self) -> NDArray[np.float64]:
        return np.array([*place(END), 1.0])

    def command(self, action: Floats) -> None:
        where, turned = self._target()
        ways = action.astype(np.float64)
        where = np.clip(where + STRIDE * ways[:3], LOW, HIGH)
        self._aim(where, np.clip(turned + TURN * ways[3:], -LEAN, LEAN))

    def expert(self) -> Expert:
        at = START

        def act(observation: Observation) -> Floats:
            """Along the wire by as much as an action can."""
            nonlocal at
            where, turned = observation["observation"][13:16], observation["observation"][16:18]
            further = np.linspace(at, min(END, at + 0.05), 40)
            ways = [np.concatenate([(place(t) - where) / STRIDE, (turn(t) - turned) / TURN]) for t in further]
            fit = [k for k, way in enumerate(ways) if np.abs(way).max() <= 1]
            chosen = fit[-1] if fit else 0
            at = float(further[chosen])
            return np.asarray(np.clip(ways[chosen], -1, 1), np.float32)

        return act

    def _touched(self) -> bool:
        return bool(self.world.state.task_counts[self._task.row, 1] > 0)

    def _target(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """m, and roll and yaw."""
        pose = self.world.commands.body_pose[self._ring]
        x, _, z, w = pose[3:]
        # The quaternion of Rz(yaw) Rx(roll).
        return pose[:3].copy(), np.array([2 * np.arctan2(x, w), 2 * np.arctan2(z, w)])

    def _aim(self, where: NDArray[np.float64], turned: NDArray[np.float64]) -> None:
        self.world.commands.set_body(self._ring, self._pose(where, turned), BodyMode.POSE)

    def _pose(self, where: NDArray[np.float64], turned: NDArray[np.float64]) -> NDArray[np.float64]:
        (roll, yaw), sines, cosines = turned, np.sin(turned / 2), np.cos(turned / 2)
        assert abs(roll) <= np.pi and abs(yaw) <= np.pi
        return np.array(
            [*where, sines[0] * cosines[1], sines[0] * sines[1], cosines[0] * sines[1], cosines[0] * cosines[1]]
        )
