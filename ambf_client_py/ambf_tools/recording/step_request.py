"""Requests every step's states from a simulator (services World/Record and World/Received), without rospy.

Two connections that stay open: one for requests, from the thread that looks for topics, one for receipts, from a
thread of its own, so that neither waits for the other.
"""

import contextlib
import socket
import struct
import threading
import time
import urllib.parse

from ambf_tools.recording.bag_writer import Stamp, fields

SERVICE = "/World/Record"  # of each simulator, below its namespace
RENEWAL = 1.0  # s: a request ends 5 s after it was last made
_TIMEOUT = 5.0  # s, of each call
_RECEIPT_PAUSE = 0.002  # s between two receipts


class _Caller:
    """A connection to one service, made when it is first called. One thread."""

    def __init__(self, uri: str, service: str, node: str) -> None:
        self._uri, self._service, self._node = uri, service, node
        self._link: socket.socket | None = None

    def call(self, body: bytes) -> bytes:
        """Raises OSError where nothing answers, ValueError where it refuses."""
        try:
            if self._link is None:
                self._connect()
            assert self._link is not None
            self._link.sendall(struct.pack("<I", len(body)) + body)
            (accepted,) = _exactly(self._link, 1)
            answer = _sized(self._link)
        except OSError:
            self.close()
            raise
        if not accepted:
            raise ValueError(answer.decode(errors="replace"))
        return answer

    def close(self) -> None:
        if self._link is not None:
            self._link.close()
        self._link = None

    def _connect(self) -> None:
        place = urllib.parse.urlparse(self._uri)
        self._link = socket.create_connection((place.hostname or "", place.port or 0), _TIMEOUT)
        self._link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        asked = {"callerid": self._node, "service": self._service, "md5sum": "*", "persistent": "1"}
        head = fields({name: text.encode() for name, text in asked.items()})
        self._link.sendall(struct.pack("<I", len(head)) + head)
        _sized(self._link)


class StepRequest:
    """What one recorder requests from one simulator. uris: those of its services Record and Received."""

    def __init__(self, service: str, uris: tuple[str, str], node: str) -> None:
        self.uris = uris
        self.topics: list[str] = []
        self._node = node
        self._request = _Caller(uris[0], service, node)
        self._receipt = _Caller(uris[1], receipt_service(service), node)
        self._newest: Stamp | None = None
        self._due: Stamp | None = None  # not sent yet
        self._changed = threading.Condition()
        self._ended = False
        self._thread: threading.Thread | None = None

    def make(self, topics: list[str], every: int) -> list[str]:
        """Requests these topics at every so many steps. Returns those that are published so, from now on.

        Raises OSError or ValueError, as _Caller.call().
        """
        body = _text(self._node) + struct.pack("<I", len(topics)) + b"".join(map(_text, topics))
        answer = self._request.call(body + struct.pack("<I", every))
        message, at = _read_text(answer, 1)
        if not answer[0]:
            raise ValueError(message)
        at += 8  # the lease
        (count,) = struct.unpack_from("<I", answer, at)
        at += 4
        granted = []
        for _ in range(count):
            topic, at = _read_text(answer, at)
            granted.append(topic)
        self.topics = topics
        if self._thread is None:
            self._send_receipt(bytes(8))  # the first, before anything is connected to
            self._thread = threading.Thread(target=self._keep_receipting, daemon=True)
            self._thread.start()
        return granted

    def received(self, stamp: Stamp) -> None:
        """All states of the step with this stamp are here. Does not wait."""
        if stamp != self._newest:
            with self._changed:
                self._newest = self._due = stamp
                self._changed.notify()

    def end(self) -> None:
        """Ends the request, quietly where nothing answers any more."""
        with self._changed:
            self._ended = True
            self._changed.notify()
        if self._thread is not None:
            self._thread.join(_TIMEOUT)
        with contextlib.suppress(OSError, ValueError, struct.error, IndexError):
            self.make([], 0)
        self._request.close()

    def _keep_receipting(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._ended or self._due is not None)
                stamp, self._due = self._due, None
            if stamp is None:
                break
            try:
                self._send_receipt(stamp)
            except (OSError, ValueError):
                break  # the simulator has ended; the next one gets a request of its own
            time.sleep(_RECEIPT_PAUSE)
        self._receipt.close()

    def _send_receipt(self, stamp: Stamp) -> None:
        self._receipt.call(_text(self._node) + stamp)


def receipt_service(service: str) -> str:
    """The service Received beside a service Record."""
    return service.rpartition("/")[0] + "/Received"


def _sized(link: socket.socket) -> bytes:
    (length,) = struct.unpack("<I", _exactly(link, 4))
    return _exactly(link, length)


def _exactly(link: socket.socket, count: int) -> bytes:
    data = b""
    while len(data) < count:
        more = link.recv(count - len(data))
        if not more:
            raise OSError("the simulator hung up")
        data += more
    return data


def _text(text: str) -> bytes:
    data = text.encode()
    return struct.pack("<I", len(data)) + data


def _read_text(data: bytes, at: int) -> tuple[str, int]:
    (length,) = struct.unpack_from("<I", data, at)
    return data[at + 4 : at + 4 + length].decode(errors="replace"), at + 4 + length
