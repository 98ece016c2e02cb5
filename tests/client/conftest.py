"""Clients in this process (they share its one ROS node), and scripts of users in processes of their own."""

import functools
import importlib.util
import inspect
import shutil
import sys
from pathlib import Path

import pytest
from harness import SIMULATOR

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
from user_script import Script  # noqa: E402

if importlib.util.find_spec("rospy") is None:  # built without ROS: there is nothing to test, nor to import
    collect_ignore_glob = ["test_*.py"]


def pytest_collection_modifyitems(items):
    if shutil.which("rosmaster") is None or not SIMULATOR.exists():
        for item in items:
            if HERE in Path(item.fspath).parents:
                item.add_marker(pytest.mark.skip(reason=f"no rosmaster or no {SIMULATOR}"))


@pytest.fixture
def client(ros):
    """A connected client of whatever simulator the test starts."""
    from ambf_client import Client

    made = Client(max_discovery_attempts=1)
    made.connect()
    yield made
    made.clean_up()


@pytest.fixture(scope="module")
def called():
    """Documented methods that the tests of a file have called so far: {(class, method)}, by the class of the object."""
    import ambf_client
    from documented import PUBLIC, methods

    calls = set()

    def recording(function):
        @functools.wraps(function)
        def call(self, *arguments, **named):
            calls.update((each.__name__, function.__name__) for each in type(self).__mro__)
            return function(self, *arguments, **named)

        return call

    with pytest.MonkeyPatch.context() as patch:
        for class_name, text in PUBLIC.items():
            owner = getattr(ambf_client, class_name)
            for name in methods(text):
                patch.setattr(owner, name, recording(inspect.getattr_static(owner, name)))
        yield calls


@pytest.fixture
def script(tmp_path):
    """script(text, master_uri): a Script that ends with the test."""
    scripts = []

    def make(text, master_uri, **options):
        scripts.append(Script(tmp_path, text, master_uri, **options))
        return scripts[-1]

    yield make
    for each in scripts:
        each.end()
