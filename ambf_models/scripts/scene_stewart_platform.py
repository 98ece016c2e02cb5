"""Stewart platform: six legs, each a universal joint at the base, a slide, and a ball under the platform."""

import math

import mesh_tools as mt
import numpy as np
import outlines
from adf_writer import PASSIVE, Model, box_inertia, cylinder_inertia, shape_box, shape_round, velocity_servo
from lettering import Canvas
from mesh_folder import MeshFolder

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


PLATFORM_RADIUS = 0.135


def platform_print():
    """A turntable's scale: degrees about the platform's z axis, 0 towards +x."""
    side = 2 * PLATFORM_RADIUS
    canvas = Canvas(side, side, 3600, (226, 226, 223))
    ink = (52, 62, 72)
    for k in range(0, 360, 2):
        # x of the world is down on the print, y to its right
        c, s = math.sin(math.radians(k)), -math.cos(math.radians(k))
        low = 0.104 if k % 30 == 0 else 0.108 if k % 10 == 0 else 0.111
        canvas.stroke([(low * c, low * s), (0.115 * c, 0.115 * s)], 0.0011 if k % 30 == 0 else 0.0006, ink, 0.85)
        if k % 30 == 0:
            canvas.text(str(k), 0.093 * c, 0.093 * s, 0.0085, ink, 0.9, up=(-c, -s))
    for radius in (0.04, 0.075):
        canvas.paint(np.abs(canvas.disc(0, 0, radius)) - 0.0006, (34, 122, 128), 0.9)
    for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        canvas.stroke([(0.012 * c, 0.012 * s), (0.075 * c, 0.075 * s)], 0.0006, (34, 122, 128), 0.9)
    for k in range(6):
        a = math.radians(30 + 60 * k)
        canvas.paint(canvas.disc(0.0575 * math.cos(a), 0.0575 * math.sin(a), 0.0034), (96, 102, 108))
    return canvas


def fork(half_gap, reach, radius, thickness, color):
    """Two cheeks along +z on either side of the origin in y, round about the y axis."""
    cheek = mt.extrude(outlines.stadium(reach, radius, 8), thickness, 0.0008, 2, color).turned(
        [[0, 1, 0], [0, 0, 1], [1, 0, 0]]
    )
    return mt.joined([cheek.moved(y=side * (half_gap + thickness / 2)) for side in (-1, 1)])


def stewart_meshes(folder, legs):
    disc = mt.lathe(
        mt.rounded_profile(
            [(0, 0), (0.225, 0), (0.225, 0.028), (0.13, 0.028), (0.125, 0.020), (0, 0.020)],
            [0, 0.003, 0.005, 0.003, 0.002, 0],
            3,
        ),
        64,
        "graphite",
    )
    inlay = mt.lathe(
        mt.rounded_profile([(0, 0.019), (0.120, 0.019), (0.120, 0.0225), (0, 0.0225)], [0, 0, 0.0008, 0]),
        56,
        "aluminium",
    )
    ring = mt.torus(0.225, 0.0018, 64, 8, "teal").moved(z=0.014)
    parts = [disc, inlay, ring]
    for k in range(12):
        a = 2 * math.pi * (k + 0.5) / 12
        if k % 4 == 1:
            parts.append(mt.screw(0.0055, 0.003).moved(0.212 * math.cos(a), 0.212 * math.sin(a), 0.028))
        parts.append(mt.screw(0.0035, 0.002).moved(0.108 * math.cos(a), 0.108 * math.sin(a), 0.0225))
    for start, end in legs:
        yaw = math.atan2(end[1] - start[1], end[0] - start[0])
        shoe = mt.box(0.036, 0.046, 0.008, 0.0015, 0.004, "aluminium").moved(z=0.031)
        cheeks = (
            fork(0.0095, 0.018, 0.0085, 0.005, "aluminium")
            .turned(mt.rotation_about("x", math.pi))
            .moved(z=BASE_JOINT_HEIGHT)
        )
        parts.append((shoe + cheeks).turned(mt.rotation_about("z", yaw)).moved(*start[:2]))
    folder.add("base.obj", mt.joined(parts))
    top = mt.lathe(
        mt.rounded_profile(
            [(0, -0.009), (0.120, -0.009), (PLATFORM_RADIUS, 0.002), (PLATFORM_RADIUS, 0.009), (0, 0.009)],
            [0, 0.004, 0.006, 0.002, 0],
            4,
        ),
        64,
        "shell",
    )
    folder.print("platform_print", platform_print())
    top = top.printed("platform_print", 2 * PLATFORM_RADIUS, 2 * PLATFORM_RADIUS)
    cup = mt.lathe(
        mt.rounded_profile(
            [
                (0.0122, -0.031),
                (0.0145, -0.031),
                (0.0145, -0.018),
                (0.011, -0.006),
                (0, -0.006),
                (0, -0.017),
                (0.0122, -0.024),
                (0.0122, -0.031),
            ],
            [0, 0.0008, 0.003, 0, 0, 0, 0, 0],
        ),
        24,
        "aluminium",
    )
    cups = [cup.moved(end[0], end[1]) for _, end in legs]
    folder.add("platform.obj", mt.joined([top, *cups]))
    folder.add(
        "cross.obj",
        mt.joined(
            [
                mt.cylinder(0.0048, 0.036, 0.0008, 18, "steel").along("x"),
                mt.cylinder(0.0048, 0.036, 0.0008, 18, "steel").along("y"),
                mt.box(0.0165, 0.0165, 0.0165, 0.0025, color="graphite", segments=3),
            ]
        ),
    )
    # The barrel's fork takes the other pin of the cross, along x.
    yoke = fork(0.0095, 0.016, 0.0085, 0.005, "slate").turned(mt.rotation_about("z", math.pi / 2))
    barrel = mt.lathe(
        mt.rounded_profile(
            [(0, 0.014), (0.0145, 0.014), (LOWER_RADIUS, 0.026), (LOWER_RADIUS, LOWER_LENGTH), (0, LOWER_LENGTH)],
            [0, 0.003, 0.004, 0.002, 0],
        ),
        32,
        "slate",
    )
    bands = [
        mt.collar(0.012, 0.0155, LOWER_LENGTH - 0.012, LOWER_LENGTH - 0.004, 0.0006, 32, "teal"),
        mt.collar(0.008, 0.0125, LOWER_LENGTH - 0.001, LOWER_LENGTH + 0.003, 0.001, 32, "aluminium"),
        mt.collar(0.012, 0.0146, 0.034, 0.037, 0.0003, 32, "aluminium"),
    ]
    folder.add("lower.obj", mt.joined([yoke, barrel, *bands]))
    rod = mt.cylinder(UPPER_RADIUS, UPPER_LENGTH - 0.006, 0.001, 24, "steel").moved(z=-UPPER_LENGTH / 2 - 0.003)
    ball = mt.lathe(
        [
            (0.0118 * math.sin(math.pi * k / 12) if 0 < k < 12 else 0.0, -0.0118 * math.cos(math.pi * k / 12))
            for k in range(13)
        ],
        24,
        "brass",
    )
    folder.add("upper.obj", rod + ball)


def build(models):
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
