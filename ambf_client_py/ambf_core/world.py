"""One world on the caller's thread."""

from __future__ import annotations

import logging
import math
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, TypeVar

import _ambf_core
import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import Diverged, LoadError
from .arrays import Commands, Memory, State, allocate, carry_over, find
from .models import MODELS
from .pictures import Painter, Picture, View, check_size, seen_by
from .tasks import TasksOfWorld, rows_of, tasks_of

_LEVELS = (logging.INFO, logging.WARNING, logging.ERROR)
_log = logging.getLogger("ambf_core")
_T = TypeVar("_T")


class Parameter(NamedTuple):
    """A value of bodies or joints that may change while the world runs."""

    name: str
    per_axis: bool  # x, y and z; else one number
    min: float
    max: float


PARAMETERS = {each[0]: Parameter(*each) for each in _ambf_core.parameters()}


class World(TasksOfWorld):
    """A simulation that moves only in step(), on the thread that calls it.

    Not for two threads at a time, nor for a forked process: such calls raise RuntimeError, as all do after close().
    What is logged goes to the logger "ambf_core".
    """

    state: State  #: the newest step
    commands: Commands  #: what the next step obeys
    bodies: list[str]  #: full names, by row of state.body_...
    joints: list[str]  #: full names, by row of state.joint_...
    joint_limits: NDArray[np.float64]  #: (joints, 2) lower and upper, rad or m; infinite where there is none
    commandable: NDArray[np.bool_]  #: (joints,) takes commands: is not passive
    masses: NDArray[np.float64]  #: (bodies,) kg; 0: static
    models: list[str]  #: what unload() takes
    sensors: list[str]  #: full names, by row of state.sensor_...
    elements: list[slice]  #: of each sensor: its rows of state.element_...
    actuators: list[str]  #: full names, by row of state.actuator_...
    cameras: list[str]  #: full names: what picture() takes
    rows: dict[str, dict[str, int]]  #: {"bodies": {name: row}}, and so with joints, sensors, actuators, cameras, tasks
    counts: dict[str, int]  #: rows of arrays of each kind

    def __init__(
        self,
        *files: str | os.PathLike[str],
        text: str | None = None,
        without: Sequence[str] = (),
        world: str | os.PathLike[str] | None = None,
        colors: str | os.PathLike[str] | None = None,
        step: float = 0.001,
        solver: str = "direct",
        solver_iterations: int = 0,
        friction_directions: int = 2,
        sleeping: bool = True,
        prefix: str = "",
        renderer: str = "auto",
    ) -> None:
        """Loads ADF files, then ADF text, then removes the objects that `without` names.

        world: a world file (gravity, ground); colors: a file of named colours (none: AMBF's); step: s of each step;
        solver: "direct", "si" or "mlcp"; solver_iterations: 0 for the solver's own; prefix: put before all namespaces;
        renderer: who draws pictures, "osmesa" (the processor), "egl" (a graphics card) or "auto" (a card if there is
        one).
        Raises LoadError where a file is refused, ValueError for the other arguments.
        """
        if not (math.isfinite(step) and 1e-6 <= step <= 0.1):
            raise ValueError(f"step={step}: not from 1e-6 to 0.1 s")
        if solver not in ("direct", "si", "mlcp"):
            raise ValueError(f"solver={solver!r}: not 'direct', 'si' or 'mlcp'")
        if friction_directions not in (1, 2) or not 0 <= solver_iterations <= 10000:
            raise ValueError("friction_directions is 1 or 2, solver_iterations at most 10000")
        if renderer not in ("auto", "osmesa", "egl"):
            raise ValueError(f"renderer={renderer!r}: not 'auto', 'osmesa' or 'egl'")
        self._renderer = renderer
        self._painter: Painter | None = None
        named = MODELS / "color/colors.yaml" if colors is None else Path(colors)
        colors_file = str(named) if colors is not None or named.is_file() else ""
        world_file = "" if world is None else os.fspath(world)
        try:
            self._native = _ambf_core.World(
                world_file, colors_file, step, solver, solver_iterations, friction_directions, sleeping, prefix
            )
        except _ambf_core.Refused as error:
            message, *findings = str(error).split("\n")
            raise LoadError(message, findings) from None
        self._version = -1
        self._saved: dict[str, tuple[int, list[NDArray[Any]]]] = {}
        for file in files:
            self._answer(self._native.load(os.fspath(file), "", "", _IDENTITY))
        if text is not None:
            self._answer(self._native.load("text.yaml", text, "", _IDENTITY))
        self._follow()
        for name in without:
            self.remove(name)
        if without:
            self.reset()  # what a reset goes back to: removing changes the order of what is left

    # ---- what exists ----

    def load(
        self,
        file: str | os.PathLike[str] | None = None,
        *,
        text: str | None = None,
        pose: ArrayLike = (0, 0, 0, 0, 0, 0, 1),
        prefix: str = "",
    ) -> str:
        """Loads a file, or a text (as if it were that file's), at a pose (m, quaternion x y z w); the model's name."""
        if file is None and text is None:
            raise ValueError("load takes a file or a text")
        numbers = np.array(pose, dtype=np.float64)
        if numbers.shape != (7,) or not np.isfinite(numbers).all() or abs(np.linalg.norm(numbers[3:]) - 1) > 0.1:
            raise ValueError(f"pose={pose!r}: not a position and a unit quaternion")
        numbers[3:] /= np.linalg.norm(numbers[3:])
        path = "text.yaml" if file is None else os.fspath(file)
        answer = self._native.load(path, text or "", prefix, numbers.tolist())
        self._follow()
        return self._answer(answer)

    def unload(self, model: str) -> None:
        """Removes a model and all that it brought. Raises ValueError where there is none of this name."""
        self._change(self._native.unload(model))

    def remove(self, name: str) -> None:
        """Removes one object (full name or the only one that contains it), and the joints at it."""
        self._change(self._native.remove(name))

    def body(self, name: str) -> int:
        """The row of a body. Raises LookupError."""
        return find(self.rows["bodies"], name)

    def joint(self, name: str) -> int:
        """The row of a joint. Raises LookupError."""
        return find(self.rows["joints"], name)

    def sensor(self, name: str) -> int:
        """The row of a sensor. Raises LookupError."""
        return find(self.rows["sensors"], name)

    def actuator(self, name: str) -> int:
        """The row of an actuator. Raises LookupError."""
        return find(self.rows["actuators"], name)

    # ---- steps ----

    def step(self, n: int = 1) -> None:
        """Runs n steps; `commands` act from the first on. With 0 nothing moves.

        Raises ValueError, with nothing moved, for commands that are not fit to act on; Diverged when the world has
        stopped, which it stays until reset() or restore().
        """
        if not self._native.step(n):
            self._report()
            if self.state.diverged:
                raise Diverged(self._native.frozen()[0])

    def reset(self) -> None:
        """As loaded: bodies, joints, time, parameters, gravity. Nothing is commanded."""
        self._native.reset()
        self._report()

    def hash(self) -> int:
        """64 bits of all that was computed: equal states (step, time, bodies, joints, contacts) have equal ones."""
        return int(self._native.hash())

    def frozen(self) -> list[str]:
        """Names of the bodies that diverged, or hang on one that did. The others go on."""
        return list(self._native.frozen())

    # ---- pictures ----

    def picture(
        self,
        camera: str | View = "",
        width: int = 640,
        height: int = 480,
        rgb: bool = True,
        depth: bool = False,
        mask: bool = False,
    ) -> Picture:
        """What a camera (its name; "": the first one) or a View sees of the newest step, drawn now.

        Raises LookupError for cameras that do not exist, ValueError for sizes and views that show nothing, RuntimeError
        where nothing can be drawn, and on another thread than that of the first picture.
        """
        slot, view = seen_by(camera, self.rows["cameras"])
        check_size(width, height)

        def draw(frame: object) -> tuple[Picture, list[str]]:
            if self._painter is None:
                self._painter = Painter(self._renderer)
            return self._painter.draw(frame, slot, view, (width, height), (rgb, depth, mask))

        picture, findings = self.look(draw)
        for each in findings:
            _log.warning("%s", each)
        return picture._replace(sim_step=int(self.state.sim_step))

    def look(self, see: Callable[[object], _T]) -> _T:
        """What `see` makes of the newest step; for Painter and Window, which must not keep it."""
        return self._native.with_frame(see)

    # ---- the whole state ----

    def snapshot(self, name: str = "") -> str:
        """Keeps the whole state in memory; returns its name. What continues here and after a restore is identical."""
        made = self._answer(self._native.snapshot(name))
        self._native.attach(*self._memory, True)
        self._saved[made] = (self._version, [each.copy() for each in self._memory[1]])
        return made

    def restore(self, name: str) -> None:
        """Goes back to a snapshot, commands included. Raises ValueError where there is none of this name."""
        self._answer(self._native.restore(name))
        version, commands = self._saved[name]
        self._follow()
        if version == self._version:
            for target, saved in zip(self._memory[1], commands, strict=True):
                target[...] = saved

    def forget(self, name: str) -> None:
        """Frees a snapshot."""
        self._answer(self._native.forget(name))
        del self._saved[name]

    # ---- parameters ----

    def set_parameter(self, name: str, parameter: str, value: ArrayLike) -> None:
        """Sets one of PARAMETERS of a body or joint until reset: a number, or x, y, z where it is per axis."""
        numbers = np.broadcast_to(np.asarray(value, dtype=np.float64), (3,))
        self._answer(self._native.set_parameter(name, parameter, numbers.tolist()))

    def parameter(self, name: str, parameter: str) -> float | NDArray[np.float64]:
        """The value in force after the last step."""
        value = self._native.parameter(name, parameter)
        return np.array(value) if PARAMETERS[parameter].per_axis else float(value[0])

    def set_gravity(self, gravity: ArrayLike) -> None:
        """m/s2, world axes, until reset; bodies with a gravity of their own keep it."""
        numbers = np.asarray(gravity, dtype=np.float64)
        if numbers.shape != (3,) or not np.isfinite(numbers).all():
            raise ValueError(f"gravity={gravity!r}: not three finite numbers")
        self._native.set_gravity(numbers.tolist())

    # ---- end ----

    def close(self) -> None:
        """Frees the world; its arrays keep their values. Twice is fine."""
        self._native.close()
        self._painter = None

    def __enter__(self) -> World:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()

    # ---- for WorldBatch ----

    def advance(self, n: int) -> None:
        """step(n) that leaves divergence to `state.diverged`."""
        if not self._native.step(n):
            self._report()

    def check_commands(self, commands: list[NDArray[Any]], count: int) -> tuple[int, str]:
        """The first of `count` equal worlds whose commands, in arrays with one more axis, would be refused, and why."""
        return self._native.check(commands, count)

    def share(self, memory: Memory) -> None:
        """State and commands are in this memory from now on."""
        self._memory = memory
        self.state = State(memory[0])
        self.commands = Commands(memory[1], self.rows)
        self._native.attach(*memory, False)

    # ---- inside ----

    def _change(self, answer: tuple[bool, str, list[str], str]) -> None:
        self._follow()
        self._answer(answer)

    def _answer(self, answer: tuple[bool, str, list[str], str]) -> str:
        success, message, findings, name = answer
        self._report()
        if not success:
            raise LoadError(message, findings) if findings else ValueError(message)
        return name

    def _report(self) -> None:
        for severity, text in self._native.take_log():
            _log.log(_LEVELS[severity], "%s", text)

    def _follow(self) -> None:
        """Takes new memory where the structure has changed, and shows the newest frame."""
        structure = self._native.structure()
        changed = structure["version"] != self._version
        if changed:
            before = None if self._version < 0 else (self.commands, self.rows)
            self._take_structure(structure)
            self._memory = allocate(self.counts)
            self.state = State(self._memory[0])
            self.commands = Commands(self._memory[1], self.rows)
            self._native.attach(*self._memory, False)
            if before is not None:
                carry_over(*before, self.commands, self.rows)
        else:
            self._native.attach(*self._memory, True)

    def _take_structure(self, structure: dict[str, Any]) -> None:
        self._version = structure["version"]
        self.bodies, self.joints, self.models = structure["bodies"], structure["joints"], structure["models"]
        self.joint_limits = np.array(structure["limits"], dtype=np.float64).reshape(-1, 2)
        self.commandable = np.array(structure["commanded"], dtype=np.bool_)
        self.masses = np.array(structure["masses"], dtype=np.float64)
        self.sensors, self.actuators = structure["sensors"], structure["actuators"]
        self.cameras = structure["cameras"]
        self.elements = [slice(first, first + count) for first, count in structure["elements"]]
        self.tasks = tasks_of(structure)
        kinds = ("bodies", "joints", "sensors", "actuators", "cameras", "tasks")
        self.rows = {kind: {name: row for row, name in enumerate(structure[kind])} for kind in kinds}
        self.counts = {kind: len(self.rows[kind]) for kind in kinds}
        self.counts |= {"contacts": _ambf_core.MAX_CONTACTS, "punctures": structure["punctures"]}
        self.counts["elements"] = max((each.stop for each in self.elements), default=0)
        self.counts |= rows_of(self.tasks)


_IDENTITY = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
