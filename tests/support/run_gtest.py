"""Runs one GoogleTest program for ctest and leaves a JUnit file with the result of each of its tests.

Usage: run_gtest.py PROGRAM [--shard K/N] [--timeout SECONDS]

AMBF_TEST_RESULTS   folder of the JUnit file; no file without it
AMBF_TEST_MATCHING  regular expression: only tests whose SUITE.TEST matches are run
AMBF_SANITIZER      address: without a filter, what tests/sanitizers/address_leaves_out.txt names is not run
AMBF_TRIES          2: the tests that fail (at most three of a program) run once more, alone; those that then pass are
                    marked unsteady in the file (docs/decisions/0050)

A program that crashes, hangs or reports an error after its last test (a leak, a race) counts as one failed test of the
program's own name. It gets no second try.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree


def test_names(program):
    """SUITE.TEST of each test in the program."""
    listed = subprocess.run([program, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout
    suite, names = "", []
    for line in listed.splitlines():
        name = line.partition("#")[0].rstrip()
        if line.startswith("  "):
            names.append(suite + name.strip())
        elif name.endswith("."):
            suite = name
    return names


def left_out():
    """GoogleTest patterns of what does not run under this build's sanitizer."""
    build = os.environ.get("AMBF_SANITIZER") or "release"
    file = pathlib.Path(__file__).parents[1] / "sanitizers" / f"{build}_leaves_out.txt"
    if not file.exists():
        return []
    return [line for line in file.read_text().splitlines() if line and not line.startswith("#")]


def write_failure(file, name, message):
    suites = ElementTree.Element("testsuites")
    case = ElementTree.SubElement(ElementTree.SubElement(suites, "testsuite", name=name), "testcase", name=name)
    ElementTree.SubElement(case, "failure", message=message)
    ElementTree.ElementTree(suites).write(file)


def add_failure(file, name, message):
    """A failure of the program, unless one of its tests or the program itself already counts as failed."""
    tree = ElementTree.parse(file)
    if tree.find(".//failure") is None:
        case = ElementTree.SubElement(
            ElementTree.SubElement(tree.getroot(), "testsuite", name=name), "testcase", name=name
        )
        ElementTree.SubElement(case, "failure", message=message)
        tree.write(file)


def pass_at_second_try(program, file, environment, timeout):
    """Whether the failed tests in `file`, few of a program that ran to its end, all pass when they run once more."""
    tree = ElementTree.parse(file)
    failed = [case for case in tree.iter("testcase") if case.find("failure") is not None]
    if not 0 < len(failed) <= 3:
        return False
    names = [f"{case.get('classname')}.{case.get('name')}" for case in failed]
    print(f"{program.name}: once more: {' '.join(names)}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        again = f"{folder}/again.xml"
        environment = dict(environment, GTEST_TOTAL_SHARDS="1", GTEST_SHARD_INDEX="0")
        environment |= {"GTEST_FILTER": ":".join(names), "GTEST_OUTPUT": f"xml:{again}"}
        try:
            if subprocess.run([program], env=environment, timeout=timeout).returncode:
                return False
        except subprocess.TimeoutExpired:
            return False
        ran = sum(case.get("status") == "run" for case in ElementTree.parse(again).iter("testcase"))
    if ran != len(names):
        return False
    for case in failed:
        case.set("unsteady", "true")
        for failure in case.findall("failure"):
            case.remove(failure)
    tree.write(file)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--shard", default="1/1", help="K/N: the K-th of N parts of the tests")
    parser.add_argument("--timeout", type=float)
    options = parser.parse_args()
    shard, shards = map(int, options.shard.split("/"))
    name = options.program.name + (f"-{shard}" if shards > 1 else "")
    environment = dict(os.environ, GTEST_TOTAL_SHARDS=str(shards), GTEST_SHARD_INDEX=str(shard - 1))

    file = None
    if "AMBF_TEST_RESULTS" in os.environ:
        file = pathlib.Path(os.environ["AMBF_TEST_RESULTS"]) / f"{name}.xml"
        environment["GTEST_OUTPUT"] = f"xml:{file}"
        write_failure(file, name, "the program did not finish")  # GoogleTest replaces the file after its last test
    matching = os.environ.get("AMBF_TEST_MATCHING")
    if matching:
        chosen = [each for each in test_names(options.program) if re.search(matching, each)]
        if not chosen:
            if file:
                file.unlink()
            return 0
        environment["GTEST_FILTER"] = ":".join(chosen)
    elif patterns := left_out():
        environment["GTEST_FILTER"] = "-" + ":".join(patterns)
    try:
        code = subprocess.run([options.program], env=environment, timeout=options.timeout).returncode
    except subprocess.TimeoutExpired:
        print(f"{name} did not finish within {options.timeout:g} s")
        return 1
    # GoogleTest ends with 1 when a test failed; crashes and what sanitizers report end a program otherwise.
    second = code == 1 and file and os.environ.get("AMBF_TRIES") == "2"
    if second and pass_at_second_try(options.program, file, environment, options.timeout):
        return 0
    if code and file:
        add_failure(file, name, f"the program ended with {code}")
    return 1 if code else 0


if __name__ == "__main__":
    sys.exit(main())
