"""Depth pictures, masks and point clouds as programs get them: exact, in the right frame, noisy where asked."""

import math
import time

import numpy as np
import pytest
from pictures import CAMERAS, FIELD_OF_VIEW, HEIGHT, PLATES, WIDTH, cloud_points, one_moment, pixels
from sensor_msgs.msg import CameraInfo, Image, PointCloud2

from ambf_msgs.msg import ObjectLabels, SensorState


@pytest.mark.parametrize("camera", ["eye", "scope"])
def test_depth_is_exact_to_a_millimetre_and_the_cloud_is_in_the_cameras_frame(scene, ros, camera):
    listeners = [
        ros.listen(f"{CAMERAS}/{camera}/{topic}", kind)
        for topic, kind in (
            ("depth/ImageData", Image),
            ("DepthData", PointCloud2),
            ("MaskData", Image),
            ("depth/camera_info", CameraInfo),
        )
    ]
    labels = ros.listen(f"{CAMERAS}/{camera}/MaskData/labels", ObjectLabels)
    depth_message, cloud, mask_message, _ = one_moment(*listeners)
    ids = dict(zip(labels.last().names, labels.last().ids, strict=True))
    depth, mask = pixels(depth_message), pixels(mask_message)
    points, colors = cloud_points(cloud)
    assert cloud.header.frame_id == camera
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


def test_the_first_cloud_that_somebody_gets_has_its_colours(scene, ros):
    """Though the picture of that moment may have been drawn when only its depth was asked for."""
    depth = ros.listen(f"{CAMERAS}/eye/depth/ImageData", Image)
    for i in range(60):
        depth.next()
        time.sleep(0.001 * i)  # at all moments between two pictures
        cloud = ros.listen(f"{CAMERAS}/eye/DepthData", PointCloud2)
        cloud.last()
        points, colors = cloud_points(cloud.messages[0])
        seen = np.isfinite(points[..., 0])
        assert seen.any() and (colors[seen] & 0xFFFFFF).any()
        cloud.unregister()


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


def test_a_range_sensor_at_the_cameras_place_measures_the_same(scene, ros, tmp_path):
    from ambf_client import Client

    focal = HEIGHT / 2 / math.tan(FIELD_OF_VIEW / 2)
    depth = pixels(ros.listen(f"{CAMERAS}/eye/depth/ImageData", Image).last(20.0))
    # Away from edges, which a ray and a pixel may see differently.
    places = []
    for row in range(4, HEIGHT - 4, 5):
        for column in range(4, WIDTH - 4, 5):
            seen = np.isfinite(depth[row - 2 : row + 3, column - 2 : column + 3])
            if seen.all() or not seen.any():
                places.append((row, column))
    rays = ""
    for row, column in places:
        y, z = (column - (WIDTH - 1) / 2) / focal, -(row - (HEIGHT - 1) / 2) / focal
        rays += f"  - {{offset: {{x: 0, y: 0, z: 0}}, direction: {{x: -1, y: {y}, z: {z}}}}}\n"
    model = tmp_path / "range.yaml"
    model.write_text(
        "adf version: 1.0\nnamespace: /ambf/env/\nsensors: [SENSOR far]\nSENSOR far:\n  name: far\n  type: Range\n"
        "  range: 10.0\n  rays per step: 50\n"
        "  location: {position: {x: 2.0, y: 0, z: 0}, orientation: {r: 0, p: 0, y: 0}}\n"
        f"  array:\n{rays}"
    )
    with Client() as client:
        client.load(str(model))
    state = ros.listen("/ambf/env/far/State", SensorState).last(20.0)
    assert state.count == len(places)
    compared = 0
    for i, (row, column) in enumerate(places):
        assert state.triggered[i] == np.isfinite(depth[row, column])
        if not state.triggered[i]:
            continue
        y, z = (column - (WIDTH - 1) / 2) / focal, -(row - (HEIGHT - 1) / 2) / focal
        along = state.measurement[i] / math.sqrt(1.0 + y * y + z * z)
        # Plates collide 4.9 mm in front of where they are drawn.
        assert along + 0.0049 == pytest.approx(depth[row, column], abs=1e-3)
        compared += 1
    assert compared > 30
