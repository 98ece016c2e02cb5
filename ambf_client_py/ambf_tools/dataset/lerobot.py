"""LeRobot's formats 2.1 (a file an episode) and 3.0 (many episodes a file), written and read without LeRobot.

What they have no place for (environment, seeds, randomisation) is in meta/ambf.json.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import lerobot_videos, png, readme
from .episodes import ACTION, STATE, Dataset, DatasetError, Episode, check_writable

CHUNK = lerobot_videos.CHUNK
FILE_MB = 100  # of 3.0: a new file beyond
PATHS = {
    "2.1": "data/chunk-{episode_chunk:03d}/episode_{episode_index:06d}.parquet",
    "3.0": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
}
AUTOMATIC = {  # columns that the format itself wants
    "timestamp": "float32",
    "frame_index": "int64",
    "episode_index": "int64",
    "index": "int64",
    "task_index": "int64",
}
_IMAGE = "image"  # dtype of pictures that are PNGs in the column itself
VIDEO = "video"  # dtype of those that are in files of their own
QUANTILES = {"q01": 0.01, "q10": 0.1, "q50": 0.5, "q90": 0.9, "q99": 0.99}  # 3.0


def write(dataset: Dataset, folder: str | Path, version: str, video: bool = False) -> None:
    """Writes into a folder that does not exist yet. version: "2.1" or "3.0"; video: pictures as videos, not as PNGs.

    Raises DatasetError. What fails leaves no folder.
    """
    check_writable(dataset)
    root = Path(folder)
    root.mkdir(parents=True)
    try:
        _write(dataset, root, version, video)
    except BaseException:
        shutil.rmtree(root)
        raise


def _write(dataset: Dataset, root: Path, version: str, video: bool) -> None:
    import pyarrow.parquet as parquet

    (root / "meta").mkdir()
    features = _features(dataset, video)
    filmed = lerobot_videos.write(dataset, root, version) if video else [{} for _ in dataset.episodes]
    first, tables, rows = 0, [], []
    for number, episode in enumerate(dataset.episodes):
        tables.append(_table(dataset, episode, number, first, features))
        stats = _stats(tables[-1], features, version, [episode])
        rows.append(
            {"episode_index": number, "tasks": [dataset.task], "length": len(episode), "from": first, "stats": stats}
            | {"videos": filmed[number]}
        )
        first += len(episode)
    if version == "2.1":
        for number, table in enumerate(tables):
            place = root / PATHS[version].format(episode_chunk=number // CHUNK, episode_index=number)
            place.parent.mkdir(parents=True, exist_ok=True)
            parquet.write_table(table, place)
        _write_lists(root, dataset, rows)
    else:
        _write_files(root, dataset, tables, rows, features)
    (root / "meta/info.json").write_text(json.dumps(_info(dataset, version, features), indent=4))
    (root / "meta/README.md").write_text(readme.text(dataset))
    extra = {
        "environment": dataset.environment,
        "options": dataset.options,
        "episodes": [
            {"seed": e.seed, "success": e.success, "randomization": e.randomization} for e in dataset.episodes
        ],
    }
    (root / "meta/ambf.json").write_text(json.dumps(extra, indent=1))


def read(folder: str | Path) -> Dataset:
    """A data set of either version; pictures as write() leaves them. Raises DatasetError."""
    import pyarrow.parquet as parquet

    root = Path(folder)
    try:
        info = json.loads((root / "meta/info.json").read_text())
        features = {name: each for name, each in info["features"].items() if name not in AUTOMATIC}
        tables = [parquet.read_table(file) for file in sorted(root.glob("data/chunk-*/*.parquet"))]
        extra_file = root / "meta/ambf.json"
        extra = json.loads(extra_file.read_text()) if extra_file.is_file() else {}
        dataset = Dataset(
            info["fps"],
            tasks(root)[0],
            info["robot_type"] or "",
            extra.get("environment", ""),
            extra.get("options", {}),
            names={name: each["names"] for name, each in features.items() if each["names"] and len(each["shape"]) == 1},
        )
        films = {name: each for name, each in features.items() if each["dtype"] == VIDEO}
        pictures = {name: lerobot_videos.read(root, name, info, episode_rows(root)) for name in films}
        for table in tables:
            numbers = table["episode_index"].to_numpy()
            for number in np.unique(numbers):
                part = table.filter(numbers == number)
                columns = {
                    name: pictures[name][number] if name in films else values(part, name, feature)
                    for name, feature in features.items()
                }
                about = extra["episodes"][number] if "episodes" in extra else {}
                dataset.episodes.append(Episode(columns, about.get("seed"), about.get("randomization", {})))
    except (OSError, KeyError, ValueError, IndexError) as problem:
        raise DatasetError(f"{root}: {problem!r}") from problem
    return dataset


def values(table: Any, name: str, feature: dict[str, Any]) -> NDArray[Any]:
    """One column of a table, (rows, ...); a number a row is (rows,), but for states and actions."""
    column = table[name].combine_chunks()
    shape = tuple(feature["shape"])
    if feature["dtype"] == _IMAGE:
        return np.array([png.decode(each["bytes"]) for each in column.to_pylist()]).reshape(len(column), *shape)
    if shape == (1,):
        numbers = np.asarray(column.to_numpy(zero_copy_only=False), feature["dtype"])
        return numbers[:, None] if name in (STATE, ACTION) else numbers
    flat = np.asarray(column.flatten().to_numpy(zero_copy_only=False), feature["dtype"])
    return flat.reshape(len(column), *shape)


def episode_rows(root: Path) -> list[dict[str, Any]]:
    """The list of episodes, by their index: episode_index, length, ...; in 3.0 with the places of their videos."""
    import pyarrow.parquet as parquet

    if (root / "meta/episodes.jsonl").is_file():
        rows = [json.loads(line) for line in (root / "meta/episodes.jsonl").read_text().splitlines()]
    else:
        rows = parquet.read_table(root / "meta/episodes").to_pylist()
    return sorted(rows, key=lambda row: int(row["episode_index"]))


def tasks(root: Path) -> list[str]:
    """By their index."""
    import pyarrow.parquet as parquet

    if (root / "meta/tasks.jsonl").is_file():
        rows = [json.loads(line) for line in (root / "meta/tasks.jsonl").read_text().splitlines()]
    else:
        rows = parquet.read_table(root / "meta/tasks.parquet").to_pylist()
    return [row["task"] for row in sorted(rows, key=lambda row: int(row["task_index"]))]


def _table(dataset: Dataset, episode: Episode, number: int, first: int, features: dict[str, Any]) -> Any:
    import pyarrow as pa

    rows = len(episode)
    columns: dict[str, Any] = {}
    for name, array in episode.columns.items():
        if features[name]["dtype"] == VIDEO:
            continue
        if features[name]["dtype"] == _IMAGE:
            kind = pa.struct([("bytes", pa.binary()), ("path", pa.string())])
            columns[name] = pa.array([{"bytes": png.encode(each), "path": None} for each in array], kind)
            continue
        flat = pa.array(array.reshape(-1))
        size = array[0].size
        columns[name] = flat if size == 1 else pa.FixedSizeListArray.from_arrays(flat, size)
        if array.ndim > 2:
            raise DatasetError(f"column '{name}' has {array.ndim - 1} axes: neither a vector nor a picture of 8 bits")
    frame = np.arange(rows)
    columns["timestamp"] = pa.array((frame / dataset.fps).astype(np.float32))
    columns["frame_index"] = pa.array(frame)
    columns["episode_index"] = pa.array(np.full(rows, number))
    columns["index"] = pa.array(first + frame)
    columns["task_index"] = pa.array(np.zeros(rows, np.int64))
    table = pa.table(columns)
    described = {name: _described(table.schema.field(name).type) for name in columns}
    return table.replace_schema_metadata({"huggingface": json.dumps({"info": {"features": described}})})


def _described(kind: Any) -> dict[str, Any]:
    """A column's type in the words of Hugging Face's datasets: without them LeRobot 0.3 takes pictures for bytes."""
    import pyarrow as pa

    if pa.types.is_struct(kind):
        return {"_type": "Image"}
    if pa.types.is_fixed_size_list(kind):
        return {"feature": _described(kind.value_type), "length": kind.list_size, "_type": "Sequence"}
    return {"dtype": {"float": "float32", "double": "float64"}.get(str(kind), str(kind)), "_type": "Value"}


def _stats(table: Any, features: dict[str, Any], version: str, episodes: list[Episode]) -> dict[str, dict[str, Any]]:
    """Of the rows of a table, and of the videos of the episodes that it holds."""
    of_table = {name: stats_of(values(table, name, features[name]), version) for name in table.column_names}
    films = [name for name, feature in features.items() if feature["dtype"] == VIDEO]
    return of_table | {
        name: stats_of(np.concatenate([episode.columns[name] for episode in episodes]), version) for name in films
    }


def stats_of(array: NDArray[Any], version: str) -> dict[str, Any]:
    """Of each element over the rows; of pictures (rows, height, width, 3) of each colour, from 0 to 1."""
    count = len(array)
    pictures = array.ndim == 4
    rows = array.reshape(-1, 3) / 255.0 if pictures else np.asarray(array, np.float64).reshape(count, -1)
    stats: dict[str, Any] = {
        "min": rows.min(0),
        "max": rows.max(0),
        "mean": rows.mean(0),
        "std": rows.std(0),
    }
    if version == "3.0":
        stats |= {name: np.quantile(rows, part, axis=0) for name, part in QUANTILES.items()}
    return {
        **{n: (each.reshape(3, 1, 1) if pictures else each).tolist() for n, each in stats.items()},
        "count": [count],
    }


def _features(dataset: Dataset, video: bool) -> dict[str, Any]:
    """As info.json has them."""
    columns = {**dataset.features(), **{name: (kind, (1,)) for name, kind in AUTOMATIC.items()}}
    pictures = dataset.pictures()
    found = {}
    for name, (kind, shape) in columns.items():
        if name not in pictures:
            found[name] = {"dtype": kind, "shape": list(shape), "names": dataset.names.get(name)}
        elif video:
            found[name] = lerobot_videos.feature(shape, dataset.fps)
        else:
            found[name] = {"dtype": _IMAGE, "shape": list(shape), "names": ["height", "width", "channels"]}
    return found


def _info(dataset: Dataset, version: str, features: dict[str, Any]) -> dict[str, Any]:
    count = len(dataset.episodes)
    films = sum(feature["dtype"] == VIDEO for feature in features.values())
    info: dict[str, Any] = {
        "codebase_version": f"v{version}",
        "robot_type": dataset.robot,
        "total_episodes": count,
        "total_frames": dataset.frames,
        "total_tasks": 1,
        "chunks_size": CHUNK,
        "fps": dataset.fps,
        "splits": {"train": f"0:{count}"},
        "data_path": PATHS[version],
        "video_path": lerobot_videos.PATHS[version] if films else None,
        "features": features,
    }
    if version == "2.1":
        return info | {"total_videos": count * films, "total_chunks": -(-count // CHUNK)}
    return info | {"data_files_size_in_mb": FILE_MB, "video_files_size_in_mb": lerobot_videos.FILE_MB}


def _write_lists(root: Path, dataset: Dataset, rows: list[dict[str, Any]]) -> None:
    """Lists of 2.1: a line an episode or task."""

    def lines(name: str, entries: list[dict[str, Any]]) -> None:
        (root / "meta" / name).write_text("".join(json.dumps(entry) + "\n" for entry in entries))

    lines("tasks.jsonl", [{"task_index": 0, "task": dataset.task}])
    lines("episodes.jsonl", [{key: row[key] for key in ("episode_index", "tasks", "length")} for row in rows])
    lines("episodes_stats.jsonl", [{key: row[key] for key in ("episode_index", "stats")} for row in rows])


def _write_files(
    root: Path, dataset: Dataset, tables: list[Any], rows: list[dict[str, Any]], features: dict[str, Any]
) -> None:
    """Files of 3.0: episodes behind each other, a row group each."""
    import pandas as pd
    import pyarrow as pa
    import pyarrow.parquet as parquet

    file, size, writer = -1, 0, None
    episodes = []
    for table, row in zip(tables, rows, strict=True):
        if writer is None or size > FILE_MB * 1e6:
            if writer is not None:
                writer.close()
            file, size = file + 1, 0
            place = root / PATHS["3.0"].format(chunk_index=file // CHUNK, file_index=file % CHUNK)
            place.parent.mkdir(parents=True, exist_ok=True)
            writer = parquet.ParquetWriter(place, table.schema)
        writer.write_table(table)
        size += table.nbytes
        entry = {key: row[key] for key in ("episode_index", "tasks", "length")}
        entry |= {"data/chunk_index": file // CHUNK, "data/file_index": file % CHUNK}
        entry |= {"dataset_from_index": row["from"], "dataset_to_index": row["from"] + row["length"]}
        entry |= {"meta/episodes/chunk_index": 0, "meta/episodes/file_index": 0} | row["videos"]
        entry |= {f"stats/{name}/{key}": each for name, stat in row["stats"].items() for key, each in stat.items()}
        episodes.append(entry)
    assert writer is not None
    writer.close()
    folder = root / "meta/episodes/chunk-000"
    folder.mkdir(parents=True)
    parquet.write_table(pa.Table.from_pylist(episodes), folder / "file-000.parquet")
    named = pd.DataFrame({"task_index": [0]}, index=pd.Index([dataset.task], name="task"))
    parquet.write_table(pa.Table.from_pandas(named), root / "meta/tasks.parquet")
    whole = pa.concat_tables(tables)
    (root / "meta/stats.json").write_text(json.dumps(_stats(whole, features, "3.0", dataset.episodes), indent=4))
