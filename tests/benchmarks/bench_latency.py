"""Latency between the simulator and Python (dissertation Fig. 3.24-3.26): ambf-cli latency, in our arm's scene.

Histograms go to latency.png in the working folder, or where --png says.
"""

import argparse
import os
import subprocess
import sys

import support
from harness import Simulator, eventually


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--png", default="latency.png")
    parser.add_argument("--seconds", type=float, default=5.0)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    watch = support.Watch()
    try:
        with support.scratch() as folder:
            simulator = Simulator(folder, "--launch_file", support.OWN_LAUNCH, "-l", "2", master_uri=master.uri)
            try:
                eventually(lambda: "/ambf/env/World/State" in master.published(), 30)
                words = ["latency", "--for", str(options.seconds), "--png", options.png]
                code = subprocess.run([sys.executable, "-m", "ambf_tools.cli", *words]).returncode
            finally:
                simulator.stop()
    finally:
        master.kill()
    busy, stolen = watch.shares()
    print(f"machine {100 * busy:.0f} % busy, {100 * stolen:.1f} % stolen")
    return code


if __name__ == "__main__":
    sys.exit(main())
