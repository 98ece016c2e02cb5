"""A flap of tissue that has grown to its bed along one edge, a bead in its free edge, and a gripper above: it holds the
nodes between its jaws (an actuator, docs/grasping.md) and turns the flap back. Its task judges where the bead is."""

import mesh_tools as mt
import scene_grippers
import scene_tissue
import touch_parts as parts
from adf_writer import Model, color_components, pose, shape_box, vector
from mesh_folder import MeshFolder

BED = (0.14, 0.12, 0.012)  # m
FLAP = (0.06, 0.05, 0.006)  # m; it has grown to the bed along its edge at -x
YOUNG, POISSON, DENSITY, ELEMENT = 1.0e4, 0.45, 1060.0, 0.006
MARGIN = 0.0005
FLAP_AT = (0.0, 0.0, BED[2] + FLAP[2] / 2 + MARGIN)
BEAD, BEAD_MASS = 0.003, 0.0005  # radius (m), kg: it sits on the free edge, out of the jaws' way
BEAD_AT = (FLAP[0] / 2 + 0.002, 0.0, FLAP_AT[2])
HELD = 0.25  # opening of the jaws below which they hold: they are open at 0.37 in environments
RAYS_AT, RANGE = -0.008, 0.016  # m below the pin: where rays begin; they end 4 mm below the jaws' tips
LIFTED, HOLD_S = 0.025, 0.2  # m of the bead above the bench, at least; s


def add_gripper(model):
    """That of the peg board, with rays between its jaws, and what holds the nodes that they meet."""
    scene_grippers.add_jaw_gripper(model, "right", (0.0, 0.0, 0.10))
    for name in ("right_gripper", "right_jaw_a", "right_jaw_b"):
        body = model.bodies[name]
        body["mesh"] = "../../peg_transfer/high_res/" + body["mesh"]
    starts = [(x, 0.0, RAYS_AT) for x in (-0.0015, 0.0, 0.0015)]
    model.add("sensors", "eyes", "right_gripper", type="Proximity", range=RANGE, array=parts.rays(starts, (0, 0, -1)))
    model.add(
        "actuators",
        "grip",
        "right_gripper",
        type="Constraint",
        sensor="SENSOR eyes",
        trigger={"jaw": "BODY right_gripper", "below": HELD},
        hardness=1000.0,
        damping=1.0,
    )


def add_flap(model):
    size = dict(zip("xyz", FLAP, strict=True))
    edge = {"x": 2 * ELEMENT, "y": FLAP[1], "z": FLAP[2]}
    model.add(
        "soft bodies",
        "flap",
        shape="BOX",
        geometry=size,
        **{"color components": color_components("liver")},
        location=pose(FLAP_AT),
        tissue={
            "kind": "solid",
            "young modulus": YOUNG,
            "poisson ratio": POISSON,
            "density": DENSITY,
            "element size": ELEMENT,
            "friction": 0.3,
            "regions": [
                {"box": edge, "location": pose((-FLAP[0] / 2, 0, 0)), "fixed": True},
                {"sphere": 0.006, "location": pose((FLAP[0] / 2, 0, 0)), "attach to": "BODY bead"},
            ],
        },
        **{"collision shape": "BOX", "collision geometry": size, "collision margin": MARGIN},
    )


def build(models):
    folder = MeshFolder(models, "tissue_retract")
    folder.add("bed.obj", mt.box(*BED, 0.002, 0.004, "ivory", 3).moved(z=BED[2] / 2))
    folder.add("bead.obj", scene_tissue.sphere(BEAD, 24, "teal"))
    folder.close()
    model = Model(
        "A flap of tissue on its bed, with a bead in its free edge, and a gripper that holds what is between its jaws\n"
        "when they close. The task: the bead is lifted (docs/learning.md).",
        namespace="/ambf/env/tissue_retract/",
        meshes=folder.seen_from(2),
    )
    model.body(
        "bed",
        mesh="bed.obj",
        shape=(shape_box(*BED), (0, 0, BED[2] / 2), (0, 0, 0)),
        friction=(0.6, 0.01),
    )
    model.body(
        "bead",
        BEAD_AT,
        mass=BEAD_MASS,
        inertia=3 * (0.4 * BEAD_MASS * BEAD * BEAD,),
        mesh="bead.obj",
        shape=({"shape": "SPHERE", "geometry": {"radius": BEAD}}, (0, 0, 0), (0, 0, 0)),
        friction=(0.3, 0.01),
        restitution=0.0,
        damping=(0.3, 0.5),
    )
    add_gripper(model)
    add_flap(model)
    top = 0.2
    lifted = {
        "name": "lifted",
        "piece": "BODY bead",
        "location": {"position": vector((0, 0, (LIFTED + top) / 2))},
        "position tolerance": {"x": 0.1, "y": 0.1, "z": (top - LIFTED) / 2},
        "hold": HOLD_S,
        "released": False,
    }
    model.add("tasks", "retract", holders=["BODY right_gripper"], goals=[lifted])
    model.write(models / "descriptions" / "tasks" / "tissue_retract.yaml")
