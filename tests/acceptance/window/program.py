"""The program with windows, and what tests wait for."""

import os
import pathlib
import subprocess
import time

import x11
from harness import SLOWNESS

ROOT = pathlib.Path(__file__).resolve().parents[3]
SIMULATOR = pathlib.Path(os.environ.get("AMBF_BUILD_DIR", ROOT / "build")) / "bin/ambf_simulator"


class Simulator:
    def __init__(self, display, log, *arguments, ros=False):
        self.log_file = log
        environment = {**os.environ, "DISPLAY": display}
        environment.pop("WAYLAND_DISPLAY", None)
        with open(log, "w") as out:
            self.process = subprocess.Popen(
                [SIMULATOR, "--check-graphics", *(() if ros else ("--no_ros",)), *map(str, arguments)],
                cwd=ROOT,
                env=environment,
                stdout=out,
                stderr=out,
            )

    def log(self):
        return self.log_file.read_text(errors="replace")

    def says(self, text, seconds=30.0):
        x11.eventually(lambda: text in self.log(), seconds, lambda: f"'{text}' in the log:\n{self.log()}")

    def ends(self, seconds=15.0):
        return self.process.wait(timeout=seconds)

    def close(self):
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(timeout=30.0 * SLOWNESS)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
                raise AssertionError(f"the simulator did not end within 30 s of SIGTERM:\n{self.log()}") from None


def drawn(user, number=1):
    """Once the window shows a scene."""
    x11.eventually(lambda: user.colours(number) > 30, 30.0, "a scene, not a plain surface")


def changes(user, act, seconds=20.0):
    """Does the screen differ from what it was soon after act()?"""
    before = user.picture()
    act()
    x11.eventually(lambda: user.picture() != before, seconds, "another picture")


def still(picture):
    """picture(), once it has stood still for longer than any message is shown (6 s)."""
    seen, since = picture(), time.monotonic()

    def stands():
        nonlocal seen, since
        now = picture()
        if now != seen:
            seen, since = now, time.monotonic()
        return time.monotonic() - since > 7.0

    x11.eventually(stands, 40.0, "a still picture")
    return seen
