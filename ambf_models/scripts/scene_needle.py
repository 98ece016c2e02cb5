"""A curved needle on the mat of the peg board, and its tasks: pick it up, hand it over. Loaded after
multi-bodies/puzzles/peg_transfer.yaml, whose grippers do it; friction alone holds it."""

import math

import mesh_tools as mt
from adf_writer import Model, placed, shape_round, vector
from mesh_folder import MeshFolder

RADIUS, THICKNESS = 0.012, 0.0006  # m, of the arc, and of the wire
HALF = math.radians(70)  # of the arc
PARTS = 12
MASS = 0.002
MAT = 0.006  # m, its upper side
AT = (0.0, 0.0, MAT + THICKNESS + 0.0004)


def point(share):
    """From -1 (its base) to 1 (its tip); the frame is at 0, x towards the tip, the arc's middle at -y."""
    angle = HALF * share
    return (RADIUS * math.sin(angle), RADIUS * (math.cos(angle) - 1.0), 0.0)


def mesh():
    points = [point(k / 10 - 1.0) for k in range(21)]
    return mt.ngon_tube(points, THICKNESS, 8, "brass")


def shape():
    shapes = []
    for k in range(PARTS):
        (ax, ay, _), (bx, by, _) = point(2 * k / PARTS - 1), point(2 * (k + 1) / PARTS - 1)
        length = math.hypot(bx - ax, by - ay) + 2 * THICKNESS
        turn = (0.0, 0.0, math.atan2(by - ay, bx - ax))
        shapes.append(placed(shape_round("CAPSULE", THICKNESS, length, "x"), ((ax + bx) / 2, (ay + by) / 2, 0.0), turn))
    return shapes


def add_tasks(model):
    lifted = {"position": vector((0.0, 0.0, 0.08))}
    tolerance = {"x": 0.1, "y": 0.1, "z": 0.06}
    hands = ["BODY left_gripper", "BODY right_gripper"]
    common = {"piece": "BODY needle", "location": lifted, "position tolerance": tolerance, "hold": 0.2}
    held = {**common, "held by": "BODY right_gripper"}
    model.add("tasks", "needle_pick", holders=hands[1:], goals=[{"name": "lifted", **held}])
    model.add("tasks", "needle_regrasp", holders=hands, goals=[{"name": "handed over", **held, "hand over": True}])


def build(models):
    folder = MeshFolder(models, "needle")
    folder.add("needle.obj", mesh())
    folder.close()
    model = Model(
        "A curved needle on the mat of the peg board, which is loaded first, and tasks of learning\n"
        "(docs/learning.md): the right gripper lifts it, or gets it from the left one in the air.",
        namespace="/ambf/env/",
        meshes=folder.seen_from(2),
    )
    middle = RADIUS * (math.sin(HALF) / HALF - 1.0)
    ring = MASS * RADIUS**2
    model.body(
        "needle",
        AT,
        mass=MASS,
        com=(0.0, middle, 0.0),
        inertia=(0.5 * ring, 0.5 * ring, ring),
        mesh="needle.obj",
        compound=shape(),
        friction=(1.5, 0.01),
        restitution=0.0,
        damping=(0.3, 0.3),
        **{
            "controller": dict.fromkeys(("linear", "angular"), {"P": 30.0, "I": 0.0, "D": 0.0}),
            "controller output type": "VELOCITY",
            "collision margin": 0.0002,
        },
    )
    add_tasks(model)
    model.write(models / "descriptions" / "tasks" / "needle_board.yaml")
