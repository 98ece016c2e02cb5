"""A cabinet whose door knows when it is shut and when it is open: two tasks of one sensor each. The hinge has friction,
so that the door stays where it is left."""

import mesh_tools as mt
import touch_parts as parts
from adf_writer import Model, box_inertia, placed, shape_box
from mesh_folder import MeshFolder

CABINET = (0.18, 0.30, 0.34)  # depth, width, height, m
WALL = 0.012
LEAF = (0.014, 0.296, 0.336)
MASS = 0.9  # kg
CLEAR = 0.001  # between cabinet and door
FRONT = CABINET[0] / 2
HINGE = (FRONT + CLEAR + LEAF[0] / 2, -LEAF[1] / 2)  # x, y
LIMITS = (0.0, 1.92)  # rad
AJAR = 0.8  # rad, at the start
FRICTION = 2e-4  # N m s: 0.2 N m of the hinge
OPEN_AT = 0.030  # m: so far to the left of the hinge the door is met from 96 degrees on


def walls():
    """Middle and size of each; the front is open."""
    x, y, z = CABINET
    return [
        ((0, 0, WALL / 2), (x, y, WALL)),
        ((0, 0, z - WALL / 2), (x, y, WALL)),
        ((0, -(y - WALL) / 2, z / 2), (x, WALL, z - 2 * WALL)),
        ((0, (y - WALL) / 2, z / 2), (x, WALL, z - 2 * WALL)),
        ((-(x - WALL) / 2, 0, z / 2), (WALL, y - 2 * WALL, z - 2 * WALL)),
        ((-WALL / 2, 0, z * 0.52), (x - 2 * WALL, y - 2 * WALL, 0.008)),
    ]


def cabinet_mesh():
    pieces = [mt.box(*size, 0.001, 0.001, "ivory").moved(*middle) for middle, size in walls()]
    bottles = [(-0.09, "teal"), (-0.04, "amber"), (0.02, "sky"), (0.08, "coral")]
    for k, (y, color) in enumerate(bottles):  # on the shelf and on the floor
        for z in (WALL, CABINET[2] * 0.52 + 0.004):
            tall = 0.070 + 0.012 * ((k + (z > WALL)) % 3)
            pieces.append(mt.cylinder(0.016, tall, 0.002, 24, color).moved(-0.01, y, z + tall / 2))
            pieces.append(mt.cylinder(0.008, 0.014, 0.001, 20, "shell").moved(-0.01, y, z + tall + 0.007))
    strike = mt.box(0.004, 0.006, 0.030, 0.001, color="steel").moved(FRONT - 0.002, CABINET[1] / 2 - 0.006, 0.17)
    return mt.joined([*pieces, strike])


def leaf_mesh():
    """Frame in the hinge's axis, at half its height; shut it reaches along +y."""
    x, y, z = LEAF
    middle = y / 2
    frame = [mt.box(x, y, 0.030, 0.001, 0.001, "slate").moved(y=middle, z=s * (z / 2 - 0.015)) for s in (-1, 1)] + [
        mt.box(x, 0.030, z - 0.06, 0.001, 0.001, "slate").moved(y=middle + s * (y / 2 - 0.015)) for s in (-1, 1)
    ]
    pane = mt.box(0.004, y - 0.058, z - 0.058, 0.0005, 0.001, "tinted").moved(y=middle)
    posts = [
        mt.cylinder(0.004, 0.020, 0.0005, 16, "steel").along("x").moved(0.016, y - 0.016, s * 0.04) for s in (-1, 1)
    ]
    bar = mt.cylinder(0.005, 0.110, 0.002, 20, "steel").moved(0.026, y - 0.016)
    hinges = [mt.cylinder(0.006, 0.040, 0.0008, 20, "steel").moved(0.004, 0.0, s * 0.11) for s in (-1, 1)]
    return mt.joined([*frame, pane, *posts, bar, *hinges])


def build(models):
    folder = MeshFolder(models, "door")
    folder.add("cabinet.obj", cabinet_mesh())
    folder.add("door.obj", leaf_mesh())
    folder.close()
    model = Model(
        "A cabinet with a door. Sensor `door_shut` is content while the door is shut, `door_open` while it is open\n"
        "by 96 degrees or more, each for 0.2 s. Joint `hinge` of cabinet: 0 shut, 1.92 rad wide open.",
        namespace="/ambf/env/door/",
        meshes=folder.seen_from(3),
    )
    model.body(
        "cabinet",
        mesh="cabinet.obj",
        compound=[placed(shape_box(*size), middle) for middle, size in walls()],
        **{"publish children names": True},
    )
    x, y, z = LEAF
    height = CABINET[2] / 2
    model.body(
        "door",
        (*HINGE, height),
        (0, 0, -AJAR),
        mass=MASS,
        com=(0, y / 2, 0),
        inertia=box_inertia(MASS, x, y, z),
        mesh="door.obj",
        compound=[
            placed(shape_box(x, y, z), (0, y / 2, 0)),
            placed(shape_box(0.010, 0.010, 0.110), (0.026, y - 0.016, 0)),
        ],
    )
    model.joint(
        "hinge",
        "revolute",
        "cabinet",
        "door",
        (*HINGE, height),
        (0, 0, -1),
        home=AJAR,
        limits=LIMITS,
        damping=0.02,
        **parts.holding_motor(4.0, FRICTION),
    )
    tasks = {"success when": "present", "hold": 0.2, "type": "Proximity"}
    strike = (FRONT - 0.004, CABINET[1] / 2 - 0.006, 0.17)
    model.add("sensors", "door_shut", "cabinet", range=0.008, array=parts.rays([strike], (1, 0, 0)), **tasks)
    # Along the front, to the left of the hinge: an open door crosses it.
    start = (HINGE[0], HINGE[1] - OPEN_AT, height)
    reach = {"range": 0.28, "array": parts.rays([start], (1, 0, 0))}
    model.add("sensors", "door_open", "cabinet", **reach, **tasks)
    model.write(models / "descriptions" / "multi-bodies" / "touch" / "door.yaml")
