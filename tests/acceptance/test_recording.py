"""--screenshot and --video: pictures of a run without a display, exact in time."""

import os
import re
import shutil
import subprocess

import numpy as np
import pytest
import scenes
from harness import SIMULATOR
from PIL import Image as Picture


def run(*arguments, path=None):
    env = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
    if path is not None:
        env["PATH"] = path
    return subprocess.run(
        [str(SIMULATOR), "--no_ros", *map(str, arguments)], capture_output=True, text=True, timeout=120, env=env
    )


def falling(tmp_path):
    """The camera looks along -x; a box falls freely from 0.5 m above the middle of the picture."""
    launch = scenes.write(tmp_path, scenes.model({"Box": scenes.box("Box", 1.0, (0.0, 0.3, 0.6), 0.2)}))
    world = scenes.WORLD.replace("gravity: {x: 0.0, y: 0.0, z: 0.0}", "gravity: {x: 0.0, y: 0.0, z: -2.0}")
    world = world.replace("location: {x: 3.0, y: 0.0, z: 1.0}", "location: {x: 3.0, y: 0.0, z: 0.0}")
    (tmp_path / "world.yaml").write_text(world)
    return launch


def height_of_box(array, focal):
    """In metres, from a picture of `falling`."""
    sky = array[:, :5, :].astype(int).mean(axis=1, keepdims=True)
    rows, _ = np.nonzero(np.abs(array.astype(int) - sky).sum(axis=2) > 60)
    assert len(rows) > 50
    # Its front face, 2.9 m away, is what is widest; top and bottom of it average out near the middle of the picture.
    return -((rows.min() + rows.max()) / 2 - (array.shape[0] - 1) / 2) / focal * 2.9


def test_screenshots_of_chosen_cameras_sizes_and_kinds(tmp_path):
    launch = scenes.write(tmp_path)
    first, second = tmp_path / "a picture.png", tmp_path / "b.jpg"
    result = run(
        "--launch_file", launch, "-l", "0", "--screenshot", first, f"{second}:eye", "--picture_size", "320x200"
    )
    assert result.returncode == 0, result
    a, b = (np.asarray(Picture.open(each).convert("RGB")).astype(int) for each in (first, second))
    assert a.shape == b.shape == (200, 320, 3)
    assert Picture.open(second).format == "JPEG"
    assert np.abs(a - b).mean() < 3.0
    assert a.std() > 10.0, "there is something in it"


@pytest.mark.parametrize("backend", ["osmesa", "egl"])
def test_both_ways_to_draw_without_a_display(tmp_path, backend):
    launch = scenes.write(tmp_path)
    file = tmp_path / "a.png"
    result = run("--launch_file", launch, "-l", "0", "--screenshot", file, "--offscreen", backend, "--at", "0")
    assert result.returncode == 0, result
    assert np.asarray(Picture.open(file)).shape[:2] == (720, 1280)


def test_a_broken_egl_is_said_in_a_line_and_the_processor_draws(tmp_path, monkeypatch):
    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_DIRS", str(tmp_path))  # where no driver is
    file = tmp_path / "a.png"
    result = run(
        "--launch_file", scenes.write(tmp_path), "-l", "0", "--screenshot", file, "--offscreen", "egl", "--at", "0"
    )
    assert result.returncode == 0, result
    assert np.asarray(Picture.open(file).convert("RGB")).std() > 10.0
    assert (result.stdout + result.stderr).count("the processor draws by OSMesa instead") == 1


def test_a_screenshot_shows_the_very_moment_that_was_asked_for(tmp_path):
    launch = falling(tmp_path)
    focal = 480 / 2 / np.tan(0.35)
    for at in (0.0, 0.7):
        file = tmp_path / f"at{at}.png"
        result = run("--launch_file", launch, "-l", "0", "--screenshot", file, "--at", at, "--picture_size", "640x480")
        assert result.returncode == 0, result
        assert re.search(rf"at {at:.3f} s", result.stdout + result.stderr)
        height = height_of_box(np.asarray(Picture.open(file).convert("RGB")), focal)
        assert abs(height - (0.6 - 0.5 * 2.0 * at**2)) < 0.02, at


def test_of_a_stereo_camera_both_eyes_are_taken_side_by_side(tmp_path):
    launch = falling(tmp_path)
    with open(tmp_path / "world.yaml", "a") as world:  # the camera's block is the last
        world.write("  stereo: {mode: PASSIVE_LEFT_RIGHT, eye separation: 0.1, focal length: 5.0}\n")
    file = tmp_path / "a.png"
    result = run("--launch_file", launch, "-l", "0", "--screenshot", file, "--at", "0", "--picture_size", "641x480")
    assert result.returncode == 0, result
    both = np.asarray(Picture.open(file).convert("RGB")).astype(int)
    assert both.shape == (480, 641, 3)
    focal = 480 / 2 / np.tan(0.35)
    places = []
    for eye in (both[:, :320], both[:, -320:]):
        sky = eye[:, :5].mean(axis=1, keepdims=True)
        _, columns = np.nonzero(np.abs(eye - sky).sum(axis=2) > 60)
        places.append((columns.min() + columns.max()) / 2)
    # Its front face, 2.9 m away, is nearer than where both eyes see the same: to the right for the left eye.
    assert abs((places[0] - places[1]) - focal * 0.1 * (1 / 2.9 - 1 / 5.0)) < 1.5


def test_what_is_wrong_is_said_and_fails(tmp_path):
    launch = scenes.write(tmp_path)
    result = run("--launch_file", launch, "-l", "0", "--screenshot", f"{tmp_path}/a.png:nobody")
    assert result.returncode == 1
    assert "nobody" in result.stdout + result.stderr and "/ambf/env/cameras/eye" in result.stdout + result.stderr
    result = run("--launch_file", launch, "-l", "0", "--screenshot", f"{tmp_path}/no/such/folder/a.png")
    assert result.returncode == 1
    assert "No such file" in result.stdout + result.stderr


def flags(**values):
    return [word for name, value in values.items() for word in (f"--{name}", value)]


@pytest.fixture
def stand_in(tmp_path):
    """stand_in(script): a folder with nothing in it but that script, as ffmpeg; nothing at all without a script."""

    def make(script=None):
        tools = tmp_path / "tools"
        tools.mkdir()
        if script is not None:
            (tools / "ffmpeg").write_text(f"#!/bin/sh\n{script}\n")
            (tools / "ffmpeg").chmod(0o755)
        return tools

    return make


def test_without_ffmpeg_a_video_is_numbered_pictures_exact_in_time(tmp_path, stand_in):
    launch = falling(tmp_path)
    video = flags(video=tmp_path / "fall.mp4", fps=10, seconds=1, at=0, picture_size="320x240")
    result = run("--launch_file", launch, "-l", "0", *video, path=str(stand_in()))
    assert result.returncode == 0, result
    files = sorted((tmp_path / "fall").glob("*.png"))
    assert [file.name for file in files] == [f"{i:06d}.png" for i in range(1, 11)]
    focal = 240 / 2 / np.tan(0.35)
    for i, file in enumerate(files):
        height = height_of_box(np.asarray(Picture.open(file).convert("RGB")), focal)
        assert abs(height - (0.6 - 0.5 * 2.0 * (i / 10) ** 2)) < 0.03, i


def test_ffmpeg_gets_every_picture(tmp_path, stand_in):
    """A stand-in for ffmpeg that keeps what it is told."""
    launch = scenes.write(tmp_path)
    tools = stand_in('echo "$@" > "$0.words"\nexec /bin/cat > "$0.pictures"')
    video = flags(video=f"{tmp_path}/v.mkv:eye", fps=25, seconds=0.2, picture_size="64x48", at=0)
    result = run("--launch_file", launch, "-l", "0", *video, path=str(tools))
    assert result.returncode == 0, result
    words = (tools / "ffmpeg.words").read_text().split()
    assert words[words.index("-video_size") + 1] == "64x48"
    assert words[words.index("-framerate") + 1] == "25"
    assert words[-1] == f"{tmp_path}/v.mkv"
    assert (tools / "ffmpeg.pictures").stat().st_size == 5 * 64 * 48 * 3


def test_an_ffmpeg_that_fails_is_told(tmp_path, stand_in):
    video = flags(video=tmp_path / "v.mp4", at=0)
    result = run("--launch_file", scenes.write(tmp_path), "-l", "0", *video, path=str(stand_in("exit 1")))
    assert result.returncode == 1
    assert "ffmpeg" in result.stdout + result.stderr


def test_an_ffmpeg_that_is_killed_in_the_middle_is_told(tmp_path, stand_in):
    tools = stand_in("/usr/bin/head -c 100000 > /dev/null\nkill -9 $$")
    video = flags(video=tmp_path / "v.mp4", at=0, seconds=2, picture_size="320x240")
    result = run("--launch_file", scenes.write(tmp_path), "-l", "0", *video, path=str(tools))
    assert result.returncode == 1
    assert "ffmpeg takes no more pictures" in result.stdout + result.stderr


def test_a_video_by_the_real_ffmpeg_has_the_size_rate_and_pictures_asked_for(tmp_path):
    if shutil.which("ffmpeg") is None or shutil.which("ffprobe") is None:
        pytest.skip("ffmpeg is not installed: videos are checked with stand-ins only")
    launch = falling(tmp_path)
    file = tmp_path / "fall.mp4"
    video = flags(video=file, fps=20, seconds=1, at=0, picture_size="321x240")
    result = run("--launch_file", launch, "-l", "0", *video)
    assert result.returncode == 0, result
    ask = "-v error -count_frames -of csv=p=0 -show_entries stream=width,height,r_frame_rate,nb_read_frames"
    told = subprocess.run(["ffprobe", *ask.split(), file], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "322,240,20/1,20", "widths are padded to even ones"
    # The last picture is that of 0.95 s.
    last = tmp_path / "last.png"
    cut = ["ffmpeg", "-v", "error", "-sseof", "-0.05", "-i", file, "-update", "1", "-y", last]
    subprocess.run(cut, check=True, timeout=60)
    height = height_of_box(np.asarray(Picture.open(last).convert("RGB"))[:, :320], 240 / 2 / np.tan(0.35))
    assert abs(height - (0.6 - 0.5 * 2.0 * 0.95**2)) < 0.04


def test_with_run_for_the_simulation_keeps_its_pace(tmp_path):
    launch = scenes.write(tmp_path)
    file = tmp_path / "a.png"
    result = run(
        "--launch_file", launch, "-l", "0", "--screenshot", file, "--at", "0.5", "--run_for", "2.5", "-g", "false"
    )
    assert result.returncode == 0, result
    assert file.exists()
    assert "real-time factor" in result.stdout


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--screenshot", "a.bmp"], "FILE.png"),
        (["--video", "a.txt"], "--video"),
        (["--video", "a.mp4", "--fps", "0"], "--fps"),
        (["--video", "a.mp4", "--seconds", "-1"], "--seconds"),
        (["--fps", "10"], "--video"),
        (["--at", "1"], "--screenshot"),
        (["--screenshot", "a.png", "--at", "-1"], "--at"),
        (["--screenshot", "a.png", "--picture_size", "640"], "--picture_size"),
        (["--screenshot", "a.png", "--picture_size", "640x99999"], "8192"),
        (["--offscreen", "glx"], "osmesa"),
    ],
)
def test_bad_picture_flags_are_refused_clearly(arguments, told):
    result = run(*arguments)
    assert result.returncode == 2, result
    assert told in result.stderr
