#!/usr/bin/env python3
"""Reports what happens at the suturing scene: entries and exits of the needle, how deep it went, hand-overs.

Start a simulator: ./dev run --launch_file ambf_models/suturing/launch.yaml -l 0,1,2,3,4,5
Then: ./dev shell -- python ambf_client_py/examples/suturing_evaluation.py

Works with every scene that has bodies of these names, so with those of AMBF 3.0's suites, too.
"""

import argparse
import time
from dataclasses import dataclass

import numpy as np
from ambf_client import Actuator, Client, RigidBody
from numpy.typing import NDArray

TIP = np.array((0.00662, 0.00697, 0.0, 1.0))  # of the needle, in its frame (m)
HOLES = [f"{kind}{number}" for number in range(1, 5) for kind in ("Entry", "Exit")]
BOUND = 0.005  # m: on each axis of a hole's frame; its z points out of the tissue
RATE = 100.0  # samples a second


@dataclass
class Passage:
    """The tip went through a hole: into the tissue (entry), or out of it."""

    hole: str
    entry: bool
    sim_time: float  # s
    lateral: float  # m, from the hole's middle


class Evaluation:
    """What happened so far. Call sample() about 100 times a second."""

    def __init__(self, needle: RigidBody, holes: dict[str, RigidBody], grips: dict[str, Actuator]) -> None:
        self.needle, self.holes, self.grips = needle, holes, grips
        self.passages: list[Passage] = []
        self.depth = dict.fromkeys(holes, 0.0)  # m, max below each hole
        self.hand_overs: list[tuple[str, str]] = []
        self._before: dict[str, NDArray[np.float64]] = {}
        self._holder = ""

    def sample(self) -> list[Passage]:
        """Takes the present states; returns what is new among the passages."""
        tip, new = self.needle.matrix @ TIP, []
        for name, hole in self.holes.items():
            now = (np.linalg.inv(hole.matrix) @ tip)[:3]
            inside = bool(np.all(np.abs(now) <= BOUND))
            before = self._before.pop(name, None)
            if inside:
                self.depth[name] = max(self.depth[name], -now[2])
                if before is not None and before[2] * now[2] < 0.0:
                    lateral = float(np.hypot(now[0], now[1]))
                    new.append(Passage(name, now[2] < 0.0, self.needle.get_sim_time(), lateral))
                self._before[name] = now
        self.passages += new
        holders = [name for name, grip in self.grips.items() if grip.is_actuated()]
        if len(holders) == 1:
            if self._holder not in ("", holders[0]):
                self.hand_overs.append((self._holder, holders[0]))
            self._holder = holders[0]
        elif not holders:
            self._holder = ""  # put down: no hand-over
        return new


def evaluation_of(client: Client) -> Evaluation:
    """Of the scene that the client is connected to."""
    grips = {psm: client.wait_for(f"{psm}/Actuator0") for psm in ("psm1", "psm2")}
    return Evaluation(client.wait_for("Needle"), {name: client.wait_for(name) for name in HOLES}, grips)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=float("inf"), help="how long to watch (default: until Ctrl-C)")
    options = parser.parse_args()
    with Client("suturing_evaluation") as client:
        evaluation = evaluation_of(client)
        print(f"watching {len(evaluation.holes)} holes")
        rate, end = client.create_rate(RATE), time.monotonic() + options.seconds
        reported = 0
        while not client.is_shutdown() and time.monotonic() < end:
            for passage in evaluation.sample():
                way = "into" if passage.entry else "out of"
                print(f"{passage.sim_time:.3f} s: {way} {passage.hole}, {1e3 * passage.lateral:.1f} mm aside")
            for giver, taker in evaluation.hand_overs[reported:]:
                print(f"{giver} handed the needle to {taker}")
            reported = len(evaluation.hand_overs)
            rate.sleep()
        for name, depth in evaluation.depth.items():
            if depth > 0.0:
                print(f"{name}: {1e3 * depth:.1f} mm deep")


if __name__ == "__main__":
    main()
