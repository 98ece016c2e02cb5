"""Peg transfer after the FLS task: a board with 12 pegs, six soft-looking objects on the left pegs, two small
grippers above.

Sizes are real: board 150 x 100 x 20 mm, pegs 4.5 mm thick and 25 mm high, objects of a few grams with holes of 11 and
12 mm, so that a jaw fits between peg and wall. The published task has no drawing; peg places are ours (2 x 3 on the
left, a hexagon on the right). The operator stands at +x and looks along -x: left is -y.
"""

import itertools
import math

import mesh_tools as mt
import numpy as np
import outlines
import scene_grippers
import touch_parts
from adf_writer import Model, placed, shape_box, shape_round, tube_inertia, vector
from lettering import Canvas
from mesh_folder import MeshFolder

MAT = (0.20, 0.27, 0.006)
BOARD = (0.100, 0.150, 0.020)
BOARD_TOP = MAT[2] + BOARD[2]
PEG_RADIUS, PEG_HEIGHT = 0.00225, 0.025
LEFT_PEGS = [(x, y) for x in (-0.030, 0.0, 0.030) for y in (-0.058, -0.030)]
RIGHT_PEGS = [(-0.030, 0.031), (-0.030, 0.057), (0.0, 0.026), (0.0, 0.062), (0.030, 0.031), (0.030, 0.057)]

RUBBER = 1200.0  # kg/m^3
RING_RADIUS, RING_TUBE, RING_PARTS = 0.009, 0.003, 10
TRIANGLE_INRADIUS, TRIANGLE_CORNER, TRIANGLE_HEIGHT, HOLE_RADIUS = 0.008, 0.003, 0.015, 0.0055
OBJECTS = [
    ("triangle", "coral"),
    ("ring", "amber"),
    ("ring", "teal"),
    ("triangle", "sky"),
    ("triangle", "sage"),
    ("ring", "plum"),
]


# Each goal has the key of a kind of object; it and an object on it see each other: the peg's rays look outwards, near
# the board, and those of the object's hole inwards.
SENSED_HEIGHT, SENSED_AROUND, HELD_S = 0.003, 0.010, 0.5
RAYS = 6  # a peg cannot stand between those of a hole

# Prints are seen by the operator: right is +y, up is -x.
INK, PALE, TEAL, MAT_COLOR = (52, 62, 72), (196, 212, 220), (34, 122, 128), (44, 58, 68)


def mat_print():
    width, height = MAT[1], MAT[0]
    canvas = Canvas(width, height, 4000, MAT_COLOR)
    for k in range(-12, 13):
        strong = k % 5 == 0
        canvas.paint(np.abs(canvas.x - 0.01 * k) - 0.00012, PALE, 0.30 if strong else 0.12)
        if abs(k) < 10:
            canvas.paint(np.abs(canvas.y - 0.01 * k) - 0.00012, PALE, 0.30 if strong else 0.12)
    margin = 0.0095
    frame = np.abs(canvas.box(0, 0, width - 2 * margin, height - 2 * margin, 0.012)) - 0.0002
    canvas.paint(
        np.maximum(canvas.box(0, 0, width, height), -canvas.box(0, 0, width - 2 * margin, height - 2 * margin, 0.012)),
        MAT_COLOR,
    )
    canvas.paint(frame, PALE, 0.75)
    for k in range(-120, 121):  # millimetres along the near edge
        length = 0.0042 if k % 10 == 0 else 0.003 if k % 5 == 0 else 0.0018
        y = -height / 2 + margin
        canvas.stroke([(0.001 * k, y), (0.001 * k, y + length)], 0.0002, PALE, 0.8)
    for k in range(-12, 13, 2):
        canvas.text(str(abs(k)), 0.01 * k, -height / 2 + margin + 0.0072, 0.0030, PALE, 0.85)
    canvas.text("cm", 0.1265, -height / 2 + margin + 0.0072, 0.0030, PALE, 0.85)
    canvas.glow(canvas.box(0, 0, BOARD[1], BOARD[0], 0.010), 0.012, (8, 14, 22), 0.7)
    return canvas


def board_print():
    width, height = BOARD[1], BOARD[0]
    ivory = (235, 231, 221)
    canvas = Canvas(width, height, 3200, ivory)
    canvas.paint(np.abs(canvas.box(0, 0, width - 0.012, height - 0.012, 0.006)) - 0.0002, INK, 0.45)
    canvas.stroke([(0.0, -0.028), (0.0, 0.034)], 0.0006, INK, 0.45)
    for places, first in ((LEFT_PEGS, 1), (RIGHT_PEGS, 7)):
        for k, (x, y) in enumerate(places):
            at = (y, -x)
            canvas.paint(np.abs(canvas.disc(*at, 0.0108)) - 0.0003, TEAL, 0.85)
            # Away from the neighbour: pegs of a row on the right are close to each other.
            beside = 0.0122 if places is LEFT_PEGS or y < 0.05 and k % 2 else -0.0122
            canvas.text(str(first + k), at[0] + beside, at[1] - 0.0078, 0.0040, INK, 0.9)
            if places is RIGHT_PEGS:
                sign_of(canvas, OBJECTS[k][0], at[0] + beside, at[1])
            canvas.glow(canvas.disc(*at, PEG_FOOT), 0.0035, (70, 66, 60), 0.55)
    for word, x, y in (("START", -0.044, 0.0405), ("GOAL", 0.044, 0.0405)):
        canvas.text(word, x, y, 0.0040, INK, 0.95)
    canvas.text("PEG", 0.0, -0.0340, 0.0030, INK, 0.95)
    canvas.text("TRANSFER", 0.0, -0.0388, 0.0030, INK, 0.95)
    return canvas


def sign_of(canvas, kind, x, y):
    """What belongs on a peg."""
    if kind == "ring":
        canvas.paint(np.abs(canvas.disc(x, y, 0.0019)) - 0.00045, INK, 0.9)
        return
    corners = [(x + 0.0024 * math.sin(a), y + 0.0024 * math.cos(a)) for a in (0.0, 2 * math.pi / 3, 4 * math.pi / 3)]
    for a, b in itertools.pairwise([*corners, corners[0]]):
        canvas.stroke([a, b], 0.0008, INK, 0.9)


PEG_FOOT = 0.0048


def board_mesh():
    """A white plate screwed on an aluminium one."""
    x, y, z = BOARD
    lower, corner = 0.006, 0.010
    top = mt.extrude(outlines.rectangle(x, y, corner, 7), z - lower, 0.0016, 3, "ivory").moved(z=-(z - lower) / 2)
    top = top.printed("board_print", y, x)
    base = mt.extrude(outlines.rectangle(x - 0.0012, y - 0.0012, corner, 7), lower, 0.0008, 2, "graphite")
    parts = [top, base.moved(z=-z + lower / 2)]
    screw = mt.lathe(
        mt.rounded_profile(
            [(0, -0.001), (0.0022, -0.001), (0.0022, 0.0006), (0.0012, 0.0006), (0.0012, 0.0001), (0, 0.0001)],
            [0, 0, 0.0004, 0.0001, 0, 0],
            2,
        ),
        20,
        "steel",
    )
    slot = mt.cylinder(0.00122, 0.0002, 0.0, 6, "graphite").moved(z=0.00008)
    for side_x in (-1, 1):
        for side_y in (-1, 1):
            parts.append((screw + slot).moved(side_x * (x / 2 - 0.0105), side_y * (y / 2 - 0.0105)))
    return mt.joined(parts)


def pegs_mesh():
    """Turned steel with a round head and a flange that is filleted into the pin."""
    corners = [
        (0, -0.004),
        (PEG_FOOT, -0.004),
        (PEG_FOOT, 0.0009),
        (PEG_RADIUS, 0.0009),
        (PEG_RADIUS, PEG_HEIGHT - PEG_RADIUS),
    ]
    profile = mt.rounded_profile(corners, [0, 0, 0.0004, 0.0011, 0], 3)
    for k in range(1, 6):
        a = 0.5 * math.pi * k / 5
        profile.append((PEG_RADIUS * math.cos(a) if k < 5 else 0.0, PEG_HEIGHT - PEG_RADIUS + PEG_RADIUS * math.sin(a)))
    peg = mt.lathe(profile, 20, "steel")
    return mt.joined([peg.moved(x, y) for x, y in LEFT_PEGS + RIGHT_PEGS])


def triangle_outline():
    far = 2 * TRIANGLE_INRADIUS
    corners = [(far * math.cos(a), far * math.sin(a)) for a in (math.radians(90 + 120 * k) for k in range(3))]
    return outlines.rounded_outline(corners, TRIANGLE_CORNER, 5)


def triangle_mesh():
    outline = triangle_outline()
    angles = [math.atan2(p[1], p[0]) for p in outline]
    steps = []
    for i, a in enumerate(angles):  # fill the long straight sides so that the hole comes out round
        b = angles[(i + 1) % len(angles)]
        span = (b - a) % (2 * math.pi)
        pieces = max(1, round(span / math.radians(12)))
        steps += [a + span * k / pieces for k in range(pieces)]
    outer = outlines.ray_outline(outline, steps)
    inner = [(HOLE_RADIUS * math.cos(a), HOLE_RADIUS * math.sin(a)) for a in steps]
    return mt.extrude_ring(outer, np.array(inner), TRIANGLE_HEIGHT, 0.0012, 3, "rubber")


def triangle_shape():
    """Three walls between the tangent points of the rounded corners, and the corners themselves as upright
    cylinders."""
    wall = TRIANGLE_INRADIUS - HOLE_RADIUS
    length = 2 * (TRIANGLE_INRADIUS - TRIANGLE_CORNER) * math.tan(math.radians(60))
    parts = []
    for k in range(3):
        a = math.radians(90 + 60 + 120 * k)
        d = TRIANGLE_INRADIUS - wall / 2
        parts.append(placed(shape_box(wall, length, TRIANGLE_HEIGHT), (d * math.cos(a), d * math.sin(a), 0), (0, 0, a)))
        a = math.radians(90 + 120 * k)
        d = 2 * (TRIANGLE_INRADIUS - TRIANGLE_CORNER)
        parts.append(
            placed(shape_round("CYLINDER", TRIANGLE_CORNER, TRIANGLE_HEIGHT), (d * math.cos(a), d * math.sin(a), 0))
        )
    return parts


def ring_shape():
    """Capsules end to end around the ring; their corners a little outside, their middles a little inside its centre
    line."""
    corner = 2 * RING_RADIUS / (1 + math.cos(math.pi / RING_PARTS))
    length = 2 * corner * math.sin(math.pi / RING_PARTS)
    middle = corner * math.cos(math.pi / RING_PARTS)
    parts = []
    for k in range(RING_PARTS):
        a = 2 * math.pi * k / RING_PARTS
        parts.append(
            placed(
                shape_round("CAPSULE", RING_TUBE, length + 2 * RING_TUBE, "x"),
                (middle * math.cos(a), middle * math.sin(a), 0),
                (0, 0, a + math.pi / 2),
            )
        )
    return parts


def add_object(model, name, kind, color, position):
    rubber = {"friction": (0.9, 0.01), "restitution": 0.05, "damping": (0.05, 0.1), "collision margin": 0.0002}
    if kind == "ring":
        mass = RUBBER * 2 * math.pi**2 * RING_RADIUS * RING_TUBE**2
        across = mass * (RING_RADIUS**2 / 2 + 5 * RING_TUBE**2 / 8)
        inertia = (across, across, mass * (RING_RADIUS**2 + 3 * RING_TUBE**2 / 4))
        model.body(
            name,
            (*position, BOARD_TOP + RING_TUBE),
            mass=mass,
            inertia=inertia,
            mesh="ring.obj",
            color=color,
            compound=ring_shape(),
            **rubber,
        )
    else:
        sides = 3 * math.sqrt(3) * TRIANGLE_INRADIUS**2
        corners = (3 * math.sqrt(3) - math.pi) * TRIANGLE_CORNER**2
        area = sides - corners
        mass = RUBBER * TRIANGLE_HEIGHT * (area - math.pi * HOLE_RADIUS**2)
        model.body(
            name,
            (*position, BOARD_TOP + TRIANGLE_HEIGHT / 2),
            mass=mass,
            mesh="triangle.obj",
            color=color,
            inertia=tube_inertia(mass, math.sqrt(area / math.pi), HOLE_RADIUS, TRIANGLE_HEIGHT),
            compound=triangle_shape(),
            **rubber,
        )


def add_tasks(model):
    """Sensors `goal7` to `goal12` of the right pegs and `hole1` to `hole6` of the objects."""
    for k, ((x, y), (kind, _)) in enumerate(zip(RIGHT_PEGS, OBJECTS, strict=True)):
        outwards = [
            {"offset": vector((x, y, SENSED_HEIGHT)), "direction": vector(way)}
            for way in touch_parts.circle_of(RAYS, 1.0)
        ]
        model.add(
            "sensors",
            f"goal{k + 7}",
            "pegs",
            type="Proximity",
            range=SENSED_AROUND,
            hold=HELD_S,
            **{"matching key": kind, "success when": "matched"},
            array=outwards,
        )
    for k, (kind, _) in enumerate(OBJECTS):
        radius = HOLE_RADIUS if kind == "triangle" else RING_RADIUS - RING_TUBE
        inwards = [
            {"offset": vector((radius * x, radius * y, 0)), "direction": vector((-x, -y, 0))}
            for x, y, _ in touch_parts.circle_of(RAYS, 1.0)
        ]
        model.add(
            "sensors",
            f"hole{k + 1}",
            f"{kind}{k + 1}",
            type="Proximity",
            range=radius,
            **{"matching key": kind},
            array=inwards,
        )


def make(folder, title):
    """The board and its objects, without grippers; meshes are in `folder`."""
    model = Model(title, meshes=folder.seen_from(3))
    still = {"passive": True, "collision margin": 0.0002}
    model.body(
        "mat", mesh="mat.obj", shape=(shape_box(*MAT), (0, 0, MAT[2] / 2), (0, 0, 0)), friction=(0.9, 0.01), **still
    )
    model.body(
        "peg_board",
        (0, 0, BOARD_TOP),
        mesh="board.obj",
        friction=(0.7, 0.01),
        shape=(shape_box(*BOARD), (0, 0, -BOARD[2] / 2), (0, 0, 0)),
        **{"collision margin": 0.0002},
    )
    sunk = 0.005
    model.body(
        "pegs",
        (0, 0, BOARD_TOP),
        mesh="pegs.obj",
        friction=(0.3, 0.01),
        **still,
        compound=[
            placed(shape_round("CAPSULE", PEG_RADIUS, PEG_HEIGHT + sunk), (x, y, (PEG_HEIGHT - sunk) / 2))
            for x, y in LEFT_PEGS + RIGHT_PEGS
        ],
    )
    for k, ((kind, color), place) in enumerate(zip(OBJECTS, LEFT_PEGS, strict=True)):
        add_object(model, f"{kind}{k + 1}", kind, color, place)
    add_tasks(model)
    return model


def build(models):
    folder = MeshFolder(models, "peg_transfer")
    folder.print("mat_print", mat_print())
    folder.print("board_print", board_print())
    mat = mt.extrude(outlines.rectangle(MAT[0], MAT[1], 0.02, 8), MAT[2], 0.002, 3, "night").moved(z=MAT[2] / 2)
    folder.add("mat.obj", mat.printed("mat_print", MAT[1], MAT[0]))
    folder.add("board.obj", board_mesh())
    folder.add("pegs.obj", pegs_mesh())
    folder.add("triangle.obj", triangle_mesh())
    folder.add("ring.obj", mt.torus(RING_RADIUS, RING_TUBE, 40, 16, "rubber"))
    scene_grippers.add_jaw_gripper_meshes(folder)
    folder.close()

    model = make(
        folder,
        "Peg transfer: board, 12 pegs, six objects, two floating grippers. Move the objects to the right pegs\n"
        "and back. Frames: board and pegs have theirs in the middle of the board's top, a gripper in the pin\n"
        "of its jaws.",
    )
    scene_grippers.add_jaw_gripper(model, "left", (0.0, -0.044, 0.095))
    scene_grippers.add_jaw_gripper(model, "right", (0.0, 0.044, 0.095))
    model.write(models / "descriptions" / "multi-bodies" / "puzzles" / "peg_transfer.yaml")
