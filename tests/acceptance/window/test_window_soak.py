"""Windows opened, resized and closed, models loaded and unloaded, again and again: memory stays flat, no OpenGL error.

Half a minute by default; AMBF_SOAK_SECONDS=600 for the real thing.
"""

import os
import random
import statistics
import time
from pathlib import Path

import pytest
import worlds
import x11
from program import drawn
from test_windows import FRONT, MODEL_WITH_CAMERA

SECONDS = float(os.environ.get("AMBF_SOAK_SECONDS", "30"))
# The allocator's heaps and Mesa's caches grow in steps; in the first minute they still fill (from 150 to about 205 MB).
GROWTH_MB = 8.0 if SECONDS >= 120 else 24.0
MODELS = Path(__file__).resolve().parents[3] / "ambf_models/descriptions/multi-bodies"


def megabytes(pid):
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024
    raise AssertionError("no VmRSS")


@pytest.mark.timeout(SECONDS + 300)
def test_memory_is_flat_while_windows_and_models_come_and_go(server, user, start, tmp_path, master, ros):
    from ambf_msgs.srv import Load, Unload

    simulator = start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT}), "-l", "0", ros=True)
    user.window(1)
    drawn(user)
    load, unload = ros.service("/test/World/Load", Load), ros.service("/test/World/Unload", Unload)
    (tmp_path / "extra.yaml").write_text(MODEL_WITH_CAMERA)
    chance = random.Random(1)
    held, cycles = [], 0
    end = time.monotonic() + SECONDS
    while time.monotonic() < end or cycles < 6:
        scene = load(path=str(MODELS / chance.choice(["puzzles/peg_transfer.yaml", "mechanisms/four_bar.yaml"])))
        extra = load(path=str(tmp_path / "extra.yaml"))
        assert scene.success and extra.success, (scene.message, extra.message)
        number = max(x11.eventually(lambda: len(user.windows()) == 2 and set(user.windows()), 60.0, "a second window"))
        for window in user.windows().values():
            user.resize(window, chance.randint(200, 700), chance.randint(150, 400))
        user.window(number)
        user.key(chance.choice("vuh"))
        time.sleep(0.3)
        for answer in (extra, scene):
            assert unload(model=answer.model).success
        x11.eventually(lambda: set(user.windows()) == {1}, 60.0, "the second window closes")
        user.resize(user.windows()[1], 640, 300)
        time.sleep(0.2)
        held.append(megabytes(simulator.process.pid))
        cycles += 1
    # What is met for the first time (models, window sizes, glyphs of the driver's caches) is over by the middle.
    quarter = max(1, len(held) // 4)
    early, late = statistics.median(held[-2 * quarter : -quarter]), statistics.median(held[-quarter:])
    print(f"{cycles} cycles, {early:.0f} MB in the third quarter, {late:.0f} MB in the last")
    assert late - early < GROWTH_MB, held
