"""Groups the sources of one target, so that those of a group can be compiled as one file (cmake/AmbfTogether.cmake).

Sources of a group share their unnamed namespaces. A group holds no two files of which one names what the other keeps
to itself; it is found by looking at the text as clang-format leaves it, and rather refuses a pair too many.

    group_sources.py SIZE FILE...

prints for each FILE, in order, a line: the name of its group, or "alone".
"""

import pathlib
import re
import sys

NOISE = re.compile(r'R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*(?:.|\n)*?\*/')
WORD = re.compile(r"[A-Za-z_]\w*")
CALL = re.compile(r"(?<![.\w:>])([A-Za-z_]\w*)(?:<[^<>();]*>)?\(")
TYPE = re.compile(r"^(?:template <.*> )?(?:(?:struct|class|union|enum(?: class)?) (\w+)|using (\w+) =)")
CONSTANT = re.compile(r"\b(k[A-Z]\w*)(?:\[\w*\])* ?[={]")
VARIABLE = re.compile(r"^[\w:<>,*& ]*?\b(\w+)(?:\[\w*\])*(?: = |;|\{)")
FUNCTION = re.compile(r"^[\w:<>,*&\[\] ]*?\b(\w+)\(")
USING = re.compile(r"^\s*using ((?:\w+::)+(\w+));", re.MULTILINE)
# Headers whose macros change what follows them, and what a file does to the preprocessor itself.
ALONE = re.compile(r"^#\s*(?:define|undef|pragma (?!once)|include <(?:X11/|GL/|EGL/|jpeglib|png\.h))", re.MULTILINE)
KEYWORDS = {"if", "for", "while", "switch", "return", "else", "do", "case", "operator", "template", "static_assert"}
KEYWORDS |= {"TEST", "TEST_F", "TEST_P", "INSTANTIATE_TEST_SUITE_P"}


class Source:
    def __init__(self, path):
        text = pathlib.Path(path).read_text(encoding="utf-8")
        self.alone = bool(ALONE.search(text))
        text = NOISE.sub(lambda found: "//" if found[0] == "//" else '""', text)
        self.words = set(WORD.findall(text))
        self.calls = set(CALL.findall(text))
        self.used = {name: path for path, name in USING.findall(text)}  # what both mean by the same words may meet
        self.names = set()  # types, constants and variables that only this file has
        self.functions = set()
        inside = False
        for line in text.splitlines():
            if line == "namespace {":
                inside = True
            elif inside and line.startswith("}") and "namespace" not in line and line.rstrip() in ("}  //", '}  ""'):
                inside = False
            elif inside or line.startswith("static "):
                self.look_at(line)

    def look_at(self, line):
        self.names |= set(CONSTANT.findall(line))
        if line[:1] in ("", " ", "}", "#", ")") or USING.match(line):
            return
        line = re.sub(r"^template <[^(){}]*> ", "", line)
        if found := TYPE.match(line):
            self.names.add(found[1] or found[2])
        elif found := FUNCTION.match(line):
            self.functions.add(found[1])
        elif found := VARIABLE.match(line):
            self.names.add(found[1])
        self.names -= KEYWORDS
        self.functions -= KEYWORDS

    def hides_from(self, other):
        if any(other.used.get(name, path) != path for name, path in self.used.items()):
            return True
        return self.names & other.words or self.functions & (other.functions | other.names | other.calls)

    def fits(self, other):
        return not (self.hides_from(other) or other.hides_from(self))


def groups_of(sources, size):
    """For each source the number of its group, or None."""
    groups = []
    chosen = []
    for source in sources:
        if source.alone:
            chosen.append(None)
            continue
        room = (n for n, group in enumerate(groups) if len(group) < size and all(map(source.fits, group)))
        number = next(room, len(groups))
        if number == len(groups):
            groups.append([])
        groups[number].append(source)
        chosen.append(number)
    return chosen


def main(size, *paths):
    for number in groups_of([Source(path) for path in paths], int(size)):
        print("alone" if number is None else f"part{number}")


if __name__ == "__main__":
    main(*sys.argv[1:])
