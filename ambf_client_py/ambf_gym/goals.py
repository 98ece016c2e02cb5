"""What environments with a goal have in common: the goal convention of Gymnasium-Robotics, over one world."""

from __future__ import annotations

import math
import os
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeAlias, cast

import gymnasium
import numpy as np
from ambf_core import Diverged, View, Window, World, WorldBatch, WorldView
from gymnasium import spaces
from numpy.typing import ArrayLike, NDArray

from .options import check_options, goal_of, noise_of
from .randomization import Randomization
from .task_world import TaskWorld

Floats: TypeAlias = NDArray[np.float32]
Observation: TypeAlias = dict[str, Floats]
Expert: TypeAlias = Callable[[Observation], Floats]
_STEP = 0.001  # s of a step of physics, World's own


_ONE, _MINUS_ONE = np.array(1.0, np.float32), np.array(-1.0, np.float32)


def _within(values: Floats, low: Floats, high: Floats) -> Floats:
    """clip() in a quarter of the time."""
    return np.minimum(np.maximum(values, low), high)


class GoalEnv(gymnasium.Env[Any, Floats]):
    """Observations are dicts of "observation", "achieved_goal", "desired_goal"; goals are points (m, world).

    A new environment derives from this class, names its files and sizes, and writes find, settle, observe, achieved,
    sample_goal and command.
    """

    metadata: dict[str, Any] = {"render_modes": ["human", "rgb_array"], "render_fps": 50}
    files: tuple[str | os.PathLike[str], ...] = ()  # ADF
    ground: str | os.PathLike[str] | None = None  # the world file
    without: tuple[str, ...] = ()  # objects of these files that the task has no use for
    robot = ""  # what data sets call it
    steps = 20  # of physics for each action
    threshold_m = 0.01
    action_size, observation_size = 0, 0
    goal_size = 3  # numbers of a goal
    bound = 100.0  # of what is observed, which is clipped to it
    view: str | View = ""  # what pictures show: a camera of the files ("": the first one), or a view

    def __init__(
        self,
        render_mode: str | None = None,
        backend: str | WorldView = "core",
        reward: str = "sparse",
        randomization: str | Path | Mapping[str, Any] | None = None,
        observation: str = "state",
        picture_size: tuple[int, int] = (84, 84),
        noise: ArrayLike = 0.0,
        delay: int = 0,
    ) -> None:
        """backend: "core", a world in this process; "ros", a running simulator; or a world of a batch.

        reward: "sparse" (-1, 0 at the goal) or "dense" (-m from it). randomization: ranges, or a YAML file of them
        (see Randomization); drawn at each reset. observation: "state"; "pictures" (height, width, 3) of picture_size
        (width, height) in its place; or "both", pictures then being "picture". render_mode: "rgb_array", or "human":
        the simulator's window (over ROS that of the one that runs), and actions take the time that they simulate.
        noise: standard deviations of what is added to the numbers observed, one for all or one each; delay: so many
        actions are observations late. Both leave goals and rewards as they are.
        """
        check_options(backend, render_mode, reward, observation, delay)
        self._noise = noise_of(noise, self.observation_size)
        self._noisy, self._delay = bool(self._noise.any()), delay
        self._bounds = np.array(-self.bound, np.float32), np.array(self.bound, np.float32)
        self._past: deque[Observation] = deque()
        if backend == "ros":
            self.metadata = {**self.metadata, "render_modes": ["human"]}
        self.render_mode, self.reward, self._observed, self._size = render_mode, reward, observation, picture_size
        self._own_reward = type(self).compute_reward is not GoalEnv.compute_reward
        goal = spaces.Box(-self.bound, self.bound, (self.goal_size,), np.float32)
        numbers = spaces.Box(-self.bound, self.bound, (self.observation_size,), np.float32)
        picture = spaces.Box(0, 255, (picture_size[1], picture_size[0], 3), np.uint8)
        seen = {"observation": picture if observation == "pictures" else numbers}
        if observation == "both":
            seen["picture"] = picture
        self.observation_space = spaces.Dict({**seen, "achieved_goal": goal, "desired_goal": goal})
        self.action_space = spaces.Box(-1.0, 1.0, (self.action_size,), np.float32)
        self._randomization: Randomization | None = None
        # The batch steps, resets and closes its views: nothing here does.
        self.world = self._open(backend) if isinstance(backend, str) else cast(TaskWorld, backend)
        self._plain = self.world  # that of the files as they are; of some episodes, there is another one
        self._window: Window | None = None
        try:
            if backend == "ros" and render_mode == "human":
                self.world.show()  # type: ignore[attr-defined]  # a world over ROS
            self.find()
            if randomization is not None:
                self._randomization = self._ranges(randomization, backend)
            if isinstance(backend, str):
                self._make_home()
            if backend == "core" and render_mode == "human":
                self._window = Window(cast(World, self.world))
        except BaseException:
            self.close()
            raise
        self._drawn: Mapping[str, Any] = {}
        self._goal = np.zeros(self.goal_size, np.float32)
        self._running = False

    # ---- written by each environment ----

    def find(self) -> None:
        """Keeps what it needs of the structure of self.world: rows of bodies and joints, limits."""

    def settle(self, world: TaskWorld | WorldBatch) -> None:
        """Brings the world, or all of a batch, to where episodes begin; arrays may have one more axis in front."""

    def observe(self) -> NDArray[np.float64]:
        """`observation_size` numbers."""
        raise NotImplementedError

    def achieved(self) -> NDArray[np.float64]:
        """The point that shall be at the goal: m, world."""
        raise NotImplementedError

    def sample_goal(self) -> NDArray[np.float64]:
        """A goal by self.np_random."""
        raise NotImplementedError

    def start(self) -> None:
        """What else an episode begins with, once it has a goal: may draw by self.np_random and command."""

    def command(self, action: Floats) -> None:
        """Writes the commands of one action, from -1 to 1 each."""
        raise NotImplementedError

    def is_reached(self, achieved: NDArray[Any], desired: NDArray[Any]) -> NDArray[np.bool_]:
        """Whether the first one counts as the goal; of many (one a row), too."""
        return self.distance(achieved, desired) < self.threshold_m

    def distance(self, achieved: NDArray[Any], desired: NDArray[Any]) -> NDArray[np.float64]:
        """What the reward "dense" takes off: m between the points; of many, too."""
        away = np.asarray(achieved, np.float64) - np.asarray(desired, np.float64)
        norms: NDArray[np.float64] = np.sqrt(np.add.reduce(away * away, axis=-1))  # in a third of norm()'s time
        return norms

    def expert(self) -> Expert:
        """A policy by script for one episode that begins now."""
        raise NotImplementedError

    # ---- gymnasium ----

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode with a new goal; options: {"goal": a point} instead.

        Over ROS it connects to the simulator that runs now, if another one ended. Where it raises, no episode runs.
        """
        self._running = False
        goal_of(options, self.goal_size)
        try:
            if not getattr(self.world, "changed", False):  # over ROS; begin() loads such a world anew
                self._leave_changed()
                self.world.restore(self._home)
        except ConnectionError:  # the simulator ended; there may be another one
            self.world.reconnect()  # type: ignore[attr-defined]  # only worlds over ROS raise this
            self._make_home()
            self.world.restore(self._home)
        begun = self.begin(seed, options)
        if self._window is not None:
            self._window.take_reset()
            self._window.show(cast(World, self.world))
        return begun

    def step(self, action: Floats) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """`steps` steps of physics under one action. A world that diverges ends the episode as truncated, and so does
        a reset that somebody asks for in the window: info["window_reset"]."""
        self.act(action)
        with suppress(Diverged):  # state.diverged says so
            self.world.step(self.steps)
        outcome = self.outcome()
        if self._window is None:
            return outcome
        self._window.show(cast(World, self.world), self.steps * _STEP)
        if not self._window.take_reset():
            return outcome
        return *outcome[:3], True, {**outcome[4], "window_reset": True}

    def render(self) -> NDArray[np.uint8] | None:
        """A picture (480, 640, 3) of the newest step, in the render mode "rgb_array"; "human" has its window."""
        return self._picture((640, 480)) if self.render_mode == "rgb_array" else None

    @property
    def window(self) -> Window | None:
        """Of a world in this process, in the render mode "human"."""
        return self._window

    def close(self) -> None:
        """Frees the world, and closes its window."""
        if getattr(self, "_window", None) is not None:
            cast(Window, self._window).close()
        for world in (self.world, self._plain):
            if hasattr(world, "close"):  # a view has none
                world.close()

    def compute_reward(self, achieved_goal: Floats, desired_goal: Floats, info: Any) -> NDArray[np.float64]:
        """Of one pair of goals, or of many (one a row): a function of these alone."""
        if self.reward == "dense":
            return -self.distance(achieved_goal, desired_goal)
        return np.where(self.is_reached(achieved_goal, desired_goal), 0.0, -1.0)

    def compute_terminated(self, achieved_goal: Floats, desired_goal: Floats, info: Any) -> bool:
        """Never: what is reached can be left again."""
        return False

    def compute_truncated(self, achieved_goal: Floats, desired_goal: Floats, info: Any) -> bool:
        """Never: the limit of time is gymnasium's."""
        return False

    # ---- parts of reset and step, for vector environments ----

    def begin(self, seed: int | None, options: dict[str, Any] | None) -> tuple[Observation, dict[str, Any]]:
        """An episode in a world that is where episodes begin."""
        self._running = False
        goal = goal_of(options, self.goal_size)
        super().reset(seed=seed)
        drawn = self._drawn = self._draw()
        self._goal = self.sample_goal().astype(np.float32) if goal is None else goal
        self.start()
        self._running = True
        self._past = deque(maxlen=drawn.get("delay", self._delay) + 1)
        observation = self._observation()
        info = self._info(observation)
        return observation, {**info, "randomization": drawn} if drawn else info

    def act(self, action: Floats) -> None:
        """Commands one action."""
        if not self._running:
            raise RuntimeError("step before reset")
        numbers = np.asarray(action, dtype=np.float32)
        if numbers.shape != self.action_space.shape or not all(map(math.isfinite, numbers.tolist())):
            raise ValueError(f"action {action!r}: not {self.action_size} finite numbers")
        self.command(_within(numbers, _MINUS_ONE, _ONE))

    def outcome(self) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """What step returns, of the world as it is now."""
        state = self.world.state
        stopped = self.world.frozen() if state.diverged or state.frozen_bodies else []
        observation = self._observation()
        info = self._info(observation)
        if stopped:
            info["diverged"] = stopped[0]
            self._running = False
        return observation, self._reward(observation, info), False, bool(stopped), info

    # ---- inside ----

    def _open(self, backend: str) -> TaskWorld:
        if backend == "core":
            return World(*self.files, world=self.ground, without=self.without)
        from .over_ros import RosWorld

        return RosWorld(*self.files, world=self.ground, without=self.without)

    def _ranges(self, given: str | Path | Mapping[str, Any], backend: str | WorldView) -> Randomization:
        files = (self.files, self.ground, self.without)
        if backend != "ros":
            ranges = Randomization(given, self.world, self.view, *files)
        else:  # what is refused here is refused there
            with World(*self.files, world=self.ground, without=self.without) as plan:
                ranges = Randomization(given, plan, self.view, *files)
        if ranges.changes_files and not isinstance(backend, str):
            raise ValueError("randomization: masses, scales, colours and lights are not for a WorldBatch")
        if ranges.changes_lights and backend == "ros":
            raise ValueError("randomization: lights of a running simulator are set by their topics")
        return ranges

    def _make_home(self) -> None:
        self.settle(self.world)
        self._home = self.world.snapshot()

    def _draw(self) -> dict[str, Any]:
        if self._randomization is None:
            return {}
        drawn: dict[str, Any] = {}
        if self._randomization.changes_files:
            over_ros = None if isinstance(self.world, World) else self.world
            drawn, self.world = self._randomization.load(self.np_random, over_ros)
            self.find()
            self.settle(self.world)
            self.world.restore(self.world.snapshot())  # as the plain one: a restore forgets what contacts remember
        return {**drawn, **self._randomization.apply(self.world, self.np_random)}

    def _leave_changed(self) -> None:
        if self.world is not self._plain:
            cast(World, self.world).close()
            self.world = self._plain
            cast(World, self.world).reset()  # what find() sees is what was loaded
            self.find()

    def _observation(self) -> Observation:
        out: Observation = {}
        if self._observed != "pictures":
            numbers = self.observe()
            noise = self._drawn.get("noise", self._noise)
            if noise is not self._noise or self._noisy:
                rounded = numbers.astype(np.float32).astype(np.float64)  # as messages carry them
                numbers = rounded + self.np_random.normal(0.0, noise, self.observation_size)
            out["observation"] = self._clipped(numbers)
        if self._observed != "state":
            picture: Any = self._picture(self._size)
            out["observation" if self._observed == "pictures" else "picture"] = picture
        if self._past.maxlen != 1:  # an old one, which may be returned again when an episode begins
            self._past.append(out)
            out = {name: each.copy() for name, each in self._past[0].items()}
        out["achieved_goal"], out["desired_goal"] = self._clipped(self.achieved()), self._goal.copy()
        return out

    def _clipped(self, values: NDArray[np.float64]) -> Floats:
        return _within(values.astype(np.float32), *self._bounds)

    def _picture(self, size: tuple[int, int]) -> NDArray[np.uint8]:
        view = self.view if self._randomization is None else self._randomization.view(self._drawn)
        rgb = self.world.picture(view, *size).rgb
        assert rgb is not None
        return rgb

    def _reward(self, observation: Observation, info: Any) -> float:
        if self.reward == "sparse" and not self._own_reward:  # the answer that compute_reward() would ask for again
            return 0.0 if info["is_success"] else -1.0
        return float(self.compute_reward(observation["achieved_goal"], observation["desired_goal"], info))

    def _info(self, observation: Observation) -> dict[str, Any]:
        return {"is_success": bool(self.is_reached(observation["achieved_goal"], observation["desired_goal"]))}
