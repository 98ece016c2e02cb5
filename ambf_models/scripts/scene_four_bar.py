"""Four-bar: a Grashof crank-rocker (0.10 + 0.30 < 0.28 + 0.22), so the crank turns all the way round."""

import math

import mesh_tools as mt
import numpy as np
import outlines
from adf_writer import PASSIVE, Model, box_inertia, placed, shape_box, velocity_servo
from lettering import Canvas
from mesh_folder import MeshFolder

GROUND, CRANK, COUPLER, ROCKER = 0.30, 0.10, 0.28, 0.22  # m
PIVOT_HEIGHT = 0.20
CRANK_HOME = math.radians(60.0)
BAR = {
    "crank": (CRANK, 0.016, 0.018, 0.12),
    "coupler": (COUPLER, 0.016, 0.036, 0.26),
    "rocker": (ROCKER, 0.016, 0.018, 0.21),
}  # length, half width, x of its middle plane (all m), mass kg
THICKNESS = 0.014


def bar_mesh(length, half_width, color):
    """Slotted bar along +y from the frame's origin, its middle plane at x = 0, with bearings and the screws in them."""
    slot = outlines.stadium(length - 0.060, 0.0065) + np.array([0.030, 0.0])
    plate = mt.extrude_ring(outlines.stadium(length, half_width), slot, THICKNESS, 0.0022, 3, color).along("x")
    parts = [plate]
    for y in (0.0, length):
        bearing = mt.collar(0.004, 0.0105, -THICKNESS / 2 - 0.0022, THICKNESS / 2 + 0.0012, 0.0006, 28, "aluminium")
        parts.append((bearing + mt.screw(0.0062, THICKNESS / 2 + 0.0042)).along("x").moved(y=y))
    return mt.joined(parts)


DIAL = 0.046  # m, radius


def dial_print():
    """Degrees of the crank: 0 along +y, counter-clockwise as seen from +x."""
    canvas = Canvas(2 * DIAL, 2 * DIAL, 6000, (238, 236, 228))
    ink = (52, 62, 72)
    for k in range(0, 360, 5):
        c, s = math.cos(math.radians(k)), math.sin(math.radians(k))
        low = 0.0385 if k % 30 == 0 else 0.0405 if k % 10 == 0 else 0.0420
        canvas.stroke([(low * c, low * s), (0.0436 * c, 0.0436 * s)], 0.0005 if k % 30 == 0 else 0.0003, ink, 0.9)
        if k % 30 == 0:
            canvas.text(str(k), 0.0335 * c, 0.0335 * s, 0.0040, ink, 0.9)
    canvas.paint(np.abs(canvas.disc(0, 0, 0.0262)) - 0.0003, (34, 122, 128), 0.9)
    return canvas


def stand_mesh():
    """Plate with two posts; behind the crank's post its motor, in front of it the dial."""
    parts = [mt.box(0.16, 0.46, 0.02, 0.003, 0.014, "graphite").moved(z=0.01)]
    for x in (-0.064, 0.064):
        for y in (-0.214, 0.214):
            parts.append(mt.screw(0.0065, 0.004).moved(x, y, 0.02))
    top = PIVOT_HEIGHT + 0.024 - 0.012
    outline = [(0.0, -0.034), (top, -0.022), (top, 0.022), (0.0, 0.034)]
    post = mt.extrude(
        outlines.rounded_outline(outline, [0.001, 0.0215, 0.0215, 0.001], 10), 0.02, 0.002, 3, "aluminium"
    )
    # outline x is height, y stays: turn so that x -> z, y -> y, plate normal -> -x
    post = post.turned([[0, 0, -1], [0, 1, 0], [1, 0, 0]]).moved(x=-0.012, z=0.012)
    shoe = mt.box(0.052, 0.092, 0.012, 0.002, 0.006, "aluminium").moved(x=-0.012, z=0.025)
    bolts = [mt.screw(0.0042, 0.003).moved(sx * 0.018 - 0.012, sy * 0.038, 0.031) for sx in (-1, 1) for sy in (-1, 1)]
    pin = mt.cylinder(0.008, 0.05, 0.001, 24, "steel").along("x").moved(x=0.004, z=PIVOT_HEIGHT)
    for y in (-GROUND / 2, GROUND / 2):
        parts += [part.moved(y=y) for part in [post, shoe, pin, *bolts]]
    dial = mt.lathe(
        mt.rounded_profile([(0, 0), (DIAL, 0), (DIAL, 0.003), (0, 0.003)], [0, 0.0004, 0.0008, 0], 2), 56, "shell"
    )
    dial = dial.along("x").printed("dial_print", 2 * DIAL, 2 * DIAL, right=(0, 1, 0), up=(0, 0, 1))
    parts.append(dial.moved(x=-0.0022, y=-GROUND / 2, z=PIVOT_HEIGHT))
    motor = [
        mt.cylinder(0.0235, 0.008, 0.001, 36, "aluminium").moved(z=-0.004),
        mt.cylinder(0.0215, 0.040, 0.0015, 36, "graphite").moved(z=-0.027),
        mt.cylinder(0.0215, 0.008, 0.002, 36, "slate").moved(z=-0.050),
        mt.collar(0.019, 0.0218, -0.020, -0.017, 0.0003, 36, "teal"),
    ]
    parts += [part.along("x").moved(x=-0.0215, y=-GROUND / 2, z=PIVOT_HEIGHT) for part in motor]
    other = mt.cylinder(0.017, 0.007, 0.001, 32, "slate").along("x").moved(x=-0.0245, y=GROUND / 2, z=PIVOT_HEIGHT)
    return mt.joined([*parts, other])


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


def build(models):
    folder = MeshFolder(models, "four_bar")
    folder.print("dial_print", dial_print())
    folder.add("stand.obj", stand_mesh())
    for name, color in (("crank", "coral"), ("coupler", "shell"), ("rocker", "teal")):
        length, half_width, _, _ = BAR[name]
        folder.add(f"{name}.obj", bar_mesh(length, half_width, color))
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
