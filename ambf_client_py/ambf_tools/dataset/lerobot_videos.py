"""Where LeRobot's formats keep videos: 2.1 a file an episode and column, 3.0 many episodes a file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import video
from .episodes import Dataset, DatasetError

PATHS = {
    "2.1": "videos/chunk-{episode_chunk:03d}/{video_key}/episode_{episode_index:06d}.mp4",
    "3.0": "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4",
}
CHUNK = 1000  # episodes or files a folder
FILE_MB = 200  # of 3.0: no file is meant to be larger
_TOLERANCE = 1e-4  # s: LeRobot's
_PIXELS_A_FILE = 4e9  # what fills one at some 0.4 bits a pixel


def write(dataset: Dataset, root: Path, version: str) -> list[dict[str, Any]]:
    """Of all pictures. Returns, for each episode, what 3.0's list of episodes says of its videos."""
    rows: list[dict[str, Any]] = [{} for _ in dataset.episodes]
    for name in dataset.pictures():
        height, width, _ = dataset.features()[name][1]
        for file, numbers in enumerate(_files(dataset, version, width * height)):
            place = _place(root, version, name, file)
            parts = [dataset.episodes[number].columns[name] for number in numbers]
            video.encode((each for part in parts for each in part), place, width, height, dataset.fps)
            before = 0
            for number, part in zip(numbers, parts, strict=True):
                begin, before = before, before + len(part)
                rows[number] |= {
                    f"videos/{name}/chunk_index": file // CHUNK,
                    f"videos/{name}/file_index": file % CHUNK,
                    f"videos/{name}/from_timestamp": begin / dataset.fps,
                    f"videos/{name}/to_timestamp": before / dataset.fps,
                }
    return rows


def feature(shape: tuple[int, ...], fps: int) -> dict[str, Any]:
    """A column of pictures (height, width, 3) as info.json has it."""
    height, width, channels = shape
    about = {"height": height, "width": width, "channels": channels, "codec": video.CODEC, "pix_fmt": video.PIXELS}
    about |= {"fps": fps, "g": video.GROUP, "crf": video.QUALITY, "is_depth_map": False}
    described = {f"video.{key}": value for key, value in about.items()} | {"has_audio": False}
    return {"dtype": "video", "shape": list(shape), "names": ["height", "width", "channels"], "info": described}


def read(root: Path, name: str, info: dict[str, Any], episodes: list[dict[str, Any]]) -> list[NDArray[np.uint8]]:
    """The pictures of one column, an array an episode. episodes: as placed() gives them."""
    height, width, _ = info["features"][name]["shape"]
    files: dict[Path, NDArray[np.uint8]] = {}
    found = []
    for episode in episodes:
        file, first = placed(root, name, info, episode)
        if file not in files:
            files = {file: video.decode(file, width, height)}  # one at a time: they are large
        found.append(files[file][first : first + episode["length"]])
        if len(found[-1]) != episode["length"]:
            raise DatasetError(f"{file} has too few pictures for episode {episode['episode_index']}")
    return found


def placed(root: Path, name: str, info: dict[str, Any], episode: dict[str, Any]) -> tuple[Path, int]:
    """The file of an episode's pictures, and the number of its first one. episode: a row of the list of episodes."""
    version = info["codebase_version"].removeprefix("v")
    if version == "2.1":
        return _place(root, version, name, episode["episode_index"]), 0
    file = episode[f"videos/{name}/chunk_index"] * CHUNK + episode[f"videos/{name}/file_index"]
    return _place(root, version, name, file), round(episode[f"videos/{name}/from_timestamp"] * info["fps"])


def problems(root: Path, info: dict[str, Any], episodes: list[dict[str, Any]]) -> list[str]:
    """What is wrong with the videos: files that are not there, of another size or rate, with other counts of rows."""
    found = []
    for name, about in info["features"].items():
        if about["dtype"] != "video":
            continue
        rows: dict[Path, int] = {}
        for episode in episodes:
            file, first = placed(root, name, info, episode)
            if first != rows.get(file, 0):
                found.append(f"{name}: episode {episode['episode_index']} begins at {first} of {file.name}")
            rows[file] = rows.get(file, 0) + episode["length"]
            length = episode["length"] / info["fps"]
            begin, end = (episode.get(f"videos/{name}/{each}_timestamp", 0.0) for each in ("from", "to"))
            if end and abs(end - begin - length) > _TOLERANCE:  # 2.1 has no such times
                found.append(f"{name}: episode {episode['episode_index']} lasts {end - begin} s, not {length}")
        for file, count in rows.items():
            try:
                seen = video.describe(file)
            except DatasetError as problem:
                found.append(str(problem))
                continue
            if seen["frames"] != count:
                found.append(f"{file.name} of {name} has {seen['frames']} pictures for {count} rows")
            if [seen["height"], seen["width"]] != about["shape"][:2] or abs(seen["rate"] - info["fps"]) > 1e-3:
                found.append(f"{file.name} of {name} is {seen}, not {about['shape']} at {info['fps']}")
    return found


def _place(root: Path, version: str, name: str, file: int) -> Path:
    of_episode = {"episode_chunk": file // CHUNK, "episode_index": file}
    return root / PATHS[version].format(
        video_key=name, chunk_index=file // CHUNK, file_index=file % CHUNK, **of_episode
    )


def _files(dataset: Dataset, version: str, pixels: int) -> list[list[int]]:
    """Numbers of the episodes in each file."""
    if version == "2.1":
        return [[number] for number in range(len(dataset.episodes))]
    files: list[list[int]] = [[]]
    held = 0
    for number, episode in enumerate(dataset.episodes):
        if files[-1] and held + len(episode) * pixels > _PIXELS_A_FILE:
            files.append([])
            held = 0
        files[-1].append(number)
        held += len(episode) * pixels
    return files
