"""Data sets of ambf_tools.dataset read by LeRobot and robomimic themselves.

    ./dev shell -- python tests/soak/read_by_others.py write FOLDER
    OTHER/bin/python tests/soak/read_by_others.py read FOLDER

`write` records three episodes of PsmReach, without and with pictures, and with LeRobot's as videos, in each format, and
what was recorded as plain arrays. `read` runs in an environment that has lerobot 0.3 (reads 2.1), lerobot 0.4 (3.0),
robomimic or only h5py, but nothing of AMBF: it compares every row with those arrays, prints what it read, and ends with
1 at the first difference.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import importlib.util
import json
import os
from pathlib import Path
from typing import Any

import numpy as np

EPISODES = 3
FILMED = "filmed"  # pictures of LeRobot's formats are videos
KINDS: dict[str, dict[str, Any]] = {"plain": {}, "seen": {"observation": "both"}, FILMED: {"observation": "both"}}
BATCH = 32
_OBSERVED = "observation."


def write(folder: Path) -> None:
    """Makes the data sets in a folder that does not exist yet."""
    from ambf_tools import dataset

    folder.mkdir(parents=True)
    for kind, options in KINDS.items():
        recorded = dataset.record("ambf/PsmReach-v0", EPISODES, **options)
        for form in dataset.FORMATS:
            film = kind == FILMED and form != "robomimic"
            dataset.write(recorded, folder / f"{kind}-{form}", form, video=film)
        columns = {name: [each.columns[name] for each in recorded.episodes] for name in recorded.episodes[0].columns}
        np.savez(folder / f"{kind}.npz", **{name: np.stack(each) for name, each in columns.items()})
        (folder / f"{kind}.json").write_text(json.dumps({"fps": recorded.fps, "task": recorded.task}))


def same(found: Any, right: Any, what: str) -> None:
    """Values and type, to the bit."""
    found, right = np.asarray(found), np.asarray(right)
    assert found.shape == right.shape, f"{what}: the shape is {found.shape}, not {right.shape}"
    assert np.array_equal(found, right), f"{what}: {found} is not {right}"


def read_lerobot(folder: Path, kind: str, version: str) -> None:
    """All rows by index, statistics, and batches of a torch DataLoader."""
    import torch
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    rows, about = np.load(folder / f"{kind}.npz"), json.loads((folder / f"{kind}.json").read_text())
    data = LeRobotDataset(f"ambf/{kind}", root=folder / f"{kind}-lerobot-{version}")  # checks versions, timestamps
    length = rows["action"].shape[1]
    assert data.num_episodes == EPISODES and data.num_frames == len(data) == EPISODES * length
    assert data.fps == about["fps"] and set(rows.files) < set(data.meta.features)

    def compare(item: dict[str, Any], episode: int, frame: int) -> None:
        for name in rows.files:
            found, right = item[name].numpy(), rows[name][episode, frame]
            if right.ndim == 3:  # pictures come as (channels, height, width), from 0 to 1
                assert found.dtype == np.float32, name
                found = np.rint(found * 255).astype(np.uint8).transpose(1, 2, 0)
                if kind == FILMED:  # it loses some detail, but not the picture before or after
                    away = np.abs(found.astype(float) - right).mean()
                    assert away < 3, f"{name} of row {frame} of episode {episode} differs by {away} of 255"
                    continue
            same(found.reshape(right.shape), right, f"{name} of row {frame} of episode {episode}")
            assert found.dtype == right.dtype, f"{name} is {found.dtype}, not {right.dtype}"

    for index in range(len(data)):
        item = data[index]
        episode, frame = divmod(index, length)
        assert item["task"] == about["task"]
        assert (int(item["index"]), int(item["episode_index"]), int(item["frame_index"])) == (index, episode, frame)
        assert abs(float(item["timestamp"]) - frame / about["fps"]) < 1e-6
        compare(item, episode, frame)
    for name in rows.files:
        array = rows[name].reshape(len(data), *rows[name].shape[2:]).astype(np.float64)
        array = array.reshape(-1, 3).T[:, :, None, None] / 255 if array.ndim == 4 else array.reshape(len(data), -1)
        axis = 1 if array.ndim == 4 else 0
        for key, right in (("mean", array.mean(axis)), ("min", array.min(axis)), ("max", array.max(axis))):
            found = np.asarray(data.meta.stats[name][key], np.float64)
            assert found.shape == right.shape, f"{key} of {name}: the shape is {found.shape}, not {right.shape}"
            assert np.allclose(found, right, rtol=1e-5, atol=1e-6), f"{key} of {name}: {found} is not {right}"
    place = folder / f"{kind}-lerobot-{version}"
    part = LeRobotDataset(f"ambf/{kind}", root=place, episodes=[1])
    assert len(part) == length
    compare(part[7], 1, 7)
    pairs = LeRobotDataset(f"ambf/{kind}", root=place, delta_timestamps={"action": [0.0, 1 / about["fps"]]})
    same(pairs[length]["action"].numpy(), rows["action"][1, :2], "the first two actions of episode 1")
    same(pairs[length - 1]["action_is_pad"].numpy(), [False, True], "what follows the last action of episode 0")
    count = 0
    for batch in torch.utils.data.DataLoader(data, BATCH, shuffle=True, num_workers=0):
        count += len(batch["action"])
        for row in range(len(batch["action"])):
            numbers = int(batch["episode_index"][row]), int(batch["frame_index"][row])
            compare({name: batch[name][row] for name in rows.files}, *numbers)
    assert count == len(data)
    reader = f"lerobot {importlib.metadata.version('lerobot')}"
    print(f"{reader}, {kind} {version}: {EPISODES} episodes, {count} frames, {', '.join(data.meta.features)}")


def key(name: str) -> str:
    """Of an observation in robomimic's files."""
    return name.removeprefix(_OBSERVED).replace(".", "_")


def read_documented(folder: Path, kind: str) -> None:
    """Robomimic's layout by h5py alone."""
    import h5py

    rows = np.load(folder / f"{kind}.npz")
    with h5py.File(folder / f"{kind}-robomimic", "r") as file:
        arguments = json.loads(file["data"].attrs["env_args"])
        assert arguments["env_name"] == "ambf/PsmReach-v0" and isinstance(arguments["env_kwargs"], dict)
        assert file["data"].attrs["total"] == rows["action"].shape[0] * rows["action"].shape[1]
        assert sorted(file["data"]) == [f"demo_{number}" for number in range(EPISODES)]
        names = {each.decode() for mask in file["mask"].values() for each in mask[()]}
        assert names == set(file["data"]), names
        for number in range(EPISODES):
            demo = file[f"data/demo_{number}"]
            assert demo.attrs["num_samples"] == rows["action"].shape[1]
            layout = {"actions": "action", "rewards": "next.reward", "dones": "next.done"}
            layout |= {"states": "observation.state"}
            layout |= {f"obs/{key(name)}": name for name in rows.files if name.startswith(_OBSERVED)}
            for name, ours in layout.items():
                right = rows[ours][number]
                right = right[:, None] if name.startswith("obs/") and right.ndim == 1 else right
                same(demo[name][()], right, f"demo_{number}/{name}")
            assert np.abs(demo["actions"][()]).max() <= 1
    print(f"h5py {h5py.__version__}, {kind}: {EPISODES} episodes, {', '.join(sorted(layout))}")


def read_robomimic(folder: Path, kind: str) -> None:
    """By robomimic's own functions and its data set for training."""
    import robomimic
    import robomimic.utils.env_utils as env_utils
    import robomimic.utils.file_utils as file_utils
    import robomimic.utils.obs_utils as obs_utils
    import torch
    from robomimic.utils.dataset import SequenceDataset

    rows, file = np.load(folder / f"{kind}.npz"), str(folder / f"{kind}-robomimic")
    keys = {key(name): name for name in rows.files if name.startswith(_OBSERVED)}
    pictures = [name for name in keys if name.startswith("images_")]
    numbers = [name for name in keys if name not in pictures]
    obs_utils.initialize_obs_utils_with_obs_specs({"obs": {"low_dim": numbers, "rgb": pictures}})
    about = file_utils.get_env_metadata_from_dataset(file)
    assert env_utils.is_robosuite_env(about) is False and about["env_name"] == "ambf/PsmReach-v0"
    shapes = file_utils.get_shape_metadata_from_dataset(file, all_obs_keys=list(keys))
    assert shapes["ac_dim"] == rows["action"].shape[2]
    length = rows["action"].shape[1]
    following = SequenceDataset(
        hdf5_path=file,
        obs_keys=tuple(keys),
        dataset_keys=("actions", "rewards", "dones"),
        seq_length=1,
        frame_stack=1,
        load_next_obs=True,
        hdf5_cache_mode="all",
    )
    count = 0
    for batch in torch.utils.data.DataLoader(following, BATCH):
        for row in range(len(batch["actions"])):
            episode, frame = divmod(count, length)
            same(batch["actions"][row, 0], rows["action"][episode, frame], "actions")
            same(batch["rewards"][row, 0], rows["next.reward"][episode, frame], "rewards")
            for name, ours in keys.items():
                right = rows[ours][episode]
                right = np.concatenate([right, right[-1:]]).reshape(length + 1, *(right.shape[1:] or (1,)))
                same(batch["obs"][name][row, 0], right[frame], name)
                same(batch["next_obs"][name][row, 0], right[frame + 1], f"next {name}")
            count += 1
    assert count == EPISODES * length
    learn_robomimic(following, shapes, numbers, pictures)
    print(f"robomimic {robomimic.__version__}, {kind}: {EPISODES} episodes, {count} rows, {', '.join(keys)}")


def learn_robomimic(data: Any, shapes: dict[str, Any], numbers: list[str], pictures: list[str]) -> None:
    """Some steps of robomimic's behaviour cloning and TD3-BC, which bootstraps from next_obs."""
    import robomimic.utils.obs_utils as obs_utils
    import torch
    from robomimic.algo import algo_factory
    from robomimic.config import config_factory

    for name in ("bc", "td3_bc"):
        config = config_factory(name)
        with config.unlocked():
            config.observation.modalities.obs.low_dim = numbers
            config.observation.modalities.obs.rgb = pictures
        obs_utils.initialize_obs_utils_with_config(config)
        model = algo_factory(name, config, shapes["all_shapes"], shapes["ac_dim"], torch.device("cpu"))
        model.set_train()
        for _, batch in zip(range(2), torch.utils.data.DataLoader(data, BATCH, shuffle=True), strict=False):
            ready = model.postprocess_batch_for_training(model.process_batch_for_training(batch), None)
            losses = model.train_on_batch(ready, epoch=0, validate=False)
        assert losses


def read(folder: Path) -> None:
    """By all that this environment has."""
    os.environ["HF_HUB_OFFLINE"] = "1"  # else a data set that lerobot refuses is looked for elsewhere
    has = {name: importlib.util.find_spec(name) is not None for name in ("lerobot", "h5py", "robomimic")}
    assert any(has.values()), "there is neither lerobot nor h5py nor robomimic"
    for kind in KINDS:
        if has["lerobot"]:
            old = importlib.metadata.version("lerobot").startswith("0.3.")
            read_lerobot(folder, kind, "2.1" if old else "3.0")
        if has["h5py"]:
            read_documented(folder, kind)
        if has["robomimic"]:
            read_robomimic(folder, kind)


def main() -> None:
    """Of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("write", "read"))
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    (write if arguments.what == "write" else read)(arguments.folder)


if __name__ == "__main__":
    main()
