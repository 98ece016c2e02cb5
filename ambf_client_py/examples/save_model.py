#!/usr/bin/env python3
"""Loads a model, lets it move, and writes it as an ADF file that starts where the model is now; or the whole scene.

Start a simulator, then: ./dev shell -- python ambf_client_py/examples/save_model.py
"""

import argparse
import time
from pathlib import Path

from ambf_client import Client

MODELS = Path(__file__).resolve().parents[2] / "ambf_models/descriptions/multi-bodies"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", default=MODELS / "mechanisms/four_bar.yaml")
    parser.add_argument("--to", type=Path, default=Path("saved.yaml"))
    parser.add_argument("--scene", type=Path, help="a folder for the whole scene, too")
    parser.add_argument("--seconds", type=float, default=1.0, help="between loading and saving")
    options = parser.parse_args()

    with Client("save_model") as client:
        loaded = client.load(options.file)
        time.sleep(options.seconds)
        # The file is the one that was read; only the places of bodies that moved differ.
        saved = client.save(loaded, options.to.resolve(), current_pose=True, overwrite=True)
        print(f"{saved.path}: {saved.size} bytes")
        for finding in saved.findings:
            print(f"  {finding}")
        if options.scene:
            # A launch file, a world file and a file for each model; the message is the command that starts it.
            print(client.save_scene(options.scene.resolve(), current_pose=True, overwrite=True).message)
        client.unload(loaded)


if __name__ == "__main__":
    main()
