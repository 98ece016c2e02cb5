"""Shared by all pytest tests."""

import re


def pytest_addoption(parser):
    parser.addoption("--matching", metavar="REGEX", default="", help="run only tests whose id matches (as ctest -R)")


def pytest_collection_modifyitems(config, items):
    pattern = re.compile(config.getoption("--matching"))
    chosen = [item for item in items if pattern.search(item.nodeid)]
    config.hook.pytest_deselected(items=[item for item in items if item not in chosen])
    items[:] = chosen
