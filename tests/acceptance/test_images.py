"""Pictures of cameras as programs get them: right way round, of the right moment, things in place, no display."""

import io
import math
import os
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
import rospy
from harness import SLOWNESS, eventually
from pictures import (
    CAMERAS,
    FIELD_OF_VIEW,
    HEIGHT,
    PLATES,
    WIDTH,
    camera,
    colored,
    middle_of,
    one_moment,
    pixels,
    write,
)
from PIL import Image as Picture
from sensor_msgs.msg import CameraInfo, CompressedImage, Image

from ambf_msgs.msg import CameraCmd, RigidBodyState, WorldRates

IMAGE_SAVER = Path("/usr/lib/image_view/image_saver")


def test_topics_are_those_of_the_original_and_what_image_tools_expect_beside_them(master, scene):
    expected = {
        "eye/ImageData": "sensor_msgs/Image",
        "eye/ImageData/compressed": "sensor_msgs/CompressedImage",
        "eye/camera_info": "sensor_msgs/CameraInfo",
        "eye/CameraInfo": "sensor_msgs/CameraInfo",
        "eye/MaskData": "sensor_msgs/Image",
        "eye/MaskData/labels": "ambf_msgs/ObjectLabels",
        "eye/DepthData": "sensor_msgs/PointCloud2",
        "eye/depth/ImageData": "sensor_msgs/Image",
        "eye/depth/camera_info": "sensor_msgs/CameraInfo",
        "pair/left/ImageData": "sensor_msgs/Image",
        "pair/right/ImageData": "sensor_msgs/Image",
        "pair/left/camera_info": "sensor_msgs/CameraInfo",
        "pair/left/CameraInfo": "sensor_msgs/CameraInfo",
        "pair/right/camera_info": "sensor_msgs/CameraInfo",
        "slow/ImageData": "sensor_msgs/Image",
    }
    published = master.published()
    assert {f"{CAMERAS}/{name}": kind for name, kind in expected.items()}.items() <= published.items()
    assert f"{CAMERAS}/flat/DepthData" not in published
    assert f"{CAMERAS}/eye/left/ImageData" not in published


def test_nothing_is_drawn_until_somebody_listens(scene, ros):
    def draws():
        with open(f"/proc/{scene.pid}/maps") as maps:
            return "libOSMesa" in maps.read()

    time.sleep(1.0)
    assert not draws()
    info = ros.listen(f"{CAMERAS}/eye/camera_info", CameraInfo)
    info.last()
    assert not draws(), "where a camera is needs no picture"
    image = ros.listen(f"{CAMERAS}/eye/ImageData", Image)
    image.last(20.0)
    assert draws()
    image.unregister()
    ros.open.remove(image)
    # What drawing took is given back after a while, and taken again when wanted.
    time.sleep(7.0 * SLOWNESS)
    ros.listen(f"{CAMERAS}/eye/ImageData", Image).last(20.0)
    assert scene.log().count("published pictures: drawn by") == 2


def test_pictures_are_the_right_way_round_and_points_where_camera_info_says(scene, ros):
    for name in ("eye", "pair", "pair/left", "pair/right", "flat", "scope"):
        image = ros.listen(f"{CAMERAS}/{name}/ImageData", Image)
        info = ros.listen(f"{CAMERAS}/{name}/camera_info", CameraInfo)
        shown, geometry = one_moment(image, info)
        array = pixels(shown)
        assert (shown.width, shown.height, shown.encoding) == (WIDTH, HEIGHT, "rgb8")
        assert (geometry.width, geometry.height) == (WIDTH, HEIGHT)
        frame = "pair_left_optical" if "/" in name else f"{name}_optical"
        assert shown.header.frame_id == geometry.header.frame_id == frame
        for plate_name, (x, y, z) in PLATES.items():
            # The camera's optical axes: x right (world y), y down (world -z), z ahead (world -x), from x = 2.
            aside = {"pair/left": -0.05, "pair/right": 0.05}.get(name, 0.0)
            point = np.array([y - aside, -z, 2.0 - x])
            ahead = 1.0 if geometry.distortion_model == "orthographic" else point[2]
            u = (geometry.K[0] * point[0] + geometry.K[1] * point[1]) / ahead + geometry.K[2]
            v = geometry.K[4] * point[1] / ahead + geometry.K[5]
            column, row = middle_of(colored(array, plate_name))
            assert abs(column - u) < 0.5 and abs(row - v) < 0.5, (name, plate_name, column, u, row, v)
        red, green = middle_of(colored(array, "Red")), middle_of(colored(array, "Green"))
        assert red[0] > green[0] and red[1] < green[1], "right is right and up is up"
        if name == "eye":
            assert abs(geometry.K[4] - HEIGHT / 2 / math.tan(FIELD_OF_VIEW / 2)) < 1e-9
        if name == "scope":
            of_the_file = [300.0, -10.0, 184.0 - 0.5, 0.0, 250.0, 108.0 - 0.5, 0.0, 0.0, 1.0]
            assert list(geometry.K) == pytest.approx(of_the_file, abs=1e-9)
            assert [geometry.P[i] for i in (0, 1, 2, 4, 5, 6, 8, 9, 10)] == pytest.approx(of_the_file, abs=1e-9)
        if name == "pair/right":
            assert abs(geometry.P[3] + geometry.K[0] * 0.1) < 1e-9


def test_the_client_s_cameras_have_pictures_as_arrays_of_the_step_that_was_made(scene, ros):
    from ambf_client import Client

    with Client() as client:
        eye, flat = client.wait_for("cameras/eye"), client.wait_for("cameras/flat")
        image = eye.image(30.0)
        assert image.shape == (HEIGHT, WIDTH, 3) and image.dtype == np.uint8
        column, row = middle_of(colored(image, "Red"))
        depth = eye.depth()
        assert depth.shape == (HEIGHT, WIDTH) and depth.dtype == np.float32
        x = PLATES["Red"][0]
        assert depth[round(row), round(column)] == pytest.approx(2.0 - x, abs=0.06)
        client.world.step(0)
        eye.set_pos(3.0, 0.0, 0.0)
        for _ in range(3):
            client.world.step(1)
        assert np.nanmin(eye.depth()) == pytest.approx(np.nanmin(depth) + 1.0, abs=0.06), "of the step that was made"
        with pytest.raises(TimeoutError, match="publish depth: true"):
            flat.depth(0.5)


@pytest.mark.parametrize("backend", ["osmesa", "egl"])
def test_either_way_of_drawing_publishes_colours_and_depth(tmp_path, master, start, ros, backend):
    arguments = ("--launch_file", write(tmp_path), "-l", "0", "--offscreen", backend)
    simulator = start(*arguments, master_uri=master.uri)
    eventually(lambda: f"{CAMERAS}/eye/depth/ImageData" in master.published(), 20.0, "the camera's topics")
    shown, depth = one_moment(
        ros.listen(f"{CAMERAS}/eye/ImageData", Image), ros.listen(f"{CAMERAS}/eye/depth/ImageData", Image)
    )
    red = colored(pixels(shown), "Red")
    assert red.sum() > 100
    column, row = (round(each) for each in middle_of(red))
    assert abs(pixels(depth)[row, column] - 2.0) < 1e-3
    simulator.wait_log("published pictures: drawn by")


def test_compressed_pictures_show_the_same(scene, ros):
    image = ros.listen(f"{CAMERAS}/eye/ImageData", Image)
    compressed = ros.listen(f"{CAMERAS}/eye/ImageData/compressed", CompressedImage)
    shown, packed = one_moment(image, compressed)
    assert "jpeg" in packed.format
    assert len(packed.data) < len(shown.data) / 5
    decoded = np.asarray(Picture.open(io.BytesIO(packed.data)).convert("RGB")).astype(int)
    assert np.abs(decoded - pixels(shown)).mean() < 4.0


def test_every_nth_picture_is_published_and_told_in_rates(scene, ros):
    every = ros.listen(f"{CAMERAS}/eye/camera_info", CameraInfo)
    third = ros.listen(f"{CAMERAS}/slow/camera_info", CameraInfo)
    second = ros.listen(f"{CAMERAS}/slow/depth/camera_info", CameraInfo)
    image = ros.listen(f"{CAMERAS}/eye/ImageData", Image)
    rates = ros.listen("/ambf/env/World/Rates", WorldRates)
    image.last(20.0)
    time.sleep(2.0 * SLOWNESS)
    begin = [len(each.messages) for each in (every, third, second)]
    time.sleep(4.0)
    counts = [len(each.messages) - first for each, first in zip((every, third, second), begin, strict=True)]
    assert counts[0] > 20
    assert abs(counts[0] / counts[1] - 3.0) < 0.3
    assert abs(counts[0] / counts[2] - 2.0) < 0.2
    told = dict(zip(rates.last().picture_topics, rates.last().pictures_per_second, strict=True))
    assert told[f"{CAMERAS}/eye/ImageData"] == pytest.approx(counts[0] / 4.0, rel=0.4)


def test_a_picture_shows_the_moment_of_its_stamp(scene, ros):
    """A plate flies through the picture: where it is seen is where its state says it was at that time."""
    from ambf_msgs.msg import RigidBodyCmd

    speed = 0.6
    talk = ros.talk("/ambf/env/Red/Command", RigidBodyCmd)
    state = ros.listen("/ambf/env/Red/State", RigidBodyState)
    image = ros.listen(f"{CAMERAS}/eye/ImageData", Image)
    info = ros.listen(f"{CAMERAS}/eye/camera_info", CameraInfo).last()
    same = ros.listen(f"{CAMERAS}/eye/CameraInfo", CameraInfo).last()  # its name in AMBF 3.0
    assert (same.K, same.P, same.width) == (info.K, info.P, info.width)
    image.last(20.0)
    command = RigidBodyCmd(cartesian_cmd_type=2)
    command.twist.linear.y = -speed
    end = time.monotonic() + 1.5
    while time.monotonic() < end:
        talk.publish(command)
        time.sleep(0.005)
    time.sleep(0.3)
    states = list(state.messages)
    times = np.array([m.header.stamp.to_nsec() for m in states], dtype=np.int64)
    places = np.array([m.pose.position.y for m in states])
    checked = 0
    for message in list(image.messages):
        stamp = message.header.stamp.to_nsec()
        if not times[0] < stamp < times[-1]:
            continue
        y = np.interp(stamp - times[0], times - times[0], places)
        found = colored(pixels(message), "Red")
        u = info.K[0] * y / 2.0 + info.K[2]
        if not 40 < u < WIDTH - 40 or abs(places[0] - y) < 0.1:
            continue
        column, _ = middle_of(found)
        # A pixel is 7.7 mm there, which the plate crosses in 13 ms.
        assert abs(column - u) < 0.75, f"{(column - u) * 2.0 / info.K[0] / speed * 1e3:.1f} ms"
        checked += 1
    assert checked > 5


def test_a_camera_that_rides_on_a_body_or_is_moved_over_ros_shows_what_it_sees_then(scene, ros):
    image = ros.listen(f"{CAMERAS}/rider/MaskData", Image)
    assert len(np.unique(pixels(image.last(20.0)))) == 2  # 5 m below: only its carrier
    talk = ros.talk(f"{CAMERAS}/rider/Command", CameraCmd)
    command = CameraCmd(enable_position_controller=True)
    command.pose.position.x, command.pose.position.z, command.pose.orientation.w = 2.0, 5.0, 1.0

    def sees():
        talk.publish(command)
        return len(np.unique(pixels(image.messages[-1]))) == 4

    eventually(sees, 10.0, "all three plates")


def test_a_paused_world_is_shown_to_who_comes_then_and_stepping_shows_each_step(scene, ros):
    from ambf_msgs.msg import WorldCmd
    from ambf_msgs.srv import Step

    talk = ros.talk("/ambf/env/World/Command", WorldCmd)
    talk.publish(WorldCmd(enable_step_throttling=True, n_skip_steps=1))
    image = ros.listen(f"{CAMERAS}/eye/ImageData", Image)
    image.last(20.0)
    step = ros.service("/ambf/env/World/Step", Step)
    for _ in range(3):
        time.sleep(0.2)
        before = time.time()
        step(n=10)
        image.next(lambda m, before=before: m.header.stamp.to_sec() >= before, 5.0, "a picture of the step")


def test_stereo_that_is_turned_on_later_says_that_it_has_no_topics(scene, ros):
    scene.allowed.append("made for cameras that are loaded with `stereo`")
    mode = f"{CAMERAS}/eye/mode"
    eventually(lambda: rospy.has_param(mode), 10.0, "parameters")
    rospy.set_param(mode, "STEREO")
    scene.wait_log(r"eye' shows both eyes .* no left/ and right/ pictures")


def test_topics_go_with_their_camera(tmp_path, master, scene, ros):
    from ambf_msgs.srv import Load, Unload

    block = camera("guest").replace("guest:\n", "CAMERA guest:\n", 1)
    (tmp_path / "guest.yaml").write_text("adf version: 1.0\nnamespace: /ambf/env/\ncameras: [CAMERA guest]\n" + block)
    topic = f"{CAMERAS}/guest/ImageData"
    answer = ros.service("/ambf/env/World/Load", Load)(path=str(tmp_path / "guest.yaml"))
    assert answer.success, answer
    eventually(lambda: topic in master.published(), 10.0, "the guest's topics")
    ros.listen(topic, Image).last(20.0)
    assert ros.service("/ambf/env/World/Unload", Unload)(model=answer.model).success
    eventually(lambda: not any("guest" in name for name in master.published()), 10.0, "the guest's topics are gone")


def test_image_view_saves_what_is_published(tmp_path, master, scene):
    """A program of others that knows nothing of us."""
    if not IMAGE_SAVER.exists():
        pytest.skip("image_saver of Debian's ros-image-view is not installed")
    environment = dict(os.environ, ROS_MASTER_URI=master.uri)
    process = subprocess.Popen(
        [IMAGE_SAVER, f"image:={CAMERAS}/eye/ImageData", f"_filename_format:={tmp_path}/%04d.%s"],
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        saved = eventually(lambda: sorted(tmp_path.glob("00*.jpg"))[:-1], 30.0, "a saved picture")
        array = np.asarray(Picture.open(saved[0]).convert("RGB"))
    finally:
        process.terminate()
        process.wait(10)
    assert array.shape == (HEIGHT, WIDTH, 3)
    red, green = middle_of(colored(array, "Red")), middle_of(colored(array, "Green"))
    assert red[0] > green[0] and red[1] < green[1]
