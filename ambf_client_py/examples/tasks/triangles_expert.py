#!/usr/bin/env python3
"""Carries hollow triangles from peg to peg on the boards of the studies (dissertation, Fig. 7.1 and 7.5a), with hands
that grasp them by friction alone; the simulator's judge says when it is done.

Start a simulator with a board, its task and the hands (docs/tasks.md):
  ./dev run --launch_file ambf_models/descriptions/launch_tasks.yaml -l 5,6,14    # a_b_c_a
  ./dev run --launch_file ambf_models/descriptions/launch_tasks.yaml -l 7,8,14    # opposite_corners
then: ./dev shell -- python ambf_client_py/examples/tasks/triangles_expert.py a_b_c_a --runs 10
"""

import argparse
import math
from typing import NamedTuple

import numpy as np
from ambf_client import Client
from four_hands import ACROSS, Grip, Hands, heading

WALL, CORNER = 0.0925, 0.1762  # m, from a triangle's middle to what fingers press on: a wall, and the corner beyond
NUMBER = 0.010  # m: the plate with a number on a wall
TIPS = -0.08  # m: fingers hold the upper half, and palms stay above the pegs
HIGH = -0.5  # m, of a triangle's lower side that is carried: above the pegs
LOW = 0.008  # m above the base, where it is let go
A, B, C, FAR = (0.27, 0.22, 0.2), (-0.27, 0.9, 0.2), (-0.27, 0.22, 0.2), (-0.521, 0.56, 0.2)  # in the base's frame


def grip(wall: float, plate: float = 0.0) -> Grip:
    """wall: the direction in which it looks (rad, in the triangle's frame)."""
    near, along = WALL + plate, wall + math.pi
    middle = 0.5 * (CORNER - near)
    return Grip(0.5 * (CORNER + near), TIPS, along - ACROSS, (middle * math.cos(along), middle * math.sin(along)))


class Move(NamedTuple):
    piece: str
    place: tuple[float, float, float]
    grip: Grip
    hand: str


LEFT_WALL = math.pi  # it looks along -x; the hand opens along x
FREE_WALL = math.radians(60)  # of triangle 1: beside its other two are neighbours
MOVES = {
    "a_b_c_a": [Move("PuzzleYellow", place, grip(LEFT_WALL), "user1_left") for place in (B, C, A)],
    "opposite_corners": [
        Move("PuzzleRed1", B, grip(FREE_WALL, NUMBER), "user1_left"),
        Move("PuzzleYellow", FAR, grip(LEFT_WALL, NUMBER), "user1_right"),
    ],
}


def carry(client: Client, hands: Hands, moves: list[Move]) -> None:
    base = np.array(client.wait_for("Base").position)
    for move in moves:
        piece = client.wait_for(move.piece)
        hands.pick(move.hand, piece, move.grip, HIGH)
        hands.put(move.hand, piece, base + move.place + (0.0, 0.0, LOW), heading(piece), move.grip)
        client.world.step(600)  # a goal is done once it has lasted for 0.5 s
        if move is moves[-1] or move.hand != moves[-1].hand:
            hands.leave([move.hand])


def random_start(client: Client, hands: Hands, pieces: set[str], dice: np.random.Generator) -> None:
    """The triangles lie on their pegs as they were pushed."""
    client.world.reset()
    client.world.step(1)
    hands.begin()
    client.world.step(700)
    for name in sorted(pieces):
        angle, push = dice.uniform(0.0, 2.0 * math.pi), dice.uniform(0.5, 3.0)
        client.wait_for(name).set_force(push * math.cos(angle), push * math.sin(angle), 0.0)
    client.world.step(100)
    for name in pieces:
        client.wait_for(name).clear_cmd()
    client.world.step(400)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", nargs="?", choices=tuple(MOVES), default="a_b_c_a")
    parser.add_argument("--runs", type=int, default=1, help="how often, each from another random start")
    parser.add_argument("--seed", type=int, default=1, help="of the random starts")
    parser.add_argument("--moves", type=int, default=3, help="so many of its moves only")
    options = parser.parse_args()

    done, moves = 0, MOVES[options.task][: options.moves]
    with Client("triangles_expert") as client:
        client.world.step(0)  # the world waits for our steps: the same every time
        hands, task = Hands(client), client.get_task(options.task)
        for run in range(options.runs):
            random_start(client, hands, {move.piece for move in moves}, np.random.default_rng(options.seed + run))
            carry(client, hands, moves)
            goals = task.get_goals()
            done += sum(goals.values()) == len(moves)
            print(f"start {options.seed + run}: {goals} in {task.get_time():.1f} s, {task.get_drops()} drops")
        client.world.release()
    print(f"{done} of {options.runs} done")
    raise SystemExit(0 if done == options.runs else 1)


if __name__ == "__main__":
    main()
