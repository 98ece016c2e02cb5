#!/usr/bin/env python3
"""Cuts into the block of tissue with the scalpel, draws it apart, and reports how far its lips part.

Start a simulator (./dev run -l 31), then:
./dev shell -- python ambf_client_py/examples/cut_tissue.py
"""

import argparse

import numpy as np
from ambf_client import Client

TOP = 0.025  # m, of the block
APART = 0.001  # m, that each clamp goes outwards
Place = tuple[float, float, float]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--depth", type=float, default=0.010, help="m")
    options = parser.parse_args()

    with Client("cut_tissue") as client:
        world, block, scalpel = client.world, client.wait_for("block"), client.wait_for("scalpel")
        world.step(0)  # the world waits for our steps: the same every time
        loaded = block.get_nodes()

        def move(start: Place, end: Place, steps: int = 40) -> None:
            for share in np.linspace(0.0, 1.0, steps + 1)[1:]:
                at = (1.0 - share) * np.array(start) + share * np.array(end)
                scalpel.set_pos(*at)
                world.step(10)

        above, below = TOP + 0.004, TOP - options.depth
        move((0.001, -0.008, above), (0.001, -0.008, below))
        move((0.001, -0.008, below), (0.001, 0.012, below))
        move((0.001, 0.012, below), (0.001, 0.012, above + 0.02))
        for side, name in ((-1, "left"), (1, "right")):
            clamp = client.wait_for(name)
            at = clamp.get_pos()
            clamp.set_pos(at.x + side * APART, at.y, at.z)
        world.step(300)

        cut = block.get_nodes()
        places = np.unique(np.round(loaded, 6), axis=0, return_inverse=True)[1].ravel()
        widest = max(np.ptp(cut[places == place], axis=0).max() for place in range(places.max() + 1))
        print(f"cut {1e3 * options.depth:.0f} mm deep, the lips part by {1e3 * widest:.2f} mm")


if __name__ == "__main__":
    main()
