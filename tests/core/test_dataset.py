"""Data sets: what is recorded comes back from each format, actions replay it, and planted faults are found."""

import io
import json

import numpy as np
import pytest

for module in ("gymnasium", "h5py", "pandas", "pyarrow"):
    pytest.importorskip(module)
import h5py  # noqa: E402
import pyarrow as pa  # noqa: E402
import pyarrow.parquet as parquet  # noqa: E402
from ambf_tools import dataset  # noqa: E402
from ambf_tools.cli.main import main  # noqa: E402

RANGES = {"joint1": {"damping": [0.5, 2.0]}}


@pytest.fixture(scope="module")
def recorded():
    return dataset.record("ambf/Arm7Reach-v0", 3, seed=5, policy="random", randomization=RANGES)


@pytest.fixture
def written(recorded, tmp_path):
    places = {}
    for format in dataset.FORMATS:
        places[format] = tmp_path / format
        dataset.write(recorded, places[format], format)
    return places


def assert_equal(a, b):
    assert (a.fps, a.task, a.robot, a.environment, a.options) == (b.fps, b.task, b.robot, b.environment, b.options)
    for one, other in zip(a.episodes, b.episodes, strict=True):
        assert (one.seed, one.randomization) == (other.seed, other.randomization)
        assert one.columns.keys() == other.columns.keys()
        for name, array in one.columns.items():
            assert array.dtype == other.columns[name].dtype and (array == other.columns[name]).all(), name


def test_each_format_gives_back_what_was_recorded(recorded, written, tmp_path):
    for format, place in written.items():
        assert dataset.check(place) == [], format
        assert_equal(dataset.read(place), recorded)
        for other in dataset.FORMATS:
            target = tmp_path / f"{format} as {other}"
            dataset.write(dataset.read(place), target, other)
            assert_equal(dataset.read(target), recorded)
    with pytest.raises(dataset.DatasetError, match="exists"):
        dataset.write(recorded, written["robomimic"], "robomimic")


def test_layouts_are_the_documented_ones(recorded, written):
    v21, v30 = written["lerobot-2.1"], written["lerobot-3.0"]
    table = parquet.read_table(v21 / "data/chunk-000/episode_000001.parquet")
    assert table["index"].to_pylist() == list(range(50, 100)) and table["timestamp"][3].as_py() == np.float32(0.06)
    assert table.schema.field("action").type == pa.list_(pa.float32(), 7)
    lines = (v21 / "meta/episodes.jsonl").read_text().splitlines()
    assert json.loads(lines[2]) == {"episode_index": 2, "tasks": [recorded.task], "length": 50}
    info = json.loads((v30 / "meta/info.json").read_text())
    assert info["codebase_version"] == "v3.0" and info["features"]["timestamp"]["dtype"] == "float32"
    episodes = parquet.read_table(v30 / "meta/episodes/chunk-000/file-000.parquet").to_pylist()
    assert (episodes[1]["dataset_from_index"], episodes[1]["dataset_to_index"]) == (50, 100)
    assert len(episodes[1]["stats/action/q50"]) == 7
    assert parquet.read_table(v30 / "meta/tasks.parquet").to_pandas().index.name == "task"
    assert parquet.ParquetFile(v30 / "data/chunk-000/file-000.parquet").num_row_groups == 3
    with h5py.File(written["robomimic"]) as file:
        assert file["data"].attrs["total"] == 150 and file["data/demo_2"].attrs["num_samples"] == 50
        assert file["data/demo_0/actions"].shape == (50, 7) and "obs/state" in file["data/demo_0"]
        assert list(file["mask/failure"]) == [b"demo_0", b"demo_1", b"demo_2"]
        assert json.loads(file["data"].attrs["env_args"])["type"] == 2  # robomimic reads this, documents env_type
        shown, after = file["data/demo_1/obs/state"][()], file["data/demo_1/next_obs/state"][()]
        assert (after[:-1] == shown[1:]).all() and (after[-1] == shown[-1]).all()
        assert file["data/demo_1/obs/sim_step"].shape == (50, 1)  # its algorithms refuse (50,)


def test_actions_replay_the_episodes(recorded):
    assert dataset.replay(recorded, 1)
    recorded.episodes[1].columns["action"][3] *= -1
    try:
        assert not dataset.replay(recorded, 1)
    finally:
        recorded.episodes[1].columns["action"][3] *= -1


def change_table(name, change):
    def plant(root):
        file = root / "data/chunk-000/episode_000001.parquet"
        table = parquet.read_table(file)
        values = change(table[name].to_numpy().copy())
        parquet.write_table(table.set_column(table.column_names.index(name), name, pa.array(values)), file)

    return plant


def change_json(name, **values):
    def plant(root):
        file = root / "meta" / name
        first, *rest = file.read_text().splitlines() if name.endswith("l") else [file.read_text()]
        file.write_text("\n".join([json.dumps({**json.loads(first), **values}), *rest]))

    return plant


def set_to(value):
    def change(array):
        array[7] = value
        return array

    return change


@pytest.mark.parametrize(
    ("plant", "message"),
    [
        (change_json("info.json", total_frames=149), "total_frames is 149"),
        (change_json("info.json", codebase_version="v1.0"), "neither v2.1 nor v3.0"),
        (change_json("info.json", fps=25), "'timestamp' is not"),
        (change_json("episodes.jsonl", length=49), "the lengths of episodes"),
        (change_table("index", set_to(3)), "'index' does not run"),
        (change_table("episode_index", set_to(2)), "each in one piece"),
        (change_table("frame_index", set_to(9)), "'frame_index' does not count"),
        (change_table("task_index", set_to(4)), "names a task that does not exist"),
        (change_table("next.reward", set_to(np.nan)), "'next.reward' has values that are not finite"),
        (change_table("next.reward", set_to(-9)), "the statistics of 'next.reward'"),
        (lambda root: (root / "meta/tasks.jsonl").unlink(), "tasks.parquet"),
        (lambda root: (root / "data/chunk-000/episode_000002.parquet").write_bytes(b"PAR1"), "error"),
    ],
)
def test_planted_faults_are_found(written, plant, message):
    plant(written["lerobot-2.1"])
    found = dataset.check(written["lerobot-2.1"])
    assert any(message in str(each) and each.level == "error" for each in found), found


def test_faults_of_robomimic_files_are_found(written):
    place = written["robomimic"]
    with h5py.File(place, "a") as file:
        file["data"].attrs["total"] = 7
        file["data/demo_1/actions"][3, 2] = 1.5
        file["data/demo_0/obs/state"][0, 0] = np.inf
        file["data/demo_2/next_obs/state"][3, 0] += 1
        file["mask/train"] = np.array([b"demo_9"])
    messages = "\n".join(map(str, dataset.check(place)))
    parts = ["total is 7", "demo_1/actions are not within", "obs/state has values", "next_obs/state is not"]
    for part in (*parts, "names ['demo_9']"):
        assert part in messages


def test_the_command_line_records_converts_and_checks(tmp_path, capsys):
    made, other = str(tmp_path / "made"), str(tmp_path / "other.hdf5")
    assert main(["dataset", "record", "ambf/Arm7Reach-v0", made, "--episodes", "1"]) == 0
    assert "1 episode of ambf/Arm7Reach-v0, 1 successful, 50 rows at 50 a second" in capsys.readouterr().out
    assert main(["dataset", "convert", made, other, "--format", "robomimic"]) == 0
    assert main(["dataset", "info", other]) == 0
    assert main(["dataset", "check", made]) == 0 and "0 findings" in capsys.readouterr().out
    assert main(["dataset", "convert", made, other]) == 1
    assert main(["dataset", "check", made, "--open-h"]) == 1
    assert "there is no folder videos" in capsys.readouterr().out


def test_pictures_come_back_without_loss(tmp_path, capsys):
    """A PNG a row in LeRobot's columns, arrays in robomimic's; other readers of PNGs see the same."""
    made, pictures = tmp_path / "made", "observation.images.view"
    words = ["dataset", "record", "ambf/EcmReach-v0", str(made), "--episodes", "1", "--pictures", "40", "32"]
    assert main(words) == 0 and f"{pictures}: uint8 32x40x3" in capsys.readouterr().out
    recorded = dataset.read(made)
    shown = recorded.episodes[0].columns[pictures]
    assert shown.shape == (50, 32, 40, 3) and shown[0].std() > 1 and (shown[0] != shown[-1]).any()
    assert dataset.check(made) == [] and dataset.replay(recorded, 0)
    assert "no pictures" not in str(dataset.check(made, open_h=True))
    place = made / "data/chunk-000/episode_000000.parquet"
    for format in ("lerobot-3.0", "robomimic"):
        dataset.write(recorded, tmp_path / format, format)
        assert dataset.check(tmp_path / format) == []
        assert_equal(dataset.read(tmp_path / format), recorded)
    with h5py.File(tmp_path / "robomimic") as file:  # torch refuses names of modules with dots
        assert not any("." in name for part in ("obs", "next_obs") for name in file["data/demo_0"][part])
    schemas = [place, tmp_path / "lerobot-3.0/data/chunk-000/file-000.parquet"]
    for schema in map(parquet.read_schema, schemas):  # LeRobot 0.3 finds pictures by this alone
        described = json.loads(schema.metadata[b"huggingface"])["info"]["features"]
        assert list(described) == schema.names and described[pictures] == {"_type": "Image"}
    feature = json.loads((made / "meta/info.json").read_text())["features"][pictures]
    assert feature == {"dtype": "image", "shape": [32, 40, 3], "names": ["height", "width", "channels"]}
    stats = json.loads((made / "meta/episodes_stats.jsonl").read_text())["stats"][pictures]
    np.testing.assert_allclose(np.reshape(stats["mean"], 3), shown.reshape(-1, 3).mean(0) / 255)
    assert np.shape(stats["max"]) == (3, 1, 1) and stats["count"] == [50]
    table = parquet.read_table(place)
    column = table[pictures].to_pylist()
    image = pytest.importorskip("PIL.Image")
    assert (np.array(image.open(io.BytesIO(column[7]["bytes"]))) == shown[7]).all()
    column[7]["bytes"] = column[7]["bytes"][:-40]
    damaged = table.set_column(table.column_names.index(pictures), pictures, pa.array(column))
    parquet.write_table(damaged, place)
    assert "PNG" in str(dataset.check(made)[0])
    with pytest.raises(ValueError, match="'both'"):
        dataset.record("ambf/EcmReach-v0", 1, observation="pictures")
