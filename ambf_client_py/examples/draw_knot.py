#!/usr/bin/env python3
"""Loads a thread with a loose overhand knot, draws it tight by its ends, and says what holds.

Start a simulator, then: ./dev shell -- python ambf_client_py/examples/draw_knot.py
"""

import argparse
import json
import math
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from ambf_client import Client
from numpy.typing import NDArray

RADIUS = 0.0002  # m, of the thread
TAIL = 0.025  # m, of thread at either end of the knot
LOOP = 0.001  # m: the loose knot is six of these wide
CUT, GAP = math.pi / 3, 0.25  # rad: where the closed curve is cut open, and half of what is left out


def trefoil(turn: float) -> NDArray[np.float64]:
    across = [math.sin(turn) + 2 * math.sin(2 * turn), math.cos(turn) - 2 * math.cos(2 * turn)]
    return LOOP * np.array([*across, -math.sin(3 * turn)])


def model(height: float) -> dict[str, Any]:
    """A file of AMBF that holds one thread; YAML reads JSON."""
    out = np.array([math.sin(CUT), math.cos(CUT), 0.0])
    along = np.array([-math.cos(CUT), math.sin(CUT), 0.0])
    curve = [trefoil(turn) for turn in np.linspace(CUT + GAP, CUT + 2 * math.pi - GAP, 60)]
    points = [curve[0] + (out + along) * TAIL, *curve, curve[-1] + (out - along) * TAIL]
    tissue = {
        "kind": "thread",
        "points": [dict(zip("xyz", map(float, point), strict=True)) for point in points],
        "radius": RADIUS,
        "young modulus": 1e7,
        "element size": 0.001,
        "friction": 0.4,
    }
    place = {"position": {"x": 0.0, "y": 0.0, "z": height}}
    return {"soft bodies": ["SOFT thread"], "SOFT thread": {"name": "knot", "location": place, "tissue": tissue}}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--force", type=float, default=1.0, help="N, at each end")
    parser.add_argument("--seconds", type=float, default=2.0)
    options = parser.parse_args()

    with Client("draw_knot") as client, tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "knot.yaml"
        file.write_text(json.dumps(model(1.0)))
        loaded = client.load(str(file))
        thread = client.wait_for(loaded.objects[0])

        def look() -> tuple[float, float]:
            """Length of the thread, and between its ends (m)."""
            nodes = thread.get_nodes()
            length = float(np.linalg.norm(np.diff(nodes, axis=0), axis=1).sum())
            return length, float(np.linalg.norm(nodes[-1] - nodes[0]))

        try:
            ends = [0, len(thread.get_nodes()) - 1]
            length, _ = look()
            print(f"{ends[1]} segments, {1e3 * length:.1f} mm")
            apart = options.force * np.array([-math.cos(CUT), math.sin(CUT), 0.0])
            end = time.monotonic() + options.seconds
            while time.monotonic() < end:
                thread.set_node_forces(ends, [apart, -apart])
                time.sleep(0.1)
            length, between = look()
            print(f"{1e3 * (length - between):.1f} mm are in the knot", end=", ")
            print("which holds" if length - between > 4 * RADIUS else "it is gone")
        finally:
            thread.set_node_forces([], [])
            client.unload(loaded.model)


if __name__ == "__main__":
    main()
