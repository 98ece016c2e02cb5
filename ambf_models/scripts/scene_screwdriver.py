"""The two-handed screwdriver of the dissertation (Fig. 6.11, Table 6.2): one hand turns it, the other one steadies it.
In which of them the handle turns is a question of how firmly each holds: joints only open and close the fingers.

Proportions are those of the original's scene, at a fifth of its size: a screwdriver of 0.25 m and 0.6 kg. The screw is
a disc with four blocks between which the crossed tips lie; it turns against 0.05 N m.
"""

import math

import mesh_tools as mt
import touch_parts as parts
from adf_writer import Model, combined_inertia, cylinder_inertia, placed, shape_box, shape_round
from mesh_folder import MeshFolder

HANDLE = (0.015, 0.111)  # radius, height of a capsule
SHAFT = (0.0042, 0.107)
TIP = (0.0044, 0.040)  # of two crossed capsules
MASSES = (0.2, 0.1, 0.15, 0.15)  # kg: handle, shaft, each of the tips
SCREW = (0.0753, 0.0142, 0.5)  # radius, height, kg
BLOCK = (0.0143, 0.0143, 0.0177)
BLOCK_AT = 0.0142  # x and y
BASE = (0.42, 0.30, 0.012)
BASE_X = -0.10
SCREW_TOP = BASE[2] + 0.001 + SCREW[1]
TIP_HEIGHT = SCREW_TOP + TIP[0]
HANDLE_LOW = 0.100  # of the handle's end above the tips
MAIN_PAD, HELPER_PAD = 0.205, 0.150  # heights at which the hands hold
PAD = 0.71 * 0.075  # of the pads from a palm
COLUMN_X, COLUMN, TOP = -0.26, 0.036, 0.42
ARM = (0.30, 0.04, 0.032)
RANGE = 0.010
FIRM, LOOSE = 0.0160, 0.0238  # opening of each finger, m
TURN = 2.2  # rad to each side
SCREW_FRICTION = 5e-5  # N m s: 0.05 N m
# Friction counts only up to what is stable for the masses that it acts on (docs/sensors.md): heavy fingers hold firmly.
FINGER_MASS = 0.4  # kg


def screwdriver_mesh():
    """Frame between the tips."""
    tip = mt.capsule(*TIP, 16, "steel")
    shaft = mt.cylinder(SHAFT[0], SHAFT[1], 0.0004, 24, "steel").moved(z=SHAFT[1] / 2)
    handle = mt.capsule(*HANDLE, 32, "coral").moved(z=HANDLE_LOW + HANDLE[1] / 2)
    # A line along the handle, so that turning is seen.
    mark = mt.box(0.003, 0.003, 0.075, 0.0006, color="ivory").moved(x=HANDLE[0] - 0.0009, z=HANDLE_LOW + HANDLE[1] / 2)
    collar = mt.collar(0.004, 0.0085, HANDLE_LOW - 0.004, HANDLE_LOW + 0.004, 0.0008, 28, "graphite")
    return mt.joined([tip.along("x"), tip.along("y"), shaft, handle, mark, collar])


def screw_mesh():
    """Frame in the middle of the disc."""
    radius, height, _ = SCREW
    disc = mt.cylinder(radius, height, 0.0015, 56, "slate")
    blocks = [
        mt.box(*BLOCK, 0.0008, 0.001, "amber").moved(x, y, height / 2 + BLOCK[2] / 2)
        for x in (-BLOCK_AT, BLOCK_AT)
        for y in (-BLOCK_AT, BLOCK_AT)
    ]
    fins = [
        mt.box(0.016, 0.004, 0.002, 0.0004, color="ivory").moved(x, y, height / 2 + 0.0006)
        for x, y, _ in ((radius - 0.012, 0, 0),)
    ]
    return mt.joined([disc, *blocks, *fins])


def stand_mesh():
    base = parts.base_plate(BASE[0], BASE[1]).moved(x=BASE_X)
    height = TOP - BASE[2]
    column = mt.box(COLUMN, COLUMN, height, 0.001, 0.004, "aluminium").moved(COLUMN_X, 0, BASE[2] + height / 2)
    arm = mt.box(*ARM, 0.002, 0.005, "aluminium", 3).moved(ARM_X, 0, TOP)
    upper = parts.bearing(0.0092, 0.05).moved(z=TOP)
    lower = parts.bearing(0.0092, 0.05).along("x").moved(COLUMN_X, 0, HELPER_PAD)
    return mt.joined([base, column, arm, upper, lower])


ARM_X = COLUMN_X - COLUMN / 2 + ARM[0] / 2


def add_screwdriver(model):
    low = HANDLE_LOW + HANDLE[1] / 2
    mass, com, inertia = combined_inertia(
        [
            (MASSES[0], (0, 0, low), cylinder_inertia(MASSES[0], *HANDLE)),
            (MASSES[1], (0, 0, SHAFT[1] / 2), cylinder_inertia(MASSES[1], *SHAFT)),
            (MASSES[2], (0, 0, 0), cylinder_inertia(MASSES[2], *TIP, "x")),
            (MASSES[3], (0, 0, 0), cylinder_inertia(MASSES[3], *TIP, "y")),
        ]
    )
    model.body(
        "tool",
        (0, 0, TIP_HEIGHT + 0.0002),
        mass=mass,
        com=com,
        inertia=inertia,
        mesh="screwdriver.obj",
        compound=[
            placed(shape_round("CAPSULE", *HANDLE), (0, 0, low)),
            placed(shape_round("CYLINDER", *SHAFT), (0, 0, SHAFT[1] / 2)),
            placed(shape_round("CAPSULE", *TIP, "x"), (0, 0, 0)),
            placed(shape_round("CAPSULE", *TIP, "y"), (0, 0, 0)),
        ],
        friction=(0.2, 0.0),
        restitution=0.0,
        damping=(0.0, 0.0),
        **{"collision margin": 0.0002},
    )


def add_screw(model):
    radius, height, mass = SCREW
    at = (0, 0, SCREW_TOP - height / 2)
    model.body(
        "screw",
        at,
        mass=mass,
        inertia=cylinder_inertia(mass, radius, height),
        mesh="screw.obj",
        compound=[
            placed(shape_round("CYLINDER", radius, height), (0, 0, 0)),
            *(
                placed(shape_box(*BLOCK), (x, y, height / 2 + BLOCK[2] / 2))
                for x in (-BLOCK_AT, BLOCK_AT)
                for y in (-BLOCK_AT, BLOCK_AT)
            ),
        ],
        friction=(0.2, 0.0),
        restitution=0.0,
        **{"collision margin": 0.0002},
    )
    model.joint(
        "thread",
        "continuous",
        "stand",
        "screw",
        at,
        (0, 0, 1),
        damping=0.01,
        **parts.holding_motor(1.0, SCREW_FRICTION),
    )


def build(models):
    folder = MeshFolder(models, "screwdriver")
    folder.add("stand.obj", stand_mesh())
    folder.add("screwdriver.obj", screwdriver_mesh())
    folder.add("screw.obj", screw_mesh())
    folder.close()
    model = Model(
        "Two hands on a screwdriver (Fig. 6.11 and Table 6.2 of the dissertation). Joints of stand: `wrist` turns the\n"
        "main hand, `reach` draws the helping hand back, main_hand-a, -b and helping_hand-a, -b open the fingers:\n"
        f"{FIRM} m holds firmly, {LOOSE} m lets the handle turn in the hand. `thread` is the screw's.",
        namespace="/ambf/env/screwdriver/",
        meshes=folder.seen_from(3),
    )
    height = TOP - BASE[2]
    model.body(
        "stand",
        mesh="stand.obj",
        compound=[
            placed(shape_box(*BASE), (BASE_X, 0, BASE[2] / 2)),
            placed(shape_box(COLUMN, COLUMN, height), (COLUMN_X, 0, BASE[2] + height / 2)),
            placed(shape_box(*ARM), (ARM_X, 0, TOP)),
        ],
        **{"publish children names": True},
    )
    add_screw(model)
    add_screwdriver(model)
    # Rays on the middle of the handle: across it they would pass beside.
    main, helper = (0.0, 0.0, MAIN_PAD + PAD), (-PAD, 0.0, HELPER_PAD)
    parts.add_hand(
        model, "main_hand", main, (0, 0, 0), FIRM, parts.SCREWDRIVER, RANGE, (0.012, 5, 0.026, 5), FINGER_MASS
    )
    parts.add_hand(
        model,
        "helping_hand",
        helper,
        (0, -math.pi / 2, 0),
        FIRM,
        parts.SCREWDRIVER,
        RANGE,
        (0.022, 5, 0.012, 5),
        FINGER_MASS,
    )
    model.joint(
        "wrist",
        "revolute",
        "stand",
        "main_hand",
        main,
        (0, 0, 1),
        limits=(-TURN, TURN),
        damping=0.01,
        **parts.holding_motor(4.0, 0.002),
    )
    model.joint(
        "reach",
        "prismatic",
        "stand",
        "helping_hand",
        helper,
        (1, 0, 0),
        limits=(-0.05, 0.0),
        damping=1.0,
        **parts.holding_motor(3.0, 0.05),
    )
    model.write(models / "descriptions" / "multi-bodies" / "touch" / "screwdriver.yaml")
