"""Pictures of data sets as videos, in both of LeRobot's formats."""

import json
import os
import shutil

import numpy as np
import pytest

for module in ("h5py", "pandas", "pyarrow"):
    pytest.importorskip(module)
import pyarrow.parquet as parquet  # noqa: E402
from ambf_tools import dataset  # noqa: E402
from ambf_tools.dataset import lerobot_videos, video  # noqa: E402

pytestmark = pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not installed")
VIEW, HEIGHT, WIDTH, ROWS = "observation.images.view", 48, 64, (30, 25)


def episode(rows, shift):
    """A bright square that wanders over a slope of colours."""
    across = np.linspace(0, 200, WIDTH)
    shown = np.empty((rows, HEIGHT, WIDTH, 3), np.uint8)
    shown[...] = np.stack([across, across[::-1], np.full(WIDTH, 60.0 + shift)], axis=1)
    for row in range(rows):
        shown[row, 10:26, 2 * row % 48 : 2 * row % 48 + 16] = 250
    columns = {"observation.state": np.full((rows, 2), shift, np.float32), "action": np.zeros((rows, 1), np.float32)}
    columns |= {VIEW: shown, "next.reward": np.zeros(rows, np.float32), "next.success": np.ones(rows, bool)}
    return dataset.Episode(columns | {"next.done": np.arange(rows) == rows - 1}, seed=shift)


@pytest.fixture
def made():
    parts = [episode(rows, 10 * number) for number, rows in enumerate(ROWS)]
    return dataset.Dataset(25, "a task", "psm", "ambf/PsmReach-v0", episodes=parts)


@pytest.fixture(params=["2.1", "3.0"])
def version(request):
    return request.param


@pytest.fixture
def written(made, version, tmp_path):
    dataset.write(made, tmp_path / "made", f"lerobot-{version}", video=True)
    return tmp_path / "made"


def test_they_are_where_the_formats_have_them_and_come_back(made, written, version):
    assert dataset.check(written) == []
    files = sorted(each.relative_to(written).as_posix() for each in written.glob("videos/**/*.mp4"))
    if version == "2.1":
        assert files == [f"videos/chunk-000/{VIEW}/episode_00000{number}.mp4" for number in (0, 1)]
    else:
        assert files == [f"videos/{VIEW}/chunk-000/file-000.mp4"]
        rows = parquet.read_table(written / "meta/episodes").to_pylist()
        times = [(row[f"videos/{VIEW}/from_timestamp"], row[f"videos/{VIEW}/to_timestamp"]) for row in rows]
        assert times == [(0.0, 1.2), (1.2, 2.2)]
    info = json.loads((written / "meta/info.json").read_text())
    assert info["features"][VIEW]["dtype"] == "video" and info["video_path"] == lerobot_videos.PATHS[version]
    assert info["features"][VIEW]["info"]["video.codec"] == "h264" and info["features"][VIEW]["shape"] == [48, 64, 3]
    assert all(VIEW not in parquet.read_schema(file).names for file in written.glob("data/**/*.parquet"))
    read = dataset.read(written)
    for one, other in zip(made.episodes, read.episodes, strict=True):
        for name in one.columns:
            difference = np.abs(one.columns[name].astype(float) - other.columns[name])
            # Its own picture in each row: a square two pixels from there differs by far more.
            assert difference.mean() < 3 if name == VIEW else difference.max() == 0, name
    levels = {each.message.split("'")[0]: each.level for each in dataset.check(written, open_h=True)}
    assert "there is no folder videos" not in levels and "there is no meta/README.md" not in levels


def test_what_is_wrong_with_them_is_found(made, written, version, tmp_path):
    place = sorted(written.glob("videos/**/*.mp4"))[0]
    video.encode(iter(made.episodes[1].columns[VIEW][:9]), place, WIDTH, HEIGHT, 25)
    assert f"has 9 pictures for {ROWS[0] if version == '2.1' else sum(ROWS)} rows" in str(dataset.check(written))
    with pytest.raises(dataset.DatasetError, match="too few pictures for episode 0"):
        dataset.read(written)
    place.write_bytes(b"no video")
    assert "cannot be read" in str(dataset.check(written))
    place.unlink()
    assert "there is no" in str(dataset.check(written))


def test_videos_that_nothing_can_hold_are_refused(made, tmp_path, monkeypatch):
    with pytest.raises(dataset.DatasetError, match="hold no videos"):
        dataset.write(made, tmp_path / "a", "robomimic", video=True)
    for each in made.episodes:
        each.columns[VIEW] = each.columns[VIEW][:, :, :63]
    with pytest.raises(dataset.DatasetError, match="even width and height, not 63 x 48"):
        dataset.write(made, tmp_path / "b", "lerobot-2.1", video=True)
    assert not (tmp_path / "b").exists(), "what failed leaves no folder"
    (tmp_path / "ffmpeg").write_text("#!/bin/sh\necho no such codec >&2\nexit 1\n")
    (tmp_path / "ffmpeg").chmod(0o755)
    with monkeypatch.context() as patch, pytest.raises(dataset.DatasetError, match="did not write .* no such codec"):
        patch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
        video.encode(np.zeros((9, 16, 16, 3), np.uint8), tmp_path / "x.mp4", 16, 16, 25)
    for each in made.episodes:
        del each.columns[VIEW]
    with pytest.raises(dataset.DatasetError, match="there are no pictures"):
        dataset.write(made, tmp_path / "c", "lerobot-2.1", video=True)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(dataset.DatasetError, match=r"ffprobe, which is not installed"):
        (tmp_path / "x.mp4").write_bytes(b"")
        video.describe(tmp_path / "x.mp4")
