"""Our own scenes: generated files are up to date, mechanisms closed, numbers possible, launch files agree."""

import itertools
import math
import pathlib
import re
import struct
import sys
import zlib

import numpy as np
import pytest
import yaml

MODELS = pathlib.Path(__file__).resolve().parents[2] / "ambf_models"
sys.path.insert(0, str(MODELS / "scripts"))

import adf_kinematics as kinematics  # noqa: E402
import generate  # noqa: E402
import mesh_io  # noqa: E402

DESCRIPTIONS = MODELS / "descriptions"
SCENES = sorted(DESCRIPTIONS.rglob("multi-bodies/**/*.yaml"))
MESHES = sorted((MODELS / "meshes").rglob("*.obj"))
STEP = 1e-3  # s


def name_of(path):
    return path.stem


def load(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def scene(name):
    return load(next(path for path in SCENES if path.stem == name))


def bodies_of(model):
    return {name: model[name] for name in model["bodies"]}


def joints_of(model):
    return {name: model[name] for name in model.get("joints", [])}


# --- generated files -------------------------------------------------------------------------------------------------

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?(?![\w.])")


def png_pixels(data):
    """(all but the pixels, pixels): compressed bytes differ between versions of zlib, pixels must not."""
    position, rest, compressed = 8, b"", b""
    while position < len(data):
        (length,) = struct.unpack(">I", data[position : position + 4])
        kind, body = data[position + 4 : position + 8], data[position + 8 : position + 8 + length]
        if kind == b"IDAT":
            compressed += body
        else:
            rest += kind + body
        position += 12 + length
    (rows,) = struct.unpack(">I", data[20:24])
    lines = np.frombuffer(zlib.decompress(compressed), dtype=np.uint8).reshape(rows, -1)
    assert set(lines[:, 0]) in ({0}, {2}), "filters that mesh_io does not write"
    pixels = lines[:, 1:]
    return rest, np.cumsum(pixels, axis=0, dtype=np.uint8) if lines[0, 0] == 2 else pixels


def same_content(ours, fresh):
    if ours == fresh:
        return True
    if ours.startswith(b"\x89PNG"):
        (rest, pixels), (fresh_rest, fresh_pixels) = png_pixels(ours), png_pixels(fresh)
        if rest != fresh_rest:
            return False
        # Another machine's sine may round to the next level.
        return bool((np.abs(pixels.astype(int) - fresh_pixels.astype(int)) <= 1).all())
    # Another machine's sine may differ in the last bit.
    a, b = ours.decode(), fresh.decode()
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return False
    numbers = np.array([[float(x), float(y)] for x, y in zip(NUMBER.findall(a), NUMBER.findall(b), strict=True)])
    tolerance = 1.1e-3 if "\nvn " in a else 1e-12  # the last written digit of a normal
    return bool((np.abs(numbers[:, 0] - numbers[:, 1]) <= tolerance).all())


def test_generated_files_are_what_the_scripts_write(tmp_path):
    generate.generate(tmp_path)
    fresh = {path.relative_to(tmp_path) for path in tmp_path.rglob("*") if path.is_file()}
    ours = {path.relative_to(MODELS) for path in (MODELS / "meshes").rglob("*") if path.is_file()}
    ours |= {path.relative_to(MODELS) for path in DESCRIPTIONS.rglob("*.yaml") if "generate.py" in path.read_text()}
    assert ours == fresh
    assert len(fresh) > 60
    stale = [
        str(path)
        for path in sorted(fresh)
        if not same_content((MODELS / path).read_bytes(), (tmp_path / path).read_bytes())
    ]
    assert stale == [], "run ambf_models/scripts/generate.py"


def test_the_comparison_notices_a_changed_number_and_a_changed_word():
    assert same_content(b"a: 1.0000000000000002", b"a: 1.0")
    assert not same_content(b"a: 1.00001", b"a: 1.0")
    assert not same_content(b"b: 1.0", b"a: 1.0")


def test_the_comparison_of_pictures_lets_rounding_pass_and_nothing_else(tmp_path):
    pixels = np.arange(75, dtype=np.uint8).reshape(5, 5, 3)
    files = []
    for change in (0, 1, 2):
        changed = pixels.copy()
        changed[2, 3, 1] += change
        mesh_io.write_png(tmp_path / f"{change}.png", changed)
        files.append((tmp_path / f"{change}.png").read_bytes())
    assert same_content(files[0], files[1])
    assert not same_content(files[0], files[2])
    mesh_io.write_png_indexed(tmp_path / "a.png", pixels[..., 0], np.zeros((75, 3), dtype=np.uint8))
    mesh_io.write_png_indexed(tmp_path / "b.png", pixels[..., 0], np.ones((75, 3), dtype=np.uint8))
    assert not same_content((tmp_path / "a.png").read_bytes(), (tmp_path / "b.png").read_bytes())


# --- kinematics ------------------------------------------------------------------------------------------------------


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


# --- masses, shapes, gains -------------------------------------------------------------------------------------------

FULL_SIZES = {
    "BOX": lambda g: (g["x"], g["y"], g["z"]),
    "CYLINDER": lambda g: (2 * g["radius"], g["height"]),
    "CAPSULE": lambda g: (2 * g["radius"], g["height"]),
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
        else:
            extent = 0.0
            for part in body["compound collision shape"]:
                reach = 0.5 * math.sqrt(sum(s * s for s in FULL_SIZES[part["shape"]](part["geometry"])))
                extent = max(extent, 2 * (reach + np.linalg.norm(kinematics.xyz(part["offset"]["position"]))))
        gyration = math.sqrt(max(ix, iy, iz) / body["mass"])
        assert 0.08 * extent < gyration < 0.5 * extent, name


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_jointed_bodies_differ_little_in_mass(path):
    bodies = bodies_of(load(path))
    for name, joint in joints_of(load(path)).items():
        masses = [bodies[joint[role]]["mass"] for role in ("parent", "child")]
        if 0.0 not in masses:
            assert max(masses) / min(masses) < 40.0, name


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
            assert 0.0 < joint["controller"]["P"] * STEP <= 0.1, name
        elif not joint.get("passive"):
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


# --- files that belong together --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["launch.yaml", "launch_two_views.yaml", "launch_cameras.yaml", "launch_stereo.yaml"])
def test_launch_files_name_existing_files_under_their_index(name):
    text = (DESCRIPTIONS / name).read_text(encoding="utf-8")
    launch = yaml.safe_load(text)
    for key in ("world config", "color config", "input devices config"):
        assert (DESCRIPTIONS / launch[key]).is_file()
    configs = launch["multibody configs"]
    assert all((DESCRIPTIONS / config).is_file() for config in configs)
    assert configs[1].endswith("peg_transfer.yaml"), "entry 1 is what opens by default"
    lists = 2 if "world configs" in launch else 1
    assert [int(n) for n in re.findall(r'^  - ".*" # (\d+)$', text, re.MULTILINE)] == lists * list(range(len(configs)))
    assert configs == load(DESCRIPTIONS / "launch.yaml")["multibody configs"]
    assert {(DESCRIPTIONS / config).resolve() for config in configs} == set(SCENES)


def test_every_scene_has_a_world_of_its_own():
    launch = load(DESCRIPTIONS / "launch.yaml")
    for model, world in zip(launch["multibody configs"], launch["world configs"], strict=True):
        assert pathlib.Path(world).stem == pathlib.Path(model).stem + "_world"
        assert (DESCRIPTIONS / world).is_file()


@pytest.mark.parametrize("path", sorted((DESCRIPTIONS / "world").glob("*world.yaml")), ids=name_of)
def test_worlds_have_their_environment_lights_and_camera(path):
    world = load(path)
    assert world["namespace"] == "/ambf/env/"
    assert (path.parent / world["environment"]).is_file()
    assert path.stem in ("two_views_world", "stereo_world") or world["cameras"][0] == "main_camera"
    for block in world["lights"] + world["cameras"]:
        assert "location" in world[block]
    shown = [name for name in world["cameras"] if world[name].get("visible", True)]
    assert len(shown) == (2 if path.stem == "two_views_world" else 1), "a window for each"


def test_meshes_named_by_bodies_exist_and_none_is_left_over():
    named = set()
    for path in [*SCENES, *(DESCRIPTIONS / "world").glob("lab_*.yaml")]:
        model = load(path)
        for name, body in bodies_of(model).items():
            assert "mesh" in body, name
            assert {"collision shape", "compound collision shape", "collision mesh"} & set(body), name
            named.add((path.parent / model["high resolution path"] / body["mesh"]).resolve())
            if "collision mesh" in body:
                named.add((path.parent / model["low resolution path"] / body["collision mesh"]).resolve())
    assert named == set(MESHES)


def test_input_devices_move_bodies_that_exist():
    path = DESCRIPTIONS / "input_devices" / "input_devices.yaml"
    devices = load(path)
    peg_transfer = scene("peg_transfer")
    for name in devices["input devices"]:
        device = devices[name]
        assert device["hardware name"]
        if "simulated multibody" in device:
            assert (path.parent / device["simulated multibody"]).is_file()
        else:
            assert f"BODY {device['root link']}" in peg_transfer["bodies"]


def test_color_file_holds_the_palette_of_the_meshes():
    colors = load(DESCRIPTIONS / "color" / "colors.yaml")
    for name, (r, g, b, _, _) in mesh_io.PALETTE.items():
        assert [colors[name][k] for k in "rgb"] == pytest.approx([255 * c for c in (r, g, b)], abs=1.0)
    assert all(isinstance(c[k], int) and 0 <= c[k] <= 255 for c in colors.values() for k in "rgba")


def read_obj(path):
    vertices, faces = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:]])
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return np.array(vertices), np.array(faces)


# Rooms are seen from inside, and a table top is planks on a slab.
@pytest.mark.parametrize("path", [p for p in MESHES if "lab" not in p.parts], ids=lambda p: "/".join(p.parts[-3:]))
def test_meshes_are_closed_and_face_outwards(path):
    vertices, faces = read_obj(path)
    edges = np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)])
    assert (edges[:, 0] != edges[:, 1]).all()
    # Every edge is passed as often one way as the other.
    there = np.sort(edges[:, 0] * len(vertices) + edges[:, 1])
    back = np.sort(edges[:, 1] * len(vertices) + edges[:, 0])
    assert (there == back).all()
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() > 0.0


def corners_of(shape, geometry):
    """Corners of a primitive's bounding box in its own frame."""
    if shape == "BOX":
        half = [geometry[k] / 2 for k in "xyz"]
    else:
        half = [geometry["height"] / 2 if k == geometry["axis"] else geometry["radius"] for k in "XYZ"]
    return np.array(
        [[sign * h for sign, h in zip(signs, half, strict=True)] for signs in itertools.product((-1, 1), repeat=3)]
    )


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_what_is_seen_is_about_what_collides(path):
    model = load(path)
    vertices = {}
    for name, body in bodies_of(model).items():
        if "collision mesh" in body:
            collides = read_obj(path.parent / model["low resolution path"] / body["collision mesh"])[0]
        else:
            parts = body.get("compound collision shape") or [
                {
                    "shape": body["collision shape"],
                    "geometry": body["collision geometry"],
                    "offset": body["collision offset"],
                }
            ]
            placed = []
            for part in parts:
                rotation, position = kinematics.pose_of(part["offset"])
                placed.append(corners_of(part["shape"], part["geometry"]) @ np.array(rotation).T + position)
            collides = np.concatenate(placed)
        mesh = path.parent / model["high resolution path"] / body["mesh"]
        if mesh not in vertices:
            vertices[mesh] = read_obj(mesh)[0]
        seen = vertices[mesh]
        slack = max(0.004, 0.12 * np.linalg.norm(np.ptp(collides, axis=0)))
        assert (np.abs(seen.min(axis=0) - collides.min(axis=0)) < slack).all(), name
        assert (np.abs(seen.max(axis=0) - collides.max(axis=0)) < slack).all(), name


def test_meshes_are_small():
    sizes = [path.stat().st_size for path in (MODELS / "meshes").rglob("*") if path.is_file()]
    assert max(sizes) < 1_000_000
    assert sum(sizes) < 12_000_000


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_scenes_have_few_enough_triangles_for_a_machine_without_a_graphics_card(path):
    model = load(path)
    triangles = {}
    total = 0
    for body in bodies_of(model).values():
        mesh = path.parent / model["high resolution path"] / body["mesh"]
        if mesh not in triangles:
            triangles[mesh] = len(read_obj(mesh)[1])
        total += triangles[mesh]
    assert total < 60_000


def test_textures_exist_and_none_is_left_over():
    named = set()
    for palette in (MODELS / "meshes").rglob("*.mtl"):
        for line in palette.read_text().splitlines():
            keyword, _, file = line.partition(" ")
            if keyword in ("map_Kd", "norm"):
                named.add((palette.parent / file).resolve())
    pictures = {path for path in (MODELS / "meshes").rglob("*.png") if not path.name.startswith("sky_")}
    assert named == pictures
