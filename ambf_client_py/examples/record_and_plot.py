#!/usr/bin/env python3
"""Records a movement into a bag, reads it back, and plots what was commanded and what was measured.

Start a simulator with the arm (./dev run -l 2), then: ./dev shell -- python ambf_client_py/examples/record_and_plot.py
"""

import argparse
import math
import time
from pathlib import Path

from ambf_client import Client
from ambf_tools import read_bag
from ambf_tools.record import Recorder, bag_name


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("base", nargs="?", default="arm7/base", help="the body below which the joint is")
    parser.add_argument("--joint", type=int, default=0)
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--folder", type=Path, default=Path("recordings"))
    options = parser.parse_args()

    with Client("record_and_plot") as client:
        base = client.wait_for(options.base)
        topics = [f"{base.get_name()}/State", f"{base.get_name()}/Command"]
        with Recorder(options.folder / bag_name("example", "sinusoid"), topics) as recorder:
            recorder.ready(2)  # both are connected
            middle, begin = base.get_joint_pos(options.joint), time.monotonic()
            while (t := time.monotonic() - begin) < options.seconds:
                base.set_joint_pos(options.joint, middle + 0.4 * math.sin(2.0 * t))
                time.sleep(0.005)

    status = recorder.status
    print(f"{recorder.path}: {status.messages} messages, {status.lost} lost")
    plot(recorder.path, topics, options.joint)


def plot(path: Path, topics: list[str], joint: int) -> None:
    """Draws the joint's commands and positions beside the bag, as a picture of the same name."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    with read_bag.open(path) as bag:
        measured = bag.columns(topics[0], ["joint_positions"])
        commanded = bag.columns(topics[1], ["joint_cmds"])
    pyplot.figure(figsize=(9, 4))
    pyplot.plot(commanded["time"], commanded[f"joint_cmds[{joint}]"], "--", label="commanded")
    pyplot.plot(measured["time"], measured[f"joint_positions[{joint}]"], label="measured")
    pyplot.xlabel("simulation time, s")
    pyplot.ylabel(f"joint {joint}, rad")
    pyplot.legend()
    pyplot.grid(alpha=0.3)
    pyplot.tight_layout()
    pyplot.savefig(path.with_suffix(".png"), dpi=110)
    print(f"picture: {path.with_suffix('.png')}")


if __name__ == "__main__":
    main()
