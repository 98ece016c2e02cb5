"""Every #include obeys layers.toml, and the headers that ROS code includes parse as C++17."""

import functools
import pathlib
import re
import subprocess
import tomllib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FRAMEWORK = ROOT / "ambf_framework"
LAYERS = tomllib.loads((pathlib.Path(__file__).parent / "layers.toml").read_text())
ROW = {folder: row for row, folders in enumerate(LAYERS["rows"]) for folder in folders}
PACKAGES = {name: (re.compile(p["headers"]), p["folders"]) for name, p in LAYERS["packages"].items()}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def sources():
    outside = ("ambf_plugins", "ambf_simulator", "ambf_client_py", "ambf_file_reader")
    folders = [FRAMEWORK, *(ROOT / folder for folder in outside)]
    return sorted(p for f in folders for p in f.rglob("*") if p.suffix in (".h", ".cpp"))


@functools.cache
def includes(path):
    return INCLUDE.findall(path.read_text())


def framework_folder(path):
    return path.relative_to(FRAMEWORK).parts[0] if path.is_relative_to(FRAMEWORK) else None


def upward_room(own, target):
    """The room of its folder that a file may not use, of the two that an include connects; else None."""
    folder = framework_folder(own)
    rooms = LAYERS["rooms"].get(folder)
    if rooms is None:
        return None
    of = [p.relative_to(FRAMEWORK / folder).parts[0] for p in (own, target)]
    missing = [room for room in of if room not in rooms]
    return missing[0] if missing else of[1] if rooms.index(of[1]) > rooms.index(of[0]) else None


def package_of(header):
    return next((name for name, (pattern, _) in PACKAGES.items() if pattern.fullmatch(header)), None)


@functools.cache
def packages_seen_through(path):
    """Third-party packages that a header of ours brings along."""
    seen = set()
    for _, header in includes(path):
        if package := package_of(header):
            seen.add(package)
        elif (FRAMEWORK / header).is_file() and FRAMEWORK / header != path:
            seen |= packages_seen_through(FRAMEWORK / header)
    return frozenset(seen)


def complaints_about(path):
    own = framework_folder(path)
    name = path.relative_to(ROOT)
    for bracket, header in includes(path):
        if package := package_of(header):
            if not set(name.parts) & set(PACKAGES[package][1]):
                yield f"{name}: <{header}> may be included only in {', '.join(PACKAGES[package][1])}"
            continue
        if bracket == "<":
            # Left are the standard library's headers (no dot) and the system's (plain C names).
            if re.fullmatch(r"[a-z0-9_]+|((sys|linux|netinet|arpa)/)?[a-z0-9_]+\.h|tl/expected\.hpp|fmt/.*", header):
                continue
            yield f"{name}: <{header}> belongs to no package of layers.toml"
            continue
        target = FRAMEWORK / header
        if not target.is_file():
            if not any((base / header).is_file() for base in (path.parent, ROOT, ROOT / "ambf_plugins")) or own:
                yield f'{name}: "{header}" is not a path below ambf_framework/'
            continue
        used = framework_folder(target)
        if used == own:
            if room := upward_room(path, target):
                yield f'{name}: "{header}": {own}/{room} is no room below it (layers.toml)'
            continue
        if used not in ROW or (own and own not in ROW):
            yield f"{name}: folder {used} or {own} is missing in layers.toml"
        elif own and (ROW[used] <= ROW[own] or used in LAYERS["never"].get(own, [])):
            yield f'{name}: "{header}": {own} may not use {used}'
        elif packages := packages_seen_through(target):
            yield f'{name}: "{header}" is private to {used}: it includes {", ".join(sorted(packages))}'


def test_every_include_obeys_the_layers():
    assert sources()
    complaints = "\n".join(c for path in sources() for c in complaints_about(path))
    assert not complaints, complaints


def test_a_wrong_include_is_noticed(tmp_path, monkeypatch):
    bad = {
        "math/up.h": '#include "runtime/simulation.h"\n',
        "runtime/simulation.h": "",
        "math/third.h": "#include <yaml-cpp/yaml.h>\n",
        "physics/inside.h": "#include <BulletDynamics/btWorld.h>\n",
        "model/uses_inside.cpp": '#include "physics/inside.h"\n',
        "comm/peeks.cpp": '#include "physics/face.h"\n',
        "physics/face.h": "",
        "render/sideways.cpp": '#include "comm/peeks.h"\n',
        "comm/peeks.h": "",
        "base/nowhere.cpp": '#include "nowhere.h"\n',
        "render/gl/up.cpp": '#include "render/window/part.h"\n',
        "render/window/part.h": '#include "render/gl/detail/functions.h"\n',
        "render/gl/detail/functions.h": "",
        "render/attic/unknown.cpp": '#include "render/gl/detail/functions.h"\n',
    }
    framework = tmp_path / "ambf_framework"
    for name, text in bad.items():
        (framework / name).parent.mkdir(parents=True, exist_ok=True)
        (framework / name).write_text(text)
    monkeypatch.setitem(globals(), "ROOT", tmp_path)
    monkeypatch.setitem(globals(), "FRAMEWORK", framework)
    complained = {str(p.relative_to(framework)) for p in sources() if any(complaints_about(p))}
    assert complained == {
        "math/up.h",
        "math/third.h",
        "model/uses_inside.cpp",
        "comm/peeks.cpp",
        "render/sideways.cpp",
        "base/nowhere.cpp",
        "render/gl/up.cpp",
        "render/attic/unknown.cpp",
    }


def cxx17_headers():
    return sorted(h for folder in LAYERS["cxx17"] for h in (FRAMEWORK / folder).rglob("*.h"))


def errors_as_cxx17(*headers):
    command = ["c++", "-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror"]
    command += ["-I", str(FRAMEWORK), "-isystem", "/usr/include/eigen3", "-x", "c++", "-"]
    text = "".join(f'#include "{header.relative_to(FRAMEWORK)}"\n' for header in headers)
    return subprocess.run(command, input=text, capture_output=True, text=True).stderr


def comes_first_in_its_source(header):
    source = header.with_suffix(".cpp")
    return source.exists() and includes(source)[:1] == [('"', str(header.relative_to(FRAMEWORK)))]


def test_headers_next_to_ros_parse_as_cxx17():
    assert len(cxx17_headers()) > 50
    assert errors_as_cxx17(*cxx17_headers()) == ""


# The others are first in a source of their own: the build shows that they parse alone.
@pytest.mark.parametrize(
    "header",
    [h for h in cxx17_headers() if not comes_first_in_its_source(h)],
    ids=lambda h: str(h.relative_to(FRAMEWORK)),
)
def test_header_next_to_ros_parses_alone(header):
    assert errors_as_cxx17(header) == ""
