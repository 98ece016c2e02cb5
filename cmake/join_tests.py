"""Joins sources of one test program to files that are compiled in one go (cmake/AmbfTogether.cmake).

Most test files have one unnamed namespace, and nothing behind it, and call their helpers by the same names. In the
joined file each is wrapped in a namespace of its own; #line keeps the places of messages.

    join_tests.py plan SIZE FILE...    prints for each FILE, in order, a line: its group, or "alone"
    join_tests.py write OUT FILE...    writes the joined file
"""

import pathlib
import re
import sys

# What a file does to the preprocessor, or a header whose macros do, would change the files behind it.
ALONE = re.compile(r"^#\s*(?:define|undef|pragma (?!once)|include <(?:X11/|GL/|EGL/|jpeglib|png\.h))", re.MULTILINE)
OUTER = re.compile(r"^namespace ambf[\w:]* \{$", re.MULTILINE)
INNER = re.compile(r"^namespace \{$", re.MULTILINE)
END = re.compile(r"^\}  // namespace\n\n?\}  // namespace ambf[\w:]*\n*\Z", re.MULTILINE)
NAMESPACE = re.compile(r"^\s*(?:inline )?namespace\b", re.MULTILINE)
BEFORE = re.compile(r"(?:\s*(?:#[^\n]*|//[^\n]*|using namespace testing;)\n)*\s*")


def can_be_joined(text):
    outer = OUTER.search(text)
    if outer is None or ALONE.search(text) or len(NAMESPACE.findall(text)) != 2 or len(INNER.findall(text)) != 1:
        return False
    before = text[: outer.start()]
    return "using" not in before and BEFORE.fullmatch(before) is not None and END.search(text) is not None


def plan(size, paths):
    # What the build itself writes is not there yet.
    there = [pathlib.Path(path).exists() for path in paths]
    fit = [there[n] and can_be_joined(pathlib.Path(path).read_text(encoding="utf-8")) for n, path in enumerate(paths)]
    if sum(fit) < 2:
        fit = [False] * len(fit)
    # Groups of about the same size: the processors share them.
    groups = max(1, -(-sum(fit) // size))
    number = 0
    for one in fit:
        print(f"joined{number % groups}" if one else "alone")
        number += one


def joined(path, number):
    text = pathlib.Path(path).read_text(encoding="utf-8")
    outer, end = OUTER.search(text), END.search(text)
    opened = text[: outer.end()] + f" namespace file{number} {{" + text[outer.end() : end.start()]
    return f'#line 1 "{path}"\n{opened}}} }}  // namespace\n}}  // namespace ambf\n'


def main(verb, first, *paths):
    if verb == "plan":
        plan(int(first), paths)
    else:
        pathlib.Path(first).write_text("\n".join(joined(p, n) for n, p in enumerate(paths)), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
