"""A suture thread that hangs over two pegs with a weight in its middle, its ends in the jaws of two hands on a rail:
they draw it taut over the pegs, or open and let it run. docs/tissue.md"""

import math

import mesh_tools as mt
import numpy as np
import outlines
import scene_grippers as grippers
import touch_parts as parts
from adf_writer import (
    Model,
    box_inertia,
    color_components,
    cylinder_inertia,
    placed,
    pose,
    shape_box,
    shape_round,
    spring_servo,
    vector,
)
from lettering import Canvas
from mesh_folder import MeshFolder

BASE = (0.12, 0.30)  # x, y of the plate
PLATE = 0.012
PANEL = (0.008, 0.130, 0.150)  # x, y, z; it carries the pegs and a scale
PANEL_X = -0.030
PEG, PEG_Y, PEG_Z = 0.006, 0.040, 0.130  # radius, to each side, height: m
PEG_END, HEAD = 0.012, (0.0085, 0.004)  # x where the head begins; its radius and thickness
THREAD, DENSITY, YOUNG, ELEMENT = 0.0004, 1150.0, 2.0e7, 0.002  # radius: a braided suture of size 2
THREAD_FRICTION, PEG_FRICTION = 0.4, 0.5
SAG = 0.056  # m, of the middle below the tops of the pegs
HAND_Y, HAND_Z = 0.098, PEG_Z + PEG + THREAD  # of the pins of the jaws
HELD = 0.011  # m from a pin: where the thread ends
JAW_HOME = 0.045  # rad, of each: closed on the thread
CLOSED = 0.2  # opening below which a hand holds
PULL = 0.022  # m outwards
CARRIAGE, RAIL = (0.040, 0.030, 0.020), (0.014, 0.008)  # x, y, z; x and z
POST, ARM = 0.006, 0.030  # radius; y of the post behind the pin
HAND_MASS, WEIGHT_MASS = 0.15, 0.02
WEIGHT = (0.0075, 0.020)  # radius, height
RING = (0.0032, 0.0007)

INK, PALE = (52, 62, 72), (235, 231, 221)


def scale_print():
    """Millimetres below the pegs' tops, which the ring of the weight is read against."""
    canvas = Canvas(PANEL[1], PANEL[2], 3600, PALE)
    top = PEG_Z + PEG - PLATE - PANEL[2] / 2  # in the panel
    for k in range(0, 101):
        long = 0.030 if k % 10 == 0 else 0.022 if k % 5 == 0 else 0.018
        thick = 0.0003 if k % 10 == 0 else 0.00016
        for side in (-1, 1):
            canvas.stroke([(side * 0.012, top - 0.001 * k), (side * long, top - 0.001 * k)], thick, INK, 0.8)
        if k % 10 == 0 and k > 0:
            canvas.text(str(k), -0.0355, top - 0.001 * k - 0.0016, 0.0034, INK, 0.9)
    canvas.text("mm", 0.0355, top - 0.1016, 0.0030, INK, 0.9)
    frame = np.abs(canvas.box(0, 0, PANEL[1] - 0.008, PANEL[2] - 0.008, 0.004)) - 0.0002
    canvas.paint(frame, INK, 0.45)
    return canvas


def stand_mesh():
    plate = parts.base_plate(*BASE)
    panel = mt.box(PANEL[2], PANEL[1], PANEL[0], 0.001, 0.004, "ivory", 3).turned(mt.rotation_about("y", math.pi / 2))
    panel = panel.printed("scale", PANEL[1], PANEL[2], up=(0, 0, 1))
    pieces = [plate, panel.moved(PANEL_X, 0, PLATE + PANEL[2] / 2)]
    foot = mt.box(0.022, PANEL[1] - 0.01, 0.010, 0.002, 0.003, "aluminium").moved(PANEL_X, 0, PLATE + 0.005)
    pieces.append(foot)
    back = PANEL_X + PANEL[0] / 2
    profile = [
        (0, back - 0.002),
        (0.0095, back - 0.002),
        (0.0095, back + 0.003),
        (PEG, back + 0.003),
        (PEG, PEG_END),
        (HEAD[0], PEG_END),
        (HEAD[0], PEG_END + HEAD[1]),
        (0, PEG_END + HEAD[1]),
    ]
    peg = mt.lathe(mt.rounded_profile(profile, [0, 0, 0.0008, 0.0012, 0.001, 0.0006, 0.0014, 0], 2), 28, "steel")
    for side in (-1, 1):
        pieces.append(peg.along("x").moved(y=side * PEG_Y, z=PEG_Z))
        rail = mt.box(RAIL[0], 0.066, RAIL[1], 0.001, 0.002, "steel")
        pieces.append(rail.moved(0, side * (BASE[1] / 2 - 0.043), PLATE + RAIL[1] / 2))
    return mt.joined(pieces)


def in_jaws(side):
    """Turns the frame of the jaw gripper, jaws towards -z, so that they point inwards."""
    return mt.rotation_about("x", -side * math.pi / 2)


def hand_mesh(side):
    """In a frame in the pin of its jaws, which point to the middle."""
    wrist = grippers.turned_part(
        [(0, 0.0075), (0.0036, 0.0075), (0.004, 0.0105), (0.004, ARM), (0, ARM)],
        [0, 0.0006, 0.001, 0, 0],
        "steel",
        20,
        2,
    )
    cheek = mt.extrude(outlines.stadium(0.0085, 0.0034), 0.0013, 0.0003, color="steel").turned(
        mt.rotation_about("y", -math.pi / 2)
    )
    cheeks = [cheek.moved(x=k * 0.0033) for k in (-1.0, 1.0)]
    pin = mt.cylinder(0.0013, 0.0082, 0.0002, 12, "graphite").along("x")
    heads = [mt.cylinder(0.0019, 0.0008, 0.0002, 12, "brass").along("x").moved(x=k * 0.0042) for k in (-1.0, 1.0)]
    block = mt.box(0.016, 0.016, 0.016, 0.0015, 0.003, "shell", 3).moved(z=ARM)
    band = mt.collar(0.003, 0.0046, 0.013, 0.016, 0.0003, 24, "teal" if side < 0 else "coral")
    instrument = mt.joined([wrist, *cheeks, pin, *heads, block, band]).turned(in_jaws(side))
    low = PLATE + 0.002 + CARRIAGE[2] - HAND_Z
    post = mt.cylinder(POST, -low, 0.0005, 28, "aluminium").moved(y=side * ARM, z=low / 2)
    carriage = mt.box(*CARRIAGE, 0.0015, 0.004, "graphite", 3)
    carriage = carriage.moved(y=side * ARM, z=low - CARRIAGE[2] / 2)
    return mt.joined([instrument, post, carriage])


def weight_mesh():
    """Hangs by its ring, whose inside's top is the frame's origin; the thread runs through along y."""
    radius, height = WEIGHT
    ring = mt.torus(*RING, 28, 8, "steel").turned(mt.rotation_about("x", math.pi / 2))
    top = -2 * RING[0] + 0.0004
    profile = [(0, -height), (radius, -height), (radius, -0.003), (0.0022, 0.0), (0, 0.0)]
    body = mt.lathe(mt.rounded_profile(profile, [0, 0.0012, 0.0012, 0.0008, 0], 2), 28, "brass")
    return mt.joined([ring.moved(z=RING[1] - RING[0]), body.moved(z=top)])


def thread_points():
    """From the left hand over both pegs; it lies on them without touching them yet."""
    around = PEG + THREAD + 0.00005
    # Where it leaves a peg towards the middle, whose place is below by SAG.
    middle = np.array([0.0, PEG_Z + PEG - SAG])
    centre = np.array([PEG_Y, PEG_Z])
    way = middle - centre
    apart = float(np.linalg.norm(way))
    leaves = math.atan2(way[1], way[0]) - math.acos(around / apart)
    leaves += 2 * math.pi if leaves < 0 else 0.0
    arc = [leaves + (math.pi / 2 - leaves) * k / 8 for k in range(9)]
    right = [(0.0, PEG_Y + around * math.cos(a), PEG_Z + around * math.sin(a)) for a in arc]
    right.append((0.0, HAND_Y - HELD, HAND_Z))
    left = [(x, -y, z) for x, y, z in reversed(right)]
    return [*left, (0.0, 0.0, float(middle[1])), *right]


def add_hand(model, name, side):
    at = (0.0, side * HAND_Y, HAND_Z)
    floating = {"gravity": vector((0, 0, 0)), "collision margin": 0.0002}
    low = PLATE + 0.002 + CARRIAGE[2] - HAND_Z
    model.body(
        name,
        at,
        mass=HAND_MASS,
        com=(0, side * ARM, low / 2),
        inertia=box_inertia(HAND_MASS, 0.03, 0.03, -low),
        mesh=f"{name}.obj",
        compound=[
            placed(shape_box(0.016, 0.016, 0.016), (0, side * ARM, 0)),
            placed(shape_round("CYLINDER", 0.004, ARM - 0.006, "y"), (0, side * (ARM + 0.006) / 2, 0)),
            placed(shape_round("CYLINDER", POST, -low), (0, side * ARM, low / 2)),
            placed(shape_box(*CARRIAGE), (0, side * ARM, low - CARRIAGE[2] / 2)),
        ],
        friction=(0.3, 0.01),
        **{"publish children names": True},
        **floating,
    )
    model.joint(
        f"{name}-pull",
        "prismatic",
        "stand",
        name,
        at,
        (0, side, 0),
        limits=(-0.005, PULL),
        **parts.holding_motor(20.0, 0.01),
    )
    roll = -side * math.pi / 2
    for jaw, sign in (("a", 1.0), ("b", -1.0)):
        child = f"{name}_jaw_{jaw}"
        middle = (0, sign * (grippers.JAW_GAP + grippers.JAW_THICKNESS / 2), -grippers.JAW_LENGTH / 2)
        size = (grippers.JAW_WIDTH, grippers.JAW_THICKNESS, grippers.JAW_LENGTH)
        model.body(
            child,
            at,
            (roll + sign * JAW_HOME, 0, 0),
            mass=grippers.JAW_MASS,
            com=middle,
            mesh=f"../../peg_transfer/high_res/jaw_{jaw}.obj",
            inertia=box_inertia(grippers.JAW_MASS, *size),
            friction=(0.6, 0.01),
            restitution=0.0,
            shape=(shape_box(*size), middle, (0, 0, 0)),
            damping=(0.2, 0.2),
            **{"collision groups": [1] if jaw == "a" else [2]},
            **floating,
        )
        model.joint(
            f"{name}-jaw_{jaw}",
            "revolute",
            name,
            child,
            at,
            (sign, 0, 0),
            home=JAW_HOME,
            limits=grippers.JAW_LIMITS,
            damping=1e-4,
            **spring_servo(grippers.JAW_STIFFNESS, grippers.JAW_DAMPING, 1e-4),
            hold=True,
        )
    starts = [(-0.004, -side * y, 0.0) for y in (0.012, 0.014, 0.016, 0.018)]
    eyes = f"{name}_eyes"
    model.add("sensors", eyes, name, type="Proximity", range=0.008, array=parts.rays(starts, (1, 0, 0)))
    model.add(
        "actuators",
        f"{name}_grip",
        name,
        type="Constraint",
        sensor=f"SENSOR {eyes}",
        trigger={"jaw": f"BODY {name}", "below": CLOSED},
        hardness=2000.0,
        damping=1.0,
    )


def build(models):
    folder = MeshFolder(models, "thread_over_pegs")
    folder.print("scale", scale_print())
    folder.add("stand.obj", stand_mesh())
    folder.add("weight.obj", weight_mesh())
    for name, side in (("left_hand", -1.0), ("right_hand", 1.0)):
        folder.add(f"{name}.obj", hand_mesh(side))
    folder.close()
    model = Model(
        "A suture thread over two pegs, a weight of 20 g in its middle, its ends in the jaws of two hands. Joints of\n"
        "`stand`: NAME_hand-pull (m, outwards), NAME_hand-jaw_a and -jaw_b (rad): below a fifth of their way they\n"
        "hold what is between them. ambf_client_py/examples/lift_by_thread.py lifts the weight. docs/tissue.md",
        namespace="/ambf/env/thread_over_pegs/",
        meshes=folder.seen_from(3),
    )
    reach = PEG_END - PANEL_X
    model.body(
        "stand",
        mesh="stand.obj",
        compound=[
            placed(shape_box(*BASE, PLATE), (0, 0, PLATE / 2)),
            placed(shape_box(*PANEL), (PANEL_X, 0, PLATE + PANEL[2] / 2)),
            *(
                placed(shape_round("CYLINDER", PEG, reach, "x"), (PANEL_X + reach / 2, side * PEG_Y, PEG_Z))
                for side in (-1, 1)
            ),
            *(
                placed(shape_round("CYLINDER", HEAD[0], HEAD[1], "x"), (PEG_END + HEAD[1] / 2, side * PEG_Y, PEG_Z))
                for side in (-1, 1)
            ),
        ],
        friction=(PEG_FRICTION, 0.01),
        **{"publish children names": True},
    )
    radius, height = WEIGHT
    top = -2 * RING[0] + 0.0004
    model.body(
        "weight",
        (0.0, 0.0, PEG_Z + PEG - SAG),
        mass=WEIGHT_MASS,
        com=(0, 0, top - height / 2),
        inertia=cylinder_inertia(WEIGHT_MASS, radius, height),
        mesh="weight.obj",
        compound=[
            placed(shape_round("CYLINDER", radius, height), (0, 0, top - height / 2)),
            placed(shape_round("CYLINDER", 0.002, 0.005), (0, 0, -0.004)),
        ],
        friction=(0.5, 0.01),
        restitution=0.0,
        damping=(0.04, 0.6),
    )
    for name, side in (("left_hand", -1.0), ("right_hand", 1.0)):
        add_hand(model, name, side)
    points = thread_points()
    model.add(
        "soft bodies",
        "thread",
        **{"color components": color_components("plum")},
        location=pose((0, 0, 0)),
        tissue={
            "kind": "thread",
            "points": [vector(point) for point in points],
            "radius": THREAD,
            "young modulus": YOUNG,
            "density": DENSITY,
            "element size": ELEMENT,
            "friction": THREAD_FRICTION,
            "regions": [
                {"sphere": 0.25 * ELEMENT, "location": pose(points[len(points) // 2]), "attach to": "BODY weight"}
            ],
        },
    )
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "thread_over_pegs.yaml")
