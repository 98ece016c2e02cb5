"""The boards of two studies of the dissertation, ten times as large as life, as their files have them: puzzle4, hollow
triangles that are carried from peg to peg (§7.1), and puzzle5, numbered ones (study A, Fig. 7.5a).

Names, places, masses and what collides are those of the original's files, so that scripts and scalings of devices for
them fit; the meshes are ours.
"""

import itertools
import math

import mesh_tools as mt
import outlines
import shaped_holes as sh
from adf_writer import Model, box_inertia, cylinder_inertia, placed, shape_box, shape_round, tube_inertia
from lettering import length_of, strokes
from mesh_folder import MeshFolder
from scene_worlds import View

NAMESPACE = "/ambf/icl/"
FILES = ("puzzle4", "puzzle5")
BASE, BASE_PLACE = (1.30, 2.06, 0.40), (0.004, 0.160, -1.302)
TABLE, TABLE_TOP = (2.6, 3.4, 0.08), BASE_PLACE[2] - BASE[2] / 2
GRID = ((-0.321, 0.038), (0.329, -0.580), (0.004, -0.580), (-0.321, -0.580), (0.329, 0.038), (0.004, 0.038))
HEXAGON = ((0.274, 0.380), (-0.266, 1.060), (0.274, 1.060), (-0.517, 0.720), (0.526, 0.720), (-0.266, 0.380))
PEG_RADIUS = 0.025
WALL_FAR, WALL, WALL_LENGTH, HEIGHT = 0.075, 0.035, 0.300, 0.200  # of a triangle: three walls about its middle
PIECE_MASS, DIGIT_MASS, TEXT_MASS = 0.3, 0.05, 0.5
DIGIT_HEIGHT, DIGIT_DEPTH, TEXT_HEIGHT, TEXT_LENGTH = 0.138, 0.010, 0.116, 1.036
TEXT_MIDDLE = 0.067  # along its line, from its frame
# Of each number: where the walls look that its three plates are on (deg), and how high their frames are.
DIGITS = {
    1: ((-60, 180, 60), 0.106),
    2: ((180, -60, 60), 0.124),
    3: ((180, -60, 60), 0.098),
    4: ((180, -60, 60), 0.093),
    5: ((60, -60, 180), 0.065),
    6: ((180, -60, 60), 0.088),
}
NAMES = ("One", "Two", "Three", "Four", "Five", "Six")
STILL = {"friction": (0.5, 0.01), "restitution": 0.0, "damping": (0.04, 0.1), "collision margin": 0.001}


def letters(words, height, depth, thickness=0.2, color="ivory"):
    """Words as a solid of round strokes, upright in x-y, their middle in the origin."""
    unit, radius = height * (1.0 - thickness) / 6.0, 0.5 * thickness * height
    parts = []
    for line in strokes(words):
        places = [((x - length_of(words) / 2) * unit, (y - 3.0) * unit) for x, y in line]
        for (ax, ay), (bx, by) in itertools.pairwise(places):
            bar = mt.extrude(outlines.stadium(math.hypot(bx - ax, by - ay), radius, 5), depth, 0.0, 1, color)
            parts.append(bar.turned(mt.rotation_about("z", math.atan2(by - ay, bx - ax))).moved(ax, ay))
    return mt.joined(parts)


def triangle_mesh():
    """Its middle in the origin, from z = 0 upwards; a corner looks along +x."""
    inner = WALL_FAR - WALL / 2
    corners = [(math.cos(a), math.sin(a)) for a in (math.radians(120 * k) for k in range(3))]
    outer = outlines.rounded_outline([(2 * (inner + WALL) * x, 2 * (inner + WALL) * y) for x, y in corners], 0.02, 6)
    hole = outlines.rounded_outline([(2 * inner * x, 2 * inner * y) for x, y in corners], 0.012, 6)
    return mt.extrude_ring(outer, hole, HEIGHT, 0.008, 3, "shell").moved(z=HEIGHT / 2)


def triangle_shape():
    walls = []
    for degrees in (60, 180, 300):
        a = math.radians(degrees)
        place = (WALL_FAR * math.cos(a), WALL_FAR * math.sin(a), HEIGHT / 2)
        walls.append(placed(shape_box(WALL, WALL_LENGTH, HEIGHT), place, (0.0, 0.0, a)))
    return walls


def peg_mesh(height):
    """Round at its upper end, as the capsule that collides."""
    top = height / 2 - PEG_RADIUS
    profile = [(0.0, -height / 2), (PEG_RADIUS, -height / 2), (PEG_RADIUS, top)]
    for k in range(1, 8):
        a = 0.5 * math.pi * k / 7
        profile.append((PEG_RADIUS * math.cos(a) if k < 7 else 0.0, top + PEG_RADIUS * math.sin(a)))
    return mt.lathe(profile, 28, "aluminium")


def fixed(model, parent, child):
    point = model.bodies[child]["location"]["position"]
    model.joint(f"{parent}-{child}", "fixed", parent, child, tuple(point.values()), (0, 0, 1))


def board(model, peg, peg_height):
    """The base and its twelve pegs."""
    model.body(
        "Base",
        BASE_PLACE,
        mass=50.0,
        inertia=box_inertia(50.0, *BASE),
        mesh="base.obj",
        shape=(shape_box(*BASE), (0, 0, 0), (0, 0, 0)),
        **STILL,
        **{"publish joint names": True, "publish joint positions": True, "collision groups": [0]},
    )
    middle = BASE_PLACE[2] + BASE[2] / 2 + peg_height / 2
    for k, (x, y) in enumerate(GRID + HEXAGON):
        model.body(
            f"Cylinder_{k:03}" if k else "Cylinder",
            (x, y, middle),
            mass=1.0,
            inertia=cylinder_inertia(1.0, PEG_RADIUS, peg_height),
            mesh=peg,
            shape=(shape_round("CAPSULE", PEG_RADIUS, peg_height), (0, 0, 0), (0, 0, 0)),
            **STILL,
            **{"collision groups": [0]},
        )


def piece(model, name, color, place):
    model.body(
        name,
        place,
        mass=PIECE_MASS,
        inertia=tube_inertia(PIECE_MASS, WALL_FAR + WALL, WALL_FAR, HEIGHT),
        com=(0.0, 0.0, HEIGHT / 2),
        mesh="triangle.obj",
        color=color,
        compound=triangle_shape(),
        **STILL,
        **{"collision groups": [0]},
    )


def plate(model, name, mesh, size, mass, place, yaw, middle):
    """A flat thing that stands upright and looks along (sin yaw, -cos yaw); `middle`: of it in its own x and y."""
    model.body(
        name,
        place,
        (math.pi / 2, 0.0, yaw),
        mass=mass,
        inertia=box_inertia(mass, *size),
        mesh=mesh,
        com=(*middle, 0.0),
        shape=(shape_box(*size), (*middle, 0.0), (0, 0, 0)),
        **STILL,
        **{"collision groups": [0]},
    )


def digits(model, parent, number, place):
    """A number on each wall of a triangle."""
    size = ((0.020 if number == 1 else 0.088), DIGIT_HEIGHT, DIGIT_DEPTH)
    ways, high = DIGITS[number]
    for k, degrees in enumerate(ways, 1):
        a = math.radians(degrees)
        far = WALL_FAR + WALL / 2 + DIGIT_DEPTH / 2
        at = (place[0] + far * math.cos(a), place[1] + far * math.sin(a), place[2] + high)
        name = f"{NAMES[number - 1]}{k}"
        middle = (0.0, HEIGHT / 2 - high)
        plate(model, name, f"digit_{number}.obj", size, DIGIT_MASS, at, a + math.pi / 2, middle)
        yield parent, name


def puzzle4(folder):
    model = Model(
        "Hollow triangles on pegs, ten times as large as life: the yellow one goes from peg A to B, C and back\n"
        "(dissertation, Fig. 7.1). Names and places as in the original's file; frames: middle of the base, of\n"
        "each peg, and of each triangle's lower side.",
        NAMESPACE,
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    board(model, "peg_long.obj", 0.419)
    spots = {1: 3, 2: 5, 3: 2, 4: 0, 5: 1}
    for number, spot in spots.items():
        piece(model, f"PuzzleRed{number}", "coral", (*GRID[spot], -0.597))
    piece(model, "PuzzleYellow", "amber", (*HEXAGON[0], -0.597))
    for name in list(model.bodies)[1:13]:
        fixed(model, "Base", name)
    return model


def puzzle5(folder):
    model = Model(
        "Numbered triangles on pegs, ten times as large as life: study A of two people who share a task\n"
        "(dissertation, Fig. 7.5a: the pieces 1 and 6 are moved). Names and places as in the original's file;\n"
        "frames: middle of the base, of each peg and plate, and of each triangle's lower side.",
        NAMESPACE,
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    board(model, "peg_short.obj", 0.227)
    pegs = {name: model.bodies.pop(name) for name in list(model.bodies)[1:]}
    size = (TEXT_LENGTH, TEXT_HEIGHT, DIGIT_DEPTH)
    for k, side in ((1, 1), (2, -1)):
        x = BASE_PLACE[0] + side * (BASE[0] / 2 + DIGIT_DEPTH / 2)
        place = (x, BASE_PLACE[1] - side * TEXT_MIDDLE, -1.310)
        plate(model, f"AMBF_Text{k}", "text.obj", size, TEXT_MASS, place, side * math.pi / 2, (TEXT_MIDDLE, 0.0))
    model.bodies.update(pegs)
    ties = [("Base", name) for name in list(model.bodies)[1:]]
    spots = {5: GRID[0], 4: GRID[4], 1: GRID[1], 2: GRID[2], 3: GRID[3], 6: HEXAGON[4]}
    for number, (x, y) in spots.items():
        name = "PuzzleYellow" if number == 6 else f"PuzzleRed{number}"
        place = (x, y, -0.893 if number == 6 else -0.894)
        piece(model, name, "amber" if number == 6 else "coral", place)
        ties += digits(model, name, number, place)
    for parent, child in ties:
        fixed(model, parent, child)
    return model


def build(models):
    studies = models / "studies"
    studies.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "puzzles")
    folder.add("base.obj", mt.extrude(outlines.rectangle(BASE[0], BASE[1], 0.05, 8), BASE[2], 0.02, 4, "night"))
    folder.add("peg_long.obj", peg_mesh(0.419))
    folder.add("peg_short.obj", peg_mesh(0.227))
    folder.add("triangle.obj", triangle_mesh())
    for number, (_, high) in DIGITS.items():
        mesh = letters(str(number), DIGIT_HEIGHT, DIGIT_DEPTH)
        if number == 1:  # a bar, as what collides
            mesh = mt.extrude(outlines.rectangle(0.020, DIGIT_HEIGHT, 0.006, 4), DIGIT_DEPTH, 0.0015, 1, "ivory")
        folder.add(f"digit_{number}.obj", mesh.moved(y=HEIGHT / 2 - high))
    folder.add("text.obj", letters("AMBF STUDY A", TEXT_HEIGHT, DIGIT_DEPTH).moved(x=TEXT_MIDDLE))
    folder.add("table.obj", sh.table_mesh(TABLE))
    folder.close()
    puzzle4(folder).write(studies / "puzzle4.yaml")
    puzzle5(folder).write(studies / "puzzle5.yaml")
    title = "The table of the studies' boards; its top is at z = -1.502."
    sh.table(folder, title, "table.obj", (0.0, BASE_PLACE[1]), TABLE_TOP, TABLE, 0.8).write(studies / "table.yaml")
    view = View((3.1, 0.16, 1.15), (0.05, 0.16, -1.02), 0.55)
    title = "A table with one of the studies' boards in view, from where the operator sits."
    world = sh.world(title, "table.yaml", (0.0, 0.16, -1.0), 1.4, view)
    (studies / "world.yaml").write_text(world, encoding="utf-8")
    title = "The boards of the dissertation's studies, ten times as large as life; one at a time: -l 0 or -l 1."
    launch = sh.launch(title, "world.yaml", [f"./{name}.yaml" for name in FILES])
    (studies / "launch.yaml").write_text(launch, encoding="utf-8")
