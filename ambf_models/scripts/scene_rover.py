"""Rover: a chassis on four wheels of the raycast kind, with soft springs. Drives along its +x."""

import mesh_tools as mt
import scene_toy_car
from adf_writer import Model, box_inertia, cylinder_inertia, placed, shape_box, shape_round
from mesh_folder import MeshFolder

RADIUS, REST = 0.11, 0.12  # m, of a wheel and of its suspension without load
HALF_BASE, HALF_TRACK = 0.30, 0.22
TUB = (0.70, 0.28, 0.10)
MASS, STIFFNESS = 12.0, 70.0  # kg, 1/s^2
SINK = 9.8 / (4 * STIFFNESS)  # m, under its own weight
HEIGHT = RADIUS + REST - SINK  # of the chassis frame, where the suspensions hang


def chassis_mesh():
    tub = mt.box(*TUB, 0.012, color="ivory", segments=3)
    deck = mt.box(0.50, 0.26, 0.012, 0.004, color="graphite").moved(z=0.056)
    mast = mt.cylinder(0.012, 0.22, 0.003, 24, "aluminium").moved(0.20, 0.0, 0.17)
    head = mt.box(0.05, 0.11, 0.05, 0.010, color="coral").moved(0.20, 0.0, 0.29)
    parts = [tub, deck, mast, head]
    for side in (-1.0, 1.0):
        parts.append(mt.cylinder(0.013, 0.012, 0.002, 24, "lamp").along("x").moved(0.226, side * 0.028, 0.29))
        parts.append(mt.box(0.20, 0.11, 0.004, 0.001, color="night").moved(-0.13, side * 0.065, 0.064))
        for x in (-HALF_BASE, HALF_BASE):
            reach = HALF_TRACK - TUB[1] / 2
            parts.append(
                mt.cylinder(0.014, reach, 0.002, 20, "steel").along("y").moved(x, side * (TUB[1] + reach) / 2, 0.0)
            )
    return mt.joined(parts)


def wheel_mesh():
    """The toy car's, larger and wider."""
    mesh = scene_toy_car.wheel_mesh()
    factor = RADIUS / scene_toy_car.WHEEL_RADIUS
    mesh.vertices = mesh.vertices * (factor, 1.15 * factor, factor)
    return mesh


def wheel(body, x, y):
    return {
        "body": f"BODY {body}",
        "radius": RADIUS,
        "width": 0.09,
        "offset": {"x": x, "y": y, "z": 0.0},
        "down direction": {"x": 0.0, "y": 0.0, "z": -1.0},
        "axel direction": {"x": 0.0, "y": -1.0, "z": 0.0},
        "suspension": {"stiffness": STIFFNESS, "damping": 7.0, "compression": 5.0, "rest length": REST},
        "friction": 1.2,
        "roll influence": 0.3,
        "front": x > 0.0,
        "steering limits": {"low": -0.45, "high": 0.45} if x > 0.0 else {"low": 0.0, "high": 0.0},
        "max engine power": 20.0,
        "max brake power": 40.0,
    }


def build(models):
    folder = MeshFolder(models, "rover")
    folder.add("chassis.obj", chassis_mesh())
    folder.add("wheel.obj", wheel_mesh())
    folder.close()

    model = Model(
        "Rover on four wheels. VehicleCmd to `rover`: wheels 0 and 1 steer (rad, positive is to the left), all are\n"
        "driven and braked (N). docs/vehicles.md",
        namespace="/ambf/env/",
        meshes=folder.seen_from(3),
    )
    model.body(
        "rover_chassis",
        (0, 0, HEIGHT),
        mass=MASS,
        inertia=box_inertia(MASS, *TUB),
        mesh="chassis.obj",
        compound=[placed(shape_box(*TUB), (0, 0, 0)), placed(shape_box(0.06, 0.12, 0.27), (0.20, 0, 0.18))],
        damping=(0.0, 0.0),
    )
    wheels = []
    for end, x in (("front", HALF_BASE), ("rear", -HALF_BASE)):
        for side, y in (("left", HALF_TRACK), ("right", -HALF_TRACK)):
            name = f"{end}_{side}_wheel"
            model.body(
                name,
                (x, y, RADIUS),
                mass=0.8,
                inertia=cylinder_inertia(0.8, RADIUS, 0.09, "y"),
                mesh="wheel.obj",
                shape=(shape_round("CYLINDER", RADIUS, 0.09, "y"), (0, 0, 0), (0, 0, 0)),
            )
            wheels.append(wheel(name, x, y))
    model.vehicle("rover", "rover_chassis", wheels)
    model.write(models / "descriptions" / "multi-bodies" / "vehicles" / "rover.yaml")
