"""What the Python client achieves: commands to states, and stepping (dissertation §3.8).

Round trip: a static body is told a pose until its state shows it, at default settings; trials start at random moments.
Stepping: a PSM that never sleeps, held by a joint command at each call, 1, 10 and 50 steps a call; beside it what the
scene does in the same run, between the calls, when nobody steps it (medians). Ends with 1 when a step was lost.
"""

import argparse
import os
import random
import time
from pathlib import Path
from statistics import median

import support  # first: it makes the tools of the acceptance tests importable

# isort: split
import scenes
from harness import Simulator

FREE = ("-t", "1", "-p", "100000", "-s", "100", "--sleeping", "0")
ROUNDS = 10  # of free running and stepping, by turns
HELD = [0.0, 0.0, 0.1, 0.0, 0.0, 0.0]


def quantiles(values):
    ordered = sorted(values)
    return [f"{ordered[min(len(ordered) - 1, int(share * len(ordered)))] * 1e3:.2f}" for share in (0.5, 0.95, 0.99)]


def round_trips(client, trials, random_):
    table = client.wait_for("Table")

    def trip(x):
        begin = time.perf_counter()
        table.set_pos(x, 0.0, 0.0)
        while table.get_pos().x != x:
            if not table.wait_for_next_state(5.0):
                raise SystemExit("no state for 5 s")
        return time.perf_counter() - begin

    def scattered(i):
        time.sleep(random_.uniform(0.0005, 0.003))
        return trip(1.0 + i)

    def after_silence(i):
        table.clear_cmd()
        time.sleep(0.8)
        return trip(-1.0 - i)

    for i in range(200):
        trip(0.001 * i)
    rows = [
        ["random moments", *quantiles([scattered(i) for i in range(trials)]), "5.9 / 10.9 / 50"],
        ["one after the other", *quantiles([trip(10_000.0 + i) for i in range(trials)]), ""],
        ["first after 0.8 s of silence", *quantiles([after_silence(i) for i in range(20)]), "20 / 22 to 49"],
    ]
    support.table(rows, ["command to state, ms", "p50", "p95", "p99", "original"])


def free_rate(world, seconds=0.7):
    """Steps a second when nobody steps it; what is commanded stays commanded."""
    world.release()
    time.sleep(0.3)
    first, begin = world.get_sim_step(), time.monotonic()
    time.sleep(seconds)
    return (world.get_sim_step() - first) / (time.monotonic() - begin)


def stepping(client, base, all_bodies, calls):
    """Rows of the table. Free running and stepping take turns, so that both meet the machine in all its moods."""
    world = client.world
    arm = client.wait_for(base)
    held = [client.wait_for(name) for name in client.get_obj_names() if name != "World"] if all_bodies else [arm]
    arm.set_joint_pos(HELD)
    rows = []
    for steps, original in ((1, 488), (10, 375), (50, 250)):
        rates, free, watch = [], [], support.Watch()
        for _ in range(ROUNDS):
            free.append(free_rate(world))
            at = world.step(1000).sim_step
            begin = time.perf_counter()
            for call in range(calls // ROUNDS):
                arm.set_joint_pos([HELD[0] + 1e-3 * (call % 100), *HELD[1:]])
                at += steps
                if world.step(steps).sim_step != at or any(handle.get_sim_step() != at for handle in held):
                    raise SystemExit(f"the handles do not show step {at}")
            rates.append(calls // ROUNDS / (time.perf_counter() - begin))
        busy, stolen = watch.shares()
        rate, raw = median(rates), median(free)
        shares = sorted(each * steps / beside for each, beside in zip(rates, free, strict=True))
        rows.append([len(held), steps, f"{rate:.0f}", f"{rate * steps:.0f}", f"{raw:.0f}", f"{median(shares):.2f}"])
        rows[-1] += [f"{shares[0]:.2f} to {shares[-1]:.2f}", f"{busy:.2f}, {stolen:.2f}", original]
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--trials", type=int, default=1000)
    parser.add_argument("--calls", type=int, default=5000)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    from ambf_client import Client

    scene, base = ((*support.SCENES["PSM"],), "psm/baselink")
    if not support.available(["PSM"]):
        scene, base = (("--launch_file", support.OWN_LAUNCH, "-l", "1"), "base")
    try:
        with support.scratch() as folder:
            simulator = Simulator(folder, "--launch_file", scenes.write(Path(folder)), "-l", "0", master_uri=master.uri)
            try:
                with Client() as client:
                    round_trips(client, options.trials, random.Random(1))
            finally:
                simulator.stop()
            simulator = Simulator(folder, *FREE, *scene, master_uri=master.uri)
            try:
                head = [
                    "handles",
                    "steps a call",
                    "calls/s",
                    "steps/s",
                    "free",
                    "share",
                    "lowest, highest",
                    "busy, stolen",
                    "original calls/s",
                ]
                rows = []
                for all_bodies in (False, True):
                    with Client() as client:
                        rows += stepping(client, base, all_bodies, options.calls)
                support.table(rows, head)
            finally:
                simulator.stop()
    finally:
        master.kill()


if __name__ == "__main__":
    main()
