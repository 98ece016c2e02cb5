#!/usr/bin/env python3
"""Forceps retract a gallbladder that its peritoneum holds down, a hook cuts the membrane on one side, and the forceps
lift the gallbladder out; what pulls at the forceps is reported.

Start a simulator (./dev run -l 35), then: ./dev shell -- python ambf_client_py/examples/free_gallbladder.py
"""

import argparse
from typing import Any

import numpy as np
from ambf_client import Client

FUNDUS = (0.030, 0.0)  # x, y (m) where the forceps take it
NEAR = 0.002  # m above the gallbladder: where they do
SIDE = 0.029  # y (m) of the cut
FROM, TO = 0.036, -0.042  # x (m), from before the membrane's free edge to behind the other
Place = tuple[float, float, float]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lift", type=float, default=0.020, help="m")
    parser.add_argument("--keep", action="store_true", help="end with the gallbladder lifted")
    options = parser.parse_args()

    with Client("free_gallbladder") as client:
        world, gallbladder, membrane = client.world, client.wait_for("gallbladder"), client.wait_for("membrane")
        forceps, hook, grip = client.wait_for("forceps"), client.wait_for("hook"), client.wait_for("grip")
        world.step(0)  # the world waits for our steps: the same every time
        loaded = membrane.get_nodes()
        world.step(500)  # it settles
        places = {"forceps": forceps.get_pos(), "hook": hook.get_pos()}
        places = {name: (at.x, at.y, at.z) for name, at in places.items()}

        def move(name: str, body: Any, goal: Place, speed: float = 0.04, hold: bool = False) -> None:  # m/s
            start = np.array(places[name])
            steps = max(1, round(float(np.linalg.norm(np.array(goal) - start)) / speed / 0.01))
            for share in np.linspace(0.0, 1.0, steps + 1)[1:]:
                body.set_pos(*(start + share * (np.array(goal) - start)))
                if hold:
                    grip.actuate_from_sensor_data("eyes")
                world.step(10)
            places[name] = goal

        def pull() -> float:
            """N, upwards on the gallbladder, a mean."""
            forces = []
            for _ in range(10):
                world.step(20)
                forces.append(grip.get_force()[2])
            return float(np.mean(forces))

        nodes = gallbladder.get_nodes()
        top = float(nodes[np.hypot(nodes[:, 0] - FUNDUS[0], nodes[:, 1] - FUNDUS[1]) < 0.006, 2].max())
        move("forceps", forceps, (*FUNDUS, top + 0.01))
        move("forceps", forceps, (*FUNDUS, top + NEAR))
        move("forceps", forceps, (*FUNDUS, top + NEAR), hold=True)
        world.step(100)
        print("held" if grip.is_actuated() else "not held")
        move("forceps", forceps, (*FUNDUS, top + NEAR + options.lift), hold=True)
        held_back = pull()
        print(f"lifted by {1e3 * options.lift:.0f} mm, it is held back by {held_back:.2f} N")

        low = float(nodes[:, 2].min())
        move("hook", hook, (FROM, SIDE, places["hook"][2]))
        move("hook", hook, (FROM, SIDE, low + 0.004))
        move("hook", hook, (TO, SIDE, low + 0.004), speed=0.03)
        move("hook", hook, (TO, SIDE, places["hook"][2] + 0.05))
        now = membrane.get_nodes()
        numbers = np.unique(np.round(loaded, 6), axis=0, return_inverse=True)[1].ravel()
        widest = max(np.ptp(now[numbers == place], axis=0).max() for place in range(numbers.max() + 1))
        freed = pull()
        print(f"cut: the membrane gapes by {1e3 * widest:.1f} mm, and {freed:.2f} N are left")
        if options.keep:
            return
        move("forceps", forceps, (*FUNDUS, top + NEAR), hold=True)
        grip.deactuate()
        move("forceps", forceps, (*FUNDUS, top + 0.05))
        print("let down and let go")


if __name__ == "__main__":
    main()
