#!/usr/bin/env python3
"""Moves all joints of an arm along sinusoids, each with its own period, and prints the tracking errors.

Start a simulator with the arm (./dev run -l 2), then: ./dev shell -- python ambf_client_py/examples/joint_sinusoids.py
"""

import argparse
import time

import numpy as np
from ambf_client import Client


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("base", nargs="?", default="arm7/base", help="the body below which the joints are")
    parser.add_argument("--amplitude", type=float, default=0.3, help="rad (m for sliding joints: a tenth of it)")
    parser.add_argument("--seconds", type=float, default=10.0)
    options = parser.parse_args()

    with Client("joint_sinusoids") as client:
        base = client.wait_for(options.base)
        names = base.get_joint_names()
        sliding = {joint.name for joint in client.list().joints if joint.type == "prismatic"}
        amplitude = np.array([options.amplitude * (0.1 if full_name(name, sliding) else 1.0) for name in names])
        period = np.linspace(3.0, 5.0, len(names))  # s
        middle = base.joint_positions
        errors = np.zeros(len(names))

        begin = time.monotonic()
        while (t := time.monotonic() - begin) < options.seconds:
            target = middle + amplitude * np.sin(2.0 * np.pi * t / period)
            base.set_joint_pos(target)  # one value a joint, in the order of the names
            errors = np.maximum(errors, np.abs(base.joint_positions - target))
            time.sleep(0.005)

        base.set_joint_pos(middle)
        time.sleep(1.0)
        for name, error in zip(names, errors, strict=True):
            print(f"{name}: largest error {error:.4f}")


def full_name(joint: str, among: set[str]) -> bool:
    """Whether a joint, named without its namespace, is among these."""
    return any(name == joint or name.endswith("/" + joint) for name in among)


if __name__ == "__main__":
    main()
