"""Seven-joint arm with the proportions of a KUKA LBR iiwa 14 / Med 14: shoulder, elbow and wrist centres 0.36, 0.42,
0.40 m apart and the flange 0.126 m beyond. Odd links turn about their length and carry a fork, even links nod in the
fork before them."""

import math

import mesh_tools as mt
from adf_writer import Model, cylinder_inertia, placed, shape_round, velocity_servo
from mesh_folder import MeshFolder

BASE_HEIGHT = 0.1575
LENGTHS = (
    0.2025,
    0.2045,
    0.2155,
    0.1845,
    0.2155,
    0.081,
    0.045,
)  # m, from each joint to the next, the last to the flange
MASSES = (5.0, 4.0, 4.0, 3.0, 2.7, 1.7, 0.6)  # kg
LIMITS = tuple(math.radians(d) for d in (170, 120, 170, 120, 170, 120, 175))
TORQUES = (176.0, 176.0, 100.0, 100.0, 100.0, 38.0, 38.0)  # N m
SERVO_GAINS = (20.0, 20.0, 20.0, 20.0, 30.0, 30.0, 30.0)  # 1/s
DAMPING = (1.0, 1.0, 0.5, 0.5, 0.3, 0.1, 0.05)  # N m s/rad
AXES = ("z", "y", "z", "-y", "z", "y", "z")
HOME = (0.0, 0.6, 0.0, -1.6, 0.0, math.pi - 2.2, 0.0)  # rad: flange above the middle of the table, pointing down
BASE = (-0.56, 0.0, 0.0)
SCALE = (1.0, 1.0, 0.92, 0.92, 0.84, 0.84, 0.84)  # the arm gets slimmer towards its tip


def base_mesh():
    foot = mt.lathe(
        mt.rounded_profile([(0, 0), (0.12, 0), (0.12, 0.018), (0, 0.018)], [0, 0.002, 0.006, 0]), 36, "graphite"
    )
    column = mt.lathe(
        mt.rounded_profile(
            [(0, 0.018), (0.105, 0.018), (0.08, 0.075), (0.08, 0.1535), (0, 0.1535)], [0, 0.004, 0.04, 0.006, 0], 4
        ),
        36,
        "shell",
    )
    return foot + column


def base_hull_mesh():
    """What collides: a cone on the foot, few points that are taken as one convex hull."""
    return mt.lathe([(0, 0), (0.12, 0), (0.12, 0.018), (0.08, BASE_HEIGHT), (0, BASE_HEIGHT)], 12)


def odd_mesh(length, s):
    """Collar and two cheeks around the next joint."""
    top = length - 0.11 * s
    collar = mt.lathe(
        mt.rounded_profile([(0, 0.0), (0.076 * s, 0.0), (0.076 * s, top), (0, top)], [0, 0.005, 0.014 * s, 0], 4),
        32,
        "shell",
    )
    ring = mt.collar(0.07 * s, 0.0775 * s, 0.014, 0.022, 0.0015, 32, "teal")
    cheek = (
        mt.extrude(mt.stadium(0.09 * s, 0.06 * s), 0.024 * s, 0.006 * s, color="shell")
        .along("y")
        .moved(z=length - 0.09 * s)
    )
    cap = mt.cylinder(0.04 * s, 0.006 * s, 0.002 * s, 24, "graphite").along("y")
    parts = [collar, ring]
    for side in (-1.0, 1.0):
        parts.append(cheek.moved(y=side * 0.064 * s))
        parts.append(cap.moved(y=side * 0.078 * s, z=length))
    return mt.joined(parts)


def even_mesh(length, s):
    """Drum in the fork of the link before, and a tube to the next joint."""
    drum = mt.cylinder(0.056 * s, 0.1 * s, 0.004 * s, 28, "graphite").along("y")
    rim = 0.074 * s if length > 0.1 else 0.052 * s
    neck = min(0.05 * s, rim)
    profile = [(0, 0.0), (neck, 0.0), (neck, length - 0.045 * s if length > 0.1 else 0.05 * s)]
    profile += [
        (rim, length - 0.028 * s if length > 0.1 else length - 0.016),
        (rim, length - 0.003),
        (0, length - 0.003),
    ]
    return drum + mt.lathe(mt.rounded_profile(profile, [0, 0, 0.012 * s, 0.008 * s, 0.004, 0], 3), 32, "shell")


def flange_mesh():
    body = mt.lathe(
        mt.rounded_profile(
            [(0, 0), (0.044, 0), (0.044, 0.034), (0.032, 0.036), (0.032, 0.045), (0, 0.045)],
            [0, 0.003, 0.004, 0.001, 0.002, 0],
        ),
        36,
        "graphite",
    )
    ring = mt.collar(0.04, 0.0455, 0.012, 0.018, 0.001, 32, "teal")
    return body + ring


def build(models):
    folder = MeshFolder(models, "arm7")
    folder.add("base.obj", base_mesh())
    folder.add("base.obj", base_hull_mesh(), "low_res")
    for k, length in enumerate(LENGTHS[:6]):
        folder.add(f"link{k + 1}.obj", (odd_mesh if k % 2 == 0 else even_mesh)(length, SCALE[k]))
    folder.add("link7.obj", flange_mesh())
    folder.close()

    model = Model(
        "Seven-joint arm in the proportions of an LBR iiwa 14, 21 kg, on a fixed base. Joints are speed-controlled\n"
        "motors; the home pose holds the flange above the origin, pointing down.",
        meshes=folder.seen_from(3),
        namespace="/ambf/env/arm7/",
        low_resolution=True,
        **{"ignore inter-collision": True},
    )
    model.body(
        "base",
        BASE,
        mesh="base.obj",
        hull="base.obj",
        **{"publish children names": True},
    )
    position, tilt, previous = [BASE[0], BASE[1], BASE_HEIGHT], 0.0, "base"
    for k, length in enumerate(LENGTHS):
        axis = AXES[k]
        tilt += {"z": 0.0, "y": 1.0, "-y": -1.0}[axis] * HOME[k]
        s = SCALE[k]
        radius = (0.07 if k % 2 == 0 else 0.056) * s
        if k == 6:
            radius, low, high = 0.04, 0.0, length
        else:
            low, high = (0.0, length + 0.06 * s) if k % 2 == 0 else (-0.056 * s, length)
        middle, extent = (low + high) / 2, high - low
        kind = "CYLINDER" if k >= 5 else "CAPSULE"
        name = f"link{k + 1}"
        model.body(
            name,
            position,
            (0.0, tilt, 0.0),
            mass=MASSES[k],
            com=(0, 0, middle),
            mesh=f"{name}.obj",
            inertia=cylinder_inertia(MASSES[k], radius, extent),
            compound=[placed(shape_round(kind, radius, extent), (0, 0, middle))],
        )
        direction = {"z": (math.sin(tilt), 0.0, math.cos(tilt)), "y": (0, 1, 0), "-y": (0, -1, 0)}[axis]
        model.joint(
            f"joint{k + 1}",
            "revolute",
            previous,
            name,
            position,
            direction,
            home=HOME[k],
            limits=(-LIMITS[k], LIMITS[k]),
            damping=DAMPING[k],
            **velocity_servo(SERVO_GAINS[k], TORQUES[k] * 1e-3),
        )
        position = [position[0] + length * math.sin(tilt), position[1], position[2] + length * math.cos(tilt)]
        previous = name
    model.write(models / "descriptions" / "multi-bodies" / "robots" / "arm7.yaml")
