"""Lists all topics and services of the ROS master with their types, and finds the classes of types."""

import re
from dataclasses import dataclass, field
from typing import Any

import roslib.message
from ambf_client._master import Master

_SIMULATOR = re.compile(r"^/ambf_comm_node_[0-9]+_[0-9]+$")  # its nodes


@dataclass(frozen=True)
class Topic:
    """A topic as the master knows it."""

    name: str
    type: str  # empty: not known yet
    publishers: int
    listeners: int
    ours: bool  # of a simulator


@dataclass(frozen=True)
class Service:
    """A service as the master knows it."""

    name: str
    type: str  # empty: the service does not answer
    ours: bool


@dataclass(frozen=True)
class Listing:
    """What there is, ours first, then by name."""

    topics: list[Topic] = field(default_factory=list)
    services: list[Service] = field(default_factory=list)


def list_all(master: Master, ignored_node: str = "") -> Listing:
    """Lists what there is, except for what `ignored_node` alone publishes, hears or offers."""
    publishers, subscribers, services = master.ask("getSystemState")
    types = dict(master.ask("getTopicTypes"))
    nodes: dict[str, tuple[set[str], set[str]]] = {}
    for side, part in enumerate((publishers, subscribers)):
        for name, of in part:
            nodes.setdefault(name, (set(), set()))[side].update(node for node in of if node != ignored_node)
    topics = [
        Topic(name, _known(types.get(name, "")), len(of[0]), len(of[1]), _is_ours(of[0] | of[1]))
        for name, of in nodes.items()
        if of[0] or of[1]
    ]
    offered = [
        Service(name, service_type(master, name), _is_ours(set(of))) for name, of in services if ignored_node not in of
    ]
    return Listing(
        sorted(topics, key=lambda each: (not each.ours, each.name)),
        sorted(offered, key=lambda each: (not each.ours, each.name)),
    )


def _is_ours(nodes: set[str]) -> bool:
    return any(_SIMULATOR.match(node) for node in nodes)


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
