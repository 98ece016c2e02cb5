"""The original's second toy car: four wheels, each on a sprung strut. Names, order, masses, places, springs and the
wheels' shapes are those of the original's file; the meshes, the chassis' shapes and inertias are ours. It drives along
+x; as in the original, a wheel has the name of the other side from its strut's."""

import math

import mesh_tools as mt
import outlines
from adf_kinematics import rotate, rpy
from adf_writer import Model, addon_gains, box_inertia, cylinder_inertia, placed, shape_box, shape_round
from mesh_folder import MeshFolder
from scene_puzzles import STILL

CHASSIS_AT, CHASSIS_MASS = (-0.27, -0.01, 0.035), 10.0
HULL, HULL_Z = (1.14, 0.34, 0.14), 0.0  # of the chassis' body, in its frame
CABIN, CABIN_AT = (0.52, 0.30, 0.16), (-0.06, 0.0, 0.15)
REAR, FRONT = (0.181, 0.115), (0.1455, 0.092)  # radius and width of wheels
STRUT = 0.030  # radius
# Strut, its place, how it is turned (its x is the way of the spring), half its length, mass, stiffness; wheel, place.
CORNERS = (
    ("ShockBL", (-0.698, 0.291, 0.035), (1.396, -1.396, -1.571), 0.094, 0.2, 1e3, "WheelBR", (-0.699, 0.409, 0.035)),
    ("ShockBR", (-0.698, -0.306, 0.035), (-1.396, -1.396, 1.571), 0.094, 0.2, 1e3, "WheelBL", (-0.702, -0.418, 0.035)),
    ("ShockFL", (0.126, 0.185, 0.035), (-0.452, -1.772, 0.444), 0.117, 0.3, 600.0, "WheelFR", (0.129, 0.289, -0.044)),
    ("ShockFR", (0.126, -0.206, 0.035), (0.452, -1.772, -0.444), 0.117, 0.3, 600.0, "WheelFL", (0.129, -0.310, -0.044)),
)


def side_view(outline, width, bevel, color):
    """A side view (x, z) of the given width."""
    return mt.extrude(outline, width, bevel, 4, color).turned([[1, 0, 0], [0, 0, -1], [0, 1, 0]])


def chassis_mesh():
    half, up = HULL[0] / 2, HULL[2] / 2
    tub = [(-half, -up), (half - 0.04, -up), (half, -0.02), (half - 0.12, 0.03), (half - 0.30, up), (-half, up)]
    parts = [side_view(outlines.rounded_outline(tub, 0.02, 4), HULL[1], 0.02, "plum")]
    low, high, x = up - 0.02, CABIN_AT[2] + CABIN[2] / 2, CABIN_AT[0]
    cabin = [(x - 0.26, low), (x + 0.26, low), (x + 0.12, high), (x - 0.20, high)]
    parts.append(side_view(outlines.rounded_outline(cabin, 0.03, 4), CABIN[1], 0.03, "tinted"))
    for side in (-1, 1):
        lamp = mt.cylinder(0.035, 0.03, 0.006, 28, "lamp").along("x")
        parts.append(lamp.moved(half - 0.02, side * 0.11, -0.015))
        # Between the hull and the struts, rear and front.
        for at, reach, thick in ((-0.428, 0.150, 0.06), (0.396, 0.060, 0.05)):
            beam = mt.box(thick, reach, thick, 0.006, color="graphite")
            parts.append(beam.moved(at, side * (HULL[1] / 2 + reach / 2 - 0.01), 0.0))
    return mt.joined(parts)


def chassis_shape():
    return [placed(shape_box(*HULL), (0.0, 0.0, HULL_Z)), placed(shape_box(*CABIN), CABIN_AT)]


def strut_mesh(half):
    """A spring about a rod along x."""
    turns = 6
    angles = [2 * math.pi * turns * k / 96 for k in range(97)]
    reach = half * 0.8
    coil = [(-reach + 2 * reach * k / 96, 0.024 * math.cos(a), 0.024 * math.sin(a)) for k, a in enumerate(angles)]
    rod = mt.cylinder(0.012, 2 * half, 0.002, 20, "steel").along("x")
    caps = [mt.cylinder(STRUT, 0.016, 0.003, 24, "graphite").along("x").moved(s * (half - 0.008)) for s in (-1, 1)]
    return mt.joined([rod, mt.ngon_tube(coil, 0.005, 8, "amber"), *caps])


def wheel_mesh(radius, width):
    """About z: a tyre, a dished rim with five spokes."""
    w = width / 2
    profile = [(0.62 * radius, -w), (0.92 * radius, -w), (radius, -0.6 * w), (radius, 0.6 * w), (0.92 * radius, w)]
    profile += [(0.62 * radius, w), (0.62 * radius, -w)]
    tyre = mt.lathe(mt.rounded_profile(profile, [0, 0.01, 0.01, 0.01, 0.01, 0, 0], 2), 48, "rubber")
    rim = mt.tube(0.64 * radius, 0.54 * radius, 0.9 * width, 0.004, 40, "aluminium")
    hub = mt.cylinder(0.16 * radius, 0.8 * width, 0.004, 28, "aluminium")
    spokes = [
        mt.box(0.44 * radius, 0.12 * radius, 0.3 * width, 0.004, color="aluminium")
        .moved(x=0.36 * radius)
        .turned(mt.rotation_about("z", 2 * math.pi * k / 5))
        for k in range(5)
    ]
    return mt.joined([tyre, rim, hub, *spokes])


def car(folder):
    model = Model(
        "A car whose four wheels hang on sprung struts. Names, places, masses and springs as in the original's second\n"
        "toy car; a wheel has the name of the other side from its strut's, as there. The wheels take speeds (rad/s,\n"
        "negative is forwards, along +x: their axes look to the right).",
        "/ambf/env/",
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    groups = {"collision groups": [0]}
    model.body(
        "Chassis",
        CHASSIS_AT,
        mass=CHASSIS_MASS,
        inertia=box_inertia(CHASSIS_MASS, *HULL),
        com=(0.009, 0.0, 0.087),
        mesh="chassis.obj",
        compound=chassis_shape(),
        **STILL,
        **groups,
        **{"publish joint names": True, "publish joint positions": True},
    )
    for strut, at, turned, half, mass, _, wheel, wheel_at in CORNERS:
        rear = strut.startswith("ShockB")
        size = REAR if rear else FRONT
        model.body(
            strut,
            at,
            turned,
            mass=mass,
            inertia=cylinder_inertia(mass, STRUT, 2 * half, "x"),
            mesh="rear_strut.obj" if rear else "front_strut.obj",
            shape=(shape_round("CYLINDER", STRUT, 2 * half, "x"), (0, 0, 0), (0, 0, 0)),
            **STILL,
            **groups,
        )
        model.body(
            wheel,
            wheel_at,
            (math.pi / 2, math.pi, 0.0),
            mass=1.0,
            inertia=cylinder_inertia(1.0, *size),
            mesh="rear_wheel.obj" if rear else "front_wheel.obj",
            shape=(shape_round("CYLINDER", *size), (0, 0, 0), (0, 0, 0)),
            **{**STILL, "friction": (1.0, 0.01), "damping": (0.1, 0.1)},
            **groups,
        )
    for strut, at, turned, _, _, stiffness, wheel, wheel_at in CORNERS:
        p = {"ShockB": 10200.0, "ShockF": 10300.0}[strut[:6]]
        along = rotate(rpy(*turned), (1.0, 0.0, 0.0))
        spring = {"damping": 100.0, "stiffness": stiffness, **addon_gains(p)}
        model.joint(f"Chassis-{strut}", "linear spring", "Chassis", strut, at, along, limits=(-0.2, 0.2), **spring)
        p = {"ShockB": 1200.0, "ShockF": 1300.0}[strut[:6]]
        model.joint(f"{strut}-{wheel}", "continuous", strut, wheel, wheel_at, (0.0, -1.0, 0.0), **addon_gains(p))
    return model


def build(models):
    out = models / "original"
    out.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "toy_car2")
    folder.add("chassis.obj", chassis_mesh())
    folder.add("rear_strut.obj", strut_mesh(0.094))
    folder.add("front_strut.obj", strut_mesh(0.117))
    folder.add("rear_wheel.obj", wheel_mesh(*REAR))
    folder.add("front_wheel.obj", wheel_mesh(*FRONT))
    folder.close()
    car(folder).write(out / "toy_car2.yaml")
