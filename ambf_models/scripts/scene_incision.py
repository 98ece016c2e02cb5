"""A block of tissue on a board and a scalpel that is moved by commands and cuts it. docs/tissue.md"""

import mesh_tools as mt
from adf_writer import Model, color_components, placed, pose, shape_box
from mesh_folder import MeshFolder

BLOCK = (0.05, 0.03, 0.015)  # m
ELEMENT = 0.005
BOARD = (0.12, 0.10, 0.01)
EDGE = 0.024  # m, along y
BLADE = (0.0006, EDGE, 0.018)
HANDLE = (0.006, 0.010, 0.09)
SHARPNESS = 20.0  # N/m


def scalpel_mesh():
    blade = mt.box(*BLADE, 0.0001, 0.0002, "steel", 2).moved(z=BLADE[2] / 2)
    handle = mt.box(*HANDLE, 0.001, 0.002, "aluminium", 3).moved(z=BLADE[2] + HANDLE[2] / 2 - 0.002)
    return mt.joined([blade, handle])


def build(models):
    folder = MeshFolder(models, "incision")
    folder.add("board.obj", mt.box(*BOARD, 0.002, 0.004, "ivory", 3).moved(z=BOARD[2] / 2))
    folder.add("scalpel.obj", scalpel_mesh())
    folder.close()
    model = Model(
        "A block of tissue on a board, and a scalpel that pose commands move: its edge is the origin, along y.\n"
        "ambf_client_py/examples/cut_tissue.py cuts. docs/tissue.md",
        namespace="/ambf/env/incision/",
        meshes=folder.seen_from(3),
    )
    model.body(
        "board",
        mesh="board.obj",
        shape=(shape_box(*BOARD), (0, 0, BOARD[2] / 2), (0, 0, 0)),
        friction=(0.6, 0.01),
    )
    model.body(
        "scalpel",
        (0.0, -0.008, BOARD[2] + BLOCK[2] + 0.015),
        mesh="scalpel.obj",
        compound=[
            placed(shape_box(*BLADE), (0, 0, BLADE[2] / 2)),
            placed(shape_box(*HANDLE), (0, 0, BLADE[2] + HANDLE[2] / 2 - 0.002)),
        ],
    )
    model.add(
        "actuators",
        "edge",
        "scalpel",
        type="Blade",
        edge=[{"x": 0.0, "y": y, "z": 0.0} for y in (-EDGE / 2, EDGE / 2)],
        sharpness=SHARPNESS,
        trigger="contact",
    )
    size = dict(zip("xyz", BLOCK, strict=True))
    model.add(
        "soft bodies",
        "block",
        shape="BOX",
        geometry=size,
        **{"color components": color_components("liver")},
        location=pose((0, 0, BOARD[2] + BLOCK[2] / 2)),
        tissue={
            "kind": "solid",
            "young modulus": 2.0e4,
            "poisson ratio": 0.45,
            "density": 1060.0,
            "element size": ELEMENT,
            "friction": 0.5,
            "max nodes": 4000,
            "regions": [
                {
                    "box": {"x": 0.004, "y": BLOCK[1], "z": BLOCK[2]},
                    "location": pose((side * BLOCK[0] / 2, 0, 0)),
                    "fixed": True,
                }
                for side in (-1, 1)
            ],
        },
        **{"collision shape": "BOX", "collision geometry": size, "collision margin": 0.0005},
    )
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "incision.yaml")
