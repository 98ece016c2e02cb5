"""Scripts of users in processes of their own."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from harness import SLOWNESS, eventually


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
