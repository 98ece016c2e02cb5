"""What the layers over ROS 1 and ROS 2 share: names, children, and errors that name what there is."""

from __future__ import annotations

import functools
import inspect
import time
from collections.abc import Callable
from typing import Any

_POLL_S = 0.01


def _with_signature_in_errors(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """The function; a call that does not fit its signature raises a TypeError with that signature."""
    signature = inspect.signature(function)

    @functools.wraps(function)
    def call(*arguments: Any, **named: Any) -> Any:
        try:
            return function(*arguments, **named)
        except TypeError:
            try:
                signature.bind(*arguments, **named)
            except TypeError as wrong:
                raise TypeError(f"ral.{name}: {wrong}; known: {_shown(signature)}") from None
            raise

    return call


def _shown(signature: inspect.Signature) -> str:
    """Its arguments and defaults, without types."""
    known = [each.replace(annotation=each.empty) for each in signature.parameters.values() if each.name != "self"]
    return str(signature.replace(parameters=known, return_annotation=signature.empty))


class _Named(type):
    """Metaclass of layers: what is not there raises an AttributeError that names what is."""

    def __new__(cls, name: str, bases: tuple[type, ...], members: dict[str, Any]) -> _Named:
        for key, member in members.items():
            if key.startswith("_") and key != "__init__":
                continue
            if inspect.isfunction(member):
                members[key] = _with_signature_in_errors(key, member)
        return super().__new__(cls, name, bases, members)

    def __getattr__(cls, name: str) -> Any:
        raise AttributeError(f"ral has no '{name}'; it has {', '.join(cls._public())}")

    def _public(cls) -> list[str]:
        return sorted({key for each in cls.__mro__ for key in vars(each) if not key.startswith("_")})


class Layer(metaclass=_Named):
    """Base of the layers. Topics and services get '/', the namespace and '/' before their names."""

    def __init__(self, node_name: str, namespace: str = "", node: Any = None) -> None:
        self._node_name = node_name
        self._namespace = namespace.strip("/")
        self._node = node
        self._children: dict[str, Layer] = {}
        self._ends: list[Any] = []  # publishers and subscribers

    def __getattr__(self, name: str) -> Any:  # only called for what there is not
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(type(self), name)

    def node_name(self) -> str:
        """The name that the node was made with."""
        return self._node_name

    def namespace(self) -> str:
        """What stands before all names, without '/' at its ends."""
        return self._namespace

    def create_child(self, child_namespace: str) -> Any:
        """A layer of the same node below this one's namespace. RuntimeError if this one already made it."""
        if child_namespace in self._children:
            raise RuntimeError(f"ral has a child '{child_namespace}' already; it has {sorted(self._children)}")
        child = type(self)(self._node_name, self._add_namespace_to(child_namespace), self._shared_node())
        self._children[child_namespace] = child
        return child

    @staticmethod
    def get_timestamp(t: Any) -> Any:
        """The time of a message with a header, of a header or any other thing with a stamp, or the time itself."""
        if hasattr(t, "header"):
            t = t.header
        return t.stamp if hasattr(t, "stamp") else t

    def check_connections(self, timeout_seconds: float = 5.0, check_children: bool = True) -> None:
        """Waits until each publisher and subscriber has another end; TimeoutError names those that have none.

        check_children: those of children, too. timeout_seconds 0: checks nothing.
        """
        if timeout_seconds == 0.0:
            return
        ends = self._all_ends() if check_children else list(self._ends)
        deadline = time.monotonic() + timeout_seconds
        while True:
            alone = [end for end in ends if not self._is_connected(end)]
            if not alone:
                return
            if time.monotonic() >= deadline:
                names = ", ".join(sorted(self.get_topic_name(end) for end in alone))
                raise TimeoutError(f"within {timeout_seconds} s nobody came to the other end of {names}")
            time.sleep(_POLL_S)

    def _all_ends(self) -> list[Any]:
        return self._ends + [end for child in self._children.values() for end in child._all_ends()]

    def _add_namespace_to(self, name: str) -> str:
        below = f"/{self._namespace}" if self._namespace else ""
        return f"{below}/{name.strip('/')}"
