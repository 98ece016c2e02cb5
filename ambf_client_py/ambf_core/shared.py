"""What the processes of a WorldBatch share: arrays and the words by which they ring for each other; deferred Ctrl-C."""

from __future__ import annotations

import mmap
import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import _ambf_core
import numpy as np
from numpy.typing import NDArray

from .arrays import Memory, shapes

GO, WHAT, STEPS, FIRST_DONE = range(4)  # places in the control array; one more for each further worker


class SharedArrays:
    """Arrays of n worlds in memory that other processes map: by this process' number and file."""

    def __init__(self, counts: dict[str, int], n: int, place: str | None = None) -> None:
        """place: where another process has them; None: made here."""
        layout = [
            (fields, [((n, *shape), np.dtype(element)) for shape, element in shapes(fields, counts)])
            for fields in (_ambf_core.STATE_FIELDS, _ambf_core.COMMAND_FIELDS)
        ]
        sizes = [[-(-int(np.prod(shape)) * kind.itemsize // 64) * 64 for shape, kind in each] for _, each in layout]
        self.file = os.memfd_create("ambf_core") if place is None else os.open(place, os.O_RDWR)
        if place is None:
            os.ftruncate(self.file, max(64, sum(map(sum, sizes))))
            self.place = f"/proc/{os.getpid()}/fd/{self.file}"
        memory = mmap.mmap(self.file, 0)
        if place is not None:
            os.close(self.file)
        self.arrays: list[list[NDArray[Any]]] = []
        at = 0
        for (_, rows), bytes_ in zip(layout, sizes, strict=True):
            self.arrays.append([])
            for (shape, kind), size in zip(rows, bytes_, strict=True):
                count = int(np.prod(shape))
                self.arrays[-1].append(np.frombuffer(memory, kind, count, at).reshape(shape))
                at += size

    def of(self, world: int) -> Memory:
        """The memory of one world."""
        state, commands = ([np.asarray(each[world, ...]) for each in arrays] for arrays in self.arrays)
        return state, commands


def control_array(place: str | None, workers: int) -> tuple[NDArray[np.uint32], int]:
    """The shared words by which processes ring for each other, and their file."""
    file = os.memfd_create("ambf_core_bells") if place is None else os.open(place, os.O_RDWR)
    if place is None:
        os.ftruncate(file, 4 * (FIRST_DONE + workers))
    return np.frombuffer(mmap.mmap(file, 0), np.uint32), file


@contextmanager
def interrupts_deferred() -> Iterator[None]:
    """Ctrl-C is obeyed once the block has ended, also where it raises. Only the main thread is ever interrupted."""
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield
        return
    arrived: list[tuple[int, Any]] = []
    signal.signal(signal.SIGINT, lambda number, frame: arrived.append((number, frame)))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if arrived:
            before(*arrived[0])
