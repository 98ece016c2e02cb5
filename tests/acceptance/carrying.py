"""A ring of the default scene, carried to another peg by the right gripper, whatever device moves the hand."""

import time

from harness import SLOWNESS, eventually

FREE_PEG = (-0.03, 0.031)  # x, y in the world, m
# From the ring's middle to the gripper that grasps the ring at its right: the inner jaw is between ring and peg.
GRASP_RIGHT = 0.011
GRASP_HEIGHT, CARRY_HEIGHT = 0.048, 0.09  # of the gripper's pin: jaws 20 mm long about the ring; over all pegs
ON_A_PEG = 0.034  # m: rings below are on the board, 6 mm thick
NEAR = 0.0015  # m


class Carrier:
    """Somebody who sees the scene and moves the hand until the gripper is where it should be.

    hand.nudge(dx, dy, dz): moves the hand by so many metres towards the operator, to the right, upwards, roughly;
    hand.close_jaw(), hand.open_jaw().
    """

    def __init__(self, ros, hand):
        from ambf_msgs.msg import RigidBodyState

        self.hand = hand
        self.states = {
            name: ros.listen(f"/ambf/env/{name}/State", RigidBodyState) for name in ("right_gripper", "ring2")
        }

    def place(self, name):
        position = self.states[name].last().pose.position
        return position.x, position.y, position.z

    def settle(self):
        """Once the gripper rests; what a window sees takes two pictures to arrive."""
        time.sleep(0.3 * SLOWNESS)

        def rests():
            before = self.place("right_gripper")
            time.sleep(0.1)
            return max(abs(a - b) for a, b in zip(before, self.place("right_gripper"), strict=True)) < 2e-4

        eventually(rests, 10.0, "the gripper rests")

    def bring(self, name, x=None, y=None, z=None):
        """Moves until the gripper, or the ring in it, is there."""
        missing = []
        for _ in range(40):
            missing = [0.0 if to is None else to - at for to, at in zip((x, y, z), self.place(name), strict=True)]
            if max(map(abs, missing)) < NEAR:
                return
            self.hand.nudge(*missing)
            self.settle()
        raise AssertionError(f"{name} does not come closer than {missing} m")

    def jaw(self):
        return sum(self.states["right_gripper"].last().joint_positions)

    def carry(self):
        x, y, _ = self.place("ring2")
        self.bring("right_gripper", x, y + GRASP_RIGHT)
        self.bring("right_gripper", z=GRASP_HEIGHT)
        opening = self.jaw()
        self.hand.close_jaw()
        eventually(lambda: self.jaw() < 0.6 * opening, 10.0, "the jaw closes")
        self.settle()
        self.bring("right_gripper", z=CARRY_HEIGHT)
        assert self.place("ring2")[2] > 0.06, f"the gripper lifts the ring: it is at {self.place('ring2')}"
        self.bring("ring2", *FREE_PEG)
        self.bring("right_gripper", z=GRASP_HEIGHT)
        closed = self.jaw()
        self.hand.open_jaw()
        eventually(lambda: self.jaw() > closed + 0.2, 10.0, "the jaw opens")
        self.bring("right_gripper", z=CARRY_HEIGHT)
        eventually(lambda: self.place("ring2")[2] < ON_A_PEG, 10.0, "the ring drops")
        x, y, _ = self.place("ring2")
        assert abs(x - FREE_PEG[0]) < 0.005 and abs(y - FREE_PEG[1]) < 0.005, f"the ring is not on the peg: {x}, {y}"
