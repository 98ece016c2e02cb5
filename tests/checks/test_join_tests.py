"""Test files that are compiled as one keep their names to themselves, and their places in messages."""

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake"))

import join_tests  # noqa: E402

FILE = """#include <cstdio>

namespace ambf::{room} {{
{more}
namespace {{

int value() {{ return {value}; }}
const int kept = value();
{test}
}}  // namespace

}}  // namespace ambf::{room}
"""


def text(room="math", more="", value=1, test=""):
    return FILE.format(room=room, more=more, value=value, test=test)


def test_files_with_something_for_others_stay_alone():
    assert join_tests.can_be_joined(text())
    assert join_tests.can_be_joined(text(more="using namespace std;\n"))
    assert not join_tests.can_be_joined("#define A 1\n" + text()), "the next file would see the macro"
    assert not join_tests.can_be_joined("using std::size_t;\n" + text())
    assert not join_tests.can_be_joined(text() + "int main() {}\n")
    behind = "}  // namespace\nint given() { return 1; }\n"
    assert not join_tests.can_be_joined(text().replace("}  // namespace\n", behind))
    assert not join_tests.can_be_joined(text() + text(room="base"))


def test_one_file_alone_is_not_joined_and_groups_are_of_one_size(tmp_path, capsys):
    files = []
    for number in range(5):
        files.append(tmp_path / f"{number}.cpp")
        files[-1].write_text(text() if number != 2 else "int main() {}\n")
    join_tests.plan(3, files)
    assert capsys.readouterr().out.split() == ["joined0", "joined1", "alone", "joined0", "joined1"]
    join_tests.plan(3, files[2:4])
    assert capsys.readouterr().out.split() == ["alone", "alone"]


def test_equal_names_do_not_meet_and_messages_name_the_line(tmp_path):
    files = [tmp_path / "one.cpp", tmp_path / "two.cpp"]
    files[0].write_text(text(value=1))
    files[1].write_text(text(value=2, test="int wrong() { return nothing; }"))
    join_tests.main("write", tmp_path / "out.cpp", *files)
    done = subprocess.run(["g++", "-fsyntax-only", tmp_path / "out.cpp"], capture_output=True, text=True)
    errors = [line for line in done.stderr.splitlines() if "error" in line]
    assert len(errors) == 1 and f"{files[1]}:9:" in errors[0], done.stderr
