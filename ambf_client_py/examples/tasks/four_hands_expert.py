#!/usr/bin/env python3
"""Puts the multi-link puzzle together with four hands (dissertation, Fig. 3.21): all of them lift the plate by its
handles and put it over the pegs of the base, then three of them put the spools on it, by friction alone; the
simulator's judge says when it is done.

Start a simulator with the boards, the hands and their task (docs/tasks.md):
  ./dev run --launch_file ambf_models/studies/launch_four_hands.yaml -l 0,1,2
then: ./dev shell -- python ambf_client_py/examples/tasks/four_hands_expert.py --runs 10
"""

import argparse
import math

import numpy as np
from ambf_client import Client
from four_hands import ACROSS, CLEAR, FINGER, SQUEEZE, Grip, Hands, Pose, about_z, heading

# Of each hand: the handle, which of its bars (along the plate's x), and how far outwards of its hinge it holds it.
GRASPS = {
    "user1_left": ("HandleLeft", 0.105, -0.105),
    "user2_left": ("HandleLeft", -0.105, -0.215),
    "user1_right": ("HandleRight", 0.105, 0.105),
    "user2_right": ("HandleRight", -0.105, 0.215),
}
BAR = 0.055  # m: half its thickness
TIPS = 0.038  # m, of the fingers below a bar's middle: the table is right below it
OVER = 0.75  # m, of the plate's frame above the base's: over the pegs
ON_BASE, ON_PLATE = 0.2, 0.25  # m, of the plate and of the spools
TIPS_OF_SPOOLS = -0.165  # m: fingers hold their upper half
# Spool, where along the base it belongs, how it is held, by which hand.
SPOOLS = (
    ("SquarePuzzle", -0.5, Grip(0.14, TIPS_OF_SPOOLS), "user2_left"),
    ("CirclePuzzle", 0.0, Grip(0.16, TIPS_OF_SPOOLS), "user1_right"),
    ("TrianglePuzzle", 0.5, Grip(0.1575, TIPS_OF_SPOOLS, middle=(0.0075, 0.0)), "user2_right"),
)


def lift_plate(client: Client, hands: Hands) -> None:
    """Over the pegs of the base, and down."""
    plate, base = client.wait_for("CenterPuzzle"), client.wait_for("PuzzleBase")
    above, down = {}, {}
    for name, (handle, x, y) in GRASPS.items():
        hinge = client.wait_for(handle)
        yaw = heading(plate)
        bar = np.array(hinge.position) + about_z(yaw) @ (x, y, 0.0)
        palm = bar + (0.0, 0.0, FINGER - TIPS)
        down[name] = Pose(palm, yaw + ACROSS)
        above[name] = Pose(palm + (0.0, 0.0, 0.4), yaw + ACROSS)
    names = list(GRASPS)
    hands.fingers(dict.fromkeys(names, BAR + CLEAR))
    hands.go(above)
    hands.go(down)
    hands.fingers(dict.fromkeys(names, BAR - SQUEEZE))
    x, y, z = base.position
    yaw = heading(base)
    hands.carry(names, plate, (*plate.position[:2], z + OVER), heading(plate))
    hands.carry(names, plate, (x, y, z + OVER), yaw)
    hands.carry(names, plate, (x, y, z + OVER), yaw)  # what they see to be missing
    hands.carry(names, plate, (x, y, z + ON_BASE + 0.01), yaw)
    hands.fingers(dict.fromkeys(names, BAR + CLEAR))
    hands.by(names, (0.0, 0.0, 0.45))
    client.world.step(500)


def stack_spools(client: Client, hands: Hands) -> None:
    base = client.wait_for("PuzzleBase")
    x, y, z = base.position
    yaw = heading(base)
    for name, along, grip, hand in SPOOLS:
        spool = client.wait_for(name)
        hands.pick(hand, spool, grip, z + OVER - 0.02)
        place = np.array((x, y, z)) + about_z(yaw) @ (0.0, along, ON_PLATE + 0.008)
        hands.put(hand, spool, place, yaw, grip)
        client.world.step(600)
        hands.leave([hand])


def random_start(client: Client, hands: Hands, dice: np.random.Generator) -> None:
    """The plate and the spools stand elsewhere, by a few centimetres and degrees."""
    client.world.reset()
    client.world.step(1)
    hands.begin()
    for name, mass in (("CenterPuzzle", 1.6), ("SquarePuzzle", 0.8), ("CirclePuzzle", 0.8), ("TrianglePuzzle", 0.8)):
        angle, push = dice.uniform(0.0, 2.0 * math.pi), mass * dice.uniform(0.0, 8.0)
        client.wait_for(name).set_force(push * math.cos(angle), push * math.sin(angle), 0.0)
    client.world.step(150)
    for name in ("CenterPuzzle", "SquarePuzzle", "CirclePuzzle", "TrianglePuzzle"):
        client.wait_for(name).clear_cmd()
    client.world.step(600)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=1, help="how often, each from another random start")
    parser.add_argument("--seed", type=int, default=1, help="of the random starts")
    parser.add_argument("--plate", action="store_true", help="the plate only: over_the_pegs of study B")
    options = parser.parse_args()

    done = 0
    with Client("four_hands_expert") as client:
        client.world.step(0)  # the world waits for our steps: the same every time
        hands, task = Hands(client), client.get_task("four_hands")
        for run in range(options.runs):
            random_start(client, hands, np.random.default_rng(options.seed + run))
            lift_plate(client, hands)
            if not options.plate:
                hands.leave(list(GRASPS))
                stack_spools(client, hands)
            client.world.step(100)
            goals = task.get_goals()
            success = all(list(goals.values())[:1] if options.plate else goals.values())
            done += success
            print(f"start {options.seed + run}: {goals} in {task.get_time():.1f} s, {task.get_drops()} drops")
        client.world.release()
    print(f"{done} of {options.runs} done")
    raise SystemExit(0 if done == options.runs else 1)


if __name__ == "__main__":
    main()
