"""What the scenes of touch share: bundles of rays, resistive numbers, and a gripper with rays in its fingers."""

import math

import adf_kinematics as kinematics
import mesh_tools as mt
import scene_grippers as grippers
from adf_writer import box_inertia, combined_inertia, cylinder_inertia, placed, shape_box, shape_round, vector
from mesh_folder import MeshFolder

# Table 6.2 of the dissertation: friction static (1/m) and dynamic (N s/m), contact stiffness (N), contact damping
# (N s), contact area (m).
OBJECT_GRASP = (1000.0, 0.5, 1.0, 5.0, 0.001)
SCREWDRIVER = (5000.0, 0.8, 0.8, 0.1, 0.001)
THREAD = (1000.0, 0.3, 0.05, 5.0, 0.005)


def spread(width, count):
    """`count` places over `width`, about 0."""
    return [width * (k / (count - 1) - 0.5) for k in range(count)] if count > 1 else [0.0]


def rays(starts, direction):
    """Entries of `array`: parallel rays, as long as the sensor's range."""
    return [{"offset": vector(start), "direction": vector(direction)} for start in starts]


def resistance(numbers, range_m, array):
    """Keys of a resistive sensor; `numbers` as in Table 6.2. Friction grows with the normal force (Eq. 6.1)."""
    static, dynamic, stiffness, damping, area = numbers
    return {
        "type": "Resistance",
        "range": range_m,
        "friction": {"static": static, "damping": 0.1, "dynamic": dynamic, "variable": True},
        "contact stiffness": stiffness,
        "contact damping": damping,
        "contact area": area,
        "array": array,
    }


def holding_motor(gain, max_impulse):
    """As adf_writer.velocity_servo, and it keeps the last target when commands end."""
    return {
        "controller": {"P": float(gain), "I": 0.0, "D": 0.0},
        "controller output type": "VELOCITY",
        "enable motor": True,
        "enable feedback": True,
        "max motor impulse": float(max_impulse),
        "hold": True,
    }


# Seen from the meshes of a scene: those of the hand are its own and the two-finger gripper's.
HAND, FINGERS = "../../hand/high_res/hand.obj", "../../two_finger/high_res/finger_{}.obj"
ROD_RADIUS, ROD_M = 0.009, 0.22  # of the rod above the palm
PALM_MASS, ROD_MASS = 0.5, 0.2  # kg; the rod is a tube


def build(models):
    """The hand's meshes."""
    folder = MeshFolder(models, "hand")
    rod = mt.cylinder(ROD_RADIUS, ROD_M, 0.0004, 28, "steel").moved(z=grippers.PALM[2] + 0.02 + ROD_M / 2)
    folder.add("hand.obj", grippers.palm_mesh() + rod)
    folder.close()


def add_hand(model, name, at, turn, opening, numbers, range_m, grid=(0.022, 5, 0.026, 5), finger_mass=0.08):
    """Palm `name` and its fingers `<name>_finger_a`, `_b`, each with a resistive sensor `<name>_rays_a`, `_b`.

    at, turn: of the palm, in the world; fingers point to its -z and open along its y. opening: of each finger, m.
    numbers: of the sensors; None: there are none. grid: width, columns, height, rows of the rays. Friction of the
    fingers themselves is 0: the rays hold alone. Their motors keep them where they are commanded to, so that how far
    they close sets how deep the rays reach.
    """
    px, py, pz = grippers.PALM
    weightless = {"gravity": vector((0, 0, 0))}
    rod = (0, 0, pz + (ROD_M + 0.02) / 2)
    mass, com, inertia = combined_inertia(
        [
            (PALM_MASS, (0, 0, pz / 2), box_inertia(PALM_MASS, px, py, pz)),
            (ROD_MASS, rod, cylinder_inertia(ROD_MASS, ROD_RADIUS, ROD_M + 0.02)),
        ]
    )
    model.body(
        name,
        at,
        turn,
        mass=mass,
        com=com,
        inertia=inertia,
        mesh=HAND,
        compound=[
            placed(shape_box(px, py, pz), (0, 0, pz / 2)),
            placed(shape_round("CYLINDER", ROD_RADIUS, ROD_M + 0.02), rod),
        ],
        **{"publish children names": True},
        **weightless,
    )
    fx, fy, fz = grippers.FINGER
    rotation, _ = kinematics.pose_of({"position": vector(at), "orientation": dict(zip("rpy", turn, strict=True))})
    for finger, sign in (("a", 1.0), ("b", -1.0)):
        child = f"{name}_finger_{finger}"
        place = kinematics.plus(at, kinematics.rotate(rotation, (0.0, sign * opening, 0.0)))
        middle = (0, sign * (fy / 2 + 0.0002), -fz / 2)
        model.body(
            child,
            place,
            turn,
            mass=finger_mass,
            com=middle,
            inertia=box_inertia(finger_mass, fx, fy, fz),
            mesh=FINGERS.format(finger),
            shape=(shape_box(fx, fy, fz), middle, (0, 0, 0)),
            friction=(0.0, 0.0),
            restitution=0.0,
            **{"collision groups": [1] if finger == "a" else [2]},
            **weightless,
        )
        model.joint(
            f"{name}-{finger}",
            "prismatic",
            name,
            child,
            at,
            kinematics.rotate(rotation, (0, sign, 0)),
            child_point=place,
            limits=(0.0, grippers.STROKE),
            damping=0.5,
            **holding_motor(20.0, 0.06),
        )
        if numbers is None:
            continue
        width, columns, height, rows = grid
        pad = -0.71 * fz
        starts = [(x, sign * 0.0002, pad + z) for x in spread(width, columns) for z in spread(height, rows)]
        entries = resistance(numbers, range_m, rays(starts, (0, -sign, 0)))
        model.add("sensors", f"{name}_rays_{finger}", child, **entries)


def base_plate(x, y, color="graphite"):
    """Foot of a stand, its top at z = 0.012."""
    plate = mt.box(x, y, 0.012, 0.002, 0.012, color, 3).moved(z=0.006)
    screws = [
        mt.screw(0.004, 0.003).moved(sx * (x / 2 - 0.014), sy * (y / 2 - 0.014), 0.012)
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    return mt.joined([plate, *screws])


def bearing(radius, height):
    """A collar through which a rod slides, along z, centred."""
    corners = [(radius, -height / 2), (radius + 0.009, -height / 2), (radius + 0.009, height / 2), (radius, height / 2)]
    profile = mt.rounded_profile(corners, [0, 0.0015, 0.0015, 0], 2)
    return mt.lathe(profile + profile[:1], 32, "aluminium")


def circle_of(count, radius, z=0.0):
    """Places on a circle about z."""
    turns = [2.0 * math.pi * k / count for k in range(count)]
    return [(radius * math.cos(a), radius * math.sin(a), z) for a in turns]
