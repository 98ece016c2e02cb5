"""Which objects the ROS master knows, and whether the simulators that published them are still alive."""

from __future__ import annotations

import http.client
import xmlrpc.client
from dataclasses import dataclass, field

from ros_abstraction_layer._master import MasterLink, MasterSilent, describe_uri, proxy

from .kinds import handle_class

__all__ = ["Master", "MasterSilent", "View", "describe_uri"]

_STATE = "/State"


@dataclass(frozen=True)
class View:
    """What is registered at one moment."""

    objects: dict[str, str] = field(default_factory=dict)  # topics without /State, of living simulators: message type
    nodes: dict[str, str] = field(default_factory=dict)  # the same topics: node that publishes them
    publishers: dict[str, set[str]] = field(default_factory=dict)  # topic: nodes
    subscribers: dict[str, set[str]] = field(default_factory=dict)


class Master(MasterLink):
    """The master of this process's environment."""

    def __init__(self, caller: str) -> None:
        super().__init__(caller)
        self._types: dict[str, str] = {}

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
        with proxy(api) as node:
            node.publisherUpdate(self._caller, topic, publishers)

    def _is_alive(self, node: str) -> bool:
        try:
            uri = self.ask("lookupNode", node)
            with proxy(uri) as living:
                living.getPid(self._caller)
        except (TimeoutError, MasterSilent):
            return True  # stopped or slow, not gone
        except (OSError, http.client.HTTPException, xmlrpc.client.Error):
            return False
        return True
