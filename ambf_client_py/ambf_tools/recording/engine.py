"""The recording process: python -m ambf_tools.recording.engine SETTINGS (JSON). Started by ambf_tools.record.

It ends, with a complete bag, when its standard input closes (so also when its parent dies), on SIGTERM and
SIGINT, when space runs out, and when the disk refuses. It says how it fares in lines of JSON on its standard output.

One thread reads all connections in turns, a few milliseconds apart: many messages a system call. While it or the disk
is held up, messages wait in the kernel's buffers. A second thread writes.
"""

import contextlib
import json
import os
import queue
import select
import signal
import struct
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ambf_tools.recording.bag_writer import CHUNK_BYTES, BagWriter, Channel, Chunk, Stamp, as_number, stamp_of
from ambf_tools.recording.disk_space import free_bytes, readable_bytes
from ambf_tools.recording.step_request import StepRequest
from ambf_tools.recording.topic_sources import Source, TopicSources

TURN = 0.004  # s between two readings of a connection
CHUNK_AGE = 0.5  # s: what a crash may cost
QUEUE_CHUNKS = 256  # chunks that may wait for the disk; then reading pauses
REPORT_INTERVAL = 0.25  # s
READ_BYTES = 1 << 20
IN_FLIGHT = 0.1  # s: more than a message needs from a publisher that has sent it
STAMP_TOLERANCE = 5.0  # s: stamps farther from now are not the time at which a message was sent
MAX_MESSAGE = 1 << 30


@dataclass
class Settings:
    """What to record, and where."""

    path: str
    topics: list[str] = field(default_factory=list)
    patterns: list[str] = field(default_factory=list)
    min_free_bytes: int = 1 << 30
    duration: float = 0.0  # s; 0: until stopped
    every: int = 0  # steps between two states; 0: as they are published


class Link:
    """A connection and what was read from it."""

    def __init__(self, source: Source, channel: Channel) -> None:
        self.source, self.channel = source, channel
        self.has_header = _begins_with_header(source.header.get("message_definition", ""))
        self.rest = b""  # the beginning of a message
        self.next_sequence = -1  # roscpp and rospy number the messages of a publisher
        self.messages = 0
        self.lost = 0
        self.introduced = False
        self.last_stamp = b""  # of its newest message


def _begins_with_header(definition: str) -> bool:
    for line in definition.splitlines():
        words = line.split("#", 1)[0].split()
        if len(words) == 2 and "=" not in words[1]:
            return words[0] in ("Header", "std_msgs/Header")
        if line.startswith("===="):
            break
    return False


def take_messages(link: Link, data: bytes, chunk: Chunk, now_ns: int) -> bool:
    """Puts the whole messages of `data` into the chunk. False when the bytes are not what TCPROS may send."""
    if link.rest:
        data = link.rest + data
    size, at = len(data), 0
    if size < 4:
        link.rest = data
        return True
    out = chunk.data
    index = chunk.entries(link.channel, not link.introduced)
    link.introduced = True
    prefix, received = link.channel.prefix, stamp_of(now_ns)
    length_at = struct.Struct("<I").unpack_from
    use_stamps = link.has_header and size >= 16 and _plausible(data, 8, now_ns)
    expected, count, lost, first, last = link.next_sequence, 0, 0, b"", b""
    while size - at >= 4:
        (length,) = length_at(data, at)
        end = at + 4 + length
        if end > size:
            if length > MAX_MESSAGE:
                return False
            break
        if link.has_header:
            # <length> <seq> <secs> <nsecs>: the stamp of the message is the time in the bag, byte by byte
            stamp = data[at + 8 : at + 16] if use_stamps else received
            (sequence,) = length_at(data, at + 4)
            if sequence != expected and expected >= 0 and sequence > expected:
                lost += sequence - expected
            expected = sequence + 1
        else:
            stamp = received
        index += stamp
        index += len(out).to_bytes(4, "little")
        out += prefix
        out += stamp
        out += data[at:end]
        if not count:
            first = stamp
        last = stamp
        count += 1
        at = end
    if count:
        chunk.note_times(first, last)
        link.last_stamp = last
    link.next_sequence = expected
    link.messages += count
    link.lost += lost
    link.rest = data[at:]
    return True


def _plausible(data: bytes, at: int, now_ns: int) -> bool:
    seconds, rest = struct.unpack_from("<II", data, at)
    return bool(abs(seconds + rest * 1e-9 - now_ns * 1e-9) < STAMP_TOLERANCE)


class DiskThread:
    """Writes chunks in the background; keeps the first error."""

    def __init__(self, writer: BagWriter) -> None:
        self.error: OSError | None = None
        self._writer = writer
        self._waiting: queue.Queue[Chunk | None] = queue.Queue(QUEUE_CHUNKS)
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def give(self, chunk: Chunk) -> None:
        """Queues a chunk; waits while the disk is far behind."""
        self._waiting.put(chunk)

    @property
    def backlog(self) -> int:
        """Chunks that wait."""
        return self._waiting.qsize()

    def finish(self) -> None:
        """Returns when all is written, or dropped after an error."""
        self._waiting.put(None)
        self._thread.join()

    def _run(self) -> None:
        while (chunk := self._waiting.get()) is not None:
            if self.error is None:
                try:
                    self._writer.write(chunk)
                except OSError as problem:
                    self.error = problem


class Engine:
    """One recording, from its first message to its closed bag."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._path = Path(settings.path)
        self._wake_out, self._wake_in = os.pipe()
        os.set_blocking(self._wake_out, False)
        self._poll = select.epoll()
        self._poll.register(self._wake_out, select.EPOLLIN)
        self._links: dict[int, Link] = {}
        self._ended: list[Link] = []
        self._stop_reason = ""
        self._was_cut_short = False
        self._begin = time.monotonic()
        self._writer = BagWriter(self._path)
        self._disk = DiskThread(self._writer)
        self._chunk, self._chunk_begin = Chunk(), self._begin
        self._sources = TopicSources(settings.topics, settings.patterns, self._wake, settings.every)

    def _wake(self) -> None:
        os.write(self._wake_in, b".")

    def stop(self, reason: str) -> None:
        """Ends the recording at the next turn; from any thread."""
        self._stop_reason = self._stop_reason or reason
        self._wake()

    def run(self) -> None:
        """Records until stopped."""
        self._report("started", path=str(self._path))
        next_report = 0.0
        while not self._stop_reason:
            began = time.monotonic()
            self._turn()
            now = time.monotonic()
            if now - self._chunk_begin > CHUNK_AGE:
                self._hand_over()
            if now > next_report:
                next_report = now + REPORT_INTERVAL
                self._look_after_disk()
                self._report("status")
            if 0 < self._settings.duration <= now - self._begin:
                self.stop("its time was over")
            time.sleep(max(0.0, TURN - (time.monotonic() - began)))
        self._end()

    def _turn(self) -> None:
        for descriptor, _ in self._poll.poll(0.05):
            if descriptor == self._wake_out:
                with contextlib.suppress(BlockingIOError):
                    os.read(self._wake_out, 4096)
                self._take_sources()
            else:
                self._read(self._links[descriptor])
        if self._settings.every:
            self._send_receipts()

    def _send_receipts(self) -> None:
        """Reports, to each simulator whose steps are recorded, the newest step of which all states are here."""
        newest: dict[StepRequest, Stamp] = {}
        for link in self._links.values():
            request = link.source.request
            if request is not None and link.last_stamp:
                newest[request] = min(newest.get(request, link.last_stamp), link.last_stamp, key=as_number)
        for request, stamp in newest.items():
            request.received(stamp)

    def _take_sources(self) -> None:
        while not self._sources.arrived.empty():
            source = self._sources.arrived.get()
            link = Link(source, self._writer.channel(source.topic, source.header))
            self._links[source.socket.fileno()] = link
            self._poll.register(source.socket, select.EPOLLIN)

    def _read(self, link: Link) -> None:
        try:
            data = link.source.socket.recv(READ_BYTES)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if not data or not take_messages(link, data, self._chunk, time.time_ns()):
            self._drop(link)
        if len(self._chunk) >= CHUNK_BYTES:
            self._hand_over()

    def _drop(self, link: Link) -> None:
        self._poll.unregister(link.source.socket)
        del self._links[link.source.socket.fileno()]
        link.source.socket.close()
        self._ended.append(link)
        self._sources.forget(link.source)

    def _hand_over(self) -> None:
        if self._chunk.data:
            self._disk.give(self._chunk)
        self._chunk, self._chunk_begin = Chunk(), time.monotonic()

    def _look_after_disk(self) -> None:
        if self._disk.error is not None:
            self._cut_short(f"the disk refused: {self._disk.error.strerror}")
        elif free_bytes(self._path.parent) < self._settings.min_free_bytes:
            self._cut_short(f"less than {readable_bytes(self._settings.min_free_bytes)} are free")

    def _cut_short(self, reason: str) -> None:
        self._was_cut_short = True
        self.stop(reason)

    def _end(self) -> None:
        # All that was simulated before the end. Its publisher waits for our receipts: they go on meanwhile.
        if self._settings.every:
            with ThreadPoolExecutor(1) as pool:
                sent = pool.submit(self._sources.wait_until_sent)
                while not sent.done():
                    self._turn()
            until = time.monotonic() + (IN_FLIGHT if sent.result() else 0.0)
            while time.monotonic() < until:
                self._turn()
        self._turn()
        self._hand_over()
        self._disk.finish()
        if self._disk.error is not None:
            self._was_cut_short = True
            self._stop_reason = f"the disk refused: {self._disk.error.strerror}"
        complete, note = True, ""
        try:
            if self._writer.close():
                note = "the last part was given up to make room for the index"
        except OSError as problem:
            complete, note = False, f"no index could be written ({problem.strerror}): repair the bag"
        ended = {"reason": self._stop_reason, "cut_short": self._was_cut_short or bool(note)}
        self._report("stopped", complete=complete, note=note, **ended)
        self._sources.close()

    def _report(self, event: str, **more: Any) -> None:
        links = [*self._links.values(), *self._ended]
        topics: dict[str, list[int]] = {topic: [0, 0] for topic in sorted(self._sources.matched)}
        for link in links:
            counts = topics.setdefault(link.source.topic, [0, 0])
            counts[0] += link.messages
            counts[1] += link.lost
        line = {
            "event": event,
            "seconds": time.monotonic() - self._begin,
            "messages": sum(link.messages for link in links),
            "lost": sum(link.lost for link in links),
            "bytes": self._writer.size,
            "free_bytes": free_bytes(self._path.parent),
            "backlog": self._disk.backlog,
            "connections": len(self._links),
            "master": self._sources.master_answers,
            "topics": topics,
            "failures": dict(self._sources.failures),
            **more,
        }
        try:
            print(json.dumps(line), flush=True)
        except (BrokenPipeError, ValueError):
            self.stop("its reader is gone")


def main() -> int:
    """Records as the one argument says."""
    engine = Engine(Settings(**json.loads(sys.argv[1])))
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: engine.stop("a signal ended it"))
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # a write beyond a limit shall fail, not kill

    def until_closed() -> None:
        while sys.stdin.buffer.read(4096):
            pass
        engine.stop("stopped")

    threading.Thread(target=until_closed, daemon=True).start()
    engine.run()
    return 0


if __name__ == "__main__":
    sys.exit(main())
