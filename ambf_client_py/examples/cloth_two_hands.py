#!/usr/bin/env python3
"""Two hands pick up a cloth by two corners: they come down, close their jaws, lift it, and let it go.

Start a simulator (./dev run -l 29), then: ./dev shell -- python ambf_client_py/examples/cloth_two_hands.py
A hand whose jaw is closed holds the nodes of the cloth that the rays of its sensor meet.
"""

import time

from ambf_client import Client

HANDS = ("left_hand", "right_hand")
DOWN, UP = -0.1095, 0.10  # m, of the lifts
OPEN, CLOSED = 0.030, 0.004  # m, of each finger


def main() -> None:
    with Client("cloth_two_hands") as client:
        world = client.world
        stand, cloth = client.wait_for("stand"), client.wait_for("cloth")
        eyes = {hand: client.wait_for(f"{hand}_eyes") for hand in HANDS}
        grips = {hand: client.wait_for(f"{hand}_grip") for hand in HANDS}

        def move(joints: dict[str, tuple[float, float]], seconds: float) -> None:
            """All of them evenly from one value to another."""
            steps = int(100 * seconds)
            for n in range(1, steps + 1):
                for hand in HANDS:
                    for joint, (begin, goal) in joints.items():
                        stand.set_joint_pos(f"{hand}-{joint}", begin + (goal - begin) * n / steps)
                world.step(10)
            world.step(500)
            time.sleep(0.3)  # until the topics have what the last step made

        try:
            world.step(10)  # the world waits for our steps
            low = float(cloth.get_nodes()[:, 2].min())
            move({"a": (OPEN, OPEN), "b": (OPEN, OPEN), "lift": (0.0, DOWN)}, 1.5)
            for hand in HANDS:
                print(f"{hand} sees {eyes[hand].get_sensed_object(0)}")
            move({"a": (OPEN, CLOSED), "b": (OPEN, CLOSED), "lift": (DOWN, DOWN)}, 0.5)
            print("held by", [hand for hand in HANDS if grips[hand].is_actuated()])
            move({"a": (CLOSED, CLOSED), "b": (CLOSED, CLOSED), "lift": (DOWN, UP)}, 2.0)
            print(f"corners lifted by {1e3 * (cloth.get_nodes()[:, 2].max() - low):.0f} mm")
            move({"a": (CLOSED, OPEN), "b": (CLOSED, OPEN), "lift": (UP, UP)}, 0.5)
            world.step(1000)
            time.sleep(0.3)
            print("let go" if not any(grips[hand].is_actuated() for hand in HANDS) else "still held")
            print(f"fell to {1e3 * (cloth.get_nodes()[:, 2].max() - low):.0f} mm")
        finally:
            world.release()


if __name__ == "__main__":
    main()
