"""Formatting and linting of what is in the tree."""

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tree_files(*patterns):
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--", *patterns]
    names = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    return [n for n in names if n and (ROOT / n).is_file()]


def output_of(*command):
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    return "" if done.returncode == 0 else done.stdout + done.stderr


def test_cpp_is_formatted():
    files = tree_files("*.h", "*.cpp")
    assert files
    assert output_of("clang-format-14", "--dry-run", "-Werror", *files) == "", "run ./dev format"


def test_python_is_formatted():
    assert output_of(sys.executable, "-m", "ruff", "format", "--check", ".") == "", "run ./dev format"


def test_python_has_no_lint():
    assert output_of(sys.executable, "-m", "ruff", "check", ".") == ""


def test_shell_scripts_parse():
    scripts = [s for s in ("dev", ".ci/run", *tree_files("*.sh")) if (ROOT / s).is_file()]
    assert [output_of("bash", "-n", s) for s in scripts] == [""] * len(scripts)
