"""clang-tidy finds nothing in our code.

Checked are the files whose code changed since the commit in clang_tidy_passed (all files where that commit is not
known), and for each header whose code changed one file that includes it; `./dev tidy` writes that commit. Comments do
not count. A build folder also keeps what passed in it since then.
"""

import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORD = pathlib.Path(__file__).with_name("clang_tidy_passed")
BUILD = pathlib.Path(os.environ.get("AMBF_BUILD_DIR", ROOT / "build"))
PASSED = BUILD / "clang-tidy-passed"
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
COMMENT = re.compile(r"//(?!\s*NOLINT).*")


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


def code(text):
    return COMMENT.sub("", text).split()


def changed_since(commit):
    """Files of ours whose code is another than in that commit; None: all may be."""
    if git("cat-file", "-e", f"{commit}^{{commit}}").returncode != 0:
        return None
    names = git("diff", "--name-only", "--no-renames", "--diff-filter=d", commit).stdout.splitlines()
    names += git("ls-files", "--others", "--exclude-standard").stdout.splitlines()
    if ".clang-tidy" in names:
        return None
    sources = [name for name in names if name.endswith((".h", ".cpp"))]
    return {ROOT / name for name in sources if code(git("show", f"{commit}:{name}").stdout) != code(text_of(name))}


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def to_check(files, changed):
    """Of the source files those that changed, and one for each header that changed, by preference its own."""
    chosen = [file for file in files if file in changed]
    including = {file: with_own_headers(file, set()) for file in files}
    for header in sorted(changed - set(files)):
        if not any(header in including[file] for file in chosen):
            users = [file for file in files if header in including[file]]
            chosen += sorted(users, key=lambda file: (file.stem != header.stem, len(including[file])))[:1]
    return chosen


def fingerprint(entry):
    digest = hashlib.sha256((ROOT / ".clang-tidy").read_bytes() + entry["command"].encode())
    for path in sorted(with_own_headers(pathlib.Path(entry["file"]), set())):
        digest.update(content(path))
    return digest.hexdigest()


def flags(entry):
    """What the file is compiled with, but for precompiled headers: these are gcc's and hide missing includes."""
    command = re.sub(r"-include \S*cmake_pch\.hxx|-Winvalid-pch|-o \S+|-c \S+", "", entry["command"])
    words = shlex.split(command)
    while not words[0].startswith("-"):  # ccache and the compiler
        words.pop(0)
    return words


def single(entries):
    """Entries of single files also where several are compiled as one (AMBF_TOGETHER)."""
    for entry in entries:
        file = pathlib.Path(entry["file"])
        if file.parent.name == "Unity":
            for name in INCLUDE.findall(file.read_text(encoding="utf-8")):
                yield {**entry, "file": name}
        else:
            yield entry


def findings(entry):
    stamp = PASSED / fingerprint(entry)
    if stamp.exists():
        return ""
    # Debian's gcc flags are in the compile commands; clang knows most of them.
    command = ["clang-tidy-14", "--quiet", entry["file"], "--", *flags(entry), "-Wno-unknown-warning-option"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=entry["directory"])
    if done.returncode == 0:
        stamp.touch()
        return ""
    return done.stdout or done.stderr


@pytest.mark.timeout(2400)
def test_clang_tidy_finds_nothing():
    PASSED.mkdir(exist_ok=True)
    folders = ("ambf_framework", "ambf_plugins", "ambf_simulator", "ambf_file_reader")
    ours = tuple(str(ROOT / f) + os.sep for f in folders)
    compiled = json.loads((BUILD / "compile_commands.json").read_text())
    entries = [entry for entry in single(compiled) if entry["file"].startswith(ours)]
    assert entries
    changed = changed_since(RECORD.read_text().strip())
    if changed is not None:
        chosen = set(to_check([pathlib.Path(e["file"]).resolve() for e in entries], changed))
        entries = [e for e in entries if pathlib.Path(e["file"]).resolve() in chosen]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = "\n".join(f for f in pool.map(findings, entries) if f)
    assert not found, found


def test_only_what_changed_is_checked(tmp_path, monkeypatch):
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    author = ["-c", "user.name=a", "-c", "user.email=a@b"]
    git("init", "-q")
    one, two, three, header = (tmp_path / name for name in ("one.cpp", "two.cpp", "three.cpp", "three.h"))
    for file in (one, two, header):
        file.write_text("int i;  // a number\n")
    three.write_text('#include "three.h"\n')
    git("add", ".")
    git(*author, "commit", "-q", "-m", "first")
    commit = git("rev-parse", "HEAD").stdout.strip()
    one.write_text("int i;  // another comment\n")
    two.write_text("int k;\n")
    header.write_text("int i;  // NOLINT\n")
    assert changed_since(commit) == {two, header}
    assert to_check([one, two, three], {two, header}) == [two, three]
    (tmp_path / ".clang-tidy").write_text("")
    assert changed_since(commit) is None
    assert changed_since("0" * 40) is None
