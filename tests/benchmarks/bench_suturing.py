"""The suturing scene as programs of AMBF 3.0 use it: grasps, and time while the needle is pulled.

--cycles: open, approach, close, lift, move, release, by ghosts and actuator from random poses, in steps of the Step
service, so that the load of the machine does not count. Held without slip while closed, released within 50 ms, no jump
above 0.1 mm, no body lost.

--seconds: `-p 200 -t1`, states at 100 Hz, while an arm pulls the needle with its thread at 0.1 m/s: real-time factor
1.000 +-0.005, states at 100 +-1 Hz.
"""

import argparse
import os
import time

import numpy as np
import support
from harness import Simulator

SUTURING = support.ROOT / "ambf_models/suturing/launch.yaml"
ARGUMENTS = ("--launch_file", SUTURING, "-l", "0,1,2,3,4,5")
FLAGS = ("-p", "200", "-t1", "--override_max_comm_freq", "100", "--override_min_comm_freq", "100")
NEEDLE_BASE = np.array((-0.00951, 0.00103, 0.0))  # m, in the needle's frame
GRIP = np.array((0.0, -0.0102, 0.0, 1.0))  # in toolyawlink's
OPEN, CLOSED = 0.5, 0.0  # rad
JUMP_M, RELEASE_STEPS, SLIP = 1e-4, 50, 1e-6
SCENE_M = 0.5  # where all bodies are, from the needle's place


class Arm:
    def __init__(self, client, name):
        self.world, self.needle = client.world, client.wait_for("Needle")
        parts = (f"{name}/{part}" for part in ("baselink", "toolyawlink", "Actuator0"))
        self.base, self.wrist, self.actuator = map(client.wait_for, parts)
        self.ghosts = [client.wait_for(f"{name}/{side}_finger_ghost") for side in ("left", "right")]

    def move(self, q, steps):
        for joint, value in enumerate(q):
            self.base.set_joint_pos(joint, float(value))
        self.world.step(steps)

    def jaw(self, angle, steps=150):
        for joint in (6, 7):
            self.base.set_joint_pos(joint, angle)
        self.world.step(steps)

    def bring_needle(self):
        pose = np.identity(4)
        pose[:3, :3] = self.wrist.matrix[:3, :3]
        pose[:3, 3] = (self.wrist.matrix @ GRIP)[:3] - pose[:3, :3] @ NEEDLE_BASE
        self.needle.set_pose(pose)
        self.world.step(700)

    def held(self):
        return np.linalg.inv(self.wrist.matrix) @ self.needle.matrix

    def grasp(self):
        """What both fingers' ghosts feel of the needle is held; whether anything was."""
        now = self.world.get_sim_step()
        for ghost in self.ghosts:
            ghost.wait_for_sim_step(now, 10.0)
        names = [name for ghost in self.ghosts for name in ghost.get_all_sensed_obj_names() if "Needle" in name]
        if names:
            self.actuator.actuate(names[0])
        return bool(names)


def cycle(arm, random):
    """(whether it was grasped, its jump, its slip (m), steps until it is released)."""
    aside = random.uniform(-0.2, 0.2, 6) * (1, 1, 0.05, 1, 1, 1)
    arm.jaw(OPEN, 1)
    arm.move(np.array((0.0, 0.0, 0.13, 0.0, 0.0, 0.0)) + aside, 600)
    arm.bring_needle()
    arm.jaw(CLOSED)
    grasped = arm.grasp()
    arm.needle.set_force(0.0, 0.0, 0.0)  # ends the pose command
    jump, before = 0.0, arm.needle.matrix[:3, 3]
    for _ in range(5):
        arm.world.step(1)
        now = arm.needle.matrix[:3, 3]
        jump, before = max(jump, float(np.linalg.norm(now - before))), now
    held = arm.held()
    arm.move((*(aside[:2] + random.uniform(-0.1, 0.1, 2)), 0.12), 300)  # lifts
    arm.move(random.uniform(-0.2, 0.2, 2), 400)
    slip = float(np.abs(arm.held() - held).max())
    arm.actuator.deactuate()
    steps = 0
    while arm.actuator.is_actuated() and steps < 10 * RELEASE_STEPS:
        arm.world.step(1)
        steps += 1
    arm.jaw(OPEN, 100)
    return grasped, jump, slip, steps


def cycles(client, count):
    random, arms = np.random.default_rng(17), [Arm(client, name) for name in ("psm1", "psm2")]
    rows = np.array([cycle(arms[i % 2], random) for i in range(count)], dtype=float)
    names = [name for name in client.get_obj_names() if "phantom" in name and "ghost" not in name]
    places = [client.wait_for(name).matrix[:3, 3] for name in names]
    lost = [name for name, place in zip(names, places, strict=True) if not np.linalg.norm(place) < SCENE_M]
    held, released = int(np.sum(rows[:, 0] * (rows[:, 2] < SLIP))), int(np.sum(rows[:, 3] <= RELEASE_STEPS))
    head = ["cycles", "held", "largest slip m", "largest jump mm", "released within 50 ms", "lost"]
    support.table(
        [[count, held, f"{rows[:, 2].max():.1e}", f"{1e3 * rows[:, 1].max():.3f}", released, len(lost)]], head
    )
    return held == released == count and rows[:, 1].max() < JUMP_M and not lost


def real_time(client, seconds):
    """Pulls the needle up and down at 0.1 m/s, in real time."""
    arm = Arm(client, "psm1")
    arm.jaw(OPEN, 1)
    arm.move((0.0, 0.0, 0.13, 0.0, 0.0, 0.0), 600)
    arm.bring_needle()
    arm.jaw(CLOSED)
    grasped = arm.grasp()
    arm.needle.set_force(0.0, 0.0, 0.0)
    client.world.step(20)
    client.world.release()
    count = [0]
    counter = client.get_ral().subscriber(
        arm.needle.get_name() + "/State", type(arm.needle._state), lambda _: count.__setitem__(0, count[0] + 1)
    )
    time.sleep(1.0)
    count[0], watch, began = 0, support.Watch(), arm.needle.get_sim_time()
    rate = client.create_rate(120)
    while watch.seconds < seconds:
        phase = (watch.seconds % 0.6) / 0.3  # 3 cm up, 3 cm down
        arm.base.set_joint_pos(2, 0.13 - 0.03 * (phase if phase < 1.0 else 2.0 - phase))
        rate.sleep()
    wall, simulated, states = watch.seconds, arm.needle.get_sim_time() - began, count[0]
    busy, stolen = watch.shares()
    counter.unregister()
    held = grasped and arm.actuator.is_actuated()
    head = ["seconds", "real-time factor", "states/s", "held", "machine busy %", "stolen %"]
    row = [f"{wall:.0f}", f"{simulated / wall:.4f}", f"{states / wall:.1f}", held, f"{100 * busy:.0f}"]
    support.table([[*row, f"{100 * stolen:.1f}"]], head)
    return held


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cycles", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=20.0)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    from ambf_client import Client

    with support.scratch() as folder:
        simulator = Simulator(folder, *ARGUMENTS, *FLAGS, master_uri=master.uri)
        simulator.wait_loaded(6)
        client = Client("bench_suturing", 5)
        client.connect()
        good = cycles(client, options.cycles) if options.cycles else True
        good = (real_time(client, options.seconds) if options.seconds else True) and good
        client.clean_up()
        simulator.stop()
    master.kill()
    raise SystemExit(0 if good else 1)


if __name__ == "__main__":
    main()
