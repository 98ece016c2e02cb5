"""Figures of benchmarks are judged by their ratio to the yardstick of their own run."""

import importlib.util
import json
import pathlib

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools/bench_tables.py"
spec = importlib.util.spec_from_file_location("bench_tables", SCRIPT)
bench_tables = importlib.util.module_from_spec(spec)
spec.loader.exec_module(bench_tables)


def result(value, sort, yardstick=1000.0):
    return {
        "commit": "abc",
        "machine": "2026-11-22, one processor, commit abc",
        "yardstick": yardstick,
        "head": ["scene", "figure"],
        "rows": [["box", str(value)]],
        "figures": {"box": {"value": value, "sort": sort}},
    }


@pytest.mark.parametrize(
    ("sort", "value", "yardstick", "is_worse"),
    [
        ("rate", 100.0, 1000.0, False),
        ("rate", 86.0, 1000.0, False),
        ("rate", 84.0, 1000.0, True),
        ("rate", 51.0, 500.0, False),  # half the rate on a machine of half the speed
        ("rate", 100.0, 2000.0, True),  # the same rate on one of twice the speed
        ("time", 115.0, 1000.0, False),
        ("time", 120.0, 1000.0, True),
        ("time", 190.0, 500.0, False),
        ("time", 100.0, 2000.0, True),
        ("size", 120.0, 1000.0, True),
        ("size", 100.0, 2000.0, False),  # memory does not depend on the speed
    ],
)
def test_what_is_worse_by_the_yardstick(sort, value, yardstick, is_worse):
    before = {"start": result(100.0, sort)}
    assert bool(bench_tables.worsened({"start": result(value, sort, yardstick)}, before)) is is_worse


def test_new_figures_are_not_judged():
    assert bench_tables.worsened({"start": result(1.0, "rate")}, {}) == []


def test_tables_and_figures_are_written_on_request_only(tmp_path):
    docs, results = tmp_path / "docs", tmp_path / "results"
    docs.mkdir()
    results.mkdir()
    page = "prose\n<!-- bench start -->\nold\n<!-- end -->\nmore\n"
    (docs / "benchmarks.md").write_text(page)
    (results / "start.json").write_text(json.dumps(result(100.0, "rate")))
    assert bench_tables.main([str(results)], docs) == 0
    assert (docs / "benchmarks.md").read_text() == page
    assert bench_tables.main([str(results), "--write"], docs) == 0
    text = (docs / "benchmarks.md").read_text()
    assert text.startswith("prose\n<!-- bench start -->\n| scene | figure |\n|---|---|\n| box | 100.0 |\n")
    assert "commit abc; yardstick 1000 steps/s" in text and "old" not in text and text.endswith("<!-- end -->\nmore\n")
    (results / "start.json").write_text(json.dumps(result(80.0, "rate")))
    assert bench_tables.main([str(results)], docs) == 1
