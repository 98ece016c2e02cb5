"""All topics and services that the ROS master knows, with their types; and the classes of types."""

import re
import time
from dataclasses import dataclass, field
from typing import Any

import roslib.message
from ambf_client._master import Master

_PANELS = "/ambf_topics_"  # nodes that look for a panel: they, and what a killed one left behind, are no listeners
_ASK_AGAIN = 30.0  # s, for the type of a service that did not tell it


@dataclass(frozen=True)
class Topic:
    """A topic as the master knows it."""

    name: str
    type: str  # empty: nobody has told it yet
    publishers: int
    listeners: int
    ours: bool  # of the simulator that asks


@dataclass(frozen=True)
class Service:
    """A service as the master knows it."""

    name: str
    type: str  # empty: not known yet, or it does not say
    ours: bool


@dataclass(frozen=True)
class Listing:
    """What there is, ours first, then by name."""

    topics: list[Topic] = field(default_factory=list)
    services: list[Service] = field(default_factory=list)


class Lister:
    """Lists what there is, again and again.

    simulator: the process id of the one whose topics are ours; 0: of all simulators.
    """

    def __init__(self, master: Master, simulator: int = 0, ignored_node: str = "") -> None:
        self._master = master
        self._ours = re.compile(rf"^/ambf_comm_node_{simulator or '[0-9]+'}_[0-9]+$")
        self._ignored = ignored_node  # it watches and publishes for others, and counts for nothing
        self._service_types: dict[str, tuple[str, float]] = {}  # type, when asked

    def look(self) -> Listing:
        """What there is now, at once; the types of services once learn() has asked for them."""
        publishers, subscribers, services = self._master.ask("getSystemState")
        types = dict(self._master.ask("getTopicTypes"))
        nodes: dict[str, tuple[set[str], set[str]]] = {}
        for side, part in enumerate((publishers, subscribers)):
            for name, of in part:
                nodes.setdefault(name, (set(), set()))[side].update(
                    node for node in of if node != self._ignored and not (side == 1 and node.startswith(_PANELS))
                )
        topics = [
            Topic(name, _known(types.get(name, "")), len(of[0]), len(of[1]), self._is_ours(of[0] | of[1]))
            for name, of in nodes.items()
            if of[0] or of[1]
        ]
        offered = [
            Service(name, self._service_types.get(name, ("", 0.0))[0], self._is_ours(set(of)))
            for name, of in services
            if self._ignored not in of
        ]
        for name in self._service_types.keys() - {name for name, _ in services}:
            del self._service_types[name]
        return Listing(
            sorted(topics, key=lambda each: (not each.ours, each.name)),
            sorted(offered, key=lambda each: (not each.ours, each.name)),
        )

    def learn(self, listing: Listing) -> bool:
        """Asks services for their types. True when one was new: look again."""
        learnt = False
        for service in listing.services:
            known, asked = self._service_types.get(service.name, ("", -_ASK_AGAIN))
            if known or time.monotonic() - asked < _ASK_AGAIN:
                continue
            kind = service_type(self._master, service.name)
            self._service_types[service.name] = (kind, time.monotonic())
            learnt = learnt or bool(kind)
        return learnt

    def _is_ours(self, nodes: set[str]) -> bool:
        return any(self._ours.match(node) for node in nodes)


def _known(kind: str) -> str:
    return "" if kind == "*" else kind  # a listener that takes anything


def service_type(master: Master, name: str) -> str:
    """The type of a service, which only itself knows; empty: there is no such service, or it does not answer."""
    import rosservice

    try:
        kind = rosservice.get_service_headers(name, master.ask("lookupService", name)).get("type", "")
    except (LookupError, ConnectionError, rosservice.ROSServiceException):
        return ""
    except Exception:  # it answered, with nothing that could be read
        return ""
    return str(kind).removesuffix("Request")  # as some services of roscpp say


def message_class(kind: str) -> Any:
    """The class of a message type. Raises LookupError with what to do."""
    return _class_of(kind, roslib.message.get_message_class, "message")


def service_class(kind: str) -> Any:
    """The class of a service type. Raises LookupError with what to do."""
    return _class_of(kind, roslib.message.get_service_class, "service")


def _class_of(kind: str, find: Any, what: str) -> Any:
    package, slash, name = kind.partition("/")
    if not (slash and package and name):
        raise LookupError(f"'{kind}' is no {what} type: it should read PACKAGE/TYPE")
    try:
        found = find(kind)
    except Exception as problem:  # a package that is there and broken
        raise LookupError(f"the {what} type {kind} cannot be used: {problem}") from None
    if found is None:
        raise LookupError(f"the {what} type {kind} is not known here: is the Python package {package} installed?")
    return found
