"""An installed tree works from wherever it is moved to: for programs, plugins built elsewhere, and Python."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("AMBF_BUILD_DIR", ROOT / "build"))

CONSUMER_CMAKE = """
cmake_minimum_required(VERSION 3.25)
project(consumer LANGUAGES CXX)
find_package(AMBF 3 REQUIRED)
add_executable(consumer consumer.cpp)
target_link_libraries(consumer PRIVATE AMBF::TARGET)
"""
# A plugin without windows; and one that opens them, built as before there were two libraries.
CONSUMERS = {
    "core": """
#include <base/diagnostic.h>
#include <runtime/simulation.h>
#include <cstdio>
int main() {
  ambf::base::Log log;
  ambf::runtime::Simulation simulation({}, {}, {}, log);
  ambf::base::Diagnostic diagnostic;
  diagnostic.file = "scene.yaml";
  std::puts(ambf::base::to_string(diagnostic).c_str());
}
""",
    "ambf_framework": """
#include <render/window/viewer.h>
#include <runtime/simulation.h>
#include <cstdio>
int main(int count, char**) {
  ambf::base::Log log;
  ambf::runtime::Simulation simulation({}, {}, {}, log);
  std::string why;
  if (count > 1) ambf::render::Viewer::open(simulation.abilities(), log, {}, why);
  std::puts("scene.yaml");
}
""",
}


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def moved_tree(tmp_path_factory):
    folder = tmp_path_factory.mktemp("install")
    run("cmake", "--install", BUILD, "--prefix", folder / "first")
    return shutil.move(folder / "first", folder / "moved here")


@pytest.mark.parametrize("target", CONSUMERS)
def test_a_plugin_builds_against_the_moved_tree(moved_tree, tmp_path, target):
    (tmp_path / "CMakeLists.txt").write_text(CONSUMER_CMAKE.replace("TARGET", target))
    (tmp_path / "consumer.cpp").write_text(CONSUMERS[target])
    run("cmake", "-S", tmp_path, "-B", tmp_path / "build", f"-DCMAKE_PREFIX_PATH={moved_tree}")
    run("cmake", "--build", tmp_path / "build")
    assert "scene.yaml" in run(tmp_path / "build/consumer")


def test_the_example_of_a_driver_builds_against_the_moved_tree(moved_tree, tmp_path):
    example = moved_tree / "share/ambf/plugin_examples/circle_driver"
    run("cmake", "-S", example, "-B", tmp_path, f"-DCMAKE_PREFIX_PATH={moved_tree}")
    run("cmake", "--build", tmp_path)
    assert "ambf_driver_library" in run("nm", "--dynamic", "--defined-only", tmp_path / "libambf_driver_circle.so")


def test_the_core_needs_no_graphics(moved_tree):
    graphics = re.compile(r"lib(GL\w*|EGL|OSMesa|glfw|X\w+|xcb|wayland|imgui|png|jpeg)\b")
    needs = run("ldd", moved_tree / "lib/libambf_core.so")
    assert graphics.findall(needs) == []
    assert "glfw" in graphics.findall(run("ldd", moved_tree / "lib/libambf_view.so")), "the pattern finds what there is"
    # Dear ImGui and the font reader are static: they would be inside.
    assert "ImGui" not in run("nm", "--dynamic", "--defined-only", moved_tree / "lib/libambf_core.so")


def test_installed_headers_are_whole_and_only_the_public_ones(moved_tree):
    include = moved_tree / "include/ambf"
    headers = list(include.rglob("*.h"))
    missing = {
        f"{header.relative_to(include)}: {name}"
        for header in headers
        for name in re.findall(r'#include "([^"]+)"', header.read_text())
        if not (include / name).exists()
    }
    assert missing == set()
    folders = {str(header.parent.relative_to(include)) for header in headers}
    private = ("detail", "render/panel", "render/marks", "physics/", "mesh/")
    assert not [folder for folder in folders if any(part in folder for part in private)]


def test_the_moved_simulator_starts(moved_tree):
    if not (BUILD / "bin/ambf_simulator").exists():
        pytest.skip("this build has no simulator")
    simulator = moved_tree / "bin/ambf_simulator"
    assert "3.0.0" in run(simulator, "--version", cwd="/")
    assert str(BUILD) not in run("ldd", simulator), "it still uses the library of the build tree"
    assert os.access(moved_tree / "lib/ambf/ambf_file_reader", os.X_OK), "where the library looks for it"


def test_python_finds_the_messages_after_sourcing_setup(moved_tree):
    if not (BUILD / "ros").is_dir():
        pytest.skip("built without ROS")
    command = '. "$1/share/ambf/setup.sh" && exec "$2" -c "import ambf_msgs.msg; print(ambf_msgs.__file__)"'
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    assert str(moved_tree) in run("bash", "-c", command, "-", moved_tree, sys.executable, env=environment, cwd="/")
    command = command.replace(
        "import ambf_msgs.msg; print(ambf_msgs", "import ambf_client, ambf_comm; print(ambf_client"
    )
    output = run("bash", "-c", command, "-", moved_tree, sys.executable, env=environment, cwd="/")
    assert output.startswith(str(moved_tree)), "it still uses the client of the source tree"


def test_nothing_is_installed_outside_the_prefix(moved_tree):
    scripts = [s.read_text() for s in BUILD.rglob("cmake_install.cmake")]
    assert scripts
    foreign = [line for s in scripts for line in s.splitlines() if "INSTALL DESTINATION" in line and 'ION "/' in line]
    assert foreign == []
    assert {p.name for p in moved_tree.iterdir()} <= {"bin", "lib", "include", "share"}
