"""The original's four-legged sophie. Names, order, masses, places, joints and the legs' shapes are those of the
original's file, whose meshes are lost; the meshes, the trunk's shape and inertias are ours. Each leg is a loop: two
limbs, and between them a shock absorber of two halves that slide in each other against a spring."""

import math

import mesh_tools as mt
import outlines
from adf_kinematics import plus, rotate, rpy
from adf_writer import Model, addon_gains, box_inertia, cylinder_inertia, shape_box, shape_round
from mesh_folder import MeshFolder
from scene_puzzles import STILL

LEGS = {"BL": (-0.399, 0.338), "BR": (-0.399, -0.332), "FL": (0.414, 0.338), "FR": (0.414, -0.332)}  # x, y of a hip
HIP_Z = 0.007
TRUNK = (1.05, 0.56, 0.14)
LIMB, SHOCK_UPPER, SHOCK_LOWER = 0.0275, 0.012, 0.007  # radii
# Parts of a leg: pitch; x and z from the hip; where along their y the middle is; radius, length; mass; group; damping.
PARTS = {
    "UpperLimb": (0.66, (0.0, 0.0), -0.169, (LIMB, 0.337), 0.5, 0, (0.5, 0.494)),
    "LowerLimb": (-0.70, (-0.236, -0.304), -0.134, (LIMB, 0.266), 0.3, 3, (0.5, 0.494)),
    "LowerShock": (0.032, (-0.109, -0.409), 0.062, (SHOCK_LOWER, 0.123), 0.1, 2, (0.602, 0.647)),
    "UpperShock": (0.032, (-0.102, -0.198), -0.054, (SHOCK_UPPER, 0.109), 0.2, 1, (0.639, 0.669)),
}
SLIDE = 0.109  # from the upper half's frame to its lower end, where the halves' joint is


def trunk_mesh():
    slab = mt.extrude(outlines.rectangle(TRUNK[0], TRUNK[1], 0.12, 8), TRUNK[2], 0.03, 4, "teal")
    parts = [slab, mt.extrude(outlines.rectangle(0.7, 0.36, 0.1, 8), 0.03, 0.01, 2, "ivory").moved(z=TRUNK[2] / 2)]
    parts.append(mt.box(0.10, 0.22, 0.12, 0.02, color="graphite").moved(TRUNK[0] / 2 + 0.03))
    eye = mt.cylinder(0.03, 0.02, 0.006, 24, "lamp").along("x")
    parts += [eye.moved(TRUNK[0] / 2 + 0.085, y) for y in (-0.06, 0.06)]
    for x in (-0.399, 0.414):
        parts.append(mt.cylinder(0.04, 0.75, 0.008, 28, "steel").along("y").moved(x, 0.003, HIP_Z))
    return mt.joined(parts)


def upper_limb_mesh():
    """From the hip to the knee, a collar where the shock absorber hangs."""
    rod = mt.cylinder(LIMB, 0.385, 0.006, 28, "coral").along("y").moved(y=-0.1925)
    joints = [mt.cylinder(0.045, 0.07, 0.008, 28, "graphite").moved(y=y) for y in (0.0, -0.385)]
    lug = mt.box(0.06, 0.03, 0.03, 0.006, color="graphite").moved(x=0.02, y=-0.219)
    return mt.joined([rod, *joints, lug])


def lower_limb_mesh():
    """From the knee to the foot."""
    rod = mt.cylinder(LIMB, 0.266, 0.006, 28, "amber").along("y").moved(y=-0.134)
    foot = mt.torus(0.018, 0.014, 24, 10, "rubber").turned(mt.rotation_about("x", math.pi / 2)).moved(y=-0.262)
    lug = mt.box(0.05, 0.03, 0.03, 0.006, color="graphite").moved(x=0.015, y=-0.162)
    return mt.joined([rod, foot, lug])


def shock_mesh(radius, length, middle, color):
    ring = mt.cylinder(1.7 * radius, 0.024, 0.003, 20, "graphite")
    return mt.joined([mt.cylinder(radius, length, 0.002, 20, color).along("y").moved(y=middle), ring])


def turned(part):
    """Roll, pitch, yaw: y of a part looks up along it, its z to the right of the robot."""
    return (math.pi / 2, PARTS[part][0], 0.0)


def place(leg, part):
    (x, y), (dx, dz) = LEGS[leg], PARTS[part][1]
    return (x + dx, y, HIP_Z + dz)


def add_bodies(model):
    model.body(
        "Body",
        mass=1.0,
        inertia=box_inertia(1.0, *TRUNK),
        mesh="trunk.obj",
        shape=(shape_box(*TRUNK), (0, 0, 0), (0, 0, 0)),
        **STILL,
        **{"collision groups": [0]},
    )
    for leg in LEGS:
        for part, (_, _, middle, size, mass, group, damping) in PARTS.items():
            names = {"publish joint names": True, "publish joint positions": True} if part == "UpperLimb" else {}
            model.body(
                f"{part}{leg}",
                place(leg, part),
                turned(part),
                mass=mass,
                inertia=cylinder_inertia(mass, *size, "y"),
                com=(0.0, middle, 0.0),
                mesh=f"{part}.obj",
                shape=(shape_round("CYLINDER", *size, "y"), (0.0, middle, 0.0), (0, 0, 0)),
                **{**STILL, "damping": damping},
                **{"collision groups": [group]},
                **names,
            )


def add_joints(model):
    aside = (0.0, -1.0, 0.0)
    for leg in LEGS:
        upper, lower, shock, rod = (f"{part}{leg}" for part in ("UpperLimb", "LowerLimb", "UpperShock", "LowerShock"))
        at, span = place(leg, "UpperLimb"), (-0.611, 0.524)
        model.joint(f"Body-{upper}", "revolute", "Body", upper, at, aside, limits=span, **addon_gains(1500.0))
        for parent, child, part, p in (
            (upper, lower, "LowerLimb", 800.0),
            (lower, rod, "LowerShock", 400.0),
            (upper, shock, "UpperShock", 700.0),
        ):
            model.joint(f"{parent}-{child}", "continuous", parent, child, place(leg, part), aside, **addon_gains(p))
        along = rotate(rpy(*turned("UpperShock")), (0.0, 1.0, 0.0))
        at = plus(place(leg, "UpperShock"), along, -SLIDE)
        spring = {"redundant": True, "damping": 1.0, "stiffness": 1000.0}
        name = f"{shock}-{rod}"
        model.joint(name, "linear spring", shock, rod, at, along, limits=(-0.05, 0.1), **addon_gains(300.0), **spring)


def sophie(folder):
    model = Model(
        "A robot on four legs, each with a knee and a sprung shock absorber. Names, places, masses and joints as in\n"
        "the original's sophie; frames: middle of the trunk, hips, knees, and upper and lower ends of the absorbers.",
        "/ambf/env/sophie/",
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    add_bodies(model)
    add_joints(model)
    return model


def build(models):
    out = models / "original"
    out.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "sophie")
    folder.add("trunk.obj", trunk_mesh())
    folder.add("UpperLimb.obj", upper_limb_mesh())
    folder.add("LowerLimb.obj", lower_limb_mesh())
    for part, color in (("UpperShock", "aluminium"), ("LowerShock", "steel")):
        _, _, middle, size, *_ = PARTS[part]
        folder.add(f"{part}.obj", shock_mesh(*size, middle, color))
    folder.close()
    sophie(folder).write(out / "sophie.yaml")
