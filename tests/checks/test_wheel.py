"""The wheel: what pyproject.toml says, and that CMake configures it with nothing else in it.

Building it takes minutes: `./dev learn` does, and no test.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tomllib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text())


def test_it_names_what_is_there(project):
    (version,) = re.findall(r"project\(ambf VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())
    assert project["project"]["version"] == version
    client = tomllib.loads((ROOT / "ambf_client_py/pyproject.toml").read_text())
    assert client["project"]["name"] != project["project"]["name"], "both can be installed"
    settings = project["tool"]["scikit-build"]
    packages = [ROOT / each for each in settings["wheel"]["packages"]]
    assert [each.name for each in packages] == ["ambf_core", "ambf_gym"]
    for package in packages:
        assert (package / "__init__.py").is_file()
    assert settings["wheel"]["exclude"] == ["ambf_core/native/**"], "sources stay out"
    assert project["project"]["dependencies"] == ["numpy>=1.24"], "both generations of numpy"


def test_its_packages_import_nothing_that_it_lacks(project):
    """When they are imported. Left out are those over ROS, which `backend="ros"` alone imports, and what serves SB3."""
    known = {"numpy", "gymnasium", "yaml", "ambf_core", "ambf_gym", "_ambf_core", "__future__"}
    found = set()
    for folder in ("ambf_core", "ambf_gym"):
        for file in (ROOT / "ambf_client_py" / folder).glob("*.py"):
            if file.name not in ("over_ros.py", "ros_messages.py", "ros_tasks.py", "sb3.py"):
                found |= set(re.findall(r"^(?:from|import) (\w+)", file.read_text(), re.MULTILINE))
    extra = project["project"]["optional-dependencies"]["gym"]
    assert [re.match(r"\w+", each)[0] for each in extra] == ["gymnasium", "pyyaml"]
    assert found - known <= sys.stdlib_module_names, found - known - sys.stdlib_module_names


def test_cmake_configures_it_and_nothing_else(tmp_path):
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("ROS", "CMAKE"))}
    command = ["cmake", "-S", ROOT, "-B", tmp_path, "-G", "Ninja", "-DAMBF_WHEEL=ON"]
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stderr
    compiled = json.loads((tmp_path / "compile_commands.json").read_text())
    files = [pathlib.Path(each["file"]) for each in compiled if "/build" not in each["file"]]
    folders = {file.relative_to(ROOT).parts[0] for file in files if file.is_relative_to(ROOT)}
    assert {"ambf_framework", "ambf_file_reader", "ambf_client_py"} <= folders
    assert not folders & {"ambf_plugins", "ambf_simulator", "ambf_msgs", "tests"}
    assert not any("ROS" in each["command"] for each in compiled)
    installed = "".join(each.read_text() for each in tmp_path.rglob("cmake_install.cmake"))
    for each in ("libambf_core.so.3", "libambf_view.so.3", "ambf_file_reader", "_ambf_core.", "_ambf_view."):
        assert each in installed, each
    assert "libambf_core.so.3.0" not in installed, "wheels have no links"
    assert "include/ambf" not in installed and "bin/ambf_simulator" not in installed


def test_examples_of_learning_take_what_dev_learn_installs():
    listed = re.findall(r"^([\w-]+)", (ROOT / "tools/learn-packages.txt").read_text(), re.MULTILINE)
    there = {each.replace("-", "_").lower() for each in listed} | {"ambf_core", "ambf_gym"} | sys.stdlib_module_names
    scripts = sorted((ROOT / "ambf_client_py/examples/learning").glob("*.py"))
    assert "train_psm_reach.py" in [script.name for script in scripts]
    there |= {script.stem for script in scripts}
    for script in scripts:
        text = script.read_text()
        wanted = set(re.findall(r"^\s*(?:from|import) (\w+)", text, re.MULTILINE))
        in_shell = {"ambf_tools", "ambf_client"} if "./dev shell" in text else set()  # not of the wheel
        assert wanted <= there | in_shell, script.name
