"""PsmReach learned from five seeds, and each policy then tried in a world of ROS that runs in real time.

    ./dev learn python tests/benchmarks/bench_training.py train --folder trained
    ./dev shell -- python tests/benchmarks/bench_training.py ros --folder trained
    ./dev shell -- python tests/benchmarks/bench_training.py plot --folder trained --picture docs/pictures/learning.png

train runs train_psm_reach.py for one seed after the other, and its control that sees wrong goals; ros starts the PSM
and the ECM, which a program moves meanwhile as a person would, and runs policy_on_ros.py; plot prints the table and
draws the curves. What is there is not done again, so all can be broken off. Bars: each seed at most 30 000 steps and
10 minutes on two cores, >= 95 % of 200 unseen goals by its last weights, >= 90 % over ROS, < 20 % with wrong goals.
"""

import argparse
import csv
import importlib.util
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "ambf_client_py/examples"
LEARNING = EXAMPLES / "learning"
LEAST = {"unseen": 95.0, "ros": 90.0}
MOST = {"wrong": 20.0, "ros_wrong": 20.0, "steps": 30_000, "busy": 600}  # busy: s of a processor, whatever else ran
TRAINED, TRIED = ("seed", "steps", "seconds", "busy", "unseen", "wrong"), ("seed", "ros", "ros_wrong", "factor")
FILES = {TRAINED: "trained.csv", TRIED: "over_ros.csv"}  # one for each part, which may run at the same time


def read(folder, columns):
    """{seed: what is known of it}."""
    file = folder / FILES[columns]
    rows = list(csv.DictReader(file.open())) if file.is_file() else []
    return {int(row["seed"]): {name: value for name, value in row.items() if value} for row in rows}


def write(folder, columns, results):
    with (folder / FILES[columns]).open("w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="")
        writer.writeheader()
        writer.writerows(results[seed] for seed in sorted(results))


def said(program, *arguments):
    """What a program has printed."""
    done = subprocess.run(
        [sys.executable, str(program), *map(str, arguments)], capture_output=True, text=True, cwd=LEARNING
    )
    if done.returncode != 0:
        raise SystemExit(f"{program.name} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def share(text):
    """Of unseen goals that were reached, in per cent."""
    return re.search(r"reached ([\d.]+) %", text).group(1)


def train(folder, seeds, steps):
    script = LEARNING / "train_psm_reach.py"
    for seed in seeds:
        results, own = read(folder, TRAINED), folder / f"seed{seed}"
        row = results.setdefault(seed, {"seed": seed})
        if "unseen" not in row:
            text = said(script, "--seed", seed, "--steps", steps, "--folder", own)
            row["steps"], row["seconds"], row["busy"] = re.search(r"(\d+) steps in (\d+) s, (\d+) s", text).groups()
            row["unseen"] = share(text)
            write(folder, TRAINED, results)
        if "wrong" not in row:
            row["wrong"] = share(said(script, "--replay", own / "model.zip", "--wrong-goal"))
            write(folder, TRAINED, results)
        print(row, flush=True)


def over_ros(folder, seeds, episodes):
    import support
    from harness import Master, Simulator, eventually

    master = Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    simulator = person = None
    try:
        simulator = Simulator(folder, "-l", "15,16", master_uri=master.uri)
        eventually(lambda: "/ambf/env/ecm/baselink/Command" in master.names(), 60.0, "the topics")
        moves = [EXAMPLES / "joint_sinusoids.py", "ecm/baselink", "--seconds", 36000, "--amplitude", 0.1]
        person = subprocess.Popen([sys.executable, *map(str, moves)])
        print(support.machine())
        for seed in seeds:
            results, policy = read(folder, TRIED), folder / f"seed{seed}/policy.npz"
            row = results.setdefault(seed, {"seed": seed})
            for name, options in (("ros", ()), ("ros_wrong", ("--wrong-goal",))):
                if name not in row and policy.is_file():
                    count = episodes if name == "ros" else max(1, episodes // 2)
                    text = said(LEARNING / "policy_on_ros.py", "--policy", policy, "--episodes", count, *options)
                    row[name] = share(text)
                    row.setdefault("factor", re.search(r"factor ([\d.]+)", text).group(1))
                    write(folder, TRIED, results)
                    print(f"seed {seed}, {name}: {text}", flush=True)
        if person.poll() is not None:
            raise SystemExit("the program that moves the endoscope has ended")
    finally:
        if person is not None:
            person.kill()
            person.wait()
        if simulator is not None and simulator.running():
            simulator.stop()
        master.kill()


def curve(file):
    """(steps, shares of success, means of 20 episodes)."""
    rows = list(csv.DictReader(file.open()))
    success = np.array([float(row["success"]) for row in rows])
    return np.array([int(row["steps"]) for row in rows])[19:], np.convolve(success, np.ones(20) / 20, "valid")


def plot(folder, seeds, picture):
    """Prints the table, draws the picture; what is wrong."""
    import support

    results, tried, faults = read(folder, TRAINED), read(folder, TRIED), []
    known = [seed for seed in seeds if "unseen" in results.get(seed, {})]
    results = {seed: {**results[seed], **tried.get(seed, {})} for seed in known}
    columns = [*TRAINED, *TRIED[1:]]
    support.table([[row.get(name, "") for name in columns] for row in results.values()], columns)
    for seed, row in results.items():
        low = [name for name, least in LEAST.items() if float(row.get(name, least)) < least]
        high = [name for name, most in MOST.items() if float(row.get(name, 0.0)) > most]
        faults += [f"seed {seed}: {name}: {row[name]}" for name in (*low, *high)]
    if picture is not None and known:
        import matplotlib

        matplotlib.use("Agg")
        from matplotlib import pyplot

        curves = [curve(folder / f"seed{seed}/curve.csv") for seed in known]
        steps = curves[0][0]
        shares = 100 * np.array([np.interp(steps, *each) for each in curves])
        figure, axes = pyplot.subplots(figsize=(6.4, 3.6), layout="constrained")
        axes.fill_between(steps, shares.min(axis=0), shares.max(axis=0), alpha=0.25, label="least to most")
        for each in shares:
            axes.plot(steps, each, color="C0", linewidth=0.6, alpha=0.7)
        axes.plot(steps, shares.mean(axis=0), color="C0", linewidth=2, label=f"mean of {len(known)} seeds")
        axes.set(xlabel="env steps", ylabel="success while it learns, %", ylim=(-2, 102), xlim=(0, None))
        axes.set_title("ambf/PsmReach-v0, SAC with hindsight replay; means of 20 episodes", fontsize=10)
        axes.grid(alpha=0.3)
        axes.legend(loc="lower right")
        undated = {"metadata": {"Date": None}} if picture.suffix == ".svg" else {}
        figure.savefig(picture, dpi=150, **undated)
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("part", nargs="?", choices=("train", "ros", "plot"))
    parser.add_argument("--folder", type=Path, default=Path("trained"))
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3, 4, 5])
    parser.add_argument("--steps", type=int, default=20_000)
    parser.add_argument("--episodes", type=int, default=50, help="of each policy over ROS; half of them of the control")
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    if options.part is None:
        if importlib.util.find_spec("torch") is None:
            print("left out: training needs ./dev learn, and half an hour")
            return 0
        options.part = "train"
    folder = options.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    begun, faults = time.monotonic(), []
    if options.part == "train":
        train(folder, options.seeds, options.steps)
    elif options.part == "ros":
        over_ros(folder, options.seeds, options.episodes)
    else:
        faults = plot(folder, options.seeds, options.picture)
    print(f"{time.monotonic() - begun:.0f} s")
    for fault in faults:
        print("FAULT:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
