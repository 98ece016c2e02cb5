"""Messages as text: templates to fill in, and YAML into a message."""

import math
import time

import pytest
import std_msgs.msg
from ambf_tools.topics import texts


def test_a_template_is_what_can_be_published():
    from geometry_msgs.msg import PoseStamped
    from sensor_msgs.msg import CameraInfo, PointCloud2

    from ambf_msgs.msg import RigidBodyCmd

    for kind in (PoseStamped, RigidBodyCmd, CameraInfo, PointCloud2):
        text = texts.template(kind)
        filled = texts.fill(kind, text)
        assert filled.header.stamp.to_sec() == pytest.approx(time.time(), abs=60.0), "auto"
        for name in kind.__slots__:
            assert f"{name}:" in text
    assert texts.fill(PoseStamped, texts.template(PoseStamped)).pose.orientation.w == 1.0
    assert "# constants: TYPE_FORCE=0, TYPE_POSITION=1" in texts.template(RigidBodyCmd)
    assert "fields: []  # sensor_msgs/PointField[]: {name: '', offset: 0" in texts.template(PointCloud2)


def test_yaml_fills_by_name_or_in_order():
    from geometry_msgs.msg import Point, Vector3Stamped
    from std_msgs.msg import Empty, Float64, String

    from ambf_msgs.msg import RigidBodyCmd

    fill = texts.fill
    assert fill(Point, "{x: 1, z: 2.5}") == Point(1, 0, 2.5)
    assert fill(Point, "[1, 2, 3]") == Point(1, 2, 3)
    assert fill(Float64, "1e-3").data == 1e-3, "YAML 1.1 calls this a string"
    assert fill(Float64, "data: -2E5").data == -2e5
    assert math.isnan(fill(Float64, "data: .nan").data)
    assert fill(String, "hello").data == "hello"
    assert fill(Empty, "") == Empty()
    assert fill(RigidBodyCmd, "joint_cmds: [1, 2.5]").joint_cmds == [1, 2.5]
    assert fill(Vector3Stamped, "header: {frame_id: map, stamp: now}").header.stamp.secs > 0


@pytest.mark.parametrize(
    "text, told",
    [
        ("{x: 1", "not YAML: line 1, column 6"),
        ("x: 1\n  y: 2", "not YAML: line 2"),
        ("{u: 1}", "not a geometry_msgs/Point: No field name [u]"),
        ("{x: far}", "field x must be float"),
        ("[1, 2]", "Not enough arguments"),
        ("{x: {y: 1}}", "field x must be float"),
        ("!!python/object:os.system {}", "not YAML: line 1"),
    ],
)
def test_bad_texts_are_told_in_one_line(text, told):
    from geometry_msgs.msg import Point

    with pytest.raises(texts.TextError) as problem:
        texts.fill(Point, text)
    assert told in str(problem.value) and "\n" not in str(problem.value)


@pytest.mark.parametrize(
    "name, text, told",
    [
        ("Float32", "data: 1e308", "float too large"),
        ("Float32MultiArray", "data: [0, 1e308]", "float too large"),
        ("Time", "data: {secs: 99999999999, nsecs: 0}", "99999999999"),
        ("Time", "data: {secs: -5, nsecs: 0}", "out of range"),
        ("Duration", "data: {secs: 0, nsecs: 1e300}", "not an integer"),
        ("UInt8MultiArray", "data: abc", "bytes"),
        ("Int32", "data: 3000000000", "exceeds"),
    ],
)
def test_what_could_not_be_sent_is_refused_at_once(name, text, told):
    """Not when somebody listens, in the middle of publishing."""
    kind = getattr(std_msgs.msg, name)
    with pytest.raises(texts.TextError, match="not a std_msgs/" + name) as problem:
        texts.fill(kind, text)
    assert told in str(problem.value) and "\n" not in str(problem.value) and len(str(problem.value)) < 400
