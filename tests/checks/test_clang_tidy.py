"""clang-tidy finds nothing in our code. Files that passed are looked at again when they or their headers change."""

import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("AMBF_BUILD_DIR", ROOT / "build"))
PASSED = BUILD / "clang-tidy-passed"
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


@functools.cache
def content(path):
    return path.read_bytes()


def with_own_headers(path, seen):
    """The file and all headers of ours that it includes."""
    if path not in seen:
        seen.add(path)
        for name in INCLUDE.findall(content(path).decode()):
            for folder in (path.parent, ROOT / "ambf_framework", ROOT):
                if (folder / name).is_file():
                    with_own_headers((folder / name).resolve(), seen)
                    break
    return seen


def fingerprint(entry):
    digest = hashlib.sha256((ROOT / ".clang-tidy").read_bytes() + entry["command"].encode())
    for path in sorted(with_own_headers(pathlib.Path(entry["file"]), set())):
        digest.update(content(path))
    return digest.hexdigest()


def findings(entry):
    stamp = PASSED / fingerprint(entry)
    if stamp.exists():
        return ""
    # Debian's gcc flags are in the compile commands; clang knows most of them.
    command = ["clang-tidy-14", "--quiet", "-p", str(BUILD), "--extra-arg=-Wno-unknown-warning-option", entry["file"]]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode == 0:
        stamp.touch()
        return ""
    return done.stdout or done.stderr


@pytest.mark.timeout(1200)
def test_clang_tidy_finds_nothing():
    PASSED.mkdir(exist_ok=True)
    ours = tuple(str(ROOT / f) + os.sep for f in ("ambf_framework", "ambf_plugins", "ambf_simulator"))
    entries = [e for e in json.loads((BUILD / "compile_commands.json").read_text()) if e["file"].startswith(ours)]
    assert entries
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = "\n".join(f for f in pool.map(findings, entries) if f)
    assert not found, found
