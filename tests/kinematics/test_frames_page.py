"""docs/frames.md: its matrices against its words, the kinematics, the models' files and the code of cameras."""

import math
import re

import numpy as np
import pytest
import yaml
from harness import ROOT

pytest.importorskip("rospy")
from ambf_client import kinematics as kin  # noqa: E402
from ambf_client.rotations import matrix_from_quaternion, quaternion_from_euler  # noqa: E402

PAGE = (ROOT / "docs/frames.md").read_text(encoding="utf-8")
DVRK = ROOT / "ambf_models/dvrk"
# In a camera's frame: x back, y right, z up (render/camera/camera.h).
WORDS = {"back": (1, 0, 0), "right": (0, 1, 0), "up": (0, 0, 1)}
WORDS |= {
    opposite: tuple(-np.array(WORDS[word]))
    for opposite, word in {"away": "back", "left": "right", "down": "up"}.items()
}


@pytest.fixture(scope="module")
def page():
    """The names that the page's lines define."""
    names = {}
    for block in re.findall(r"^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL):
        exec(compile(block, "docs/frames.md", "exec"), names)
    for name, value in names.items():
        if re.match(r"[RT]_", name):
            R = value[:3, :3]
            assert np.abs(R @ R.T - np.eye(3)).max() < 1e-12 and np.linalg.det(R) > 0, f"{name} is no rotation"
    return names


def matrix_from_rpy(*rpy):
    return matrix_from_quaternion(quaternion_from_euler(*rpy))


def in_words(frame):
    """Axes of a row of the page's table, as columns in a camera's frame."""
    axes = re.search(rf"^\| {re.escape(frame)} \|[^|]*\| (?:at zero: )?([^|]*) \|", PAGE, re.MULTILINE)[1]
    return np.array([WORDS[word] for word in axes.split(", ")]).T


def body_pose(file, name):
    """At home, in the world."""
    location = yaml.safe_load((DVRK / file).read_text())[f"BODY {name}"]["location"]
    T = np.eye(4)
    T[:3, :3] = matrix_from_rpy(*(location["orientation"][key] for key in "rpy"))
    T[:3, 3] = [location["position"][key] for key in "xyz"]
    return T


def quaternion_in(file, pattern):
    found = re.search(pattern + r"[({]([-\d., ]+)[)}]", (ROOT / file).read_text())
    return matrix_from_quaternion([float(number) for number in found[1].split(",")])


def close(a, b, tolerance=1e-6):
    return np.abs(np.asarray(a) - b).max() < tolerance


def test_matrices_mean_what_the_table_says(page):
    camera, optical, isi, tip = (in_words(each) for each in ("camera", "optical", "ISI view", "ECM's tip"))
    assert close(camera, np.eye(3))
    for name, wanted in (
        ("R_camera_optical", optical),
        ("R_camera_isi", isi),
        ("R_optical_isi", optical.T @ isi),
        ("R_isi_tip", isi.T @ tip),
        ("R_optical_tip", optical.T @ tip),
        ("R_camera_tip", tip),
        ("R_mtm_base_tip", in_words("master's base").T @ in_words("master's tip")),
        ("R_display_base", isi.T @ in_words("master's base")),
        ("R_base_u", in_words("master's base").T),
        ("R_u_hand", np.eye(3)),
    ):
        assert close(page[name], wanted), name
    quaternions = re.findall(r"^(R_\w+) = .*# quaternion \((.*)\)$", PAGE, re.MULTILINE)
    assert len(quaternions) == 2
    for name, numbers in quaternions:
        assert close(matrix_from_quaternion([float(x) for x in numbers.split(",")]), page[name]), name


def test_pictures_have_the_optical_axes_of_the_page(page):
    for file, pattern in (
        ("ambf_client_py/ambf_tools/cli/frames.py", r"OPTICAL = "),
        ("ambf_client_py/ambf_core/native/view_module.cpp", r"T_world_camera\.orientation \* math::Quat"),
    ):
        assert close(quaternion_in(file, pattern), page["R_camera_optical"]), file


def test_the_endoscope_looks_along_the_tip_as_the_page_says(page):
    camera = yaml.safe_load((DVRK / "world.yaml").read_text())["endoscope"]
    assert camera["parent"] == "/ambf/env/ecm/BODY tool link"
    location, target, up = (np.array([camera[key][each] for each in "xyz"]) for key in ("location", "look at", "up"))
    back = (location - target) / np.linalg.norm(location - target)  # as camera_pose of model/view_builder.cpp
    right = np.cross(up, back) / np.linalg.norm(np.cross(up, back))
    T_scope_camera = np.eye(4)
    T_scope_camera[:3] = np.column_stack([back, right, np.cross(back, right), location])
    T_camera_tip = np.linalg.inv(T_scope_camera) @ page["T_scope_tip"]
    assert close(T_camera_tip[:3, :3], page["R_camera_tip"])
    assert close(T_camera_tip[:3, 3], 0)
    straight = kin.load_arm("ECM").forward(np.zeros(4))
    for tool, angle in (("UP", -30), ("DOWN", 30)):
        tip = np.linalg.inv(straight) @ kin.load_arm("ECM", tool).forward(np.zeros(4))
        R_isi_tip = page["R_isi_tip"]
        assert close(R_isi_tip @ tip[:3, :3] @ R_isi_tip.T, matrix_from_rpy(math.radians(angle), 0, 0)), tool
        looks = R_isi_tip @ tip[:3, 2]  # up is y
        assert looks[1] == pytest.approx(0.5 if tool == "UP" else -0.5) and abs(looks[0]) < 1e-9, tool


@pytest.mark.parametrize(
    ("name", "file", "base", "body", "tip", "at_zero"),
    [
        ("PSM", "psm1.yaml", "base link", "tool gripper1 link", "T_gripper_tip", "R_psm_base_tip"),
        ("ECM", "ecm.yaml", "base link", "tool link", "T_scope_tip", "R_ecm_base_tip"),
        ("MTMR", "mtmr.yaml", "Top Panel", "WristRoll", "T_roll_tip", "R_mtm_base_tip"),
        ("MTML", "mtml.yaml", "Top Panel", "WristRoll", "T_roll_tip", "R_mtm_base_tip"),
    ],
)
def test_tips_are_where_the_page_says(page, name, file, base, body, tip, at_zero):
    arm = kin.load_arm(name)
    zero = arm.forward(np.zeros(len(arm.lower)))
    assert close(zero[:3, :3], page[at_zero])
    T_base_body = np.linalg.inv(body_pose(file, base)) @ body_pose(file, body)  # models' homes are at zero
    assert close(T_base_body @ page[tip], zero, 2e-5)


def test_first_joints_move_the_tip_as_the_page_says():
    for name in ("PSM", "ECM"):
        arm = kin.load_arm(name)
        q = np.array(arm.home, dtype=float)
        q[:2] = 0
        assert arm.forward(q)[2, 3] < -0.1
        assert arm.forward(q + 0.1 * np.eye(len(q))[0])[0, 3] > 0.01
        assert arm.forward(q + 0.1 * np.eye(len(q))[1])[1, 3] < -0.01


def test_a_psm_is_in_view_and_in_the_picture(page):
    q_psm, q_ecm = [0.1, -0.2, 0.15, 0.4, 0.3, -0.2], [0.1, 0.2, 0.1, 0.3]
    T_psm, T_ecm = body_pose("psm1.yaml", "base link"), body_pose("ecm.yaml", "base link")
    seen = page["psm_in_view"](T_psm, q_psm, T_ecm, q_ecm)
    truth = T_psm @ kin.load_arm("PSM").forward(q_psm)
    T_view = T_ecm @ kin.load_arm("ECM").forward(q_ecm)
    assert close(T_view @ page["turned"](page["R_isi_tip"].T, seen), truth)
    away, up, right = T_view[:3, 2], T_view[:3, 0], T_view[:3, 1]
    offset = truth[:3, 3] - T_view[:3, 3]
    K = np.array([[500.0, 0, 320], [0, 510.0, 240], [0, 0, 1]])
    wanted = [320 + 500 * (offset @ right) / (offset @ away), 240 - 510 * (offset @ up) / (offset @ away)]
    assert close(page["pixel"](K, seen), wanted)
    assert close(seen[:3, 3], [-(offset @ right), offset @ up, offset @ away])


def test_masters_stand_as_the_driver_and_the_line_of_the_page_say(page):
    code = (ROOT / "ambf_plugins/dvrk_arm/ros_topics.cpp").read_text()
    found = re.findall(r"request\.T_(base|tip)_offset = .*?from_rpy\((.*?)\)", code)
    quarters = {"0.0": 0.0, "M_PI / 2": math.pi / 2, "-M_PI / 2": -math.pi / 2}
    angles = {which: [quarters[angle] for angle in text.split(", ")] for which, text in found}
    assert close(matrix_from_rpy(*angles["base"]), page["R_base_u"])
    assert close(matrix_from_rpy(*angles["tip"]), page["R_tip_hand"])
    line = yaml.safe_load(re.search(r"^    (base frame: .*)$", PAGE, re.MULTILINE)[1])["base frame"]
    assert close(matrix_from_rpy(*line["rpy"]), page["R_display_base"])
