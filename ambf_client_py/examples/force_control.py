#!/usr/bin/env python3
"""Holds a box in the air by forces: a controller of one's own, outside of the simulator.

Start a simulator (any scene), then: ./dev shell -- python ambf_client_py/examples/force_control.py
The box is loaded for this and taken away again.
"""

import argparse
import time

import numpy as np
from ambf_client import Client

MASS = 0.5  # kg
BOX = f"""\
adf version: 1.0
namespace: /ambf/env/example/
bodies: [BODY Box]
BODY Box:
  name: Box
  mass: {MASS}
  inertia: {{ix: 0.0002, iy: 0.0002, iz: 0.0002}}
  location: {{position: {{x: 0.0, y: 0.0, z: 0.0}}, orientation: {{r: 0.0, p: 0.0, y: 0.0}}}}
  shape: BOX
  geometry: {{x: 0.05, y: 0.05, z: 0.05}}
  collision shape: BOX
  collision geometry: {{x: 0.05, y: 0.05, z: 0.05}}
  damping: {{linear: 0.01, angular: 0.2}}
"""
STIFFNESS, DAMPING = 40.0, 8.0  # N/m, N s/m
GRAVITY = np.array([0.0, 0.0, -9.81])  # m/s2; of the world file


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--height", type=float, default=0.4, help="m above where it starts")
    parser.add_argument("--seconds", type=float, default=6.0)
    options = parser.parse_args()

    with Client("force_control") as client:
        start = np.array([0.3, 0.0, 0.5])
        loaded = client.load(text=BOX, pose=[*start, 0.0, 0.0, 0.0])
        try:
            box = client.wait_for(loaded.objects[0])
            target = start + np.array([0.0, 0.0, options.height])
            begin = time.monotonic()
            while time.monotonic() - begin < options.seconds:
                force = STIFFNESS * (target - box.position) - DAMPING * box.linear_velocity - MASS * GRAVITY
                box.set_force(force)  # N, world axes; ends by itself when this loop does
                box.wait_for_next_state(0.1)  # as fast as states come: 1000 times a second while it is commanded
            print(f"{1e3 * np.linalg.norm(target - box.position):.1f} mm from the target")
        finally:
            client.unload(loaded.model)


if __name__ == "__main__":
    main()
