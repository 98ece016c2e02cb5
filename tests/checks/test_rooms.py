"""Limits that keep the tree readable: columns, lengths of files, sizes of folders, words.

What is over a limit today is counted in style_debt.toml, folder by folder. A count may fall, never rise; whoever cleans
a folder lowers its number there (python tests/checks/test_rooms.py prints the counts of today).
"""

import collections
import pathlib
import re
import tomllib

from test_style import ROOT, tree_files

DEBT = pathlib.Path(__file__).with_name("style_debt.toml")
PRODUCT = ("ambf_framework/", "ambf_plugins/", "ambf_simulator/", "ambf_file_reader/", "ambf_client_py/")
COLUMNS, LINES, FILES = 120, 350, 40
# A longer file says why in its first lines: "Long: REASON".
REASON = re.compile(r"^(//|#|\"\"\")?.*\bLong: \S", re.MULTILINE)
# docs/glossary.md, "Say instead": names and comments of the product.
WORDS = re.compile(
    r"\bk(Most|Least|Farthest|Deepest)[A-Z]\w*|\b(most|least|deepest|farthest)_\w+"
    r"|\b(mourn|bury|buried|nobody's|whoever)\b|\b(tells?|told)\b"
)


def room(file):
    """The folder that its debt is counted for."""
    return "/".join(file.split("/")[:-1][:2]) or "."


def sources():
    return tree_files("*.h", "*.cpp", "*.py", "*.cmake", "*CMakeLists.txt", "dev", ".ci/run")


def text_of(file):
    return (ROOT / file).read_text(encoding="utf-8")


def long_lines():
    counts = collections.Counter()
    for file in sources():
        counts[room(file)] += sum(len(line) > COLUMNS for line in text_of(file).splitlines())
    return +counts


def discouraged_words():
    counts = collections.Counter()
    for file in sources():
        if file.startswith(PRODUCT):
            counts[room(file)] += len(WORDS.findall(text_of(file)))
    return +counts


def long_files():
    counts = {}
    for file in sources():
        lines = text_of(file).splitlines()
        if file.startswith(PRODUCT) and len(lines) > LINES and not REASON.search("\n".join(lines[:10])):
            counts[file] = len(lines)
    return counts


def large_folders():
    counts = collections.Counter(
        str(pathlib.PurePath(file).parent)
        for file in sources()
        if file.startswith(PRODUCT) and file.endswith((".h", ".cpp", ".py"))
    )
    return {folder: count for folder, count in counts.items() if count > FILES}


KINDS = (long_lines, discouraged_words, long_files, large_folders)


def risen(found, allowed):
    """What is counted more often than allowed."""
    return {
        key: f"{count}, allowed {allowed.get(key, 0)}" for key, count in found.items() if count > allowed.get(key, 0)
    }


def debt(kind):
    return tomllib.loads(DEBT.read_text()).get(kind.__name__, {})


def test_lines_end_within_the_columns():
    assert risen(long_lines(), debt(long_lines)) == {}


def test_words_are_those_of_the_glossary():
    assert risen(discouraged_words(), debt(discouraged_words)) == {}


def test_files_are_short_or_say_why_not():
    assert risen(long_files(), debt(long_files)) == {}


def test_folders_are_small():
    assert risen(large_folders(), debt(large_folders)) == {}


def test_a_count_may_fall_and_never_rises():
    assert risen({"a": 2, "b": 1}, {"a": 3, "c": 1}) == {"b": "1, allowed 0"}
    assert risen({"a": 4}, {"a": 3}) == {"a": "4, allowed 3"}


def main():
    for kind in KINDS:
        print(f"[{kind.__name__}]")
        for key, count in sorted(kind().items()):
            print(f'"{key}" = {count}')
        print()


if __name__ == "__main__":
    main()
