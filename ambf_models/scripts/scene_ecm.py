"""Endoscope's arm of the da Vinci Research Kit (Classic), with its parallel linkage.

Names, order, types and home frames are those of the original AMBF's file. Numbers: the published kinematics (insertion,
limits, efforts), link lengths and masses from CAD. The front crank carries bottom and top link, which keep the end link
parallel to it; the back crank keeps the bottom link parallel to the yaw axis. Chosen, since no source has them in these
frames: centres of mass of carriage and endoscope, inertias (of boxes as large as the links), shapes.
"""

import math

import dvrk_parts as dvrk
import numpy as np
import robot_files
from adf_writer import PASSIVE, Model, vector
from dvrk_parts import Link, servo
from mesh_folder import MeshFolder

CENTER = (0.5, -0.3901, -0.599)  # the remote centre in the world
HALF = math.pi / 2
FRONT_PIVOT = np.array([0.3404, 0.0])  # (u, v), m
YAW_FRAME = 0.3404 + 0.199  # m: from the remote centre to the yaw link's frame
BACK_PIVOT = np.array([YAW_FRAME - 0.16243, -0.0098])
CRANK = np.array([0.10300, 0.28681])  # from the front pivot to the bottom link
CRANK_TOP = np.array([0.10847, 0.32426])  # from there to the top link
END_BOTTOM, END_TOP = CRANK, CRANK_TOP  # the end link's pivots, as the remote centre sees them
FRONT_BOTTOM, FRONT_TOP, BACK_BOTTOM = FRONT_PIVOT + CRANK, FRONT_PIVOT + CRANK_TOP, BACK_PIVOT + CRANK
CARRIAGE = np.array([0.059, 0.3718])  # the carriage's frame
SCOPE_FRAME, TIP = 0.3703, -0.0007  # m: the endoscope's frame and its tip along the shaft, at insertion 0
FLOOR = 1.051  # m below the remote centre

LIMITS = {  # rad, m
    "yaw": (-HALF, HALF),
    "pitch": (-math.radians(44), math.radians(65)),
    "insertion": (0.0, 0.255),
    "roll": (-1.552, 1.552),
}
EFFORTS = {"yaw": 26.932, "pitch": 26.932, "insertion": 80.659, "roll": 0.8766}  # Nm, N
FREE = (-1.3, 1.3)  # rad: limits of the linkage's passive joints, wider than the pitch's
LINK_RPY = (-HALF, 0.0, HALF)  # of the linkage's frames: x is -u, y is -v


def link(at, rpy):
    return Link((*at, 0.0), rpy, CENTER, dvrk.TO_RIGHT)


def base_link():
    """Bearing behind the linkage, on an arm that reaches down to the foot."""
    made = link((0, 0), (0.0, 0.0, 0.0))
    made.rod((0.595, 0, 0), (0.74, 0, 0), 0.032, "graphite", 0.002, True)
    made.rod((0.604, 0, 0), (0.611, 0, 0), 0.0327, "teal", 0.0005)
    made.box((0.69, -0.1524, -0.038), (0.76, 0.042, 0.038), 0.009, "shell")
    made.box((0.655, -0.172, -0.075), (0.795, -0.150, 0.075), 0.006, "graphite")
    return made


def yaw_link():
    made = link((YAW_FRAME, 0), (HALF, 0.0, math.pi))
    made.box((0.310, -0.036, -0.034), (0.565, 0.030, 0.034), 0.012, "shell")
    made.rod((0.565, 0, 0), (0.595, 0, 0), 0.028, "aluminium", 0.001, True)
    made.pin(FRONT_PIVOT, 0.013, -0.064, 0.064, collides=True)
    made.pin(BACK_PIVOT, 0.009, -0.050, 0.050)
    return made


def front_link():
    """Crank that carries both long links."""
    made = link(FRONT_PIVOT, LINK_RPY)
    for w in (-0.056, 0.056):
        made.bar(FRONT_PIVOT, FRONT_BOTTOM, 0.046, 0.012, w, "slate")
        made.bar(FRONT_BOTTOM, FRONT_TOP, 0.036, 0.012, w, "slate")
    made.pin(FRONT_BOTTOM, 0.008, -0.064, 0.064)
    made.pin(FRONT_TOP, 0.007, -0.064, 0.064)
    return made


def back_link():
    """Crank that the pitch motor drives."""
    made = link(BACK_PIVOT, LINK_RPY)
    for w in (-0.042, 0.042):
        made.bar(BACK_PIVOT, BACK_BOTTOM, 0.030, 0.012, w, "slate")
    made.pin(BACK_BOTTOM, 0.007, -0.050, 0.050)
    return made


def bottom_link():
    made = link(FRONT_BOTTOM, LINK_RPY)
    made.bar(FRONT_BOTTOM, END_BOTTOM, 0.034, 0.018, -0.0105, "aluminium")
    made.bar(FRONT_BOTTOM, BACK_BOTTOM, 0.026, 0.018, -0.0105, "aluminium")
    for at in (FRONT_BOTTOM, BACK_BOTTOM, END_BOTTOM):
        made.pin(at, 0.010, -0.022, 0.001, "steel")
    return made


def top_link():
    made = link(FRONT_TOP, LINK_RPY)
    made.bar(FRONT_TOP, END_TOP, 0.024, 0.018, 0.0105, "aluminium")
    for at in (FRONT_TOP, END_TOP):
        made.pin(at, 0.008, -0.001, 0.022, "steel")
    return made


def end_link():
    """Beam along which the carriage slides; its foot holds the cannula on the remote centre."""
    made = link(END_BOTTOM, LINK_RPY)
    for w in (-0.030, 0.030):
        made.box((0.076, 0.100, w - 0.006), (0.128, 0.520, w + 0.006), 0.004, "shell")
    made.box((0.112, 0.360, -0.026), (0.128, 0.520, 0.026), 0.003, "ivory", False)
    made.box((0.074, 0.514, -0.037), (0.130, 0.536, 0.037), 0.006, "graphite", False)
    made.pin(END_BOTTOM, 0.015, -0.038, 0.038)
    made.pin(END_TOP, 0.010, -0.038, 0.038)
    for w in (-0.020, 0.020):
        made.rod((0.082, 0.11, w), (0.082, 0.518, w), 0.005, "steel")
    made.box((-0.014, 0.094, -0.038), (0.130, 0.114, 0.038), 0.006, "graphite")
    made.pipe((0, 0.018, 0), (0, 0.106, 0), 0.0090, 0.0066, "steel")
    return made


def insertion_link():
    """Carriage that holds the endoscope."""
    made = link(CARRIAGE, (HALF, HALF, -HALF))
    v = CARRIAGE[1]
    made.box((0.030, v, -0.034), (0.086, v + 0.095, 0.034), 0.006, "graphite")
    made.box((-0.010, v + 0.030, -0.036), (0.034, v + 0.075, 0.036), 0.006, "shell")
    return made


def tool_link():
    """Endoscope of 12 mm with its camera's head."""
    made = link((0, SCOPE_FRAME), (0.0, 0.0, -HALF))
    v = SCOPE_FRAME
    made.rod((0, TIP, 0), (0, v + 0.01, 0), 0.0060, "carbon", 0.0006, True)
    made.rod((0, TIP - 0.0002, 0), (0, TIP + 0.004, 0), 0.0052, "tinted", 0.0)
    made.rod((0, v + 0.005, 0), (0, v + 0.030, 0), 0.016, "steel")
    made.rod((0, v + 0.028, 0), (0, v + 0.150, 0), 0.026, "night", 0.004, True)
    made.rod((0, v + 0.105, 0), (0, v + 0.112, 0), 0.0265, "teal", 0.0005)
    made.rod((0, v + 0.150, 0), (0, v + 0.170, 0), 0.009, "rubber", 0.002)
    return made


# Mass (kg), centre of mass in the body frame (m), box with the same inertia (m, body axes).
MASSES = {
    "yaw link": (6.4168, (0.0, -0.029045, 0.10669), (0.11, 0.10, 0.26)),
    "pitch front link": (1.6069, (-0.0306, -0.1358, 0.0), (0.12, 0.34, 0.12)),
    "pitch back link": (0.4214, (-0.0329, -0.1500, -0.0081), (0.11, 0.30, 0.09)),
    "pitch bottom link": (0.35928, (0.14594, -0.0267, 0.0), (0.36, 0.05, 0.03)),
    "pitch top link": (0.43851, (0.1702, 0.0, 0.0008), (0.36, 0.04, 0.03)),
    "pitch end link": (2.0321, (0.0181, -0.0271, 0.0008), (0.10, 0.46, 0.08)),
    "main insertion link": (0.23108, (-0.045, -0.010, 0.0), (0.10, 0.09, 0.07)),
    "tool link": (1.9074, (0.0, 0.0, -0.0723), (0.06, 0.06, 0.45)),
}
LINKS = {
    "base link": base_link,
    "main insertion link": insertion_link,
    "pitch back link": back_link,
    "pitch bottom link": bottom_link,
    "pitch end link": end_link,
    "pitch front link": front_link,
    "pitch top link": top_link,
    "target_fk": None,
    "target_ik": None,
    "tool link": tool_link,
    "yaw link": yaw_link,
}
TARGETS = {"target_ik": ("coral", 14, {}), "target_fk": ("sage", 5, {})}  # colour, collision group, further entries
ORIGINAL_PASSIVE = {  # as in the original's file: without State and Command of their own
    "main insertion link",
    "pitch bottom link",
    "pitch end link",
    "pitch front link",
    "yaw link",
}


def add_joints(model):
    """In the order of the original's file."""
    yaw_axis, across, down = (0, -1, 0), (-1, 0, 0), (0, 0, -1)

    def joint(parent, child, at, axis, kind="revolute", **more):
        where = dvrk.place(CENTER, dvrk.TO_RIGHT, at)
        model.joint(f"{parent}-{child}", kind, parent, child, where, axis, **more)

    def driven(name):
        return {"limits": LIMITS[name], **servo(EFFORTS[name])}

    free = {"limits": FREE, "damping": 0.002, **PASSIVE}
    joint("base link", "yaw link", (0, 0), yaw_axis, **driven("yaw"))
    joint("main insertion link", "tool link", (0, SCOPE_FRAME), down, **driven("roll"))
    joint("pitch back link", "pitch bottom link", BACK_BOTTOM, across, **free)
    joint("pitch bottom link", "pitch end link", END_BOTTOM, across, **free)
    joint("pitch end link", "main insertion link", (0, CARRIAGE[1]), down, "prismatic", **driven("insertion"))
    joint("pitch front link", "pitch bottom link", FRONT_BOTTOM, across, **free)
    joint("pitch front link", "pitch top link", FRONT_TOP, across, **free)
    joint("pitch top link", "pitch end link", END_TOP, across, **free)
    # Redundant: the linkage keeps the remote centre without it. Scripts know its name.
    joint("base link", "pitch end link", (0, 0), across, "p2p", **PASSIVE)
    joint("yaw link", "pitch back link", BACK_PIVOT, across, **driven("pitch"))
    joint("yaw link", "pitch front link", FRONT_PIVOT, across, **free)


def make(folder):
    """The arm on no stand; its meshes go to `folder`."""
    model = Model(
        "Endoscope's arm of the da Vinci Research Kit (docs/models.md). Gravity does not act on it, as in the\n"
        "original's file; its motors keep their last target.",
        namespace="/ambf/env/ecm/",
        meshes=folder.seen_from(3),
        gravity=vector((0, 0, 0)),
        **{"ignore inter-collision": True},
    )
    dvrk.add_bodies(model, folder, LINKS, TARGETS, MASSES, ORIGINAL_PASSIVE)
    add_joints(model)
    return model


def build(models):
    folder = MeshFolder(models, "ecm")
    model = make(folder)
    mesh, shapes = dvrk.stand(FLOOR - 0.172)
    at = dvrk.place(CENTER, dvrk.TO_RIGHT, (0.725, -0.172))
    model.body("stand", at, mesh=folder.add("stand.obj", mesh), compound=shapes, passive=True)
    folder.close()
    robot_files.write(model, models, "ecm")
