"""The program from outside: skipped where there is no program. The fixtures are those of tests/conftest.py."""

import shutil
from pathlib import Path

import pytest
from harness import SIMULATOR, eventually


def pytest_collection_modifyitems(items):
    if shutil.which("rosmaster") is None or not SIMULATOR.exists():
        reason = "no rosmaster" if SIMULATOR.exists() else f"no {SIMULATOR}"
        for item in items:
            if Path(item.fspath).parent == Path(__file__).parent:
                item.add_marker(pytest.mark.skip(reason=reason))


@pytest.fixture
def scene(tmp_path, master, start):
    """A simulator with the cameras of pictures.py, their topics up."""
    from pictures import CAMERA_BLOCKS, CAMERAS, write

    simulator = start("--launch_file", write(tmp_path), "-l", "0", master_uri=master.uri)
    last = {f"{CAMERAS}/{name}/MaskData/labels" for name in CAMERA_BLOCKS}
    last |= {f"{CAMERAS}/pair/right/camera_info", f"{CAMERAS}/slow/depth/camera_info", "/ambf/env/Carrier/State"}
    eventually(lambda: last <= set(master.published()), 20.0, "the cameras' topics")
    yield simulator
    simulator.stop()
    eventually(lambda: not master.names(), 5.0, "no topics are left behind")
