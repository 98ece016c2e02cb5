"""The da Vinci Research Kit as a whole: three PSMs and the ECM on the set-up arms of the patient cart, at the published
simulated positions, a peg board below them, both masters at a console, and the view through the endoscope. PSM3 is
turned aside: at its published position it overlaps PSM2.

The arms are those of scene_psm, scene_ecm and scene_mtm, put elsewhere: their bodies are moved, their joints, which are
given in the bodies' frames, stay as they are. Each base is a body with mass that a fixed joint holds on its set-up arm.
"""

import copy
import math

import adf_kinematics as kinematics
import dvrk_parts as dvrk
import mesh_tools as mt
import numpy as np
import scene_ecm
import scene_mtm
import scene_peg_transfer
import scene_psm
import scene_suj
import scene_worlds
from adf_writer import Model, block, box_inertia, placed, pose, shape_box, shape_round
from mesh_folder import MeshFolder

NAMESPACE = "/ambf/env/"
ASIDE = -0.25  # rad: PSM3's first axis, from its published position
POSITIONS = {arm: list(positions) for arm, positions in scene_suj.SIMULATED.items()}
POSITIONS["psm3"][1] += ASIDE
CART_GROUP = 6  # the cart's shapes are simpler than those of the arms, which they would meet at their mounts
TABLE_TOP = 0.80  # m: where the tools work when they are some 10 cm in
CONSOLE = (0.25, 1.45, 1.65)  # m: what the masters are moved by; the floor of their own scenes is at -1.65
BASE_MASS = 2.6363  # kg, of a manipulator's base
ENDOSCOPE_TIP = scene_ecm.SCOPE_FRAME - scene_ecm.TIP  # m below the tool link's frame
EYES = 0.005  # m apart
FILES = ("suj", "psm1", "psm2", "psm3", "ecm", "mounts", "mtmr", "mtml", "table", "board")


class SeenFolder(MeshFolder):
    """Meshes that another scene writes."""

    def add(self, file_name, mesh, resolution="high_res"):
        return file_name

    def seen_from(self, levels):
        return super().seen_from(1)


def below_endoscope():
    """World pose of the middle of the table: where the endoscope at home looks, turned for its picture."""
    base = scene_suj.mount_of("ecm", POSITIONS["ecm"])
    ahead, right = -base[:3, 2], -base[:3, 0]
    point = base[:3, 3] + (TABLE_TOP - base[2, 3]) / ahead[2] * ahead
    # Who reads the board's prints has +y to the right.
    return scene_suj.frame(mt.rotation_about("z", math.atan2(right[1], right[0]) - math.pi / 2), point)


def moved(model, T, namespace):
    """The model with its bodies moved by a world transform (4x4)."""
    made = copy.deepcopy(model)
    made.namespace = namespace
    for name, entries in made.bodies.items():
        if name.startswith("target_"):
            continue
        R, p = kinematics.pose_of(entries["location"])
        at = T @ scene_suj.frame(np.array(R), p)
        entries["location"] = pose(at[:3, 3], dvrk.rpy_of(at[:3, :3]))
    return made


def base_frame(model, name):
    R, p = kinematics.pose_of(model.bodies[name]["location"])
    return scene_suj.frame(np.array(R), p)


def arm_on(model, arm):
    """The arm with its base where the set-up arm holds it."""
    mount = scene_suj.mount_of(arm, POSITIONS[arm])
    made = moved(model, mount @ np.linalg.inv(base_frame(model, "base link")), f"{NAMESPACE}{arm}/")
    for name in ("target_ik", "target_fk"):
        made.bodies[name].pop("namespace", None)
    inertia = box_inertia(BASE_MASS, 0.15, 0.20, 0.15)
    made.bodies["base link"] |= {
        "mass": BASE_MASS,
        "inertia": dict(zip(("ix", "iy", "iz"), inertia, strict=True)),
        "damping": {"linear": 0.04, "angular": 0.1},
    }
    return made


def mounts(arms):
    """Joints only: what holds the arms on the cart."""
    model = Model(
        "What holds the manipulators on the set-up arms: fixed joints between bodies of other files.", NAMESPACE
    )
    for arm, made in arms.items():
        holder, base = f"suj {arm} L5", f"{NAMESPACE}{arm}/BODY base link"
        T_holder = scene_suj.frames_of(arm, POSITIONS[arm])[5]
        at = {"location": pose(T_holder[:3, 3], dvrk.rpy_of(T_holder[:3, :3]))}
        pair = Model("")
        pair.bodies = {holder: at, base: made.bodies["base link"]}
        point = tuple(made.bodies["base link"]["location"]["position"].values())
        pair.joint(f"{arm} mount", "fixed", holder, base, point, (0, 0, 1), passive=True)
        model.joints |= pair.joints
        model.joints[f"{arm} mount"]["child"] = base
    return model


def board(models):
    """The peg board without its grippers."""
    title = "Peg board: move the objects to the right pegs and back. Board and pegs have their frames in its top."
    made = scene_peg_transfer.make(SeenFolder(models, "peg_transfer"), title)
    return moved(made, below_endoscope(), NAMESPACE)


def cart(models):
    model = scene_suj.make(SeenFolder(models, "suj"), POSITIONS)
    for entries in model.bodies.values():
        entries["collision groups"] = [CART_GROUP]
    return model


def table(models):
    folder = MeshFolder(models / "dvrk", "table")
    model = Model("The table under the peg board.", NAMESPACE, "./meshes/table")
    top = mt.box(0.62, 0.46, 0.03, 0.008, 0.03, "ivory", 2).moved(z=-0.015)
    leg = mt.cylinder(0.035, TABLE_TOP - 0.05, 0.002, 28, "graphite").moved(z=-(TABLE_TOP + 0.01) / 2)
    foot = mt.box(0.50, 0.40, 0.025, 0.006, 0.05, "graphite", 2).moved(z=-TABLE_TOP + 0.0125)
    shapes = [
        placed(shape_box(0.62, 0.46, 0.03), (0, 0, -0.015)),
        placed(shape_round("CYLINDER", 0.035, TABLE_TOP - 0.05), (0, 0, -(TABLE_TOP + 0.01) / 2)),
        placed(shape_box(0.50, 0.40, 0.025), (0, 0, -TABLE_TOP + 0.0125)),
    ]
    mesh = folder.add("table.obj", mt.joined([top, leg, foot]))
    T = below_endoscope()
    where = (T[:3, 3], dvrk.rpy_of(T[:3, :3]))
    model.body("table", *where, mesh=mesh, compound=shapes, passive=True, **{"collision groups": [0]})
    folder.close()
    return model


def master(arm, models):
    T = scene_suj.frame(np.eye(3), CONSOLE)
    folder = SeenFolder(models, arm.name)
    model = arm.make(folder)
    stand = arm.stand()
    model.body("stand", mesh=folder.add("stand.obj", stand.mesh()), passive=True, **stand.entries(0.0, None, None))
    return moved(model, T, model.namespace)


def world():
    room = scene_worlds.World("world", "", "lab_room", (1.0, 0.3, 0.9), 1.6, {})
    lights = list(scene_worlds.LIGHTS)
    cameras = {
        "main_camera": scene_worlds.View((3.35, 1.75, 2.05), (0.62, 0.36, 0.93), 0.62),
        "endoscope": scene_worlds.View(
            (0.0, 0.0, -ENDOSCOPE_TIP),
            (0.0, 0.0, -1.0),
            math.radians(52.0),
            {
                "parent": f"{NAMESPACE}ecm/BODY tool link",
                # Towards the cart, so that pitch moves the picture up and down and PSM1 is on the right.
                "up": {"x": 1.0, "y": 0.0, "z": 0.0},
                "clipping plane": {"near": 0.002, "far": 10.0},
                "stereo": {"mode": "PASSIVE_LEFT_RIGHT", "eye separation": EYES, "focal length": 0.1},
                "visible": False,
                "publish image": True,
                "publish image resolution": {"width": 640, "height": 480},
            },
        ),
    }
    lines = [
        "# The room with the patient cart in view; `endoscope` sits in the ECM's tip.",
        "# Generated by ambf_models/scripts/generate.py: change the script, not this file.",
        "adf version: 1.0",
        f"namespace: {NAMESPACE}",
        "environment: ../descriptions/world/lab_room.yaml",
        "gravity: {x: 0.0, y: 0.0, z: -9.81}",
        f"lights: [{', '.join(lights)}]",
        f"cameras: [{', '.join(cameras)}]",
    ]
    for name in lights:
        lines += ["", block(name, scene_worlds.light(room, name))]
    for name, view in cameras.items():
        lines += ["", block(name, scene_worlds.camera(name, view))]
    return "\n".join(lines) + "\n"


def launch():
    lines = [
        "# The da Vinci Research Kit: -l 0,1,2,3,4,5 loads the patient side, 6,7 the masters, 8,9 a peg board.",
        "# Generated by ambf_models/scripts/generate.py: change the script, not this file.",
        "world config: ../dvrk/world.yaml",
        "color config: ./color/colors.yaml",
        "input devices config: ./input_devices/input_devices.yaml",
        "multibody configs:",
    ]
    lines += [f'  - "../dvrk/{name}.yaml" # {i}' for i, name in enumerate(FILES)]
    return "\n".join(lines) + "\n"


def build(models):
    folder = models / "dvrk"
    folder.mkdir(parents=True, exist_ok=True)
    psm, ecm = scene_psm.make(SeenFolder(models, "psm")), scene_ecm.make(SeenFolder(models, "ecm"))
    arms = {arm: arm_on(ecm if arm == "ecm" else psm, arm) for arm in scene_suj.ARMS}
    parts = {
        "suj": cart(models),
        **arms,
        "mounts": mounts(arms),
        "mtmr": master(scene_mtm.RIGHT, models),
        "mtml": master(scene_mtm.LEFT, models),
        "table": table(models),
        "board": board(models),
    }
    for name in FILES:
        parts[name].write(folder / f"{name}.yaml")
    (folder / "world.yaml").write_text(world(), encoding="utf-8")
    (models / "descriptions" / "launch_dvrk.yaml").write_text(launch(), encoding="utf-8")
