"""The scene of study B (dissertation, Fig. 7.5b), ten times as large as life, as the original's puzzle1 has it: two
people take a yellow plate by its two handles and put it over the three pegs of a base.

Names, places, masses and joints are those of the original's file, so that scripts and scalings of devices for it fit;
the meshes are ours. Holes and pegs, plate and base are square, round and triangular along y.
"""

import math

import mesh_tools as mt
import outlines
import shaped_holes as sh
from adf_writer import Model, box_inertia, cylinder_inertia, placed, shape_box, shape_round, tube_inertia
from mesh_folder import MeshFolder
from scene_puzzles import STILL
from scene_worlds import View

PLATE, PLATE_FIELD = (0.70, 1.75, 0.10), 0.50  # each hole is in the middle of a field of that length
POCKET = (0.25, 0.125)  # where a handle sits in an end of the plate
HOLE, HOLE_IN_RADIUS = 0.09, 0.052  # half a side and radius; of the circle within the triangle
PEG, PEG_IN_RADIUS, PEG_LENGTH = 0.075, 0.043, 0.50
BLOCK = (0.70, 1.50, 0.15)  # of the base, below its pegs
SPOOL, WAIST, SPOOL_HEIGHT, FLANGE = 0.175, 0.150, 0.30, 0.075
ROD, FRAME_X, FRAME_Z = 0.055, 0.32, 0.21  # of a handle: half its thickness, and between the middles of its bars
DISC, DISC_HEIGHT, POST, POST_TOP = 0.446, 0.030, 0.090, 0.616
RING, RING_ROD = 0.200, 0.073
TABLE, TABLE_TOP, TABLE_MIDDLE = (4.4, 4.6, 0.08), -1.080, (-0.35, -0.2)
KINDS = {"square": -PLATE_FIELD, "round": 0.0, "triangle": PLATE_FIELD}  # and where along the plate and the base


def size_of(kind):
    return HOLE_IN_RADIUS if kind == "triangle" else HOLE


def hole(kind):
    return sh.outline(kind, size_of(kind), 0.012)


def plate_mesh():
    fields = []
    for kind, y in KINDS.items():
        rim = outlines.rectangle(PLATE[0], PLATE_FIELD)
        fields.append(sh.pierced(rim, hole(kind), PLATE[2], color="amber").moved(y=y))
    reach = PLATE[1] / 2 - 1.5 * PLATE_FIELD
    side = (PLATE[0] - POCKET[0]) / 2
    for x, y in ((x, y) for x in (-1, 1) for y in (-1, 1)):
        piece = mt.extrude(outlines.rectangle(side, reach), PLATE[2], 0.0, 1, "amber")
        fields.append(piece.moved(x * (PLATE[0] - side) / 2, y * (PLATE[1] - reach) / 2))
    return mt.joined(fields)


def plate_shape():
    half, end, z = PLATE[0] / 2, PLATE[1] / 2, PLATE[2] / 2
    boxes = []
    for kind, y in KINDS.items():
        boxes += sh.boxes_around(kind, size_of(kind), (PLATE[0], PLATE_FIELD), (0.0, y), -z, z)
    for sign in (-1, 1):
        y1, y2 = sorted((sign * (end - POCKET[1]), sign * end))
        boxes.append(sh.slab(-half, -POCKET[0] / 2, y1, y2, -z, z))
        boxes.append(sh.slab(POCKET[0] / 2, half, y1, y2, -z, z))
    return boxes


def handle_bars(sign):
    """Middles and lengths of a handle's four bars, in its frame: y outwards, z along the plate's x."""
    far = sign * FRAME_X
    return [
        ((0.0, 0.0, 0.0), "z", FRAME_Z),
        ((0.0, far, 0.0), "z", FRAME_Z),
        ((0.0, far / 2, -FRAME_Z / 2), "y", FRAME_X),
        ((0.0, far / 2, FRAME_Z / 2), "y", FRAME_X),
    ]


def handle_mesh(sign):
    return mt.joined(
        mt.capsule(ROD, length + 2 * ROD, 16, "graphite").along(axis).moved(*at)
        for at, axis, length in handle_bars(sign)
    )


def handle_shape(sign):
    return [placed(shape_round("CAPSULE", ROD, length + 2 * ROD, axis), at) for at, axis, length in handle_bars(sign)]


def spool_mesh(kind, color):
    flange, waist = outlines.circle(SPOOL, 48), outlines.circle(WAIST, 48)
    high = SPOOL_HEIGHT - 2 * FLANGE
    return mt.joined(
        [
            sh.pierced(flange, hole(kind), FLANGE, 0.008, 2, color).moved(z=FLANGE / 2),
            sh.pierced(waist, hole(kind), high + 0.016, 0.0, 1, color).moved(z=SPOOL_HEIGHT / 2),
            sh.pierced(flange, hole(kind), FLANGE, 0.008, 2, color).moved(z=SPOOL_HEIGHT - FLANGE / 2),
        ]
    )


def spool_shape(kind):
    middle = (0.0, 0.0, SPOOL_HEIGHT / 2)
    near, far, width = {"square": (HOLE, 0.14, 0.2), "round": (HOLE, 0.16, 0.1326), "triangle": (0.052, 0.15, 0.18)}[
        kind
    ]
    walls = [sh.wall(each, near, far, width, SPOOL_HEIGHT, middle) for each in sh.WALLS[kind]]
    if kind == "triangle":  # beyond its corners
        walls += [sh.wall(each, 0.115, 0.165, 0.11, SPOOL_HEIGHT, middle) for each in (0, 120, 240)]
    return walls


def base_mesh():
    parts = [mt.extrude(outlines.rectangle(*BLOCK[:2], 0.03, 4), BLOCK[2], 0.01, 2, "slate").moved(z=BLOCK[2] / 2)]
    for kind, y in KINDS.items():
        shape = sh.outline(kind, PEG_IN_RADIUS if kind == "triangle" else PEG, 0.008)
        peg = mt.extrude(shape, PEG_LENGTH, 0.008, 2, "aluminium")
        parts.append(peg.moved(y=y, z=BLOCK[2] + PEG_LENGTH / 2))
    return mt.joined(parts)


def base_shape():
    up = BLOCK[2] + PEG_LENGTH / 2
    square = placed(shape_box(2 * PEG, 2 * PEG, PEG_LENGTH), (0.0, KINDS["square"], up))
    around = placed(shape_round("CYLINDER", PEG, PEG_LENGTH), (0.0, KINDS["round"], up))
    corner = (0.0, KINDS["triangle"], up)
    near, far = PEG_IN_RADIUS - 0.02, PEG_IN_RADIUS
    sides = [sh.wall(each, near, far, 0.12, PEG_LENGTH, corner) for each in sh.WALLS["triangle"]]
    return [placed(shape_box(*BLOCK), (0.0, 0.0, BLOCK[2] / 2)), square, around, *sides]


def peg_base_mesh():
    low = POST_TOP - 0.005
    disc = mt.cylinder(DISC, DISC_HEIGHT, 0.008, 64, "slate").moved(z=0.0015)
    return mt.joined([disc, mt.cylinder(POST, low, 0.015, 40, "aluminium").moved(z=POST_TOP - low / 2)])


def ring_shape(parts=10):
    """Capsules about z, with their length along y where they are turned by none."""
    length = 2 * RING * math.tan(math.pi / parts)
    capsule = shape_round("CAPSULE", RING_ROD, length + 2 * RING_ROD, "y")
    turns = [2 * math.pi * k / parts for k in range(parts)]
    return [placed(capsule, (RING * math.cos(a), RING * math.sin(a), 0.0), (0.0, 0.0, a)) for a in turns]


def puzzle1(folder):
    model = Model(
        "A yellow plate with two handles, and the base with three pegs that it is put over: study B of two people who\n"
        "share a task (dissertation, Fig. 7.5b), ten times as large as life. Names, places and joints as in the\n"
        "original's file; frames: middle of the plate, middle of a handle's inner bar, middle of the lower side of\n"
        "base and spools. Occulus marks where the original had a viewer's head.",
        "/ambf/env/",
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    more = {**STILL, "collision groups": [0]}
    model.body(
        "CenterPuzzle",
        (1.0, 0.0, -1.0),
        mass=1.0,
        inertia=box_inertia(1.0, *PLATE),
        mesh="plate.obj",
        compound=plate_shape(),
        **more,
    )
    for name, sign in (("HandleLeft", -1), ("HandleRight", 1)):
        model.body(
            name,
            (1.0, sign * 0.85, -1.0),
            (0.0, math.pi / 2, 0.0),
            mass=0.3,
            inertia=box_inertia(0.3, 2 * ROD, FRAME_X + 2 * ROD, FRAME_Z + 2 * ROD),
            com=(0.0, sign * FRAME_X / 2, 0.0),
            mesh=f"{name}.obj",
            compound=handle_shape(sign),
            **more,
        )

    def spool(name, kind, color, y):
        model.body(
            name,
            (0.0, y, -1.0),
            mass=0.8,
            inertia=tube_inertia(0.8, SPOOL, HOLE, SPOOL_HEIGHT),
            com=(0.0, 0.0, SPOOL_HEIGHT / 2),
            mesh=f"{name}.obj",
            compound=spool_shape(kind),
            **more,
        )

    spool("CirclePuzzle", "round", "teal", -0.5)
    model.body(
        "Occulus",
        (1.0, 0.0, 1.0),
        (0.0, -0.7, 0.0),
        mass=0.1,
        inertia=(0.01, 0.01, 0.01),
        mesh="viewer.obj",
        shape=(shape_box(0.03, 0.03, 0.03), (0, 0, 0), (0, 0, 0)),
        gravity={"x": 0.0, "y": 0.0, "z": 0.0},
        **{"collision groups": [1]},
    )
    model.body(
        "PegBase",
        (-1.5, -1.5, -1.0),
        mass=10.0,
        inertia=cylinder_inertia(10.0, DISC, POST_TOP),
        com=(0.0, 0.0, 0.1),
        mesh="peg_base.obj",
        compound=[
            placed(shape_round("CYLINDER", DISC, DISC_HEIGHT), (0.0, 0.0, 0.0015)),
            placed(shape_round("CYLINDER", POST, POST_TOP), (0.0, 0.0, POST_TOP / 2)),
        ],
        **more,
    )
    model.body(
        "PuzzleBase",
        (-1.0, 0.0, -1.0),
        mass=8.0,
        inertia=box_inertia(8.0, *BLOCK),
        com=(0.0, 0.0, 0.1),
        mesh="study_b_base.obj",
        compound=base_shape(),
        **more,
    )
    spool("SquarePuzzle", "square", "coral", 0.5)
    model.body(
        "Torus",
        (-1.5, -1.5, -0.5),
        mass=0.8,
        inertia=tube_inertia(0.8, RING + RING_ROD, RING - RING_ROD, 2 * RING_ROD),
        mesh="torus.obj",
        compound=ring_shape(),
        **more,
    )
    spool("TrianglePuzzle", "triangle", "sage", 0.0)
    for name, sign in (("HandleLeft", -1), ("HandleRight", 1)):
        model.joint(
            f"CenterPuzzle-{name}",
            "revolute",
            "CenterPuzzle",
            name,
            (1.0, sign * 0.85, -1.0),
            (1.0, 0.0, 0.0),
            limits=(-1.2, 1.2),
            controller={"P": 1300.0, "I": 0.0, "D": 2.6},
        )
    return model


def build(models):
    studies = models / "studies"
    studies.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "study_b")
    folder.add("plate.obj", plate_mesh())
    for name, sign in (("HandleLeft", -1), ("HandleRight", 1)):
        folder.add(f"{name}.obj", handle_mesh(sign))
    for name, kind, color in (
        ("CirclePuzzle", "round", "teal"),
        ("SquarePuzzle", "square", "coral"),
        ("TrianglePuzzle", "triangle", "sage"),
    ):
        folder.add(f"{name}.obj", spool_mesh(kind, color))
    folder.add("viewer.obj", mt.box(0.03, 0.03, 0.03, 0.006, color="graphite"))
    folder.add("peg_base.obj", peg_base_mesh())
    folder.add("study_b_base.obj", base_mesh())
    folder.add("torus.obj", mt.torus(RING, RING_ROD, 40, 16, "coral"))
    folder.add("study_b_table.obj", sh.table_mesh(TABLE))
    folder.close()
    puzzle1(folder).write(studies / "puzzle1.yaml")
    # So smooth that handles which hang down slide aside below the plate.
    title = "The table of study B; its top is at z = -1.08."
    sh.table(folder, title, "study_b_table.obj", TABLE_MIDDLE, TABLE_TOP, TABLE, 0.5).write(
        studies / "study_b_table.yaml"
    )
    view = View((4.6, -0.4, 1.9), (-0.35, -0.2, -0.95), 0.55)
    title = "A table with the scene of study B in view, from where the operator sits."
    world = sh.world(title, "study_b_table.yaml", (-0.3, -0.2, -0.9), 1.9, view)
    (studies / "study_b_world.yaml").write_text(world, encoding="utf-8")
    title = "Study B of the dissertation, ten times as large as life: -l 0, with its task -l 0,1."
    files = ("./puzzle1.yaml", "../descriptions/tasks/puzzle1.yaml")
    (studies / "launch_study_b.yaml").write_text(sh.launch(title, "study_b_world.yaml", files), encoding="utf-8")
