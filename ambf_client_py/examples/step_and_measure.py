#!/usr/bin/env python3
"""Runs the simulation step by step, and measures after each: a falling box shows what gravity is.

Start a simulator, then: ./dev shell -- python ambf_client_py/examples/step_and_measure.py
Between two steps the simulation waits, however long a program thinks: state, action and result belong together.
"""

import argparse

import numpy as np
from ambf_client import Client

BALL = """\
adf version: 1.0
namespace: /ambf/env/example/
bodies: [BODY Ball]
BODY Ball:
  name: Ball
  mass: 0.1
  inertia: {ix: 0.0001, iy: 0.0001, iz: 0.0001}
  location: {position: {x: 0.0, y: 0.0, z: 0.0}, orientation: {r: 0.0, p: 0.0, y: 0.0}}
  shape: SPHERE
  geometry: {radius: 0.02}
  collision shape: SPHERE
  collision geometry: {radius: 0.02}
  damping: {linear: 0.0, angular: 0.0}
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=200)
    options = parser.parse_args()

    with Client("step_and_measure") as client:
        world = client.world
        world.step(0)  # from here on the simulation waits for us
        loaded = client.load(text=BALL, pose=[0.0, 0.0, 5.0, 0.0, 0.0, 0.0])
        try:
            ball = client.wait_for(loaded.objects[0])
            first = world.step(1)
            times, heights = [0.0], [ball.position[2]]
            for _ in range(options.steps):
                done = world.step(1)  # returns when the step is done; all handles show that very step
                assert ball.get_sim_step() == done.sim_step
                times.append(done.sim_time - first.sim_time)
                heights.append(ball.position[2])
            a, _, _ = np.polyfit(times, heights, 2)
            print(f"{options.steps} steps, {times[-1]:.3f} s of simulated time")
            print(f"gravity: {2.0 * a:.4f} m/s2")
        finally:
            client.unload(loaded.model)
            world.release()


if __name__ == "__main__":
    main()
