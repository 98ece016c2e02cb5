"""Writes bag files (rosbag format 2.0) from serialized messages, at hundreds of thousands of messages a second.

The file on disk is a sequence of complete chunks, each with its index, so that `rosbag reindex` finds everything up
to the last chunk whenever the process dies. rosbag's own writer looks at each message object, which is too slow by a
factor of 20. Format: wiki.ros.org/Bags/Format/2.0. One thread owns a writer.
"""

import os
import struct
from pathlib import Path

MAGIC = b"#ROSBAG V2.0\n"
CHUNK_BYTES = 1 << 20
_HEADER_SPACE = 4096  # the bag header is rewritten in place at the end
_OP_MESSAGE, _OP_BAG, _OP_INDEX, _OP_CHUNK, _OP_CHUNK_INFO, _OP_CONNECTION = 2, 3, 4, 5, 6, 7

Stamp = bytes  # seconds and nanoseconds, two little-endian uint32: as in messages, so as in the file


def stamp_of(nanoseconds: int) -> Stamp:
    """A stamp, from nanoseconds since 1970."""
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    return struct.pack("<II", seconds & 0xFFFFFFFF, rest)


def fields(values: dict[str, bytes]) -> bytes:
    """Named values as ROS writes them: in connection headers, in bag records."""
    parts = [name.encode() + b"=" + value for name, value in values.items()]
    return b"".join(struct.pack("<I", len(part)) + part for part in parts)


def _record(header: dict[str, bytes], data: bytes) -> bytes:
    head = fields(header)
    return struct.pack("<I", len(head)) + head + struct.pack("<I", len(data)) + data


def _op(code: int) -> bytes:
    return bytes([code])


class Channel:
    """One topic of one publisher in the bag. Messages are added by Chunk.add()."""

    def __init__(self, number: int, topic: str, header: dict[str, str]) -> None:
        self.number = number
        self.topic = topic
        named = {name: text.encode() for name, text in header.items()}
        self.record = _record(
            {"op": _op(_OP_CONNECTION), "conn": struct.pack("<I", number), "topic": topic.encode()},
            fields({"topic": topic.encode(), **named}),
        )
        # Everything before the time of a message record: the time, and the message with its length, follow.
        head = fields({"op": _op(_OP_MESSAGE), "conn": struct.pack("<I", number)})
        time_field = struct.pack("<I", 5 + 8) + b"time="
        self.prefix = struct.pack("<I", len(head) + len(time_field) + 8) + head + time_field


class Chunk:
    """Messages that are written together."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.index: dict[int, bytearray] = {}  # channel number -> (stamp, offset) of each message
        self.first = b""
        self.last = b""

    def __len__(self) -> int:
        return len(self.data)

    def entries(self, channel: Channel, is_new: bool) -> bytearray:
        """The channel's index in this chunk. A channel is introduced in the chunk where it first appears."""
        if is_new:
            self.data += channel.record
        return self.index.setdefault(channel.number, bytearray())

    def note_times(self, first: Stamp, last: Stamp) -> None:
        """Widens the chunk's time range."""
        if not self.first or as_number(first) < as_number(self.first):
            self.first = first
        if not self.last or as_number(last) > as_number(self.last):
            self.last = last


def as_number(stamp: Stamp) -> tuple[int, int]:
    """Seconds and nanoseconds: what stamps are compared by."""
    seconds, rest = struct.unpack("<II", stamp)
    return seconds, rest


class BagWriter:
    """A bag being written under NAME.active; close() completes it and gives it its name."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.active_path = path.with_name(path.name + ".active")
        self._channels: list[Channel] = []
        self._infos: list[tuple[int, bytes, bytes, dict[int, int]]] = []
        self._file = os.open(self.active_path, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o644)
        self._end = 0
        try:
            self._append(MAGIC + self._bag_header(0))
        except OSError:
            os.close(self._file)
            self.active_path.unlink()
            raise

    @property
    def size(self) -> int:
        """Bytes written so far."""
        return self._end

    def channel(self, topic: str, header: dict[str, str]) -> Channel:
        """A new channel; header: what the publisher declared (type, md5sum, message_definition, callerid, latching)."""
        self._channels.append(Channel(len(self._channels), topic, header))
        return self._channels[-1]

    def write(self, chunk: Chunk) -> None:
        """Writes a chunk and its index: wholly, or, where the disk refuses, not at all."""
        if not chunk.data:
            return
        start = self._end
        size = struct.pack("<I", len(chunk.data))
        head = fields({"op": _op(_OP_CHUNK), "compression": b"none", "size": size})
        parts = [struct.pack("<I", len(head)), head, size, bytes(chunk.data)]
        counts = {}
        for number, entries in chunk.index.items():
            counts[number] = len(entries) // 12
            header = {"op": _op(_OP_INDEX), "ver": struct.pack("<I", 1), "conn": struct.pack("<I", number)}
            header["count"] = struct.pack("<I", counts[number])
            parts.append(_record(header, bytes(entries)))
        self._append(b"".join(parts))
        self._infos.append((start, chunk.first or stamp_of(0), chunk.last or stamp_of(0), counts))

    def close(self) -> int:
        """Writes the closing index and renames the file. Returns how many of the last chunks had to go to make room."""
        given_up = 0
        while True:
            index_at = self._end
            try:
                self._append(self._closing_index())
                break
            except OSError:
                if not self._infos:
                    os.close(self._file)
                    raise
                # A full disk: the last chunk makes room for what makes the others readable.
                self._end = self._infos.pop()[0]
                os.ftruncate(self._file, self._end)
                given_up += 1
        os.pwrite(self._file, self._bag_header(index_at), len(MAGIC))
        os.fsync(self._file)
        os.close(self._file)
        self.active_path.rename(self.path)
        return given_up

    def _closing_index(self) -> bytes:
        parts = [channel.record for channel in self._channels]
        for position, first, last, counts in self._infos:
            header = {"op": _op(_OP_CHUNK_INFO), "ver": struct.pack("<I", 1), "chunk_pos": struct.pack("<Q", position)}
            header.update(start_time=first, end_time=last, count=struct.pack("<I", len(counts)))
            parts.append(_record(header, b"".join(struct.pack("<II", n, count) for n, count in counts.items())))
        return b"".join(parts)

    def _bag_header(self, index_at: int) -> bytes:
        head = fields(
            {
                "op": _op(_OP_BAG),
                "index_pos": struct.pack("<Q", index_at),
                "conn_count": struct.pack("<I", len(self._channels) if index_at else 0),
                "chunk_count": struct.pack("<I", len(self._infos) if index_at else 0),
            }
        )
        blanks = b" " * (_HEADER_SPACE - len(head))
        return struct.pack("<I", len(head)) + head + struct.pack("<I", len(blanks)) + blanks

    def _append(self, data: bytes) -> None:
        view, at = memoryview(data), self._end
        try:
            while view:
                done = os.pwrite(self._file, view, at)
                at, view = at + done, view[done:]
        except OSError:
            os.ftruncate(self._file, self._end)
            raise
        self._end = at
