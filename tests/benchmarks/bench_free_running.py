"""Free running: 1 ms steps as fast as they go, headless and without ROS, beside what the original reached.

Targets, all bodies awake: `si`, the original's way of solving, at least the original's rate; the default solver at
least 0.7 of it, though its joints are far stiffer and nothing creeps; with sleeping at least 5 times it on puzzle1 and
the cubes (settling is part of the run). On a machine that does other things too, look at the steps a CPU second of the
physics thread instead of those a wall second.
"""

import argparse

import support

ORIGINAL = {"PSM": 30100, "PSM+ECM+MTM": 11450, "puzzle1": 6760, "300 cubes": 758}  # steps a second
FREE = ("-t", "1", "-p", "1000000", "-s", "1000")
MODES = {
    "si, 1 direction, awake": ("--solver", "si", "--friction-directions", "1", "--sleeping", "0"),
    "default, awake": ("--sleeping", "0"),
    "default, sleeping": (),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--runs", type=int, default=3, help="the best counts")
    options = parser.parse_args()
    print(support.machine())
    rows, figures = [], {}
    for scene in support.available(ORIGINAL):
        for mode, flags in MODES.items():
            runs = [
                support.summary_of((*support.SCENES[scene], *FREE, *flags), options.seconds)
                for _ in range(options.runs)
            ]
            best = max(runs, key=lambda run: run["steps per second"])
            figures[f"{scene}, {mode}"] = (best["steps per CPU second"], "rate")
            phases = {name[6:]: value for name, value in best.items() if name.startswith("phase ")}
            rows.append(
                [
                    scene,
                    mode,
                    f"{best['steps per second']:.0f}",
                    f"{best['steps per CPU second']:.0f}",
                    f"{ORIGINAL[scene]}",
                    f"{best['steps per second'] / ORIGINAL[scene]:.2f}",
                    f"{best['steps per CPU second'] / ORIGINAL[scene]:.2f}",
                    ", ".join(f"{name} {value:.1f}" for name, value in phases.items() if value >= 0.05),
                    f"{100 * best['stolen']:.1f}",
                ]
            )
    head = [
        "scene",
        "mode",
        "steps/s",
        "a CPU second",
        "original",
        "ratio",
        "by CPU",
        "us a step, by phase",
        "stolen %",
    ]
    support.record("free_running", rows, head, figures)


if __name__ == "__main__":
    main()
