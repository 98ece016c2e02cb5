"""robomimic's HDF5: one file, a group an episode (demo_0 ..)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .episodes import ACTION, DONE, REWARD, STATE, SUCCESS, Dataset, DatasetError, Episode, check_writable

GYM = 2  # type of environment
_OBSERVED = "observation."
_COLUMN = "column"  # attribute of an observation: its name in other formats
_LONE = "lone"  # whether it is one number a row there


def write(dataset: Dataset, file: str | Path) -> None:
    """Writes a file that does not exist yet."""
    import h5py

    check_writable(dataset)
    Path(file).parent.mkdir(parents=True, exist_ok=True)
    with h5py.File(file, "x") as out:
        data = out.create_group("data")
        arguments = {"env_name": dataset.environment, "env_type": GYM, "env_kwargs": dataset.options}
        arguments["type"] = GYM  # env_type is what robomimic documents, type what it reads
        data.attrs["env_args"] = json.dumps(arguments)
        data.attrs["total"] = dataset.frames
        data.attrs["names"] = json.dumps(dataset.names)
        data.attrs["fps"], data.attrs["task"], data.attrs["robot"] = dataset.fps, dataset.task, dataset.robot
        for number, episode in enumerate(dataset.episodes):
            demo = data.create_group(f"demo_{number}")
            demo.attrs["num_samples"] = len(episode)
            demo.attrs["randomization"] = json.dumps(episode.randomization)
            if episode.seed is not None:
                demo.attrs["seed"] = episode.seed
            demo["actions"], demo["rewards"] = episode.columns[ACTION], episode.columns[REWARD]
            demo["dones"] = episode.columns[DONE].astype(np.uint8)
            demo["successes"] = episode.columns[SUCCESS].astype(np.uint8)
            demo["states"] = episode.columns[STATE]  # of other simulators it is not restored from
            for name, array in episode.columns.items():
                if name.startswith(_OBSERVED):
                    key = name.removeprefix(_OBSERVED).replace(".", "_")  # robomimic's networks refuse dots
                    rows = array[:, None] if array.ndim == 1 else array  # its algorithms refuse lone numbers, too
                    demo[f"obs/{key}"], demo[f"next_obs/{key}"] = rows, following(rows)
                    demo[f"obs/{key}"].attrs.update({_COLUMN: name, _LONE: array.ndim == 1})
        for key, wanted in (("success", True), ("failure", False)):
            names = [f"demo_{i}".encode() for i, episode in enumerate(dataset.episodes) if episode.success == wanted]
            out[f"mask/{key}"] = np.array(names, dtype="S16")


def following(array: NDArray[Any]) -> NDArray[Any]:
    """Observations after the actions of an episode: the next row's; the last, where `dones` is 1, repeats its own."""
    return np.concatenate([array[1:], array[-1:]])


def read(file: str | Path) -> Dataset:
    """Raises DatasetError."""
    import h5py

    try:
        with h5py.File(file, "r") as source:
            data = source["data"]
            arguments = json.loads(data.attrs["env_args"])
            about: dict[str, Any] = dict(data.attrs)
            dataset = Dataset(
                int(about.get("fps", 20)),
                str(about.get("task", arguments["env_name"])),
                str(about.get("robot", "")),
                arguments["env_name"],
                arguments["env_kwargs"],
                names=json.loads(about.get("names", "{}")),
            )
            for number in range(len(data)):
                demo = data[f"demo_{number}"]
                columns = {
                    str(each.attrs.get(_COLUMN, _OBSERVED + name)): each[:, 0] if each.attrs.get(_LONE) else each[()]
                    for name, each in demo["obs"].items()
                }
                columns[ACTION], columns[REWARD] = demo["actions"][()], demo["rewards"][()]
                columns[DONE] = demo["dones"][()].astype(np.bool_)
                columns[SUCCESS] = demo["successes" if "successes" in demo else "dones"][()].astype(np.bool_)
                seed = demo.attrs.get("seed")
                drawn = json.loads(demo.attrs.get("randomization", "{}"))
                dataset.episodes.append(Episode(columns, None if seed is None else int(seed), drawn))
    except (OSError, KeyError, ValueError) as problem:
        raise DatasetError(f"{file}: {problem!r}") from problem
    return dataset
