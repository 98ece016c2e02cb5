"""The objects that a client knows: one handle for each, kept for as long as the client lives, present or not."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable, Sequence
from typing import Any

from ._master import View
from ._say import say
from .base_object import BaseObject
from .handle import Gate, Handle
from .kinds import handle_class
from .services import Listing, ObjectInfo
from .world import World

_WORLD = World.state_type._type

Callback = Callable[[str], None]


class Objects:
    """Which objects there are, and their handles. May be used from any thread."""

    def __init__(self, namespace: str, gate: Gate, connect_world: Callable[[World], None]) -> None:
        """namespace: only objects below it. connect_world is called with each new world."""
        self._prefix = "/" + namespace.strip("/") + "/" if namespace.strip("/") else "/"
        self._gate = gate
        self._connect_world = connect_world
        self._lock = threading.RLock()
        self._handles: dict[str, Handle] = {}  # all that were ever seen
        self._present: dict[str, str] = {}  # those there are: message type
        self._had_world = False
        self.world: World | None = None
        self.ral: Any = None  # for the handles made from now on
        self.on_added: list[Callback] = []
        self.on_removed: list[Callback] = []

    def kinds(self) -> dict[str, str]:
        """The objects there are: {name: message type}."""
        with self._lock:
            return dict(self._present)

    def names(self) -> list[str]:
        """The objects there are, without worlds."""
        with self._lock:
            return [name for name, kind in self._present.items() if kind != _WORLD]

    def handle(self, name: str) -> Any:
        """The handle of an object that was seen."""
        with self._lock:
            return self._handles[name]

    def in_use(self) -> Sequence[BaseObject]:
        """The connected handles of objects there are."""
        with self._lock:
            present = [self._handles[name] for name in self._present]
        return [handle for handle in present if handle.is_active() and isinstance(handle, BaseObject)]

    def open_topics(self) -> Sequence[tuple[str, str, bool]]:
        """The topics of all connected handles; see Handle.open_topics."""
        with self._lock:
            handles = list(self._handles.values())
        return [topic for handle in handles if handle.is_active() for topic in handle.open_topics()]

    def forget(self) -> None:
        """Closes all handles."""
        with self._lock:
            handles = list(self._handles.values())
            self._handles.clear()
            self._present.clear()
            self.world = None
        for handle in handles:
            handle.set_inactive()

    def find(self, wanted: Any) -> tuple[str | None, str]:
        """(the only object that the name fits, why there is none). Handles and listed objects are named by themselves.

        Raises TypeError where it is none of them.
        """
        if isinstance(wanted, ObjectInfo):
            if not wanted.topic:
                return None, f"{wanted.name} has no topics: it is `passive: true` in its file"
            wanted = wanted.topic
        elif isinstance(wanted, Handle):
            wanted = wanted._topic
        if not isinstance(wanted, str):
            raise TypeError(f"an object is named by text, its handle or its entry in list(), not by {wanted!r}")
        kinds = self.kinds()
        if wanted == "World" and self.world is not None and self.world._topic in kinds:
            return self.world._topic, ""
        for fits in (
            [name for name in kinds if name == wanted],
            [name for name in kinds if name.endswith("/" + wanted.lstrip("/"))],
            [name for name in kinds if wanted in name],
        ):
            if len(fits) == 1:
                return fits[0], ""
            if fits:
                return None, f"'{wanted}' fits several objects: {', '.join(sorted(fits))}"
        there = f"there are: {', '.join(sorted(kinds))}" if kinds else "there is no simulator"
        return None, f"there is no object '{wanted}'; {there}"

    def change(self, view: View, added: Sequence[str], removed: Sequence[str]) -> None:
        """Takes over what discovery found; the view has only kinds with a registered handle."""
        added = [name for name in added if name.startswith(self._prefix)]
        with self._lock:
            removed = [name for name in removed if name in self._present]
            for name in removed:
                del self._present[name]
            for name in added:
                self._present[name] = view.objects[name]
                kind = handle_class(view.objects[name])
                if type(self._handles.get(name)) is not kind:
                    self._handles[name] = self._new(kind, name)
            worlds = sorted(name for name, kind in self._present.items() if kind == _WORLD)
        self._choose_world(worlds, added)
        for callbacks, names in ((self.on_removed, removed), (self.on_added, added)):
            for name in names:
                _notify(callbacks, name)

    def add(self, name: str, kind: str) -> Any:
        """The handle of a topic without /State, of that message type, which discovery may not have found yet."""
        with self._lock:
            self._present[name] = kind
            if type(self._handles.get(name)) is not handle_class(kind):
                self._handles[name] = self._new(handle_class(kind), name)
            return self._handles[name]

    def _new(self, kind: Callable[[str], Any], name: str) -> Handle:
        handle: Handle = kind(name)
        handle.ral = self.ral
        handle._join(self._gate, self._list_world)
        if isinstance(handle, World):
            self._connect_world(handle)
        return handle

    def _list_world(self) -> Listing | None:
        return self.world.list() if self.world is not None else None

    def _choose_world(self, worlds: Sequence[str], added: Sequence[str]) -> None:
        if worlds:
            self.world = self.handle(worlds[0])
            assert self.world is not None
            self.world.set_active()
            if len(worlds) > 1 and self.world._topic in added:
                say(f"there are several worlds: {', '.join(worlds)}; taking the first (Client(namespace=...) chooses)")
        if self._had_world and not worlds:
            say("the simulator is gone; waiting for it")
        elif worlds and not self._had_world and self.world is not None and self.world.has_state():
            say("the simulator is back")
        self._had_world = bool(worlds)


def _notify(callbacks: Sequence[Callback], name: str) -> None:
    for callback in tuple(callbacks):
        try:
            callback(name)
        except Exception:  # the caller's mistake must not end the client's thread
            traceback.print_exc()
