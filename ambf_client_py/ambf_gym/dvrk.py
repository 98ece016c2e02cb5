"""Arms of the dVRK: ambf/PsmReach-v0, ambf/EcmReach-v0 (the tip to a point), ambf/EcmTrack-v0 (follow what moves).

Both arms turn about a remote centre, the origin of their base. Places are m from it, along the world's axes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from ambf_core import MODELS, Arm, BodyMode, View, WorldBatch
from numpy.typing import NDArray

from .goals import Expert, Floats, GoalEnv, Observation
from .task_world import TaskWorld

STRIDE = 0.002  # m of the tip's target an action at most
STRIDES = np.full(3, STRIDE)
LOW, HIGH = np.array([-0.05, -0.05, -0.16]), np.array([0.05, 0.05, -0.08])  # where goals are
MARGIN = 0.01  # m by which targets may leave that box
MIN_TARGET, MAX_TARGET = LOW - MARGIN, HIGH + MARGIN
NEAR = 0.01  # m that goals keep from where the tip begins
MARK = "target_ik"  # the body that shows a goal


class DvrkEnv(GoalEnv):
    """What environments of one arm have in common. Joints are commanded as messages carry them."""

    arm = ""  # as Arm calls it
    tip = ""  # the last body before the arm's tip
    tip_along_m = 0.0  # from that body's origin to the tip, along its z

    def find(self) -> None:
        self._arm = Arm(self.arm)
        names = self._arm.to_adf(self._arm.home)
        self._joints = {name: self.world.joint(name.replace(" ", "")) for name in names}
        self._rows = list(self._joints.values())
        self._places = np.array(self._rows)  # the same, as arrays are read in a third of the time
        self._tip, self._mark = self.world.body(self.tip), self.world.body(MARK)
        base = self.world.state.body_pose[self.world.body("baselink")]
        self._centre, self._turned = base[:3].copy(), _matrix(base[3:])
        self._values = b""  # of which _reference() knows the answer

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        targets = self._targets(self._arm.home)
        world.commands.set_joints(targets, joints=self._rows)
        world.step(1500)

    def _targets(self, joints: NDArray[np.float64]) -> NDArray[np.float32]:
        """Of the world's joints, for a joint vector of the arm; a jaw is closed."""
        return np.array(list(self._arm.to_adf(joints).values()), np.float32)

    def _commanded(self) -> NDArray[np.float64]:
        """The joint vector that is commanded."""
        return self._reference()[0]

    def _reference(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """It and the tip's pose there."""
        joints, pose, _ = self._known_reference()
        return joints.copy(), pose.copy()

    def _known_reference(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """These, to be read only, and the tip's place: m from the remote centre, along the world's axes.

        An action and what is observed after the one before ask for the same.
        """
        values = self.world.commands.joint_value[self._places]
        bits = values.tobytes()
        if bits != self._values:
            joints, _ = self._arm.from_adf(dict(zip(self._joints, values.tolist(), strict=True)))
            self._keep(bits, joints, self._arm.forward(joints))
        return self._known

    def _keep(self, bits: bytes, joints: NDArray[np.float64], pose: NDArray[np.float64]) -> None:
        self._values, self._known = bits, (joints, pose, self._turned @ pose[:3])

    def _command(self, joints: NDArray[np.float64]) -> None:
        """As set_joints(), whose mode settle() has set."""
        self.world.commands.joint_value[self._places] = self._targets(joints)

    def _tip_place(self) -> NDArray[np.float64]:
        """m, world."""
        pose = self.world.state.body_pose[self._tip]
        return np.asarray(pose[:3] + self.tip_along_m * _matrix(pose[3:])[:, 2] if self.tip_along_m else pose[:3])

    def _show(self, place: NDArray[np.float64]) -> None:
        self.world.commands.set_body(self._mark, [*(self._centre + place), 0, 0, 0, 1], BodyMode.POSE)


class TipEnv(DvrkEnv):
    """50 actions of 20 ms: the way of the tip's target along x, y, z of the world, at most 2 mm each.

    Observed: the driven joints' positions (rad, m) and speeds, and the tip's target. Goals are 80 to 160 mm below the
    remote centre, up to 50 mm beside it along x and y, and never within 10 mm of where the tip begins.
    """

    action_size = 3
    threshold_m = 0.003
    joint_strides: tuple[float, ...] = ()  # rad, m of each joint's target an action at most

    def __init__(self, render_mode: str | None = None, action: str = "tip", **options: Any) -> None:
        """action: "tip", or "joints": the ways of the joints' targets, at most `joint_strides` each. options: those of
        GoalEnv."""
        if action not in ("tip", "joints"):
            raise ValueError(f"action={action!r}: 'tip' or 'joints'")
        self._acts_on_joints = action == "joints"
        if self._acts_on_joints:
            self.action_size = len(self.joint_strides)
        super().__init__(render_mode, **options)

    def observe(self) -> NDArray[np.float64]:
        state = self.world.state
        target = self._known_reference()[2]
        return np.concatenate([state.joint_position[self._places], state.joint_velocity[self._places], target])

    def achieved(self) -> NDArray[np.float64]:
        return self._tip_place()

    def sample_goal(self) -> NDArray[np.float64]:
        start = self.achieved() - self._centre
        while True:
            goal = self.np_random.uniform(LOW, HIGH)
            if np.linalg.norm(goal - start) >= NEAR:
                return np.asarray(self._centre + goal)

    def start(self) -> None:
        self._show(self._goal - self._centre)
        self.world.step(1)  # the mark is there when the first picture is taken

    def command(self, action: Floats) -> None:
        joints, pose, place = self._known_reference()
        if self._acts_on_joints:
            targets = joints + np.array(self.joint_strides) * action.astype(np.float64)
            self._command(np.clip(targets, self._arm.lower, self._arm.upper))
            return
        target = place + STRIDES * action.astype(np.float64)
        wanted = pose.copy()
        wanted[:3] = self._turned.T @ np.minimum(np.maximum(target, MIN_TARGET), MAX_TARGET)
        self._reach(wanted, joints)

    def _reach(self, pose: NDArray[np.float64], joints: NDArray[np.float64]) -> None:
        """Commands the joints that bring the tip to the position of `pose`, near to these."""
        self._command(self._inverse(pose, joints))

    def _inverse(self, pose: NDArray[np.float64], joints: NDArray[np.float64]) -> NDArray[np.float64]:
        """The joints that bring the tip to the position of `pose`, near to these; may change its orientation."""
        raise NotImplementedError

    def expert(self) -> Expert:
        def act(observation: Observation) -> Floats:
            away = observation["desired_goal"] - self._centre - observation["observation"][-3:]
            return np.asarray(np.clip(away / STRIDE, -1, 1), np.float32)

        def act_on_joints(observation: Observation) -> Floats:
            joints, pose = self._reference()
            pose[:3] = self._turned.T @ (observation["desired_goal"].astype(np.float64) - self._centre)
            away = self._inverse(pose, joints) - joints
            return np.asarray(np.clip(away / self.joint_strides, -1, 1), np.float32)

        return act_on_joints if self._acts_on_joints else act


class PsmReach(TipEnv):
    """ambf/PsmReach-v0: the tool points down all the time."""

    files = (MODELS / "multi-bodies/robots/psm.yaml",)
    ground = MODELS / "world/psm_world.yaml"
    robot = arm = "PSM"
    tip = "toolgripper1link"
    observation_size = 17
    joint_strides = (0.02, 0.02, STRIDE, 0.05, 0.05, 0.05)
    view = View(eye=(0.86, 0.36, -0.72), at=(0.5, 0.5141, -0.82), field_of_view=0.42)

    def find(self) -> None:
        super().find()
        self._down = self._arm.forward(self._arm.home)[3:]

    def _inverse(self, pose: NDArray[np.float64], joints: NDArray[np.float64]) -> NDArray[np.float64]:
        pose[3:] = self._down
        return self._arm.inverse(pose, joints)[0]

    def _reach(self, pose: NDArray[np.float64], joints: NDArray[np.float64]) -> None:
        """In one call of the arm, which also says what _known_reference() would ask for next."""
        pose[3:] = self._down
        values, joints, pose = self._arm.reach(pose, joints)
        self.world.commands.joint_value[self._places] = values
        self._keep(values.tobytes(), joints, pose)


class EcmReach(TipEnv):
    """ambf/EcmReach-v0: the endoscope looks away from the remote centre; its roll stays."""

    files = (MODELS / "multi-bodies/robots/ecm.yaml",)
    ground = MODELS / "world/ecm_world.yaml"
    robot = arm = "ECM"
    tip = "toollink"
    tip_along_m = -0.371
    view = View(eye=(1.0, -0.6, -0.58), at=(0.5, -0.3901, -0.75), field_of_view=0.5)
    observation_size = 11
    joint_strides = (0.02, 0.02, STRIDE, 0.05)

    def _inverse(self, pose: NDArray[np.float64], joints: NDArray[np.float64]) -> NDArray[np.float64]:
        return _away(self._arm, pose[:3], joints)


class EcmTrack(DvrkEnv):
    """ambf/EcmTrack-v0: what wanders shall stay in the middle of the picture, 60 mm before the endoscope's tip.

    200 actions of 20 ms: turns about the first two joints, at most 0.02 rad each, and the way in, at most 2 mm.
    Observed: the driven joints' positions (rad, m), speeds and targets. The goal, and what is achieved, are places of
    the mark as the endoscope sees it: x and y beside its axis, z ahead.
    """

    files, ground, robot, arm = EcmReach.files, EcmReach.ground, "ECM", "ECM"
    tip, tip_along_m, view = EcmReach.tip, EcmReach.tip_along_m, EcmReach.view
    action_size, observation_size = 3, 12
    threshold_m = 0.005
    strides = np.array([0.02, 0.02, STRIDE, 0.0])
    ahead_m = 0.06
    actions = 200

    def start(self) -> None:
        self._acts = 0
        while True:
            self._middle = self.np_random.uniform([-0.01, -0.01, -0.19], [0.01, 0.01, -0.17])
            self._swing = self.np_random.uniform([0.02, 0.02, 0.0], [0.03, 0.03, 0.01])
            self._speed = 2 * np.pi * self.np_random.uniform(0.15, 0.3, 3)
            self._phase = self.np_random.uniform(0, 2 * np.pi, 3)
            if np.hypot(*self._place(self.actions)[:2]) > 0.02:  # not where who does nothing looks
                break
        self._show(self._place(0))
        self.world.step(1)

    def observe(self) -> NDArray[np.float64]:
        state = self.world.state
        return np.concatenate(
            [state.joint_position[self._places], state.joint_velocity[self._places], self._commanded()]
        )

    def achieved(self) -> NDArray[np.float64]:
        turned = _matrix(self.world.state.body_pose[self._tip, 3:])
        x, y, z = turned.T @ (self._centre + self._place(self._acts) - self._tip_place())
        return np.array([x, -y, -z])

    def sample_goal(self) -> NDArray[np.float64]:
        return np.array([0, 0, self.ahead_m])

    def command(self, action: Floats) -> None:
        self._acts += 1
        self._show(self._place(self._acts))
        targets = self._commanded() + self.strides * np.append(action.astype(np.float64), 0)
        self._command(np.clip(targets, self._arm.lower, self._arm.upper))

    def expert(self) -> Expert:
        def act(observation: Observation) -> Floats:
            """To where the mark will be: motors and messages lag by some actions."""
            place = self._turned.T @ self._place(self._acts + 4)
            ahead = observation["desired_goal"][2]
            joints = self._commanded()
            away = _away(self._arm, place * (1 - ahead / np.linalg.norm(place)), joints) - joints
            return np.asarray(np.clip(away[:3] / self.strides[:3], -1, 1), np.float32)

        return act

    def _place(self, acts: int) -> NDArray[np.float64]:
        """Of the mark, after so many actions."""
        time_s = acts * self.steps * 0.001
        return np.asarray(self._middle + self._swing * np.sin(self._speed * time_s + self._phase))


def _away(arm: Arm, place: NDArray[np.float64], joints: NDArray[np.float64]) -> NDArray[np.float64]:
    """Joints of an ECM with its tip there (m, in the arm's frame), near to these, the roll as it is."""
    turned = _turn_z(arm.forward(joints)[3:], place / np.linalg.norm(place))
    return np.append(arm.inverse([*place, *turned], joints)[0][:3], joints[3])


def _matrix(q: NDArray[np.float64]) -> NDArray[np.float64]:
    x, y, z, w = q.tolist()
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _turn_z(q: NDArray[np.float64], away: NDArray[np.float64]) -> NDArray[np.float64]:
    """The orientation nearest to q whose z axis points there. In plain numbers: numpy takes longer for these."""
    x, y, z, w = q.tolist()
    ax, ay, az = away.tolist()
    zx, zy, zz = 2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)  # the z axis now
    rx, ry, rz, rw = zy * az - zz * ay, zz * ax - zx * az, zx * ay - zy * ax, 1 + zx * ax + zy * ay + zz * az
    out = np.array(
        [
            rw * x + w * rx + ry * z - rz * y,
            rw * y + w * ry + rz * x - rx * z,
            rw * z + w * rz + rx * y - ry * x,
            rw * w - rx * x - ry * y - rz * z,
        ]
    )
    return np.asarray(out / np.sqrt(out @ out))
