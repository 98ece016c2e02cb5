"""PNG files of 8 bits red, green and blue, without a library: what LeRobot's columns of pictures hold."""

from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_RGB8 = struct.pack(">BBBBB", 8, 2, 0, 0, 0)  # bits, colours, compression, filters, no interlace


def encode(picture: NDArray[np.uint8]) -> bytes:
    """A picture (height, width, 3), without loss."""
    height, width, _ = picture.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # each row begins with its filter: none
    rows[:, 1:] = picture.reshape(height, -1)
    header = struct.pack(">II", width, height) + _RGB8
    return (
        _SIGNATURE + _chunk(b"IHDR", header) + _chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + _chunk(b"IEND", b"")
    )


def decode(data: bytes) -> NDArray[np.uint8]:
    """What encode() was given. Raises ValueError for what is none, and for PNGs of other kinds."""
    if data[:8] != _SIGNATURE:
        raise ValueError("a picture is no PNG")
    at, packed, header = 8, b"", b""
    while at + 8 <= len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        header, packed = (body, packed) if kind == b"IHDR" else (header, packed + body * (kind == b"IDAT"))
        at += size + 12
    if header[8:] != _RGB8:
        raise ValueError("a PNG of another kind than 8 bits red, green and blue")
    width, height = struct.unpack(">II", header[:8])
    try:
        rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    except (zlib.error, ValueError) as error:
        raise ValueError(f"a damaged PNG: {error}") from error
    if rows[:, 0].any():
        raise ValueError("a PNG with filters, as other writers make it")
    return rows[:, 1:].reshape(height, width, 3).copy()


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
