#!/usr/bin/env python3
"""Two hands drive a screw, as in the dissertation's Fig. 6.11: one turns the screwdriver while it turns in the other.

Start a simulator (./dev run -l 13), then: ./dev shell -- python ambf_client_py/examples/turn_screwdriver.py
A stroke: the helping hand loosens its grip and the main hand turns; then the helping hand holds, and the main hand
goes back around the handle.
"""

import argparse
import math
import time

from ambf_client import Client

FIRM, LOOSE = 0.016, 0.0238  # m, of each finger: the deeper the rays reach, the more friction they have
STROKE = 2.0  # rad
SPEED = 1.0  # rad/s


class Operator:
    def __init__(self, client: Client) -> None:
        self.stand, self.tool = client.wait_for("stand"), client.wait_for("tool")

    def grip(self, hand: str, opening: float) -> None:
        for finger in "ab":
            self.stand.set_joint_pos(f"{hand}-{finger}", opening)
        time.sleep(0.5)

    def turn(self, goal: float) -> None:
        """The main hand's wrist, evenly."""
        begin = self.stand.get_joint_pos("wrist")
        steps = round(abs(goal - begin) / SPEED / 0.02)
        for n in range(1, steps + 1):
            self.stand.set_joint_pos("wrist", begin + (goal - begin) * n / steps)
            time.sleep(0.02)
        time.sleep(0.5)

    def angles(self) -> dict[str, float]:
        """Of the handle in each hand, rad. The helping hand does not turn."""
        yaw = self.tool.rpy[2]
        return {"main_hand": yaw - self.stand.get_joint_pos("wrist"), "helping_hand": yaw}

    def stroke(self, firm: str, loose: str, goal: float) -> str:
        self.grip(firm, FIRM)
        self.grip(loose, LOOSE)
        before = self.angles()
        self.turn(goal)
        after = self.angles()
        slip = {hand: abs(math.degrees(math.remainder(after[hand] - before[hand], math.tau))) for hand in before}
        return f"{slip[loose]:.1f} degrees in the loose hand, {slip[firm]:.2f} degrees in the firm one"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--strokes", type=int, default=2)
    options = parser.parse_args()

    with Client("turn_screwdriver") as client:
        operator = Operator(client)
        operator.stroke("helping_hand", "main_hand", -STROKE / 2)  # to where a stroke begins
        screw = operator.stand.get_joint_pos("thread")
        wall, simulated = time.monotonic(), client.world.get_sim_time()
        for number in range(1, options.strokes + 1):
            print(f"stroke {number} drives:", operator.stroke("main_hand", "helping_hand", STROKE / 2))
            print(f"stroke {number} goes back:", operator.stroke("helping_hand", "main_hand", -STROKE / 2))
        factor = (client.world.get_sim_time() - simulated) / (time.monotonic() - wall)
        turned = math.degrees(operator.stand.get_joint_pos("thread") - screw)
        print(f"the screw turned by {turned:.0f} degrees, real-time factor {factor:.4f}")


if __name__ == "__main__":
    main()
