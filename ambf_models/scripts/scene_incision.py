"""A block of tissue between two clamps, a scalpel that cuts it, a needle with its thread that closes the cut, and
forceps at the thread's end, all moved by commands. docs/tissue.md"""

import math

import mesh_tools as mt
import scene_suture_pad as sewing
from adf_writer import Model, color_components, placed, pose, shape_box
from mesh_folder import MeshFolder

BLOCK = (0.05, 0.03, 0.015)  # m
ELEMENT = 0.005
BOARD = (0.12, 0.10, 0.01)
EDGE = 0.024  # m, along y
BLADE = (0.0006, EDGE, 0.018)
HANDLE = (0.006, 0.010, 0.09)
CLAMP = (0.008, BLOCK[1] + 0.004, BLOCK[2] + 0.002)
SHARPNESS = 20.0  # N/m
NEEDLE_AT = (-0.035, 0.0, 0.060)
FORCEPS_AT = (-0.075, 0.0, 0.060)  # its tip: the end of the thread
THREAD_M = 0.300


def scalpel_mesh():
    blade = mt.box(*BLADE, 0.0001, 0.0002, "steel", 2).moved(z=BLADE[2] / 2)
    handle = mt.box(*HANDLE, 0.001, 0.002, "aluminium", 3).moved(z=BLADE[2] + HANDLE[2] / 2 - 0.002)
    return mt.joined([blade, handle])


def thread_points():
    """From the needle's rear down to the board, to and fro on it, and up to the forceps."""
    rear = tuple(a + b for a, b in zip(NEEDLE_AT, sewing.arc(math.pi), strict=True))
    low = BOARD[2] + 0.001
    points = [rear, (rear[0], 0.0, low)]
    left, x = THREAD_M - 2 * (rear[2] - low), rear[0]
    step = (rear[0] - FORCEPS_AT[0]) / 5
    reach = (left - 5 * step) / 10
    for k in range(5):
        y = reach if k % 2 == 0 else -reach
        points += [(x, y, low), (x - step, y, low)]
        x -= step
    points += [(FORCEPS_AT[0], 0.0, low), FORCEPS_AT]
    return points


def build(models):
    folder = MeshFolder(models, "incision")
    folder.add("board.obj", mt.box(*BOARD, 0.002, 0.004, "ivory", 3).moved(z=BOARD[2] / 2))
    folder.add("scalpel.obj", scalpel_mesh())
    folder.add("clamp.obj", mt.box(*CLAMP, 0.0005, 0.001, "aluminium", 3))
    folder.add("needle.obj", sewing.needle_mesh())
    folder.add("forceps.obj", sewing.forceps_mesh())
    folder.close()
    model = Model(
        "A block of tissue between two clamps, a scalpel, a needle with its thread, and forceps that hold the\n"
        "thread's end until a command says otherwise. Pose commands move them all: the scalpel's edge is the origin,\n"
        "along y; the needle's frame is in the middle of its circle, the tip at +x. The examples cut_tissue.py cuts,\n"
        "close_incision.py has the cut gape and closes it by five stitches. docs/tissue.md",
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
    for name, side in (("left", -1), ("right", 1)):
        model.body(
            name,
            (side * (BLOCK[0] + CLAMP[0]) / 2, 0.0, BOARD[2] + 0.0005 + CLAMP[2] / 2),
            mesh="clamp.obj",
            shape=(shape_box(*CLAMP), (0, 0, 0), (0, 0, 0)),
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
    sewing.add_needle(model, NEEDLE_AT, FORCEPS_AT, thread_points(), 0.0042)
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
            "young modulus": 1.5e4,
            "poisson ratio": 0.45,
            "density": 1060.0,
            "element size": ELEMENT,
            "friction": 0.5,
            "max nodes": 4000,
            "regions": [
                {
                    "box": {"x": 0.004, "y": BLOCK[1], "z": BLOCK[2]},
                    "location": pose((side * BLOCK[0] / 2, 0, 0)),
                    "attach to": f"BODY {name}",
                }
                for name, side in (("left", -1), ("right", 1))
            ],
        },
        **{"collision shape": "BOX", "collision geometry": size, "collision margin": 0.0005},
    )
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "incision.yaml")
