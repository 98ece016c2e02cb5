"""Tools of the benchmarks: scenes, runs of the simulator, and what the machine was doing meanwhile."""

import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/acceptance"))
from harness import COMPAT, SIMULATOR, Master, Simulator  # noqa: E402, F401  (the benchmarks take them from here)

COMPAT_LAUNCH = COMPAT / "ambf_models/descriptions/launch.yaml"
OWN_LAUNCH = ROOT / "ambf_models/descriptions/launch.yaml"
OUR_ORIGINAL = ROOT / "ambf_models/descriptions/launch_original.yaml"

# Arguments that load the scenes whose figures of the original are known. Its 300 cubes are not ours, but like them.
SCENES = {
    "PSM": ("--launch_file", COMPAT_LAUNCH, "-l", "5"),
    "PSM+ECM+MTM": ("--launch_file", COMPAT_LAUNCH, "-l", "5,6,4"),
    "our PSM+ECM+MTM": ("--launch_file", OUR_ORIGINAL, "-l", "5,6,4"),
    "puzzle1": ("--launch_file", COMPAT_LAUNCH, "-l", "11"),
    "300 cubes": ("--launch_file", OWN_LAUNCH, "-l", "5"),
}


def available(scenes):
    """Those of the named scenes whose files are here; says which are not."""
    found = []
    for name in scenes:
        launch = SCENES[name][1]
        if launch.is_file():
            found.append(name)
        else:
            print(f"left out: {name} ({launch} is missing; AMBF_COMPAT_DIR says where such models are)")
    return found


class Watch:
    """Measures a stretch of wall time and what the rest of the machine took of it (/proc/stat)."""

    def __init__(self):
        self.started, self.ticks = time.monotonic(), self._ticks()

    @staticmethod
    def _ticks():
        return [int(n) for n in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]

    @property
    def seconds(self):
        return time.monotonic() - self.started

    def shares(self):
        """(busy, stolen) shares of all processors since the start; stolen by the host of a virtual machine."""
        user, nice, system, idle, wait, irq, soft, steal = (
            b - a for a, b in zip(self.ticks, self._ticks(), strict=True)
        )
        total = max(1, user + nice + system + idle + wait + irq + soft + steal)
        return (total - idle - wait) / total, steal / total


def machine():
    """One line for the head of a benchmark's output."""
    model = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True)
    return (
        f"{time.strftime('%Y-%m-%d %H:%M')}, {os.cpu_count()} x {model.group(1) if model else platform.machine()}, "
        f"load {os.getloadavg()[0]:.1f}, commit {commit.stdout.strip() or 'unknown'}"
    )


def summary_of(arguments, seconds, master=None):
    """Runs the simulator headless for so long; {name: number} of what it says at the end, and the machine's shares."""
    environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    if master is not None:
        environment.update(ROS_MASTER_URI=master.uri)
    command = [SIMULATOR, "-g", "false", "--run-for", seconds, *([] if master else ["--no-ros"]), *arguments]
    watch = Watch()
    done = subprocess.run(
        list(map(str, command)), capture_output=True, text=True, env=environment, timeout=60 + 3 * seconds
    )
    if done.returncode != 0:
        raise SystemExit(f"the simulator ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    numbers = {name: float(value) for name, value in re.findall(r"^([^:\n\[]+): ([-+.\deE]+)", done.stdout, re.M)}
    numbers["busy"], numbers["stolen"] = watch.shares()
    # What the physics thread would do with a core of its own. Real-time threads have that anyway.
    numbers["steps per CPU second"] = numbers["steps per second"] / max(1e-9, numbers["physics thread CPU"] / 100)
    return numbers


def process_numbers(pid):
    """Memory (MB; heap: what of it is no file's), threads and open files of a process."""
    status = dict(line.split(":", 1) for line in Path(f"/proc/{pid}/status").read_text().splitlines())
    return {
        "memory": int(status["VmRSS"].split()[0]) / 1024,
        "heap": int(status["RssAnon"].split()[0]) / 1024,
        "threads": int(status["Threads"]),
        "files": len(list(Path(f"/proc/{pid}/fd").iterdir())),
    }


def scratch():
    """A folder that goes with the program."""
    return tempfile.TemporaryDirectory(prefix="ambf-bench-")


def record(name, rows, head, figures):
    """Prints the table and leaves it, with the figures to be judged, for tools/bench_tables.py.

    figures: {what: (number, sort)}; sort is "rate" (more is better), "time" or "size" (less is better).
    """
    table(rows, head)
    folder = os.environ.get("AMBF_BENCH_RESULTS")
    if folder is None:
        return
    yardstick = subprocess.run([SIMULATOR.parent / "ambf_yardstick"], check=True, capture_output=True, text=True)
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True)
    result = {
        "commit": commit.stdout.strip() or "unknown",
        "machine": machine(),
        "yardstick": float(yardstick.stdout),
        "head": head,
        "rows": [[str(cell) for cell in row] for row in rows],
        "figures": {what: {"value": value, "sort": sort} for what, (value, sort) in figures.items()},
    }
    (Path(folder) / f"{name}.json").write_text(json.dumps(result, indent=1))


def plot(rows, head, picture):
    """Draws a table of numbers: a row of bars for each of its columns but the first, which names them."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    names = [row[0] for row in rows]
    size = (2.4 * (len(head) - 1) + 1.5, 0.32 * len(rows) + 1.2)
    figure, parts = pyplot.subplots(1, len(head) - 1, figsize=size, sharey=True, layout="constrained", squeeze=False)
    for column, part in enumerate(parts[0], 1):
        cells = [row[column] for row in rows]
        part.bar_label(part.barh(names, [float(cell.split()[0]) for cell in cells]), cells, padding=3, fontsize=7)
        part.set_title(head[column], fontsize=8)
        part.tick_params(labelsize=7)
        part.spines[["top", "right"]].set_visible(False)
        part.margins(x=0.35)
    parts[0][0].invert_yaxis()
    figure.savefig(picture, dpi=150)
    pyplot.close(figure)


def table(rows, head):
    """Prints rows (lists of strings) as a table that Markdown takes too."""
    widths = [max(len(str(row[i])) for row in [head, *rows]) for i in range(len(head))]
    for number, row in enumerate([head, *rows]):
        print("| " + " | ".join(str(c).ljust(w) for c, w in zip(row, widths, strict=True)) + " |")
        if number == 0:
            print("|" + "|".join("-" * (w + 2) for w in widths) + "|")
    print(flush=True)
