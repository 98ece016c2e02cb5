"""A gallbladder on the liver under its peritoneum, with a pad of fat at its neck: solids and a sheet that touch.
Forceps retract it, a hook cuts the membrane that holds it down. Sizes are those of life. docs/tissue.md"""

import math

import mesh_tools as mt
import scene_tissue
import touch_parts as parts
from adf_writer import Model, color_components, placed, pose, shape_box, vector
from mesh_folder import MeshFolder
from scene_peritoneum import ALONE, RANGE, WET, Vessels, ellipsoid, forceps_mesh

BOARD = (0.20, 0.16, 0.010)  # m
LIVER, ROUND, HOLLOW = (0.150, 0.115, 0.044), 0.018, -0.003  # the lobe that it lies on; of its upper side
LIVER_SIZE = 0.030
TOP = BOARD[2] + LIVER[2]
# The gallbladder along x, from its neck to its fundus: 7 cm long, 3 cm thick.
NECK, FUNDUS, THICK = -0.034, 0.036, 0.0145
GALL_SIZE = 0.013
OUT = 0.0012  # m, by which what touches is thicker than what is drawn: its facets stay outside
GALL_Z = TOP + HOLLOW + THICK + OUT
FAT = (0.014, 0.012, 0.007)  # half lengths
FAT_AT = (-0.050, 0.0, TOP + HOLLOW + FAT[2])
# Of healthy liver, fat, and a gallbladder with its bile, which gives way more than its wall of 85 kPa does; peritoneum.
LIVER_TISSUE = {"young modulus": 5.0e3, "poisson ratio": 0.45, "density": 1060.0}
FAT_TISSUE = {"young modulus": 2.0e3, "poisson ratio": 0.47, "density": 950.0}
GALL_TISSUE = {"young modulus": 1.5e4, "poisson ratio": 0.45, "density": 1020.0}
MEMBRANE_TISSUE = {"young modulus": 2.0e5, "poisson ratio": 0.45, "density": 1060.0, "thickness": 0.0005}
SPAN, RIM = (0.058, 0.084), 0.036  # m, of the membrane along x and y; half of the way between its rims
MEMBRANE_X = -0.004  # its middle
CELL = 0.0065
MARGIN = 0.0005
SHARPNESS = 10.0  # N/m
FORCEPS_AT = (0.030, 0.0, TOP + 0.060)
HOOK_AT = (0.050, 0.022, TOP + 0.050)
EDGE = 0.024  # m, upright


def gall_radius(share):
    """Of the way from the neck to the fundus, both of which are round."""
    body = 0.42 + 0.58 * math.sin(0.5 * math.pi * min(1.0, share / 0.62)) ** 2
    ends = math.sqrt(max(0.0, 1.0 - max(0.0, (share - 0.72) / 0.28) ** 2))
    start = math.sqrt(max(0.0, 1.0 - max(0.0, (0.08 - share) / 0.08) ** 2))
    return THICK * body * ends * start


def gall_mesh(rings, sides, out=0.0):
    """A body of revolution about x."""
    shares = [0.5 - 0.5 * math.cos(math.pi * k / rings) for k in range(rings + 1)]
    profile = [(gall_radius(s) + out, NECK + (FUNDUS - NECK) * s) for s in shares]
    profile[0], profile[-1] = (0.0, NECK - out), (0.0, FUNDUS + out)
    return mt.lathe(profile, sides, "sage").along("x")


def membrane_mesh():
    """Draped over the gallbladder, from rim to rim; the last row of triangles lies on the liver."""
    nx, ny = round(SPAN[0] / CELL), 2 * round(SPAN[1] / 2 / CELL)
    crest = 2 * (THICK + OUT) + HOLLOW + 0.001

    def height(y):
        away = min(1.0, abs(y) / (RIM - 0.004))
        return crest * 0.5 * (1.0 + math.cos(math.pi * away**1.5))

    vertices, faces = [], []
    for i in range(nx + 1):
        for j in range(ny + 1):
            x, y = SPAN[0] * (i / nx - 0.5), SPAN[1] * (j / ny - 0.5)
            vertices.append((x, y, 0.0))
    for i in range(nx):
        for j in range(ny):
            a, b = i * (ny + 1) + j, (i + 1) * (ny + 1) + j
            faces += [(a, b, b + 1), (a, b + 1, a + 1)] if (i + j) % 2 else [(a, b, a + 1), (b, b + 1, a + 1)]
    flat = mt.Mesh(vertices, faces).printed("vessels", SPAN[0], SPAN[1], right=(1, 0, 0), up=(0, 1, 0))
    flat.vertices[:, 2] = [height(y) for _, y, _ in flat.vertices]
    return flat


def hook_mesh():
    """A thin hook that points down, its tip at the origin; its edge looks along -x."""
    shaft = mt.cylinder(0.0022, 0.09, 0.0004, 20, "night").moved(z=EDGE + 0.045)
    blade = mt.box(0.0022, 0.0008, EDGE, 0.0002, 0.0003, "steel", 2).moved(z=EDGE / 2)
    return mt.joined([shaft, blade])


def solid(model, name, at, tissue, size, regions):
    model.add(
        "soft bodies",
        name,
        mesh=f"{name}.obj",
        **{"color components": color_components({"fat": "amber", "gallbladder": "sage"}.get(name, "liver"))},
        location=pose(at),
        tissue={
            "kind": "solid",
            **tissue,
            "element size": size,
            "friction": 0.5,
            "touches": "others",
            "regions": regions,
        },
        **{"collision mesh": f"../low_res/{name}.obj", "collision margin": MARGIN},
    )


def add_membrane(model):
    rim = [
        {
            "box": vector((SPAN[0] + 0.01, SPAN[1] / 2 - RIM, 0.05)),
            "location": pose((0, side * (SPAN[1] / 2 + RIM) / 2, 0.01)),
            "fixed": True,
        }
        for side in (-1, 1)
    ]
    model.add(
        "soft bodies",
        "membrane",
        mesh="membrane.obj",
        **{"color components": {**color_components("skin"), **WET}},
        location=pose((MEMBRANE_X, 0, TOP - 0.0005)),
        tissue={
            "kind": "sheet",
            **MEMBRANE_TISSUE,
            "friction": 0.4,
            "touches": "others",
            "max nodes": 600,
            "regions": rim,
        },
        **{"collision mesh": "../high_res/membrane.obj", "collision margin": MARGIN},
    )


def add_instruments(model):
    model.body(
        "forceps",
        FORCEPS_AT,
        mesh="forceps.obj",
        shape=(shape_box(0.006, 0.004, 0.056), (0, 0, 0.032), (0, 0, 0)),
        **ALONE,
    )
    starts = [(x, y, 0.001) for x in (-0.003, 0.0, 0.003) for y in (-0.004, 0.0, 0.004)]
    model.add("sensors", "eyes", "forceps", type="Proximity", range=RANGE, array=parts.rays(starts, (0, 0, -1)))
    model.add("actuators", "grip", "forceps", type="Constraint", sensor="SENSOR eyes", hardness=400.0, damping=0.4)
    model.body(
        "hook",
        HOOK_AT,
        mesh="hook.obj",
        compound=[
            placed(shape_box(0.004, 0.004, 0.09), (0, 0, EDGE + 0.045)),
            placed(shape_box(0.0022, 0.0008, EDGE), (0, 0, EDGE / 2)),
        ],
        **ALONE,
    )
    model.add(
        "actuators",
        "edge",
        "hook",
        type="Blade",
        edge=[{"x": 0.0, "y": 0.0, "z": z} for z in (0.0, EDGE)],
        sharpness=SHARPNESS,
        trigger="contact",
    )


def build(models):
    folder = MeshFolder(models, "gallbladder")
    folder.print("vessels", Vessels())
    folder.add("board.obj", mt.box(*BOARD, 0.002, 0.004, "ivory", 3).moved(z=BOARD[2] / 2))
    folder.add("liver.obj", scene_tissue.rounded_block(LIVER, ROUND, 0.005, "liver", HOLLOW))
    folder.add("liver.obj", scene_tissue.rounded_block(LIVER, ROUND, 0.018, "liver", HOLLOW), "low_res")
    folder.add("gallbladder.obj", gall_mesh(24, 32))
    folder.add("gallbladder.obj", gall_mesh(10, 12, OUT), "low_res")
    folder.add("fat.obj", ellipsoid(FAT, 24, "amber"))
    folder.add("fat.obj", ellipsoid(FAT, 10, "amber"), "low_res")
    folder.add("membrane.obj", membrane_mesh())
    folder.add("forceps.obj", forceps_mesh())
    folder.add("hook.obj", hook_mesh())
    folder.close()
    model = Model(
        "A gallbladder on a lobe of liver, held down by its peritoneum, with fat at its neck; forceps that hold what\n"
        "their rays meet, and a hook whose edge cuts the membrane; pose commands move both.\n"
        "ambf_client_py/examples/free_gallbladder.py retracts, cuts and lifts. docs/tissue.md",
        namespace="/ambf/env/gallbladder/",
        meshes=folder.seen_from(3),
        low_resolution=True,
    )
    model.body(
        "board",
        mesh="board.obj",
        shape=(shape_box(*BOARD), (0, 0, BOARD[2] / 2), (0, 0, 0)),
        friction=(0.5, 0.01),
    )
    below = [{"box": vector((0.2, 0.2, 0.016)), "location": pose((0, 0, -LIVER[2] / 2)), "fixed": True}]
    solid(model, "liver", (0, 0, BOARD[2] + LIVER[2] / 2), LIVER_TISSUE, LIVER_SIZE, below)
    neck = [{"box": vector((0.012, 0.04, 0.04)), "location": pose((NECK, 0, 0)), "fixed": True}]
    solid(model, "gallbladder", (0, 0, GALL_Z), GALL_TISSUE, GALL_SIZE, neck)
    stalk = [{"box": vector((0.02, 0.02, 0.006)), "location": pose((0, 0, -FAT[2])), "fixed": True}]
    solid(model, "fat", FAT_AT, FAT_TISSUE, 0.010, stalk)
    add_membrane(model)
    add_instruments(model)
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "gallbladder.yaml")
