"""Grippers: the small jaw gripper that peg transfer uses twice, and a parallel two-finger gripper of its own.

Both float: no gravity on their bodies, moved by the Cartesian controller of the base. Both close at the low joint
limits and open at the high ones, fingers having mirrored axes, so that one opening value in 0..1 drives all fingers.
"""

import math

import mesh_tools as mt
import outlines
from adf_writer import (
    Model,
    box_inertia,
    combined_inertia,
    cylinder_inertia,
    placed,
    shape_box,
    shape_round,
    spring_servo,
    vector,
)
from mesh_folder import MeshFolder

# --- jaw gripper: frame in the jaw pin, jaws towards -z, opening in y -----------------------------

JAW_LENGTH, JAW_WIDTH, JAW_THICKNESS = 0.020, 0.0036, 0.0014  # m; thin enough to go between a peg and the object on it
JAW_GAP = 0.00015  # m from the middle plane to the inner face of a closed jaw
JAW_LIMITS = (0.0, 0.6)  # rad
JAW_HOME = 0.35
JAW_MASS = 0.006  # kg, with its share of the linkage
JAW_STIFFNESS, JAW_DAMPING = 0.3, 7e-4  # N m/rad, N m s/rad: 5 N at 15 mm from the pin for a target 0.25 rad inside
# The shaft is 8 mm thick, as that of a da Vinci instrument, and short. It carries more than half of the mass: forces
# act at the jaw pin, which the controller can hold the better the less a force there turns the whole.
HOUSING_RADIUS, HOUSING_LOW, HOUSING_HIGH, HOUSING_MASS = 0.018, 0.100, 0.142, 0.09
SHAFT_RADIUS, SHAFT_LOW, SHAFT_HIGH, SHAFT_MASS = 0.004, 0.004, 0.100, 0.11
# Bodies of different groups do not touch. The two jaws of one gripper share none, jaws of different grippers share one.
JAW_GROUPS = {"left": {"a": [1, 2], "b": [3, 4]}, "right": {"a": [1, 3], "b": [2, 4]}}


def turned_part(points, radii, color, segments=32, steps=3):
    return mt.lathe(mt.rounded_profile(points, radii, steps), segments, color)


def housing_mesh(accent):
    low, high, r = HOUSING_LOW, HOUSING_HIGH, HOUSING_RADIUS
    wrist = turned_part(
        [(0, 0.0075), (0.0036, 0.0075), (SHAFT_RADIUS, 0.0105), (SHAFT_RADIUS, 0.020), (0.0036, 0.021), (0, 0.021)],
        [0, 0.0006, 0.001, 0.0004, 0, 0],
        "steel",
        24,
    )
    shaft = turned_part([(0, 0.019), (0.0038, 0.019), (0.0038, low + 0.002), (0, low + 0.002)], [0] * 4, "carbon", 24)
    mark = mt.collar(0.003, 0.00405, 0.0245, 0.0285, 0.0002, 24, accent)
    nose = turned_part(
        [(0, low - 0.010), (0.0062, low - 0.010), (0.0062, low - 0.001), (0.010, low + 0.002), (0, low + 0.002)],
        [0, 0.0012, 0.0025, 0.0005, 0],
        "steel",
    )
    body = turned_part(
        [(0, low), (0.0115, low), (r, low + 0.007), (r, high - 0.012), (0, high - 0.012)],
        [0, 0.002, 0.004, 0.0008, 0],
        "graphite",
        40,
    )
    ring = mt.collar(0.010, r + 0.0002, high - 0.0125, high - 0.0095, 0.0004, 40, accent)
    lid = turned_part(
        [(0, high - 0.010), (r, high - 0.010), (r, high - 0.003), (0.008, high), (0, high)],
        [0, 0.0006, 0.004, 0.003, 0],
        "shell",
        40,
    )
    ribs = [
        mt.box(0.0016, 0.0022, 0.014, 0.0006, color="graphite", segments=1)
        .moved(x=r, z=(low + high) / 2 - 0.004)
        .turned(mt.rotation_about("z", 2 * math.pi * (k + 0.5) / 16))
        for k in range(16)
    ]
    gland = turned_part(
        [(0, high - 0.001), (0.0048, high - 0.001), (0.0040, high + 0.008), (0, high + 0.008)],
        [0, 0, 0.001, 0],
        "rubber",
        20,
    )
    cable = mt.ngon_tube(
        [(-0.012 * (t * t), 0.0, high + 0.005 + 0.008 * t) for t in (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)],
        0.0022,
        12,
        "rubber",
    )
    # The fork that holds the jaws: two cheeks rounded about the pin, and the pin with its heads.
    cheek = mt.extrude(outlines.stadium(0.0085, 0.0034), 0.0013, 0.0003, color="steel").turned(
        mt.rotation_about("y", -math.pi / 2)
    )
    cheeks = [cheek.moved(x=side * 0.0033) for side in (-1.0, 1.0)]
    pin = mt.cylinder(0.0013, 0.0082, 0.0002, 16, "graphite").along("x")
    heads = [mt.cylinder(0.0019, 0.0008, 0.0002, 16, "brass").along("x").moved(x=side * 0.0042) for side in (-1.0, 1.0)]
    return mt.joined([wrist, shaft, mark, nose, body, ring, lid, gland, cable, pin] + ribs + cheeks + heads)


def jaw_mesh(side):
    """side +1: inner face looks to -y. A tapered finger with grip ridges and a hub around the pin."""
    inner, tip, root = JAW_GAP, JAW_GAP + 0.8 * JAW_THICKNESS, JAW_GAP + 1.8 * JAW_THICKNESS
    finger = outlines.rounded_outline(
        [(inner, -JAW_LENGTH), (tip, -JAW_LENGTH), (tip + 0.0009, -JAW_LENGTH * 0.5), (root, 0.0), (inner, 0.0)],
        [0.0003, 0.0006, 0.005, 0.0005, 0.0003],
        4,
    )
    # outline (y, z) with its normal along +x: columns x -> y, y -> z, z -> x
    plate = mt.extrude(finger, JAW_WIDTH, 0.0005, 3, color="steel").along("x")
    hub = mt.cylinder(0.0030, 0.0048, 0.0004, 24, "steel").along("x")
    ridges = [
        mt.box(JAW_WIDTH - 0.0009, 0.0003, 0.00055, 0.0001, color="graphite", segments=1).moved(
            y=inner, z=-0.0065 - 0.0011 * k
        )
        for k in range(12)
    ]
    mesh = mt.joined([plate, hub] + ridges)
    return mesh if side > 0 else mesh.turned(mt.rotation_about("z", math.pi))


def add_jaw_gripper_meshes(folder):
    for side, accent in (("left", "teal"), ("right", "coral")):
        folder.add(f"{side}_gripper.obj", housing_mesh(accent))
    folder.add("jaw_a.obj", jaw_mesh(1.0))
    folder.add("jaw_b.obj", jaw_mesh(-1.0))


def add_jaw_gripper(model, side, position):
    """Base body `<side>_gripper`, jaws `<side>_jaw_a` (+y) and `<side>_jaw_b` (-y)."""
    mass, com, inertia = combined_inertia(
        [
            (
                HOUSING_MASS,
                (0, 0, (HOUSING_LOW + HOUSING_HIGH) / 2),
                cylinder_inertia(HOUSING_MASS, HOUSING_RADIUS, HOUSING_HIGH - HOUSING_LOW),
            ),
            (
                SHAFT_MASS,
                (0, 0, (SHAFT_LOW + SHAFT_HIGH) / 2),
                cylinder_inertia(SHAFT_MASS, SHAFT_RADIUS, SHAFT_HIGH - SHAFT_LOW),
            ),
        ]
    )
    base = f"{side}_gripper"
    floating = {"gravity": vector((0, 0, 0)), "collision margin": 0.0002}
    model.body(
        base,
        position,
        mass=mass,
        inertia=inertia,
        com=com,
        mesh=f"{base}.obj",
        damping=(0.5, 0.5),
        friction=(0.5, 0.01),
        compound=[
            placed(
                shape_round("CYLINDER", HOUSING_RADIUS, HOUSING_HIGH - HOUSING_LOW),
                (0, 0, (HOUSING_LOW + HOUSING_HIGH) / 2),
            ),
            placed(shape_round("CYLINDER", SHAFT_RADIUS, SHAFT_HIGH - SHAFT_LOW), (0, 0, (SHAFT_LOW + SHAFT_HIGH) / 2)),
        ],
        controller={"linear": {"P": 100.0, "I": 0.0, "D": 7.0}, "angular": {"P": 0.3, "I": 0.0, "D": 0.006}},
        **{"controller output type": "FORCE", "publish children names": True},
        **floating,
    )
    for jaw, sign in (("a", 1.0), ("b", -1.0)):
        name = f"{side}_jaw_{jaw}"
        middle = (0, sign * (JAW_GAP + JAW_THICKNESS / 2), -JAW_LENGTH / 2)
        model.body(
            name,
            position,
            (sign * JAW_HOME, 0, 0),
            mass=JAW_MASS,
            com=middle,
            mesh=f"jaw_{jaw}.obj",
            inertia=box_inertia(JAW_MASS, JAW_WIDTH, JAW_THICKNESS, JAW_LENGTH),
            friction=(1.2, 0.01),
            restitution=0.0,
            shape=(shape_box(JAW_WIDTH, JAW_THICKNESS, JAW_LENGTH), middle, (0, 0, 0)),
            damping=(0.2, 0.2),
            **{"collision groups": JAW_GROUPS[side][jaw]},
            **floating,
        )
        model.joint(
            f"{side}_gripper-jaw_{jaw}",
            "revolute",
            base,
            name,
            position,
            (sign, 0, 0),
            home=JAW_HOME,
            limits=JAW_LIMITS,
            damping=1e-4,
            **spring_servo(JAW_STIFFNESS, JAW_DAMPING, 1e-4),
        )


# --- two-finger gripper: frame in the middle of the palm's underside, fingers towards -z, closing a

PALM = (0.055, 0.13, 0.05)  # x, y, z of the palm, m
PALM_MASS = 0.6
FINGER = (0.026, 0.014, 0.075)
FINGER_MASS = 0.08
STROKE = 0.04  # of each finger
FINGER_HOME = 0.025
FINGER_STIFFNESS, FINGER_DAMPING = 1500.0, 20.0  # N/m, N s/m: 30 N for a target 20 mm inside


def palm_mesh():
    """Housing with a rail under it, a flange on top and a lamp that shows its state."""
    x, y, z = PALM
    body = mt.box(x, y, z - 0.008, 0.0055, 0.016, "shell", 4).moved(z=(z + 0.008) / 2)
    skirt = mt.box(x - 0.003, y - 0.003, 0.012, 0.002, 0.0145, "graphite", 3).moved(z=0.006)
    rail = mt.box(0.018, y - 0.012, 0.006, 0.001, 0.002, "steel").moved(z=-0.002)
    lips = [mt.box(0.005, y - 0.008, 0.004, 0.0008, 0.0015, "aluminium").moved(x=s * 0.0125, z=-0.001) for s in (-1, 1)]
    band = mt.box(x + 0.0006, y + 0.0006, 0.0045, 0.0008, 0.0163, "teal", 4).moved(z=z * 0.60)
    lamp = mt.cylinder(0.0035, 0.004, 0.0008, 20, "lamp").along("x").moved(x=x / 2 - 0.0012, z=z * 0.80)
    panel = mt.box(0.002, 0.060, 0.013, 0.0008, color="graphite").moved(x=x / 2 - 0.0003, z=0.0195)
    collar = turned_part(
        [
            (0, z - 0.002),
            (0.0255, z - 0.002),
            (0.0255, z + 0.005),
            (0.021, z + 0.007),
            (0.021, z + 0.014),
            (0, z + 0.014),
        ],
        [0, 0, 0.001, 0.002, 0, 0],
        "graphite",
        40,
    )
    flange = turned_part(
        [(0, z + 0.013), (0.024, z + 0.013), (0.024, z + 0.022), (0, z + 0.022)],
        [0, 0.0008, 0.0012, 0],
        "aluminium",
        40,
    )
    parts = [body, skirt, rail, band, lamp, panel, collar, flange, *lips]
    for k in range(6):
        a = math.pi / 3 * k
        parts.append(mt.screw(0.0022, 0.0016).moved(0.0185 * math.cos(a), 0.0185 * math.sin(a), z + 0.022))
    for sx in (-1, 1):
        for sy in (-1, 1):
            parts.append(
                mt.screw(0.0026, 0.0006, "graphite").moved(sx * (x / 2 - 0.010), sy * (y / 2 - 0.012), z - 0.0002)
            )
    return mt.joined(parts)


def finger_mesh(side):
    """side +1: inner face at y = 0 looks to -y; the finger lies at y > 0."""
    x, y, z = FINGER
    outline = outlines.rounded_outline(
        [(0.002, -z), (0.006, -z), (y, -z * 0.50), (y, -0.010), (0.002, -0.010)],
        [0.001, 0.0035, 0.012, 0.003, 0.001],
        6,
    )
    finger = mt.extrude(outline, x, 0.0022, 3, "aluminium").along("x")
    pad = mt.box(x - 0.005, 0.0030, z * 0.52, 0.0008, color="rubber").moved(y=0.0015, z=-z * 0.71)
    ribs = [
        mt.box(x - 0.007, 0.0008, 0.0016, 0.0003, color="rubber", segments=1).moved(y=0.0002, z=-z * 0.48 - 0.0036 * k)
        for k in range(10)
    ]
    slider = mt.box(0.034, 0.022, 0.014, 0.0022, 0.003, "graphite", 3).moved(y=0.009, z=-0.008)
    parts = [finger, pad, slider, *ribs]
    for sx in (-1, 1):
        parts.append(mt.screw(0.0024, 0.0014).turned(mt.rotation_about("x", -math.pi / 2)).moved(sx * 0.009, y, -0.030))
        parts.append(
            mt.screw(0.0024, 0.0014).turned(mt.rotation_about("x", -math.pi / 2)).moved(sx * 0.012, 0.020, -0.008)
        )
    mesh = mt.joined(parts)
    return mesh if side > 0 else mesh.turned(mt.rotation_about("z", math.pi))


def build_two_finger(models):
    folder = MeshFolder(models, "two_finger")
    folder.add("palm.obj", palm_mesh())
    folder.add("finger_a.obj", finger_mesh(1.0))
    folder.add("finger_b.obj", finger_mesh(-1.0))
    folder.close()

    model = Model(
        "Parallel gripper with two sliding fingers, 0 to 80 mm. Floats; the palm has the Cartesian controller.",
        namespace="/ambf/env/two_finger/",
        meshes=folder.seen_from(3),
        gravity=vector((0, 0, 0)),
    )
    at = (0.0, 0.0, 0.25)
    x, y, z = PALM
    model.body(
        "palm",
        at,
        mass=PALM_MASS,
        com=(0, 0, z / 2),
        inertia=box_inertia(PALM_MASS, x, y, z),
        mesh="palm.obj",
        damping=(0.5, 0.5),
        compound=[
            placed(shape_box(x, y, z), (0, 0, z / 2)),
            placed(shape_round("CYLINDER", 0.024, 0.022), (0, 0, z + 0.011)),
        ],
        controller={"linear": {"P": 680.0, "I": 0.0, "D": 45.0}, "angular": {"P": 2.2, "I": 0.0, "D": 0.08}},
        **{"controller output type": "FORCE", "publish children names": True},
    )
    fx, fy, fz = FINGER
    for finger, sign, groups in (("a", 1.0, [1]), ("b", -1.0, [2])):
        name = f"finger_{finger}"
        middle = (0, sign * (fy / 2 + 0.0002), -fz / 2)
        model.body(
            name,
            (0.0, sign * FINGER_HOME, at[2]),
            mass=FINGER_MASS,
            com=middle,
            inertia=box_inertia(FINGER_MASS, fx, fy, fz),
            mesh=f"{name}.obj",
            shape=(shape_box(fx, fy, fz), middle, (0, 0, 0)),
            friction=(1.2, 0.01),
            restitution=0.0,
            **{"collision groups": groups},
        )
        model.joint(
            f"palm-{name}",
            "prismatic",
            "palm",
            name,
            at,
            (0, sign, 0),
            child_point=(0.0, sign * FINGER_HOME, at[2]),
            limits=(0.0, STROKE),
            damping=0.5,
            **spring_servo(FINGER_STIFFNESS, FINGER_DAMPING, 0.04),
        )
    model.write(models / "descriptions" / "multi-bodies" / "grippers" / "two_finger.yaml")


def build(models):
    build_two_finger(models)
