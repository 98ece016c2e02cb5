#!/usr/bin/env python3
"""Brings objects of the peg board to pegs of their kind, and lets the pegs' sensors say which are done.

Start a simulator (./dev run), then: ./dev shell -- python ambf_client_py/examples/sort_by_key.py
The first object is put on a peg of the other kind first: that does not count.
"""

import argparse

import numpy as np
from ambf_client import Client, RigidBody

JAWS = ("right_gripper-jaw_a", "right_gripper-jaw_b")
JAW = 0.020  # m, from the pivot, which is the gripper's origin, to the tip
# Of each kind: from its middle to the wall that is held, how high above its middle the pin is then, and how wide the
# jaws open for it.
WALL = {"ring": 0.009, "triangle": 0.00675}
PIN = {"ring": JAW - 0.003, "triangle": 0.0215}
OPEN = {"ring": 0.22, "triangle": 0.12}  # rad, each jaw
CLOSED = 0.0
OBJECTS = ("ring2", "triangle4", "ring6", "triangle1", "ring3", "triangle5")
# As printed on the board: peg, x, y in m.
GOALS = {
    "triangle": [("goal7", -0.030, 0.031), ("goal10", 0.0, 0.062), ("goal11", 0.030, 0.031)],
    "ring": [("goal8", -0.030, 0.057), ("goal9", 0.0, 0.026), ("goal12", 0.030, 0.057)],
}
ABOVE = 0.1  # m, over the mat: no peg is in the way
SPEED = 0.2  # m/s


class Sorter:
    def __init__(self, client: Client) -> None:
        self.world = client.world
        self.gripper = client.wait_for("right_gripper")
        left = client.wait_for("left_gripper")
        self.world.step(0)  # the world waits for our steps: the same every time
        aside = left.position
        for n in range(1, 51):  # it stands over the objects
            left.set_pose([aside[0], aside[1] - 0.002 * n, aside[2] + 0.001 * n, 0.0, 0.0, 0.0])
            self.world.step(10)
        self.at = self.gripper.position

    def jaws(self, angle: float) -> None:
        for joint in JAWS:
            self.gripper.set_joint_pos(joint, angle)
        self.world.step(300)

    def go(self, x: float, y: float, z: float) -> None:
        """In a straight line, the jaws pointing down."""
        begin, goal = self.at, np.array((x, y, z))
        steps = int(200 * np.linalg.norm(goal - begin) / SPEED) + 1
        for n in range(1, steps + 1):
            self.gripper.set_pose([*(begin + (goal - begin) * n / steps), 0.0, 0.0, 0.0])
            self.world.step(5)
        self.world.step(200)
        self.at = goal

    def carry(self, thing: RigidBody, kind: str, x: float, y: float) -> None:
        """Holds it by the wall that is nearer to the operator's left."""
        here = thing.position
        height = here[2] + PIN[kind]
        self.go(here[0], here[1] - WALL[kind], ABOVE)
        self.jaws(OPEN[kind])
        self.go(here[0], here[1] - WALL[kind], height)
        self.jaws(CLOSED)
        self.go(here[0], here[1] - WALL[kind], ABOVE)
        self.go(x, y - WALL[kind], ABOVE)
        self.go(x, y - WALL[kind], height + 0.002)
        self.jaws(OPEN[kind])
        self.go(x, y - WALL[kind], ABOVE)
        self.world.step(700)  # a task is done once it has lasted for 0.5 s


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--objects", type=int, default=len(OBJECTS), help="how many of them")
    options = parser.parse_args()

    with Client("sort_by_key") as client:
        sorter = Sorter(client)

        def done() -> list[str]:
            return sorted(name.rpartition("/")[2] for name, success in client.world.get_success().items() if success)

        goals = {kind: iter(places) for kind, places in GOALS.items()}
        for number, name in enumerate(OBJECTS[: options.objects]):
            thing, kind = client.wait_for(name), name[:-1]
            if number == 0:
                wrong = "triangle" if kind == "ring" else "ring"
                goal, x, y = GOALS[wrong][0]
                sorter.carry(thing, kind, x, y)
                print(f"{name} on {goal}, a peg of the other kind: done are {done()}")
            goal, x, y = next(goals[kind])
            sorter.carry(thing, kind, x, y)
            print(f"{name} on {goal}: done are {done()}")
        client.world.release()


if __name__ == "__main__":
    main()
