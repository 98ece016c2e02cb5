"""Many equal worlds, stepped at once by this process and others beside it, over arrays that they share.

Processes, not threads: Debian's Bullet is built without thread safety (docs/decisions/0043-simulation-in-python.md).
"""

from __future__ import annotations

import operator
import os
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from multiprocessing.connection import Pipe
from types import TracebackType
from typing import Any

import _ambf_core
import numpy as np
from numpy.typing import ArrayLike, NDArray

from .arrays import Commands, State
from .pictures import Picture, View
from .shared import FIRST_DONE, GO, STEPS, WHAT, SharedArrays, control_array, interrupts_deferred
from .views import COMMON, WorldView
from .world import World

STEP, CALL = 0, 1  # what a ring asks of workers
STEPS_BETWEEN_SIGNALS = 1000  # of all worlds of a process: Ctrl-C is seen after so many


class Worlds:
    """Some worlds of a batch, in the process that steps them."""

    def __init__(self, first: int, count: int, arguments: tuple[tuple[Any, ...], dict[str, Any]]) -> None:
        """first: the number of the first one within the batch."""
        files, options = arguments
        self.first = first
        self.worlds = [World(*files, **options) for _ in range(count)]

    def attach(self, shared: SharedArrays) -> None:
        """From now on the worlds show their state there, and obey the commands there."""
        for number, world in enumerate(self.worlds, self.first):
            world.share(shared.of(number))

    def step(self, n: int) -> None:
        """Steps all. Those that have diverged stay where they are."""
        for world in self.worlds:
            world.advance(n)

    def call(self, method: str, arguments: tuple[Any, ...], which: Sequence[int] | None) -> list[Any]:
        """World.method(*arguments) of each world, or of those numbered; the results."""
        return [
            getattr(world, method)(*arguments)
            for number, world in enumerate(self.worlds, self.first)
            if which is None or number in which
        ]

    def close(self) -> None:
        """Frees the worlds."""
        for world in self.worlds:
            world.close()


class _Worker:
    """A further process and its share of the worlds."""

    def __init__(self, number: int, control: str, first: int, count: int, arguments: Any) -> None:
        self.pipe, theirs = Pipe()
        self.process = subprocess.Popen(
            [sys.executable, "-m", "ambf_core.worker", str(theirs.fileno()), control, str(number), str(os.getpid())],
            pass_fds=[theirs.fileno()],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(each for each in sys.path if each)},
        )
        theirs.close()
        self.send((first, count, arguments))

    def send(self, what: tuple[Any, ...]) -> None:
        """Raises RuntimeError where the worker has ended."""
        try:
            self.pipe.send(what)
        except ConnectionError:
            raise self.ended() from None

    def receive(self) -> tuple[bool, Any]:
        """(True, what it computed) or (False, what it raised). Raises RuntimeError where the worker has ended."""
        try:
            good, value = self.pipe.recv()
        except (EOFError, ConnectionError):
            raise self.ended() from None
        return good, value

    def ended(self) -> RuntimeError:
        """What a call raises whose worker has ended."""
        return RuntimeError(f"a worker of the batch ended with {self.process.wait()}")


class WorldBatch:
    """n worlds of the same files. Arrays of `state` and `commands` have one more axis in front: the worlds."""

    state: State
    commands: Commands

    def __init__(self, *files: str | os.PathLike[str], n: int, workers: int = 1, **options: Any) -> None:
        """Loads n worlds (options: as of World); `workers` processes step them, of which this one is the first."""
        if n < 1 or not 1 <= workers <= n:
            raise ValueError(f"n={n}, workers={workers}: at least one world for each worker")
        self.n = n
        self._process = os.getpid()
        arguments = (tuple(os.fspath(each) for each in files), options)
        shares = [list(each) for each in np.array_split(np.arange(n), workers)]
        self._own = Worlds(0, len(shares[0]), arguments)  # first: what is wrong with the files shows here
        self._control, self._control_file = control_array(None, workers)
        place = f"/proc/{self._process}/fd/{self._control_file}"
        self._workers = [
            _Worker(number, place, int(share[0]), len(share), arguments) for number, share in enumerate(shares[1:])
        ]
        self._shared: SharedArrays | None = None
        self._busy, self._broken = threading.Lock(), ""
        self._end = weakref.finalize(self, _end, self._process, self._own, self._workers, self._control_file)
        for good, value in [worker.receive() for worker in self._workers]:
            if not good:
                raise value
        self._share()

    def __getattr__(self, name: str) -> Any:
        """What all worlds have in common: COMMON."""
        if name in COMMON:
            return getattr(self._own.worlds[0], name)
        raise AttributeError(f"WorldBatch has no '{name}'")

    def step(self, n: int = 1) -> None:
        """Runs n steps in each world.

        Raises ValueError, with nothing moved, where a world's commands are not fit to act on. Worlds that have diverged
        (`state.diverged`) stay where they are until they are reset; the others go on.
        """
        n = operator.index(n)
        if not 0 <= n < 2**31:
            raise ValueError(f"step: {n} steps")
        with self._alone():
            assert self._shared is not None
            wrong, problem = self._own.worlds[0].check_commands(self._shared.arrays[1], self.n)
            if wrong < self.n:
                raise ValueError(f"world {wrong}: {problem}")
            most = max(1, STEPS_BETWEEN_SIGNALS // len(self._own.worlds))
            while True:  # all worlds have made equally many steps wherever Ctrl-C ends this
                now = min(n, most)
                with self._whole():
                    self._ring(STEP, now)
                    self._own.step(now)
                    self._wait()
                n -= now
                if n == 0:
                    return

    def reset(self, worlds: ArrayLike | None = None) -> None:
        """Resets all worlds, or those that a mask of n truth values names."""
        self._all("reset", (), self._numbers(worlds))

    def hashes(self) -> list[int]:
        """World.hash() of each."""
        return [int(each) for each in self._all("hash", ())]

    def snapshot(self, name: str) -> None:
        """Keeps the whole state of each world under a name."""
        self._all("snapshot", (name,))

    def restore(self, name: str, worlds: ArrayLike | None = None) -> None:
        """Goes back to a snapshot in all worlds, or in those of a mask."""
        self._all("restore", (name,), self._numbers(worlds))

    def set_parameter(self, name: str, parameter: str, value: ArrayLike, worlds: ArrayLike | None = None) -> None:
        """World.set_parameter in all worlds, or in those of a mask."""
        self._all("set_parameter", (name, parameter, value), self._numbers(worlds))

    def parameter(self, name: str, parameter: str) -> NDArray[np.float64]:
        """World.parameter of each: n numbers, or (n, 3) of what is per axis."""
        return np.array(self._all("parameter", (name, parameter)))

    def set_gravity(self, gravity: ArrayLike, worlds: ArrayLike | None = None) -> None:
        """World.set_gravity in all worlds, or in those of a mask."""
        self._all("set_gravity", (gravity,), self._numbers(worlds))

    def pictures(
        self,
        camera: str | View = "",
        width: int = 640,
        height: int = 480,
        *,
        worlds: ArrayLike | None = None,
        rgb: bool = True,
        depth: bool = False,
        mask: bool = False,
    ) -> list[Picture]:
        """World.picture of all worlds, or of those of a mask."""
        arguments = (camera, width, height, rgb, depth, mask)
        return self._all("picture", arguments, self._numbers(worlds))

    def view(self, number: int) -> WorldView:
        """One of the worlds."""
        assert self._shared is not None
        return WorldView(self, number, self._shared.of(number))

    def frozen(self) -> list[list[str]]:
        """World.frozen() of each."""
        return self._all("frozen", ())

    def close(self) -> None:
        """Ends the workers and frees the worlds; arrays keep their values. Twice is fine."""
        if self._process == os.getpid():
            self._end()

    def __enter__(self) -> WorldBatch:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()

    # ---- inside ----

    def _numbers(self, mask: ArrayLike | None) -> list[int] | None:
        if mask is None:
            return None
        chosen = np.asarray(mask)
        if chosen.shape != (self.n,) or chosen.dtype != np.bool_:
            raise ValueError(f"a mask has {self.n} truth values, not shape {chosen.shape} of {chosen.dtype}")
        return [int(each) for each in np.flatnonzero(chosen)]

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """A call, which no other thread's may meet: what it asks of its own worlds included."""
        if self._process != os.getpid():
            raise RuntimeError("the batch belongs to the process that forked this one")
        if not self._busy.acquire(blocking=False):
            raise RuntimeError("another thread is using this batch")
        try:
            if not self._end.alive:
                raise RuntimeError("the batch is closed")
            if self._broken:
                raise RuntimeError(f"close the batch: {self._broken}")
            yield
        finally:
            self._busy.release()

    def _share(self) -> None:
        first = self._own.worlds[0]
        self._shared = SharedArrays(first.counts, self.n)
        self._everywhere(
            lambda: self._own.attach(self._shared or _never()), ("attach", first.counts, self.n, self._shared.place)
        )
        os.close(self._shared.file)  # all have mapped it
        self.state = State(self._shared.arrays[0])
        self.commands = Commands(self._shared.arrays[1], first.rows)

    def _all(self, method: str, arguments: tuple[Any, ...], which: list[int] | None = None) -> list[Any]:
        with self._alone():
            return self._everywhere(
                lambda: self._own.call(method, arguments, which), ("call", method, arguments, which)
            )

    def _everywhere(self, here: Callable[[], Any], there: tuple[Any, ...]) -> list[Any]:
        """Runs one thing here, then in all workers; results in the order of the worlds. What fails here is not sent."""
        with interrupts_deferred():
            results = list(here() or ())
            with self._whole():
                for worker in self._workers:
                    worker.send(there)
                self._ring(CALL, 0)
                answers = [worker.receive() for worker in self._workers]  # all, before one of them raises
                self._wait()
        for good, value in answers:
            if not good:
                raise value
            results += value or ()
        return results

    @contextmanager
    def _whole(self) -> Iterator[None]:
        """An exchange with the workers. Ctrl-C waits for its end; whatever else cuts it off breaks the batch."""
        with interrupts_deferred():
            try:
                yield
            except BaseException:
                self._broken = "a call was cut off, and its workers are out of step"
                raise

    def _ring(self, what: int, steps: int) -> None:
        if self._workers:
            self._seen = self._control[FIRST_DONE:].copy()
            self._control[WHAT], self._control[STEPS] = what, steps
            _ambf_core.ring(self._control, GO)

    def _wait(self) -> None:
        for number, worker in enumerate(self._workers):
            while not _ambf_core.wait_for_ring(self._control, FIRST_DONE + number, int(self._seen[number]), 1.0):
                if worker.process.poll() is not None:
                    raise worker.ended()


def _never() -> SharedArrays:
    raise AssertionError("shared arrays are made before they are attached")


def _end(owner: int, worlds: Worlds, workers: list[_Worker], control_file: int) -> None:
    if os.getpid() != owner:
        return
    worlds.close()
    for worker in workers:
        worker.pipe.close()
        worker.process.terminate()
    for worker in workers:
        worker.process.wait()
    os.close(control_file)
