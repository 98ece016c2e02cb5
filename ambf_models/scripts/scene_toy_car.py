"""Toy car of rigid bodies: motors on the rear wheels, steered knuckles with free wheels in front. Drives along its
+x."""

import math

import mesh_tools as mt
import outlines
from adf_writer import (
    PASSIVE,
    Model,
    box_inertia,
    combined_inertia,
    cylinder_inertia,
    placed,
    shape_box,
    shape_round,
    velocity_servo,
)
from mesh_folder import MeshFolder

WHEEL_RADIUS, WHEEL_WIDTH, WHEEL_MASS = 0.035, 0.026, 0.09
HALF_BASE, HALF_TRACK = 0.095, 0.078
KNUCKLE_MASS = 0.05
BODY = (0.27, 0.104, 0.038)
BODY_HEIGHT = 0.055  # of the body's middle, which is the chassis frame
CABIN = (0.125, 0.088, 0.036)
CABIN_AT = (-0.02, 0.0, 0.034)
CHASSIS_MASS = 0.9
HEADING = math.pi / 4  # at home


def along_y(outline, width, bevel, color, steps=4):
    """A side view (x, z) of the given width, its edges rounded."""
    return mt.extrude(outline, width, bevel, steps, color).turned([[1, 0, 0], [0, 0, -1], [0, 1, 0]])


def tub_outline(grow=0.0):
    """Side view of the body from the sills to the shoulders: a low bonnet, a high tail."""
    corners = [(-0.132, -0.017), (0.128, -0.017), (0.134, -0.004), (0.118, 0.011), (0.060, 0.019), (-0.126, 0.019)]
    outline = outlines.rounded_outline(corners, [0.010, 0.008, 0.010, 0.014, 0.05, 0.012], 5)
    return outlines.inset(outline, -grow) if grow else outline


def chassis_mesh():
    tub = along_y(tub_outline(), BODY[1], 0.009, "coral", 5)
    sill = along_y(
        outlines.rounded_outline([(-0.134, -0.021), (0.136, -0.021), (0.136, -0.012), (-0.134, -0.012)], 0.004, 3),
        BODY[1] + 0.003,
        0.003,
        "graphite",
        2,
    )
    cabin = along_y(
        outlines.rounded_outline(
            [(-0.088, 0.010), (0.064, 0.010), (0.024, 0.050), (-0.060, 0.050)], [0.004, 0.006, 0.016, 0.018], 6
        ),
        CABIN[1] - 0.004,
        0.012,
        "tinted",
        5,
    )
    roof = along_y(
        outlines.rounded_outline(
            [(-0.062, 0.0455), (0.026, 0.0455), (0.021, 0.0525), (-0.056, 0.0525)], [0.002, 0.002, 0.006, 0.006], 3
        ),
        CABIN[1] - 0.022,
        0.003,
        "coral",
        3,
    )
    stripe = along_y(
        outlines.rounded_outline(
            [(-0.058, 0.0460), (0.022, 0.0460), (0.018, 0.0531), (-0.053, 0.0531)], [0.002, 0.002, 0.006, 0.006], 3
        ),
        0.016,
        0.0005,
        "ivory",
        1,
    )
    parts = [tub, sill, cabin, roof, stripe]
    for side in (-1.0, 1.0):
        bezel = mt.cylinder(0.0100, 0.010, 0.002, 28, "graphite").along("x").moved(0.1265, side * 0.034, 0.0)
        lamp = mt.cylinder(0.0080, 0.004, 0.0016, 24, "lamp").along("x").moved(0.1315, side * 0.034, 0.0)
        tail = mt.box(0.005, 0.024, 0.008, 0.0018, color="night", segments=2).moved(-0.1318, side * 0.030, 0.006)
        mirror = mt.box(0.008, 0.012, 0.007, 0.002, color="graphite").moved(0.036, side * 0.050, 0.026)
        parts += [bezel, lamp, tail, mirror]
        for x in (-HALF_BASE, HALF_BASE):
            axle = (
                mt.cylinder(0.005, 0.03, 0.001, 16, "steel")
                .along("y")
                .moved(x, side * 0.05, WHEEL_RADIUS - BODY_HEIGHT)
            )
            arch = mt.arc_band(0.0395, 0.0425, 0.034, math.radians(14), math.radians(166), 20, "coral").moved(
                x, side * (HALF_TRACK - 0.009), WHEEL_RADIUS - BODY_HEIGHT
            )
            parts += [axle, arch]
    grille = mt.box(0.006, 0.038, 0.010, 0.0015, color="graphite", segments=2).moved(0.1305, 0, -0.003)
    plate = mt.box(0.003, 0.034, 0.009, 0.0006, color="ivory", segments=1).moved(-0.1332, 0, -0.006)
    return mt.joined([*parts, grille, plate])


def wheel_mesh():
    """A tyre with a groove and a tread, a dished rim with five spokes on either side."""
    profile = [(0.0225, -0.0105), (0.027, -0.0130), (0.033, -0.0120), (0.035, -0.0090), (0.035, -0.0012), (0.0342, 0.0)]
    profile += [(r, -z) for r, z in reversed(profile[:-1])]
    tyre = mt.lathe(
        mt.rounded_profile([*profile, profile[0]], [0, 0.002, 0.002, 0.002, 0, 0, 0, 0.002, 0.002, 0.002, 0, 0], 2),
        44,
        "rubber",
    )
    rim_profile = [
        (0.0205, -0.0112),
        (0.0232, -0.0112),
        (0.0232, 0.0112),
        (0.0205, 0.0112),
        (0.0192, 0.0),
        (0.0205, -0.0112),
    ]
    rim = mt.lathe(mt.rounded_profile(rim_profile, [0, 0.0006, 0.0006, 0, 0.002, 0], 2), 36, "aluminium")
    disc = mt.cylinder(0.0196, 0.004, 0.0, 28, "graphite")
    spokes = []
    for k in range(5):
        spoke = mt.box(0.0165, 0.0052, 0.0170, 0.0014, color="aluminium", segments=2).moved(x=0.0118)
        spokes.append(spoke.turned(mt.rotation_about("z", 2 * math.pi * k / 5)))
    hub = mt.cylinder(0.0058, 0.0215, 0.0015, 24, "aluminium")
    cap = mt.cylinder(0.0034, 0.0226, 0.0006, 20, "coral")
    return mt.joined([tyre, rim, disc, hub, cap, *spokes]).along("y")


def build(models):
    folder = MeshFolder(models, "toy_car")
    folder.add("chassis.obj", chassis_mesh())
    folder.add("wheel.obj", wheel_mesh())
    folder.add(
        "knuckle.obj", mt.cylinder(0.007, 0.026, 0.002, 20, "steel") + mt.box(0.012, 0.022, 0.012, 0.002, color="steel")
    )
    folder.close()

    model = Model(
        "Toy car. rear_left_motor and rear_right_motor take wheel speeds (rad/s, positive is forwards), steer_left\n"
        "and steer_right angles (rad, positive is to the left).",
        namespace="/ambf/env/toy_car/",
        meshes=folder.seen_from(3),
        **{"ignore inter-collision": True},
    )
    c, s = math.cos(HEADING), math.sin(HEADING)

    def world(x, y, z):
        """From the car's axes (x forwards, y left, z up, on the floor under the chassis) to the world."""
        return (c * x - s * y, s * x + c * y, z)

    mass, com, inertia = combined_inertia(
        [(0.7, (0, 0, -0.004), box_inertia(0.7, *BODY)), (0.2, CABIN_AT, box_inertia(0.2, *CABIN))]
    )
    turned = (0.0, 0.0, HEADING)
    model.body(
        "chassis",
        world(0, 0, BODY_HEIGHT),
        turned,
        mass=mass,
        com=com,
        inertia=inertia,
        mesh="chassis.obj",
        compound=[placed(shape_box(*BODY), (0, 0, 0)), placed(shape_box(*CABIN), CABIN_AT)]
        + [placed(shape_box(0.06, 2 * HALF_TRACK + 0.032, 0.004), (x, 0, 0.021)) for x in (-HALF_BASE, HALF_BASE)],
        **{"publish children names": True},
    )
    left_axis, up = world(0, 1, 0), (0.0, 0.0, 1.0)
    wheel_inertia = cylinder_inertia(WHEEL_MASS, WHEEL_RADIUS, WHEEL_WIDTH, "y")
    for end, x in (("front", HALF_BASE), ("rear", -HALF_BASE)):
        for side, sign in (("left", 1.0), ("right", -1.0)):
            centre = world(x, sign * HALF_TRACK, WHEEL_RADIUS)
            wheel, carrier = f"{end}_{side}_wheel", "chassis"
            if end == "front":
                carrier = f"{side}_knuckle"
                post = world(x, sign * (HALF_TRACK - 0.022), WHEEL_RADIUS)
                model.body(
                    carrier,
                    post,
                    turned,
                    mass=KNUCKLE_MASS,
                    inertia=box_inertia(KNUCKLE_MASS, 0.02, 0.022, 0.026),
                    mesh="knuckle.obj",
                    shape=(shape_round("CYLINDER", 0.007, 0.026), (0, 0, 0), (0, 0, 0)),
                )
                model.joint(
                    f"steer_{side}",
                    "revolute",
                    "chassis",
                    carrier,
                    post,
                    up,
                    limits=(-0.5, 0.5),
                    damping=0.002,
                    **velocity_servo(20.0, 1e-3),
                )
            model.body(
                wheel,
                centre,
                turned,
                mass=WHEEL_MASS,
                inertia=wheel_inertia,
                mesh="wheel.obj",
                friction=(1.0, 0.002),
                shape=(shape_round("CYLINDER", WHEEL_RADIUS, WHEEL_WIDTH, "y"), (0, 0, 0), (0, 0, 0)),
            )
            motor = velocity_servo(10.0, 3e-4) if end == "rear" else PASSIVE
            model.joint(
                f"{end}_{side}_{'motor' if end == 'rear' else 'axle'}",
                "continuous",
                carrier,
                wheel,
                centre,
                left_axis,
                damping=1e-4,
                **motor,
            )
    model.write(models / "descriptions" / "multi-bodies" / "vehicles" / "toy_car.yaml")
