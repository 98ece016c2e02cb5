"""ambf-cli tf: with what it broadcasts, pictures and points of cameras lie where the things are that they show."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import scenes
from harness import ROOT, eventually

tf2_msgs = pytest.importorskip("tf2_msgs.msg", reason="no python3-tf2-msgs")

LAYOUTS = ROOT / "ambf_client_py/layouts"
LAUNCH = ROOT / "ambf_models/descriptions/launch_cameras.yaml"
RVIZ = Path("/usr/bin/rviz")


class Tree:
    """All transforms heard so far."""

    def __init__(self, ros):
        self.newest = {}
        self.listeners = [ros.listen(topic, tf2_msgs.TFMessage, queue_size=50) for topic in ("/tf", "/tf_static")]

    def known(self):
        for listener in self.listeners:
            for message in listener.messages:
                for each in message.transforms:
                    self.newest[each.child_frame_id] = each
        return self.newest

    def matrix(self, frame):
        """T_world_frame; None: there is no way to the world yet."""
        whole = np.eye(4)
        while frame != "world":
            if frame not in self.known():
                return None
            link = self.newest[frame]
            p, q = link.transform.translation, link.transform.rotation
            x, y, z, w = q.x, q.y, q.z, q.w
            step = np.eye(4)
            step[:3, :3] = [
                [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
            ]
            step[:3, 3] = [p.x, p.y, p.z]
            whole, frame = step @ whole, link.header.frame_id
        return whole


@pytest.fixture
def tf(master):
    """tf(*words): starts `ambf-cli tf words...`"""
    started = []

    def make(*words):
        env = dict(os.environ, ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
        env["PYTHONPATH"] = os.pathsep.join([str(ROOT / "ambf_client_py"), os.environ.get("PYTHONPATH", "")])
        command = ["env", "--ignore-signal=INT", sys.executable, "-m", "ambf_tools.cli", "tf", *map(str, words)]
        started.append(subprocess.Popen(command, env=env, stdout=subprocess.PIPE, text=True))
        return started[-1]

    yield make
    for process in started:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            assert process.wait(timeout=20) == 130


RIDER = """\
rider:
  namespace: cameras/
  name: rider
  parent: BODY Carrier
  location: {x: 0.5, y: 0.0, z: 0.0}
  look at: {x: 0.0, y: 0.0, z: 0.0}
  up: {x: 0.0, y: 0.0, z: 1.0}
  clipping plane: {near: 0.01, far: 20.0}
  field view angle: 0.8
  visible: false
  stereo: {mode: PASSIVE_LEFT_RIGHT, eye separation: 0.06, focal length: 0.5}
"""


def test_cameras_on_bodies_and_their_eyes_are_where_they_are(tmp_path, master, start, ros, tf):
    launch = scenes.write(tmp_path, scenes.model({"Carrier": scenes.box("Carrier", 1.0, (0.0, 2.0, 1.0))}))
    world = (tmp_path / "world.yaml").read_text().replace("cameras: [eye]", "cameras: [eye, rider]")
    (tmp_path / "world.yaml").write_text(world + RIDER)
    start("--launch_file", launch, "-l", "0", master_uri=master.uri)
    eventually(lambda: "/ambf/env/cameras/rider/State" in master.published(), 20.0, "the camera")
    tree = Tree(ros)
    tf()
    wanted = ("eye_optical", "rider", "rider_optical", "rider_left_optical")
    eventually(lambda: all(tree.matrix(frame) is not None for frame in wanted), 20.0, "its frames")
    assert tree.known()["rider"].header.frame_id == "Carrier"
    assert "eye_left_optical" not in tree.known()
    # Half a metre ahead of the rider is the middle of its body; the left eye is 3 cm to the left, seen along -x: at -y.
    np.testing.assert_allclose(tree.matrix("rider_optical") @ [0, 0, 0.5, 1], [0.0, 2.0, 1.0, 1.0], atol=1e-5)
    np.testing.assert_allclose(tree.matrix("rider_left_optical")[:3, 3], [0.5, 1.97, 1.0], atol=1e-5)
    np.testing.assert_allclose(tree.matrix("rider_optical")[:3, 0], [0.0, 1.0, 0.0], atol=1e-5)  # x: right
    np.testing.assert_allclose(tree.matrix("rider_optical")[:3, 1], [0.0, 0.0, -1.0], atol=1e-5)  # y: down


def test_a_camera_on_a_light_is_broadcast_with_it(tmp_path, master, start, ros, tf):
    launch = scenes.write(tmp_path)
    world = (tmp_path / "world.yaml").read_text().replace("cameras: [eye]", "cameras: [eye, rider]")
    (tmp_path / "world.yaml").write_text(world + RIDER.replace("BODY Carrier", "sun"))
    start("--launch_file", launch, "-l", "0", master_uri=master.uri)
    eventually(lambda: "/ambf/env/cameras/rider/State" in master.published(), 20.0, "the camera")
    tree = Tree(ros)
    tf("rider")
    eventually(lambda: tree.matrix("rider") is not None, 20.0, "its frame")
    assert tree.known()["rider"].header.frame_id == "sun"
    np.testing.assert_allclose(tree.matrix("rider")[:3, 3], [0.0, 0.0, 2.5], atol=1e-5)  # the sun's x axis points down


def test_a_camera_on_a_body_that_tells_nothing_is_left_out_and_named(tmp_path, master, start, run_python, ros, tf):
    carrier = scenes.box("Carrier", 1.0, (0.0, 2.0, 1.0), extra="  passive: true\n")
    launch = scenes.write(tmp_path, scenes.model({"Carrier": carrier}))
    world = (tmp_path / "world.yaml").read_text().replace("cameras: [eye]", "cameras: [eye, rider]")
    (tmp_path / "world.yaml").write_text(world + RIDER)
    start("--launch_file", launch, "-l", "0", master_uri=master.uri)
    eventually(lambda: "/ambf/env/cameras/rider/State" in master.published(), 20.0, "the camera")
    refused = run_python("-m", "ambf_tools.cli", "tf", "rider", code=1)
    assert "rider is left out" in refused.stderr and "Carrier is `passive: true`" in refused.stderr
    tree = Tree(ros)
    all_cameras = tf()
    eventually(lambda: tree.matrix("eye_optical") is not None, 20.0, "the other camera")
    assert not {"rider", "rider_optical"} & set(tree.known())
    assert "rider" not in all_cameras.stdout.readline()


def test_named_objects_and_patterns_and_what_is_not_there(bench, run_python, ros, tf):
    tree = Tree(ros)
    tf("/ambf/env/B*", "--rate", 100)
    eventually(lambda: {"Base", "Box"} <= set(tree.known()), 20.0, "its frames")
    assert "eye" not in tree.known() and "Plate" not in tree.known()
    refused = run_python("-m", "ambf_tools.cli", "tf", "nobody", code=1)
    assert "nobody" in refused.stderr


def named_by(layout):
    """(topic, class of display) of all that a layout of rviz shows."""
    import yaml

    for display in yaml.safe_load(layout.read_text())["Visualization Manager"]["Displays"]:
        for key in ("Topic", "Image Topic", "Depth Map Topic", "Color Image Topic"):
            if key in display:
                yield display[key], display["Class"]


def test_all_that_the_layout_of_rviz_names_is_published_and_placed(master, start, ros, tf):
    import roslib.message

    start("--launch_file", LAUNCH, master_uri=master.uri)
    topics = list(named_by(LAYOUTS / "cameras.rviz"))
    assert {kind for _, kind in topics} == {"rviz/PointCloud2", "rviz/DepthCloud", "rviz/Camera", "rviz/Image"}
    eventually(lambda: {topic for topic, _ in topics} <= set(master.published()), 20.0, "its topics")
    tree = Tree(ros)
    tf()
    for topic, kind in topics:
        if kind == "rviz/PointCloud2":
            assert master.published()[topic] == "sensor_msgs/PointCloud2"
        else:
            assert master.published()[topic] == "sensor_msgs/Image"
            # What rviz looks for beside a picture.
            assert master.published()[topic.rpartition("/")[0] + "/camera_info"] == "sensor_msgs/CameraInfo"
        message = ros.listen(topic, roslib.message.get_message_class(master.published()[topic])).last(30.0)
        frame = message.header.frame_id
        eventually(lambda frame=frame: tree.matrix(frame) is not None, 20.0, frame)


@pytest.mark.skipif(not RVIZ.exists(), reason="rviz of Debian is not installed")
def test_rviz_shows_points_and_pictures(tmp_path, master, start, tf):
    sys.path.insert(0, str(ROOT / "tests/acceptance/window"))
    x11 = pytest.importorskip("x11", reason="no python3-xlib")
    start("--launch_file", LAUNCH, master_uri=master.uri)
    eventually(lambda: "/ambf/env/cameras/main_camera/DepthData" in master.published(), 20.0, "the camera")
    tf()
    server = x11.XServer()
    user = x11.User(server.name)
    env = dict(os.environ, ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1", DISPLAY=server.name)
    layout = tmp_path / "cameras.rviz"  # as large as this screen
    text = (LAYOUTS / "cameras.rviz").read_text().replace("Width: 1500", f"Width: {x11.SCREEN[0]}")
    layout.write_text(text.replace("Height: 950", f"Height: {x11.SCREEN[1]}").replace("X: 20\n  Y: 20", "X: 0\n  Y: 0"))
    with open(tmp_path / "rviz.log", "w") as log:
        rviz = subprocess.Popen([RVIZ, "-d", layout], env=env, stdout=log, stderr=log)
    try:

        def wood():
            """Shares of the left and the right part of the screen in which the bench's oak is seen."""
            shown = np.frombuffer(user.picture(), np.uint8).reshape(x11.SCREEN[1], x11.SCREEN[0], 4)[:, :, 2::-1]
            red, green, blue = (shown[:, :, i].astype(int) for i in range(3))
            oak = (red > 150) & (red - blue > 40) & (red - green > 10) & (red - green < 80) & (green > blue)
            third = x11.SCREEN[0] // 4
            return oak[:, :third].mean(), oak[:, third:].mean()

        # Pictures are at the left, points in the middle.
        eventually(lambda: wood()[0] > 0.02 and wood()[1] > 0.05, 90.0, "points in the middle and pictures at the left")
    finally:
        rviz.terminate()
        rviz.wait(timeout=20)
        user.close()
        server.kill()
