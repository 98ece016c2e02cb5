#!/usr/bin/env python3
"""Moves a body round a circle, and says how well it follows.

Start a simulator (./dev run), then: ./dev shell -- python ambf_client_py/examples/move_body.py
"""

import argparse
import math
import time

import numpy as np
from ambf_client import Client


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("body", nargs="?", default="left_gripper", help="its name, or a part of it")
    parser.add_argument("--radius", type=float, default=0.03, help="m")
    parser.add_argument("--seconds", type=float, default=6.0, help="for one turn")
    options = parser.parse_args()

    with Client("move_body") as client:
        body = client.wait_for(options.body)
        start = body.position  # a numpy array, m
        print(f"{body.get_name()} starts at {np.round(start, 4)}")

        errors = []
        begin = time.monotonic()
        while (t := time.monotonic() - begin) < options.seconds:
            angle = 2.0 * math.pi * t / options.seconds
            target = start + options.radius * np.array([math.cos(angle) - 1.0, math.sin(angle), 0.0])
            body.set_pos(target)  # the client keeps sending it, 120 times a second, until it is given another
            errors.append(np.linalg.norm(body.position - target))
            time.sleep(0.01)

        body.set_pos(start)
        time.sleep(1.0)
        print(f"mean distance to where it should have been: {1e3 * np.mean(errors):.1f} mm")
        print(f"back within {1e3 * np.linalg.norm(body.position - start):.1f} mm")


if __name__ == "__main__":
    main()
