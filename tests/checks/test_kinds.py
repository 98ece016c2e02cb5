"""Kinds of objects are named where they are registered, nowhere else in the product (docs/decisions/0020-kinds.md)."""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
ENUMERATOR = re.compile(r"\bObjectKind::\w+")

# Files and folders that may name kinds: the tables themselves, and one file for each kind in each layer.
REGISTRIES = (
    "ambf_framework/model/kinds/",
    "ambf_framework/state/columns.",
    "ambf_framework/state/kind_rows.h",
    "ambf_framework/state/kinds.",
    "ambf_framework/state/parameters.",
    "ambf_framework/state/structure.h",
    "ambf_framework/render/panel/kinds/",
    "ambf_plugins/ros_comm/endpoints/endpoint_kinds.cpp",
)


def files_that_name_kinds():
    folders = ("ambf_framework", "ambf_plugins", "ambf_simulator")
    files = (p for f in folders for p in (ROOT / f).rglob("*") if p.suffix in (".h", ".cpp"))
    named = {p.relative_to(ROOT).as_posix() for p in files if ENUMERATOR.search(p.read_text())}
    return {name for name in named if not name.startswith(REGISTRIES)}


def test_only_registries_name_kinds():
    assert files_that_name_kinds() == set(), "ask state::info_of(kind), or register what the kind needs"
