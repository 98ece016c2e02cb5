"""Our own scenes: mechanisms closed, grippers close, masses, inertias and gains possible."""

import itertools
import math
import re

import adf_kinematics as kinematics
import numpy as np
import pytest
from own_files import SCENES, bodies_of, joints_of, load, name_of, scene

STEP = 1e-3  # s


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_every_joint_is_closed_at_home(path):
    reports = kinematics.check_file(path)
    assert len(reports) == len(load(path).get("joints", []))
    assert [(report.name, fault) for report in reports for fault in report.faults] == []


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_home_values_put_every_child_where_the_file_puts_it(path):
    model = load(path)
    bodies = bodies_of(model)
    for report, joint in zip(kinematics.check_model(model), joints_of(model).values(), strict=True):
        if joint["type"] == "p2p":
            continue
        R_parent, p_parent = kinematics.pose_of(bodies[joint["parent"]]["location"])
        R_child, p_child = kinematics.pose_of(bodies[joint["child"]]["location"])
        rotation, position = kinematics.place_child(joint, report.home)
        assert np.allclose(kinematics.product(R_parent, rotation), R_child, rtol=0, atol=1e-9), report.name
        placed = kinematics.plus(p_parent, kinematics.rotate(R_parent, position))
        assert np.allclose(placed, p_child, rtol=0, atol=1e-9), report.name


@pytest.mark.parametrize(
    ("key", "change", "complaint"),
    [
        ("child pivot", {"x": 1e-6}, "pivots"),
        ("parent axis", {"x": 1e-6}, "axes"),
        ("joint limits", {"low": 1.2, "high": 1.3}, "limits"),
        ("child", "BODY nobody", "no such body"),
        ("joint offset", 0.1, "not handled"),
    ],
)
def test_the_checker_finds_a_broken_joint(key, change, complaint):
    model = scene("arm7")
    joint = model["JOINT joint4"]
    if isinstance(change, dict):
        joint[key] = {k: joint[key][k] + change.get(k, 0.0) for k in joint[key]}
    else:
        joint[key] = change
    faults = {report.name: report.faults for report in kinematics.check_model(model)}
    assert any(complaint in fault for fault in faults.pop("JOINT joint4"))
    assert not any(faults.values())


def test_shortest_rotation_maps_any_axis_onto_any_other():
    axes = [s * np.eye(3)[k] for k in range(3) for s in (-1.0, 1.0)] + [kinematics.unit([1.0, 2.0, -3.0])]
    for a, b in itertools.product(axes, axes):
        rotation = np.array(kinematics.shortest_rotation(list(a), list(b)))
        assert np.allclose(rotation @ a, b, rtol=0, atol=1e-12)
        assert np.allclose(rotation @ rotation.T, np.eye(3), rtol=0, atol=1e-12)
        assert np.linalg.det(rotation) > 0.999


@pytest.mark.parametrize(("name", "loops"), [("four_bar", 1), ("stewart_platform", 5)])
def test_mechanisms_have_their_closed_loops(name, loops):
    model = scene(name)
    assert len(joints_of(model)) - (len(bodies_of(model)) - 1) == loops


def tip_of(model, joint_name, value, point):
    """World position of a point of the child when one joint hangs on its parent's home pose."""
    joint = model[joint_name]
    R, p = kinematics.pose_of(model[joint["parent"]]["location"])
    rotation, position = kinematics.place_child(joint, value)
    return np.array(
        kinematics.plus(p, kinematics.rotate(R, kinematics.plus(position, kinematics.rotate(rotation, point))))
    )


@pytest.mark.parametrize(
    ("name", "fingers", "point"),
    [
        ("peg_transfer", ["JOINT left_gripper-jaw_a", "JOINT left_gripper-jaw_b"], [0.0, 0.0, -0.02]),
        ("peg_transfer", ["JOINT right_gripper-jaw_a", "JOINT right_gripper-jaw_b"], [0.0, 0.0, -0.02]),
        ("two_finger", ["JOINT palm-finger_a", "JOINT palm-finger_b"], [0.0, 0.0, -0.07]),
    ],
)
def test_grippers_close_at_the_low_limit_and_open_at_the_high_one(name, fingers, point):
    model = scene(name)
    gap = {}
    for end in ("low", "high"):
        a, b = (tip_of(model, finger, model[finger]["joint limits"][end], point) for finger in fingers)
        gap[end] = a[1] - b[1]
    assert abs(gap["low"]) < 1e-9
    assert gap["high"] > 0.015


FULL_SIZES = {
    "BOX": lambda g: (g["x"], g["y"], g["z"]),
    "CYLINDER": lambda g: (2 * g["radius"], g["height"]),
    "CAPSULE": lambda g: (2 * g["radius"], g["height"]),
    "SPHERE": lambda g: (2 * g["radius"],),
}


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_inertias_are_those_of_a_body_of_that_size(path):
    model = load(path)
    for name, body in bodies_of(model).items():
        if body["mass"] == 0.0:
            continue
        ix, iy, iz = (body["inertia"][k] for k in ("ix", "iy", "iz"))
        assert min(ix, iy, iz) > 0.0, name
        assert ix + iy > iz and iy + iz > ix and iz + ix > iy, name
        if "collision shape" in body:
            sizes = FULL_SIZES[body["collision shape"]](body["collision geometry"])
            extent = math.sqrt(sum(s * s for s in sizes))
        elif "collision mesh" in body:
            text = (path.parent / model["low resolution path"] / body["collision mesh"]).read_text(encoding="utf-8")
            points = np.array([line.split()[1:4] for line in text.splitlines() if line.startswith("v ")], dtype=float)
            extent = np.linalg.norm(np.ptp(points, axis=0))
        else:
            extent = 0.0
            for part in body["compound collision shape"]:
                reach = 0.5 * math.sqrt(sum(s * s for s in FULL_SIZES[part["shape"]](part["geometry"])))
                extent = max(extent, 2 * (reach + np.linalg.norm(kinematics.xyz(part["offset"]["position"]))))
        gyration = math.sqrt(max(ix, iy, iz) / body["mass"])
        assert 0.08 * extent < gyration < 0.5 * extent, name


# Robots with the masses of the original's files.
GIVEN_MASSES = ("neuro_robot", "neuro_robot_gravity", "pr2")


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_jointed_bodies_differ_little_in_mass(path):
    most = 70.0 if path.stem in GIVEN_MASSES else 40.0
    bodies = bodies_of(load(path))
    for name, joint in joints_of(load(path)).items():
        masses = [bodies[joint[role]]["mass"] for role in ("parent", "child")]
        if 0.0 not in masses:
            assert max(masses) / min(masses) < most, name


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_controllers_are_stable_at_one_kilohertz(path):
    model = load(path)
    for name, joint in joints_of(model).items():
        if "controller" in joint and joint["controller output type"] == "FORCE":  # fingers: springs to their target
            assert joint["joint limits"], name
            gains, child = joint["controller"], bodies_of(model)[joint["child"]]
            arm = kinematics.xyz(child["inertial offset"]["position"])
            turning = child["inertia"]["ix"] + child["mass"] * sum(v * v for v in arm)
            moved = child["mass"] if joint["type"] == "prismatic" else turning
            assert 0.0 < gains["D"] * STEP < moved, name
            assert 0.3 < gains["D"] / (2.0 * math.sqrt(gains["P"] * moved)) < 1.2, name
        elif "controller" in joint:
            assert joint["controller output type"] == "VELOCITY", name
            gains = joint["controller"]  # the gain of the error: model/joint_controller.h
            assert 0.0 < gains["P"] / (1.0 + gains["D"]) * STEP <= 0.1, name
        elif joint["type"] == "torsion spring":
            child = bodies_of(model)[joint["child"]]
            assert joint["stiffness"] * STEP**2 / min(child["inertia"].values()) < 1.0, name
        elif not joint.get("passive") and joint["type"] != "fixed":
            raise AssertionError(f"{name} has neither a controller nor is it passive")
    for name, body in bodies_of(model).items():
        if "controller" in body:
            linear, angular = body["controller"]["linear"], body["controller"]["angular"]
            lightest = min(body["inertia"].values())
            assert linear["D"] * STEP / body["mass"] < 0.5 and linear["P"] * STEP**2 / body["mass"] < 0.1, name
            assert angular["D"] * STEP / lightest < 0.5 and angular["P"] * STEP**2 / lightest < 0.1, name


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_names_are_unique_and_blocks_are_listed(path):
    model = load(path)
    for key, prefix in (("bodies", "BODY "), ("joints", "JOINT ")):
        listed = model.get(key, [])
        assert len(set(listed)) == len(listed)
        assert set(listed) == {block for block in model if block.startswith(prefix)}
        names = [model[block]["name"] for block in listed]
        assert len(set(names)) == len(names)


def test_objects_start_loose_on_their_pegs():
    model = scene("peg_transfer")
    pegs = [part for part in model["BODY pegs"]["compound collision shape"]]
    at = kinematics.xyz(model["BODY pegs"]["location"]["position"])
    top = model["BODY peg_board"]["location"]["position"]["z"]
    assert len(pegs) == 12
    objects = [model[name] for name in model["bodies"] if re.match(r"BODY (ring|triangle)\d", name)]
    assert len(objects) == 6
    taken = set()
    for item in objects:
        centre = kinematics.xyz(item["location"]["position"])
        places = [kinematics.plus(at, kinematics.xyz(peg["offset"]["position"])) for peg in pegs]
        peg = min(range(12), key=lambda k: math.dist(places[k][:2], centre[:2]))
        assert math.dist(places[peg][:2], centre[:2]) < 1e-9
        taken.add(peg)
        clearance, lowest = math.inf, math.inf
        for part in item["compound collision shape"]:
            offset, geometry = part["offset"]["position"], part["geometry"]
            distance = math.hypot(offset["x"], offset["y"])
            half = geometry["x"] / 2 if part["shape"] == "BOX" else geometry["radius"]
            height = {"BOX": geometry.get("z"), "CYLINDER": geometry.get("height"), "CAPSULE": 2 * half}[part["shape"]]
            clearance = min(clearance, distance - half)
            lowest = min(lowest, centre[2] + offset["z"] - height / 2)
        assert pegs[peg]["geometry"]["radius"] + 0.001 < clearance < 0.006
        assert abs(lowest - top) < 1e-9
        assert 0.001 < item["mass"] < 0.006
    assert len(taken) == 6
