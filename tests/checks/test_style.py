"""Formatting and linting of what is in the tree."""

import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tree_files(*patterns):
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--", *patterns]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    return [n for n in names if n and (ROOT / n).is_file()]


def python_packages():
    return [p for p in ("ambf_client_py", "ambf_plugins") if tree_files(f"{p}/*.py")]


def output_of(*command):
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def test_cpp_is_formatted():
    files = tree_files("*.h", "*.cpp")
    assert files
    output = output_of("clang-format-14", "--dry-run", "-Werror", *files)
    assert not output, "run ./dev format\n" + output


def test_python_is_formatted():
    assert output_of(sys.executable, "-m", "ruff", "format", "--check", ".") == "", "run ./dev format"


def test_python_has_no_lint():
    assert output_of(sys.executable, "-m", "ruff", "check", ".") == ""


def test_shell_scripts_parse():
    scripts = [s for s in ("dev", ".ci/run", *tree_files("*.sh")) if (ROOT / s).is_file()]
    assert [output_of("bash", "-n", s) for s in scripts] == [""] * len(scripts)


@pytest.mark.skipif(not python_packages(), reason="no Python package in the tree yet")
def test_python_types_are_right():
    assert output_of(sys.executable, "-m", "mypy", *python_packages()) == ""


def test_parameters_of_tests_have_names():
    """Results would call the tests by numbers."""
    unnamed = []
    for file in tree_files("tests/*.cpp"):
        text = (ROOT / file).read_text(encoding="utf-8")
        for made in text.split("INSTANTIATE_TEST_SUITE_P(")[1:]:
            if "parameter.param" not in made.partition("\n\n")[0]:
                unnamed.append(f"{file}: {made.splitlines()[0]}")
    assert unnamed == []
