"""The program from outside: skipped where there is no program. The fixtures are those of tests/conftest.py."""

import shutil
from pathlib import Path

import pytest
from harness import SIMULATOR


def pytest_collection_modifyitems(items):
    if shutil.which("rosmaster") is None or not SIMULATOR.exists():
        reason = "no rosmaster" if SIMULATOR.exists() else f"no {SIMULATOR}"
        for item in items:
            if Path(item.fspath).parent == Path(__file__).parent:
                item.add_marker(pytest.mark.skip(reason=reason))
