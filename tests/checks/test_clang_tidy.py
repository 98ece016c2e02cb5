"""clang-tidy finds nothing in our code.

Checked are the files that changed, or that include a header that changed, since the commit in clang_tidy_passed (all
files where that commit is not known); `./dev tidy` writes it. A build folder also keeps what passed in it since then.
"""

import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORD = pathlib.Path(__file__).with_name("clang_tidy_passed")
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


def git(*arguments):
    return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True)


def unchanged_since(commit):
    """unchanged(paths): whether clang-tidy saw them, as they are, in that commit."""
    if git("cat-file", "-e", f"{commit}^{{commit}}").returncode != 0:
        return lambda paths: False
    names = git("diff", "--name-only", "--no-renames", commit).stdout.splitlines()
    names += git("ls-files", "--others", "--exclude-standard").stdout.splitlines()
    changed = {ROOT / name for name in names}
    if ROOT / ".clang-tidy" in changed:
        return lambda paths: False
    return lambda paths: changed.isdisjoint(paths)


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
    unchanged = unchanged_since(RECORD.read_text().strip())
    entries = [e for e in entries if not unchanged(with_own_headers(pathlib.Path(e["file"]).resolve(), set()))]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = "\n".join(f for f in pool.map(findings, entries) if f)
    assert not found, found


def test_only_what_changed_is_checked(tmp_path, monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    author = ["-c", "user.name=a", "-c", "user.email=a@b"]
    git("init", "-q")
    for name in ("one.cpp", "two.cpp"):
        (tmp_path / name).write_text("")
    git("add", ".")
    git(*author, "commit", "-q", "-m", "first")
    commit = git("rev-parse", "HEAD").stdout.strip()
    (tmp_path / "two.cpp").write_text("int i;")
    (tmp_path / "three.h").write_text("")
    unchanged = unchanged_since(commit)
    assert unchanged({tmp_path / "one.cpp"})
    assert not unchanged({tmp_path / "one.cpp", tmp_path / "two.cpp"})
    assert not unchanged({tmp_path / "one.cpp", tmp_path / "three.h"})
    (tmp_path / ".clang-tidy").write_text("")
    assert not unchanged_since(commit)({tmp_path / "one.cpp"})
    assert not unchanged_since("0" * 40)({tmp_path / "one.cpp"})
