#!/usr/bin/env python3
"""Two forceps lay a gauze swab on a lobe of liver and the omentum over it, a gloved finger presses on it, and the
forceps draw it away; how far the liver was pressed in, and how far the swab slid, are reported.

Start a simulator (./dev run -l 37), then: ./dev shell -- python ambf_client_py/examples/lay_swab.py
"""

import argparse
import math
from typing import Any

import numpy as np
from ambf_client import Client
from numpy.typing import NDArray

TILTS = {"left": math.radians(28), "right": math.radians(-28)}
FINGER_TILT, FINGER = math.radians(20), 0.008  # rad, m: radius of the finger
SIDE, COUNT = 0.060, 13  # m, of the swab; nodes along it
NEAR = 0.002  # m above the swab: where forceps take it
FRONT, PRESSED = 0.003, (-0.027, -0.022)  # m: x of its front edge on the liver; x, y where the finger presses


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--depth", type=float, default=0.005, help="m, of the finger below where the swab lay")
    parser.add_argument("--draw", type=float, default=0.025, help="m, along the liver")
    parser.add_argument("--keep", action="store_true", help="end while the finger presses")
    options = parser.parse_args()

    with Client("lay_swab") as client:
        world = client.world
        swab, liver, omentum = (client.wait_for(name) for name in ("swab", "liver", "omentum"))
        forceps = {side: client.wait_for(f"{side}_forceps") for side in TILTS}
        grips = {side: client.wait_for(f"{side}_grip") for side in TILTS}
        finger = client.wait_for("finger")
        world.step(0)  # the world waits for our steps: the same every time
        places = {name: body.get_pos() for name, body in {**forceps, "finger": finger}.items()}
        at = {name: np.array([place.x, place.y, place.z]) for name, place in places.items()}
        world.step(500)

        def put(name: str, body: Any, place: NDArray[np.float64]) -> None:
            half = 0.5 * (FINGER_TILT if name == "finger" else TILTS[name])
            turn = [0.0, math.sin(half)] if name == "finger" else [math.sin(half), 0.0]
            body.set_pose([*place, *turn, 0.0, math.cos(half)])
            at[name] = place

        def move(goals: dict[str, NDArray[np.float64]], speed: float, hold: bool) -> None:
            starts = {side: at[side] for side in goals}
            way = max(float(np.linalg.norm(goals[side] - starts[side])) for side in goals)
            for share in np.linspace(0.0, 1.0, max(1, round(way / speed / 0.01)) + 1)[1:]:
                for side, goal in goals.items():
                    put(side, forceps[side], starts[side] + share * (goal - starts[side]))
                    if hold:
                        grips[side].actuate_from_sensor_data(f"{side}_eyes")
                world.step(10)

        def shift(x: float, z: float, speed: float = 0.08, hold: bool = True) -> None:
            move({side: at[side] + [x, 0.0, z] for side in TILTS}, speed, hold)

        def take(row: int) -> None:
            """The swab near its corners, beside the omentum: of its nodes along x, those in this row."""
            nodes = swab.get_nodes().reshape(COUNT, COUNT, 3)
            corners = {"left": nodes[row, 1], "right": nodes[row, COUNT - 4]}
            move({side: corners[side] + [0.0, 0.0, 0.02] for side in TILTS}, 0.1, hold=False)
            move({side: corners[side] + [0.0, 0.0, NEAR] for side in TILTS}, 0.05, hold=False)
            shift(0.0, 0.0)
            print("held by", [side for side in TILTS if grips[side].is_actuated()])

        def point(goal: NDArray[np.float64], speed: float) -> None:
            start = at["finger"]
            steps = max(1, round(float(np.linalg.norm(goal - start)) / speed / 0.01))
            for share in np.linspace(0.0, 1.0, steps + 1)[1:]:
                put("finger", finger, start + share * (goal - start))
                world.step(10)

        def let_go(up: float) -> None:
            for grip in grips.values():
                grip.deactuate()
            shift(0.0, up, hold=False)

        def surface(x: float, y: float) -> NDArray[np.int64]:
            """Nodes of the liver's upper side near there."""
            nodes = liver.get_nodes()
            near = np.hypot(nodes[:, 0] - x, nodes[:, 1] - y) < 0.012
            return np.flatnonzero(near & (nodes[:, 2] > 0.030))

        top = float(liver.get_nodes()[surface(*PRESSED), 2].max())
        take(1)
        shift(0.0, top + SIDE + 0.015 - at["left"][2])
        shift(FRONT - at["left"][0], 0.0)
        shift(0.0, top + SIDE - at["left"][2])
        for turn in np.linspace(0.0, 0.5 * math.pi, 31)[1:]:  # its lower edge lies down first, then the rest
            goal = FRONT - SIDE * math.sin(turn), top + NEAR + SIDE * math.cos(turn)
            shift(goal[0] - at["left"][0], goal[1] - at["left"][2], 0.06)
        let_go(0.04)
        world.step(500)
        laid = swab.get_nodes()
        print(f"laid: {np.count_nonzero(laid[:, 2] > 0.025)} of {len(laid)} nodes are on the liver")

        below, before = surface(*PRESSED), liver.get_nodes()
        high = float(laid[np.hypot(laid[:, 0] - PRESSED[0], laid[:, 1] - PRESSED[1]) < 0.008, 2].max())
        turned = np.array([math.sin(FINGER_TILT), 0.0, math.cos(FINGER_TILT)])
        tip = np.array([*PRESSED, high + FINGER]) - FINGER * turned
        above, start = tip + [0.0, 0.0, 0.03], at["finger"]
        point(above, 0.1)
        point(tip, 0.05)
        point(tip - [0.0, 0.0, options.depth], 0.015)
        world.step(300)
        depth = float((before - liver.get_nodes())[below, 2].max())
        print(f"the finger presses the liver in by {1e3 * depth:.1f} mm")
        if options.keep:
            return
        point(above, 0.08)
        point(start, 0.1)
        left = float((before - liver.get_nodes())[below, 2].max())
        print(f"let go, {1e3 * left:.1f} mm are left")

        rest, fat = swab.get_nodes(), omentum.get_nodes()
        take(COUNT - 2)
        shift(0.0, 0.002, 0.02)
        dragged = 0.0
        for _ in range(30):
            shift(options.draw / 30, 0.0, 0.03)
            dragged = max(dragged, float(np.linalg.norm(omentum.get_nodes() - fat, axis=1).max()))
        slid = float((swab.get_nodes() - rest)[:, 0].mean())
        print(f"the swab slid by {1e3 * slid:.1f} mm, and took the omentum along by {1e3 * dragged:.1f} mm")
        shift(0.0, 0.07)
        world.step(500)
        gone = float(np.linalg.norm(omentum.get_nodes() - fat, axis=1).mean())
        print(f"drawn away: the omentum lies within {1e3 * gone:.1f} mm of where it lay, on average")


if __name__ == "__main__":
    main()
