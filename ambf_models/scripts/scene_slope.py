"""A slope of 20 degrees with two boxes of 0.5 kg, both without Bullet's friction: one stands on resistive rays (the
dissertation's Fig. 6.10), the other one slides away. And the same box on a level board, to be pushed: it sticks, and
slips by a millimetre at a time (Fig. 6.7)."""

import math

import mesh_tools as mt
import touch_parts as parts
from adf_writer import Model, box_inertia, placed, shape_box
from lettering import Canvas
from mesh_folder import MeshFolder

ANGLE = math.radians(20.0)
BOARD = (0.46, 0.24, 0.018)  # along the slope, across, thick
LEVEL = (0.20, 0.60, 0.018)
BOX = (0.10, 0.07, 0.03)
MASS = 0.5  # kg
LANES = {"sensorized": -0.06, "bare": 0.06}  # y
START = -0.13  # along the slope, of both
RANGE = 0.002  # of the rays: short ones are stiff, and it hardly tilts
CLEAR = 0.0003  # below the box, at rest
STOP = 0.012  # the bar at the slope's foot
# friction static and dynamic, contact stiffness and damping, contact area
FIG_6_10 = (5000.0, 0.1, 1.0, 50.0, 0.001)
FIG_6_7 = (1000.0, 5.0, 1.0, 50.0, 0.001)  # much friction while it slides: it creeps instead of shooting off
COLUMNS, ROWS = 4, 4
GRAVITY = 9.81
PALE = (206, 190, 160)
INK = (58, 50, 42)


def board_print(width, height, marks):
    """Wood-coloured, with a scale in centimetres along `marks`: "x" or "y" of the picture."""
    canvas = Canvas(width, height, 2400, PALE)
    length = width if marks == "x" else height
    for k in range(int(-length / 2 * 1000) // 5 + 2, int(length / 2 * 1000) // 5 - 1):
        at = 0.005 * k
        tick = 0.010 if k % 10 == 0 else 0.007 if k % 2 == 0 else 0.004
        if marks == "x":
            canvas.stroke([(at, -height / 2 + 0.006), (at, -height / 2 + 0.006 + tick)], 0.0004, INK, 0.8)
        else:
            canvas.stroke([(-width / 2 + 0.006, at), (-width / 2 + 0.006 + tick, at)], 0.0004, INK, 0.8)
        if k % 10 == 0:
            place = (at, -height / 2 + 0.024) if marks == "x" else (-width / 2 + 0.024, at)
            canvas.text(str(abs(k // 2)), *place, 0.008, INK, 0.8)
    return canvas


def box_mesh(color):
    body = mt.box(*BOX, 0.003, 0.006, color, 3)
    band = mt.box(BOX[0] + 0.0004, BOX[1] + 0.0004, 0.006, 0.0008, 0.0062, "graphite", 3).moved(z=-BOX[2] / 2 + 0.010)
    return body + band


def slope_mesh():
    """Frame on the bench, below the middle of the board's top."""
    x, y, z = BOARD
    board = mt.box(x, y, z, 0.001, 0.004, "sand", 2).printed("slope_print", y, x).moved(z=-z / 2)
    bar = mt.box(0.012, y, STOP + 0.004, 0.001, 0.002, "rubber").moved(x=x / 2 - 0.006, z=STOP / 2 - 0.002)
    tilt = mt.rotation_about("y", ANGLE)
    leaning = (board + bar).turned(tilt).moved(z=HEIGHT)
    pieces = [leaning]
    for s in (-1, 1):
        tall = HEIGHT + math.sin(ANGLE) * 0.19 - 0.03
        pieces.append(mt.box(0.018, 0.018, tall, 0.001, 0.003, "aluminium").moved(-0.19, s * 0.09, tall / 2))
    return mt.joined(pieces)


HEIGHT = math.sin(ANGLE) * BOARD[0] / 2 + BOARD[2]  # of the middle of the slope's top


def on_slope(x, y, above):
    """World place of a point `above` the slope."""
    c, s = math.cos(ANGLE), math.sin(ANGLE)
    return (c * x + s * above, y, HEIGHT - s * x + c * above)


def feet(numbers, weight):
    """Rays at the box's underside, which at rest stands CLEAR above the board."""
    depth = weight / (COLUMNS * ROWS * numbers[2])
    inside = RANGE * (1.0 - depth) - CLEAR
    starts = [
        (x, y, -BOX[2] / 2 + inside)
        for x in parts.spread(BOX[0] - 0.016, COLUMNS)
        for y in parts.spread(BOX[1] - 0.016, ROWS)
    ]
    return parts.resistance(numbers, RANGE, parts.rays(starts, (0, 0, -1)))


def add_box(model, name, place, turn, mesh):
    model.body(
        name,
        place,
        turn,
        mass=MASS,
        inertia=box_inertia(MASS, *BOX),
        mesh=mesh,
        shape=(shape_box(*BOX), (0, 0, 0), (0, 0, 0)),
        friction=(0.0, 0.0),
        restitution=0.0,
        damping=(0.0, 0.0),
        **{"collision margin": 0.0002},
    )


def build_slope(models):
    folder = MeshFolder(models, "slope")
    folder.print("slope_print", board_print(BOARD[1], BOARD[0], "y"))
    folder.add("slope.obj", slope_mesh())
    for name, color in (("sensorized", "sky"), ("bare", "coral")):
        folder.add(f"{name}.obj", box_mesh(color))
    folder.close()
    model = Model(
        "A slope of 20 degrees without friction. `sensorized` stands on 16 resistive rays (Fig. 6.10 of the\n"
        "dissertation), `bare` slides away.",
        namespace="/ambf/env/slope/",
        meshes=folder.seen_from(3),
    )
    x, y, z = BOARD
    tall = HEIGHT + math.sin(ANGLE) * 0.19 - 0.03
    model.body(
        "slope",
        mesh="slope.obj",
        compound=[
            placed(shape_box(x, y, z), on_slope(0, 0, -z / 2), (0, ANGLE, 0)),
            placed(shape_box(0.012, y, STOP), on_slope(x / 2 - 0.006, 0, STOP / 2), (0, ANGLE, 0)),
            *(placed(shape_box(0.018, 0.018, tall), (-0.19, s * 0.09, tall / 2)) for s in (-1, 1)),
        ],
        friction=(0.0, 0.0),
        **{"collision margin": 0.0002},
    )
    for name, lane in LANES.items():
        above = BOX[2] / 2 + (CLEAR if name == "sensorized" else 0.0)
        add_box(model, name, on_slope(START, lane, above), (0, ANGLE, 0), f"{name}.obj")
    model.add("sensors", "feet", "sensorized", **feet(FIG_6_10, MASS * GRAVITY * math.cos(ANGLE)))
    model.write(models / "descriptions" / "multi-bodies" / "touch" / "slope.yaml")


def build_stick_slip(models):
    folder = MeshFolder(models, "stick_slip")
    folder.print("level_print", board_print(LEVEL[1], LEVEL[0], "x"))
    board = mt.box(*LEVEL, 0.001, 0.004, "sand", 2).printed("level_print", LEVEL[1], LEVEL[0])
    folder.add("board.obj", board.moved(z=LEVEL[2] / 2))
    folder.add("block.obj", box_mesh("sky"))
    folder.close()
    model = Model(
        "A block on 16 resistive rays on a level board without friction (Fig. 6.7 of the dissertation). A push that\n"
        "grows slowly moves it from 4.9 N on, in slips of 1 mm; a sudden one from half of that.",
        namespace="/ambf/env/stick_slip/",
        meshes=folder.seen_from(3),
    )
    model.body(
        "board",
        mesh="board.obj",
        shape=(shape_box(*LEVEL), (0, 0, LEVEL[2] / 2), (0, 0, 0)),
        friction=(0.0, 0.0),
        **{"collision margin": 0.0002},
    )
    add_box(model, "block", (0, -0.20, LEVEL[2] + BOX[2] / 2 + CLEAR), (0, 0, math.pi / 2), "block.obj")
    model.add("sensors", "feet", "block", **feet(FIG_6_7, MASS * GRAVITY))
    model.write(models / "descriptions" / "multi-bodies" / "touch" / "stick_slip.yaml")


def build(models):
    build_slope(models)
    build_stick_slip(models)
