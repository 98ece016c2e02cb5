#!/usr/bin/env python3
"""Cuts into a block of tissue, has the cut gape, and closes it by a running suture of five stitches.

Start a simulator (./dev run -l 31), then: ./dev shell -- python ambf_client_py/examples/close_incision.py
"""

import math

import numpy as np
from ambf_client import Client

TOP, CUT_AT, DEEP = 0.025, 0.001, 0.010  # m: of the block; where it is cut, and how deep
APART = 0.002  # m, that each clamp goes outwards
BITES = (-0.010, -0.005, 0.0, 0.005, 0.010)  # m, along the cut
OVER, ABOVE = TOP + 0.0025, TOP + 0.0225  # m: the needle's middle in a bite, and before it
AROUND = 2 * math.pi - 0.1  # rad: all the way through
LENGTH, BEFORE, BITE = 0.300, 0.105, 0.027  # m, of thread: all, before the first stitch, in one
Place = tuple[float, float, float, float]  # x, y, z (m), turn about y (rad)


def main() -> None:
    with Client("close_incision") as client:
        world, block = client.world, client.wait_for("block")
        stitch, grip = client.wait_for("stitch"), client.wait_for("grip")
        bodies = {name: client.wait_for(name) for name in ("scalpel", "left", "right", "needle", "forceps")}
        world.step(0)  # from here on the world waits for our steps
        loaded = block.get_nodes()
        of_place = np.unique(np.round(loaded, 6), axis=0, return_inverse=True)[1].ravel()
        places = {}
        for name, body in bodies.items():
            at = body.get_pos()
            places[name] = np.array((at.x, at.y, at.z, 0.611 if name == "forceps" else 0.0))

        def move(steps: int, let_go: bool = False, **goals: Place) -> None:
            starts = {name: places[name].copy() for name in goals}
            for share in np.linspace(0.0, 1.0, steps // 10 + 1)[1:]:
                for name, goal in goals.items():
                    places[name] = (1.0 - share) * starts[name] + share * np.array(goal)
                for name, body in bodies.items():
                    x, y, z, turn = places[name]
                    body.set_pose([x, y, z, 0.0, math.sin(turn / 2), 0.0, math.cos(turn / 2)])
                grip.deactuate() if let_go else grip.actuate("thread")
                world.step(10)

        def by(name: str, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Place:
            at = places[name]
            return at[0] + x, at[1] + y, at[2] + z, at[3]

        move(400, scalpel=(CUT_AT, -0.008, TOP - DEEP, 0.0))
        move(400, scalpel=(CUT_AT, 0.012, TOP - DEEP, 0.0))
        move(200, scalpel=(CUT_AT, 0.012, TOP + 0.03, 0.0))
        move(300, scalpel=(0.0, 0.06, TOP + 0.05, 0.0), left=by("left", -APART), right=by("right", APART))
        now = block.get_nodes()
        top = np.flatnonzero((loaded[:, 2] > TOP - 1e-4) & (np.abs(loaded[:, 1]) < 0.0126))
        lips = [top[of_place[top] == place] for place in np.unique(of_place[top])]
        lips = [lip for lip in lips if np.ptp(now[lip, 0]) > 1e-3]

        def gap() -> float:
            nodes = block.get_nodes()
            return 1e3 * max(float(np.ptp(nodes[lip, 0])) for lip in lips)

        print(f"cut {1e3 * DEEP:.0f} mm deep and drawn apart: {gap():.2f} mm at one of {len(lips)} places")
        slack = LENGTH - BEFORE
        for i, y in enumerate(BITES):
            turn = 0.0 if i == 0 else -0.1
            move(200, needle=(CUT_AT, y, ABOVE + 0.02, places["needle"][3]))
            places["needle"][3] = turn
            move(200, needle=(CUT_AT, y, OVER, -0.1))
            move(800, needle=(CUT_AT, y, OVER, AROUND))
            slack -= BITE
            move(60, needle=by("needle", -0.010, z=0.020))
            move(400, needle=by("needle", z=slack - 0.02))
        print(f"sewn by {stitch.get_bites()} bites, {stitch.get_stitches()} places: {gap():.2f} mm")
        move(300, needle=(0.045, BITES[-1], TOP + 0.04, AROUND), forceps=by("forceps", 0.0))
        for _ in range(80):
            if gap() < 0.45 or np.linalg.norm(grip.get_force()) > 3.0:
                break
            move(30, forceps=by("forceps", -0.001))
        print(f"pulled tight by {np.linalg.norm(grip.get_force()):.2f} N: {gap():.2f} mm")
        stitch.actuate("tie")
        move(20)
        stitch.deactuate()
        move(300, let_go=True, needle=(0.035, BITES[-1], TOP + 0.025, AROUND))
        move(300, let_go=True)
        print(f"tied in {stitch.get_tied()} places and let go: {gap():.2f} mm")


if __name__ == "__main__":
    main()
