"""`pip install ./ambf_client_py` in a fresh virtual environment with the system's packages (rospy is one of them)."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from harness import ROOT

import ambf_msgs.msg

MODULES = [
    *("ambf_client", "ambf_tools", "ambf_comm", "ambf_world", "ambf_object", "ambf_rigid_body", "ambf_base_object"),
    *("ambf_camera", "ambf_light", "ambf_sensor", "ambf_actuator", "ambf_vehicle", "ambf_env", "watch_dog"),
    *("ambf_client.ambf_rigid_body", "ambf_client.ambf_sensor", "ros_abstraction_layer", "tf_function"),  # of 3.0
]


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    """The interpreter of that environment."""
    if importlib.util.find_spec("rospy") is None:
        pytest.skip("no rospy")
    folder = tmp_path_factory.mktemp("install")
    # The system's own Python: this one may be of another virtual environment.
    system = os.path.realpath(sys.executable)
    subprocess.run([system, "-m", "venv", "--system-site-packages", folder / "venv"], check=True)
    # From a copy: building leaves files behind. Without what is ignored by git, as a user's checkout.
    ignored = shutil.ignore_patterns("build", "*.egg-info", "__pycache__")
    shutil.copytree(ROOT / "ambf_client_py", folder / "ambf_client_py", ignore=ignored)
    made = folder / "venv/bin/python"
    has_wheel = subprocess.run([made, "-c", "import setuptools, wheel"], capture_output=True).returncode == 0
    offline = ["--no-build-isolation"] if has_wheel else []
    command = [made, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *offline, "./ambf_client_py"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return made


def run(python, *arguments, messages=True):
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    if messages:  # as share/ambf/setup.sh of an installation does
        env["PYTHONPATH"] = str(Path(ambf_msgs.msg.__file__).parents[2])
    return subprocess.run([python, *arguments], env=env, cwd="/", capture_output=True, text=True)


def test_all_modules_are_importable_from_where_they_were_installed(python):
    program = f"import {', '.join(MODULES)}\nprint(*[m.__file__ for m in ({', '.join(MODULES)})], sep='\\n')"
    done = run(python, "-c", program)
    assert done.returncode == 0, done.stderr
    assert all(str(python.parents[1]) in line for line in done.stdout.split())


def test_types_travel_with_it(python):
    program = "import ambf_client, os; print(os.path.exists(os.path.dirname(ambf_client.__file__) + '/py.typed'))"
    assert run(python, "-c", program).stdout == "True\n"


def test_the_command_line_tool_is_installed(python):
    done = run(python.parent / "ambf-cli", "--help")
    assert done.returncode == 0, done.stderr
    assert "ambf-cli" in done.stdout


def test_without_the_messages_it_says_what_to_do(python):
    done = run(python, "-c", "import ambf_client", messages=False)
    assert done.returncode != 0
    assert "setup.sh" in done.stderr
