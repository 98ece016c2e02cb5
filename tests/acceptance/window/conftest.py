import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
try:
    import x11
    from program import Simulator
except ImportError:  # no python3-xlib
    collect_ignore_glob = ["test_*.py"]


@pytest.fixture
def server():
    server = x11.XServer()
    yield server
    server.kill()


@pytest.fixture
def user(server):
    user = x11.User(server.name)
    yield user
    user.close()


@pytest.fixture
def start(tmp_path):
    """start(display, *arguments, ros=False): a simulator with windows; the graphics driver must not complain."""
    started = []

    def make(display, *arguments, ros=False):
        started.append(Simulator(display, tmp_path / f"log{len(started)}", *arguments, ros=ros))
        return started[-1]

    yield make
    for simulator in started:
        simulator.close()
    for simulator in started:
        assert "OpenGL:" not in simulator.log(), simulator.log()
