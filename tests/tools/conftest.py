"""Skipped where there is no program. The fixtures are those of tests/conftest.py."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import scenes
from harness import BENCH_ALLOWED, ROOT, SIMULATOR, WORLD_NAMES, eventually

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))


def pytest_collection_modifyitems(items):
    if shutil.which("rosmaster") is None or not SIMULATOR.exists():
        reason = "no rosmaster" if SIMULATOR.exists() else f"no {SIMULATOR}"
        for item in items:
            if Path(item.fspath).parent == HERE:
                item.add_marker(pytest.mark.skip(reason=reason))


@pytest.fixture
def run_python(master):
    """run_python(*arguments, code=0): what a Python program printed, started as users start it."""

    def run(*arguments, code=0, timeout=60, **environment):
        env = dict(os.environ, ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1", **environment)
        env["PYTHONPATH"] = os.pathsep.join([str(ROOT / "ambf_client_py"), os.environ.get("PYTHONPATH", "")])
        command = [sys.executable, *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, env=env, timeout=timeout)
        assert done.returncode == code, f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
        return done

    return run


@pytest.fixture
def cli(run_python):
    """cli(*words, code=0): what `ambf-cli words...` printed."""

    def run(*words, code=0, **more):
        return run_python("-m", "ambf_tools.cli", *words, code=code, **more)

    return run


@pytest.fixture
def ask(cli):
    """ask(*words): its answer in JSON."""

    def run(*words, code=0):
        return json.loads(cli(*words, "--json", code=code).stdout)

    return run


@pytest.fixture
def cubes(tmp_path, master, start):
    """cubes(count, hertz): a simulator with so many cubes, all publishing so often."""

    def make(count, hertz=1000):
        launch = scenes.write(tmp_path, scenes.cubes(count))
        rates = ("--override_min_comm_freq", hertz, "--override_max_comm_freq", hertz)
        simulator = start("--launch_file", launch, "-l", "0", *rates, allowed=BENCH_ALLOWED, master_uri=master.uri)
        eventually(lambda: len(master.names()) == 2 * (count + 2) + WORLD_NAMES, 60.0, "the cubes' topics")
        return simulator

    return make
