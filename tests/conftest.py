"""Shared by all pytest tests: --matching, and simulators seen from outside (tests/acceptance/harness.py).

Most tests share one ROS master and one rospy node (rospy has but one a process); tests that kill masters have one of
their own. A simulator whose log holds a warning or error that its test did not expect fails that test.
"""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent / "acceptance"))
import scenes  # noqa: E402
from harness import BENCH_ALLOWED, COMPAT, WORLD_NAMES, Master, Ros, Simulator, eventually  # noqa: E402


def pytest_addoption(parser):
    parser.addoption("--matching", metavar="REGEX", default="", help="run only tests whose id matches (as ctest -R)")


def pytest_configure(config):
    """Each process of pytest-xdist has a display of its own: keys and mouse go to the window that has the focus."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # as shells start what runs in their background
        signal.signal(signal.SIGINT, signal.default_int_handler)  # else what we start would begin with it ignored
    if "PYTEST_XDIST_WORKER" in os.environ and os.environ.get("DISPLAY"):
        reading, writing = os.pipe()
        config.ambf_display = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
            stderr=subprocess.DEVNULL,
            pass_fds=[writing],
        )
        os.close(writing)
        with os.fdopen(reading) as numbers:
            os.environ["DISPLAY"] = ":" + numbers.readline().strip()


def pytest_unconfigure(config):
    if hasattr(config, "ambf_display"):
        config.ambf_display.kill()
        config.ambf_display.wait()


def pytest_collection_modifyitems(config, items):
    pattern = re.compile(config.getoption("--matching"))
    chosen = [item for item in items if pattern.search(item.nodeid)]
    config.hook.pytest_deselected(items=[item for item in items if item not in chosen])
    items[:] = chosen


@pytest.fixture(autouse=True)
def interrupts_as_before():
    """What handles Ctrl-C is again what it was: mains of programs that tests call change it."""
    before = signal.getsignal(signal.SIGINT)
    yield
    if before is not None and signal.getsignal(signal.SIGINT) is not before:
        signal.signal(signal.SIGINT, before)


@pytest.fixture
def masters_to_end():
    """Ended after the simulators, which would complain."""
    masters = []
    yield masters
    for each in masters:
        each.kill()


@pytest.fixture
def start(tmp_path, masters_to_end):
    """start(*arguments, master_uri=..., ...): a simulator that ends with the test, and whose log is judged."""
    simulators = []

    def make(*arguments, **options):
        simulators.append(Simulator(tmp_path, *arguments, **options))
        return simulators[-1]

    yield make
    for simulator in simulators:
        if simulator.running():
            simulator.stop()
    for simulator in simulators:
        simulator.close()


@pytest.fixture(scope="session")
def master():
    """The master of the shared rospy node."""
    shared = Master()
    os.environ["ROS_MASTER_URI"] = shared.uri
    os.environ["ROS_IP"] = "127.0.0.1"
    yield shared
    shared.kill()


@pytest.fixture
def own_master(masters_to_end):
    """A master that a test may kill."""
    masters_to_end.append(Master())
    return masters_to_end[-1]


@pytest.fixture(scope="session")
def ros_node(master):
    return Ros()


@pytest.fixture
def ros(ros_node):
    yield ros_node
    ros_node.close()


@pytest.fixture
def bench(tmp_path, master, start, ros):
    """A simulator with the bench scene, its topics up."""
    launch = scenes.write(tmp_path)
    master.forget_dead()
    simulator = start("--launch_file", launch, "-l", "0", allowed=BENCH_ALLOWED, master_uri=master.uri)
    # 5 bodies, a camera, a light; the world's topics and services
    eventually(lambda: len(master.names()) == 2 * 7 + WORLD_NAMES, 20.0, f"the bench's topics, not {master.names()}")
    yield simulator
    simulator.stop()
    eventually(lambda: not master.names(), 5.0, "no topics are left behind")


@pytest.fixture
def compat():
    """The folder of models made for the original."""
    folder = COMPAT / "ambf_models/descriptions"
    if not folder.is_dir():
        pytest.skip(f"no compatibility models at {COMPAT} (set AMBF_COMPAT_DIR)")
    return folder
