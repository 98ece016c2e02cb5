"""Pictures as H.264 in MP4 files, by ffmpeg: what LeRobot's columns of the type `video` hold. It loses some detail."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .episodes import DatasetError

CODEC, PIXELS, QUALITY, GROUP = "h264", "yuv420p", 18, 2  # a picture of its own every two: readers ask for single ones


def encode(pictures: Iterable[NDArray[np.uint8]], file: Path, width: int, height: int, fps: int) -> None:
    """Writes pictures (height, width, 3); one at a time is in memory. Raises DatasetError."""
    if width % 2 or height % 2:
        raise DatasetError(f"videos want pictures of an even width and height, not {width} x {height}")
    file.parent.mkdir(parents=True, exist_ok=True)
    made = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(fps), "-i", "-"]
    made += ["-c:v", "libx264", "-pix_fmt", PIXELS, "-crf", str(QUALITY), "-g", str(GROUP), str(file)]
    command = ["ffmpeg", "-nostdin", "-loglevel", "error", "-y", *made]
    # Complaints go to a file: ffmpeg never waits to be read. Unbuffered: what it did not take is not sent again.
    with tempfile.TemporaryFile() as complaints:
        with _started(command, stdin=subprocess.PIPE, stderr=complaints, bufsize=0) as process:
            assert process.stdin
            try:
                for picture in pictures:
                    rest = memoryview(picture.tobytes())
                    while rest:
                        rest = rest[process.stdin.write(rest) :]
            except BrokenPipeError:
                pass  # it says why it ended
        complaints.seek(0)
        said = complaints.read().decode(errors="replace").strip()
    if process.returncode:
        raise DatasetError(f"ffmpeg did not write {file}: {said}")


def decode(file: Path, width: int, height: int) -> NDArray[np.uint8]:
    """All pictures, (pictures, height, width, 3). Raises DatasetError."""
    command = ["ffmpeg", "-nostdin", "-loglevel", "error", "-i", str(file), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    data = _output(command, file)
    if not data or len(data) % (width * height * 3):
        raise DatasetError(f"{file} does not hold pictures of {width} x {height}")
    return np.frombuffer(data, np.uint8).reshape(-1, height, width, 3)


def describe(file: Path) -> dict[str, Any]:
    """Its width, height, frames and rate (pictures a second). Raises DatasetError."""
    shown = "stream=width,height,nb_read_packets,r_frame_rate"
    command = ["ffprobe", "-v", "error", "-select_streams", "v:0", "-count_packets", "-show_entries", shown]
    streams = json.loads(_output([*command, "-of", "json", str(file)], file)).get("streams", [])
    if not streams:
        raise DatasetError(f"{file} holds no video")
    rate, _, base = streams[0]["r_frame_rate"].partition("/")
    about = {"width": streams[0]["width"], "height": streams[0]["height"]}
    return about | {"frames": int(streams[0]["nb_read_packets"]), "rate": float(rate) / float(base or 1)}


def _started(command: list[str], **streams: Any) -> subprocess.Popen[bytes]:
    try:
        return subprocess.Popen(command, **streams)
    except FileNotFoundError:
        raise DatasetError(f"videos need {command[0]}, which is not installed (Debian: ffmpeg)") from None


def _output(command: list[str], file: Path) -> bytes:
    if not file.is_file():
        raise DatasetError(f"there is no {file}")
    with _started(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        data, said = process.communicate()
    if process.returncode:
        raise DatasetError(f"{file} cannot be read: {said.decode(errors='replace').strip()}")
    return data
