#!/usr/bin/env python3
"""Two hands draw a thread to and fro round two pegs, as in the dissertation's Fig. 6.12.

Start a simulator (./dev run -l 26), then: ./dev shell -- python ambf_client_py/examples/draw_thread.py
One hand holds firmly and goes back, while the thread runs through the jaws of the other one; then they change.
"""

import argparse
import math
import time

from ambf_client import Client

FIRM, LOOSE = 0.0065, 0.018  # m, of each finger
TAUT, FAR = 0.010, 0.055  # m, of a hand from where it begins
STEP_S = 0.02


class Operator:
    def __init__(self, client: Client, paced: bool) -> None:
        self.world, self.paced = client.world, paced
        self.stand, self.middle = client.wait_for("stand"), client.wait_for("/ambf/env/thread/link26")

    def step(self) -> None:
        self.world.step(round(STEP_S * 1000))
        if self.paced:
            time.sleep(STEP_S)

    def move(self, goals: dict[str, float], seconds: float) -> None:
        """Joints to their goals, evenly."""
        begin = {joint: self.stand.get_joint_pos(joint) for joint in goals}
        steps = max(1, round(seconds / STEP_S))
        for n in range(1, steps + 1):
            for joint, goal in goals.items():
                self.stand.set_joint_pos(joint, begin[joint] + (goal - begin[joint]) * n / steps)
            self.step()

    def grip(self, hand: str, opening: float) -> None:
        self.move({f"{hand}-a": opening, f"{hand}-b": opening}, 0.3)

    def draw(self, hand: str, other: str) -> float:
        """How far the thread came along, m."""
        self.grip(other, LOOSE)
        self.grip(hand, FIRM)
        begin = self.middle.position
        self.move({f"{hand}-pull": FAR}, 1.5)
        self.move({}, 0.3)
        came = math.dist(begin, self.middle.position)
        self.grip(other, FIRM)
        self.grip(hand, LOOSE)
        self.move({f"{hand}-pull": TAUT}, 1.0)
        self.grip(hand, FIRM)
        return came


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--strokes", type=int, default=2)
    parser.add_argument("--fast", action="store_true", help="not in real time")
    options = parser.parse_args()

    with Client("draw_thread") as client:
        operator = Operator(client, not options.fast)
        operator.move({"left_hand-pull": TAUT, "right_hand-pull": TAUT}, 0.8)
        hands = ("right_hand", "left_hand")
        for number in range(options.strokes):
            hand, other = hands[number % 2], hands[(number + 1) % 2]
            print(f"the {hand} drew {1000 * operator.draw(hand, other):.0f} mm")


if __name__ == "__main__":
    main()
