"""Messages for people go to standard error, so that scripts keep standard output for themselves."""

from __future__ import annotations

import sys


def say(message: str) -> None:
    """One line for people."""
    print(f"[ambf_client] {message}", file=sys.stderr, flush=True)
