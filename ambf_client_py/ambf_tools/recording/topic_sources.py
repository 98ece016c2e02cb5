"""Connects to the publishers of topics and keeps connected, as a ROS 1 node, without rospy.

rospy has a thread a connection and touches each message several times; a recorder wants the bytes as they come. So this
speaks the two protocols itself: XML-RPC with the master and the publishers, the TCPROS handshake with the publishers.
It knows nothing of what is done with the bytes. Threads of its own; connections are handed over through a queue.
"""

import contextlib
import fnmatch
import os
import queue
import re
import socket
import struct
import threading
import time
import urllib.parse
import xmlrpc.client
import xmlrpc.server
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from socketserver import ThreadingMixIn
from typing import Any

from ambf_tools.recording.bag_writer import fields
from ambf_tools.recording.step_request import RENEWAL, SERVICE, StepRequest, receipt_service

EVERY = "ambf_every"  # in a bag's connection: every how many steps there is a message; absent: as it was published
LOOK_INTERVAL = 0.5  # s between looks at the master
_TIMEOUT = 5.0  # s, of each conversation
_ASKING = 4  # conversations with publishers at once: ROS lets five wait to be let in, and turns more away for a second
_BUFFER = 4 << 20  # bytes asked for a connection's receive buffer: seconds of messages while we are held up


@dataclass(frozen=True)
class Source:
    """A connection to one publisher of one topic, its handshake done."""

    topic: str
    publisher: str  # URI of the publishing node
    header: dict[str, str]  # what the publisher declared: type, md5sum, message_definition, callerid, latching
    socket: socket.socket
    request: StepRequest | None = None  # by which every so many steps are published; None: at the publisher's rate


class _Proxy(xmlrpc.client.ServerProxy):
    """XML-RPC with a time limit."""

    class _Transport(xmlrpc.client.Transport):
        def make_connection(self, host: Any) -> Any:
            connection = super().make_connection(host)
            connection.timeout = _TIMEOUT
            return connection

    def __init__(self, uri: str) -> None:
        super().__init__(uri, transport=self._Transport())


class _Server(ThreadingMixIn, xmlrpc.server.SimpleXMLRPCServer):
    daemon_threads = True


def own_host(master_uri: str) -> str:
    """The address under which others reach this process: ROS_HOSTNAME, ROS_IP, else loopback for a local master."""
    for name in ("ROS_HOSTNAME", "ROS_IP"):
        if os.environ.get(name):
            return os.environ[name]
    host = urllib.parse.urlparse(master_uri).hostname or "localhost"
    return "127.0.0.1" if host in ("localhost", "127.0.0.1", "::1", socket.gethostname()) else socket.getfqdn()


def is_pattern(name: str) -> bool:
    """Whether it stands for several topics: a shell pattern, or a regular expression after "re:"."""
    return name.startswith("re:") or any(sign in name for sign in "*?[")


def matches(topic: str, topics: list[str], patterns: list[str]) -> bool:
    """Whether a topic is one of those named, or fits a pattern: a shell pattern, or one after "re:" (regular)."""
    if topic in topics:
        return True
    for pattern in patterns:
        if pattern.startswith("re:"):
            if re.fullmatch(pattern[3:], topic):
                return True
        elif fnmatch.fnmatchcase(topic, pattern):
            return True
    return False


class TopicSources:
    """Finds the publishers of the wanted topics and connects to each; puts Source objects into `arrived`.

    every: simulators are requested to publish the wanted states at every so many steps, before they are connected to;
    0: as they publish them. What they grant is in the Source's header as EVERY.
    """

    def __init__(self, topics: list[str], patterns: list[str], wake: Callable[[], None], every: int = 0) -> None:
        self.arrived: queue.SimpleQueue[Source] = queue.SimpleQueue()
        self.matched: set[str] = set(topics)  # topics asked for, published or not
        self.failures: dict[str, str] = {}  # topic -> why no connection came about, lately
        self.master_answers = False
        self._topics, self._patterns, self._wake = topics, patterns, wake
        self._master_uri = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
        self._every = every
        self._granted: dict[str, StepRequest] = {}  # topic that is published at every so many steps -> by which request
        self._requests: dict[str, StepRequest] = {}  # by service
        self._renew_at = 0.0
        self._requesting = threading.Lock()
        self._connected: set[tuple[str, str]] = set()
        self._registered: set[str] = set()
        self._master_pid = 0
        self._lock = threading.Lock()
        self._ending = threading.Event()
        self._look_now = threading.Event()
        host = own_host(self._master_uri)
        self._name = f"/ambf_record_{os.getpid()}_{time.monotonic_ns() % 1_000_000_000}"
        self._server = _Server(("", 0), logRequests=False, allow_none=True)
        self.uri = f"http://{host}:{self._server.server_address[1]}/"
        self._serve()
        self._asking = threading.Semaphore(_ASKING)
        self._pool = ThreadPoolExecutor(8, "connect")
        self._threads = [
            threading.Thread(target=self._server.serve_forever, daemon=True),
            threading.Thread(target=self._keep_looking, daemon=True),
        ]
        for thread in self._threads:
            thread.start()

    def wait_until_sent(self) -> bool:
        """Waits until what was simulated so far is sent, where steps were requested. False: nothing was."""
        with self._requesting:
            self._renew(now=True)
        return bool(self._requests)

    def forget(self, source: Source) -> None:
        """Says that a connection ended: it is made again if its publisher is still there."""
        with self._lock:
            self._connected.discard((source.topic, source.publisher))
        self._look_now.set()

    def close(self) -> None:
        """Ends all threads and unregisters."""
        self._ending.set()
        self._look_now.set()
        self._server.shutdown()
        self._server.server_close()
        self._pool.shutdown(wait=False, cancel_futures=True)
        self._threads[1].join(_TIMEOUT)
        for request in self._requests.values():
            request.end()
        with contextlib.suppress(OSError, xmlrpc.client.Error):
            master = _Proxy(self._master_uri)
            for topic in self._registered:
                master.unregisterSubscriber(self._name, topic, self.uri)

    # What a node must answer others. Only publisherUpdate matters here; the master calls it at each change.

    def _serve(self) -> None:
        def update(_caller: str, _topic: str, _publishers: list[str]) -> list[Any]:
            self._look_now.set()
            return [1, "", 0]

        answers: dict[str, Callable[..., list[Any]]] = {
            "publisherUpdate": update,
            "paramUpdate": lambda *_: [1, "", 0],
            "getPid": lambda *_: [1, "", os.getpid()],
            "getMasterUri": lambda *_: [1, "", self._master_uri],
            "getSubscriptions": lambda *_: [1, "", [[topic, "*"] for topic in sorted(self._registered)]],
            "getPublications": lambda *_: [1, "", []],
            "getBusStats": lambda *_: [1, "", [[], [], []]],
            "getBusInfo": lambda *_: [1, "", []],
            "requestTopic": lambda *_: [0, "this node publishes nothing", 0],
            "shutdown": lambda *_: [0, "end the recording instead", 0],
        }
        for name, answer in answers.items():
            self._server.register_function(answer, name)

    def _keep_looking(self) -> None:
        while not self._ending.is_set():
            try:
                with self._requesting:
                    self._renew()
                    self._look()
                self.master_answers = True
            except (OSError, xmlrpc.client.Error):
                self.master_answers = False
                self._registered.clear()  # a master that returns knows nothing of us
            self._look_now.wait(LOOK_INTERVAL)
            if self._look_now.is_set():
                self._look_now.clear()
                time.sleep(0.02)  # changes come in swarms

    def _look(self) -> None:
        with _Proxy(self._master_uri) as master:
            pid = self._ask(master.getPid(self._name))
            if pid != self._master_pid:
                self._master_pid = pid
                self._registered.clear()
            published, _, services = self._ask(master.getSystemState(self._name))
            wanted = {t: n for t, n in published if matches(t, self._topics, self._patterns)}
            for topic in sorted((set(wanted) | set(self._topics)) - self._registered):
                # The answer lists the publishers; so do later calls of publisherUpdate, but asking anew is simpler.
                self._ask(master.registerSubscriber(self._name, topic, "*", self.uri))
                self._registered.add(topic)
                self.matched.add(topic)
            if self._every:
                steps = sorted(topic for topic in wanted if topic.endswith("/State"))
                for service in sorted(name for name, _ in services if name.endswith(SERVICE)):
                    names = (service, receipt_service(service))
                    uris = [self._ask(master.lookupService(self._name, name)) for name in names]
                    if not self._request(service, (uris[0], uris[1]), steps):
                        return  # nothing is connected to before it is granted: the next look tries again
            nodes: dict[str, str] = {}
            for topic, publishers in wanted.items():
                for node in publishers:
                    if node not in nodes:
                        found: Any = master.lookupNode(self._name, node)
                        nodes[node] = found[2] if found[0] == 1 else ""
                    self._want(topic, nodes[node])

    def _request(self, service: str, uris: tuple[str, str], topics: list[str]) -> bool:
        """Requests steps where something has changed. False: the simulator is there, and does not answer."""
        request = self._requests.get(service)
        if request is not None and (request.uris, request.topics) == (uris, topics):
            return True
        if request is None or request.uris != uris:
            request = StepRequest(service, uris, self._name)
        try:
            granted = request.make(topics, self._every)
        except ConnectionRefusedError:
            return True  # a killed one: the next simulator, or the user, clears it away
        except (OSError, ValueError, struct.error) as problem:
            self.failures[service] = str(problem)
            return False
        self.failures.pop(service, None)
        self._requests[service] = request
        self._granted.update(dict.fromkeys(granted, request))
        return True

    def _renew(self, now: bool = False) -> None:
        """Repeats the requests, also while no master answers. Simulators answer when all before is sent."""
        if time.monotonic() < self._renew_at and not now:
            return
        self._renew_at = time.monotonic() + RENEWAL
        for service, request in list(self._requests.items()):
            try:
                request.make(request.topics, self._every)
            except (OSError, ValueError, struct.error):
                self._requests.pop(service).end()  # requested anew when it is back

    @staticmethod
    def _ask(answer: Any) -> Any:
        code, message, value = answer
        if code != 1:
            raise xmlrpc.client.Fault(code, message)
        return value

    def _want(self, topic: str, publisher: str) -> None:
        with self._lock:
            if not publisher or (topic, publisher) in self._connected:
                return
            self._connected.add((topic, publisher))
        self._pool.submit(self._connect, topic, publisher)

    def _connect(self, topic: str, publisher: str) -> None:
        try:
            source = self._handshake(topic, publisher)
        except (OSError, xmlrpc.client.Error, ValueError) as problem:
            self.failures[topic] = str(problem)
            with self._lock:
                self._connected.discard((topic, publisher))
            return
        self.failures.pop(topic, None)
        self.arrived.put(source)
        self._wake()

    def _handshake(self, topic: str, publisher: str) -> Source:
        with self._asking, _Proxy(publisher) as node:
            protocol = self._ask(node.requestTopic(self._name, topic, [["TCPROS"]]))
        if len(protocol) < 3 or protocol[0] != "TCPROS":
            raise ValueError(f"{publisher} does not offer TCPROS")
        link = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            link.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BUFFER)
            link.settimeout(_TIMEOUT)
            link.connect((protocol[1], int(protocol[2])))
            asked = {"callerid": self._name, "topic": topic, "md5sum": "*", "type": "*"}
            head = fields({name: text.encode() for name, text in asked.items()})
            link.sendall(struct.pack("<I", len(head)) + head)
            header = read_fields(_exactly(link, struct.unpack("<I", _exactly(link, 4))[0]))
            if "error" in header:
                raise ValueError(header["error"])
            link.setblocking(False)
        except (OSError, ValueError):
            link.close()
            raise
        kept = ("type", "md5sum", "message_definition", "callerid", "latching")
        declared = {name: header[name] for name in kept if name in header}
        request = self._granted.get(topic)
        if request is not None:
            declared[EVERY] = str(self._every)
        return Source(topic, publisher, declared, link, request)


def read_fields(data: bytes) -> dict[str, str]:
    """The opposite of bag_writer.fields()."""
    found, at = {}, 0
    while at + 4 <= len(data):
        (length,) = struct.unpack_from("<I", data, at)
        name, sep, value = data[at + 4 : at + 4 + length].partition(b"=")
        if not sep:
            raise ValueError("malformed connection header")
        found[name.decode()] = value.decode(errors="replace")
        at += 4 + length
    return found


def _exactly(link: socket.socket, count: int) -> bytes:
    if count > 1 << 20:
        raise ValueError("absurd connection header")
    data = b""
    while len(data) < count:
        more = link.recv(count - len(data))
        if not more:
            raise OSError("the publisher hung up")
        data += more
    return data
