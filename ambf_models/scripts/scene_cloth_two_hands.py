"""Two hands on a gantry above a cloth of 30 x 30 nodes that lies flat, or above a sheet of tissue: each comes down on a
corner, closes its jaw, holds the nodes below its rays and lifts them. docs/soft_bodies.md, docs/tissue.md"""

import mesh_tools as mt
import scene_cloth
import touch_parts as parts
from adf_writer import Model, placed, pose, shape_box
from mesh_folder import MeshFolder

SIDE, COUNT, MASS, MARGIN = 0.20, 30, 0.04, 0.0015  # of the cloth: m, nodes along it, kg, m
PLACES = {"left_hand": -0.092, "right_hand": 0.092}  # y, m
HEIGHT = 0.20  # of the palms' undersides as loaded
PLATE = (0.44, 0.52)
PLATE_AT = -0.08  # x of its middle
CLOTH_AT = (-0.09, 0.0)  # its edge towards the operator is under the hands
BEAM = (0.05, 0.48, 0.04)
BEAM_HEIGHT = 0.39
COLUMN = 0.03
LOW, HIGH = -0.1095, 0.10  # of the lifts; at the low end fingers end 2 mm above the cloth
CONFIG = {"kLST": 0.5, "kDP": 0.03, "kDF": 0.6, "piterations": 4}
COARSE = 15  # nodes along the sheet of tissue, which the drawn mesh follows
TISSUE = {"kind": "sheet", "young modulus": 1.0e5, "poisson ratio": 0.4, "density": 1060.0, "thickness": 0.0005}
RAYS_AT, RANGE = -0.055, 0.030  # m below the palm: where rays begin; how long they are


def stand_mesh():
    pieces = [parts.base_plate(*PLATE).moved(x=PLATE_AT)]
    for y in (-0.22, 0.22):
        height = BEAM_HEIGHT - 0.012
        pieces.append(mt.box(COLUMN, COLUMN, height, 0.001, 0.004, "aluminium").moved(y=y, z=0.012 + height / 2))
    pieces.append(mt.box(*BEAM, 0.002, 0.006, "aluminium", 3).moved(z=BEAM_HEIGHT))
    for y in PLACES.values():
        pieces.append(parts.bearing(0.0092, 0.06).moved(y=y, z=BEAM_HEIGHT))
    return mt.joined(pieces)


def build(models):
    folder = MeshFolder(models, "cloth_two_hands")
    folder.print("check", scene_cloth.Check())
    folder.add("cloth.obj", scene_cloth.cloth_mesh(SIDE, COUNT))
    folder.add("cloth_coarse.obj", scene_cloth.sheet_mesh(SIDE, COARSE), "low_res")
    folder.add("stand.obj", stand_mesh())
    folder.close()
    at = pose((*CLOTH_AT, 0.012 + MARGIN), (0, 0, 0))
    of_links = {"mass": MASS, "location": at, "config": CONFIG}
    write(models, folder, "cloth_two_hands", "a cloth", "docs/soft_bodies.md", of_links)
    of_tissue = {"collision mesh": "cloth_coarse.obj", "location": at, "tissue": TISSUE}
    write(models, folder, "cloth_two_hands_tissue", "a sheet of tissue", "docs/tissue.md", of_tissue)


def write(models, folder, file, above, page, cloth):
    model = Model(
        f"Two hands above {above}. Joints: NAME-lift (m, up), NAME-a and NAME-b (0 closed, 0.04 m open). A hand whose\n"
        f"jaw is less open than 0.4 holds the nodes of `cloth` that its rays meet. {page}",
        namespace=f"/ambf/env/{file}/",
        meshes=folder.seen_from(3),
        low_resolution="tissue" in cloth,
    )
    height = BEAM_HEIGHT - 0.012
    model.body(
        "stand",
        mesh="stand.obj",
        compound=[
            placed(shape_box(*PLATE, 0.012), (PLATE_AT, 0, 0.006)),
            *(placed(shape_box(COLUMN, COLUMN, height), (0, y, 0.012 + height / 2)) for y in (-0.22, 0.22)),
            placed(shape_box(*BEAM), (0, 0, BEAM_HEIGHT)),
        ],
        friction=(0.5, 0.01),
        **{"publish children names": True},
    )
    for name, y in PLACES.items():
        at = (0.0, y, HEIGHT)
        parts.add_hand(model, name, at, (0, 0, 0), 0.03, None, RANGE)
        model.joint(
            f"{name}-lift",
            "prismatic",
            "stand",
            name,
            at,
            (0, 0, 1),
            limits=(LOW, HIGH),
            damping=1.0,
            **parts.holding_motor(10.0, 0.02),
        )
        starts = [(x, 0.0, RAYS_AT) for x in (-0.006, 0.0, 0.006)]
        eyes = f"{name}_eyes"
        model.add("sensors", eyes, name, type="Proximity", range=RANGE, array=parts.rays(starts, (0, 0, -1)))
        model.add(
            "actuators",
            f"{name}_grip",
            name,
            type="Constraint",
            sensor=f"SENSOR {eyes}",
            trigger={"jaw": f"BODY {name}", "below": 0.4},
            hardness=3000.0,
            damping=2.0,
        )
    model.add(
        "soft bodies",
        "cloth",
        mesh="cloth.obj",
        **cloth,
        **{"collision margin": MARGIN},
    )
    model.write(models / "descriptions" / "multi-bodies" / "soft" / f"{file}.yaml")
