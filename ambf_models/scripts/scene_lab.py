"""The rooms that our worlds stand in: a laboratory with a floor at z = 0, and the same one around an oak bench whose
top is z = 0. The floor's grid has lines every 0.1 m, strong ones every metre."""

import mesh_tools as mt
import numpy as np
from adf_writer import Model, placed, shape_box, shape_ground
from mesh_folder import MeshFolder
from textures import STAVE_PERIOD, STAVE_WIDTH, STAVES, hashed

SIDE, HEIGHT = 10.0, 3.0  # m: of the room
# A thick box: nothing falls through it, and box against box has four contact points where a plane has one.
WALL = 0.2
TABLE = (1.5, 2.04, 0.04)  # x, y, thickness
TABLE_MIDDLE_X = -0.09  # there is more bench behind the middle than in front of it
TABLE_HEIGHT = 0.75
LOW_FLOOR = 1.65
SUNK_FLOOR = 0.475  # m


def quad(corners, uv, color):
    mesh = mt.Mesh(corners, [(0, 1, 2), (0, 2, 3)], color)
    mesh.uv = np.array(uv, dtype=float)[mesh.faces]
    return mesh


def floor_mesh():
    h = SIDE / 2
    corners = [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)]
    return quad(corners, [c[:2] for c in corners], "resin")


def walls_mesh():
    h = SIDE / 2
    parts = []
    ring = [(-h, h), (-h, -h), (h, -h), (h, h)]  # so that the walls look inwards
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1], strict=True):
        corners = [(ax, ay, 0), (ax, ay, HEIGHT), (bx, by, HEIGHT), (bx, by, 0)]
        parts.append(quad(corners, [(0, 0), (0, 1), (1, 1), (1, 0)], "paint"))
    for k in range(4):
        turn = mt.rotation_about("z", k * np.pi / 2)
        parts.append(mt.box(0.015, SIDE, 0.08, color="shell").moved(x=-h + 0.0075, z=0.04).turned(turn))
    # Windows in the left wall: bright panes between mullions.
    for k in range(4):
        x = -2.7 + 1.8 * k
        parts.append(mt.box(1.55, 0.03, 1.35, color="slate").moved(x, -h, 1.75))
        for side in (-1, 1):
            parts.append(mt.box(0.70, 0.05, 1.25, color="lamp").moved(x + side * 0.37, -h, 1.75))
    # A row of cupboards along the back wall with a worktop, shelves above.
    for k in range(7):
        y = -2.7 + 0.9 * k
        parts.append(mt.box(0.58, 0.885, 0.76, color="shell").moved(-h + 0.29, y, 0.48))
        parts.append(mt.box(0.02, 0.30, 0.012, color="graphite").moved(-h + 0.59, y, 0.78))
    parts.append(mt.box(0.50, 6.2, 0.10, color="graphite").moved(-h + 0.25, 0, 0.05))
    parts.append(mt.box(0.64, 6.36, 0.04, color="oak").moved(-h + 0.32, 0, 0.88))
    for k, y in enumerate((-2.0, 0.0, 2.0)):
        z = 1.55
        parts.append(mt.box(0.28, 1.7, 0.03, color="oak").moved(-h + 0.14, y, z))
        for n in range(6):  # what stands on it
            height = 0.14 + 0.16 * float(hashed(k, n, 5)[0])
            color = ("night", "slate", "shell", "teal", "sand")[int(5 * float(hashed(k, n, 6)[0]))]
            parts.append(
                mt.box(0.18, 0.11, height, color=color).moved(-h + 0.12, y - 0.6 + 0.24 * n, z + 0.016 + height / 2)
            )
    return mt.joined(parts)


def table_mesh():
    """Staves on a slab on a steel frame. Each stave is cut from another place of the picture."""
    x, y, z = TABLE
    bevel = 0.005
    slab = mt.box(x, y, z, bevel, 0.012, "oak").moved(z=-z / 2 - 0.0003)
    parts = [slab]
    count = round((x - 2 * bevel) / STAVE_WIDTH)
    width = (x - 2 * bevel) / count
    for row in range(count):
        low_x = -x / 2 + bevel + row * width
        at, piece = -y / 2 + bevel, 0
        while at < y / 2 - bevel - 1e-9:
            length = 0.42 + 0.5 * float(hashed(row, piece, 1)[0])
            end = at + length if at + length < y / 2 - bevel - 0.25 else y / 2 - bevel
            stave = int(STAVES * float(hashed(row, piece, 2)[0]))
            start = STAVE_PERIOD * float(hashed(row, piece, 3)[0])
            along = 1.0 if hashed(row, piece, 4)[0] < 0.5 else -1.0
            corners = [(low_x, at, 0), (low_x + width, at, 0), (low_x + width, end, 0), (low_x, end, 0)]
            v = [stave * STAVE_WIDTH, (stave + 1) * STAVE_WIDTH]
            u = [start, start + along * (end - at)]
            parts.append(quad(corners, [(u[0], v[0]), (u[0], v[1]), (u[1], v[1]), (u[1], v[0])], "oak"))
            at, piece = end, piece + 1
    leg = TABLE_HEIGHT - z
    for side_x in (-1, 1):
        parts.append(mt.box(0.05, y - 0.2, 0.06, 0.003, color="graphite").moved(side_x * (x / 2 - 0.09), 0, -z - 0.032))
        for side_y in (-1, 1):
            parts.append(
                mt.box(0.06, 0.06, leg, 0.004, color="graphite").moved(
                    side_x * (x / 2 - 0.09), side_y * (y / 2 - 0.1), -z - leg / 2
                )
            )
    return mt.joined(parts)


def add_room(model, z):
    model.body(
        "floor",
        (0, 0, z),
        mesh="floor.obj",
        shape=(shape_ground(), (0, 0, 0), (0, 0, 0)),
        friction=(0.8, 0.01),
        passive=True,
    )
    at = SIDE / 2 + WALL / 2
    long = SIDE + 2 * WALL
    model.body(
        "walls",
        (0, 0, z),
        mesh="walls.obj",
        compound=[placed(shape_box(WALL, long, HEIGHT), (side * at, 0, HEIGHT / 2)) for side in (-1, 1)]
        + [placed(shape_box(long, WALL, HEIGHT), (0, side * at, HEIGHT / 2)) for side in (-1, 1)],
        friction=(0.6, 0.01),
        passive=True,
    )


def build(models):
    folder = MeshFolder(models, "lab")
    folder.add("floor.obj", floor_mesh())
    folder.add("walls.obj", walls_mesh())
    folder.add("table.obj", table_mesh())
    folder.close()

    room = Model("A room of 10 m x 10 m, its floor at z = 0, with a grid of 0.1 m.", meshes=folder.seen_from(2))
    add_room(room, 0.0)
    room.write(models / "descriptions" / "world" / "lab_room.yaml")

    low = Model(
        f"A room of 10 m x 10 m, its floor {LOW_FLOOR} m below z = 0: for arms that reach below it.",
        meshes=folder.seen_from(2),
    )
    add_room(low, -LOW_FLOOR)
    low.write(models / "descriptions" / "world" / "lab_low_room.yaml")

    sunk = Model(
        f"A room of 10 m x 10 m, its floor {SUNK_FLOOR} m below z = 0: where the wheels of the PR2 stand.",
        meshes=folder.seen_from(2),
    )
    add_room(sunk, -SUNK_FLOOR)
    sunk.write(models / "descriptions" / "world" / "lab_sunk_room.yaml")

    bench = Model(
        f"An oak bench of {TABLE[1]} m x {TABLE[0]} m, its top at z = 0; the room's floor lies {TABLE_HEIGHT} m lower.",
        meshes=folder.seen_from(2),
    )
    x, y, z = TABLE
    leg = TABLE_HEIGHT - z
    bench.body(
        "table",
        (TABLE_MIDDLE_X, 0, 0),
        mesh="table.obj",
        friction=(0.8, 0.01),
        passive=True,
        compound=[placed(shape_box(x, y, z), (0, 0, -z / 2))]
        + [
            placed(shape_box(0.06, 0.06, leg), (sx * (x / 2 - 0.09), sy * (y / 2 - 0.1), -z - leg / 2))
            for sx in (-1, 1)
            for sy in (-1, 1)
        ],
    )
    add_room(bench, -TABLE_HEIGHT)
    bench.write(models / "descriptions" / "world" / "lab_bench.yaml")
