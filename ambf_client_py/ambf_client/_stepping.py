"""Steps the world by the Step service: commands go with the request, states of that very step come with the answer."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable, Mapping
from typing import Any

import rospy
from ros_abstraction_layer._interrupt import raise_if_interrupted

from ._messages import Message, Step, srv
from .base_object import BaseObject
from .handle import Gate, Handle
from .services import Services, SimulatorUnavailable, StepResult, checked

# Commands that are under way on topics when stepping begins arrive within this time.
_SETTLE = 0.02
_START = 3.0  # s that a starting simulator may need to offer its services


class Stepper:
    """The stepping of one world. Calls from several threads take turns."""

    def __init__(self, world: Handle, gate: Gate, services: Services) -> None:
        self._world = world
        self._gate = gate
        self._services = services
        self._proxy: Any = None
        self._lock = threading.Lock()
        self._names: dict[str, str] = {}  # topic: full name

    def step(
        self, n: int, commands: Mapping[Any, Message], handles: Iterable[BaseObject], only: bool = False
    ) -> StepResult:
        """See World.step."""
        with self._lock:
            handles = [h for h in handles if h.step_lists is not None]
            if not self._gate.stepping:
                self._begin(handles)
            if only:
                return self._run(n, commands, handles)
            for handle, command in commands.items():
                handle.set_command(command)
            set_before = {h: h._current_command() for h in handles if h.is_commanded() or h._cleared}
            for handle in set_before:
                handle._cleared = False
            return self._run(n, set_before, handles)

    def show(self, handle: BaseObject) -> None:
        """Fills a handle that was got while the world waits."""
        with self._lock:
            if self._gate.stepping and handle.step_lists is not None:
                self._run(0, {}, [handle])

    def end(self, handles: Iterable[BaseObject]) -> None:
        """From now on commands go by topics again."""
        with self._lock:
            if not self._gate.stepping:
                return
            # What the steps commanded ends here, or forces would count twice until its watchdog expires.
            request = srv.StepRequest(n=0)
            ended = False
            for handle in handles:
                if handle.commands_add_up and handle.is_commanded():
                    self._add_command(request, handle, handle._letting_go())
                    ended = True
            self._gate.stepping = False
            try:
                if ended:
                    self._call(request)
            finally:
                self.close()

    def close(self) -> None:
        """Closes the connection to the service."""
        if self._proxy is not None:
            self._proxy.close()
        self._proxy = None

    def _give_up(self) -> None:
        """Whether the world waits is unknown: the next step begins anew."""
        self._gate.stepping = False  # but it may still wait for us
        self.close()

    def _begin(self, handles: Iterable[BaseObject]) -> None:
        self._gate.waits = True
        self._reach()
        self._gate.stepping = True
        # Topics and steps are different sources to the simulator, whose forces add: those of the topics end here.
        for handle in handles:
            if handle.commands_add_up:
                handle._withdraw()
        time.sleep(_SETTLE)

    def _reach(self) -> None:
        """A simulator that just starts may not offer the service yet, while a dead one's is still registered."""
        deadline = time.monotonic() + _START
        while True:
            try:
                self._call(srv.StepRequest(n=0))
                return
            except SimulatorUnavailable:
                if time.monotonic() > deadline or rospy.is_shutdown():
                    raise
                time.sleep(0.05)

    def _run(self, n: int, commands: Mapping[BaseObject, Message], wanted: list[BaseObject]) -> StepResult:
        request = srv.StepRequest(n=n)
        for handle, command in commands.items():
            self._add_command(request, handle, command)
        request.wanted_states = [self._name_of(handle) for handle in wanted]
        answer = self._call(request)
        if not self._deliver(answer, wanted):
            # Something was loaded, renamed or removed meanwhile.
            self._names.clear()
            wanted = [h for h in wanted if self._is_there(h)]
            again = srv.StepRequest(n=0, wanted_states=[self._name_of(h) for h in wanted])
            self._deliver(self._call(again), wanted)
        self._world._accept_step(answer.world)
        return StepResult(answer.sim_step, answer.sim_time)

    def _add_command(self, request: Message, handle: BaseObject, command: Message) -> None:
        lists = handle.step_lists
        if lists is not None and lists.names:
            getattr(request, lists.names).append(self._name_of(handle))
            getattr(request, lists.commands).append(command)

    @staticmethod
    def _deliver(answer: Message, wanted: list[BaseObject]) -> bool:
        by_kind: dict[str, list[BaseObject]] = {}
        for handle in wanted:
            assert handle.step_lists is not None
            by_kind.setdefault(handle.step_lists.states, []).append(handle)
        if any(len(getattr(answer, kind)) != len(handles) for kind, handles in by_kind.items()):
            return False
        for kind, handles in by_kind.items():
            for handle, state in zip(handles, getattr(answer, kind), strict=True):
                handle._accept_step(state)
        return True

    def _name_of(self, handle: BaseObject) -> str:
        if handle._topic not in self._names:
            self._is_there(handle)
        return self._names.get(handle._topic, handle._topic)

    def _is_there(self, handle: BaseObject) -> bool:
        if handle._topic not in self._names:
            self._names = {o.topic: o.name for o in self._services.list().objects if o.topic}
        return handle._topic in self._names

    def _call(self, request: Message) -> Message:
        name = f"{self._world._topic}/Step"
        try:
            if self._proxy is None:
                self._proxy = rospy.ServiceProxy(name, Step, persistent=True)
            answer = self._proxy(request)
        except (rospy.ServiceException, OSError, AttributeError) as error:
            self._give_up()
            raise_if_interrupted(error)
            raise SimulatorUnavailable(f"{name}: {error}; whether the steps were run is not known") from error
        except BaseException:  # interrupted in the middle of an answer: what comes next would be its rest
            self._give_up()
            raise
        return checked(answer, "Step")
