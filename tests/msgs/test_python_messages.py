"""The generated Python classes have the wire formats that clients, scripts and bags were built against."""

import pathlib

import pytest

FROZEN = pathlib.Path(__file__).parent / "md5sums.txt"


def test_md5sums_are_the_frozen_ones():
    messages = pytest.importorskip("ambf_msgs.msg", reason="built without ROS")
    services = pytest.importorskip("ambf_msgs.srv")
    generated = {n: c._md5sum for n, c in vars(messages).items() if hasattr(c, "_slot_types")}
    generated |= {n: c._md5sum for n, c in vars(services).items() if hasattr(c, "_request_class")}
    lines = FROZEN.read_text().splitlines()
    assert generated == dict(line.split() for line in lines if line and not line.startswith("#"))
