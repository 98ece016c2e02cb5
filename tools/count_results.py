"""Sums JUnit result files and prints one line, "N passed, N failed", with ", N skipped" where some were.

Usage: count_results.py FOLDER... (all *.xml in them). Exits 1 when a test failed or none ran at all.
"""

import collections
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def outcome(case):
    # GoogleTest marks what did not run in an attribute, pytest in child elements.
    if case.find("failure") is not None or case.find("error") is not None:
        return "failed"
    if case.find("skipped") is not None or case.get("status") == "notrun":
        return "skipped"
    return "passed"


def main():
    counts = collections.Counter()
    for folder in sys.argv[1:]:
        for file in sorted(pathlib.Path(folder).glob("*.xml")):
            for case in ElementTree.parse(file).iter("testcase"):
                result = outcome(case)
                counts[result] += 1
                if result != "passed" or case.get("unsteady"):
                    name = "::".join(filter(None, (case.get("classname"), case.get("name"))))
                    print(f"{'unsteady, passed at a second try' if case.get('unsteady') else result}: {name}")
    if not counts:
        print("no test ran: none has this in its name (a part of a name, or a regular expression)")
    skipped = f", {counts['skipped']} skipped" if counts["skipped"] else ""
    print(f"{counts['passed']} passed, {counts['failed']} failed{skipped}")
    return 1 if counts["failed"] or not counts["passed"] else 0


if __name__ == "__main__":
    sys.exit(main())
