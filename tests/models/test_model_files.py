"""Our own scenes: files that belong together exist and agree; meshes are closed, small, and about what collides."""

import itertools
import json
import pathlib
import re

import adf_kinematics as kinematics
import mesh_io
import numpy as np
import pytest
import yaml
from own_files import DESCRIPTIONS, MESHES, MODELS, SCENES, bodies_of, load, name_of, scene, soft_bodies_of

HEAVY = [path for path in SCENES if path.stem.endswith("_gravity")]  # what launch files leave out


@pytest.mark.parametrize("path", HEAVY, ids=lambda path: path.stem)
def test_robots_with_gravity_are_those_without_it_and_counterweights(path):
    heavy, light = load(path), load(path.with_name(path.name.replace("_gravity", "")))
    assert light.pop("gravity") == {"x": 0, "y": 0, "z": 0} and "gravity" not in heavy
    for kind in ("bodies", "joints"):
        for block in [block for block in heavy[kind] if "counterweight" in block]:
            heavy[kind].remove(block)
            del heavy[block]
    assert rounded(heavy) == rounded(light)


def rounded(blocks):
    """Processors differ in last digits of what scripts compute."""
    return json.loads(json.dumps(blocks), parse_float=lambda digits: round(float(digits), 9))


@pytest.mark.parametrize(
    "name",
    ["launch.yaml", "launch_two_views.yaml", "launch_cameras.yaml", "launch_stereo.yaml", "launch_two_users.yaml"],
)
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
    assert {(DESCRIPTIONS / config).resolve() for config in configs} == set(SCENES) - set(HEAVY)


def test_the_original_s_places_have_our_models_of_the_same_things():
    ours = load(DESCRIPTIONS / "launch_original.yaml")["multibody configs"]
    assert len(ours) == 23
    assert [pathlib.Path(ours[place]).stem for place in (5, 6, 4)] == ["psm", "ecm", "mtmr"]
    assert all((DESCRIPTIONS / file).is_file() for file in ours if file)
    assert [place for place, file in enumerate(ours) if not file] == [13, 17, 20, 21], "of these no file is known"


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
    assert path.stem in ("two_views_world", "two_users_world", "stereo_world") or world["cameras"][0] == "main_camera"
    for block in world["lights"] + world["cameras"]:
        assert "location" in world[block]
    shown = [name for name in world["cameras"] if world[name].get("visible", True)]
    assert len(shown) == (2 if path.stem in ("two_views_world", "two_users_world") else 1), "a window for each"


OTHERS = [path for name in ("studies", "original", "instruments") for path in (MODELS / name).glob("*.yaml")]
OTHERS = [path for path in OTHERS if "bodies" in load(path)]  # not worlds and launch files


def test_meshes_named_by_bodies_exist_and_none_is_left_over():
    named = set()
    tasks = ("ring_wire", "needle_board", "tissue_retract", "needle_drive")
    with_meshes = [DESCRIPTIONS / f"tasks/{name}.yaml" for name in tasks]
    for path in [*SCENES, *OTHERS, *with_meshes, *(DESCRIPTIONS / "world").glob("lab_*.yaml")]:
        model = load(path)
        for name, body in bodies_of(model).items():
            assert "mesh" in body, name
            assert {"collision shape", "compound collision shape", "collision mesh"} & set(body), name
            named.add((path.parent / model["high resolution path"] / body["mesh"]).resolve())
            if "collision mesh" in body:
                named.add((path.parent / model["low resolution path"] / body["collision mesh"]).resolve())
        for soft in soft_bodies_of(model).values():
            if "mesh" in soft:
                named.add((path.parent / model["high resolution path"] / soft["mesh"]).resolve())
            if "collision mesh" in soft:
                named.add((path.parent / model["low resolution path"] / soft["collision mesh"]).resolve())
        for sensor in (model[block] for block in model.get("sensors") or ()):
            for mesh in (sensor.get("mesh"), sensor.get("wrap", {}).get("onto")):
                if mesh:
                    named.add((path.parent / model["high resolution path"] / mesh).resolve())
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


BUDGETS = {
    "psm": 7e5,
    "thread": 1.1e6,
    "ecm": 7e5,
    "mtmr": 7e5,
    "mtml": 7e5,
    "suj": 8e5,
    "kuka_lwr": 2.4e6,
    "kuka_lbr_med": 2.4e6,
    "puzzles": 7e5,
    "study_b": 1e6,
    "practice": 1e6,
    "screwdriver_env": 5e5,
    "knot_env": 4e5,
    "four_hands": 5e5,
    "original": 4e5,
    "toy_car2": 1e6,
    "sophie": 5e5,
    "instruments": 6e5,
    "neuro_robot": 8e5,
    "raven2": 1e6,
    "pr2": 1.3e6,
    "pr2_grippers": 6e5,
    "ring_wire": 5e5,
    "needle": 5e4,
    "tissue_retract": 2e5,
    "needle_drive": 1e5,
    "tissue": 5e5,
    "incision": 3e5,
    "thread_over_pegs": 7e5,
    "suture_pad": 5e5,
    "peritoneum": 9e5,
    "gallbladder": 7e5,
    "swab": 9e5,
}  # bytes


def read_obj(path):
    vertices, faces = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:]])
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return np.array(vertices), np.array(faces)


# Rooms are seen from inside, a table top is planks on a slab, cloths and membranes have two sides, and patches are
# wrapped onto pads.
OPEN = ("lab", "cloth.obj", "cloth_coarse.obj", "peritoneum.obj", "membrane.obj", "omentum.obj", "swab.obj")
OPEN += ("patch_a.obj", "patch_b.obj")


@pytest.mark.parametrize(
    "path", [p for p in MESHES if not set(OPEN) & set(p.parts)], ids=lambda p: "/".join(p.parts[-3:])
)
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
    elif shape == "SPHERE":
        half = 3 * [geometry["radius"]]
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
    sizes = {path: path.stat().st_size for path in (MODELS / "meshes").rglob("*") if path.is_file()}
    assert max(sizes.values()) < 1_000_000
    arms = {arm: sum(size for path, size in sizes.items() if arm in path.parts) for arm in BUDGETS}
    assert all(size < BUDGETS[arm] for arm, size in arms.items()), arms
    assert sum(sizes.values()) - sum(arms.values()) < 12_000_000


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_scenes_have_few_enough_triangles_for_a_machine_without_a_graphics_card(path):
    model = load(path)
    triangles = {}
    total = 0
    drawn = [*bodies_of(model).values(), *soft_bodies_of(model).values()]
    for body in (body for body in drawn if "mesh" in body):
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
