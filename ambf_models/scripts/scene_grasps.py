"""Grasps by resistive sensors: two hands on a gantry, each with 2 x 25 rays (Table 6.2, object grasp). One holds a rod
of 0.4 kg away from its middle, the other a hammer of 0.8 kg that is two collision shapes. Bullet's friction is 0: rays
hold alone."""

import mesh_tools as mt
import touch_parts as parts
from adf_writer import Model, box_inertia, combined_inertia, cylinder_inertia, placed, shape_box, shape_round
from mesh_folder import MeshFolder

PLACES = {"left_hand": -0.11, "right_hand": 0.11}  # y, m
HEIGHT = 0.22  # of the palms' undersides
PAD = HEIGHT - 0.71 * 0.075  # of the middle of the rays
BEAM = (0.05, 0.56, 0.04)
BEAM_HEIGHT = 0.40
COLUMN = 0.03
RANGE = 0.010  # of the rays
GAP = 0.0015  # from a finger to what it holds, at the start

ROD = (0.020, 0.16, 0.4)  # radius, length, kg; along x
ROD_OFF = 0.015  # of its middle from the grip
HANDLE = (0.150, 0.036, 0.034)
HEAD = (0.021, 0.080)  # radius, length; along y
HAMMER = (0.3, 0.5)  # kg: handle, head
GRIP = 0.008  # of the hammer's grip from its centre of mass, towards the end of the handle


def stand_mesh():
    pieces = [parts.base_plate(0.30, 0.60)]
    for y in (-0.26, 0.26):
        height = BEAM_HEIGHT - 0.012
        pieces.append(mt.box(COLUMN, COLUMN, height, 0.001, 0.004, "aluminium").moved(y=y, z=0.012 + height / 2))
    pieces.append(mt.box(*BEAM, 0.002, 0.006, "aluminium", 3).moved(z=BEAM_HEIGHT))
    for y in PLACES.values():
        pieces.append(parts.bearing(0.0092, 0.06).moved(y=y, z=BEAM_HEIGHT))
    return mt.joined(pieces)


def add_rod(model, grip):
    radius, length, mass = ROD
    model.body(
        "rod",
        (grip[0] + ROD_OFF, grip[1], grip[2]),
        mass=mass,
        inertia=cylinder_inertia(mass, radius, length, "x"),
        mesh="rod.obj",
        shape=(shape_round("CYLINDER", radius, length, "x"), (0, 0, 0), (0, 0, 0)),
        friction=(0.0, 0.0),
        damping=(0.0, 0.0),
    )


def add_hammer(model, grip):
    """Its frame is in the middle of the handle."""
    head_x = HANDLE[0] / 2 + HEAD[0]
    mass, com, inertia = combined_inertia(
        [
            (HAMMER[0], (0, 0, 0), box_inertia(HAMMER[0], *HANDLE)),
            (HAMMER[1], (head_x, 0, 0), cylinder_inertia(HAMMER[1], *HEAD, "y")),
        ]
    )
    model.body(
        "hammer",
        (grip[0] - com[0] + GRIP, grip[1], grip[2]),
        mass=mass,
        com=com,
        inertia=inertia,
        mesh="hammer.obj",
        compound=[
            placed(shape_box(*HANDLE), (0, 0, 0)),
            placed(shape_round("CYLINDER", *HEAD, "y"), (head_x, 0, 0)),
        ],
        friction=(0.0, 0.0),
        damping=(0.0, 0.0),
    )


def build(models):
    folder = MeshFolder(models, "grasps")
    folder.add("stand.obj", stand_mesh())
    folder.add("rod.obj", mt.cylinder(ROD[0], ROD[1], 0.0015, 40, "plum").along("x"))
    head = mt.cylinder(HEAD[0], HEAD[1], 0.002, 40, "steel").along("y").moved(x=HANDLE[0] / 2 + HEAD[0])
    folder.add("hammer.obj", mt.box(*HANDLE, 0.004, 0.008, "amber", 3) + head)
    folder.close()

    model = Model(
        "Grasps by resistive sensors. Two hands on a gantry hold a rod far from its middle and a hammer of two\n"
        "collision shapes, by rays alone. Joints: NAME-lift (m, up), NAME-a and NAME-b (0 closed, 0.04 m open).",
        namespace="/ambf/env/grasps/",
        meshes=folder.seen_from(3),
    )
    height = BEAM_HEIGHT - 0.012
    model.body(
        "stand",
        mesh="stand.obj",
        compound=[
            placed(shape_box(0.30, 0.60, 0.012), (0, 0, 0.006)),
            *(placed(shape_box(COLUMN, COLUMN, height), (0, y, 0.012 + height / 2)) for y in (-0.26, 0.26)),
            placed(shape_box(*BEAM), (0, 0, BEAM_HEIGHT)),
        ],
        **{"publish children names": True},
    )
    for name, y in PLACES.items():
        half = ROD[0] if name == "left_hand" else HANDLE[1] / 2
        at = (0.0, y, HEIGHT)
        parts.add_hand(model, name, at, (0, 0, 0), half + GAP, parts.OBJECT_GRASP, RANGE)
        model.joint(
            f"{name}-lift",
            "prismatic",
            "stand",
            name,
            at,
            (0, 0, 1),
            limits=(-0.12, 0.06),
            damping=1.0,
            **parts.holding_motor(3.0, 0.02),
        )
    add_rod(model, (0.0, PLACES["left_hand"], PAD))
    add_hammer(model, (0.0, PLACES["right_hand"], PAD))
    model.write(models / "descriptions" / "multi-bodies" / "touch" / "grasps.yaml")
