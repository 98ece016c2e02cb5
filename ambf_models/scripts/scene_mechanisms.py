"""Closed loops: a four-bar linkage and a Stewart platform."""

import math

import mesh_tools as mt
from adf_writer import PASSIVE, Model, box_inertia, cylinder_inertia, placed, shape_box, shape_round, velocity_servo
from mesh_folder import MeshFolder

# --- four-bar: a Grashof crank-rocker (0.10 + 0.30 < 0.28 + 0.22), so the crank turns all the way r

GROUND, CRANK, COUPLER, ROCKER = 0.30, 0.10, 0.28, 0.22  # m
PIVOT_HEIGHT = 0.20
CRANK_HOME = math.radians(60.0)
BAR = {
    "crank": (CRANK, 0.016, 0.018, 0.12),
    "coupler": (COUPLER, 0.016, 0.036, 0.26),
    "rocker": (ROCKER, 0.016, 0.018, 0.21),
}  # length, half width, x of its middle plane (all m), mass kg
THICKNESS = 0.014


def bar_mesh(length, half_width, color, x):
    """Bar along +y from the frame's origin, its middle plane at x = 0, with pins that reach back to the plate behind
    it."""
    plate = mt.extrude(mt.stadium(length, half_width), THICKNESS, 0.003, color=color).along("x")
    boss = mt.cylinder(0.010, THICKNESS + 0.006, 0.002, 24, "steel").along("x")
    return mt.joined([plate, boss, boss.moved(y=length)])


def stand_mesh():
    plate = mt.box(0.16, 0.46, 0.02, 0.004, 0.016, "graphite").moved(z=0.01)
    parts = [plate]
    for y in (-GROUND / 2, GROUND / 2):
        pylon = mt.extrude(
            mt.rounded_outline(
                [
                    (0.0, -0.032),
                    (PIVOT_HEIGHT + 0.02 - 0.012, -0.02),
                    (PIVOT_HEIGHT + 0.02 - 0.012, 0.02),
                    (0.0, 0.032),
                ],
                [0.001, 0.0195, 0.0195, 0.001],
                8,
            ),
            0.02,
            0.003,
            color="slate",
        )
        # outline x is height, y stays: turn so that x -> z, y -> y, plate normal -> -x
        pylon = pylon.turned([[0, 0, -1], [0, 1, 0], [1, 0, 0]]).moved(x=-0.012, y=y, z=0.012)
        pin = mt.cylinder(0.008, 0.05, 0.002, 24, "steel").along("x").moved(x=0.004, y=y, z=PIVOT_HEIGHT)
        parts += [pylon, pin]
    return mt.joined(parts)


def loop_points():
    """World (y, z) of the four pivots at home: A ground-crank, B crank-coupler, C coupler-rocker, D ground-rocker."""
    a, d = (-GROUND / 2, PIVOT_HEIGHT), (GROUND / 2, PIVOT_HEIGHT)
    b = (a[0] + CRANK * math.cos(CRANK_HOME), a[1] + CRANK * math.sin(CRANK_HOME))
    dy, dz = d[0] - b[0], d[1] - b[1]
    distance = math.hypot(dy, dz)
    along = (COUPLER**2 - ROCKER**2 + distance**2) / (2 * distance)
    across = math.sqrt(COUPLER**2 - along**2)
    c = (b[0] + (along * dy - across * dz) / distance, b[1] + (along * dz + across * dy) / distance)
    return a, b, c, d


def build_four_bar(models):
    folder = MeshFolder(models, "four_bar")
    folder.add("stand.obj", stand_mesh())
    for name, color in (("crank", "coral"), ("coupler", "shell"), ("rocker", "teal")):
        length, half_width, x, _ = BAR[name]
        folder.add(f"{name}.obj", bar_mesh(length, half_width, color, x))
    folder.close()

    model = Model(
        "Four-bar linkage (crank-rocker) that closes exactly. The crank has the motor and no limits,\n"
        "the other pins are free.",
        namespace="/ambf/env/four_bar/",
        meshes=folder.seen_from(3),
        **{"ignore inter-collision": True},
    )
    model.body(
        "base",
        mesh="stand.obj",
        compound=[placed(shape_box(0.16, 0.46, 0.02), (0, 0, 0.01))]
        + [
            placed(shape_box(0.02, 0.05, PIVOT_HEIGHT), (-0.012, y, 0.01 + PIVOT_HEIGHT / 2))
            for y in (-GROUND / 2, GROUND / 2)
        ],
        **{"publish children names": True},
    )
    a, b, c, d = loop_points()
    for name, start, end in (("crank", a, b), ("coupler", b, c), ("rocker", d, c)):
        length, half_width, x, mass = BAR[name]
        angle = math.atan2(end[1] - start[1], end[0] - start[0])
        whole = length + 2 * half_width
        model.body(
            name,
            (x, start[0], start[1]),
            (angle, 0, 0),
            mass=mass,
            com=(0, length / 2, 0),
            mesh=f"{name}.obj",
            inertia=box_inertia(mass, THICKNESS, whole, 2 * half_width),
            shape=(shape_box(THICKNESS, whole, 2 * half_width), (0, length / 2, 0), (0, 0, 0)),
        )
    x_axis = (1.0, 0.0, 0.0)
    model.joint(
        "base-crank",
        "continuous",
        "base",
        "crank",
        (0.018, *a),
        x_axis,
        home=CRANK_HOME,
        damping=0.01,
        **velocity_servo(20.0, 5e-3),
    )
    model.joint("crank-coupler", "continuous", "crank", "coupler", (0.027, *b), x_axis, damping=0.002, **PASSIVE)
    model.joint(
        "base-rocker",
        "revolute",
        "base",
        "rocker",
        (0.018, *d),
        x_axis,
        home=math.atan2(c[1] - d[1], c[0] - d[0]),
        limits=(0.2, 3.0),
        damping=0.002,
        **PASSIVE,
    )
    model.joint("coupler-rocker", "continuous", "coupler", "rocker", (0.027, *c), x_axis, damping=0.002, **PASSIVE)
    model.write(models / "descriptions" / "multi-bodies" / "mechanisms" / "four_bar.yaml")


# --- Stewart platform: six legs, each a universal joint at the base, a slide, and a ball under the

BASE_RADIUS, BASE_JOINT_HEIGHT = 0.18, 0.052
TOP_RADIUS, TOP_JOINT_HEIGHT = 0.11, 0.30
PAIR_HALF_ANGLE = math.radians(12.0)
PLATE_HEIGHT = 0.03  # of the platform's frame (its middle) above the balls
LOWER_LENGTH, LOWER_RADIUS, UPPER_LENGTH, UPPER_RADIUS = 0.165, 0.014, 0.17, 0.0085
STROKE = 0.04  # either way from home


def leg_ends():
    """Six (base point, platform point) pairs in the world."""
    legs = []
    for k in range(3):
        middle = 2.0 * math.pi * k / 3.0
        for side in (-1.0, 1.0):
            base_angle = middle + side * PAIR_HALF_ANGLE
            top_angle = middle + side * (math.pi / 3.0 - PAIR_HALF_ANGLE)
            legs.append(
                (
                    (BASE_RADIUS * math.cos(base_angle), BASE_RADIUS * math.sin(base_angle), BASE_JOINT_HEIGHT),
                    (TOP_RADIUS * math.cos(top_angle), TOP_RADIUS * math.sin(top_angle), TOP_JOINT_HEIGHT),
                )
            )
    return legs


def stewart_meshes(folder, legs):
    base = mt.lathe(
        mt.rounded_profile(
            [(0, 0), (0.225, 0), (0.225, 0.028), (0.13, 0.028), (0.12, 0.018), (0, 0.018)],
            [0, 0.003, 0.006, 0.003, 0.003, 0],
            2,
        ),
        48,
        "graphite",
    )
    ring = mt.torus(0.225, 0.002, 48, 6, "teal").moved(z=0.014)
    posts = [mt.cylinder(0.011, 0.024, 0.002, 16, "steel").moved(*start[:2], z=0.034) for start, _ in legs]
    folder.add("base.obj", mt.joined([base, ring] + posts))
    top = mt.lathe(
        mt.rounded_profile(
            [(0, -0.009), (0.125, -0.009), (0.135, 0.0), (0.135, 0.009), (0, 0.009)], [0, 0.004, 0.004, 0.003, 0]
        ),
        48,
        "shell",
    )
    mark = mt.tube(0.075, 0.069, 0.003, 0.001, 48, "teal").moved(z=0.009)
    posts = [mt.cylinder(0.009, 0.024, 0.002, 16, "steel").moved(end[0], end[1], -0.018) for _, end in legs]
    folder.add("platform.obj", mt.joined([top, mark] + posts))
    folder.add(
        "cross.obj",
        mt.joined(
            [
                mt.cylinder(0.0055, 0.036, 0.001, 12, "steel").along("x"),
                mt.cylinder(0.0055, 0.036, 0.001, 12, "steel").along("y"),
                mt.box(0.018, 0.018, 0.018, 0.003, color="steel"),
            ]
        ),
    )
    barrel = mt.lathe(
        mt.rounded_profile(
            [(0, 0.004), (0.009, 0.004), (LOWER_RADIUS, 0.022), (LOWER_RADIUS, LOWER_LENGTH), (0, LOWER_LENGTH)],
            [0, 0.003, 0.006, 0.003, 0],
        ),
        24,
        "slate",
    )
    cap = mt.lathe(
        mt.rounded_profile(
            [
                (0, LOWER_LENGTH - 0.014),
                (0.0155, LOWER_LENGTH - 0.014),
                (0.0155, LOWER_LENGTH - 0.004),
                (0, LOWER_LENGTH - 0.004),
            ],
            [0, 0.001, 0.001, 0],
        ),
        24,
        "teal",
    )
    folder.add("lower.obj", barrel + cap)
    rod = mt.cylinder(UPPER_RADIUS, UPPER_LENGTH - 0.006, 0.001, 20, "steel").moved(z=-UPPER_LENGTH / 2 - 0.003)
    ball = mt.lathe(
        [
            (0.0125 * math.sin(math.pi * k / 8) if 0 < k < 8 else 0.0, -0.0125 * math.cos(math.pi * k / 8))
            for k in range(9)
        ],
        20,
        "graphite",
    )
    folder.add("upper.obj", rod + ball)


def build_stewart(models):
    legs = leg_ends()
    folder = MeshFolder(models, "stewart_platform")
    stewart_meshes(folder, legs)
    folder.close()

    model = Model(
        "Stewart platform: six legs, each universal joint (two revolutes), slide with motor, ball (p2p).\n"
        "Leg values are 0 at home.",
        namespace="/ambf/env/stewart/",
        meshes=folder.seen_from(3),
        **{"ignore inter-collision": True},
    )
    model.body(
        "base",
        mesh="base.obj",
        shape=(shape_round("CYLINDER", 0.225, 0.028), (0, 0, 0.014), (0, 0, 0)),
        **{"publish children names": True},
    )
    plate_at = (0.0, 0.0, TOP_JOINT_HEIGHT + PLATE_HEIGHT)
    model.body(
        "platform",
        plate_at,
        mass=1.2,
        inertia=cylinder_inertia(1.2, 0.135, 0.018),
        mesh="platform.obj",
        shape=(shape_round("CYLINDER", 0.135, 0.018), (0, 0, 0), (0, 0, 0)),
    )
    for k, (start, end) in enumerate(legs):
        direction = [b - a for a, b in zip(start, end, strict=True)]
        yaw = math.atan2(direction[1], direction[0])
        turned = (0.0, math.atan2(math.hypot(direction[0], direction[1]), direction[2]), yaw)
        n = k + 1
        model.body(
            f"cross{n}",
            start,
            turned,
            mass=0.06,
            inertia=box_inertia(0.06, 0.024, 0.024, 0.024),
            mesh="cross.obj",
            shape=(shape_box(0.036, 0.036, 0.018), (0, 0, 0), (0, 0, 0)),
            passive=True,
        )
        model.body(
            f"lower{n}",
            start,
            turned,
            mass=0.3,
            com=(0, 0, LOWER_LENGTH / 2),
            mesh="lower.obj",
            inertia=cylinder_inertia(0.3, LOWER_RADIUS, LOWER_LENGTH),
            shape=(shape_round("CYLINDER", LOWER_RADIUS, LOWER_LENGTH), (0, 0, LOWER_LENGTH / 2), (0, 0, 0)),
        )
        model.body(
            f"upper{n}",
            end,
            turned,
            mass=0.12,
            com=(0, 0, -UPPER_LENGTH / 2),
            mesh="upper.obj",
            inertia=cylinder_inertia(0.12, UPPER_RADIUS, UPPER_LENGTH),
            shape=(shape_round("CYLINDER", UPPER_RADIUS, UPPER_LENGTH), (0, 0, -UPPER_LENGTH / 2), (0, 0, 0)),
        )
        across = (-math.sin(yaw), math.cos(yaw), 0.0)
        other = (math.cos(turned[1]) * math.cos(yaw), math.cos(turned[1]) * math.sin(yaw), -math.sin(turned[1]))
        model.joint(
            f"base-cross{n}",
            "revolute",
            "base",
            f"cross{n}",
            start,
            across,
            limits=(-0.7, 0.7),
            damping=0.002,
            **PASSIVE,
        )
        model.joint(
            f"cross-lower{n}",
            "revolute",
            f"cross{n}",
            f"lower{n}",
            start,
            other,
            limits=(-0.7, 0.7),
            damping=0.002,
            **PASSIVE,
        )
        model.joint(
            f"leg{n}",
            "prismatic",
            f"lower{n}",
            f"upper{n}",
            end,
            direction,
            limits=(-STROKE, STROKE),
            damping=2.0,
            **velocity_servo(20.0, 0.2),
        )
        model.joint(f"upper{n}-platform", "p2p", f"upper{n}", "platform", end, direction, **PASSIVE)
    model.write(models / "descriptions" / "multi-bodies" / "mechanisms" / "stewart_platform.yaml")


def build(models):
    build_four_bar(models)
    build_stewart(models)
