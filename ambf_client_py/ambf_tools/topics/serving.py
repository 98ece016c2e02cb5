"""What the simulator's panel uses of ROS: requests come and answers go as lines of JSON. Ends with its input.

Requests: {"do": "look", "on": bool}                                     list what there is, once a second
          {"do": "watch", "topics": [..]}                                these, and no others
          {"do": "template", "id", "name", "type", "service": bool}      its YAML with default values
          {"do": "publish", "id", "topic", "type", "text", "rate": Hz}   0: once
          {"do": "stop", "id", "topic"}                                  publishing at a rate
          {"do": "call", "id", "service", "type", "text"}
Events:   {"event": "master", "alive": bool, "uri"}, {"event": "list", "topics", "services"},
          {"event": "message", "topic", "type", "count", "bytes", "rate", "rows", maybe "error"},
          {"event": "publishing", "topics": [{"topic", "rate", "count"}]},
          {"event": "answer", "id", and "text", "rows" or "error"}
"""

import contextlib
import json
import math
import os
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

import rospy
from ambf_client._master import Master, MasterSilent, describe_uri

from . import texts
from .listing import Lister, message_class, service_class, service_type
from .sending import MOST_HZ, Sender, call
from .watching import Watches

_LOOK_PERIOD = 1.0  # s
_MISSES = 2  # looks in a row without an answer, then the master is gone
_END_PATIENCE = 1.0  # s


class Server:
    """Serves one program. `emit` takes events, from any thread."""

    def __init__(self, emit: Callable[[dict[str, Any]], None], simulator: int = 0) -> None:
        self._emit = emit
        self._master = Master(f"/ambf_topics_{os.getpid()}")
        self._simulator = simulator
        self._lister: Lister | None = None  # once this is a node
        self._watches: Watches | None = None
        self._wanted: list[str] = []  # to be watched
        self._missing: set[tuple[str, str, bool]] = set()  # at the master, at the last look: topic, type, whether sent
        self._looking = True
        self._senders: dict[str, Sender] = {}
        self._lock = threading.Lock()  # of the last four
        self._alive: bool | None = None
        self._listed: Any = None
        self._published: Any = []
        self._wake = threading.Event()
        threading.Thread(target=self._run, name="looking", daemon=True).start()

    def take(self, line: str) -> None:
        """Takes a request. What takes time is done by threads of their own."""
        request: dict[str, Any] = {}
        try:
            request = json.loads(line)
            work = {
                "look": self._look_on,
                "watch": self._watch,
                "template": self._template,
                "publish": self._publish,
                "stop": self._stop,
                "call": self._call,
            }[request["do"]]
        except (ValueError, TypeError, KeyError) as problem:
            named = request.get("id") if isinstance(request, dict) else None
            self._emit(
                {"event": "answer", "id": named, "error": f"no such request: {type(problem).__name__} {problem}"}
            )
            return
        if work in (self._look_on, self._watch):
            self._answer(work, request)
        else:
            threading.Thread(target=self._answer, args=(work, request), daemon=True).start()

    def _answer(self, work: Callable[[dict[str, Any]], dict[str, Any]], request: dict[str, Any]) -> None:
        try:
            answer = work(request)
        except MasterSilent:
            answer = {"error": f"no ROS master answers at {describe_uri(self._master.uri)}"}
        except KeyError as problem:
            answer = {"error": f"the request lacks {problem}"}
        except Exception as problem:  # whatever it is, who asked is told
            answer = {"error": " ".join(str(problem).split()) or type(problem).__name__}
        if "id" in request:
            self._emit({"event": "answer", "id": request["id"], **answer})

    # --- requests ----------------------------------------------------------------------------------------------------

    def _look_on(self, request: dict[str, Any]) -> dict[str, Any]:
        self._looking = bool(request["on"])
        self._wake.set()
        return {}

    def _watch(self, request: dict[str, Any]) -> dict[str, Any]:
        with self._lock:
            self._wanted = [str(topic) for topic in request["topics"]]
            if self._watches is not None:
                self._watches.set(self._wanted)
        return {}

    def _template(self, request: dict[str, Any]) -> dict[str, Any]:
        name, kind = request["name"], request.get("type", "")
        if request.get("service"):
            kind = kind or self._type_of_service(name)
            return {"text": texts.template(service_class(kind)._request_class)}
        return {"text": texts.template(message_class(kind or self._type_of_topic(name)))}

    def _publish(self, request: dict[str, Any]) -> dict[str, Any]:
        topic, rate = request["topic"], float(request.get("rate", 0.0))
        if not (math.isfinite(rate) and 0.0 <= rate <= MOST_HZ):
            raise ValueError(f"a rate of {rate:g} Hz: it should be from 0 to {MOST_HZ:g} Hz")
        self._need_node()
        kind = message_class(request.get("type", "") or self._type_of_topic(topic))
        message = texts.fill(kind, request.get("text", ""))
        listing = self._lister.look() if self._lister else None
        known = next((each for each in listing.topics if each.name == topic), None) if listing else None
        if known is not None and known.type and known.type != kind._type:
            raise ValueError(f"{topic} is of type {known.type}, not {kind._type}")
        with self._lock:
            sender = self._senders.get(topic)
            if sender is None or not sender.keep():
                sender = self._senders[topic] = Sender(topic, kind, self._forget)
        if rate > 0:
            sender.repeat(message, rate)
            answer = {"text": f"publishing at {rate:g} Hz"}
        else:
            answer = {"text": sender.once(message, known.listeners if known else 0)}
        self._tell_publishing()
        return answer

    def _stop(self, request: dict[str, Any]) -> dict[str, Any]:
        with self._lock:
            sender = self._senders.get(request["topic"])
        if sender is not None:
            sender.repeat(None, 0.0)
        self._tell_publishing()
        return {"text": "no longer published" if sender else "it was not published"}

    def _call(self, request: dict[str, Any]) -> dict[str, Any]:
        self._need_node()
        name = request["service"]
        answer = call(name, request.get("type", "") or self._type_of_service(name), request.get("text", ""))
        return {"rows": texts.rows(answer)}

    def _type_of_topic(self, name: str) -> str:
        kind = dict(self._master.ask("getTopicTypes")).get(name, "*")
        if kind == "*":
            raise LookupError(f"nobody knows the type of {name}: no program has published or heard it yet")
        return str(kind)

    def _type_of_service(self, name: str) -> str:
        if not any(name == each for each, _ in self._master.ask("getSystemState")[2]):
            raise LookupError(f"there is no service {name}")
        kind = service_type(self._master, name)
        if not kind:
            raise LookupError(f"the service {name} does not answer")
        return kind

    def _need_node(self) -> None:
        if not self._master.answers():
            raise MasterSilent
        deadline = time.monotonic() + 5.0
        while self._lister is None:
            if time.monotonic() > deadline:
                raise ConnectionError("this program could not become a ROS node yet; try again")
            time.sleep(0.02)

    def _forget(self, sender: Sender) -> None:
        with self._lock:
            if self._senders.get(sender.topic) is sender:
                del self._senders[sender.topic]

    # --- looking -----------------------------------------------------------------------------------------------------

    def _run(self) -> None:
        missed = 0
        while True:
            begin = time.monotonic()
            try:
                self._look()
                missed = 0
            except (MasterSilent, LookupError, OSError) as problem:
                missed += 1
                if missed >= _MISSES or not getattr(problem, "slow", False):
                    self._tell_master(False)
            except Exception as problem:  # a look that fails says so and is tried again
                print(f"looking at the ROS master: {problem!r}", file=sys.stderr, flush=True)
            self._tell_publishing()
            self._wake.wait(max(_LOOK_PERIOD, 10 * (time.monotonic() - begin)))
            self._wake.clear()

    def _look(self) -> None:
        if self._lister is None:
            self._master.ask("getPid")
            rospy.init_node("ambf_topics", anonymous=True, disable_signals=True, disable_rosout=True)
            self._master = Master(rospy.get_name())  # what is registered again is the node's, and leaves with it
            with self._lock:
                self._watches = Watches(self._emit)
                self._watches.set(self._wanted)
            self._lister = Lister(self._master, self._simulator, rospy.get_name())
        if not self._looking:
            return
        self._tell_listing(self._lister.look())
        if self._lister.learn(self._listed):
            self._tell_listing(self._lister.look())
        self._register_again()

    def _tell_listing(self, listing: Any) -> None:
        self._tell_master(True)
        if listing == self._listed:
            return
        self._listed = listing
        self._emit(
            {
                "event": "list",
                "topics": [[t.name, t.type, t.publishers, t.listeners, t.ours] for t in listing.topics],
                "services": [[s.name, s.type, s.ours] for s in listing.services],
            }
        )

    def _tell_master(self, alive: bool) -> None:
        if alive == self._alive:
            return
        self._alive = alive
        if not alive:
            self._listed = None
        self._emit({"event": "master", "alive": alive, "uri": describe_uri(self._master.uri)})

    def _register_again(self) -> None:
        """A master that was started anew does not know us."""
        publishers, subscribers, _ = ({name: of for name, of in part} for part in self._master.ask("getSystemState"))
        me, api = rospy.get_name(), rospy.get_node_uri()
        with self._lock:
            watched = self._watches.topics() if self._watches else []
            sent = {topic: sender.kind._type for topic, sender in self._senders.items()}
        missing = {(topic, "*", False) for topic in watched if me not in subscribers.get(topic, ())}
        missing |= {(topic, kind, True) for topic, kind in sent.items() if me not in publishers.get(topic, ())}
        for topic, kind, publishes in missing & self._missing:  # twice: not merely on its way
            self._master.register_again(api, topic, kind, publishes)
        self._missing = missing

    def _tell_publishing(self) -> None:
        with self._lock:
            published = [
                {"topic": sender.topic, "rate": sender.rate, "count": sender.count}
                for sender in self._senders.values()
                if sender.rate > 0
            ]
        if published != self._published:
            self._published = published
            self._emit({"event": "publishing", "topics": published})


def serve(simulator: int = 0) -> None:
    """Serves whoever holds the other ends of standard input and output, until the input ends."""
    with contextlib.suppress(OSError):
        os.nice(5)  # the simulation comes first
    # Whatever prints, events stay whole: only we write to what was standard output.
    out = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    writing = threading.Lock()

    def emit(event: dict[str, Any]) -> None:
        text = json.dumps(event)
        with writing:
            try:
                print(text, file=out, flush=True)
            except OSError:  # nobody reads any more
                os._exit(0)

    server = Server(emit, simulator)
    with contextlib.suppress(KeyboardInterrupt):
        for line in sys.stdin:
            if line.strip():
                server.take(line)
    # The master is told, if it answers in time.
    end = threading.Thread(target=rospy.signal_shutdown, args=("over",), daemon=True)
    end.start()
    end.join(_END_PATIENCE)
    os._exit(0)
