#!/usr/bin/env python3
"""Does the tasks of the peg board, by friction between jaws alone; the simulator's judge says when they are done.

Start a simulator with the board and its tasks (docs/tasks.md):
  ./dev run --launch_file ambf_models/descriptions/launch_tasks.yaml -l 1,2
then: ./dev shell -- python ambf_client_py/examples/tasks/peg_transfer_expert.py one_ring --runs 10
"""

import argparse
import math

import numpy as np
from ambf_client import Client, RigidBody
from numpy.typing import ArrayLike

OPEN, CLOSED = 0.22, 0.0  # rad, each jaw
ABOVE = 0.1  # m, over the mat: no peg is in the way
SPEED = 0.15  # m/s
PART = 5  # steps between commands
# Of each kind: from its middle to the wall that is held, and the height of the pin above its middle then.
WALL = {"ring": 0.009, "triangle": 0.00675}
PIN = {"ring": 0.017, "triangle": 0.0215}
WIDE = {"ring": 0.22, "triangle": 0.12}
HEIGHT = {"ring": 0.029, "triangle": 0.0335}  # of the middle of one that lies on the board
PEG_8 = (-0.03, 0.057)
PLACES = {
    "ring": [(-0.03, 0.057), (0.0, 0.026), (0.03, 0.057)],
    "triangle": [(-0.03, 0.031), (0.0, 0.062), (0.03, 0.031)],
}
OBJECTS = ("ring2", "triangle4", "ring6", "triangle1", "ring3", "triangle5")
LEAN = 0.35  # rad: so far each hand leans outward in the hand-over, or their bodies would meet


class Hand:
    """A gripper that goes along straight lines; the world makes its steps meanwhile."""

    def __init__(self, client: Client, side: str) -> None:
        self.world = client.world
        self.side = side
        self.body: RigidBody = client.wait_for(f"{side}_gripper")
        self.joints = (f"{side}_gripper-jaw_a", f"{side}_gripper-jaw_b")
        self.start = (0.0, -0.1 if side == "left" else 0.1, 0.15)  # beside the board

    def begin(self) -> None:
        """Where it stands after a reset."""
        self.at, self.roll = self.body.position, 0.0

    def go(self, place: ArrayLike, roll: float = 0.0) -> None:
        begin, end, from_roll = self.at, np.array(place, dtype=float), self.roll
        seconds = max(float(np.linalg.norm(end - begin)) / SPEED, abs(roll - from_roll) / 1.0)
        parts = int(1000 * seconds / PART) + 1
        for n in range(1, parts + 1):
            self.body.set_pose([*(begin + (end - begin) * n / parts), from_roll + (roll - from_roll) * n / parts, 0, 0])
            self.world.step(PART)
        self.at, self.roll = end, roll
        self.world.step(200)

    def jaws(self, angle: float) -> None:
        for joint in self.joints:
            self.body.set_joint_pos(joint, angle)
        self.world.step(300)

    def pick(self, thing: RigidBody, kind: str) -> None:
        """By the wall at lower y: one jaw goes into the hole, the other one outside."""
        x, y, z = thing.position
        self.go((x, y - WALL[kind], ABOVE))
        self.jaws(WIDE[kind])
        self.go((x, y - WALL[kind], z + PIN[kind]))
        self.jaws(CLOSED)
        self.go((x, y - WALL[kind], ABOVE))

    def put(self, thing: RigidBody, kind: str, x: float, y: float, wide: float) -> None:
        """Where the middle of what it holds comes to x, y: it knows from where it was grasped."""
        held = np.array(thing.position) - self.at
        self.go((x - held[0], y - held[1], ABOVE), self.roll)
        self.go((x - held[0], y - held[1], HEIGHT[kind] + 0.003 - held[2]), self.roll)
        self.jaws(wide)
        self.go((self.at[0], self.at[1], ABOVE), self.roll)

    def leave(self) -> None:
        self.go((self.at[0], self.at[1], self.start[2]))
        self.go(self.start)


def hand_over(left: Hand, right: Hand, ring: RigidBody) -> None:
    """Left holds the ring by the wall at lower y; right takes it by the other wall, and left lets go."""
    left.go((0.0, -0.009, ABOVE + 0.03))
    left.go((0.0, -0.009, ABOVE + 0.03), LEAN)
    x, y, z = ring.position
    across = ring.matrix[:3, 1]
    # The wall that is opposite to left's, seen from the ring's middle: along its own y, where that points away.
    away = across if across[1] > 0 else -across
    away = np.array((0.0, *(np.array(away[1:]) / np.linalg.norm(away[1:]))))
    tip = np.array((x, y, z)) + WALL["ring"] * away
    # The right hand leans the other way; its pin is PIN along its axis from the wall.
    axis = np.array((0.0, math.sin(LEAN), math.cos(LEAN)))
    pin = tip + PIN["ring"] * axis
    far = pin + 0.04 * axis
    right.go((0.0, 0.1, far[2]))
    right.jaws(OPEN)
    right.go(far, -LEAN)
    right.go(pin, -LEAN)
    right.jaws(CLOSED)
    left.jaws(OPEN)
    back = left.at + 0.04 * np.array((0.0, -math.sin(LEAN), math.cos(LEAN)))
    left.go(back, LEAN)
    left.leave()


def one_ring(client: Client, left: Hand, right: Hand) -> None:
    ring = client.wait_for("ring2")
    left.pick(ring, "ring")
    hand_over(left, right, ring)
    right.put(ring, "ring", *PEG_8, OPEN)


def all_six(client: Client, left: Hand, right: Hand) -> None:
    places = {kind: iter(pegs) for kind, pegs in PLACES.items()}
    for name in OBJECTS:
        thing, kind = client.wait_for(name), name[:-1]
        right.pick(thing, kind)
        right.put(thing, kind, *next(places[kind]), WIDE[kind])


def random_start(client: Client, left: Hand, right: Hand, dice: np.random.Generator) -> None:
    """The hands begin somewhere beside the board, and the ring lies on its peg as it was pushed."""
    client.world.reset()
    client.world.step(1)
    for hand in (left, right):
        hand.begin()
        hand.go(np.array(hand.start) + dice.uniform(-0.02, 0.02, 3))
    ring = client.wait_for("ring2")
    angle = dice.uniform(0.0, 2.0 * math.pi)
    ring.set_force(0.012 * math.cos(angle), 0.012 * math.sin(angle), 0.0)
    client.world.step(100)
    ring.clear_cmd()
    client.world.step(300)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", nargs="?", choices=("one_ring", "all_six"), default="one_ring")
    parser.add_argument("--runs", type=int, default=1, help="how often, each from another random start")
    parser.add_argument("--seed", type=int, default=1, help="of the random starts")
    options = parser.parse_args()

    done = 0
    with Client("peg_transfer_expert") as client:
        client.world.step(0)  # the world waits for our steps: the same every time
        left, right, task = Hand(client, "left"), Hand(client, "right"), client.get_task(options.task)
        for run in range(options.runs):
            random_start(client, left, right, np.random.default_rng(options.seed + run))
            (one_ring if options.task == "one_ring" else all_six)(client, left, right)
            client.world.step(700)  # a goal is done once it has lasted for 0.5 s
            success = task.wait_for_success(timeout=5.0)
            done += success
            print(
                f"start {options.seed + run}: {'done' if success else 'not done'} in {task.get_time():.1f} s, "
                f"{task.get_drops()} drops, {task.get_hand_overs()} hand-overs"
            )
        client.world.release()
    print(f"{done} of {options.runs} done")
    raise SystemExit(0 if done == options.runs else 1)


if __name__ == "__main__":
    main()
