"""The window of a world in a Python process: it shows what the program does, and the program is as without it."""

import json
import os
import subprocess
import sys
import time

import pytest
from program import drawn
from x11 import eventually

pytestmark = pytest.mark.alone  # graphics yields to all else
pytest.importorskip("_ambf_core")
pytest.importorskip("gymnasium")


@pytest.fixture
def python(tmp_path):
    """python(display, *arguments): a program of ours; its output is in .log."""
    started = []

    def make(display, *arguments):
        environment = {**os.environ, "PYTHONUNBUFFERED": "1", "DISPLAY": display or ""}
        environment.pop("WAYLAND_DISPLAY", None)
        log = tmp_path / f"log{len(started)}"
        with log.open("w") as out:
            started.append(subprocess.Popen([sys.executable, *arguments], env=environment, stdout=out, stderr=out))
        started[-1].log = log.read_text
        return started[-1]

    yield make
    for each in started:
        if each.poll() is None:
            each.kill()
            each.wait()


def test_episodes_are_watched_and_obey_keys(server, user, python):
    program = python(server.name, "-m", "ambf_gym.play", "ambf/Arm7Reach-v0", "--watch", "--episodes", "50")
    window = user.window()
    drawn(user)
    user.key("p", "Control_L")
    eventually(lambda: "paused" in user.title(), 40.0, "paused")
    user.key("r", "Alt_L")
    eventually(lambda: "ended in the window after" in program.log(), 40.0, "the episode ends")
    ended = program.log()
    for _ in range(60):  # an episode has 50 actions
        user.key("space")
        time.sleep(0.03)  # else they are one that repeats
    eventually(lambda: program.log() != ended, 40.0, "steps by hand end an episode")
    user.key("p", "Control_L")
    eventually(lambda: "paused" not in user.title(), 40.0, "running")
    user.ask_to_close(window)
    assert program.wait(timeout=20.0) == 0, program.log()
    assert "the window was closed" in program.log() and "Traceback" not in program.log()


SAME = """
import hashlib, json, sys
import numpy as np
import ambf_gym
from ambf_core import Window

def episode(**options):
    env = ambf_gym.make("ambf/PsmReach-v0", observation="both", picture_size=(64, 48), **options)
    digest = hashlib.sha256(env.reset(seed=3)[0]["picture"])
    while True:
        observation, *_, over, info = env.step(np.array([1, -1, 0.5], np.float32))
        digest.update(observation["picture"].tobytes() + observation["observation"].tobytes())
        if over:
            break
    found = [digest.hexdigest(), env.unwrapped.world.hash(), "window_reset" in info]
    if options:
        try:
            Window(env.unwrapped.world)
        except RuntimeError as error:
            found.append(str(error))
    env.close()
    return found

print(json.dumps([episode(render_mode="human"), episode()]))
"""


def test_pictures_and_states_are_as_without_it(server, user, python):
    """Though its view is turned meanwhile; pictures are drawn by OpenGL, too, in the same process."""
    program = python(server.name, "-c", SAME)
    user.window()
    drawn(user)
    left, top, width, height = user.place()
    while program.poll() is None:
        user.drag(1, (left + width // 2, top + height // 2), (left + width // 3, top + height // 3), steps=4)
    watched, alone = json.loads(program.log().splitlines()[-1])
    assert watched[:3] == alone and "this process has one" in watched[3]


def test_without_a_display_it_says_why(python):
    program = python(None, "-m", "ambf_gym.play", "ambf/Arm7Reach-v0", "--watch")
    assert program.wait(timeout=60.0) == 2
    assert "no window: no display" in program.log() and "Traceback" not in program.log()
