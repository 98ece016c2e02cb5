"""Toy car of rigid bodies: motors on the rear wheels, steered knuckles with free wheels in front. Drives along its
+x."""

import math

import mesh_tools as mt
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


def chassis_mesh():
    lower = mt.box(*BODY, 0.010, 0.026, "sky")
    belt = mt.box(BODY[0] + 0.004, BODY[1] + 0.004, 0.007, 0.002, 0.028, "graphite").moved(z=-0.012)
    cabin = (
        mt.extrude(
            mt.rounded_outline(
                [(-0.062, -0.018), (0.078, -0.018), (0.038, 0.018), (-0.050, 0.018)], [0.004, 0.006, 0.012, 0.012], 5
            ),
            CABIN[1],
            0.008,
            color="night",
        )
        .turned([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
        .moved(*CABIN_AT)
    )
    roof = mt.box(0.062, 0.058, 0.004, 0.0015, 0.010, "sky").moved(-0.027, 0.0, 0.0525)
    parts = [lower, belt, cabin, roof]
    for side in (-1.0, 1.0):
        lamp = mt.cylinder(0.0085, 0.008, 0.003, 24, "shell").along("x").moved(0.133, side * 0.033, 0.003)
        tail = mt.box(0.005, 0.02, 0.008, 0.0015, color="coral").moved(-0.134, side * 0.034, 0.004)
        parts += [lamp, tail]
        for x in (-HALF_BASE, HALF_BASE):
            axle = (
                mt.cylinder(0.005, 0.03, 0.001, 16, "steel")
                .along("y")
                .moved(x, side * 0.05, WHEEL_RADIUS - BODY_HEIGHT)
            )
            arch = mt.arc_band(0.040, 0.044, 0.046, math.radians(12), math.radians(168), 16, "sky").moved(
                x, side * (HALF_TRACK - 0.007), WHEEL_RADIUS - BODY_HEIGHT
            )
            parts += [axle, arch]
    return mt.joined(parts)


def wheel_mesh():
    tire = mt.lathe(
        mt.rounded_profile(
            [(0.020, -0.013), (0.035, -0.013), (0.035, 0.013), (0.020, 0.013), (0.020, -0.013)],
            [0, 0.006, 0.006, 0.001, 0],
            3,
        ),
        32,
        "rubber",
    )
    rim = mt.lathe(
        mt.rounded_profile([(0, -0.010), (0.0205, -0.010), (0.0205, 0.010), (0, 0.010)], [0, 0.002, 0.002, 0], 2),
        28,
        "shell",
    )
    spokes = []
    for k in range(5):
        spoke = mt.box(0.012, 0.005, 0.022, 0.001, color="slate", segments=2).moved(x=0.012)
        spokes.append(spoke.turned(mt.rotation_about("z", 2 * math.pi * k / 5)))
    hub = mt.cylinder(0.006, 0.0245, 0.001, 20, "slate")
    return mt.joined([tire, rim, hub] + spokes).along("y")


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
