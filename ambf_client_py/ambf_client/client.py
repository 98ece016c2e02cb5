"""The client: finds the objects of a simulation, gives handles to them, and keeps sending their commands.

Long: scripts find each service of the world here.
"""

from __future__ import annotations

import os
import threading
import time
from typing import Any

import rospy
from ros_abstraction_layer._interrupt import raise_if_interrupted

from ._generations import DISCOVERY_ATTEMPTS, attempts_and_namespace
from ._master import Master
from ._objects import Callback, Objects
from ._say import say
from .base_object import BaseObject
from .discovery import Discovery
from .handle import Gate, Handle
from .kinds import handle_class, handle_classes
from .node import Node
from .services import Kept, ModelId, ThingId
from .task import TaskAccess
from .world import World

_DEFAULT_RATE = 120.0  # commands a second and object, as the original
_FIRST_STATE = 2.0  # s that getting a handle waits for its first state
_ATTEMPT, _POLL = 1.0, 0.05  # s of an attempt of connect() to find a simulator, and between its looks

Names = list[str]  # inside the class, list is a method


class Client(TaskAccess, Node):
    """A client of the AMBF simulator.

        with Client() as client:
            box = client.wait_for("Box")
            box.set_force(0.0, 0.0, 5.0)

    Objects are found while the client runs, whenever they are loaded. Their names are their topics without /State, e.g.
    /ambf/env/psm/baselink; wherever a name is asked for, any part of it that fits only one object will do.
    """

    def __init__(
        self,
        client_name: str = "ambf_client",
        max_discovery_attempts: int | str = DISCOVERY_ATTEMPTS,
        namespace: str | int = "",
        *,
        ral: Any = None,
    ) -> None:
        """client_name: of the ROS node (a number is added). namespace: only objects below it, e.g. /left/ambf/env/.

        max_discovery_attempts: seconds, less one, that connect() waits for a simulator. It and namespace may change
        places. ral: a node of ros_abstraction_layer, e.g. another client's, instead of one of its own.
        """
        super().__init__(client_name, ral)
        self._attempts, namespace = attempts_and_namespace(max_discovery_attempts, namespace)
        self._period = 1.0 / _DEFAULT_RATE
        self._gate = Gate()
        self._objects = Objects(namespace, self._gate, self._connect_world)
        self._discovery: Discovery | None = None
        self._sender: threading.Thread | None = None
        self._stop = threading.Event()

    # --- connecting ------------------------------------------------------------------------------------------------

    def connect(self, default_publish_rate: float = _DEFAULT_RATE) -> None:
        """Finds what there is and starts sending; default_publish_rate: commands a second for each object.

        Waits for a ROS master, and a few seconds for a simulator (max_discovery_attempts). One that comes later is
        found, too: see wait_for.
        """
        self.create_objs_from_rostopics(default_publish_rate)
        self._await_simulator()
        self.start()

    def create_objs_from_rostopics(self, publish_rate: float = _DEFAULT_RATE) -> None:
        """Becomes a ROS node, unless the script already is one, and finds what there is."""
        self.set_publish_rate(publish_rate)
        if self._discovery is None:
            self._become_node()
            self._objects.ral = self.ral
            rospy.on_shutdown(self._end)
            self._discovery = Discovery(Master(rospy.get_name()), self._objects.open_topics, self._objects.change)
        self._discovery.look()

    def start(self) -> None:
        """Starts sending commands and watching for new objects, each in a thread of its own."""
        if self._discovery is None:
            self.create_objs_from_rostopics()
        if self._sender is not None:
            return
        self._stop.clear()
        self._sender = threading.Thread(target=self._send, name="ambf_client commands", daemon=True)
        self._sender.start()
        assert self._discovery is not None
        self._discovery.start()

    def refresh(self) -> None:
        """Finds what is new now, instead of a moment later."""
        if self._discovery is None:
            self.create_objs_from_rostopics(1.0 / self._period)
        else:
            self._discovery.look()

    def set_publish_rate(self, rate: float) -> None:
        """Commands a second for each commanded object."""
        if not rate > 0.0:
            raise ValueError(f"the publish rate must be positive, not {rate}")
        self._period = 1.0 / float(rate)

    def clean_up(self) -> None:
        """Stops everything and closes all topics. What was commanded ends 0.5 s later, by the simulator's watchdog."""
        self._stop.set()
        if self._gate.waits and self._objects.world is not None and not rospy.is_shutdown():
            try:
                self._objects.world.release()
            except (OSError, RuntimeError) as error:
                say(f"the world could not be released: {error}")
        if self._discovery is not None:
            self._discovery.stop()
            self._discovery = None
        if self._sender is not None and self._sender is not threading.current_thread():
            self._sender.join(1.0)
        self._sender = None
        self._objects.forget()

    def __enter__(self) -> Client:
        if self._sender is None:
            self.connect()
        return self

    def __exit__(self, *_: object) -> None:
        self.clean_up()

    # --- objects ---------------------------------------------------------------------------------------------------

    def get_common_namespace(self) -> str:
        """What the names of all objects begin with, e.g. /ambf/env/."""
        common = os.path.commonprefix(list(self._objects.kinds()))
        if not common:
            return "/"
        return common[: common.rfind("/") + 1]

    def get_world_handle(self) -> World | None:
        """The world; None, and a message, when there is no simulator."""
        if self._objects.world is None:
            self.refresh()
        if self._objects.world is None:
            say("there is no simulator: no topic .../World/State at the master")
        return self._objects.world

    @property
    def world(self) -> World:
        """The world; waits up to 10 s for a simulator."""
        found = self.wait_for("World")
        assert isinstance(found, World)
        return found

    def get_obj_names(self) -> Names:
        """Names of all objects there are, and World."""
        kinds = self._objects.kinds()
        return ["World" if kind == World.state_type._type else name for name, kind in kinds.items()]

    def create_obj(self, topic_name: str, msg_type: str) -> Any:
        """Makes the handle of one State topic, which may come later; returns it. msg_type: ambf_msgs/CameraState, say.

        Raises ValueError where there is no handle for that type.
        """
        kind = msg_type.replace("/msg/", "/")
        if handle_class(kind) is None:
            raise ValueError(f"there is no handle for {msg_type!r}; known: {', '.join(sorted(handle_classes()))}")
        return self._objects.add(topic_name.removesuffix("/State"), kind)

    def get_obj_handle(self, a_name: Any, timeout: float = _FIRST_STATE) -> Any:
        """The handle of the object of that name, or of the only one whose name contains it; otherwise None.

        It shows a state, for which it waits up to timeout seconds. Why there is no handle is said. Entries of
        list().objects are taken for their names; what is no name raises TypeError.
        """
        name, problem = self._objects.find(a_name)
        if name is None:
            self.refresh()
            name, problem = self._objects.find(a_name)
        if name is None:
            say(problem)
            return None
        return self._activate(name, timeout)

    def wait_for(self, name: Any, timeout: float = 10.0) -> Any:
        """The handle of an object once it is there and shows a state; TimeoutError says what there is instead."""
        deadline = time.monotonic() + timeout
        while True:
            self.refresh()
            found, problem = self._objects.find(name)
            if found is not None:
                handle = self._activate(found, max(0.0, deadline - time.monotonic()), quiet=True)
                if handle.has_state():
                    return handle
                problem = f"'{found}' has sent no state"
            if time.monotonic() >= deadline or rospy.is_shutdown():
                raise_if_interrupted()
                raise TimeoutError(f"not within {timeout} s: {problem}")
            time.sleep(0.02)

    def on_object_added(self, callback: Callback) -> None:
        """callback(name) is called for each object that appears from now on, in the client's own thread."""
        self._objects.on_added.append(callback)

    def on_object_removed(self, callback: Callback) -> None:
        """callback(name) is called for each object that disappears, also with its simulator."""
        self._objects.on_removed.append(callback)

    def get_obj_pose(self, a_name: str) -> Any:
        """[x, y, z, roll, pitch, yaw] of an object (m, rad); None if there is no such object."""
        handle = self.get_obj_handle(a_name)
        return handle.get_pose() if handle is not None else None

    def set_obj_cmd(self, a_name: str, fx: float, fy: float, fz: float, nx: float, ny: float, nz: float) -> None:
        """Commands force and torque on an object (N, N m, world axes)."""
        handle = self.get_obj_handle(a_name)
        if handle is not None:
            handle.wrench_command(fx, fy, fz, nx, ny, nz)

    def print_active_topics(self) -> None:
        """Prints all topics of the simulation."""
        for name in sorted(self._objects.kinds()):
            print(f"{name}/State\n{name}/Command")

    def print_summary(self) -> None:
        """Prints the objects there are, by kind."""
        by_kind: dict[str, list[str]] = {}
        for name, kind in sorted(self._objects.kinds().items()):
            by_kind.setdefault(kind.rpartition("/")[2].removesuffix("State"), []).append(name)
        print(f"{sum(map(len, by_kind.values()))} objects below {self.get_common_namespace()}")
        for kind, names in sorted(by_kind.items()):
            print(f"  {kind} ({len(names)})")
            for name in names:
                print(f"    {name}{'  (in use)' if self._objects.handle(name).is_active() else ''}")

    # --- the world's services --------------------------------------------------------------------------------------

    def load(self, path: str = "", **options: Any) -> Any:
        """See World.load."""
        return self.world.load(path, **options)

    def unload(self, model: ModelId) -> Names:
        """See World.unload."""
        return self.world.unload(model)

    def save(self, model: ModelId, path: str = "", **options: Any) -> Any:
        """See World.save."""
        return self.world.save(model, path, **options)

    def save_scene(self, folder: str | os.PathLike[str], **options: Any) -> Any:
        """See World.save_scene."""
        return self.world.save_scene(folder, **options)

    def remove(self, name: ThingId) -> Names:
        """See World.remove."""
        return self.world.remove(name)

    def list(self, model: ModelId = "") -> Any:
        """See World.list."""
        return self.world.list(model)

    def snapshot(self, name: str = "", path: str = "") -> Any:
        """See World.snapshot."""
        return self.world.snapshot(name, path)

    def restore(self, name: str | Kept = "", path: str = "") -> Any:
        """See World.restore."""
        return self.world.restore(name, path)

    def forget(self, name: str | Kept) -> None:
        """See World.forget."""
        self.world.forget(name)

    # --- inside ----------------------------------------------------------------------------------------------------

    def _await_simulator(self) -> None:
        deadline = time.monotonic() + max(0, self._attempts - 1) * _ATTEMPT
        if not self._objects.kinds() and self._attempts > 1:
            say(f"there is no simulator yet: waiting up to {self._attempts - 1} s for one")
        while not self._objects.kinds() and time.monotonic() < deadline and not rospy.is_shutdown():
            time.sleep(_POLL)
            self.refresh()

    def _end(self) -> None:
        if self._objects.world is not None:
            self._objects.world._release_at_end()

    def _connect_world(self, world: World) -> None:
        world._serve(self._gate, self._objects.in_use, self._resolve, self._await_change)

    def _activate(self, name: str, timeout: float, quiet: bool = False) -> Any:
        handle = self._objects.handle(name)
        if isinstance(handle, World):
            handle.wait_for_state(timeout)
            return handle
        fresh, deadline = not handle.is_active(), time.monotonic() + timeout
        handle.set_active()
        if fresh or not handle.has_state():
            shown = handle.wait_for_state(timeout)
            handle.wait_for_connection(max(0.0, deadline - time.monotonic()))
            if shown:
                self._complete(handle, deadline)
            elif not quiet:
                say(f"{name} has sent no state within {timeout} s; it reads as zeros until it does")
        if self._gate.stepping and self._objects.world is not None and isinstance(handle, BaseObject):
            self._objects.world._stepper.show(handle)
        return handle

    @staticmethod
    def _complete(handle: Handle, deadline: float) -> None:
        """The first state may have been sent before the simulator received the request for joint lists."""
        deadline = min(deadline, time.monotonic() + 0.3)
        for _ in range(2):
            if handle._is_complete() or not handle.wait_for_next_state(max(0.0, deadline - time.monotonic())):
                return

    def _resolve(self, name: Any) -> BaseObject:
        if isinstance(name, BaseObject):
            return name
        found, problem = self._objects.find(name)
        if found is None:
            raise LookupError(problem)
        handle: BaseObject = self._activate(found, _FIRST_STATE)
        return handle

    def _await_change(self, added: Names, removed: Names, timeout: float = 2.0) -> None:
        """Waits until the topics of what was loaded or removed have come or gone."""
        if (world := self._objects.world) is None:
            return
        wanted = {o.topic for o in world.list().objects if o.topic}
        deadline = time.monotonic() + timeout
        while time.monotonic() < deadline:
            self.refresh()
            present = set(self._objects.names())
            mine = {name for name in present if name.startswith(world._topic.rpartition("/")[0] + "/")}
            if wanted <= present and not (removed and mine - wanted):
                return
            time.sleep(0.01)

    def _send(self) -> None:
        due = time.monotonic()
        while not self._stop.is_set() and not rospy.is_shutdown():
            for handle in self._objects.in_use():
                handle.run_publisher()
            due = max(due + self._period, (now := time.monotonic()) - self._period)
            self._stop.wait(max(0.0, due - now))
