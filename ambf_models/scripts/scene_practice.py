"""The scene in which people practise (dissertation, Fig. 7.4), ten times as large as life, as the original's puzzle2
has it: a mould with cavities, pieces that fit them, a hinged lid with two clasps, and a lamp that swings.

Names, places, masses, joints and the primitives that collide are those of the original's file, so that scripts and
scalings of devices for it fit; the meshes, and where the cavities are, are ours.
"""

import math

import mesh_tools as mt
import outlines
import shaped_holes as sh
from adf_writer import Model, box_inertia, color_components, cylinder_inertia, placed, shape_box, shape_round
from mesh_folder import MeshFolder
from scene_puzzles import STILL
from scene_worlds import View

MOULD, MOULD_FLOOR, MOULD_TOP, MOULD_LOW = (1.628, 1.984), -0.040, 0.129, -0.125
ROWS = {"square": (-0.992, -0.340), "round": (-0.340, 0.340), "triangle": (0.340, 0.992)}  # along y
COLUMNS = {"B": (-0.814, -0.200), "A": (-0.200, 0.360), "end": (0.360, 0.814)}  # along x
CLEAR = 0.010  # between a piece and its cavity
BOX_A, BOX_B = (0.174, 0.174, 0.386), (0.262, 0.262, 0.431)
ROUND_A, ROUND_B, BALL_A, BALL_B = 0.091, 0.1375, 0.149, 0.1995
TRIANGLE_A, TRIANGLE_B = 0.0565, 0.085  # radius of the circle within
HIGH_A, HIGH_B = BOX_A[2], BOX_B[2]
CAVITIES = {  # row and column: what goes there, its size as of shaped_holes.outline
    ("square", "B"): ("square", BOX_B[0] / 2),
    ("round", "B"): ("round", ROUND_B),
    ("triangle", "B"): ("triangle", TRIANGLE_B),
    ("square", "A"): ("square", BOX_A[0] / 2),
    ("round", "A"): ("round", BALL_B),
    ("triangle", "A"): ("triangle", TRIANGLE_A),
    ("round", "end"): ("round", ROUND_A),
}
LID, LID_HEIGHT, LID_CORNER = (1.613, 1.930), 0.088, (0.233, 0.279)
HINGE_RADIUS, HINGE_LENGTH = 0.135, 1.345
ARM, ARM_CLASP = (0.637, 0.091, 0.182), (0.245, 0.101, 0.113)
TABLE, TABLE_TOP, TABLE_MIDDLE = (4.4, 4.4, 0.08), -1.066, (-0.05, 0.0)
SWING = {**STILL, "damping": (0.95, 0.95)}


def middle_of(row, column):
    return sum(COLUMNS[column]) / 2, sum(ROWS[row]) / 2


def fields():
    for row, (y1, y2) in ROWS.items():
        for column, (x1, x2) in COLUMNS.items():
            yield row, column, (x2 - x1, y2 - y1), middle_of(row, column)


def mould_mesh():
    low = MOULD_FLOOR - MOULD_LOW
    parts = [mt.extrude(outlines.rectangle(*MOULD), low, 0.0, 1, "night").moved(z=MOULD_LOW + low / 2)]
    high = MOULD_TOP - MOULD_FLOOR
    for row, column, size, (x, y) in fields():
        rim = outlines.rectangle(*size)
        if (row, column) in CAVITIES:
            kind, fits = CAVITIES[row, column]
            plate = sh.pierced(rim, sh.outline(kind, fits + CLEAR, 0.006), high, color="night")
        else:
            plate = mt.extrude(rim, high, 0.0, 1, "night")
        parts.append(plate.moved(x, y, MOULD_FLOOR + high / 2))
    return mt.joined(parts)


def mould_shape():
    x, y = MOULD
    boxes = [sh.slab(-x / 2, x / 2, -y / 2, y / 2, MOULD_LOW, MOULD_FLOOR)]
    for row, column, size, at in fields():
        if (row, column) in CAVITIES:
            kind, fits = CAVITIES[row, column]
            boxes += sh.boxes_around(kind, fits + CLEAR, size, at, MOULD_FLOOR, MOULD_TOP)
        else:
            boxes.append(sh.slab(*COLUMNS[column], *ROWS[row], MOULD_FLOOR, MOULD_TOP))
    return boxes


def lid_outline():
    x, y = LID
    cut, along = LID_CORNER
    half = y / 2
    return outlines.rounded_outline(
        [(0, along - half), (cut, -half), (x - cut, -half), (x, along - half)]
        + [(x, half - along), (x - cut, half), (cut, half), (0, half - along)],
        0.02,
        3,
    )


def lid_mesh():
    """Its frame's x leads away from the hinge, its z along it."""
    flat = mt.extrude(lid_outline(), LID_HEIGHT, 0.012, 2, "coral")
    return flat.turned(mt.rotation_about("x", -math.pi / 2))


def lid_shape():
    x, y, z = LID[0], LID[1] / 2, LID_HEIGHT
    cut, along = LID_CORNER
    middle = placed(shape_box(x - 2 * cut, z, 2 * y), (x / 2, 0.0, 0.0))
    ends = [placed(shape_box(cut, z, 2 * (y - along)), (at, 0.0, 0.0)) for at in (cut / 2, x - cut / 2)]
    return [middle, *ends]


def prism_shape(radius, height):
    """Of three boxes along the sides, as long as none sticks out of another side."""
    return [sh.wall(each, radius - 0.045, radius, 2.4 * radius, height) for each in sh.WALLS["triangle"]]


def prism_inertia(mass, radius, height):
    return cylinder_inertia(mass, 1.26 * radius, height)


def piece(model, name, place, mass, inertia, **shape):
    groups = {"collision groups": [0]}
    model.body(name, place, mass=mass, inertia=inertia, mesh=f"{name}.obj", **shape, **STILL, **groups)


def ball_inertia(mass, radius):
    return (0.4 * mass * radius * radius,) * 3


def pieces(model, kind):
    """The pieces of a kind (Ball, Box, Cylinder, Triangle)."""
    if kind == "Ball":
        for name, mass, radius, place in (
            ("Ball_A", 0.4, BALL_A, (1.186, -0.554, -0.625)),
            ("Ball_B", 0.6, BALL_B, (1.090, -0.013, -0.718)),
        ):
            ball = ({"shape": "SPHERE", "geometry": {"radius": radius}}, (0, 0, 0), (0, 0, 0))
            piece(model, name, place, mass, ball_inertia(mass, radius), shape=ball)
    elif kind == "Box":
        for name, mass, size, place in (
            ("Box_A", 0.4, BOX_A, (0.962, -1.126, -0.725)),
            ("Box_B", 0.6, BOX_B, (0.682, -0.521, -0.701)),
        ):
            box = (shape_box(*size), (0, 0, 0), (0, 0, 0))
            piece(model, name, place, mass, box_inertia(mass, *size), shape=box)
    elif kind == "Cylinder":
        for name, mass, radius, height, place in (
            ("Cylinder_A", 0.4, ROUND_A, HIGH_A, (1.435, -0.018, -0.722)),
            ("Cylinder_B", 0.6, ROUND_B, HIGH_B, (0.683, -0.004, -0.703)),
        ):
            rod = (shape_round("CYLINDER", radius, height), (0, 0, 0), (0, 0, 0))
            piece(model, name, place, mass, cylinder_inertia(mass, radius, height), shape=rod)
    else:
        for name, mass, radius, height, place in (
            ("Triangle_A", 0.4, TRIANGLE_A, HIGH_A, (0.992, 1.161, -0.722)),
            ("Triangle_B", 0.6, TRIANGLE_B, HIGH_B, (0.681, 0.542, -0.702)),
        ):
            inertia = prism_inertia(mass, radius, height)
            piece(model, name, place, mass, inertia, compound=prism_shape(radius, height))


def arm(model, side):
    """One of the clasps: an arm beside the mould and what it holds the lid with."""
    left = side == "Left"
    sign = -1.0 if left else 1.0
    model.body(
        f"HandleBase{side}",
        (-0.883, sign * 1.269, -0.925 if left else -0.915),
        (sign * math.pi / 2, 1.222, sign * math.pi / 2),
        mass=1.0,
        inertia=box_inertia(1.0, *ARM),
        com=(-ARM[0] / 2, 0.0, 0.0),
        mesh="arm.obj",
        shape=(shape_box(*ARM), (-ARM[0] / 2, 0, 0), (0, 0, 0)),
        **STILL,
        **{"collision groups": [0]},
    )
    model.body(
        f"HandleLid{side}",
        (-0.883, -1.005 if left else 1.016, -0.365 if left else -0.357),
        (math.pi / 2, 0.0, sign * math.pi / 2),
        mass=0.5,
        inertia=box_inertia(0.5, *ARM_CLASP),
        com=(-ARM_CLASP[0] / 2, 0.0, 0.0),
        mesh="clasp.obj",
        shape=(shape_box(*ARM_CLASP), (-ARM_CLASP[0] / 2, 0, 0), (0, 0, 0)),
        **STILL,
        **{"collision groups": [0]},
    )


def lamp(model, name, mass, place, com, shape, inertia):
    where = (shape, com, (0, 0, 0))
    groups = {"collision groups": [0]}
    model.body(name, place, mass=mass, inertia=inertia, com=com, mesh=f"{name}.obj", shape=where, **SWING, **groups)


def puzzle2(folder):
    model = Model(
        "A mould, pieces that fit into its cavities, a hinged lid with two clasps, and a lamp: where people practise\n"
        "(dissertation, Fig. 7.4), ten times as large as life. Names, places and joints as in the original's file;\n"
        "frames: middles of the pieces, and where parts are hinged.",
        "/ambf/env/",
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    for kind in ("Ball", "Box", "Cylinder"):
        pieces(model, kind)
    groups = {"collision groups": [0]}
    model.body(
        "Mold_A",
        (-0.838, -0.013, -0.939),
        mass=100.0,
        inertia=box_inertia(100.0, *MOULD, MOULD_TOP - MOULD_LOW),
        mesh="mould.obj",
        compound=mould_shape(),
        **{**STILL, "friction": (1.0, 0.01)},
        **groups,
    )
    arm(model, "Left")
    arm(model, "Right")
    model.body(
        "MoldHinge",
        (-1.687, -0.013, -0.667),
        (math.pi / 2, 0.0, 0.0),
        mass=1.0,
        inertia=cylinder_inertia(1.0, HINGE_RADIUS, HINGE_LENGTH),
        mesh="hinge.obj",
        shape=(shape_round("CYLINDER", HINGE_RADIUS, HINGE_LENGTH), (0, 0, 0), (0, 0, 0)),
        **STILL,
        **groups,
    )
    model.body(
        "TopPlate",
        (-1.645, -0.013, -0.492),
        (math.pi / 2, 0.0, 0.0),
        mass=5.0,
        inertia=box_inertia(5.0, LID[0], LID_HEIGHT, LID[1]),
        com=(LID[0] / 2, 0.0, 0.0),
        mesh="lid.obj",
        compound=lid_shape(),
        **{"color components": {**color_components("coral"), "transparency": 0.45}},
        **STILL,
        **groups,
    )
    pieces(model, "Triangle")
    x, y = -0.874, 0.051
    cone = {"shape": "CONE", "geometry": {"radius": 0.1415, "height": 0.283, "axis": "Z"}}
    lamp(model, "LightCone", 0.05, (x, y, 0.435), (0, 0, -0.251), cone, cylinder_inertia(0.05, 0.1, 0.283))
    cube = shape_box(0.132, 0.132, 0.132)
    lamp(model, "LightCube", 0.05, (x, y, 0.752), (0, 0, -0.139), cube, box_inertia(0.05, 0.132, 0.132, 0.132))
    lamp(model, "LightCylinder", 0.0, (x, y, 1.215), (0, 0, 0), shape_round("CYLINDER", 0.097, 0.055), None)
    ball = {"shape": "SPHERE", "geometry": {"radius": 0.0795}}
    lamp(model, "LightSphere", 0.05, (x, y, 1.041), (0, 0, -0.086), ball, ball_inertia(0.05, 0.0795))
    for side, sign in (("Left", -1.0), ("Right", 1.0)):
        base, clasp = (model.bodies[f"Handle{part}{side}"]["location"]["position"] for part in ("Base", "Lid"))
        point = tuple(base.values())
        span = (-0.087, 1.047) if side == "Left" else (-1.047, 0.087)
        servo = {"controller": {"P": 101000.0, "I": 0.0, "D": 202.0}}
        name = f"HandleBase{side}"
        model.joint(f"Mold_A-{name}", "revolute", "Mold_A", name, point, (1, 0, 0), limits=span, **servo)
        point = tuple(clasp.values())
        name = f"HandleBase{side}-HandleLid{side}"
        model.joint(name, "fixed", f"HandleBase{side}", f"HandleLid{side}", point, (sign, 0, 0))
    servo = {"controller": {"P": 101000.0, "I": 0.0, "D": 202.0}}
    at = (-1.687, -0.013, -0.667)
    model.joint("Mold_A-MoldHinge", "revolute", "Mold_A", "MoldHinge", at, (0, -1, 0), limits=(0.0, 2.094), **servo)
    model.joint("MoldHinge-TopPlate", "fixed", "MoldHinge", "TopPlate", (-1.645, -0.013, -0.492), (0, -1, 0))
    for upper, lower in (("LightCube", "LightCone"), ("LightSphere", "LightCube"), ("LightCylinder", "LightSphere")):
        point = tuple(model.bodies[lower]["location"]["position"].values())
        model.joint(f"{upper}-{lower}", "p2p", upper, lower, point, (0, 0, 1))
    return model


def ball_mesh(radius, color):
    rim = [(radius * math.cos(a), radius * math.sin(a)) for a in (math.pi * (k / 24 - 0.5) for k in range(25))]
    return mt.lathe([(0.0, -radius), *rim[1:-1], (0.0, radius)], 36, color)


def prism_mesh(radius, height, color):
    return mt.extrude(sh.outline("triangle", radius, 0.006), height, 0.006, 2, color)


def rod_mesh(length, radius, z):
    """What a part of the lamp hangs on."""
    return mt.cylinder(radius, length, 0.0, 12, "steel").moved(z=z)


def lamp_meshes(folder):
    cone = mt.lathe([(0.0, -0.3925), (0.1415, -0.3925), (0.0, -0.1095)], 36, "lamp")
    folder.add("LightCone.obj", mt.joined([cone, rod_mesh(0.12, 0.006, -0.06)]))
    cube = mt.box(0.132, 0.132, 0.132, 0.01, color="amber").moved(z=-0.139)
    folder.add("LightCube.obj", mt.joined([cube, rod_mesh(0.075, 0.006, -0.0375), rod_mesh(0.112, 0.006, -0.261)]))
    top = mt.cylinder(0.097, 0.055, 0.01, 36, "teal")
    folder.add("LightCylinder.obj", mt.joined([top, rod_mesh(0.147, 0.006, -0.1)]))
    ball = ball_mesh(0.0795, "sage").moved(z=-0.086)
    folder.add("LightSphere.obj", mt.joined([ball, rod_mesh(0.124, 0.006, -0.227)]))


def build(models):
    studies = models / "studies"
    studies.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "practice")
    for name, radius, color in (("Ball_A", BALL_A, "coral"), ("Ball_B", BALL_B, "sage")):
        folder.add(f"{name}.obj", ball_mesh(radius, color))
    for name, size, color in (("Box_A", BOX_A, "sky"), ("Box_B", BOX_B, "plum")):
        folder.add(f"{name}.obj", mt.box(*size, 0.006, color=color))
    folder.add("Cylinder_A.obj", mt.cylinder(ROUND_A, HIGH_A, 0.006, 36, "amber"))
    folder.add("Cylinder_B.obj", mt.cylinder(ROUND_B, HIGH_B, 0.006, 36, "teal"))
    folder.add("Triangle_A.obj", prism_mesh(TRIANGLE_A, HIGH_A, "sand"))
    folder.add("Triangle_B.obj", prism_mesh(TRIANGLE_B, HIGH_B, "brass"))
    folder.add("mould.obj", mould_mesh())
    folder.add("arm.obj", mt.box(*ARM, 0.012, color="graphite").moved(x=-ARM[0] / 2))
    folder.add("clasp.obj", mt.box(*ARM_CLASP, 0.012, color="sky").moved(x=-ARM_CLASP[0] / 2))
    folder.add("hinge.obj", mt.cylinder(HINGE_RADIUS, HINGE_LENGTH, 0.012, 40, "coral"))
    folder.add("lid.obj", lid_mesh())
    lamp_meshes(folder)
    folder.add("practice_table.obj", sh.table_mesh(TABLE))
    folder.close()
    puzzle2(folder).write(studies / "puzzle2.yaml")
    title = "The table of the practice scene; its top is at z = -1.066."
    made = sh.table(folder, title, "practice_table.obj", TABLE_MIDDLE, TABLE_TOP, TABLE, 0.8)
    made.write(studies / "practice_table.yaml")
    view = View((4.6, -0.9, 1.9), (-0.25, 0.0, -0.68), 0.62)
    title = "A table with the practice scene in view, from where the operator sits."
    world = sh.world(title, "practice_table.yaml", (-0.2, 0.0, -0.6), 1.9, view)
    (studies / "practice_world.yaml").write_text(world, encoding="utf-8")
    title = (
        "The practice scene of the dissertation, ten times as large as life: -l 0, with its task -l 0,1, and with\n"
        "four hands -l 0,1,2: G in the window moves one by keyboard and mouse."
    )
    files = ("./puzzle2.yaml", "../descriptions/tasks/puzzle2.yaml", "./four_hands.yaml")
    text = sh.launch(title, "practice_world.yaml", files, "input_devices_four_hands.yaml")
    (studies / "launch_practice.yaml").write_text(text, encoding="utf-8")
