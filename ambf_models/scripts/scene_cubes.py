"""300 loose cubes of 5 cm on the floor: the load test for contacts and topics."""

import mesh_tools as mt
import outlines
from adf_writer import Model, box_inertia, shape_box
from mesh_folder import MeshFolder
from textures import hashed

SIDE, PITCH, MASS = 0.05, 0.08, 0.075  # m, m, kg (600 kg/m^3, wood)
ROWS, COLUMNS = 15, 20
COLORS = ("sky", "ivory", "sage", "amber", "teal", "sand", "coral", "slate", "plum")


def build(models):
    folder = MeshFolder(models, "cubes")
    folder.add("cube.obj", mt.extrude(outlines.rectangle(SIDE, SIDE, 0.004, 2), SIDE, 0.0038, 2, "stained"))
    folder.close()
    model = Model(
        "300 cubes of 5 cm and 75 g on a grid, resting on the floor, each with its own topics.",
        namespace="/ambf/env/cubes/",
        meshes=folder.seen_from(3),
    )
    for n in range(ROWS * COLUMNS):
        row, column = divmod(n, COLUMNS)
        model.body(
            f"cube_{n:03d}",
            ((row - (ROWS - 1) / 2) * PITCH, (column - (COLUMNS - 1) / 2) * PITCH, SIDE / 2),
            mass=MASS,
            inertia=box_inertia(MASS, SIDE, SIDE, SIDE),
            mesh="cube.obj",
            color=COLORS[int(hashed(row, column, 9)[0] * len(COLORS))],
            shape=(shape_box(SIDE, SIDE, SIDE), (0, 0, 0), (0, 0, 0)),
            friction=(0.6, 0.01),
        )
    model.write(models / "descriptions" / "multi-bodies" / "puzzles" / "cubes_300.yaml")
