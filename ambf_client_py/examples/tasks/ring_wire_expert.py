#!/usr/bin/env python3
"""Leads the ring along the bent wire without touching it; the simulator's judge counts touches.

Start a simulator (./dev run --launch_file ambf_models/descriptions/launch_tasks.yaml -l 0), then:
  ./dev shell -- python ambf_client_py/examples/tasks/ring_wire_expert.py --runs 10
With --careless it cuts the bends, and touches.
"""

import argparse
import math

import numpy as np
from ambf_client import Client, RigidBody
from numpy.typing import NDArray

HALF, HEIGHT, WAVE, SIDE = 0.080, 0.095, 0.020, 0.012  # m, of the wire (ambf_models/scripts/scene_ring_wire.py)
START, END = 0.06, 0.94  # of its length
SPEED = 0.04  # m/s
PART = 10  # steps between commands


def place(t: float, bends: float = 1.0) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """On the wire, t from 0 (left) to 1 (right): where, and along which direction."""
    where = np.array((SIDE * math.sin(2 * math.pi * t), HALF * (2 * t - 1), HEIGHT + WAVE * math.sin(3 * math.pi * t)))
    way = np.array(
        (SIDE * 2 * math.pi * math.cos(2 * math.pi * t), 2 * HALF, WAVE * 3 * math.pi * math.cos(3 * math.pi * t))
    )
    middle = np.array((0.0, where[1], HEIGHT))
    return middle + bends * (where - middle), way / np.linalg.norm(way)


def turn_to(way: NDArray[np.float64]) -> tuple[float, float, float]:
    """Roll, pitch, yaw that bring the ring's axis, its y, to the wire's direction."""
    return math.asin(way[2]), 0.0, math.atan2(-way[0], way[1])


def lead(client: Client, ring: RigidBody, bends: float) -> None:
    t = START
    while t < END:
        step = float(np.linalg.norm(place(t + 1e-3)[0] - place(t)[0])) * 1e3  # m a unit of t
        t = min(END, t + SPEED * PART * 1e-3 / step)
        where, way = place(t, bends)
        ring.set_pose([*where, *turn_to(way)])
        client.world.step(PART)
    client.world.step(500)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=1, help="how often, each from another random start")
    parser.add_argument("--seed", type=int, default=1, help="of the random starts")
    parser.add_argument("--careless", action="store_true", help="cuts the bends")
    options = parser.parse_args()

    clean = 0
    with Client("ring_wire_expert") as client:
        client.world.step(0)  # the world waits for our steps: the same every time
        ring, task = client.wait_for("ring_wire/ring"), client.get_task("lead")
        for run in range(options.runs):
            dice = np.random.default_rng(options.seed + run)
            client.world.reset()
            where, way = place(START)
            roll, pitch, yaw = turn_to(way)
            aside = dice.uniform(-0.004, 0.004, 3)
            for n in range(1, 51):  # to a random start about the wire
                ring.set_pose([*(where + aside * n / 50), roll * n / 50, pitch, yaw * n / 50])
                client.world.step(PART)
            lead(client, ring, 0.4 if options.careless else 1.0)
            success = task.wait_for_success(timeout=5.0)
            clean += success and task.get_touches() == 0
            print(
                f"start {options.seed + run}: {'done' if success else 'not done'} in {task.get_time():.1f} s, "
                f"{task.get_touches()} touches"
            )
        client.world.release()
    print(f"{clean} of {options.runs} done without a touch")
    raise SystemExit(0 if clean == options.runs or options.careless else 1)


if __name__ == "__main__":
    main()
