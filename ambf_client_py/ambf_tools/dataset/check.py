"""What is wrong with a data set: of its format, and by Open-H's rules for what is published there."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import lerobot, lerobot_videos, robomimic

_FLOAT_NOISE = 1e-4  # s: LeRobot's tolerance of timestamps


@dataclass(frozen=True)
class Finding:
    """level: "error" (readers refuse it or read something else) or "warning"."""

    level: str
    message: str

    def __str__(self) -> str:
        return f"{self.level}: {self.message}"


def check(path: str | Path, open_h: bool = False) -> list[Finding]:
    """All findings about a folder of LeRobot 2.1 or 3.0, or a robomimic file. open_h: also Open-H's rules."""
    place = Path(path)
    try:
        if not place.is_dir():
            return _robomimic(place)
        found = _lerobot(place)
        return found + _open_h(place) if open_h else found
    except Exception as problem:  # whatever a damaged file makes of its reader
        return [Finding("error", f"{place}: {problem!r}")]


def _lerobot(root: Path) -> list[Finding]:
    import pyarrow.parquet as parquet

    found: list[Finding] = []

    def error(message: str) -> None:
        found.append(Finding("error", message))

    info = json.loads((root / "meta/info.json").read_text())
    version = str(info.get("codebase_version", "")).removeprefix("v")
    if version not in lerobot.PATHS:
        return [Finding("error", f"codebase_version '{info.get('codebase_version')}' is neither v2.1 nor v3.0")]
    for name in ("fps", "total_episodes", "total_frames", "total_tasks", "splits", "data_path", "features"):
        if name not in info:
            error(f"info.json has no '{name}'")
    if found:
        return found
    features = info["features"]
    for name in ("action", "observation.state", *lerobot.AUTOMATIC):
        if name not in features:
            error(f"there is no feature '{name}'")
    for name in features:
        if "/" in name:
            error(f"the feature '{name}' has a / in its name")
    if not isinstance(info["fps"], int) or info["fps"] <= 0:
        error(f"fps is {info['fps']!r}, not a whole number above 0")
    names = lerobot.tasks(root)
    if len(set(names)) != len(names) or len(names) != info["total_tasks"]:
        error(f"total_tasks is {info['total_tasks']}, but the tasks are {names}")
    files = sorted(root.glob("data/chunk-*/*.parquet"))
    stored = {name: feature for name, feature in features.items() if feature["dtype"] != lerobot.VIDEO}
    tables = [parquet.read_table(file) for file in files]
    for file, table in zip(files, tables, strict=True):
        if set(table.column_names) != set(stored):
            error(f"{file.name} has the columns {sorted(table.column_names)}, not those of info.json")
    if found:
        return found
    columns = {
        name: np.concatenate([lerobot.values(table, name, feature) for table in tables])
        for name, feature in stored.items()
    }
    _check_rows(columns, info, len(names), error)
    _check_lengths(root, version, columns, info, error)
    for problem in lerobot_videos.problems(root, info, lerobot.episode_rows(root)):
        error(problem)
    return found


def _check_rows(columns: dict[str, Any], info: dict[str, Any], tasks: int, error: Any) -> None:
    index, episode = columns["index"], columns["episode_index"]
    if len(index) != info["total_frames"]:
        error(f"total_frames is {info['total_frames']}, but there are {len(index)} rows")
    if not np.array_equal(index, np.arange(len(index))):
        error("'index' does not run from 0 without a gap")
    changes = np.flatnonzero(np.diff(episode)) + 1
    numbers = episode[[0, *changes]] if len(episode) else episode
    if not np.array_equal(numbers, np.arange(info["total_episodes"])):
        error(
            f"the rows are of the episodes {numbers.tolist()}, not 0 to {info['total_episodes'] - 1}, each in one piece"
        )
    starts = np.zeros(len(index), np.int64)
    starts[changes] = changes
    frame = np.arange(len(index)) - np.maximum.accumulate(starts)
    if not np.array_equal(columns["frame_index"], frame):
        error("'frame_index' does not count from 0 in each episode")
    if len(index) and np.abs(columns["timestamp"] - columns["frame_index"] / info["fps"]).max() > _FLOAT_NOISE:
        error(f"'timestamp' is not frame_index / {info['fps']}")
    if len(index) and not 0 <= columns["task_index"].min() <= columns["task_index"].max() < tasks:
        error("'task_index' names a task that does not exist")
    for name, array in columns.items():
        if array.dtype.kind == "f" and not np.isfinite(array).all():
            error(f"'{name}' has values that are not finite")


def _check_lengths(root: Path, version: str, columns: dict[str, Any], info: dict[str, Any], error: Any) -> None:
    lengths = np.bincount(columns["episode_index"], minlength=info["total_episodes"]).tolist()
    rows = lerobot.episode_rows(root)
    if version == "2.1":
        stats = [json.loads(line) for line in (root / "meta/episodes_stats.jsonl").read_text().splitlines()]
        stated = [(each["episode_index"], each["stats"]) for each in stats]
        parts = [(f"episode {number}", columns["episode_index"] == number, stat) for number, stat in stated]
    else:
        whole = json.loads((root / "meta/stats.json").read_text())
        parts = [("stats.json", slice(None), whole)]
        begins = [each["dataset_from_index"] for each in rows]
        if begins != np.cumsum([0, *lengths])[:-1].tolist():
            error("dataset_from_index is not where the episodes begin")
    if [each["length"] for each in rows] != lengths:
        error(f"the lengths of episodes are {[each['length'] for each in rows]}, but there are {lengths} rows")
    for what, chosen, stat in parts:
        for name, array in columns.items():
            right = lerobot.stats_of(array[chosen], "2.1")
            if name not in stat or any(
                not np.allclose(stat[name][key], each, rtol=1e-5, atol=1e-7) for key, each in right.items()
            ):
                error(f"{what}: the statistics of '{name}' are not those of its rows")


def _open_h(root: Path) -> list[Finding]:
    info = json.loads((root / "meta/info.json").read_text())
    found = []
    if info["codebase_version"] != "v2.1":
        found.append(Finding("error", f"Open-H takes v2.1, not {info['codebase_version']}"))
    if not (root / "videos").is_dir():
        found.append(Finding("error", "there is no folder videos"))
    readme = root / "meta/README.md"
    if not readme.is_file():
        found.append(Finding("error", "there is no meta/README.md"))
    elif not any(word in readme.read_text().lower() for word in ("synchron", "timestamp")):
        found.append(Finding("warning", "meta/README.md does not say how streams are synchronised"))
    pictures = {name: each for name, each in info["features"].items() if name.startswith("observation.images.")}
    if not pictures:
        found.append(Finding("warning", "there are no pictures (observation.images.*)"))
    for name, each in pictures.items():
        if each["dtype"] != lerobot.VIDEO:
            found.append(Finding("warning", f"the pictures '{name}' are no video"))
        if min(each["shape"][:2]) < 480:
            found.append(Finding("warning", f"the pictures '{name}' are of {each['shape']}, not 480 high and wide"))
    if info["fps"] < 20:
        found.append(Finding("warning", f"fps is {info['fps']}, less than 20"))
    missing = [name for name in ("train", "val", "test") if name not in info["splits"]]
    if missing:
        found.append(Finding("warning", f"there is no split {', '.join(missing)}"))
    if not info["robot_type"]:
        found.append(Finding("warning", "robot_type is empty"))
    return found


def _robomimic(file: Path) -> list[Finding]:
    import h5py

    found: list[Finding] = []

    def error(message: str) -> None:
        found.append(Finding("error", message))

    with h5py.File(file, "r") as source:
        data = source["data"]
        arguments = json.loads(data.attrs["env_args"])
        if not {"env_name", "type", "env_kwargs"} <= arguments.keys() or arguments["type"] != robomimic.GYM:
            error(f"env_args are {arguments}: they lack something, or type is not {robomimic.GYM} (gym)")
        names = sorted(data, key=lambda name: int(name.removeprefix("demo_")))
        if names != [f"demo_{i}" for i in range(len(names))]:
            error(f"the episodes are {names}, not demo_0 to demo_{len(names) - 1}")
        total = 0
        for name in names:
            demo = data[name]
            rows = int(demo.attrs["num_samples"])
            total += rows
            arrays: dict[str, Any] = {each: demo[each] for each in ("actions", "rewards", "dones", "states")}
            arrays |= {f"obs/{each}": array for each, array in demo["obs"].items()}
            for key, array in arrays.items():
                if len(array) != rows:
                    error(f"{name}/{key} has {len(array)} rows, but num_samples is {rows}")
                if array.dtype.kind == "f" and not np.isfinite(array[()]).all():
                    error(f"{name}/{key} has values that are not finite")
            for key, after in demo.get("next_obs", {}).items():
                if key not in demo["obs"] or not np.array_equal(after[:-1], demo["obs"][key][1:]):
                    error(f"{name}/next_obs/{key} is not what {name}/obs/{key} has a row later")
            if np.abs(demo["actions"][()]).max(initial=0.0) > 1.0:
                error(f"{name}/actions are not within -1 to 1")
        if total != int(data.attrs["total"]):
            error(f"total is {data.attrs['total']}, but there are {total} rows")
        for key, mask in source.get("mask", {}).items():
            unknown = {each.decode() for each in mask[()]} - set(names)
            if unknown:
                error(f"mask/{key} names {sorted(unknown)}, which do not exist")
    return found
