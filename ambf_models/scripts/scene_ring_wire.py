"""A ring that is led along a bent wire without touching it. The ring is the tool: it floats, and goes where its
commands say. Its task counts touches and knows how far along the wire it is."""

import math

import mesh_tools as mt
import touch_parts as parts
from adf_writer import Model, combined_inertia, cylinder_inertia, placed, shape_box, shape_round, vector
from mesh_folder import MeshFolder

BASE = (0.12, 0.22, 0.012)
WIRE, POST = 0.0015, 0.003  # radii, m
HALF, HEIGHT, WAVE, SIDE = 0.080, 0.095, 0.020, 0.012  # of the wire: half its length, its middle, how far it bends
PARTS = 48
RING, TUBE = 0.012, 0.002  # of the ring: radius to the middle of its tube, and of the tube
HANDLE = (0.004, 0.060)  # radius, height of a capsule
START, STATIONS = 0.06, (0.25, 0.5, 0.75, 0.94)  # of the wire's length
DENSITY = 1500.0


def point(t):
    """On the wire, t from 0 (left) to 1 (right)."""
    return (
        SIDE * math.sin(2 * math.pi * t),
        HALF * (2 * t - 1),
        HEIGHT + WAVE * math.sin(3 * math.pi * t),
    )


def pieces():
    """(middle, length, direction) of the wire's straight parts."""
    for k in range(PARTS):
        a, b = point(k / PARTS), point((k + 1) / PARTS)
        way = [q - p for p, q in zip(a, b, strict=True)]
        length = math.sqrt(sum(w * w for w in way))
        yield [(p + q) / 2 for p, q in zip(a, b, strict=True)], length, [w / length for w in way]


def turn_to(direction):
    """Roll, pitch, yaw that bring z to the direction."""
    x, y, z = direction
    return (0.0, math.acos(z), math.atan2(y, x))


def wire_mesh():
    """Frame in the middle of the base's lower side."""
    solids = [parts.base_plate(BASE[0], BASE[1])]
    solids.append(mt.ngon_tube([point(k / PARTS) for k in range(PARTS + 1)], WIRE, 12, "steel"))
    for t in (0.0, 1.0):
        x, y, z = point(t)
        solids.append(mt.capsule(POST, z - BASE[2] + POST, 20, "coral").moved(x, y, (z + BASE[2] + POST) / 2))
        solids.append(mt.collar(0.002, 0.009, BASE[2], BASE[2] + 0.004, 0.001, 28, "slate").moved(x, y, 0.0))
    return mt.joined(solids)


def wire_shape():
    shapes = [placed(shape_box(*BASE), (0, 0, BASE[2] / 2))]
    for middle, length, way in pieces():
        shapes.append(placed(shape_round("CAPSULE", WIRE, length + 2 * WIRE), middle, turn_to(way)))
    for t in (0.0, 1.0):
        x, y, z = point(t)
        shapes.append(placed(shape_round("CAPSULE", POST, z - BASE[2] + POST), (x, y, (z + BASE[2] + POST) / 2)))
    return shapes


def ring_mesh():
    """Frame in its middle; the wire goes through along y, the handle points up."""
    ring = mt.torus(RING, TUBE, 40, 14, "amber").along("y")
    handle = mt.capsule(HANDLE[0], HANDLE[1], 24, "graphite").moved(z=RING + HANDLE[1] / 2)
    collar = mt.collar(0.003, 0.0052, -0.003, 0.003, 0.0006, 24, "brass").moved(z=RING + 0.006)
    return mt.joined([ring, handle, collar])


def ring_shape():
    shapes, count = [], 14
    length = 2 * RING * math.tan(math.pi / count) + TUBE
    for k in range(count):
        a = 2 * math.pi * k / count
        place = (RING * math.sin(a), 0.0, RING * math.cos(a))
        shapes.append(placed(shape_round("CAPSULE", TUBE, length, "x"), place, (0.0, a, 0.0)))
    shapes.append(placed(shape_round("CAPSULE", HANDLE[0], HANDLE[1]), (0, 0, RING + HANDLE[1] / 2)))
    return shapes


def add_ring(model):
    around = DENSITY * 2 * math.pi * RING * math.pi * TUBE**2
    handle = DENSITY * HANDLE[1] * math.pi * HANDLE[0] ** 2
    mass, com, inertia = combined_inertia(
        [
            (10 * around, (0, 0, 0), cylinder_inertia(10 * around, RING, TUBE, "y")),
            (10 * handle, (0, 0, RING + HANDLE[1] / 2), cylinder_inertia(10 * handle, HANDLE[0], HANDLE[1])),
        ]
    )
    x, y, z = point(START)
    model.body(
        "ring",
        (x, y, z),
        mass=mass,
        com=com,
        inertia=tuple(max(moment, 2e-5) for moment in inertia),  # a slimmer one needs shorter steps
        mesh="ring.obj",
        compound=ring_shape(),
        friction=(0.2, 0.0),
        restitution=0.0,
        damping=(0.5, 0.5),
        **{
            "controller": {
                "linear": {"P": 60.0, "I": 0.0, "D": 4.0},
                "angular": {"P": 0.2, "I": 0.0, "D": 0.006},
            },
            "controller output type": "FORCE",
            "gravity": vector((0, 0, 0)),
            "collision margin": 0.0002,
        },
    )


def goal(name, t, hold):
    return {
        "name": name,
        "piece": "BODY ring",
        "location": {"position": vector(point(t))},
        "position tolerance": 0.006,
        "hold": hold,
        "released": False,
    }


def build(models):
    folder = MeshFolder(models, "ring_wire")
    folder.add("wire.obj", wire_mesh())
    folder.add("ring.obj", ring_mesh())
    folder.close()
    model = Model(
        "A ring on a bent wire: lead it to the other end without touching. The task counts touches.",
        namespace="/ambf/env/ring_wire/",
        meshes=folder.seen_from(2),
    )
    model.body(
        "wire",
        mesh="wire.obj",
        compound=wire_shape(),
        friction=(0.2, 0.0),
        restitution=0.0,
        **{"collision margin": 0.0002},
    )
    add_ring(model)
    goals = [goal(f"station {k + 1}", t, 0.0) for k, t in enumerate(STATIONS[:-1])]
    goals.append(goal("the end", STATIONS[-1], 0.3))
    model.add("tasks", "lead", parent="wire", order="listed", avoid=["BODY wire"], goals=goals)
    model.write(models / "descriptions" / "tasks" / "ring_wire.yaml")
