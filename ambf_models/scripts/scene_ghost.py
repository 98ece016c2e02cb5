"""Ghost objects: a needle that a gate feels, and a tank in which balls float.

The gate is a ring with a ghost in its hole; the needle, which floats where it is put, has another one at its tip. The
tank's filling is a ghost with `drag`, so that what falls in is stopped within millimetres and stays there.
"""

import math

import mesh_tools as mt
import touch_parts as parts
from adf_writer import (
    Model,
    color_components,
    combined_inertia,
    cylinder_inertia,
    placed,
    pose,
    shape_box,
    shape_round,
    vector,
)
from mesh_folder import MeshFolder

TANK = (0.12, 0.16, 0.14)  # outside, m
WALL = 0.004
TANK_Y = 0.11
FILL = 0.105  # height of the filling above the floor
BALLS = {"ball_low": (-0.030, 0.205, "amber"), "ball_high": (0.035, 0.285, "coral")}  # y in the tank, height, colour
BALL = (0.013, 0.010)  # radius, kg
GATE_Y = -0.10
GATE_HEIGHT = 0.15
RING = (0.030, 0.004)  # radius of the ring's middle line, of its tube
NEEDLE = (0.0012, 0.090)  # radius, length
GRIP = (0.006, 0.060)
TO_TIP = NEEDLE[1] + GRIP[1] / 2
NEEDLE_HOME = 0.09  # x of its tip
DRAG = 0.9


def walls():
    """Middle and size of each, in the tank's frame: the middle of its foot."""
    x, y, z = TANK
    return [
        ((0, 0, WALL / 2), (x, y, WALL)),
        *(((s * (x - WALL) / 2, 0, z / 2 + WALL / 2), (WALL, y, z - WALL)) for s in (-1, 1)),
        *(((0, s * (y - WALL) / 2, z / 2 + WALL / 2), (x - 2 * WALL, WALL, z - WALL)) for s in (-1, 1)),
    ]


def tank_mesh():
    """What holds the panes; they themselves are too clear to be seen."""
    x, y, z = TANK
    pieces = [mt.box(x + 0.006, y + 0.006, 0.006, 0.001, 0.003, "graphite").moved(z=0.003)]
    for sx in (-1, 1):
        for sy in (-1, 1):
            post = mt.box(0.006, 0.006, z, 0.0008, 0.001, "graphite")
            pieces.append(post.moved(sx * (x - 0.006) / 2, sy * (y - 0.006) / 2, z / 2))
    for s in (-1, 1):
        pieces.append(mt.box(0.006, y, 0.005, 0.0008, 0.001, "graphite").moved(x=s * (x - 0.006) / 2, z=z - 0.0025))
        pieces.append(mt.box(x, 0.006, 0.005, 0.0008, 0.001, "graphite").moved(y=s * (y - 0.006) / 2, z=z - 0.0025))
    return mt.joined(pieces)


def gate_mesh():
    """Frame in the middle of the ring; the needle passes along x."""
    low = -GATE_HEIGHT
    ring = mt.torus(*RING, 40, 14, "teal").along("x")
    tall = GATE_HEIGHT - RING[0] - 0.010
    post = mt.cylinder(0.004, tall, 0.0003, 20, "steel").moved(z=low + 0.010 + tall / 2)
    return mt.joined([ring, post, mt.cylinder(0.035, 0.012, 0.002, 36, "graphite").moved(z=low + 0.006)])


def needle_mesh():
    """Frame in the middle of its grip; the tip looks to -x."""
    radius, length = NEEDLE
    point = [(0.0, 0.0), (radius, 0.006), (radius, length), (0.0, length)]
    needle = mt.lathe(point, 16, "steel").along("x")
    grip = mt.cylinder(GRIP[0], GRIP[1], 0.0015, 28, "plum").along("x").moved(x=length + GRIP[1] / 2)
    rings = [
        mt.collar(0.004, GRIP[0] + 0.0006, z, z + 0.003, 0.0004, 28, "shell").along("x").moved(x=length)
        for z in (0.006, 0.012, 0.018)
    ]
    return mt.joined([needle, grip, *rings]).moved(x=-TO_TIP)


def ball_mesh():
    radius, steps = BALL[0], 16
    turns = [math.pi * (k / steps - 0.5) for k in range(steps + 1)]
    return mt.lathe([(max(0.0, radius * math.cos(a)), radius * math.sin(a)) for a in turns], 28, "rubber")


def ghost(model, name, parent, place, shape, color, transparency, **more):
    geometry = shape["geometry"]
    looks = {**color_components(color), "transparency": transparency}
    model.add(
        "ghost objects",
        name,
        parent,
        location=pose(place),
        **{
            "shape": shape["shape"],
            "geometry": geometry,
            "collision shape": shape["shape"],
            "collision geometry": geometry,
            "color components": looks,
            **more,
        },
    )


def build(models):
    folder = MeshFolder(models, "ghost")
    folder.add("tank.obj", tank_mesh())
    folder.add("gate.obj", gate_mesh())
    folder.add("needle.obj", needle_mesh())
    folder.add("ball.obj", ball_mesh())
    folder.close()
    model = Model(
        "Ghost objects. `gate` feels the needle in its ring, `tip` what the needle's point is in, `filling` the balls\n"
        "that fall into the tank, and stops them (drag).",
        namespace="/ambf/env/ghost/",
        meshes=folder.seen_from(3),
    )
    model.body(
        "tank", (0, TANK_Y, 0), mesh="tank.obj", compound=[placed(shape_box(*size), middle) for middle, size in walls()]
    )
    inside = (TANK[0] - 2 * WALL, TANK[1] - 2 * WALL, FILL)
    ghost(model, "filling", "tank", (0, 0, WALL + FILL / 2), shape_box(*inside), "sky", 0.35, drag=DRAG)
    radius, mass = BALL
    for name, (y, height, color) in BALLS.items():
        model.body(
            name,
            (0, TANK_Y + y, height),
            mass=mass,
            inertia=(0.4 * mass * radius**2,) * 3,
            mesh="ball.obj",
            color=color,
            shape=({"shape": "SPHERE", "geometry": {"radius": radius}}, (0, 0, 0), (0, 0, 0)),
        )
    post = GATE_HEIGHT - RING[0]
    model.body(
        "gate_post",
        (0, GATE_Y, GATE_HEIGHT),
        mesh="gate.obj",
        compound=[
            placed(shape_round("CYLINDER", 0.035, 0.012), (0, 0, 0.006 - GATE_HEIGHT)),
            placed(shape_round("CYLINDER", 0.004, post), (0, 0, -RING[0] - post / 2)),
            *(
                placed({"shape": "SPHERE", "geometry": {"radius": RING[1]}}, (0, y, z))
                for y, z, _ in parts.circle_of(20, RING[0])
            ),
        ],
    )
    hole = RING[0] - RING[1]
    ghost(model, "gate", "gate_post", (0, 0, 0), shape_round("CYLINDER", hole, 0.003, "x"), "sage", 0.45)
    length = NEEDLE[1]
    mass, com, inertia = combined_inertia(
        [
            (0.004, (length / 2 - TO_TIP, 0, 0), cylinder_inertia(0.004, *NEEDLE, "x")),
            (0.030, (0, 0, 0), cylinder_inertia(0.030, *GRIP, "x")),
        ]
    )
    model.body(
        "needle",
        (NEEDLE_HOME + TO_TIP, GATE_Y, GATE_HEIGHT),
        mass=mass,
        com=com,
        inertia=inertia,
        mesh="needle.obj",
        damping=(0.5, 0.5),
        compound=[
            placed(shape_round("CYLINDER", NEEDLE[0], length, "x"), (length / 2 - TO_TIP, 0, 0)),
            placed(shape_round("CYLINDER", *GRIP, "x"), (0, 0, 0)),
        ],
        gravity=vector((0, 0, 0)),
        controller={"linear": {"P": 20.0, "I": 0.0, "D": 1.5}, "angular": {"P": 0.01, "I": 0.0, "D": 0.0001}},
        **{"controller output type": "FORCE", "collision margin": 0.0002},
    )
    # A ghost's place is in the frame of its parent's centre of mass.
    tip = {"shape": "SPHERE", "geometry": {"radius": 0.004}}
    ghost(model, "tip", "needle", (-TO_TIP - com[0], 0, 0), tip, "coral", 0.5)
    model.write(models / "descriptions" / "multi-bodies" / "touch" / "ghost.yaml")
