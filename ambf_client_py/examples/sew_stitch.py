#!/usr/bin/env python3
"""Sews a wound in a skin pad with one stitch: bites, pulls, ties and lets go, and reports how far the lips are apart.

Start a simulator (./dev run -l 33), then: ./dev shell -- python ambf_client_py/examples/sew_stitch.py
"""

import math

import numpy as np
from ambf_client import Client
from numpy.typing import NDArray

ABOVE, OVER = 0.0515, 0.0315  # m: the needle's middle before the bite, and in it
AROUND = 2 * math.pi - 0.1  # rad: all the way through
WIDE = 0.003  # m, of the wound as loaded


def main() -> None:
    with Client("sew_stitch") as client:
        world = client.world
        pad, needle, forceps, stitch, grip = (
            client.wait_for(name) for name in ("pad", "needle", "forceps", "stitch", "grip")
        )
        world.step(0)  # from here on the world waits for our steps
        loaded = pad.get_nodes()
        near = np.abs(loaded[:, 1]) < 0.0025
        lips = [near & (np.abs(loaded[:, 0] - side * WIDE / 2) < 1e-5) for side in (-1, 1)]

        def gap() -> float:
            nodes = pad.get_nodes()
            return 1e3 * float(nodes[lips[1], 0].mean() - nodes[lips[0], 0].mean())

        places: dict[str, NDArray[np.float64]] = {
            "needle": np.array([0.0, 0.0, ABOVE, 0.0]),
            "forceps": np.array([0.060, 0.0, 0.059, 0.611]),
        }  # x, y, z (m), turn about y (rad)

        def move(steps: int, let_go: bool = False, **goals: tuple[float, float, float, float]) -> None:
            starts = {name: places[name].copy() for name in goals}
            for share in np.linspace(0.0, 1.0, steps // 10 + 1)[1:]:
                for name, goal in goals.items():
                    places[name] = (1.0 - share) * starts[name] + share * np.array(goal)
                for body, name in ((needle, "needle"), (forceps, "forceps")):
                    x, y, z, turn = places[name]
                    body.set_pose([x, y, z, 0.0, math.sin(turn / 2), 0.0, math.cos(turn / 2)])
                # Its sensor holds the thread from the start; a command does so beyond what that sees, or lets go.
                grip.deactuate() if let_go else grip.actuate("thread")
                world.step(10)

        move(100)
        print(f"the lips are {gap():.2f} mm apart")
        move(100, needle=(0.0, 0.0, OVER, -0.1))
        move(800, needle=(0.0, 0.0, OVER, AROUND))
        move(100, needle=(-0.004, 0.0, 0.050, AROUND))
        print(f"the needle is through: the thread is in the pad in {stitch.get_bites()} bites")
        move(300, needle=(-0.015, 0.0, 0.060, AROUND))
        # Crosswise: each end goes to the other side.
        move(400, needle=(0.025, 0.0, 0.060, AROUND), forceps=(-0.010, 0.0, 0.055, -0.611))
        for far in np.arange(0.011, 0.080, 0.001):
            if gap() < 0.45:
                break
            move(30, forceps=(-far, 0.0, 0.055, -0.611))
        print(f"pulled tight: {gap():.2f} mm apart, by {np.linalg.norm(grip.get_force()):.2f} N")
        stitch.actuate("tie")
        move(20)
        stitch.deactuate()
        move(300, let_go=True, needle=(0.022, 0.0, 0.050, AROUND))
        move(300, let_go=True)
        print(f"tied in {stitch.get_tied()} places and let go: {gap():.2f} mm apart")


if __name__ == "__main__":
    main()
