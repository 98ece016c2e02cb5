#!/usr/bin/env python3
"""Lets a camera follow a body: where the body goes, the camera goes, smoothly.

Start a simulator (./dev run), then: ./dev shell -- python ambf_client_py/examples/camera_follow.py left_gripper
and move that body, e.g. with move_body.py or with the mouse.
"""

import argparse
import time

from ambf_client import Client


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("body", nargs="?", default="left_gripper")
    parser.add_argument("--camera", default="main_camera")
    parser.add_argument("--smoothing", type=float, default=0.3, help="s")
    parser.add_argument("--seconds", type=float, default=30.0)
    options = parser.parse_args()

    with Client("camera_follow") as client:
        body = client.wait_for(options.body)
        camera = client.wait_for(options.camera)
        distance = camera.position - body.position  # stays what it is now
        position = camera.position
        period = 0.02  # s
        print(f"{camera.get_name()} follows {body.get_name()} for {options.seconds:g} s")

        begin = time.monotonic()
        while time.monotonic() - begin < options.seconds:
            share = min(1.0, period / options.smoothing)
            position = position + share * (body.position + distance - position)
            camera.set_pos(position)  # keeps looking where it looks
            time.sleep(period)


if __name__ == "__main__":
    main()
