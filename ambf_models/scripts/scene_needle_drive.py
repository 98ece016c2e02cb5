"""A pad of soft tissue with three pairs of marks and a half-circle needle before it, for a PSM that is loaded first
(multi-bodies/robots/psm.yaml): its jaws hold the needle, by an actuator, and drive it from a red mark to a teal one.
The task says which pairs are done (docs/learning.md)."""

import math

import mesh_tools as mt
import scene_suture_pad
import scene_tissue
from adf_writer import Model, color_components, placed, pose, shape_box, shape_round, vector
from mesh_folder import MeshFolder

# World: the PSM's remote centre is at (0.5, 0.5141, -0.7). Its shaft comes down to the pad along -x; the jaws lie along
# -x, level, so that a turn about x drives the needle: along +y, from the entries to the exits.
TOP = (0.4, 0.5141, -0.785)  # m, the middle of the pad's upper side
PAD = (0.024, 0.024, 0.008)
STAND = (0.05, 0.05, 0.02)
YOUNG, POISSON, DENSITY, ELEMENT, MARGIN = 4.0e4, 0.45, 1070.0, 0.004, 0.0002
RADIUS, THICKNESS, MASS = scene_suture_pad.RADIUS, 0.0004, 0.001
PUNCTURE_N, FRICTION, STRENGTH_N = 0.02, 2.0, 5.0
ABOVE = 0.0055  # m, of the needle's middle above the pad while it is driven
SIDE = math.sqrt(RADIUS**2 - ABOVE**2)  # of marks beside the middle
PAIRS = (-0.005, 0.0, 0.005)  # m, along x
TOLERANCE, HOLD_S = 0.0015, 0.2
PARKED = (TOP[0] - 0.06, TOP[1], TOP[2] + 0.06)
JAW, CLOSED = 0.0065, 0.48  # m along the jaws to where they hold; share of their range below which they do
GROUP = 21  # of what the needle touches: nothing but the stand, for jaws that hold it by an actuator do not press


def needle_mesh():
    points = [(RADIUS * math.cos(a), 0.0, RADIUS * math.sin(a)) for a in (math.pi * k / 24 for k in range(25))]
    return mt.ngon_tube(points, THICKNESS, 8, "brass")


def needle_shape(parts=8):
    step = math.pi / parts
    chord, inside = 2 * RADIUS * math.sin(step / 2), RADIUS * math.cos(step / 2)
    capsule = shape_round("CAPSULE", THICKNESS, chord + 2 * THICKNESS)
    angles = [(k + 0.5) * step for k in range(parts)]
    return [placed(capsule, (inside * math.cos(a), 0.0, inside * math.sin(a)), (0.0, -a, 0.0)) for a in angles]


def marks_mesh():
    dots = []
    for x in PAIRS:
        for side, color in ((-1, "coral"), (1, "teal")):
            dots.append(scene_tissue.sphere(0.0006, 12, color).moved(x, side * SIDE, 0.0))
    return mt.joined(dots)


def add_pad(model):
    size = dict(zip("xyz", PAD, strict=True))
    below = {"x": PAD[0] + 0.002, "y": PAD[1] + 0.002, "z": 0.002}
    model.add(
        "soft bodies",
        "pad",
        shape="BOX",
        geometry=size,
        **{"color components": color_components("skin")},
        location=pose((TOP[0], TOP[1], TOP[2] - PAD[2] / 2)),
        tissue={
            "kind": "solid",
            "young modulus": YOUNG,
            "poisson ratio": POISSON,
            "density": DENSITY,
            "element size": ELEMENT,
            "friction": 0.3,
            "regions": [{"box": below, "location": pose((0, 0, -PAD[2] / 2)), "fixed": True}],
        },
        **{"collision shape": "BOX", "collision geometry": size, "collision margin": MARGIN},
    )


def add_needle(model):
    ring = MASS * RADIUS**2
    model.body(
        "needle",
        PARKED,
        mass=MASS,
        com=(0.0, 0.0, 2 * RADIUS / math.pi),
        inertia=(0.5 * ring, ring, 0.5 * ring),
        mesh="needle.obj",
        compound=needle_shape(),
        friction=(1.0, 0.01),
        restitution=0.0,
        damping=(0.3, 0.3),
        **{
            "controller": dict.fromkeys(("linear", "angular"), {"P": 30.0, "I": 0.0, "D": 0.0}),
            "controller output type": "VELOCITY",
            "collision groups": [GROUP],
        },
    )
    places = [(RADIUS, 0, 0), (0, 0, RADIUS), (-RADIUS, 0, 0)]
    model.add(
        "actuators",
        "stitch",
        "needle",
        type="Needle",
        arc=[vector(each) for each in places],
        **{"puncture force": PUNCTURE_N, "friction": FRICTION, "strength": STRENGTH_N},
    )


def add_grip(model):
    """It holds the needle while the jaws are closed: what rays meet that cross the wire beside them."""
    jaw, wrist = "/ambf/env/psm/BODY tool gripper1 link", "/ambf/env/psm/BODY tool pitch link"
    rays = [{"offset": vector((-0.004, JAW, z)), "direction": vector((1, 0, 0))} for z in (-0.003, 0.003)]
    model.add("sensors", "between", type="Proximity", range=0.008, array=rays)
    trigger = {"jaw": wrist, "below": CLOSED}
    model.add("actuators", "grip", type="Constraint", sensor="SENSOR between", trigger=trigger)
    model.others["sensors"]["between"]["parent"] = model.others["actuators"]["grip"]["parent"] = jaw  # of another file


def add_task(model):
    goals = []
    for number, x in enumerate(PAIRS):
        for side, way in ((-1, "in"), (1, "out")):
            at = {"position": vector((x, side * SIDE, PAD[2] / 2))}
            goals.append(
                {
                    "name": f"{way} {number}",
                    "piece": "BODY needle",
                    "puncture": way,
                    "place": "SOFT pad",
                    "location": at,
                    "position tolerance": TOLERANCE,
                    "hold": HOLD_S,
                    "held by": "/ambf/env/psm/BODY tool pitch link",
                }
            )
    model.add("tasks", "drive", holders=["/ambf/env/psm/BODY tool pitch link"], goals=goals)


def build(models):
    folder = MeshFolder(models, "needle_drive")
    folder.add("stand.obj", mt.box(*STAND, 0.002, 0.004, "ivory", 3))
    folder.add("needle.obj", needle_mesh())
    folder.add("marks.obj", marks_mesh())
    folder.close()
    model = Model(
        "A pad of soft tissue with pairs of marks, and a needle that the jaws of a PSM hold, which is loaded first.\n"
        "The task: it goes in at a red mark and comes out at the teal one beside it (docs/learning.md).",
        namespace="/ambf/env/needle_drive/",
        meshes=folder.seen_from(2),
    )
    model.body(
        "stand",
        (TOP[0], TOP[1], TOP[2] - PAD[2] - STAND[2] / 2 - MARGIN),
        mesh="stand.obj",
        shape=(shape_box(*STAND), (0, 0, 0), (0, 0, 0)),
        friction=(0.6, 0.01),
        **{"collision groups": [0, GROUP]},
    )
    untouched = {"shape": "SPHERE", "geometry": {"radius": 0.0005}}
    model.body("marks", TOP, mesh="marks.obj", shape=(untouched, (0, 0, 0), (0, 0, 0)), **{"collision groups": [20]})
    add_needle(model)
    add_grip(model)
    add_pad(model)
    add_task(model)
    model.write(models / "descriptions" / "tasks" / "needle_drive.yaml")
