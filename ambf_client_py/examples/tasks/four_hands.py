"""The hands of studies/four_hands.yaml: they go along straight lines together, and grasp by friction alone. For the
experts beside this file."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from ambf_client import Client, RigidBody
from numpy.typing import ArrayLike, NDArray

FINGER = 0.42  # m, from the palm to the fingers' ends; the last 0.15 m are their pads
SQUEEZE, CLEAR = 0.03, 0.035  # m: so far a target lies inside of what is held, and beside what is about to be held
SPEED, TURNING = 1.2, 2.0  # m/s, rad/s
PART = 10  # steps between commands
ACROSS = 0.5 * math.pi  # a hand that opens along x


class Pose(NamedTuple):
    """Of a hand, fingers down: where its palm is, and how it is turned about z (0: it opens along y)."""

    place: NDArray[np.float64]
    yaw: float


class Grip(NamedTuple):
    """How a thing is held, in its frame."""

    half: float  # m: so wide it is to either side of `middle`
    tips: float  # m: of the fingers, below the frame
    yaw: float = ACROSS
    middle: tuple[float, float] = (0.0, 0.0)


def about_z(yaw: float) -> NDArray[np.float64]:
    c, s = math.cos(yaw), math.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def heading(body: RigidBody) -> float:
    """How a body that stands upright is turned about z."""
    return math.atan2(body.matrix[1, 0], body.matrix[0, 0])


class Hand:
    def __init__(self, client: Client, name: str) -> None:
        self.name = name
        self.body: RigidBody = client.wait_for(f"hands/{name}")
        self.joints = (f"{name}-a", f"{name}-b")
        self.begin()

    def begin(self) -> None:
        """Where it stands after a reset."""
        self.pose = Pose(np.array(self.body.position), 0.0)
        self.home = self.pose

    def open_to(self, half: float) -> None:
        """m, of each finger from the middle."""
        for joint in self.joints:
            self.body.set_joint_pos(joint, half)


class Hands:
    def __init__(self, client: Client) -> None:
        self.world = client.world
        names = (f"{user}_{side}" for user in ("user1", "user2") for side in ("left", "right"))
        self.all = {name: Hand(client, name) for name in names}

    def begin(self) -> None:
        for hand in self.all.values():
            hand.begin()

    def go(self, to: Mapping[str, Pose], wait: int = 100) -> None:
        """All of them at once, and they come to rest together."""
        begin = {name: self.all[name].pose for name in to}
        ways = [float(np.linalg.norm(to[name].place - begin[name].place)) / SPEED for name in to]
        turns = [abs(to[name].yaw - begin[name].yaw) / TURNING for name in to]
        parts = int(1500 * max(*ways, *turns, 0.05) / PART)
        for n in range(1, parts + 1):
            u = n / parts
            share = u * u * (3.0 - 2.0 * u)
            for name, pose in to.items():
                place = begin[name].place + share * (pose.place - begin[name].place)
                self.all[name].body.set_pose([*place, 0, 0, begin[name].yaw + share * (pose.yaw - begin[name].yaw)])
            self.world.step(PART)
        for name, pose in to.items():
            self.all[name].pose = pose
        self.world.step(wait)

    def by(self, names: list[str], way: ArrayLike) -> None:
        """Along a straight line, as they are turned."""
        along = np.asarray(way, dtype=float)
        self.go({name: Pose(self.all[name].pose.place + along, self.all[name].pose.yaw) for name in names})

    def fingers(self, halves: Mapping[str, float]) -> None:
        for name, half in halves.items():
            self.all[name].open_to(half)
        self.world.step(350)

    def carry(self, names: list[str], body: RigidBody, place: ArrayLike, yaw: float) -> None:
        """What they hold together, upright, so that its frame comes to `place`, turned to `yaw` about z."""
        at, turned = np.array(body.position), heading(body)
        turn = math.remainder(yaw - turned, 2.0 * math.pi)
        to = {}
        for name in names:
            pose = self.all[name].pose
            way: NDArray[np.float64] = about_z(turn) @ (pose.place - at)
            to[name] = Pose(np.asarray(place, dtype=float) + way, pose.yaw + turn)
        self.go(to)

    def pick(self, name: str, body: RigidBody, grip: Grip, high: float) -> None:
        """A thing that stands upright; then up until its frame is at the height `high`."""
        turned = heading(body)
        at = np.array(body.position) + about_z(turned) @ (*grip.middle, FINGER - grip.tips)
        yaw = turned + grip.yaw
        self.go({name: Pose(np.array((*at[:2], at[2] + high - body.position[2]), dtype=float), yaw)})
        self.fingers({name: grip.half + CLEAR})
        self.go({name: Pose(at, yaw)})
        self.fingers({name: grip.half - SQUEEZE})
        self.by([name], (0.0, 0.0, high - body.position[2]))

    def put(self, name: str, body: RigidBody, place: ArrayLike, yaw: float, grip: Grip) -> None:
        """What it holds: down to `place` from the height where it is."""
        place = np.array(place)
        for _ in range(2):  # the second time what it sees to be missing
            self.carry([name], body, (place[0], place[1], body.position[2]), yaw)
        self.carry([name], body, place, yaw)
        self.fingers({name: grip.half + CLEAR})
        self.by([name], (0.0, 0.0, 0.6))

    def leave(self, names: list[str]) -> None:
        """Up, and home."""
        hands = {name: self.all[name] for name in names}
        self.go(
            {
                name: Pose(np.array((*each.pose.place[:2], each.home.place[2]), float), 0.0)
                for name, each in hands.items()
            }
        )
        self.go({name: each.home for name, each in hands.items()})
