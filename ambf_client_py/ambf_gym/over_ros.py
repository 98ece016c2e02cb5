"""A running simulator in place of a world in this process: the Step service moves it, to the same states."""

from __future__ import annotations

import os
import time
import uuid
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import rospy
from ambf_client import Client, RequestRefused, SimulatorUnavailable
from ambf_client._messages import msg, srv
from ambf_core import BodyMode, Commands, Picture, State, View, World
from ambf_core.arrays import allocate, find
from ambf_core.tasks import Task
from numpy.typing import ArrayLike
from ros_abstraction_layer._interrupt import raise_if_interrupted

from .ros_messages import check_commands, command_of, show_body
from .ros_tasks import TaskTopics

_LOADING = 10.0  # s
_DRAWING = 10.0  # s in which a simulator with windows has drawn something, even if it has just begun
_STEP = 0.001  # s, World's own
_DIVERGED = "the simulation diverged"  # how the Step service begins its answer then
_T = TypeVar("_T")


class RosWorld:
    """Names, rows, limits, `state` and `commands` as World has them; the simulator must have loaded the same files.

    It is reset at the beginning, and waits for these steps until close(). Of the state there are `diverged`, poses and
    twists of bodies that have topics, their joints, and tasks (errors of goals as float32); all else is NaN, -1 or
    False, and bodies that freeze while the others go on are in the simulator's log alone. A joint whose mode becomes
    NONE keeps its command until the simulator's watchdog ends it.

    All calls raise RuntimeError after close(), and SimulatorUnavailable where the simulator is gone. From then on
    `lost` is true and they go on raising it, until reconnect().
    """

    def __init__(
        self, *files: str | os.PathLike[str], world: str | os.PathLike[str] | None = None, without: Sequence[str] = ()
    ) -> None:
        """Raises ValueError where the simulator lacks what the files load, SimulatorUnavailable where none answers."""
        with World(*files, world=world, without=without, step=_STEP) as plan:
            self.bodies, self.joints, self.rows = plan.bodies, plan.joints, plan.rows
            self.sensors, self.actuators, self.elements = plan.sensors, plan.actuators, plan.elements
            self.joint_limits, self.commandable, self.masses = plan.joint_limits, plan.commandable, plan.masses
            self.tasks = plan.tasks
            state, commands = allocate(plan.counts)
            self._start = [each.copy() for each in plan.commands.arrays()]
        self._arrays = dict(zip(State.fields(), state, strict=True))
        self.state, self.commands = State(state), Commands(commands, self.rows)
        self._saved: dict[str, list[np.ndarray[Any, Any]]] = {}
        self._files, self._without = [Path(each) for each in files], list(without)
        self.changed = False  #: files were loaded with other values in them
        self._due: float | None = None  # time.monotonic() at which the newest steps are over, where somebody watches
        self._proxy: Any = None
        self._client: Any = None
        self._world: Any = None
        self._judges: TaskTopics | None = None
        self._led_bodies: set[int] = set()  # rows that obey a command, which holds until another one is sent
        self.lost = False  #: the simulator did not answer
        self._connect()

    def reconnect(self) -> None:
        """Connects to the simulator that runs now, as at the beginning; earlier snapshots are gone."""
        if self._client is None and not self.lost:
            raise RuntimeError("the world is closed")
        self._disconnect()
        self.lost = False
        try:
            self._connect()
        except BaseException:
            self.lost = True
            raise

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

    def task(self, name: str) -> Task:
        """As World's. Raises LookupError."""
        return self.tasks[find(self.rows["tasks"], name)]

    def step(self, n: int = 1) -> None:
        """As World's, but a world that diverges only sets state.diverged.

        Raises ValueError, with nothing moved, for commands to actuators and to bodies and joints without topics.
        """
        check_commands(self.commands, self.rows, self._shown, self._led)
        request = srv.StepRequest(n=n, wanted_states=[self.bodies[row] for row in self._shown])
        for row in self._shown:
            command = self._command(row)
            if command is not None:
                request.rigid_body_names.append(self.bodies[row])
                request.rigid_body_cmds.append(command)
        self._show(self._call(request))
        if self._due is not None:
            self._due = max(self._due + n * _STEP, time.monotonic())
            time.sleep(self._due - min(self._due, time.monotonic()))

    def picture(self, camera: str | View = "", width: int = 640, height: int = 480) -> Picture:
        """Raises ValueError: cameras of a simulator have topics."""
        raise ValueError("pictures: over ROS they come from the topics of the simulator's cameras")

    def show(self) -> None:
        """Steps take the time that they simulate from now on, for eyes. Raises ValueError where the simulator draws
        nothing: it was started without a display, or with -g false."""
        end = time.monotonic() + _DRAWING
        while time.monotonic() < end:
            with suppress(rospy.ROSException):
                if rospy.wait_for_message("/ambf/env/World/Rates", msg.WorldRates, _DRAWING).frames_per_second > 0:
                    self._due = time.monotonic()
                    return
        raise ValueError("render_mode='human': the simulator has no window; start it with a display")

    def set_parameter(self, name: str, parameter: str, value: ArrayLike) -> None:
        """As World's, until the next reset or restore of the simulator's world."""
        numbers = np.broadcast_to(np.asarray(value, dtype=np.float64), (3,)).tolist()
        self._ask(lambda: self._world.set_parameter(name, parameter, numbers))

    def set_gravity(self, gravity: ArrayLike) -> None:
        """As World's."""
        numbers = np.asarray(gravity, dtype=np.float64).tolist()
        self._ask(lambda: self._world.set_gravity(numbers))

    def load_instead(self, texts: Sequence[str | None] = ()) -> None:
        """Unloads what the files brought and loads them anew, a text in place of each that has one.

        The world is then as loaded; earlier snapshots are gone. Raises RequestRefused where a text is refused.
        """
        texts = texts or [None] * len(self._files)
        self._forget()
        self.changed = any(text is not None for text in texts)
        brought = {Path(each.path).name: each for each in self._ask(self._world.list).models}
        models = [brought[file.name] for file in self._files]
        for model in reversed(models):
            self._ask(partial(self._world.unload, model))
        for model, text in zip(models, texts, strict=True):
            self._ask(partial(self._world.load, model.path, text=text or ""))
        self._write(self._start)
        self._blank()
        self._take_up()

    def snapshot(self) -> str:
        """Keeps the whole state in the simulator; returns its name."""
        name = f"ambf_gym {uuid.uuid4()}"  # which no other simulator has
        self._ask(lambda: self._world.snapshot(name))
        self._saved[name] = [each.copy() for each in self.commands.arrays()]
        return name

    def restore(self, name: str) -> None:
        """Goes back to a snapshot, commands included."""
        if name not in self._saved:
            self._ask(lambda: None)  # raises where the world is closed or lost
            raise ValueError(f"there is no snapshot '{name}'")
        try:
            self._ask(lambda: self._world.restore(name))
        except RequestRefused as error:
            if name in self._ask(self._world.list).snapshots:
                raise
            self._lose()
            raise SimulatorUnavailable(f"another simulator runs now: {error}") from error
        self._write(self._saved[name])
        self._led_bodies = set(np.flatnonzero(self.commands.body_mode != BodyMode.NONE).tolist())
        self._arrays["diverged"][...] = False
        self._show(self._call(self._request_of_states()))

    def frozen(self) -> list[str]:
        """Where the world has diverged, what stands for the body that the simulator's log names."""
        return ["a body that the simulator's log names"] if self.state.diverged else []

    def close(self) -> None:
        """Frees its snapshots, brings back what files had loaded, and lets the simulator run by itself again. Twice is
        fine."""
        if self._world is not None and not self.lost:
            self._forget()
            with suppress(OSError, RuntimeError, ValueError):  # the simulator may end at any time
                if self.changed:
                    self.load_instead()
        self._disconnect()
        self.lost = False

    # ---- inside ----

    def _connect(self) -> None:
        self._saved.clear()
        self._write(self._start)
        self._blank()
        self._client = Client("ambf_gym")
        try:
            self._client.connect()
            try:
                self._world = self._client.world
            except TimeoutError as error:
                raise SimulatorUnavailable(str(error)) from error
            before = self._world.step(0)
            self._wait_for_bodies()
            if not np.isclose(self._world.step(1).sim_time - before.sim_time, _STEP, rtol=1e-6, atol=0):
                raise ValueError(f"the simulator does not make steps of {_STEP} s")
            self.changed = False
            self._take_up()
        except BaseException:
            self._disconnect()
            raise

    def _take_up(self) -> None:
        """Removes what the task has no use for, finds the rest, and resets."""
        self._remove()
        listed = self._wait_for_bodies()
        self._shown = [row for row, name in enumerate(self.bodies) if listed[name]]
        if self._judges is not None:
            self._judges.close()
        self._judges = TaskTopics(self.tasks, listed)
        self._world.reset()
        self._led: dict[int, list[tuple[int, int]]] = {}
        self._led_bodies.clear()
        self._find_joints(self._call(self._request_of_states()))

    def _forget(self) -> None:
        for name in self._saved:
            with suppress(OSError, RuntimeError):  # the simulator may end at any time
                self._world.forget(name)
        self._saved.clear()

    def _remove(self) -> None:
        """Removes what World does, by the same names, and finds out whether the same bodies are left."""
        for each in self._without:
            if any(each in listed.name for listed in self._world.list().objects):
                self._world.remove(each)  # else an environment before this one has
        further = [each.name for each in self._world.list().objects if each.kind == "rigid_body"]
        further = [name for name in further if name not in self.rows["bodies"]]
        if further:
            raise ValueError(f"the simulator has {', '.join(further)}, which this task's files do not load")

    def _disconnect(self) -> None:
        if self._proxy is not None:
            self._proxy.close()
        if self._client is not None:
            self._client.clean_up()
        if self._judges is not None:
            self._judges.close()
        self._proxy = self._client = self._world = self._judges = None

    def _lose(self) -> None:
        if self._proxy is not None:
            self._proxy.close()
        self._proxy, self.lost, self.changed = None, True, False

    def _ask(self, call: Callable[[], _T]) -> _T:
        """What a request to the simulator returns. One that it does not answer loses it."""
        if self.lost:
            raise SimulatorUnavailable("the simulator was lost: reconnect() or make another world")
        if self._client is None:
            raise RuntimeError("the world is closed")
        try:
            return call()
        except SimulatorUnavailable:
            self._lose()
            raise

    def _wait_for_bodies(self) -> dict[str, str]:
        """Topics of all objects, by name. A simulator that has just started may still be loading."""
        end = time.monotonic() + _LOADING
        while True:
            listed = {each.name: each.topic for each in self._world.list().objects}
            missing = [name for name in (*self.bodies, *self.rows["tasks"]) if name not in listed]
            if not missing:
                return listed
            if time.monotonic() > end:
                raise ValueError(f"the simulator has no {', '.join(missing)}: start it with the files of this task")
            time.sleep(0.1)

    def _request_of_states(self) -> Any:
        return srv.StepRequest(wanted_states=[self.bodies[row] for row in self._shown])

    def _call(self, request: Any) -> Any:
        """The answer of the Step service, or of a world that diverged."""

        def call() -> Any:
            try:
                if self._proxy is None:
                    self._proxy = rospy.ServiceProxy("/ambf/env/World/Step", srv.Step, persistent=True)
                if self._judges is not None:
                    self._judges.forget()
                return self._proxy(request)
            # rospy's connection has no socket (AttributeError) once the other side has closed it
            except (rospy.ServiceException, OSError, AttributeError) as error:
                raise_if_interrupted(error)
                raise SimulatorUnavailable(f"the simulator does not step: {error}") from error

        answer = self._ask(call)
        diverged = not answer.success and answer.message.startswith(_DIVERGED)
        self._arrays["diverged"][...] = diverged
        if not answer.success and not diverged:
            raise RequestRefused(answer.message, [])
        return answer

    def _find_joints(self, answer: Any) -> None:
        """Each joint is commanded and read by the first body that lists it, as in World."""
        seen: set[int] = set()
        for row, body in zip(self._shown, answer.rigid_bodies, strict=True):
            rows = [find(self.rows["joints"], name) for name in body.joint_names]
            self._led[row] = [(entry, joint) for entry, joint in enumerate(rows) if joint not in seen]
            seen.update(rows)
        self._show(answer)

    def _command(self, row: int) -> Any:
        command = command_of(self.commands, row, self._led[row], row in self._led_bodies)
        if command is not None:
            led = self.commands.body_mode[row] != BodyMode.NONE
            (self._led_bodies.add if led else self._led_bodies.discard)(row)
        return command

    def _blank(self) -> None:
        """What no message carries is never mistaken for a value."""
        for array in self._arrays.values():
            array[...] = np.nan if array.dtype.kind == "f" else -1 if array.dtype.kind == "i" else False

    def _show(self, answer: Any) -> None:
        arrays = self._arrays
        if self.state.diverged and len(answer.rigid_bodies) != len(self._shown):
            return  # the last good step stays
        arrays["sim_step"][...], arrays["sim_time"][...] = answer.sim_step, answer.sim_time
        for row, body in zip(self._shown, answer.rigid_bodies, strict=True):
            show_body(arrays, row, body, self._led.get(row, []))
        if self._judges is not None:
            self._judges.show(answer.sim_step, arrays)

    def _write(self, values: list[np.ndarray[Any, Any]]) -> None:
        for array, value in zip(self.commands.arrays(), values, strict=True):
            array[...] = value
