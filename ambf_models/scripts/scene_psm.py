"""Patient side manipulator of the da Vinci Research Kit (Classic), with its parallel linkage and a large needle driver.

Names, order, types and home frames are those of the original AMBF's file, so that its scripts run. Numbers: the
published kinematics (shaft, insertion's zero, limits, efforts), link lengths and masses from CAD. Two parallelograms,
closed by joints, carry the remote centre: cranks and bottom link keep the end link on a circle about it, the top link
keeps the end link parallel to the cranks. Published lengths that close only within rounding (0.5163 m of the top link,
0.0423 m from the end link to the insertion's line) are here those that close exactly. Chosen, since no source has
them: masses of shaft, wrist and fingers, inertias (of boxes as large as the links), shapes.
"""

import math

import dvrk_parts as dvrk
import numpy as np
import robot_files
from adf_writer import PASSIVE, ZERO, Model, vector
from dvrk_parts import Link, servo
from mesh_folder import MeshFolder

CENTER = (0.5, 0.5141, -0.7)  # the remote centre in the world
HALF = math.pi / 2
YAW_FRAME = 0.4864  # m: from the remote centre to the yaw link's frame, along the yaw axis
BACK, FRONT, CRANK = 0.516, 0.420, 0.150  # m
LEAN = 0.290386  # rad: the cranks from upright at q2 = 0
TOP_ON_BACK = (0.18366, 0.014121)  # m: the top link's pivot, in the back link's frame
INSERTION_ZERO, SHAFT, WRIST = 0.4318, 0.4162, 0.0091  # m
ROLL_FRAME = 0.231  # m: from the carriage's frame to the roll link's, along the shaft
JAW = 0.0095  # m: from the jaw's axis to its tip
COUNTERWEIGHT = 0.20  # m: from the back link's pivot
FLOOR = 0.95  # m below the remote centre

LIMITS = {  # rad, m
    "yaw": (-math.radians(91), math.radians(91)),
    "pitch": (-math.radians(53), math.radians(53)),
    "insertion": (0.0, 0.240),
    "roll": (-math.radians(260), math.radians(260)),
    "wrist": (-math.radians(80), math.radians(80)),
    # A half of the jaw carries the wrist's yaw (+-80 degrees) and half of the opening (-40 to 80 degrees).
    "finger": (-math.radians(100), math.radians(120)),
}
EFFORTS = {"yaw": 3.3161, "pitch": 3.3161, "insertion": 9.8779, "roll": 0.33, "wrist": 0.25, "finger": 0.16}
FREE = (-1.1, 1.1)  # rad: limits of the linkage's passive joints, wider than the pitch's

CRANK_UP = np.array([math.sin(LEAN), math.cos(LEAN)])  # (u, v) along the cranks at home
CRANK_ASIDE = np.array([-math.cos(LEAN), math.sin(LEAN)])  # y of the back link's frame
BACK_PIVOT, FRONT_PIVOT, ORIGIN = np.array([BACK, 0.0]), np.array([FRONT, 0.0]), np.array([0.0, 0.0])
BACK_BOTTOM, FRONT_BOTTOM, END_BOTTOM = (pivot + CRANK * CRANK_UP for pivot in (BACK_PIVOT, FRONT_PIVOT, ORIGIN))
TOP_RISE = (TOP_ON_BACK[0] - CRANK) * CRANK_UP + TOP_ON_BACK[1] * CRANK_ASIDE
BACK_TOP, END_TOP = BACK_BOTTOM + TOP_RISE, END_BOTTOM + TOP_RISE


def link(u, v, rpy):
    return Link((u, v, 0.0), rpy, CENTER, dvrk.TO_LEFT)


def base_link():
    """Bearing behind the linkage, on an arm that reaches down to the foot."""
    made = link(0, 0, (0.0, 0.0, math.pi))
    made.rod((0.575, 0, 0), (0.70, 0, 0), 0.027, "graphite", 0.002, True)
    made.rod((0.583, 0, 0), (0.589, 0, 0), 0.0276, "teal", 0.0005)
    made.box((0.655, -0.1524, -0.032), (0.715, 0.034, 0.032), 0.008, "shell")
    made.box((0.625, -0.170, -0.065), (0.745, -0.150, 0.065), 0.006, "graphite")
    return made


def yaw_link():
    """Tube on the yaw axis with the pivots of both cranks."""
    made = link(YAW_FRAME, 0, (-HALF, -HALF, 0.0))
    made.box((0.385, -0.027, -0.026), (0.548, 0.027, 0.026), 0.010, "shell")
    made.rod((0.548, 0, 0), (0.575, 0, 0), 0.024, "aluminium", 0.001, True)
    made.rod((0.372, 0, 0), (0.385, 0, 0), 0.020, "graphite", 0.002)
    for pivot in (BACK_PIVOT, FRONT_PIVOT):
        made.pin(pivot, 0.011, -0.050, 0.050, collides=True)
    return made


def back_link():
    """Crank that the pitch motor drives; its upper end carries both long links."""
    made = link(BACK, 0, (HALF, -(HALF - LEAN), HALF))
    for w in (-0.040, 0.040):
        made.bar(BACK_PIVOT, BACK_BOTTOM, 0.044, 0.016, w, "slate")
        made.bar(BACK_BOTTOM, BACK_TOP, 0.034, 0.016, w, "slate")
    made.pin(BACK_BOTTOM, 0.008, -0.050, 0.050)
    made.pin(BACK_TOP, 0.006, -0.050, 0.050)
    return made


def front_link():
    made = link(FRONT, 0, (HALF, -(HALF - LEAN), HALF))
    for w in (-0.039, 0.039):
        made.bar(FRONT_PIVOT, FRONT_BOTTOM, 0.034, 0.012, w, "slate")
    made.pin(FRONT_BOTTOM, 0.008, -0.047, 0.047)
    return made


def long_link(start, end, width, w, color):
    made = link(*start, (-HALF, 0.0, -HALF))
    made.bar(start, end, width, 0.018, w, color)
    for at in (start, end):
        made.pin(at, 0.5 * width - 0.004, w - 0.0115, w + 0.0115, "aluminium")
    return made


def end_link():
    """Beam along which the carriage slides; its foot holds the cannula on the remote centre."""
    made = link(*END_BOTTOM, (-HALF, 0.0, -HALF))
    for w in (-0.029, 0.029):
        made.box((0.030, 0.075, w - 0.005), (0.066, 0.500, w + 0.005), 0.004, "shell")
    made.box((0.052, 0.215, -0.026), (0.066, 0.500, 0.026), 0.003, "ivory", False)
    made.box((0.030, 0.495, -0.034), (0.066, 0.515, 0.034), 0.006, "graphite", False)
    made.pin(END_BOTTOM, 0.014, -0.037, 0.037)
    made.pin(END_TOP, 0.009, -0.037, 0.037)
    for w in (-0.020, 0.020):
        made.rod((0.036, 0.20, w), (0.036, 0.498, w), 0.004, "steel", 0.0005)
    made.box((-0.010, 0.070, -0.036), (0.068, 0.092, 0.036), 0.006, "graphite")
    made.pipe((0, 0.010, 0), (0, 0.098, 0), 0.0068, 0.0052, "steel")
    made.pipe((0, 0.092, 0), (0, 0.104, 0), 0.012, 0.0052, "teal")
    return made


def insertion_link():
    """Carriage with the instrument's drive."""
    zero = INSERTION_ZERO
    made = link(0, zero, (-HALF, HALF, HALF))
    made.box((0.006, zero - 0.035, -0.030), (0.040, zero + 0.055, 0.030), 0.005, "graphite")
    made.box((-0.034, zero - 0.050, -0.036), (0.012, zero + 0.050, 0.036), 0.010, "shell")
    for w in (-0.016, 0.016):
        for v in (-0.016, 0.016):
            made.rod((-0.034, zero + v, w), (-0.0375, zero + v, w), 0.009, "teal", 0.0006)
    return made


def roll_link():
    """Shaft of the instrument, 8 mm."""
    zero = INSERTION_ZERO
    made = link(0, zero - ROLL_FRAME, (math.pi, 0.0, HALF))
    made.rod((0, zero - 0.04, 0), (0, zero - SHAFT + 0.006, 0), 0.0042, "carbon", 0.0004, True, 28)
    made.rod((0, zero - SHAFT + 0.011, 0), (0, zero - SHAFT + 0.006, 0), 0.0043, "steel", 0.0004, False, 28)
    for u in (-0.0030, 0.0030):
        made.bar((u, zero - SHAFT + 0.008), (u, zero - SHAFT), 0.0022, 0.0064, 0.0, "steel", False)
    return made


def wrist_link(length=WRIST):
    height = INSERTION_ZERO - SHAFT
    made = link(0, height, (0.0, HALF, 0.0))
    made.box((-0.0018, height - 0.0065, -0.0030), (0.0018, height + 0.0022, 0.0030), 0.0008, "steel")
    for w in (-0.0024, 0.0024):
        made.bar((0, height - 0.0045), (0, height - length), 0.0044, 0.0012, w, "steel")
    made.rod((0, height, -0.0034), (0, height, 0.0034), 0.0014, "brass", 0.0002, False, 16)
    made.rod((-0.0032, height - length, 0), (0.0032, height - length, 0), 0.0010, "brass", 0.0002, False, 16)
    return made


def finger(side):
    """Half of the jaw: a tapered bar, its inner face through the jaw's axis."""
    height = INSERTION_ZERO - SHAFT - WRIST
    made = link(0, height, (-HALF, 0.0, 0.0))
    low, high = sorted((0.0, side * 0.0021))
    made.box((-0.0019, height - JAW, low), (0.0019, height - 0.0005, high), 0.0005, "steel")
    low, high = sorted((0.0, side * 0.0016))
    made.rod((-0.0011, height, 0.0), (0.0011, height, 0.0), 0.0018, "aluminium", 0.0002, False, 18)
    return made


# Mass (kg), centre of mass in the body frame (m), box with the same inertia (m, body axes).
MASSES = {
    "yaw link": (1.4705, (-0.038769, 0, 0.041596), (0.12, 0.10, 0.20)),
    "pitch back link": (0.98494, (-0.011651, -0.036241, 0), (0.20, 0.08, 0.10)),
    "pitch front link": (0.074425, (0.096269, 0, 0.047551), (0.19, 0.05, 0.09)),
    "pitch bottom link": (0.44569, (0.25683, -0.010348, 0), (0.55, 0.05, 0.03)),
    "pitch top link": (0.17841, (0.31246, -0.00057, 0), (0.54, 0.04, 0.03)),
    "pitch end link": (2.0910, (-0.0019293, -0.13613, 0), (0.09, 0.50, 0.08)),
    "main insertion link": (0.22491, (0.0, 0.0, 0.0), (0.10, 0.08, 0.08)),
    "tool roll link": (0.040, (0.0, 0.0, -0.004), (0.09, 0.09, 0.37)),
    "tool pitch link": (0.010, (0.004, 0.0, 0.0), (0.009, 0.006, 0.006)),
    "tool gripper1 link": (0.003, (0.0, 0.005, -0.001), (0.004, 0.010, 0.003)),
    "tool gripper2 link": (0.003, (0.0, 0.005, 0.001), (0.004, 0.010, 0.003)),
}
LINKS = {
    "base link": base_link,
    "main insertion link": insertion_link,
    "pitch back link": back_link,
    "pitch bottom link": lambda: long_link(BACK_BOTTOM, END_BOTTOM, 0.034, -0.0105, "aluminium"),
    "pitch end link": end_link,
    "pitch front link": front_link,
    "pitch top link": lambda: long_link(BACK_TOP, END_TOP, 0.024, 0.0105, "aluminium"),
    "target_ik": None,
    "tool gripper1 link": lambda: finger(-1.0),
    "tool gripper2 link": lambda: finger(1.0),
    "tool pitch link": wrist_link,
    "tool roll link": roll_link,
    "yaw link": yaw_link,
    "target_fk": None,
}
# Name: colour, collision group, namespace (the second one's is relative in the original's file, too).
TARGETS = {"target_ik": ("coral", 14, {}), "target_fk": ("sage", 5, {"namespace": "ambf/env/psm/"})}
ORIGINAL_PASSIVE = {  # as in the original's file: without State and Command of their own
    "pitch back link",
    "pitch bottom link",
    "pitch end link",
    "pitch front link",
    "pitch top link",
}


def add_joints(model):
    """In the order of the original's file."""
    u, w, down = (0, 1, 0), (1, 0, 0), (0, 0, -1)
    zero = INSERTION_ZERO

    def joint(parent, child, at, axis, kind="revolute", **more):
        where = dvrk.place(CENTER, dvrk.TO_LEFT, at)
        model.joint(f"{parent}-{child}", kind, parent, child, where, axis, **more)

    def driven(name):
        return {"limits": LIMITS[name], **servo(EFFORTS[name])}

    def free(damping):
        return {"limits": FREE, "damping": damping, **PASSIVE}

    joint("base link", "yaw link", (0, 0), u, **driven("yaw"))
    joint("main insertion link", "tool roll link", (0, zero - ROLL_FRAME), down, **driven("roll"))
    joint("pitch back link", "pitch bottom link", BACK_BOTTOM, w, **free(0.002))
    joint("pitch back link", "pitch top link", BACK_TOP, w, **free(0.002))
    joint("pitch bottom link", "pitch end link", END_BOTTOM, w, **free(0.002))
    joint("pitch end link", "main insertion link", (0, zero), down, "prismatic", **driven("insertion"))
    # Active in the original's file, though the loop moves it: a motor here would hold the pitch.
    idle = {**servo(0.0), "enable motor": False, "hold": False}
    joint("pitch front link", "pitch bottom link", FRONT_BOTTOM, w, limits=FREE, damping=0.002, **idle)
    joint("pitch top link", "pitch end link", END_TOP, w, **free(0.002))
    height = zero - SHAFT
    for number, axis in ((1, u), (2, (0, -1, 0))):
        joint("tool pitch link", f"tool gripper{number} link", (0, height - WRIST), axis, **driven("finger"))
    joint("tool roll link", "tool pitch link", (0, height), w, **driven("wrist"))
    joint("yaw link", "pitch back link", BACK_PIVOT, w, **driven("pitch"))
    # Redundant: the linkage keeps the remote centre without it. Scripts know its name.
    joint("yaw link", "pitch end link", (0, 0), w, "p2p", **PASSIVE)
    joint("yaw link", "pitch front link", FRONT_PIVOT, w, **free(0.002))


def make(folder):
    """The arm on no stand; its meshes go to `folder`."""
    model = Model(
        "Patient side manipulator of the da Vinci Research Kit with a large needle driver (docs/models.md). Gravity\n"
        "does not act on it, as in the original's file; its motors keep their last target.",
        namespace="/ambf/env/psm/",
        meshes=folder.seen_from(3),
        gravity=vector((0, 0, 0)),
        **{"ignore inter-collision": True},
    )
    dvrk.add_bodies(model, folder, LINKS, TARGETS, MASSES, ORIGINAL_PASSIVE)
    add_joints(model)
    return model


def moment():
    """What turns the pitch by its weight, the carriage in its middle: sum of mass times place (u, v), of all that turns
    with the pitch (about its own pivot) or is carried by the cranks, kg m."""
    crank, long_crank = CRANK * CRANK_UP, BACK_TOP - BACK_PIVOT
    shift = np.array([0.0, -0.5 * LIMITS["insertion"][1]])
    # Link: its pivot in the plane, or, for one that keeps its direction, the crank's end that carries it.
    turning = {"pitch back link": BACK_PIVOT, "pitch front link": FRONT_PIVOT, "pitch end link": ORIGIN}
    carried = {"pitch bottom link": crank, "pitch top link": long_crank}
    total = np.zeros(2)
    for name, (mass, com, _) in MASSES.items():
        if name in carried:
            total += mass * carried[name]
        elif name in turning:
            total += mass * (LINKS[name]().in_plane(com)[:2] - turning[name])
        elif name != "yaw link":
            total += mass * (LINKS[name]().in_plane(com)[:2] + shift)
    return total


def add_counterweight(model, mesh):
    """On the back link, beyond its pivot: the pitch motor (3.3 Nm) could not carry what the links weigh (7.4 Nm)."""
    weight = moment()
    mass = float(np.hypot(*weight)) / COUNTERWEIGHT
    size = (0.09, 0.09, 0.06)
    made = counterweight()
    model.body("counterweight", mesh=mesh, passive=True, **made.entries(mass, ZERO, size), **{"collision groups": [0]})
    model.joint(
        "pitch back link-counterweight",
        "fixed",
        "pitch back link",
        "counterweight",
        made.position,
        (1, 0, 0),
        **PASSIVE,
    )


def counterweight():
    """A block under the tube, on the back link's line through the centre of mass that it balances."""
    away = -moment() / np.hypot(*moment())
    at = BACK_PIVOT + COUNTERWEIGHT * away
    made = link(*at, (0.0, 0.0, 0.0))
    for w in (-0.040, 0.040):
        made.bar(BACK_PIVOT, at, 0.034, 0.012, w, "slate")
    made.box((at[0] - 0.045, at[1] - 0.045, -0.032), (at[0] + 0.045, at[1] + 0.045, 0.032), 0.006, "graphite")
    return made


def build(models):
    folder = MeshFolder(models, "psm")
    model = make(folder)
    mesh, shapes = dvrk.stand(FLOOR - 0.170)
    at = dvrk.place(CENTER, dvrk.TO_LEFT, (0.685, -0.170))
    model.body("stand", at, mesh=folder.add("stand.obj", mesh), compound=shapes, passive=True)
    weight = folder.add("counterweight.obj", counterweight().mesh())
    folder.close()
    robot_files.write(model, models, "psm", lambda heavy: add_counterweight(heavy, weight))
