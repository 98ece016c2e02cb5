#!/usr/bin/env python3
"""Two hands lift a weight by a suture thread over two pegs and let it down: friction on the pegs makes the pull differ.

Start a simulator (./dev run -l 32), then: ./dev shell -- python ambf_client_py/examples/lift_by_thread.py
In the end the hands open, and the thread runs over the pegs.
"""

import math
import time

import numpy as np
from ambf_client import Client

HANDS = ("left_hand", "right_hand")
FAR = 0.016  # m, of a hand
OPEN = 0.35  # rad, of each jaw
FRICTION = 0.4 * 0.5  # of the thread, times that of the stand
PEG = 0.040 - 0.006  # m from the middle to a peg


def main() -> None:
    with Client("lift_by_thread") as client:
        world = client.world
        stand, thread, weight = (client.wait_for(name) for name in ("stand", "thread", "weight"))
        grips = {hand: client.wait_for(f"{hand}_grip") for hand in HANDS}

        def pull(begin: float, goal: float) -> float:
            """Both hands evenly, 2 cm/s; what each pulls with on average once they stand, N."""
            steps = round(abs(goal - begin) / 2e-4)
            for n in range(1, steps + 1):
                for hand in HANDS:
                    stand.set_joint_pos(f"{hand}-pull", begin + (goal - begin) * n / steps)
                world.step(10)
            world.step(50)
            pulls = []
            for _ in range(15):
                world.step(10)
                pulls += [abs(stand.get_joint_effort(f"{hand}-pull")) for hand in HANDS]
            return float(np.mean(pulls))

        def settle(steps: int) -> float:
            """Height of the weight, m."""
            world.step(steps)
            time.sleep(0.3)  # until the topics have what the last step made
            return float(weight.get_pos().z)

        try:
            low = settle(150)
            print("held by", [hand for hand in HANDS if grips[hand].is_actuated()])
            nodes = thread.get_nodes()
            print(f"{len(nodes)} nodes, {1e3 * np.linalg.norm(np.diff(nodes, axis=0), axis=1).sum():.1f} mm long")
            up = pull(0.0, FAR / 2)
            half = thread.get_nodes()
            pull(FAR / 2, FAR)
            high = settle(1)
            print(f"lifted by {1e3 * (high - low):.1f} mm")
            down = pull(FAR, FAR / 2)
            middle, hand = half[len(half) // 2], half[-1]
            angle = math.atan2(hand[2] - middle[2], PEG - middle[1])  # of the thread round each peg
            print(f"half-way {up:.3f} N after lifting, {down:.3f} N after letting down:", end=" ")
            print(f"{up / down:.2f} times, expected {math.exp(2 * FRICTION * angle):.2f}")
            before = settle(1)
            for hand in HANDS:
                for jaw in ("a", "b"):
                    stand.set_joint_pos(f"{hand}-jaw_{jaw}", OPEN)
            fell = before - settle(500)
            print(f"let go: the weight fell by {1e3 * fell:.1f} mm")
        finally:
            world.release()


if __name__ == "__main__":
    main()
