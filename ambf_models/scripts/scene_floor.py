"""Checkered floor: the environment of our worlds. Its top is z = 0, one check is 0.1 m."""

import numpy as np
from adf_writer import Model, shape_box
from mesh_folder import MeshFolder
from mesh_io import write_png
from mesh_tools import Mesh

SIDE = 10.0  # m
DEPTH = (
    0.5  # m; a thick box: nothing falls through it, and box against box has four contact points where a plane has one
)
CHECK = 0.1  # m
CHECKS_PER_PICTURE = 4
PIXELS_PER_CHECK = 64


def picture():
    n = CHECKS_PER_PICTURE * PIXELS_PER_CHECK
    row, column = np.mgrid[0:n, 0:n]
    dark = ((row // PIXELS_PER_CHECK + column // PIXELS_PER_CHECK) % 2).astype(bool)
    pixels = np.empty((n, n, 3), dtype=np.uint8)
    pixels[:] = (214, 218, 222)
    pixels[dark] = (190, 197, 204)
    joint = (row % PIXELS_PER_CHECK == 0) | (column % PIXELS_PER_CHECK == 0)
    pixels[joint] = (176, 183, 190)
    return pixels


def build(models):
    folder = MeshFolder(models, "floor")
    h = SIDE / 2
    quad = Mesh([(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [(0, 1, 2), (0, 2, 3)], "shell")
    repeats = SIDE / (CHECK * CHECKS_PER_PICTURE)
    corner = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * repeats
    folder.add("floor.obj", quad, texcoords=corner[quad.faces])
    write_png(folder.path / "high_res" / "checks.png", picture())
    folder.close(texture=("shell", "checks.png"))

    model = Model("Checkered floor, 10 m x 10 m, top at z = 0, checks of 0.1 m.", meshes=folder.seen_from(2))
    model.body(
        "floor",
        mesh="floor.obj",
        shape=(shape_box(SIDE, SIDE, DEPTH), (0, 0, -DEPTH / 2), (0, 0, 0)),
        friction=(0.8, 0.01),
        passive=True,
    )
    model.write(models / "descriptions" / "world" / "checkered_floor.yaml")
