#!/usr/bin/env python3
"""Picks a ring off its peg with an instrument's jaws, by friction alone, and puts it down on the other side.

Start a simulator (./dev run), then: ./dev shell -- python ambf_client_py/examples/pick_ring.py
"""

import argparse

import numpy as np
from ambf_client import Client

JAWS = ("left_gripper-jaw_a", "left_gripper-jaw_b")
JAW = 0.020  # m, from the pivot, which is the gripper's origin, to the tip
RADIUS = 0.009  # m, of the ring, to the middle of its tube, which is 6 mm thick
OPEN, CLOSED = 0.22, 0.0  # rad, each jaw: between tube and peg there are 3 mm for a jaw of 1.4 mm
ABOVE = 0.1  # m, over the mat: no peg is in the way
SPEED = 0.1  # m/s


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("ring", nargs="?", default="ring2")
    options = parser.parse_args()

    with Client("pick_ring") as client:
        world = client.world
        gripper, ring = client.wait_for("left_gripper"), client.wait_for(options.ring)
        world.step(0)  # the world waits for our steps: the same every time

        def jaws(angle: float) -> None:
            for joint in JAWS:
                gripper.set_joint_pos(joint, angle)
            world.step(300)

        def go(x: float, y: float, z: float) -> None:
            """In a straight line, the jaws pointing down."""
            start, goal = gripper.get_pos_command(), np.array((x, y, z))
            begin = gripper.position if not gripper.is_commanded() else np.array((start.x, start.y, start.z))
            steps = int(1000 * np.linalg.norm(goal - begin) / SPEED) + 1
            for n in range(1, steps + 1):
                gripper.set_pose([*(begin + (goal - begin) * n / steps), 0.0, 0.0, 0.0])
                world.step()
            world.step(200)

        x, y, z = ring.position
        side = y - RADIUS  # one jaw goes into the hole, the other outside
        go(x, side, ABOVE)
        jaws(OPEN)
        go(x, side, z + JAW - 0.003)  # the tips reach below the middle of the tube
        jaws(CLOSED)
        go(x, side, ABOVE)
        print(f"{options.ring} was lifted by {1e3 * (ring.position[2] - z):.0f} mm")
        go(x, -side, ABOVE)
        go(x, -side, z + JAW)
        jaws(OPEN)
        go(x, -side, ABOVE)
        world.step(500)
        print(f"and put down {1e3 * (ring.position[1] - y):.0f} mm further")


if __name__ == "__main__":
    main()
