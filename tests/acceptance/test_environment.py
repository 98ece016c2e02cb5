"""Environments in which other programs abort: an ordinary user, no writable home, ROS variables that make no sense."""

import os
import subprocess
import tempfile
from pathlib import Path

import pytest
import scenes
from harness import SIMULATOR, Master, eventually

NOBODY = 65534


@pytest.mark.parametrize(
    ("variable", "value"),
    [
        ("ROS_MASTER_URI", "garbage"),
        ("ROS_MASTER_URI", "http://localhost"),
        ("ROS_MASTER_URI", "http://localhost:99999"),
        ("ROS_NAMESPACE", "a b!"),
        ("ROS_NAMESPACE", "a" * 100_000),
        ("ROS_IP", "not an address"),
        ("ROS_HOSTNAME", "x\ny"),
    ],
)
def test_a_ros_variable_that_makes_no_sense_is_named_and_ends_it_with_2(tmp_path, variable, value):
    done = subprocess.run(
        [SIMULATOR, "-g", "false", "--launch_file", scenes.write(tmp_path), "-l", "0"],
        env={**os.environ, variable: value},
        capture_output=True,
        text=True,
        timeout=20,
    )
    assert done.returncode == 2, done.stderr
    assert f"{variable}='{value[:20]}" in done.stderr
    assert len(done.stderr.splitlines()) == 1 + value.count("\n") and len(done.stderr) < 500


def test_a_ros_variable_that_makes_no_sense_does_not_matter_without_ros(tmp_path, start):
    simulator = start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0", "--no-ros"),
        master_uri="garbage",
        environment={"ROS_NAMESPACE": "a b!"},
    )
    simulator.wait_loaded()
    assert simulator.stop()[0] == 0


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can become another user")
def test_an_ordinary_user_without_a_home_runs_it_and_its_master(start):
    """CI runs everything as root, whom no folder refuses."""
    try:
        subprocess.run([SIMULATOR, "--version"], user=NOBODY, check=True, capture_output=True)
    except PermissionError:
        pytest.skip("the tree is in a folder that only its owner may enter")
    master = Master(running=False)
    with tempfile.TemporaryDirectory() as folder:
        os.chmod(folder, 0o755)
        simulator = start(
            *("--launch_file", scenes.write(Path(folder)), "-l", "0", "--legacy_states", "g2"),
            master_uri=master.uri,
            environment={"HOME": "/nonexistent"},
            user=NOBODY,
        )
        eventually(lambda: "/ambf/env/Slide/Command" in master.names(), 20.0, "topics at a master of its own")
        assert simulator.stop()[0] == 0
