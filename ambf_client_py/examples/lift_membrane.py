#!/usr/bin/env python3
"""Two forceps take a membrane that lies over organs, lift it and let it down again; what that does to it is reported.

Start a simulator (./dev run -l 34), then: ./dev shell -- python ambf_client_py/examples/lift_membrane.py
"""

import argparse
import math

import numpy as np
from ambf_client import Client

TILTS = {"left": math.radians(-30), "right": math.radians(30)}
ABOVE = 0.080  # m, of the tips as loaded
PLACES = {"left": (-0.030, 0.0), "right": (0.040, 0.0)}  # x, y (m)
NEAR = 0.003  # m above the membrane: where the tips take it


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lift", type=float, default=0.025, help="m")
    parser.add_argument("--keep", action="store_true", help="end with the membrane lifted")
    options = parser.parse_args()

    with Client("lift_membrane") as client:
        world, membrane = client.world, client.wait_for("peritoneum")
        forceps = {side: client.wait_for(f"{side}_forceps") for side in TILTS}
        grips = {side: client.wait_for(f"{side}_grip") for side in TILTS}
        world.step(0)  # the world waits for our steps: the same every time
        world.step(1000)  # it sinks onto the organs
        rest, faces = membrane.get_nodes(), membrane.get_faces()
        heights = dict.fromkeys(TILTS, ABOVE)

        def area() -> float:
            a, b, c = (membrane.get_nodes()[faces[:, k]] for k in range(3))
            return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())

        def below(side: str) -> float:
            x, y = PLACES[side]
            nodes = membrane.get_nodes()
            return float(nodes[np.hypot(nodes[:, 0] - x, nodes[:, 1] - y) < 0.006, 2].max())

        def move(goals: dict[str, float], hold: bool) -> None:
            starts = dict(heights)
            steps = round(max(abs(goals[side] - starts[side]) for side in TILTS) / 5e-4)  # 5 cm/s
            for share in np.linspace(0.0, 1.0, max(steps, 1) + 1)[1:]:
                for side, (x, y) in PLACES.items():
                    heights[side] = starts[side] + share * (goals[side] - starts[side])
                    turn = TILTS[side]
                    forceps[side].set_pose([x, y, heights[side], 0.0, math.sin(turn / 2), 0.0, math.cos(turn / 2)])
                    if hold:
                        grips[side].actuate_from_sensor_data(f"{side}_eyes")
                world.step(10)

        loaded = area()
        down = {side: below(side) + NEAR for side in TILTS}
        move(down, hold=False)
        move(down, hold=True)
        print("held by", [side for side in TILTS if grips[side].is_actuated()])
        move({side: down[side] + options.lift for side in TILTS}, hold=True)
        world.step(200)
        lifted = (membrane.get_nodes() - rest)[:, 2]
        print(f"lifted by up to {1e3 * lifted.max():.1f} mm, {np.count_nonzero(lifted > 0.002)} nodes along with it")
        print(f"its area grew by {100 * (area() / loaded - 1):.1f} %")
        if options.keep:
            return
        move(down, hold=True)
        for grip in grips.values():
            grip.deactuate()
        move(dict.fromkeys(TILTS, ABOVE), hold=False)
        world.step(1000)
        apart = np.linalg.norm(membrane.get_nodes() - rest, axis=1)  # its folds are others
        print(f"let go: within {1e3 * apart.mean():.1f} mm of where it lay, on average")


if __name__ == "__main__":
    main()
