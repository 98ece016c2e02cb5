#!/usr/bin/env python3
"""Drives the rover round a circle, stops it, and says how large the circle was.

Start a simulator (./dev run -l 14), then:
./dev shell -- python ambf_client_py/examples/drive_rover.py
"""

import argparse
import math

import numpy as np
from ambf_client import Client, RigidBody

BASE = 0.60  # m, between the axles
SPEED = 0.4  # m/s


def speed_of(body: RigidBody) -> float:
    velocity = body.get_linear_vel()
    return math.hypot(velocity.x, velocity.y)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steering", type=float, default=0.3, help="rad, positive turns left")
    options = parser.parse_args()

    with Client("drive_rover") as client:
        world = client.world
        rover, chassis = client.wait_for("rover"), client.wait_for("rover_chassis")
        rover.set_steered_wheel_indices([0, 1])
        rover.set_powered_wheel_indices([0, 1, 2, 3])
        world.step(0)  # the world waits for our steps: the same every time

        rover.set_vehicle_steering(options.steering)
        rear = []  # where the middle of the rear axle went
        for _ in range(120):
            x, y, _ = chassis.position
            yaw = chassis.get_rpy()[2]
            rear.append((x - 0.5 * BASE * math.cos(yaw), y - 0.5 * BASE * math.sin(yaw)))
            rover.set_vehicle_power(10.0 * (SPEED - speed_of(chassis)))
            world.step(100)
        rover.set_handbrake(True)
        world.step(2000)

        # The circle through the second half of the way: x^2 + y^2 = 2 a x + 2 b y + c.
        path = np.array(rear[60:])
        lines = np.column_stack([2.0 * path, np.ones(len(path))])
        a, b, c = np.linalg.lstsq(lines, (path**2).sum(axis=1), rcond=None)[0]
        radius, expected = math.sqrt(c + a * a + b * b), abs(BASE / math.tan(options.steering))
        print(f"radius {radius:.3f} m; wheelbase / tan(steering) is {expected:.3f} m")
        print(f"it stands: {speed_of(chassis):.4f} m/s")


if __name__ == "__main__":
    main()
