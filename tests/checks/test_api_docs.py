"""The pages in docs/api/ say what the docstrings say, and everything public has one."""

import importlib
import importlib.util
import inspect
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ROOT / "tools/make_api_docs.py"

pytestmark = pytest.mark.skipif(importlib.util.find_spec("rospy") is None, reason="built without ROS")


def test_the_pages_are_up_to_date():
    done = subprocess.run([sys.executable, TOOL, "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_everything_public_is_documented():
    spec = importlib.util.spec_from_file_location("make_api_docs", TOOL)
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    missing = []
    for module_name in tool.MODULES:
        module = importlib.import_module(module_name)
        for name, thing in tool.public(module):
            if getattr(thing, "__module__", None) != module_name or not callable(thing):
                continue
            members = tool.public(thing) if inspect.isclass(thing) else []
            documented = [(f"{name}.{m}", t) for m, t in members if inspect.isfunction(t) or isinstance(t, property)]
            for full, each in [(name, thing), *documented]:
                if not inspect.getdoc(each) and not full.endswith(".__init__"):
                    missing.append(f"{module_name}.{full}")
    assert missing == []
