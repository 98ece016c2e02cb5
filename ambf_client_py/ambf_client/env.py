"""AmbfEnv: an object of the simulation as a learning environment in the style of gym, as the original had it."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .client import Client
from .world import World

Array = NDArray[np.float64]

try:
    _Gymnasium: Any = importlib.import_module("gymnasium").Env
except ImportError:
    _Gymnasium = None
_LOW = np.array([-30.0, -30.0, -30.0, -2.0, -2.0, -2.0, 0.0])
_HIGH = np.array([30.0, 30.0, 30.0, 2.0, 2.0, 2.0, 1.0])
_BASE = "PegBase"
_COST_OF_ACTION = 4.0
_OBSERVED = 13


class Box:
    """A range of arrays; stands for gym's own where neither gymnasium nor gym is installed."""

    def __init__(
        self, low: ArrayLike, high: ArrayLike, shape: tuple[int, ...] | None = None, dtype: Any = float
    ) -> None:
        self.shape = shape if shape is not None else np.shape(low)
        self.low = np.broadcast_to(np.asarray(low, dtype=dtype), self.shape)
        self.high = np.broadcast_to(np.asarray(high, dtype=dtype), self.shape)
        self.dtype = np.dtype(dtype)
        self._random = np.random.default_rng()

    def seed(self, seed: int | None = None) -> None:
        """Makes sample() repeat itself."""
        self._random = np.random.default_rng(seed)

    def sample(self) -> NDArray[Any]:
        """A random member; where the range has no end, normally distributed."""
        bounded = np.isfinite(self.low) & np.isfinite(self.high)
        low, high = np.where(bounded, self.low, 0.0), np.where(bounded, self.high, 1.0)
        chosen = np.where(bounded, self._random.uniform(low, high), self._random.normal(size=self.shape))
        return chosen.astype(self.dtype)

    def contains(self, x: ArrayLike) -> bool:
        """Whether x is within the range."""
        array = np.asarray(x)
        return array.shape == self.shape and bool(np.all(array >= self.low) and np.all(array <= self.high))


def _box(low: ArrayLike, high: ArrayLike, shape: tuple[int, ...]) -> Any:
    for package in ("gymnasium", "gym"):
        try:
            spaces = importlib.import_module(f"{package}.spaces")
        except ImportError:
            continue
        return spaces.Box(np.broadcast_to(low, shape), np.broadcast_to(high, shape), dtype=np.float64)
    return Box(low, high, shape)


class Observation:
    """What a step showed."""

    def __init__(self) -> None:
        self.state: list[float] = [0.0] * _OBSERVED
        self.dist = 0.0  # m, from the object to its base
        self.reward = 0.0
        self.is_done = False
        self.info: dict[str, Any] = {}

    def cur_observation(self) -> tuple[Array, float, bool, dict[str, Any]]:
        """(observation, reward, done, info) as gym's step gives them."""
        return np.array(self.state), self.reward, self.is_done, self.info


class AmbfEnv(_Gymnasium or object):  # type: ignore[misc]
    """Moves one object relative to a base: any other body of the scene, "PegBase" as in the original's scenes.

    Of the scenes that come with AMBF none has a PegBase. In the peg-transfer scene (`./dev run`) a gripper and the
    board will do: make("left_gripper", "peg_board").

    An action is [x, y, z, roll, pitch, yaw, jaw] (m, rad): the object's pose command (see RigidBody.pose_command) and
    its first joint. An observation is the pose of the object, that of the base (both x, y, z, roll, pitch, yaw) and how
    many steps the action took. The reward is how much nearer the object came (m), less 4 times the action squared.

    Where gymnasium is installed this is a gymnasium.Env: reset() and step() return what its interface says. Elsewhere
    they return what the original's did.
    """

    metadata: dict[str, Any] = {"render.modes": [], "render_modes": []}

    def __init__(self) -> None:
        self.ambf_client = Client()
        self.ambf_client.connect()
        self.world_handle: World | None = None
        self.obj_handle: Any = None
        self.base_handle: Any = None
        self.enable_step_throttling = True
        self.n_skip_steps = 5
        self.obs = Observation()
        self.action: Array = np.zeros(7)
        self.action_lims_low, self.action_lims_high = _LOW, _HIGH
        self.action_space = _box(_LOW, _HIGH, (7,))
        self.observation_space = _box(-np.inf, np.inf, (_OBSERVED,))

    def skip_sim_steps(self, num: int) -> None:
        """How many simulation steps an action takes."""
        if num < 1:
            raise ValueError(f"an action takes at least one step, not {num}")
        self.n_skip_steps = num

    def set_throttling_enable(self, check: bool) -> None:
        """Whether the simulation waits between actions (as at first) or runs on in real time."""
        self.enable_step_throttling = bool(check)
        if not check and self.world_handle is not None:
            self.world_handle.release()

    def make(self, a_name: str, base: str = _BASE, timeout: float = 10.0) -> None:
        """Takes the object to move and the body that it is seen from, by their names; waits for both.

        Raises TimeoutError where one of them does not come within timeout seconds.
        """
        self.world_handle = self.ambf_client.world
        self.obj_handle = self.ambf_client.wait_for(a_name, timeout)
        try:
            self.base_handle = self.ambf_client.wait_for(base, timeout)
        except TimeoutError as error:
            raise TimeoutError(
                f"{error}. An AmbfEnv sees its object from a base: name one of the scene's bodies by make(name, base), "
                'e.g. make("left_gripper", "peg_board") in the peg-transfer scene'
            ) from None

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> Any:
        """The observation after an action of zeros. The world is not put back: see World.reset.

        As a gymnasium.Env: puts the world back before, and returns (observation, info).
        """
        if _Gymnasium is None:
            return self.step(np.zeros(7))[0]
        super().reset(seed=seed, options=options)
        if self.world_handle is not None:
            self.world_handle.reset()
        self.obs = Observation()
        observation, *_, info = self.step(np.zeros(7))
        return observation, info

    def step(self, action: ArrayLike) -> Any:
        """Takes an action, cut to its limits; returns (observation, reward, done, info). done is always False.

        As a gymnasium.Env: returns (observation, reward, terminated, truncated, info); both are always False.
        """
        wanted = np.asarray(action, dtype=float)
        if wanted.shape != (7,):
            raise ValueError(f"an action has 7 numbers, not the shape {wanted.shape}")
        if self.obj_handle is None or self.world_handle is None:
            raise RuntimeError("call make(name) first")
        self.action = np.clip(wanted, _LOW, _HIGH)
        pose, jaw = self.action[:6], self.action[6:]
        self.obj_handle.pose_command(*pose, *(jaw if self.obj_handle.get_num_joints() else ()))
        before = self.obj_handle.get_sim_step()
        if self.enable_step_throttling:
            if not self.world_handle.is_stepping():
                before = self.world_handle.step(0).sim_step
            self.world_handle.step(self.n_skip_steps)
        else:
            for handle in (self.obj_handle, self.base_handle):
                if not handle.wait_for_sim_step(before + self.n_skip_steps):
                    raise TimeoutError(f"{handle.get_name()} sends no states")
        self._observe(self.obj_handle.get_sim_step() - before)
        observation, reward, done, info = self.obs.cur_observation()
        return (observation, reward, done, info) if _Gymnasium is None else (observation, reward, done, False, info)

    def render(self, mode: str = "human") -> None:
        """Nothing to do: the simulator draws by itself."""

    def close(self) -> None:
        """Lets the simulation run on and disconnects."""
        self.ambf_client.clean_up()

    def _observe(self, steps: int) -> None:
        pose, base = self.obj_handle.get_pose(), self.base_handle.get_pose()
        dist = float(np.linalg.norm(self.obj_handle.position - self.base_handle.position))
        first = self.obs.info == {}
        nearer = 0.0 if first else self.obs.dist - dist
        self.obs.state = [*pose, *base, float(steps)]
        self.obs.reward = nearer - _COST_OF_ACTION * float(np.sum(self.action**2))
        self.obs.dist = dist
        self.obs.info = {"sim_step": self.obj_handle.get_sim_step()}
