"""What a window shows and what the program draws without one is the same picture."""

import os
import re
import subprocess

import numpy as np
import pytest
import worlds
from harness import SLOWNESS
from program import ROOT, SIMULATOR

x11 = pytest.importorskip("x11", reason="no python3-xlib")
Picture = pytest.importorskip("PIL.Image", reason="no pillow")

SCENE = ("-l", "1")


@pytest.mark.skipif(SLOWNESS > 1.0, reason="a window this slow gives up more of its quality than is compared here")
@pytest.mark.parametrize("scene", ["its camera", "no camera"])
def test_a_window_and_a_screenshot_show_the_same(server, user, start, tmp_path, scene):  # noqa: F811
    arguments = SCENE
    if (
        scene == "no camera"
    ):  # both frame what there is; along the camera of the original's there would be little to see
        arguments = ("--launch_file", worlds.write(tmp_path, {}), "-l", "0")
    simulator = start(server.name, *arguments)
    simulator.says("loaded '")
    window = user.window()
    geometry = window.get_geometry()
    place = window.translate_coords(user.root, 0, 0)
    x, y = abs(place.x), abs(place.y)
    assert (geometry.width, geometry.height) <= x11.SCREEN
    file = tmp_path / "picture.png"
    size = f"{geometry.width}x{geometry.height}"
    subprocess.run(
        [SIMULATOR, "--no_ros", *arguments, "--screenshot", file, "--picture_size", size],
        cwd=ROOT,
        env={name: value for name, value in os.environ.items() if name != "DISPLAY"},
        check=True,
        timeout=120,
    )
    alone = np.asarray(Picture.open(file).convert("RGB")).astype(int)

    def agree():
        shown = np.frombuffer(user.picture(), np.uint8).reshape(x11.SCREEN[1], x11.SCREEN[0], 4)
        shown = shown[y : y + geometry.height, x : x + geometry.width, 2::-1].astype(int)
        # Labels are at the edges of the window.
        part = np.s_[geometry.height // 5 : -geometry.height // 5, geometry.width // 5 : -geometry.width // 5]
        away = np.abs(shown[part] - alone[part]).max(axis=2)
        # A window that the processor draws may have given up smooth edges and soft shadows.
        return (away > 40).mean() < 0.03 and alone[part].std() > 15.0

    x11.eventually(agree, 60.0, lambda: f"the same picture; {re.findall('window: .*', simulator.log())}")
