"""The original's ScrewDriverEnv (dissertation, Fig. 6.11), ten times as large as life: a screwdriver with crossed tips
above a tilted disc, which turns and has four blocks that the tips go between.

Names, order, places, masses, joints and the primitives that collide are those of the original's file, so that scripts
and scalings of devices for it fit; the meshes and what the base stands on are ours. `scene_screwdriver` has the same
task at a fifth of its size, with hands.
"""

import math

import mesh_tools as mt
import outlines
import shaped_holes as sh
from adf_kinematics import plus, rotate, rpy
from adf_writer import Model, addon_gains, box_inertia, cylinder_inertia, placed, shape_box, shape_round
from mesh_folder import MeshFolder
from scene_puzzles import STILL
from scene_worlds import View

TILT = 0.262
BASE, BASE_AT = (0.983, 2.353, 0.026), (-1.211, 0.0, -1.209)
DISC_RADIUS, DISC_HEIGHT, DISC_UP = 0.3765, 0.071, 0.104  # above the base's middle
BLOCK = (0.0713, 0.0713, 0.0884)
BLOCKS = (("001_001", 1, -1), ("002", 1, 1), ("003", -1, 1), ("004", -1, -1))  # name, where on the disc
BLOCK_OFF, BLOCK_UP = 0.071, 0.082
FIN, FINS = (0.382, 0.09, 0.03), (("Fin1", 0.543), ("Fin2", -0.564))  # along the disc's x
TOOL_X = -1.211
HANDLE, HANDLE_Z, HANDLE_MIDDLE = (0.075, 0.557), 0.124, 0.046  # radius, height; of its frame; above that
SHAFT, SHAFT_Z, SHAFT_MIDDLE = (0.021, 0.534), -0.244, -0.126
TIP, TIP_Z = (0.022, 0.2005), -0.661
TABLE, TABLE_TOP, TABLE_MIDDLE = (2.4, 3.2, 0.08), -1.42, (-1.15, 0.0)
LEG_X, LEG_Y, LEG = 0.40, 1.0, 0.06  # of the two walls that the base stands on: half their length, place, thickness


def leg_height(x):
    """From the lower side of the base to the table, across the base."""
    return (BASE_AT[2] - TABLE_TOP - x * math.sin(TILT)) / math.cos(TILT) - BASE[2] / 2


def base_mesh():
    parts = [mt.extrude(outlines.rectangle(BASE[0], BASE[1], 0.04, 6), BASE[2], 0.006, 2, "ivory")]
    low = -BASE[2] / 2
    side = [(-LEG_X, low - leg_height(-LEG_X)), (LEG_X, low - leg_height(LEG_X)), (LEG_X, low), (-LEG_X, low)]
    for y in (-LEG_Y, LEG_Y):
        wall = mt.extrude(outlines.rounded_outline(side, 0.0), LEG, 0.0, 1, "graphite")
        parts.append(wall.turned([[1, 0, 0], [0, 0, -1], [0, 1, 0]]).moved(y=y))
    axle = DISC_UP - DISC_HEIGHT / 2 - BASE[2] / 2
    parts.append(mt.cylinder(0.09, axle, 0.0, 36, "steel").moved(z=(BASE[2] + axle) / 2))
    return mt.joined(parts)


def base_shape():
    """The plate, and what of its walls lies right below it."""
    high = leg_height(LEG_X)
    walls = [shape_box(2 * LEG_X, LEG, high)] * 2
    low = -(BASE[2] + high) / 2
    return [
        placed(shape_box(*BASE), (0, 0, 0)),
        *(placed(wall, (0, y, low)) for wall, y in zip(walls, (-LEG_Y, LEG_Y), strict=True)),
    ]


def handle_mesh():
    """Ribs along a capsule, so that turning is seen; its frame is below its middle."""
    radius, height = HANDLE
    ribs = []
    for k in range(8):
        a = 2 * math.pi * k / 8
        rib = mt.capsule(0.012, 0.36, 10, "ivory" if k == 0 else "graphite")
        ribs.append(rib.moved((radius - 0.004) * math.cos(a), (radius - 0.004) * math.sin(a)))
    body = mt.capsule(radius, height, 40, "sky")
    return mt.joined([body, *ribs]).moved(z=HANDLE_MIDDLE)


def shaft_mesh():
    collar = mt.cylinder(0.034, 0.05, 0.006, 32, "graphite").moved(z=SHAFT[1] / 2 - 0.025)
    return mt.joined([mt.cylinder(*SHAFT, 0.004, 32, "steel"), collar]).moved(z=SHAFT_MIDDLE)


def above_base(x, y, z):
    """From the disc's frame to the world."""
    return plus(BASE_AT, rotate(rpy(0.0, TILT, 0.0), (x, y, DISC_UP + z)))


def add_bodies(model):
    """In the original's order."""
    tilted = (0.0, TILT, 0.0)

    def on_disc(name, at, mass, inertia, groups, **shape):
        model.body(
            name,
            above_base(*at),
            tilted,
            mass=mass,
            inertia=inertia,
            **shape,
            **STILL,
            **{"collision groups": groups},
        )

    for end, x, y in BLOCKS:
        on_disc(
            f"Cube_{end}",
            (x * BLOCK_OFF, y * BLOCK_OFF, BLOCK_UP),
            0.1,
            box_inertia(0.1, *BLOCK),
            [0, 1],
            mesh="block.obj",
            color="coral" if end == "001_001" else "sky",
            shape=(shape_box(*BLOCK), (0, 0, 0), (0, 0, 0)),
        )
    model.body(
        "Cylinder",
        above_base(0.0, 0.0, 0.0),
        tilted,
        mass=0.5,
        inertia=cylinder_inertia(0.5, DISC_RADIUS, DISC_HEIGHT),
        mesh="disc.obj",
        shape=(shape_round("CYLINDER", DISC_RADIUS, DISC_HEIGHT), (0, 0, 0), (0, 0, 0)),
        **{**STILL, "damping": (0.04, 0.9)},
        **{"collision groups": [0, 1]},
    )
    for name, x in FINS:
        on_disc(
            name,
            (x, 0.0, -0.005),
            0.1,
            box_inertia(0.1, *FIN),
            [0],
            mesh="fin.obj",
            color="amber" if name == "Fin1" else "sage",
            shape=(shape_box(*FIN), (0, 0, 0), (0, 0, 0)),
        )
    groups = {"collision groups": [0, 1]}
    model.body("FixedBase", BASE_AT, tilted, mesh="base.obj", compound=base_shape(), friction=(0.5, 0.01), **groups)
    for name, mass, z, middle, shape, inertia in (
        ("SDHandle", 0.2, HANDLE_Z, HANDLE_MIDDLE, shape_round("CAPSULE", *HANDLE), cylinder_inertia(0.2, *HANDLE)),
        ("SDShaft", 0.1, SHAFT_Z, SHAFT_MIDDLE, shape_round("CYLINDER", *SHAFT), cylinder_inertia(0.1, *SHAFT)),
    ):
        at = (TOOL_X, 0.0, z)
        com = (0.0, 0.0, middle)
        shaped = {"mesh": f"{name}.obj", "shape": (shape, com, (0, 0, 0))}
        model.body(name, at, mass=mass, inertia=inertia, com=com, **shaped, **STILL, **groups)
    for name, turned, group in (("SDTip1", math.pi / 2, 0), ("SDTip2", 0.0, 1)):
        model.body(
            name,
            (TOOL_X, 0.0, TIP_Z),
            (math.pi / 2, 0.0, turned),
            mass=0.15,
            inertia=cylinder_inertia(0.15, *TIP),
            mesh="tip.obj",
            shape=(shape_round("CYLINDER", *TIP), (0, 0, 0), (0, 0, 0)),
            **STILL,
            **{"collision groups": [group]},
        )


def place_of(model, body):
    return tuple(model.bodies[body]["location"]["position"].values())


def screwdriver_env(folder):
    model = Model(
        "A screwdriver above a tilted disc with four blocks that its crossed tips go between (dissertation,\n"
        "Fig. 6.11), ten times as large as life. Names, places and joints as in the original's ScrewDriverEnv.\n"
        "Frames: middles, but for SDHandle and SDShaft, whose middles are 0.046 m above and 0.126 m below their\n"
        "frames. FixedBase-Cylinder turns.",
        "/ambf/env/ScrewDriverEnv/",
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    add_bodies(model)
    normal = (math.sin(TILT), 0.0, math.cos(TILT))
    for end, _, _ in BLOCKS:
        child = f"Cube_{end}"
        at = place_of(model, child)
        model.joint(f"Cylinder-{child}", "fixed", "Cylinder", child, at, normal, **addon_gains(600.0))
    disc = place_of(model, "Cylinder")
    model.joint("FixedBase-Cylinder", "continuous", "FixedBase", "Cylinder", disc, normal, **addon_gains(500.0))
    for name, _ in FINS:
        model.joint(f"Cylinder-{name}", "fixed", "Cylinder", name, place_of(model, name), normal, **addon_gains(600.0))
    shaft = place_of(model, "SDShaft")
    model.joint("SDHandle-SDShaft", "fixed", "SDHandle", "SDShaft", shaft, (0, 0, 1), **addon_gains(300.0))
    for name, axis in (("SDTip1", (1, 0, 0)), ("SDTip2", (0, -1, 0))):
        model.joint(f"SDShaft-{name}", "fixed", "SDShaft", name, place_of(model, name), axis, **addon_gains(250.0))
    return model


def build(models):
    studies = models / "studies"
    studies.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "screwdriver_env")
    folder.add("base.obj", base_mesh())
    folder.add("block.obj", mt.box(*BLOCK, 0.006, color="shell"))
    folder.add("fin.obj", mt.box(*FIN, 0.006, 0.03, "shell"))
    folder.add("disc.obj", mt.cylinder(DISC_RADIUS, DISC_HEIGHT, 0.008, 64, "slate"))
    folder.add("SDHandle.obj", handle_mesh())
    folder.add("SDShaft.obj", shaft_mesh())
    folder.add("tip.obj", mt.cylinder(*TIP, 0.004, 28, "steel"))
    folder.add("table.obj", sh.table_mesh(TABLE))
    folder.close()
    screwdriver_env(folder).write(studies / "screwdriver_env.yaml")
    title = f"The table of the screwdriver's scene; its top is at z = {TABLE_TOP}."
    made = sh.table(folder, title, "table.obj", TABLE_MIDDLE, TABLE_TOP, TABLE, 0.8)
    made.write(studies / "screwdriver_env_table.yaml")
    view = View((1.6, -2.3, 0.75), (-1.17, 0.0, -0.50), 0.56)
    title = "A table with the screwdriver's scene in view, from where the operator sits."
    world = sh.world(title, "screwdriver_env_table.yaml", (-1.15, 0.0, -0.7), 1.6, view)
    (studies / "screwdriver_env_world.yaml").write_text(world, encoding="utf-8")
    title = "The original's ScrewDriverEnv, ten times as large as life: -l 0, with its task -l 0,1, and hands -l 0,1,2."
    files = ("./screwdriver_env.yaml", "../descriptions/tasks/screwdriver_env.yaml", "./four_hands.yaml")
    text = sh.launch(title, "screwdriver_env_world.yaml", files)
    (studies / "launch_screwdriver_env.yaml").write_text(text, encoding="utf-8")
