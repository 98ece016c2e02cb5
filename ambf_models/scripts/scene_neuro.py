"""Robot for needles under MRI, after the neurosurgery robot of Worcester Polytechnic Institute.

Names, order, types, passive marks, masses and home frames are those of the original AMBF's file. Below, two slides on
one carriage raise and move a platform over a scissor of six bars; above, two parallelograms of eight bars with the yaw
link pitch the needle about a remote centre on the yaw axis. Two slides alone leave the scissor's platform free to tilt
(the original's does): a second bar beside `vertical_translation_lin` keeps it level, `vertical_translation_par`, which
is ours and comes last. Lengths are the published ones where they close (0.057 and 0.020 m of the scissor's links,
0.080, 0.178, 0.159 and 0.019 m above; 0.0184 m in the original's file, where the loop jams). Chosen, since no source
has them: motors, inertias (of boxes), shapes, the bar's place.
"""

import math

import dvrk_parts as dvrk
import mesh_tools as mt
import numpy as np
import robot_files
from adf_writer import PASSIVE, Model, vector
from dvrk_parts import Link, servo
from mesh_folder import MeshFolder

HALF = math.pi / 2
FLOOR = -1.65  # m, of the room with the arms of the dVRK
# Planes of the two linkages in the world: (u, v, w) is (y, z, x) below and (x, z, -y) above.
BELOW, ABOVE = dvrk.TO_LEFT, np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
WORLD = np.eye(3)

LEFT, RIGHT = (0.064, 0.062), (-0.100, 0.062)  # (y, z): the scissor's pivots on its slides
LINK, TOP = (0.057, 0.020), 0.050  # along a link at home; between the links on the platform
LEFT_TOP, RIGHT_TOP = (LEFT[0] - LINK[0], LEFT[1] + LINK[1]), (RIGHT[0] + LINK[0], RIGHT[1] + LINK[1])
BESIDE = (0.012, 0.016)  # (y, z) from a link to the bar that keeps the platform level
CENTER = (0.260, -0.065, 0.153)  # the remote centre: yaw axis (along x) and the needle's
PITCH, MIRROR = 0.082, 0.101  # x of the pivots on the yaw link, 0.019 m apart
RISE, SPREAD = 0.080, 0.019  # m: from the pivots up to the follower, and between the followers
FOLLOWER, UPPER = CENTER[2] + RISE, CENTER[2] + RISE + SPREAD  # z
REACH = CENTER[0]  # x of the pivots on the needle driver's base
RAIL_X, RAIL_Y = 0.215, -0.089  # the needle driver's frame

# Names: the original's, which end where its editor cut them.
AXIAL, AXIAL_MIRROR = "axial_translation_link", "axial_translation_mirror"
LATERAL, DRIVER_BASE, DRIVER = "lateral_translation_link", "needle_driver_base_link", "needle_driver_link"
PITCH_FOLLOWER, UPPER_FOLLOWER = "pitch_follower_link", "pitch_mirror_follower_li"
PLATFORM, LIN, MIR, PAR = (f"vertical_translation_{end}" for end in ("fol", "lin", "mir", "par"))

LIMITS = {  # m, rad
    "lateral": (0.0, 0.05),
    "axial": (0.0, 0.1),
    "axial mirror": (-0.1, 0.05),
    "yaw": (-1.134, 1.134),
    "pitch": (-0.7, 0.7),
    "insertion": (0.0, 0.04),
    "rotation": (-1.0472, 1.0472),
    "scissor": (0.0, 1.15),
}
EFFORTS = {  # N, Nm
    "lateral": 150.0,
    "axial": 150.0,
    "axial mirror": 150.0,
    "yaw": 6.0,
    "pitch": 6.0,
    "insertion": 20.0,
    "rotation": 0.5,
}
ORIGINAL_PASSIVE = {  # as in the original's file: without State and Command of their own
    AXIAL,
    AXIAL_MIRROR,
    LATERAL,
    DRIVER_BASE,
    DRIVER,
    PITCH_FOLLOWER,
    "pitch_link",
    UPPER_FOLLOWER,
    "pitch_mirror_link",
    PLATFORM,
    "yaw_link",
}


def below(y, z, x, rpy):
    return Link((y, z, x), rpy, (0, 0, 0), BELOW)


def above(x, z, y, rpy):
    return Link((x, z, -y), rpy, (0, 0, 0), ABOVE)


def world_part(x, y, z, rpy=(0.0, 0.0, 0.0)):
    return Link((x, y, z), rpy, (0, 0, 0), WORLD)


FACING_LEFT, FACING_RIGHT, FACING_BACK = (HALF, 0.0, -HALF), (HALF, 0.0, HALF), (-HALF, math.pi, 0.0)


def ground():
    """Board on the bed that carries all."""
    made = world_part(0, 0, 0)
    made.box((0.015, -0.235, -0.060), (0.435, 0.165, -0.045), 0.006, "graphite")
    return made


def base_link():
    """Frame with the two rails along x, its arch open towards the patient's head."""
    made = world_part(0.281, -0.134, -0.031)
    made.box((0.030, -0.225, -0.045), (0.420, 0.155, -0.033), 0.004, "shell")
    for y in (-0.195, 0.125):
        made.box((0.035, y - 0.016, -0.033), (0.250, y + 0.016, -0.022), 0.003, "slate")
        made.rod((0.040, y, -0.016), (0.245, y, -0.016), 0.006, "steel", 0.0005)
    for y in (-0.215, 0.115):
        made.box((0.250, y, -0.034), (0.275, y + 0.030, -0.006), 0.004, "teal")
    return made


def lateral_link():
    """Carriage on the rails; two rods along y for the scissor's slides."""
    made = world_part(0.129, 0.108, 0.005, (-HALF, 0.0, 0.0))
    made.box((0.078, -0.213, -0.024), (0.150, -0.177, 0.012), 0.004, "graphite")
    made.box((0.078, 0.107, -0.024), (0.150, 0.143, 0.012), 0.004, "graphite")
    made.box((0.078, -0.200, -0.010), (0.150, 0.130, 0.002), 0.003, "aluminium")
    for y in (-0.213, 0.125):
        made.box((0.084, y, 0.000), (0.144, y + 0.018, 0.042), 0.003, "graphite")
    for x in (0.098, 0.130):
        made.rod((x, -0.205, 0.028), (x, 0.135, 0.028), 0.005, "steel", 0.0005)
    return made


def slide(y, sign, frame, rpy):
    """Block on the rods with the clevis of one of the scissor's links; `sign`: on which side of the pivot it is."""
    made = world_part(*frame, rpy)
    low, high = sorted((y - 0.009 * sign, y + 0.030 * sign))
    made.box((0.085, low, 0.016), (0.143, high, 0.042), 0.004, "shell")
    low, high = sorted((y - 0.008 * sign, y + 0.022 * sign))
    for x in (0.090, 0.1225):
        made.box((x - 0.003, low, 0.040), (x + 0.003, high, 0.086 if sign > 0 else 0.071), 0.002, "slate")
    made.rod((0.086, y, 0.062), (0.127, y, 0.062), 0.004, "steel", 0.0004)
    if sign > 0:
        made.rod((0.086, y + BESIDE[0], 0.062 + BESIDE[1]), (0.127, y + BESIDE[0], 0.062 + BESIDE[1]), 0.003, "steel")
    return made


def scissor_link(start, end, x, frame, rpy, width=0.012, color="aluminium"):
    made = below(*frame, rpy)
    made.bar(start, end, width, 0.010, x, color)
    for at in (start, end):
        made.pin(at, 0.35 * width, x - 0.0062, x + 0.0062)
    return made


def platform():
    """What the scissor carries: a plate with the yaw's bearing."""
    made = below(LEFT_TOP[0], LEFT_TOP[1], 0.121, FACING_RIGHT)
    x = 0.1255
    made.bar(RIGHT_TOP, LEFT_TOP, 0.016, 0.006, x, "shell")
    made.bar(LEFT_TOP, (LEFT_TOP[0] + BESIDE[0], LEFT_TOP[1] + BESIDE[1]), 0.012, 0.006, x, "shell", False)
    made.bar(RIGHT_TOP, (CENTER[1], CENTER[2]), 0.022, 0.006, x, "shell")
    made.bar(LEFT_TOP, (CENTER[1], CENTER[2]), 0.018, 0.006, x, "shell")
    for at in (LEFT_TOP, RIGHT_TOP, (LEFT_TOP[0] + BESIDE[0], LEFT_TOP[1] + BESIDE[1])):
        made.pin(at, 0.004, 0.096, 0.131, collides=True)
    made.rod((CENTER[1], CENTER[2], 0.1215), (CENTER[1], CENTER[2], 0.146), 0.019, "graphite", 0.002, True)
    return made


def yaw_link():
    """Turns about x through the remote centre; an arm carries the pivots of the linkage above."""
    made = world_part(0.129, CENTER[1], CENTER[2], FACING_RIGHT)
    made.rod((0.060, CENTER[1], CENTER[2]), (0.1205, CENTER[1], CENTER[2]), 0.015, "slate", 0.002, True)
    made.box((0.064, CENTER[1], CENTER[2] - 0.012), (0.119, -0.040, CENTER[2] + 0.012), 0.004, "slate")
    made.rod((PITCH, -0.045, CENTER[2]), (PITCH, -0.0165, CENTER[2]), 0.0045, "steel", 0.0004, True)
    made.rod((MIRROR, -0.045, CENTER[2]), (MIRROR, -0.026, CENTER[2]), 0.0045, "steel", 0.0004)
    return made


def upper_bar(start, end, y, frame, rpy, width, color):
    """Bar of the linkage above between two points (x, z); `y`: of its middle."""
    made = above(*frame, rpy)
    made.bar(start, end, width, 0.004, -y, color)
    return made


def pitch_link():
    frame = (PITCH, CENTER[2], -0.020)
    made = upper_bar((PITCH, CENTER[2]), (PITCH, FOLLOWER), -0.0205, frame, (HALF, 0, 0), 0.014, "teal")
    made.pin((PITCH, FOLLOWER), 0.0035, 0.0115, 0.0235)
    return made


def mirror_link():
    made = upper_bar(
        (MIRROR, CENTER[2]), (MIRROR, UPPER), -0.030, (MIRROR, CENTER[2], -0.032), FACING_BACK, 0.012, "teal"
    )
    made.pin((MIRROR, FOLLOWER), 0.003, 0.0115, 0.033, collides=True)
    made.pin((MIRROR, UPPER), 0.003, 0.0220, 0.033)
    return made


def pitch_follower():
    return upper_bar(
        (PITCH, FOLLOWER), (REACH, FOLLOWER), -0.0155, (PITCH, FOLLOWER, -0.016), FACING_BACK, 0.010, "aluminium"
    )


def upper_follower():
    return upper_bar((MIRROR, UPPER), (REACH, UPPER), -0.0255, (MIRROR, UPPER, -0.024), FACING_BACK, 0.009, "aluminium")


def driver_base():
    """Plate that both followers keep parallel to the mirror link; rails of the needle driver, a seat of the cannula."""
    made = world_part(REACH, -0.016, FOLLOWER, FACING_BACK)
    made.box((REACH - 0.009, -0.035, FOLLOWER - 0.007), (REACH + 0.009, -0.029, UPPER + 0.007), 0.002, "slate")
    made.box((REACH - 0.016, -0.082, FOLLOWER - 0.008), (REACH + 0.012, -0.034, FOLLOWER + 0.004), 0.003, "slate")
    for z, y in ((FOLLOWER, -0.0115), (UPPER, -0.022)):
        made.rod((REACH, -0.036, z), (REACH, y, z), 0.003, "steel", 0.0003)
    made.box((0.212, -0.092, FOLLOWER - 0.008), (0.245, -0.050, FOLLOWER + 0.010), 0.003, "slate")
    for y in (-0.082, -0.060):
        made.rod((0.226, y, FOLLOWER), (0.226, y, 0.372), 0.0035, "steel", 0.0003)
    made.box((0.214, -0.092, 0.366), (0.238, -0.050, 0.376), 0.003, "graphite")
    return made


def cannula():
    made = world_part(CENTER[0], CENTER[1], 0.226, (math.pi, 0.0, 0.0))
    made.pipe((CENTER[0], CENTER[1], 0.2030), (CENTER[0], CENTER[1], 0.226), 0.0030, 0.0018, "brass")
    return made


def driver():
    """Slide with the drive that turns the needle."""
    made = world_part(RAIL_X, RAIL_Y, 0.289, (0.0, -HALF, -HALF))
    made.box((0.216, -0.092, 0.276), (0.243, -0.050, 0.306), 0.003, "shell")
    made.box((0.240, -0.078, 0.280), (0.252, -0.052, 0.302), 0.002, "shell")
    made.pipe((CENTER[0], CENTER[1], 0.280), (CENTER[0], CENTER[1], 0.302), 0.013, 0.0055, "graphite")
    return made


def needle():
    x, y, z = CENTER
    made = world_part(x, y, z)
    made.rod((x, y, z + 0.004), (x, y, 0.318), 0.0009, "steel", 0.0, True, 12)
    tip = mt.lathe([(0.0, 0.0), (0.0009, 0.004), (0.0, 0.004)], 12, "steel")
    made.shape(tip, np.eye(3), (x, y, z))
    made.rod((x, y, 0.276), (x, y, 0.312), 0.0050, "coral", 0.0008, True, 20)
    return made


# Function that makes the Link; mass (kg), centre of mass in the body frame (m), box with the same inertia (m, body
# axes). Masses and centres are the original's; so is that the ground has none.
BODIES = {
    AXIAL: (
        lambda: slide(LEFT[0], 1, (0.129, 0.072, 0.014), FACING_LEFT),
        (0.067, (0.0, 0.026, 0.015), (0.03, 0.05, 0.05)),
    ),
    AXIAL_MIRROR: (
        lambda: slide(RIGHT[0], -1, (0.108, -0.100, 0.062), FACING_RIGHT),
        (0.067, (-0.010, -0.027, 0.006), (0.03, 0.05, 0.05)),
    ),
    "base_link": (base_link, (6.575, (-0.06, 0.1, 0.005), (0.38, 0.37, 0.05))),
    "cannula": (cannula, (0.002, (0.0, 0.0, 0.0113), (0.006, 0.006, 0.023))),
    LATERAL: (lateral_link, (0.497, (-0.015, 0.005, -0.148), (0.07, 0.04, 0.33))),
    DRIVER_BASE: (driver_base, (0.113, (0.015, 0.017, -0.049), (0.04, 0.12, 0.06))),
    DRIVER: (driver, (0.029, (0.002, 0.019, 0.020), (0.03, 0.03, 0.05))),
    "needle_link": (needle, (0.02, (0.0, 0.0, 0.109), (0.012, 0.012, 0.16))),
    PITCH_FOLLOWER: (pitch_follower, (0.046, (-0.0893, 0.0, 0.0), (0.18, 0.01, 0.006))),
    "pitch_link": (pitch_link, (0.036, (0.0, 0.04, 0.0), (0.014, 0.09, 0.006))),
    UPPER_FOLLOWER: (upper_follower, (0.067, (-0.08, 0.0, 0.0), (0.16, 0.01, 0.006))),
    "pitch_mirror_link": (mirror_link, (0.032, (0.0, 0.0493, 0.0), (0.012, 0.11, 0.006))),
    PLATFORM: (platform, (0.405, (-0.042, 0.033, 0.005), (0.10, 0.10, 0.03))),
    LIN: (
        lambda: scissor_link(LEFT, LEFT_TOP, 0.1075, (LEFT[0], LEFT[1], 0.108), FACING_LEFT),
        (0.011, (0.0285, 0.010, 0.0), (0.06, 0.03, 0.01)),
    ),
    MIR: (
        lambda: scissor_link(RIGHT, RIGHT_TOP, 0.1075, (RIGHT_TOP[0], RIGHT_TOP[1], 0.121), FACING_RIGHT),
        (0.011, (-0.0285, -0.010, -0.0135), (0.06, 0.03, 0.01)),
    ),
    "world": (ground, (0.0, None, None)),
    "yaw_link": (yaw_link, (0.295, (0.010, 0.0, -0.039), (0.04, 0.04, 0.06))),
    PAR: (
        lambda: scissor_link(
            (LEFT[0] + BESIDE[0], LEFT[1] + BESIDE[1]),
            (LEFT_TOP[0] + BESIDE[0], LEFT_TOP[1] + BESIDE[1]),
            0.101,
            (LEFT[0] + BESIDE[0], LEFT[1] + BESIDE[1], 0.101),
            FACING_LEFT,
            0.009,
            "brass",
        ),
        (0.008, (0.0285, 0.010, 0.0), (0.06, 0.03, 0.01)),
    ),
}


def add_joints(model):
    """In the order of the original's file, ours last."""
    x, y, z = (1, 0, 0), (0, 1, 0), (0, 0, 1)

    def back(axis):
        return tuple(-v for v in axis)

    def joint(parent, child, at, axis, kind="revolute", **more):
        model.joint(f"{parent}-{child}", kind, parent, child, at, axis, **more)

    def driven(name):
        return {"limits": LIMITS[name], **servo(EFFORTS[name])}

    def free(limits):
        return {"limits": limits, "damping": 0.0005, **PASSIVE}

    def lower(at, along=0.108):
        return (along, *at)

    up = LIMITS["scissor"]
    joint(AXIAL, LIN, lower(LEFT), back(x), **free((-0.11, 1.15)))
    joint(AXIAL_MIRROR, MIR, lower(RIGHT, 0.084), x, **free((-1.2, 1.2)))
    joint("base_link", LATERAL, (0.129, 0.108, 0.005), x, "prismatic", **driven("lateral"))
    joint(LATERAL, AXIAL, (0.129, 0.072, 0.014), back(y), "prismatic", **driven("axial"))
    joint(LATERAL, AXIAL_MIRROR, (0.117, -0.101, 0.027), y, "prismatic", **driven("axial mirror"))
    joint(DRIVER_BASE, "cannula", (CENTER[0], CENTER[1], 0.226), back(z), "fixed", **PASSIVE)
    joint(DRIVER_BASE, DRIVER, (RAIL_X, RAIL_Y, 0.289), z, "prismatic", **driven("insertion"))
    joint(DRIVER, "needle_link", CENTER, z, **driven("rotation"))
    wide = (-1.0472, 1.0472)
    joint(PITCH_FOLLOWER, DRIVER_BASE, (REACH, -0.016, FOLLOWER), y, **free((-0.75, 0.75)))
    joint(PITCH_FOLLOWER, "pitch_mirror_link", (MIRROR, -0.020, FOLLOWER), y, **free(wide))
    joint("pitch_link", PITCH_FOLLOWER, (PITCH, -0.016, FOLLOWER), y, **free((-0.75, 0.75)))
    joint(UPPER_FOLLOWER, DRIVER_BASE, (REACH, -0.020, UPPER), y, **free(wide))
    joint("pitch_mirror_link", UPPER_FOLLOWER, (MIRROR, -0.024, UPPER), y, **free(wide))
    joint(PLATFORM, MIR, lower(RIGHT_TOP, 0.121), x, **free(up))
    joint(PLATFORM, "yaw_link", (0.129, CENTER[1], CENTER[2]), x, **driven("yaw"))
    joint(LIN, PLATFORM, lower(LEFT_TOP, 0.121), x, **free(up))
    # Turns the other way round than its twin, so its limits here are the original's with the sign changed.
    joint(MIR, AXIAL_MIRROR, lower(RIGHT), x, **free((-up[1], up[0])))
    joint("world", "base_link", (0.281, -0.134, -0.031), z, "fixed")
    joint("yaw_link", "pitch_link", (PITCH, -0.020, CENTER[2]), back(y), **driven("pitch"))
    joint("yaw_link", "pitch_mirror_link", (MIRROR, -0.032, CENTER[2]), y, **free(wide))
    beside = [(at[0] + BESIDE[0], at[1] + BESIDE[1]) for at in (LEFT, LEFT_TOP)]
    joint(AXIAL, PAR, lower(beside[0], 0.101), back(x), **free((-0.2, 1.2)))
    joint(PAR, PLATFORM, lower(beside[1], 0.101), x, **free((-0.2, 1.2)))


def build(models):
    folder = MeshFolder(models, "neuro_robot")
    model = Model(
        "Robot for needles under MRI: a scissor of six bars below, a linkage of eight bars above (docs/models.md).\n"
        "Gravity does not act on it, as in the original's file; its motors keep their last target.",
        namespace="/ambf/env/neuro_robot/",
        meshes=folder.seen_from(3),
        gravity=vector((0, 0, 0)),
        **{"ignore inter-collision": True},
    )
    for name, (make, mass) in BODIES.items():
        made = make()
        mesh = folder.add(f"{name}.obj", made.mesh())
        marks = {"passive": True} if name in ORIGINAL_PASSIVE or name == PAR else {}
        model.body(name, mesh=mesh, **made.entries(*mass), **marks, **{"collision groups": [0]})
    add_joints(model)
    mesh, shapes = dvrk.stand(-0.060 - FLOOR)
    model.body("stand", (0.225, -0.035, -0.060), mesh=folder.add("stand.obj", mesh), compound=shapes, passive=True)
    folder.close()
    robot_files.write(model, models, "neuro_robot")
