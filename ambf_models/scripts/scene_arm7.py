"""Seven-joint arm with the proportions of a KUKA LBR iiwa 14 / Med 14: shoulder, elbow and wrist centres 0.36, 0.42,
0.40 m apart and the flange 0.126 m beyond. Odd links turn about their length and carry a fork, even links nod in the
fork before them."""

import math

import mesh_tools as mt
import outlines
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
    """Bolted foot, a waisted column, the connectors at its back."""
    foot = mt.lathe(
        mt.rounded_profile(
            [(0, 0), (0.12, 0), (0.12, 0.016), (0.100, 0.020), (0, 0.020)], [0, 0.002, 0.005, 0.002, 0], 4
        ),
        48,
        "graphite",
    )
    column = mt.lathe(
        mt.rounded_profile(
            [(0, 0.019), (0.096, 0.019), (0.080, 0.075), (0.080, 0.1535), (0, 0.1535)], [0, 0.003, 0.05, 0.006, 0], 6
        ),
        48,
        "shell",
    )
    parts = [foot, column, mt.collar(0.07, 0.0815, 0.132, 0.139, 0.0012, 48, "teal")]
    for k in range(8):
        a = math.pi / 4 * (k + 0.5)
        parts.append(mt.screw(0.0062, 0.005).moved(0.109 * math.cos(a), 0.109 * math.sin(a), 0.0165))
    box = mt.box(0.030, 0.085, 0.052, 0.004, 0.008, "graphite", 3).moved(-0.092, 0, 0.050)
    plugs = [
        mt.cylinder(0.0085, 0.012, 0.001, 20, "steel").along("x").moved(-0.108, y, 0.052) for y in (-0.024, 0.0, 0.024)
    ]
    return mt.joined([*parts, box, *plugs])


def base_hull_mesh():
    """What collides: a cone on the foot, few points that are taken as one convex hull."""
    return mt.lathe([(0, 0), (0.12, 0), (0.12, 0.018), (0.08, BASE_HEIGHT), (0, BASE_HEIGHT)], 12)


def odd_mesh(length, s):
    """Collar and two cheeks around the next joint, with its covers."""
    top = length - 0.105 * s
    collar = mt.lathe(
        mt.rounded_profile([(0, 0.0), (0.077 * s, 0.0), (0.077 * s, top), (0, top)], [0, 0.005, 0.020 * s, 0], 6),
        48,
        "shell",
    )
    ring = mt.collar(0.07 * s, 0.0785 * s, 0.014, 0.021, 0.0012, 48, "teal")
    seam = mt.collar(0.07 * s, 0.0772 * s, 0.0005, 0.0035, 0.0004, 48, "graphite")
    cheek = (
        mt.extrude(outlines.stadium(0.09 * s, 0.060 * s, 16), 0.026 * s, 0.009 * s, 5, "shell")
        .along("y")
        .moved(z=length - 0.09 * s)
    )
    rim = mt.collar(0.038 * s, 0.0445 * s, -0.003 * s, 0.003 * s, 0.0008, 36, "aluminium").along("y")
    cap = mt.lathe(
        mt.rounded_profile(
            [(0, -0.002), (0.039 * s, -0.002), (0.039 * s, 0.0016), (0.030 * s, 0.0034), (0, 0.0040)],
            [0, 0, 0.0006, 0.004, 0],
            4,
        ),
        36,
        "graphite",
    ).along("y")
    parts = [collar, ring, seam]
    for side in (-1.0, 1.0):
        parts.append(cheek.moved(y=side * 0.064 * s))
        parts.append(rim.moved(y=side * 0.0765 * s, z=length))
        facing = cap if side > 0 else cap.turned(mt.rotation_about("z", math.pi))
        parts.append(facing.moved(y=side * 0.0782 * s, z=length))
    return mt.joined(parts)


def even_mesh(length, s):
    """Drum in the fork of the link before, and a tube to the next joint."""
    drum = mt.cylinder(0.056 * s, 0.1 * s, 0.004 * s, 40, "graphite").along("y")
    bands = [
        mt.collar(
            0.05 * s, 0.0566 * s, side * 0.036 * s - 0.002 * s, side * 0.036 * s + 0.002 * s, 0.0004, 40, "aluminium"
        ).along("y")
        for side in (-1, 1)
    ]
    rim = 0.076 * s if length > 0.1 else 0.052 * s
    neck = min(0.05 * s, rim)
    profile = [(0, 0.0), (neck, 0.0), (neck, length - 0.050 * s if length > 0.1 else 0.05 * s)]
    profile += [
        (rim, length - 0.026 * s if length > 0.1 else length - 0.016),
        (rim, length - 0.002),
        (0, length - 0.002),
    ]
    tube = mt.lathe(mt.rounded_profile(profile, [0, 0, 0.016 * s, 0.010 * s, 0.003, 0], 5), 48, "shell")
    return mt.joined([drum, tube, *bands])


def flange_mesh():
    body = mt.lathe(
        mt.rounded_profile(
            [(0, 0), (0.044, 0), (0.044, 0.030), (0.034, 0.034), (0, 0.034)],
            [0, 0.003, 0.006, 0.002, 0],
            4,
        ),
        48,
        "graphite",
    )
    plate = mt.lathe(
        mt.rounded_profile(
            [(0, 0.033), (0.0315, 0.033), (0.0315, 0.045), (0.010, 0.045), (0.010, 0.043), (0, 0.043)],
            [0, 0, 0.001, 0.0004, 0, 0],
            2,
        ),
        40,
        "aluminium",
    )
    parts = [body, plate, mt.collar(0.04, 0.0448, 0.012, 0.018, 0.0008, 40, "teal")]
    for k in range(7):
        a = 2 * math.pi * k / 7
        parts.append(mt.screw(0.0024, 0.0012, "graphite").moved(0.025 * math.cos(a), 0.025 * math.sin(a), 0.045))
    return mt.joined(parts)


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
