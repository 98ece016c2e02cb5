"""Compares the benchmarks' figures with those of docs/benchmarks.json, and writes the tables of docs/benchmarks.md.

Usage: bench_tables.py RESULTS [--write]

RESULTS holds one JSON file a benchmark (tests/benchmarks/support.py writes them). A figure is judged by its ratio to
the yardstick of the same run, a bare Bullet scene, so that the machine's speed cancels out; memory is judged as it is.
Ends with 1 when one is more than 15 % worse than in docs/benchmarks.json. --write replaces the tables between the
markers <!-- bench NAME --> and <!-- end --> and the recorded figures by those of this run.
"""

import argparse
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
TOLERANCE = 0.15


def gain(figure, recorded, speed, recorded_speed):
    """How many times better a figure is than the recorded one, on a machine as fast as the recorded one's."""
    ratio = figure["value"] / recorded["value"]
    return {
        "rate": ratio / (speed / recorded_speed),  # more is better, grows with the machine's speed
        "time": 1.0 / (ratio * (speed / recorded_speed)),  # less is better, shrinks with it
        "size": 1.0 / ratio,  # less is better, whatever the machine
    }[figure["sort"]]


def worsened(results, recorded):
    """One line for each figure that is worse by more than the tolerance."""
    lines = []
    for name, result in sorted(results.items()):
        before = recorded.get(name)
        for key, figure in result["figures"].items():
            if before is None or key not in before["figures"]:
                continue
            change = gain(figure, before["figures"][key], result["yardstick"], before["yardstick"])
            if change < 1.0 - TOLERANCE:
                lines.append(
                    f"{name}, {key}: {figure['value']:.4g} is {change:.2f} times as good as "
                    f"{before['figures'][key]['value']:.4g} of commit {before['commit']}, by the yardstick"
                )
    return lines


def rendered(result):
    """A benchmark's table with its date, machine and commit, as Markdown."""
    lines = ["| " + " | ".join(result["head"]) + " |", "|" + "---|" * len(result["head"])]
    lines += ["| " + " | ".join(row) + " |" for row in result["rows"]]
    lines += ["", f"*{result['machine']}; yardstick {result['yardstick']:.0f} steps/s.*"]
    return "\n".join(lines)


def with_tables(text, results):
    for name, result in results.items():
        marked = re.compile(rf"(<!-- bench {re.escape(name)} -->\n).*?(<!-- end -->)", re.DOTALL)
        if not marked.search(text):
            raise SystemExit(f"docs/benchmarks.md has no place for '{name}': <!-- bench {name} --> ... <!-- end -->")
        text = marked.sub(lambda match: match[1] + rendered(result) + "\n" + match[2], text)  # noqa: B023
    return text


def main(arguments, docs=ROOT / "docs"):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("--write", action="store_true", help="record this run's figures and write the tables")
    options = parser.parse_args(arguments)
    results = {file.stem: json.loads(file.read_text()) for file in sorted(options.results.glob("*.json"))}
    record = docs / "benchmarks.json"
    recorded = json.loads(record.read_text()) if record.exists() else {}
    lines = worsened(results, recorded)
    print("\n".join(lines) if lines else f"nothing is worse by more than {TOLERANCE:.0%}")
    if options.write:
        page = docs / "benchmarks.md"
        page.write_text(with_tables(page.read_text(), results))
        record.write_text(json.dumps({**recorded, **results}, indent=1) + "\n")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
