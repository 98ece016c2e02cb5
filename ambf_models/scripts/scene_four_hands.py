"""Four hands for the scenes of the studies, ten times as large as life (dissertation, Fig. 3.21): two people with two
grippers each lift the plate of study B by its handles, which takes at least two of them, put it over the pegs of its
base, and the spools on top of it.

All is chosen: sizes after what they hold (handles 0.11 m thick, spools 0.35 m wide), masses and gains so that each
carries 1 kg within a centimetre. They float, as the original's did, and grasp by friction alone.
"""

import math

import mesh_tools as mt
import outlines
import shaped_holes as sh
from adf_writer import (
    Model,
    box_inertia,
    combined_inertia,
    cylinder_inertia,
    placed,
    shape_box,
    shape_round,
    spring_servo,
    vector,
)
from mesh_folder import MeshFolder
from scene_worlds import View

NAMESPACE = "/ambf/env/hands/"
PALM, PALM_MASS = (0.08, 0.54, 0.12), 1.2  # x, y, z; m, kg
SHAFT, SHAFT_MASS = (0.045, 0.60), 1.0  # radius, length, above the palm
FINGER, FINGER_MASS = (0.07, 0.045, 0.42), 0.2
PAD = 0.15  # m, of a finger's end: covered with rubber
STROKE, HOME = 0.22, 0.10  # of each finger
STIFFNESS, DAMPING, MAX_IMPULSE = 1500.0, 40.0, 0.04  # N/m, N s/m; N s a step: 45 N for a target 30 mm inside
LINEAR, ANGULAR = {"P": 3000.0, "I": 0.0, "D": 150.0}, {"P": 60.0, "I": 0.0, "D": 3.0}
HANDS = {  # name: color, where it begins, above all that lies on the tables
    "user1_left": ("teal", (1.0, -1.3, 0.35)),
    "user1_right": ("teal", (1.0, 1.3, 0.35)),
    "user2_left": ("coral", (0.2, -1.3, 0.35)),
    "user2_right": ("coral", (0.2, 1.3, 0.35)),
}


def palm_mesh(color):
    """A rail for the fingers below, a shaft above with a band of its user's colour."""
    x, y, z = PALM
    body = mt.box(x, y, z - 0.02, 0.012, 0.03, "shell", 3).moved(z=(z + 0.02) / 2)
    rail = mt.box(x - 0.02, y - 0.04, 0.03, 0.004, 0.008, "steel").moved(z=0.008)
    band = mt.box(x + 0.002, y + 0.002, 0.02, 0.003, 0.031, color, 3).moved(z=0.6 * z)
    shaft = mt.cylinder(SHAFT[0], SHAFT[1], 0.01, 32, "carbon").moved(z=z + SHAFT[1] / 2)
    collar = mt.collar(0.03, SHAFT[0] + 0.003, z + 0.08, z + 0.14, 0.004, 32, color)
    flange = mt.cylinder(SHAFT[0] + 0.02, 0.03, 0.006, 32, "graphite").moved(z=z + 0.01)
    return mt.joined([body, rail, band, shaft, collar, flange])


def finger_mesh(side):
    """side +1: its inner face at y = 0 looks to -y."""
    x, y, z = FINGER
    outline = outlines.rounded_outline(
        [(0.006, -z), (0.6 * y, -z), (y, -0.5 * z), (y, -0.01), (0.006, -0.01)], [0.004, 0.014, 0.05, 0.006, 0.004], 5
    )
    finger = mt.extrude(outline, x, 0.006, 3, "aluminium").along("x")
    pad = mt.box(x - 0.008, 0.012, PAD, 0.003, color="rubber").moved(y=0.006, z=-z + PAD / 2 + 0.006)
    slider = mt.box(x + 0.014, 0.07, 0.045, 0.008, color="graphite").moved(y=0.034, z=-0.025)
    mesh = mt.joined([finger, pad, slider])
    return mesh if side > 0 else mesh.turned(mt.rotation_about("z", math.pi))


def add_hand(model, name, at):
    x, y, z = PALM
    mass, com, inertia = combined_inertia(
        [
            (PALM_MASS, (0, 0, z / 2), box_inertia(PALM_MASS, x, y, z)),
            (SHAFT_MASS, (0, 0, z + SHAFT[1] / 2), cylinder_inertia(SHAFT_MASS, *SHAFT)),
        ]
    )
    groups = {"collision groups": [0], "collision margin": 0.001}
    model.body(
        name,
        at,
        mass=mass,
        inertia=inertia,
        com=com,
        mesh=f"{name.partition('_')[0]}.obj",
        damping=(0.5, 0.5),
        compound=[
            placed(shape_box(x, y, z), (0, 0, z / 2)),
            placed(shape_round("CYLINDER", *SHAFT), (0, 0, z + SHAFT[1] / 2)),
        ],
        controller={"linear": LINEAR, "angular": ANGULAR},
        **{"controller output type": "FORCE", "publish children names": True},
        **groups,
    )
    fx, fy, fz = FINGER
    for finger, sign in (("a", 1.0), ("b", -1.0)):
        middle = (0.0, sign * (fy / 2 + 0.002), -fz / 2)
        place = (at[0], at[1] + sign * HOME, at[2])
        model.body(
            f"{name}_finger_{finger}",
            place,
            mass=FINGER_MASS,
            com=middle,
            inertia=box_inertia(FINGER_MASS, fx, fy, fz),
            mesh=f"finger_{finger}.obj",
            shape=(shape_box(fx, fy, fz), middle, (0, 0, 0)),
            friction=(1.2, 0.01),
            restitution=0.0,
            **groups,
        )
        model.joint(
            f"{name}-{finger}",
            "prismatic",
            name,
            f"{name}_finger_{finger}",
            at,
            (0, sign, 0),
            child_point=place,
            limits=(0.0, STROKE),
            damping=1.0,
            **spring_servo(STIFFNESS, DAMPING, MAX_IMPULSE),
        )


def four_hands(folder):
    model = Model(
        "Four parallel grippers of two users, for the scenes of the studies, ten times as large as life\n"
        "(dissertation, Fig. 3.21). They float; palms have the Cartesian controller, NAME-a and NAME-b open the\n"
        f"fingers by up to {STROKE} m each. A frame is in the middle of the palm's underside; fingers point to -z.",
        NAMESPACE,
        folder.seen_from(1),
        gravity=vector((0, 0, 0)),
    )
    for name, (_, at) in HANDS.items():
        add_hand(model, name, at)
    return model


def build(models):
    studies = models / "studies"
    studies.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "four_hands")
    folder.add("user1.obj", palm_mesh("teal"))
    folder.add("user2.obj", palm_mesh("coral"))
    folder.add("finger_a.obj", finger_mesh(1.0))
    folder.add("finger_b.obj", finger_mesh(-1.0))
    folder.close()
    four_hands(folder).write(studies / "four_hands.yaml")
    view = View((4.9, -0.9, 2.3), (-0.2, -0.05, -0.62), 0.62)
    title = "The table of study B and four hands above it, from where the operator sits."
    world = sh.world(title, "study_b_table.yaml", (-0.2, 0.0, -0.6), 2.0, view)
    (studies / "four_hands_world.yaml").write_text(world, encoding="utf-8")
    title = (
        "The multi-link puzzle for four hands (dissertation, Fig. 3.21), ten times as large as life: -l 0,1, with its\n"
        "task -l 0,1,2. -n 4 gives the hands to two pairs of masters; G in the window moves one by keyboard and mouse."
    )
    files = ("./puzzle1.yaml", "./four_hands.yaml", "../descriptions/tasks/four_hands.yaml")
    text = sh.launch(title, "four_hands_world.yaml", files, "input_devices_four_hands.yaml")
    (studies / "launch_four_hands.yaml").write_text(text, encoding="utf-8")
