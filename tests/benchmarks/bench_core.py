"""Worlds in the Python process (ambf_core): steps a CPU second, commands written and states read at each call.

Bars: step(1) at least 0.8 of free running, step(20) at least 0.95; each further world less than 5 MB; eight
worlds on two workers at least 1.7 times those on one, on two cores that have nothing else to do.
"""

import argparse
import gc
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import support
from ambf_core import MODELS, World, WorldBatch

SCENES = {
    "arm7": ((MODELS / "multi-bodies/robots/arm7.yaml",), MODELS / "world/arm7_world.yaml"),
    "PSM": ((support.COMPAT_LAUNCH.parent / "multi-bodies/robots/blender-psm.yaml",), None),
    "peg_transfer": ((MODELS / "multi-bodies/puzzles/peg_transfer.yaml",), MODELS / "world/peg_transfer_world.yaml"),
}


def make(scene):
    files, world_file = SCENES[scene]
    world = World(*files, world=world_file, sleeping=False)
    world.step(500)  # what is in contact rests, so that all runs do the same work
    return world


def rate(world, steps, at_a_time):
    """Steps a second of this thread's CPU time."""
    joints = np.flatnonzero(world.commandable)
    targets = world.state.joint_position[joints].copy()
    seen = np.empty_like(targets)
    started = time.thread_time()
    for _ in range(steps // at_a_time):
        world.commands.joint_value[joints] = targets
        world.step(at_a_time)
        np.take(world.state.joint_position, joints, out=seen)
    return steps / (time.thread_time() - started)


def ratios(scene, steps, runs):
    """Free running, and what is left of it at 1 and 20 steps a call: the best of runs that alternate."""
    with make(scene) as world:
        world.commands.joint_value[:] = world.state.joint_position
        world.commands.joint_mode[world.commandable] = 1
        world.step(2000)
        rates = [[rate(world, steps, each) for each in (steps, 1, 20)] for _ in range(runs)]
    free, one, twenty = (max(each) for each in zip(*rates, strict=True))
    return free, one / free, twenty / free


def memory_mb():
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6


def memory_of_a_world(scene):
    """MB, in a process of its own: elsewhere it would get what earlier worlds left."""
    done = subprocess.run([sys.executable, __file__, "--memory", scene], capture_output=True, text=True, check=True)
    return float(done.stdout)


def memory_of_further_worlds(scene, count=63):
    first = make(scene)
    before = memory_mb()
    more = [make(scene) for _ in range(count)]
    grown = (memory_mb() - before) / count
    for world in [first, *more]:
        world.close()
    return grown


def batch_gain(scene, n=8, steps=20, calls=25, runs=8):
    """Steps a wall second of n worlds on two workers over those on one: the best of runs that alternate."""
    files, world_file = SCENES[scene]
    rates = {}
    for _ in range(runs):
        for workers in (1, 2):
            with WorldBatch(*files, n=n, workers=workers, world=world_file, sleeping=False) as batch:
                batch.step(200)
                started = time.monotonic()
                for _ in range(calls):
                    batch.commands.joint_value[:] = batch.state.joint_position
                    batch.step(steps)
                rates.setdefault(workers, []).append(n * steps * calls / (time.monotonic() - started))
    return max(rates[2]) / max(rates[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=400)
    parser.add_argument("--runs", type=int, default=40, help="the best counts")
    parser.add_argument("--memory", metavar="SCENE", help="only the MB of each of 63 further worlds")
    parser.add_argument("--picture", metavar="FILE", help="draw the table, too (matplotlib)")
    options = parser.parse_args()
    if options.memory:
        print(memory_of_further_worlds(options.memory))
        return
    print(support.machine())
    rows, figures = [], {}
    for scene, (files, _) in SCENES.items():
        if not all(file.is_file() for file in files):
            print(f"left out: {scene}")
            continue
        free, one, twenty = ratios(scene, options.steps, options.runs)
        size = memory_of_a_world(scene)
        gain = batch_gain(scene)
        rows.append([scene, f"{free:.0f}", f"{one:.2f}", f"{twenty:.2f}", f"{size:.1f}", f"{gain:.2f}"])
        figures[f"{scene}, free running"] = (free, "rate")
        figures[f"{scene}, a world more"] = (size, "size")
    head = ["scene", "steps a CPU second", "step(1)", "step(20)", "MB a world more", "8 worlds, 2 workers"]
    support.record("core", rows, head, figures)
    if options.picture:
        support.plot(rows, head, options.picture)


if __name__ == "__main__":
    main()
