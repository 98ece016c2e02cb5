"""Clients in this process (they share its one ROS node), and scripts of users in processes of their own."""

import functools
import importlib.util
import inspect
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from harness import SIMULATOR, SLOWNESS, eventually

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))


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


class Script:
    """A script of a user, running. Lines that it prints can be waited for; lines can be typed into it."""

    def __init__(self, folder, text, master_uri, environment=None):
        file = Path(folder) / f"script_{time.monotonic_ns()}.py"
        file.write_text(text)
        env = dict(
            os.environ, ROS_MASTER_URI=master_uri, ROS_IP="127.0.0.1", PYTHONUNBUFFERED="1", PYTHONFAULTHANDLER="1"
        )
        env.update(environment or {})
        self.lines = []
        self.process = subprocess.Popen(
            [sys.executable, str(file)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env=env,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        for line in self.process.stdout:
            self.lines.append(line.rstrip("\n"))

    def text(self):
        return "\n".join(self.lines)

    def wait_line(self, part, seconds=20.0, count=1):
        """The count-th line with that in it."""

        def look():
            fits = [line for line in self.lines if part in line]
            return fits[count - 1] if len(fits) >= count else None

        try:
            return eventually(look, seconds)
        except pytest.fail.Exception:
            pytest.fail(f"not within {seconds} s: a line with '{part}' in:\n{self.text()}")

    def type(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def interrupt(self):
        """Ctrl-C; seconds until it ended."""
        begin = time.monotonic()
        self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(20.0 * SLOWNESS)
        except subprocess.TimeoutExpired:
            self.process.send_signal(signal.SIGABRT)  # it prints where its threads are
            self.process.wait()
            self.reader.join(5.0)
            pytest.fail(f"it goes on 20 s after Ctrl-C:\n{self.text()}")
        return time.monotonic() - begin

    def finish(self, seconds=60.0):
        """Its exit code."""
        code = self.process.wait(seconds * SLOWNESS)
        self.reader.join(5.0)
        return code

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


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
