"""The results of a GoogleTest program count test by test; a crash, a hang or a leak never looks like success."""

import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[1] / "support/run_gtest.py"
LEFT_OUT = [
    line
    for line in (SCRIPT.parents[1] / "sanitizers/address_leaves_out.txt").read_text().splitlines()
    if not line.startswith("#")
]
PASSED = '<testsuites><testsuite><testcase classname="Suite" name="Passes"/></testsuite></testsuites>'
PROGRAM = f"""#!{sys.executable}
import os, sys, time
if "--gtest_list_tests" in sys.argv:
    print("Suite.\\n  Passes\\n  Other  # GetParam() = 3")
    sys.exit()
print(os.environ.get("GTEST_FILTER"), os.environ["GTEST_SHARD_INDEX"], os.environ["GTEST_TOTAL_SHARDS"])
%s
"""
WRITE = f'open(os.environ["GTEST_OUTPUT"].removeprefix("xml:"), "w").write({PASSED!r})\n'


@pytest.fixture
def run(tmp_path):
    """run(body of the program, ...): exit status, what it printed, {name: failed} of the tests."""

    def call(body, *arguments, matching="", tries="1", sanitizer=""):
        program = tmp_path / "program"
        program.write_text(PROGRAM % body)
        program.chmod(0o755)
        environment = dict(os.environ, AMBF_TEST_RESULTS=str(tmp_path), AMBF_TEST_MATCHING=matching)
        environment |= {"AMBF_TRIES": tries, "AMBF_SANITIZER": sanitizer}
        command = [sys.executable, SCRIPT, program, *arguments]
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        cases = {}
        for file in tmp_path.glob("*.xml"):
            for case in ElementTree.parse(file).iter("testcase"):
                cases[case.get("name")] = case.find("failure") is not None
        return done.returncode, done.stdout.strip(), cases

    return call


def test_a_program_that_passes(run):
    assert run(WRITE) == (0, "None 0 1", {"Passes": False})


def test_an_error_after_the_last_test_is_a_failure_of_the_program(run):
    assert run(WRITE + "sys.exit(23)")[::2] == (1, {"Passes": False, "program": True})


def test_a_failed_test_counts_once(run):
    failed = WRITE.replace('name="Passes"/>', 'name="Passes"><failure/></testcase>')
    assert run(failed + "sys.exit(1)")[::2] == (1, {"Passes": True})


# Fails when all its tests run; what it does when only the failed one runs is to be added.
UNSTEADY = """first = "GTEST_FILTER" not in os.environ
case = '<testcase classname="Suite" name="Other" status="run">' + "<failure/>" * first + "</testcase>"
with open(os.environ["GTEST_OUTPUT"].removeprefix("xml:"), "w") as file:
    file.write("<testsuites><testsuite>" + case + "</testsuite></testsuites>")
"""


@pytest.mark.parametrize(
    ("end", "tries", "passes"),
    [
        ("sys.exit(first)", "2", True),
        ("sys.exit(first)", "1", False),  # a developer's tree
        ("sys.exit(1)", "2", False),  # fails again
        ("sys.exit(66 * first)", "2", False),  # a sanitizer's report
    ],
)
def test_a_failed_test_may_have_a_second_try(run, tmp_path, end, tries, passes):
    code, _, cases = run(UNSTEADY + end, tries=tries)
    assert (code, cases) == (0 if passes else 1, {"Other": not passes})
    assert ('unsteady="true"' in (tmp_path / "program.xml").read_text()) == passes


def test_many_failures_have_no_second_try(run):
    failed = "".join(f'<testcase classname="Suite" name="T{i}"><failure/></testcase>' for i in range(4))
    code, printed, cases = run(
        WRITE.replace('<testcase classname="Suite" name="Passes"/>', failed) + "sys.exit(1)", tries="2"
    )
    assert (code, sum(cases.values())) == (1, 4) and "once more" not in printed


def test_a_crash_before_the_end_is_a_failure(run):
    assert run("os.abort()")[::2] == (1, {"program": True})


def test_a_program_that_hangs_is_ended(run):
    assert run("time.sleep(60)", "--timeout", "0.5")[::2] == (1, {"program": True})


def test_only_matching_tests_run(run):
    assert run(WRITE, matching=r"Suite\.Oth")[:2] == (0, "Suite.Other 0 1")
    assert run("os.abort()", matching="nothing")[::2] == (0, {})


def test_long_motions_are_left_out_under_address_sanitizer_unless_asked_for(run):
    printed = run(WRITE, sanitizer="address")[1]
    assert printed.startswith("-") and LEFT_OUT[0] in printed.split(" ")[0][1:].split(":")
    assert run(WRITE, sanitizer="address", matching=r"Suite\.Oth")[:2] == (0, "Suite.Other 0 1")
    assert run(WRITE, sanitizer="thread")[1].startswith("None")


@pytest.fixture(scope="module")
def sources():
    return [file.read_text() for file in SCRIPT.parents[1].rglob("*.cpp")]


@pytest.mark.parametrize("pattern", LEFT_OUT)
def test_what_is_left_out_exists(pattern, sources):
    suite, name = re.fullmatch(r"(?:\w+/)?(\w+)\.(\w+)(?:/(?:\w+|\*))?", pattern).groups()
    assert any(re.search(rf"TEST(_F|_P)?\({suite}, {name}\)", text) for text in sources)


def test_a_shard_has_results_of_its_own(run):
    assert run("os.abort()", "--shard", "2/3")[::2] == (1, {"program-2": True})
