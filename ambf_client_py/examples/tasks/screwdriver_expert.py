#!/usr/bin/env python3
"""Turns the tilted disc of the original's screwdriver scene (dissertation, Fig. 6.11) by half a turn: a hand takes the
screwdriver by friction alone, puts its crossed tips between the disc's blocks and turns; the simulator's judge says
when it is done.

Start a simulator with the scene, its task and the hands (docs/tasks.md):
  ./dev run --launch_file ambf_models/studies/launch_screwdriver_env.yaml -l 0,1,2
then: ./dev shell -- python ambf_client_py/examples/tasks/screwdriver_expert.py --runs 10
"""

import argparse
import math
from typing import NamedTuple

import numpy as np
from ambf_client import Client, RigidBody
from four_hands import CLEAR, FINGER, PART, SQUEEZE, Hand, Hands, Pose, about_z, heading
from numpy.typing import NDArray

HAND = "user2_right"
HANDLE, TOP = 0.075, 0.3245  # m: its radius, and its upper end above its frame
BELOW_PALM = 0.03  # m, of that end
ON_DISC = 0.865  # m, of the handle's frame from the disc's, where the tips are between the blocks
OVER = 0.15  # m above that: above the blocks
SPEED, TURNING = 0.6, 0.8  # m/s, rad/s
QUARTER = 0.5 * math.pi


class Held(NamedTuple):
    """Where the tool is: its handle's frame, how far it leans about y, and how far it is turned about its own axis."""

    place: NDArray[np.float64]
    lean: float
    turn: float

    def matrix(self) -> NDArray[np.float64]:
        c, s = math.cos(self.lean), math.sin(self.lean)
        pose = np.identity(4)
        pose[:3, :3] = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]]) @ about_z(self.turn)
        pose[:3, 3] = self.place
        return pose


class Disc:
    def __init__(self, client: Client) -> None:
        self.base, self.body = client.wait_for("ScrewDriverEnv/FixedBase"), client.wait_for("ScrewDriverEnv/Cylinder")
        self.middle: NDArray[np.float64] = np.array(self.body.position)
        self.normal: NDArray[np.float64] = self.base.matrix[:3, 2]
        self.lean = math.atan2(self.normal[0], self.normal[2])

    def angle(self) -> float:
        """To the left, as seen from above, from where it is loaded (rad)."""
        return heading_of(self.base.matrix[:3, :3].T @ self.body.matrix[:3, :3])

    def above(self, way: float) -> NDArray[np.float64]:
        place: NDArray[np.float64] = self.middle + (ON_DISC + way) * self.normal
        return place


def heading_of(turned: NDArray[np.float64]) -> float:
    return math.atan2(turned[1, 0], turned[0, 0])


class Driver:
    """A hand and the tool in it."""

    def __init__(self, client: Client, hand: Hand, tool: RigidBody) -> None:
        self.world, self.hand, self.tool = client.world, hand, tool

    def take(self, hands: Hands) -> None:
        """From above, as it stands."""
        yaw, place = heading(self.tool), np.array(self.tool.position)
        palm = place + (0.0, 0.0, TOP + BELOW_PALM)
        hands.fingers({HAND: HANDLE + CLEAR})
        hands.go({HAND: Pose(palm + (0.0, 0.0, FINGER + 0.1), yaw)})
        hands.go({HAND: Pose(palm, yaw)})
        hands.fingers({HAND: HANDLE - SQUEEZE})
        self.at = Held(place, 0.0, yaw)
        self.commanded = self.at._replace(place=palm).matrix()

    def to_tool(self, tool: NDArray[np.float64], from_tool: NDArray[np.float64]) -> None:
        self.commanded = tool @ from_tool
        self.hand.body.set_pose(self.commanded)
        self.world.step(PART)

    def lead(self, to: Held, wait: int = 200) -> None:
        """The tool along a straight line, from where it should be. Where it is for what the hand was commanded, the
        give of hand and grasp included, is looked at first."""
        from_tool = np.linalg.inv(self.tool.matrix) @ self.commanded
        begin = self.at
        way = float(np.linalg.norm(to.place - begin.place)) / SPEED
        parts = int(1500 * max(way, abs(to.lean - begin.lean), abs(to.turn - begin.turn), 0.05 / SPEED) / PART)
        for n in range(1, parts + 1):
            u = n / parts
            u = u * u * (3.0 - 2.0 * u)
            now = Held(
                begin.place + u * (to.place - begin.place),
                begin.lean + u * (to.lean - begin.lean),
                begin.turn + u * (to.turn - begin.turn),
            )
            self.to_tool(now.matrix(), from_tool)
        self.at = to
        self.world.step(wait)

    def turn_disc(self, disc: Disc, goal: float) -> None:
        """Until the disc is turned so far; half a turn more at most."""
        from_tool = np.linalg.inv(self.tool.matrix) @ self.commanded
        begin, parts = self.at.turn, int(1000 * 1.5 * math.pi / TURNING / PART)
        for _ in range(parts):
            if disc.angle() % (2.0 * math.pi) >= goal and self.at.turn - begin > QUARTER:
                break
            self.at = self.at._replace(turn=self.at.turn + TURNING * PART * 1e-3)
            self.to_tool(self.at.matrix(), from_tool)
        self.world.step(200)


def drive(client: Client, hands: Hands) -> None:
    disc = Disc(client)
    driver = Driver(client, hands.all[HAND], client.wait_for("ScrewDriverEnv/SDHandle"))
    driver.take(hands)
    hold(driver.tool, None)
    x, y, z = driver.at.place
    driver.lead(driver.at._replace(place=np.array((x, y, z + 0.1))))
    for above in (OVER, OVER, OVER, 0.0):  # again what it sees to be missing
        # Tips and slots look alike after a quarter of a turn.
        turn = disc.angle() + QUARTER * round((driver.at.turn - disc.angle()) / QUARTER)
        driver.lead(Held(disc.above(above), disc.lean, turn), wait=400)
    driver.turn_disc(disc, math.pi - 0.05)


def hold(tool: RigidBody, pose: NDArray[np.float64] | None) -> None:
    """As a helper holds it up, or lets it go."""
    if pose is None:
        tool.clear_cmd()
    else:
        tool.set_pose(pose)


def random_start(client: Client, hands: Hands, dice: np.random.Generator) -> None:
    """The screwdriver hangs above the disc, held up until the hand has it, and the disc is turned a little."""
    client.world.reset()
    client.world.step(1)
    hands.begin()
    tool, disc = client.wait_for("ScrewDriverEnv/SDHandle"), client.wait_for("ScrewDriverEnv/Cylinder")
    at = Held(np.array((-1.211, 0.0, 0.124)) + dice.uniform(-0.05, 0.05, 3), 0.0, dice.uniform(-0.3, 0.3))
    hold(tool, at.matrix())
    push = dice.uniform(-0.3, 0.3)
    disc.set_torque(push * math.sin(0.262), 0.0, push * math.cos(0.262))
    client.world.step(300)
    disc.clear_cmd()
    client.world.step(1200)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=1, help="how often, each from another random start")
    parser.add_argument("--seed", type=int, default=1, help="of the random starts")
    options = parser.parse_args()

    done = 0
    with Client("screwdriver_expert") as client:
        client.world.step(0)  # the world waits for our steps: the same every time
        hands, task = Hands(client), client.get_task("turn_the_disc")
        for run in range(options.runs):
            random_start(client, hands, np.random.default_rng(options.seed + run))
            drive(client, hands)
            success = task.wait_for_success(timeout=5.0)
            done += success
            print(
                f"start {options.seed + run}: {'done' if success else task.get_goals()} in {task.get_time():.1f} s, "
                f"{task.get_drops()} drops"
            )
        client.world.release()
    print(f"{done} of {options.runs} done")
    raise SystemExit(0 if done == options.runs else 1)


if __name__ == "__main__":
    main()
