"""Layouts of plotting programs name topics and fields: each is there on a live simulator."""

import re
import xml.etree.ElementTree as ElementTree

import pytest
import roslib.message
from harness import BENCH_ALLOWED, ROOT, eventually

LAYOUTS = ROOT / "ambf_client_py/layouts"
LAUNCH = ROOT / "ambf_models/descriptions/launch.yaml"
SCENES = {"arm7": 2, "peg_transfer": 1, "rates": 1}


def curves(name):
    """What both files of a layout show."""
    tree = ElementTree.parse(LAYOUTS / f"{name}.plotjuggler.xml")
    of_plotjuggler = [curve.get("name") for curve in tree.iter("curve")]
    lines = (LAYOUTS / f"{name}.rqt_plot").read_text().split("\n")
    of_rqt = [line for line in lines if line and not line.startswith("#")]
    assert of_plotjuggler and of_plotjuggler == of_rqt
    return of_rqt


def test_every_layout_is_tested():
    # That of rviz: test_frames.py.
    assert {file.name.split(".")[0] for file in LAYOUTS.iterdir() if file.suffix != ".rviz"} == set(SCENES)


@pytest.mark.parametrize("name", SCENES)
def test_all_that_a_layout_names_is_published(name, start, master, ros):
    start("--launch_file", LAUNCH, "-l", SCENES[name], master_uri=master.uri, allowed=BENCH_ALLOWED)
    eventually(lambda: "/ambf/env/World/Rates" in master.published(), 30)
    newest = {}
    for curve in curves(name):
        topic = eventually(
            lambda curve=curve: next((t for t in master.published() if curve.startswith(t + "/")), None),
            20,
            f"a topic for {curve}",
        )
        if topic not in newest:
            kind = roslib.message.get_message_class(master.published()[topic])
            newest[topic] = ros.listen(topic, kind)
            if topic.endswith("/State") and hasattr(kind(), "joint_positions"):
                ask_for_joints(ros, topic)

    for curve in curves(name):
        topic = next(t for t in newest if curve.startswith(t + "/"))
        path = re.findall(r"[^/\[\]]+", curve[len(topic) :])
        eventually(lambda topic=topic, path=path: value_at(newest[topic].last(), path) is not None, 10, curve)


def ask_for_joints(ros, topic):
    """As every client does."""
    from ambf_msgs.msg import RigidBodyCmd

    command = RigidBodyCmd(cartesian_cmd_type=-1, publish_joint_names=True, publish_joint_positions=True)
    ros.talk(topic.removesuffix("State") + "Command", RigidBodyCmd).publish(command)


def value_at(message, path):
    """The number there; None: not there (yet)."""
    for part in path:
        if part.isdigit():
            if int(part) >= len(message):
                return None
            message = message[int(part)]
        else:
            message = getattr(message, part)
    return float(message)
