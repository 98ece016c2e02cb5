"""Environments in which other programs abort: an ordinary user, no writable home, ROS variables that make no sense."""

import os
import resource
import subprocess
import tempfile
from pathlib import Path

import pytest
import scenes
from harness import SIMULATOR, SLOWNESS, Master, eventually

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


def run_limited(resource_name, value, *arguments):
    """The program under a limit of setrlimit()."""
    return subprocess.run(
        [SIMULATOR, "-g", "false", *arguments],
        preexec_fn=lambda: resource.setrlimit(getattr(resource, resource_name), (value, value)),
        capture_output=True,
        text=True,
        timeout=30 * SLOWNESS,
    )


def test_without_memory_it_ends_with_1_and_one_line(tmp_path):
    if SLOWNESS > 1.0:
        pytest.skip("a sanitizer reserves terabytes")
    done = run_limited("RLIMIT_AS", 100 << 20, "--launch_file", scenes.write(tmp_path), "-l", "0", "--no-ros")
    assert done.returncode == 1
    assert "no more memory" in done.stderr and "104857600" in done.stderr, done.stderr


def test_a_limit_on_file_sizes_is_an_error_of_that_file(tmp_path):
    launch = scenes.write(tmp_path)
    picture = ("--screenshot", tmp_path / "x.png")
    done = run_limited("RLIMIT_FSIZE", 1024, "--launch_file", launch, "-l", "0", "--no-ros", *picture)
    assert done.returncode == 1
    assert "x.png" in done.stderr, done.stderr


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
