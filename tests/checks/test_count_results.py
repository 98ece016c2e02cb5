"""The line that CI reads counts what GoogleTest and pytest wrote, and never calls a broken run a success."""

import pathlib
import subprocess
import sys

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools/count_results.py"
GTEST = """<testsuites><testsuite><testcase name="A" status="run"/>
<testcase name="B" status="run"><failure message=""/><failure message=""/></testcase>
<testcase name="C" status="run" result="skipped"><skipped message=""/></testcase>
<testcase name="D" status="notrun"/></testsuite>
<testsuite name="program"><testcase name="program"><failure message="crashed"/></testcase></testsuite></testsuites>"""
PYTEST = """<testsuites><testsuite><testcase classname="m" name="e"/>
<testcase classname="m" name="f"><error/></testcase>
<testcase classname="m" name="g"><skipped/></testcase></testsuite></testsuites>"""


def test_what_passed_at_a_second_try_is_named(tmp_path):
    (tmp_path / "a.xml").write_text('<testsuite><testcase classname="S" name="A" unsteady="true"/></testsuite>')
    done = subprocess.run([sys.executable, SCRIPT, tmp_path], capture_output=True, text=True)
    assert done.stdout.splitlines() == ["unsteady, passed at a second try: S::A", "1 passed, 0 failed"]


def count(folder):
    done = subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, text=True)
    return done.stdout.splitlines()[-1], done.returncode


@pytest.mark.parametrize(
    ("files", "line", "status"),
    [
        ({"program.xml": GTEST, "pytest.xml": PYTEST}, "2 passed, 3 failed, 3 skipped", 1),
        ({"pytest.xml": '<testsuite><testcase name="a"/></testsuite>'}, "1 passed, 0 failed", 0),
        ({}, "0 passed, 0 failed", 1),
    ],
)
def test_counts_are_the_sums(tmp_path, files, line, status):
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    assert count(tmp_path) == (line, status)
