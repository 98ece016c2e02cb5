"""Where ambf-cli starts: Ctrl-C ends it quietly with 130 also while its modules are being imported.

An interrupted import shows a traceback, or turns into an ImportError of what it was importing.
"""

import os
import signal
import threading
from types import FrameType

INTERRUPTED = 130


def _end(number: int, frame: FrameType | None) -> None:
    os._exit(INTERRUPTED)


def main() -> int:
    """Runs ambf-cli; returns its exit code."""
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, _end)
    from ambf_tools.cli.main import main as run

    code = run()
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, _end)  # nothing is left to do but to end
    return code
