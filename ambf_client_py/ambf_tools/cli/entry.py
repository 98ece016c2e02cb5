"""Where ambf-cli starts: Ctrl-C ends it quietly with 130 also while its modules are being imported.

An interrupted import shows a traceback, or turns into an ImportError of what it was importing.
"""

import os
import signal
from types import FrameType

INTERRUPTED = 130


def _end(number: int, frame: FrameType | None) -> None:
    os._exit(INTERRUPTED)


def _end_on_interrupt() -> None:
    try:
        signal.signal(signal.SIGINT, _end)
    except ValueError:
        return  # not in the main thread, where signals do not arrive


def main() -> int:
    """Runs ambf-cli; returns its exit code."""
    _end_on_interrupt()
    from ambf_tools.cli.main import main as run

    code = run()
    _end_on_interrupt()  # nothing is left to do but to end
    return code
