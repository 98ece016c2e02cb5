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


def test_messages_of_crtk_are_those_of_its_programs():
    messages = pytest.importorskip("crtk_msgs.msg", reason="built without ROS")
    services = pytest.importorskip("crtk_msgs.srv")
    assert messages.OperatingState._md5sum == "b1bd4021639d9d9c5fbfff78d6ff3158"
    assert messages.StringStamped._md5sum == "5e3e46086181199270f1ac3a28a5977f"
    assert messages.SetpointMode._md5sum == "45488f3061f396e81b1a70a7e6acdfa4"
    assert messages.CartesianServo._md5sum == "6a249c3960a5b413513e5f1e23a82d6d"
    assert services.QueryInverseKinematics._md5sum == "ce8dbc3b4384e2f7567488e7e75496d8"
