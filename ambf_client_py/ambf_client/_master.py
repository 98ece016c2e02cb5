"""What the ROS master knows, asked with a time limit, and whether those it names are still alive."""

from __future__ import annotations

import http.client
import os
import socket
import xmlrpc.client
from dataclasses import dataclass, field
from typing import Any

from .kinds import handle_class

_TIMEOUT = 1.0  # s; a master or node that takes longer counts as silent
_STATE = "/State"


class MasterSilent(ConnectionError):
    """The master does not answer. slow: it may only be busy."""

    slow = False


@dataclass(frozen=True)
class View:
    """What is registered at one moment."""

    objects: dict[str, str] = field(default_factory=dict)  # topics without /State, of living simulators: message type
    nodes: dict[str, str] = field(default_factory=dict)  # the same topics: node that publishes them
    publishers: dict[str, set[str]] = field(default_factory=dict)  # topic: nodes
    subscribers: dict[str, set[str]] = field(default_factory=dict)


class Master:
    """The master of this process's environment."""

    def __init__(self, caller: str) -> None:
        self.uri = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
        self._caller = caller
        self._types: dict[str, str] = {}

    def answers(self) -> bool:
        """Whether there is a master."""
        try:
            self.ask("getPid")
        except MasterSilent:
            return False
        return True

    def look(self) -> View:
        """The objects of all live simulators (a killed one stays registered for ever) that have a handle class."""
        publishers, subscribers, _ = ({t: set(nodes) for t, nodes in part} for part in self.ask("getSystemState"))
        states = {topic: nodes for topic, nodes in publishers.items() if topic.endswith(_STATE)}
        if any(topic not in self._types for topic in states):
            self._types = dict(self.ask("getTopicTypes"))
        view = View(publishers=publishers, subscribers=subscribers)
        alive: dict[str, bool] = {}
        for topic, nodes in states.items():
            kind = self._types.get(topic, "")
            if handle_class(kind) is None:
                continue
            for node in nodes:
                if node not in alive:
                    alive[node] = self._is_alive(node)
            living = sorted(node for node in nodes if alive[node])
            if living:
                view.objects[topic[: -len(_STATE)]] = kind
                view.nodes[topic[: -len(_STATE)]] = living[-1]
        # A topic's type may change when another simulator takes it over.
        self._types = {topic: kind for topic, kind in self._types.items() if topic in states}
        return view

    def register_again(self, api: str, topic: str, kind: str, publishes: bool) -> None:
        """Registers a topic of this process anew, after the master was replaced by one that does not know it."""
        if publishes:
            self.ask("registerPublisher", topic, kind, api)
            return
        publishers = self.ask("registerSubscriber", topic, kind, api)
        # A returning master informs only the subscriber that registers, in its answer: pass it on.
        with _proxy(api) as node:
            node.publisherUpdate(self._caller, topic, publishers)

    def _is_alive(self, node: str) -> bool:
        try:
            uri = self.ask("lookupNode", node)
            with _proxy(uri) as proxy:
                proxy.getPid(self._caller)
        except (TimeoutError, MasterSilent):
            return True  # stopped or slow, not gone
        except (OSError, http.client.HTTPException, xmlrpc.client.Error):
            return False
        return True

    def ask(self, method: str, *arguments: Any) -> Any:
        """What the master answers; MasterSilent when it does not, LookupError when it refuses."""
        try:
            with _proxy(self.uri) as proxy:
                code, message, value = getattr(proxy, method)(self._caller, *arguments)
        except (OSError, http.client.HTTPException, xmlrpc.client.Error) as error:
            silent = MasterSilent(f"{self.uri}: {error}")
            silent.slow = isinstance(error, TimeoutError)
            raise silent from error
        if code != 1:
            raise LookupError(f"{method}: {message}")
        return value


class _Transport(xmlrpc.client.Transport):
    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = _TIMEOUT
        return connection


def _proxy(uri: str) -> Any:
    return xmlrpc.client.ServerProxy(uri, transport=_Transport())


def describe_uri(uri: str) -> str:
    """The URI, and what may be wrong with it."""
    host = uri.partition("//")[2].partition(":")[0].rstrip("/")
    try:
        socket.getaddrinfo(host, None)
    except OSError:
        return f"{uri} (there is no host '{host}': check ROS_MASTER_URI)"
    return uri
