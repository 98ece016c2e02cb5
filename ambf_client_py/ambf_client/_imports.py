"""Ctrl-C during imports.

An import that Ctrl-C interrupts does not always end in KeyboardInterrupt: C extensions make an ImportError of it, with
a page of advice on how to install them.
"""

import contextlib
import signal
import threading
from collections.abc import Iterator


@contextlib.contextmanager
def interrupts_held_back() -> Iterator[None]:
    """Raises KeyboardInterrupt at the end of the block instead of within it. A handler of the program's own stays."""
    at_home = threading.current_thread() is threading.main_thread()
    if not at_home or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    interrupted = threading.Event()
    signal.signal(signal.SIGINT, lambda _number, _frame: interrupted.set())
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        if interrupted.is_set():
            raise KeyboardInterrupt
