"""Screenshots and films of a window by keys, and the choice of its camera."""

import shutil
import subprocess
import time

import pytest
import worlds
import x11
from program import drawn, still

FRONT, SIDE = (1.0, 0.0, ""), (0.1, 1.1, "")
Picture = pytest.importorskip("PIL.Image", reason="no pillow")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Where the panel's settings say that pictures go."""
    settings = tmp_path / "config/ambf"
    settings.mkdir(parents=True)
    pictures = tmp_path / "my pictures"
    pictures.mkdir()
    (settings / "panel.conf").write_text(f"pictures {pictures}\n")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    return pictures


def test_control_s_takes_a_screenshot_of_that_window_without_labels(server, user, start, tmp_path, folder):
    simulator = start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT, "two": SIDE}), "-l", "0")
    for number in (1, 2):
        user.window(number)
        drawn(user, number)
    shown = user.picture_of(2)
    user.key("s", "Control_L")
    x11.eventually(lambda: list(folder.glob("ambf_*.png")), 30.0, simulator.log)
    simulator.says(".png: ")
    picture = Picture.open(next(folder.glob("*.png")))
    width, height = user.place(2)[2:]
    assert picture.size == (width, height)
    pixels = picture.convert("RGB")
    away = 0
    for y in range(height // 5, height // 2, 3):
        for x in range(0, width, 3):
            blue, green, red = shown[4 * (y * width + x) : 4 * (y * width + x) + 3]
            away += max(abs(a - b) for a, b in zip(pixels.getpixel((x, y)), (red, green, blue), strict=True)) > 40
    assert away < 0.05 * (height * 3 // 10 // 3) * (width // 3), "the picture that window 2 shows"


def begin_film(user, folder):
    user.key("s", "Control_L", "Shift_L")
    x11.eventually(lambda: list(folder.glob("ambf_*")), 30.0, "a film that has begun")


@pytest.mark.alone  # pictures in time
def test_control_shift_s_films(server, user, start, tmp_path, folder):
    simulator = start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT}), "-l", "0")
    user.window()
    drawn(user)
    begin_film(user, folder)
    time.sleep(3.0)
    user.key("s", "Control_L", "Shift_L")
    simulator.says(" pictures, 30 a second")
    films = list(folder.glob("ambf_*"))
    assert len(films) == 1
    if shutil.which("ffprobe") is None:
        pytest.skip("no ffprobe: the film itself is not looked at")
    ask = "-v error -count_frames -of csv=p=0 -show_entries stream=width,height,r_frame_rate,nb_read_frames"
    told = subprocess.run(["ffprobe", *ask.split(), films[0]], capture_output=True, text=True, check=True)
    width, height, rate, count = told.stdout.strip().split(",")
    assert (int(width) // 2, int(height) // 2) == tuple((each + 1) // 2 for each in user.place(1)[2:])
    assert rate == "30/1"
    assert 30 < int(count) < 300, "about three seconds"


@pytest.mark.alone  # pictures in time
def test_closing_the_window_completes_its_film(server, user, start, tmp_path, folder):
    simulator = start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT}), "-l", "0")
    window = user.window()
    drawn(user)
    begin_film(user, folder)
    time.sleep(2.0)
    user.ask_to_close(window)
    assert simulator.ends(60.0) == 0
    assert " pictures, 30 a second" in simulator.log()


def test_control_tab_looks_through_the_next_camera(server, user, start, tmp_path):
    cameras = {"one": FRONT, "unseen": (0.1, 1.1, "visible: false")}
    start(server.name, "--launch_file", worlds.write(tmp_path, cameras), "-l", "0")
    user.window()
    drawn(user)
    user.key("u")  # no labels: they show the time
    user.key("p", "Control_L")
    front = still(lambda: user.picture_of(1))
    user.key("Tab", "Control_L")
    x11.eventually(lambda: user.picture_of(1) != front, 20.0, "the other camera's view")
    user.key("Tab", "Control_L")  # the window's own view begins where that one was
    time.sleep(1.0)
    assert user.picture_of(1) != front
    assert set(user.windows()) == {1}
    user.key("Tab", "Control_L")
    x11.eventually(lambda: user.picture_of(1) == front, 20.0, "the first camera again")
