#!/usr/bin/env python3
"""Presses on the lobe of liver at several places, and finds its hard lump by how little it gives way.

Start a simulator (./dev run -l 30), then:
./dev shell -- python ambf_client_py/examples/press_tissue.py
"""

import argparse

import numpy as np
from ambf_client import Client

FINGER = 0.012  # m, radius of what presses
PLACES = [(-0.030, 0.015), (0.030, 0.015), (0.000, 0.025)]  # m; the lump is below the first


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--force", type=float, default=0.15, help="N")
    options = parser.parse_args()

    with Client("press_tissue") as client:
        world, lobe = client.world, client.wait_for("lobe")
        world.step(0)  # the world waits for our steps: the same every time
        world.step(1500)  # ball and cube settle
        rest = lobe.get_nodes()
        top = rest[:, 2] > rest[:, 2].mean()

        given_way = []
        for x, y in PLACES:
            near = np.flatnonzero(top & (np.hypot(rest[:, 0] - x, rest[:, 1] - y) < FINGER))
            before = lobe.get_nodes()[near, 2].mean()
            for _ in range(10):
                lobe.set_node_forces(near, np.tile([0.0, 0.0, -options.force / len(near)], (len(near), 1)))
                world.step(50)
            depth = before - lobe.get_nodes()[near, 2].mean()
            lobe.set_node_forces([], [])
            world.step(500)
            given_way.append(depth)
            print(f"at {1e3 * x:4.0f}, {1e3 * y:3.0f} mm it gives way by {1e3 * depth:.2f} mm under {options.force} N")
        hardest = int(np.argmin(given_way))
        x, y = PLACES[hardest]
        print(f"the lump is below {1e3 * x:.0f}, {1e3 * y:.0f} mm")


if __name__ == "__main__":
    main()
