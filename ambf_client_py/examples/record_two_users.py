#!/usr/bin/env python3
"""Records a session of several users into a bag, and says how well each one's device kept its times.

Everything that moved the tools is in it: each device's Mapping (17 frames, buttons, gains, forces before and after
limits), its hand, the body that it moves, and World/DeviceRates. Between two trials the users' shares are exchanged.

Start a simulator with two input devices, then: ./dev shell -- python ambf_client_py/examples/record_two_users.py
"""

import argparse
import time
from pathlib import Path

from ambf_client import Client
from ambf_tools import read_bag
from ambf_tools.record import Recorder, bag_name

SHARES = (0.8, 0.2), (0.2, 0.8)  # dominance of the first and of the second user, a trial each


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="of each trial")
    parser.add_argument("--folder", type=Path, default=Path("recordings"))
    options = parser.parse_args()

    with Client("record_two_users") as client:
        world = client.world
        users = world.devices()[:2]
        if len(users) < 2:
            raise SystemExit("this needs two input devices: start the simulator with -n 2")
        world_topic = world.get_name()
        topics = [f"{user.topic}/{end}" for user in users for end in ("Mapping", "State")]
        topics += [f"{user.effector}/State" for user in users] + [f"{world_topic}/DeviceRates"]
        with Recorder(options.folder / bag_name("example", "two_users"), topics) as recorder:
            recorder.ready(len(set(topics)))
            for shares in SHARES:
                for user, share in zip(users, shares, strict=True):
                    world.set_device(user.name, "dominance", share)
                print(", ".join(f"{user.name}: {share}" for user, share in zip(users, shares, strict=True)))
                time.sleep(options.seconds)
            for user in users:
                world.set_device(user.name, "dominance", 0.5)

    status = recorder.status
    print(f"{recorder.path}: {status.messages} messages, {status.lost} lost")
    report(recorder.path, f"{world_topic}/DeviceRates")


def report(path: Path, topic: str) -> None:
    """Prints the times of the whole run, as the last message of World/DeviceRates has them."""
    with read_bag.open(path) as bag:
        *_, (_, rates, _) = bag.messages(topic)
    for device in rates.devices:
        period, age = device.period, device.set_point_age
        print(
            f"{device.name}: {device.rate:.0f} Hz, period p99.9 {1e3 * period.p999:.2f} ms, max "
            f"{1e3 * period.max:.2f} ms; a sample is obeyed after {1e3 * age.p50:.2f} ms, p99.9 "
            f"{1e3 * age.p999:.2f} ms; {device.faults} faults"
        )


if __name__ == "__main__":
    main()
