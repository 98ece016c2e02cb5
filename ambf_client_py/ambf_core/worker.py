"""A worker process of a WorldBatch: python -m ambf_core.worker PIPE CONTROL NUMBER PARENT."""

from __future__ import annotations

import os
import signal
import sys
from multiprocessing.connection import Connection

import _ambf_core

from .batch import STEP, Worlds
from .shared import FIRST_DONE, GO, STEPS, WHAT, SharedArrays, control_array


def serve(pipe: Connection, place: str, number: int, parent: int) -> None:
    """The loop of a worker: ends with its parent, or when that closes the pipe."""
    control, file = control_array(place, 0)
    os.close(file)
    seen = int(control[GO])
    first, count, arguments = pipe.recv()
    worlds: Worlds | None = None
    try:
        worlds = Worlds(first, count, arguments)
        pipe.send((True, None))
    except Exception as error:
        pipe.send((False, error))
        return
    while True:
        if not _ambf_core.wait_for_ring(control, GO, seen, 1.0):
            if os.getppid() != parent:
                return
            continue
        seen = (seen + 1) % 2**32
        if control[WHAT] == STEP:
            worlds.step(int(control[STEPS]))
        else:
            try:
                what, *rest = pipe.recv()
                if what == "attach":
                    counts, n, shared = rest
                    worlds.attach(SharedArrays(counts, n, shared))
                    pipe.send((True, None))
                else:
                    pipe.send((True, worlds.call(*rest)))
            except (EOFError, ConnectionError):
                return
            except Exception as error:
                pipe.send((False, error))
        _ambf_core.ring(control, FIRST_DONE + number)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to the whole group; the parent ends its workers
    serve(Connection(int(sys.argv[1])), sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
