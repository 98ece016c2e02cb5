#!/usr/bin/env python3
"""Does the task of the practice scene with hands (dissertation, Fig. 7.4): opens the clasps and the lid by their joints
and puts each piece into the cavity that it fits, held by friction alone; the simulator's judge says when it is done.

Start a simulator with the scene, its task and the hands (docs/tasks.md):
  ./dev run --launch_file ambf_models/studies/launch_practice.yaml -l 0,1,2
then: ./dev shell -- python ambf_client_py/examples/tasks/practice_expert.py --runs 10
"""

import argparse
import math

import numpy as np
from ambf_client import Client, RigidBody
from four_hands import Grip, Hands

OPEN = {"Mold_A-HandleBaseLeft": 0.9, "Mold_A-HandleBaseRight": -0.9}
LID, LID_OPEN = "Mold_A-MoldHinge", 1.8
HIGH = -0.2  # m, of a piece's middle that is carried
LOW = 0.012  # m above its place, where a piece is let go
TIPS = 0.012  # m, of the fingers below a piece's middle: so much of it stays above the mould
# Piece: where it lies in the mould's frame, how it is held, by which hand.
PIECES = {
    "Box_B": ((-0.507, -0.666, 0.1755), Grip(0.131, TIPS), "user1_left"),
    "Cylinder_B": ((-0.507, 0.0, 0.1755), Grip(0.1375, TIPS), "user1_right"),
    "Triangle_B": ((-0.507, 0.666, 0.1755), Grip(0.1275, TIPS, middle=(0.0425, 0.0)), "user1_right"),
    "Box_A": ((0.08, -0.666, 0.153), Grip(0.087, TIPS), "user1_left"),
    "Ball_B": ((0.08, 0.0, 0.1595), Grip(0.1995, TIPS + 0.01), "user1_right"),
    "Triangle_A": ((0.08, 0.666, 0.153), Grip(0.08475, TIPS, middle=(0.02825, 0.0)), "user1_right"),
    "Cylinder_A": ((0.587, 0.0, 0.153), Grip(0.091, TIPS), "user1_left"),
}


def open_lid(client: Client, mould: RigidBody) -> None:
    """Slowly: its joints are stiff."""
    for goals in (OPEN, {LID: LID_OPEN}):
        for n in range(1, 101):
            for joint, angle in goals.items():
                mould.set_joint_pos(joint, angle * n / 100)
            client.world.step(15)
    client.world.step(200)


def sort_in(client: Client, hands: Hands, names: list[str]) -> None:
    mould = client.wait_for("Mold_A")
    open_lid(client, mould)
    for name in names:
        place, grip, hand = PIECES[name]
        piece = client.wait_for(name)
        hands.pick(hand, piece, grip, HIGH)
        hands.put(hand, piece, np.array(mould.position) + place + (0.0, 0.0, LOW), 0.0, grip)
        client.world.step(300)


def random_start(client: Client, hands: Hands, dice: np.random.Generator) -> None:
    """The pieces stand elsewhere, by a few centimetres."""
    client.world.reset()
    client.world.step(1)
    hands.begin()
    client.world.step(300)
    pieces = [client.wait_for(name) for name in PIECES]
    for piece in pieces:
        angle, push = dice.uniform(0.0, 2.0 * math.pi), dice.uniform(0.0, 2.0)
        piece.set_force(push * math.cos(angle), push * math.sin(angle), 0.0)
    client.world.step(100)
    for piece in pieces:
        piece.clear_cmd()
    client.world.step(500)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=1, help="how often, each from another random start")
    parser.add_argument("--seed", type=int, default=1, help="of the random starts")
    parser.add_argument("--pieces", nargs="+", default=list(PIECES), choices=list(PIECES), help="these only")
    options = parser.parse_args()

    done = 0
    with Client("practice_expert") as client:
        client.world.step(0)  # the world waits for our steps: the same every time
        hands, task = Hands(client), client.get_task("each_in_its_cavity")
        for run in range(options.runs):
            random_start(client, hands, np.random.default_rng(options.seed + run))
            sort_in(client, hands, options.pieces)
            client.world.step(600)
            sorted_in = sum(task.get_goals().values())
            done += sorted_in == len(options.pieces)
            print(
                f"start {options.seed + run}: {sorted_in} of {len(options.pieces)} pieces in {task.get_time():.1f} s, "
                f"{task.get_drops()} drops"
            )
        client.world.release()
    print(f"{done} of {options.runs} done")
    raise SystemExit(0 if done == options.runs else 1)


if __name__ == "__main__":
    main()
