#!/usr/bin/env python3
"""Loads a model several times into the running simulation, uses one of them, and takes all away again.

Start a simulator, then: ./dev shell -- python ambf_client_py/examples/load_unload.py
"""

import argparse
import time
from pathlib import Path

from ambf_client import Client

MODELS = Path(__file__).resolve().parents[2] / "ambf_models/descriptions/multi-bodies"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", default=MODELS / "mechanisms/four_bar.yaml")
    parser.add_argument("--count", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=2.0, help="between loading and unloading")
    options = parser.parse_args()

    with Client("load_unload") as client:
        client.on_object_added(lambda name: print(f"  came: {name}"))
        client.on_object_removed(lambda name: print(f"  went: {name}"))

        loaded = []
        for number in range(options.count):
            # Names that are taken get a number: the answer says which.
            loaded.append(client.load(options.file, pose=[0.0, 0.5 * number, 0.5, 0.0, 0.0, 0.0]))
            print(f"{loaded[-1].model}: {len(loaded[-1].objects)} objects, {len(loaded[-1].joints)} joints")

        with_joints = [client.wait_for(name) for name in loaded[0].objects]
        base = max(with_joints, key=lambda body: body.get_num_joints())
        base.wait_for_connection(10.0)  # what counts from the first command on needs a simulator that hears it
        base.set_joint_pos(0, 0.3)
        time.sleep(options.seconds)
        print(f"joint 0 below {base.get_name()} is at {base.get_joint_pos(0):.3f}")

        for each in loaded:
            print(f"{each.model}: {len(client.unload(each.model))} objects and joints removed")


if __name__ == "__main__":
    main()
