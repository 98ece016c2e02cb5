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
import scenes
from harness import SLOWNESS, eventually
from PIL import Image as Picture
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, PointCloud2

from ambf_msgs.msg import CameraCmd, ObjectLabels, RigidBodyState, WorldRates

WIDTH, HEIGHT = 320, 240
FIELD_OF_VIEW = 0.8
CAMERAS = "/ambf/env/cameras"
SHADERS = Path(__file__).resolve().parents[1] / "render/shaders"
IMAGE_SAVER = Path("/usr/lib/image_view/image_saver")


def camera(name, extra="", location="{x: 2.0, y: 0.0, z: 0.0}", look_at="{x: 0.0, y: 0.0, z: 0.0}"):
    return f"""\
{name}:
  namespace: cameras/
  name: {name}
  location: {location}
  look at: {look_at}
  up: {{x: 0.0, y: 0.0, z: 1.0}}
  clipping plane: {{near: 0.01, far: 20.0}}
  field view angle: {FIELD_OF_VIEW}
  publish image: true
  publish image resolution: {{width: {WIDTH}, height: {HEIGHT}}}
{extra}"""


CAMERA_BLOCKS = {
    "eye": camera(
        "eye",
        f"  publish depth: true\n  publish depth interval: 1\n"
        f"  publish depth resolution: {{width: {WIDTH}, height: {HEIGHT}}}\n",
    ),
    "slow": camera(
        "slow",
        "  visible: false\n  publish image interval: 3\n  publish depth: true\n  publish depth interval: 2\n"
        "  publish depth resolution: {width: 80, height: 60}\n"
        "  publish depth noise: {mean: 0.05, std_dev: 0.01, bias: 0.02}\n",
    ),
    "pair": camera("pair", "  stereo: {mode: PASSIVE_LEFT_RIGHT, eye separation: 0.1, focal length: 2.0}\n"),
    "flat": camera("flat", "  orthographic view width: 2.0\n"),
    "sensor": camera(
        "sensor",
        f"  publish depth: true\n  publish depth interval: 1\n"
        f"  publish depth resolution: {{width: {WIDTH}, height: {HEIGHT}}}\n"
        f"  depth compute shaders: {{path: {SHADERS}, vertex: points.vs, fragment: half_range.fs}}\n",
    ),
    "rider": camera("rider", "  parent: BODY Carrier\n", "{x: 2.0, y: 0.0, z: 0.0}", "{x: 0.0, y: 0.0, z: 0.0}"),
}

COLORS = "red: {r: 230, g: 20, b: 20}\ngreen: {r: 20, g: 200, b: 20}\nblue: {r: 20, g: 20, b: 230}\n"


def plate(name, color, position, y=0.2, z=0.1):
    """So thin that its picture is its front face, whose middle is where it is."""
    px, py, pz = position
    return f"""\
BODY {name}:
  name: {name}
  mass: 1.0
  inertia: {{ix: 0.01, iy: 0.01, iz: 0.01}}
  location: {{position: {{x: {px}, y: {py}, z: {pz}}}, orientation: {{r: 0.0, p: 0.0, y: 0.0}}}}
  shape: BOX
  geometry: {{x: 0.0002, y: {y}, z: {z}}}
  collision shape: BOX
  collision geometry: {{x: 0.01, y: {y}, z: {z}}}
  damping: {{linear: 0.0, angular: 0.0}}
  color: {color}
"""


PLATES = {"Red": (0.0, 0.45, 0.3), "Green": (0.5, -0.3, -0.25), "Blue": (-0.4, 0.1, 0.0)}
MODEL = scenes.model(
    {
        **{name: plate(name, name.lower(), position) for name, position in PLATES.items()},
        "Carrier": scenes.box("Carrier", 1.0, (0.0, 0.0, -5.0)),
    }
)


def write(folder):
    launch = scenes.write(folder, MODEL)
    world = scenes.WORLD.split("cameras: [eye]")
    world = world[0] + "cameras: [" + ", ".join(CAMERA_BLOCKS) + "]" + world[1].split("eye:\n")[0]
    # From above the cameras, so that nothing mirrors the light.
    world = world.replace("location: {x: 0.0, y: 0.0, z: 3.0}", "location: {x: 4.0, y: 0.0, z: 4.0}")
    world = world.replace("direction: {x: 0.0, y: 0.0, z: -1.0}", "direction: {x: -1.0, y: 0.0, z: -1.0}")
    (folder / "world.yaml").write_text(world + "".join(CAMERA_BLOCKS.values()))
    (folder / "colors.yaml").write_text(scenes.COLORS + COLORS)
    return launch


@pytest.fixture
def scene(tmp_path, master, start):
    simulator = start("--launch_file", write(tmp_path), "-l", "0", master_uri=master.uri, allowed=["WatchDog expired"])
    last = {f"{CAMERAS}/{name}/MaskData/labels" for name in CAMERA_BLOCKS}
    last |= {f"{CAMERAS}/pair/right/camera_info", f"{CAMERAS}/slow/depth/camera_info", "/ambf/env/Carrier/State"}
    eventually(lambda: last <= set(master.published()), 20.0, "the cameras' topics")
    yield simulator
    simulator.stop()
    eventually(lambda: not master.names(), 5.0, "no topics are left behind")


def pixels(image):
    kinds = {"rgb8": (np.uint8, 3), "mono16": (np.uint16, 1), "32FC1": (np.float32, 1)}
    kind, channels = kinds[image.encoding]
    assert image.step == image.width * channels * np.dtype(kind).itemsize
    array = np.frombuffer(image.data, dtype=kind).reshape(image.height, image.width, channels)
    return array if channels > 1 else array[:, :, 0]


def middle_of(pixels_of_it):
    rows, columns = np.nonzero(pixels_of_it)
    assert len(rows) > 20
    return columns.mean(), rows.mean()


def colored(array, name):
    """Where a picture shows a plate."""
    channel = {"Red": 0, "Green": 1, "Blue": 2}[name]
    others = [array[:, :, c].astype(int) for c in range(3) if c != channel]
    return array[:, :, channel].astype(int) > np.maximum(*others) + 40


def cloud_points(message):
    assert [field.name for field in message.fields] == ["x", "y", "z", "rgb"]
    raw = np.frombuffer(message.data, dtype=np.float32).reshape(message.height, message.width, 4)
    return raw[:, :, :3], raw[:, :, 3].copy().view(np.uint32)


def matching(stamp, *listeners):
    """The messages of several topics with that stamp."""

    def find():
        found = [next((m for m in each.messages if m.header.stamp == stamp), None) for each in listeners]
        return found if all(found) else None

    return eventually(find, 5.0, "messages of one moment on every topic")


def one_moment(*listeners):
    """One message of each, all of the same frame."""

    def find():
        common = set.intersection(*({m.header.stamp for m in each.messages} for each in listeners))
        return max(common) if common else None

    return matching(eventually(find, 20.0, "a moment that all topics show"), *listeners)


def test_topics_are_those_of_the_original_and_what_image_tools_expect_beside_them(master, scene):
    expected = {
        "eye/ImageData": "sensor_msgs/Image",
        "eye/ImageData/compressed": "sensor_msgs/CompressedImage",
        "eye/camera_info": "sensor_msgs/CameraInfo",
        "eye/MaskData": "sensor_msgs/Image",
        "eye/MaskData/labels": "ambf_msgs/ObjectLabels",
        "eye/DepthData": "sensor_msgs/PointCloud2",
        "eye/depth/ImageData": "sensor_msgs/Image",
        "eye/depth/camera_info": "sensor_msgs/CameraInfo",
        "pair/left/ImageData": "sensor_msgs/Image",
        "pair/right/ImageData": "sensor_msgs/Image",
        "pair/left/camera_info": "sensor_msgs/CameraInfo",
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
    for name in ("eye", "pair", "pair/left", "pair/right", "flat"):
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
            u = geometry.K[0] * point[0] / ahead + geometry.K[2]
            v = geometry.K[4] * point[1] / ahead + geometry.K[5]
            column, row = middle_of(colored(array, plate_name))
            assert abs(column - u) < 0.5 and abs(row - v) < 0.5, (name, plate_name, column, u, row, v)
        red, green = middle_of(colored(array, "Red")), middle_of(colored(array, "Green"))
        assert red[0] > green[0] and red[1] < green[1], "right is right and up is up"
        if name == "eye":
            assert abs(geometry.K[4] - HEIGHT / 2 / math.tan(FIELD_OF_VIEW / 2)) < 1e-9
        if name == "pair/right":
            assert abs(geometry.P[3] + geometry.K[0] * 0.1) < 1e-9


@pytest.mark.parametrize("backend", ["osmesa", "egl"])
def test_either_way_of_drawing_publishes_colours_and_depth(tmp_path, master, start, ros, backend):
    arguments = ("--launch_file", write(tmp_path), "-l", "0", "--offscreen", backend)
    simulator = start(*arguments, master_uri=master.uri, allowed=["WatchDog expired"])
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


def test_depth_is_exact_to_a_millimetre_and_the_cloud_is_in_the_cameras_frame(scene, ros):
    listeners = [
        ros.listen(f"{CAMERAS}/eye/{topic}", kind)
        for topic, kind in (
            ("depth/ImageData", Image),
            ("DepthData", PointCloud2),
            ("MaskData", Image),
            ("depth/camera_info", CameraInfo),
        )
    ]
    labels = ros.listen(f"{CAMERAS}/eye/MaskData/labels", ObjectLabels)
    depth_message, cloud, mask_message, _ = one_moment(*listeners)
    ids = dict(zip(labels.last().names, labels.last().ids, strict=True))
    depth, mask = pixels(depth_message), pixels(mask_message)
    points, colors = cloud_points(cloud)
    assert cloud.header.frame_id == "eye"
    assert (cloud.width, cloud.height) == (WIDTH, HEIGHT)
    seen = np.zeros_like(mask, dtype=bool)
    for name, (x, y, z) in PLATES.items():
        of_it = mask == ids[f"/ambf/env/{name}"]
        seen |= of_it
        assert np.abs(depth[of_it] - (2.0 - x)).max() < 1e-3
        # x backwards, y right, z up, from the camera.
        middle = points[of_it].mean(axis=0)
        assert np.abs(middle - np.array([x - 2.0, y, z])).max() < 2e-3
        rgb = colors[of_it]
        channel = (rgb >> {"Red": 16, "Green": 8, "Blue": 0}[name]) & 255
        assert np.median(channel) > 100
    assert np.isnan(depth[~seen]).all() and np.isnan(points[~seen]).all()
    assert (mask[~seen] == 0).all()


def test_a_users_shaders_compute_the_points_of_depth_pictures(scene, ros):
    """half_range.fs: everything is half as far away, and nothing is in the left half."""
    eye, sensor = (
        [
            ros.listen(f"{CAMERAS}/{name}/depth/ImageData", Image),
            ros.listen(f"{CAMERAS}/{name}/DepthData", PointCloud2),
        ]
        for name in ("eye", "sensor")
    )
    (measured, _), (computed, cloud) = (one_moment(*listeners) for listeners in (eye, sensor))
    measured, computed = pixels(measured), pixels(computed)
    points, _ = cloud_points(cloud)
    right = np.s_[:, WIDTH // 2 :]
    assert np.isfinite(measured[:, : WIDTH // 2]).any() and np.isnan(computed[:, : WIDTH // 2]).all()
    seen = np.isfinite(computed[right]) & np.isfinite(measured[right])
    assert seen.sum() > 200
    assert np.abs(computed[right] - measured[right] / 2)[seen].max() < 1e-3
    assert np.abs(points[right][..., 0] + computed[right])[seen].max() < 1e-6, "the cloud is that of the picture"
    # The same ray, half as far along it: y to the right.
    columns = np.arange(WIDTH // 2, WIDTH)
    focal = HEIGHT / 2 / math.tan(FIELD_OF_VIEW / 2)
    expected = (columns - (WIDTH - 1) / 2) / focal * computed[right]
    assert np.abs(points[right][..., 1] - expected)[seen].max() < 1e-3


def test_depth_noise_is_as_the_file_says(scene, ros):
    depth = pixels(ros.listen(f"{CAMERAS}/slow/depth/ImageData", Image).last(20.0))
    assert depth.shape == (60, 80)
    green = depth[np.abs(depth - 1.57) < 0.1]  # 1.5 m away, and 0.07 m of mean and bias
    assert len(green) > 30
    assert abs(green.mean() - 1.57) < 4 * 0.01 / math.sqrt(len(green))
    assert 0.006 < green.std() < 0.014


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
