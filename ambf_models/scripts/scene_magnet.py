"""A magnet on a small crane, above things of steel on the bench. It pulls with 10 N what touches it: it holds the disc,
could lift the bar, and leaves the weight of 12 N where it stands."""

import math

import mesh_tools as mt
import touch_parts as parts
from adf_writer import Model, box_inertia, combined_inertia, cylinder_inertia, placed, shape_box, shape_round, vector
from mesh_folder import MeshFolder

STEEL = 7850.0  # kg/m^3
BEAM = (0.04, 0.44, 0.03)
BEAM_HEIGHT = 0.30
COLUMN = 0.028
TROLLEY = (0.06, 0.05, 0.04)
TRAVEL = 0.12  # m, to each side
COIL = (0.028, 0.034, 0.30)  # radius, height, kg
COIL_HEIGHT = 0.11  # of its face
ROD_M, ROD = 0.20, 0.1  # length, kg
STRENGTH, RANGE = 10.0, 0.020  # N, m
DISC = (0.025, 0.012)  # radius, height: 1.8 N
WEIGHT = (0.030, 0.055)  # 12 N
BAR = (0.080, 0.022, 0.012)  # 1.6 N
SIDE = 0.11  # y of what stands on the bench
# Flat round things collide as boxes of about their area: box against box has four contact points.
SQUARE = math.sqrt(math.pi)
SUNK = 0.0002  # m: so far inside its face the coil's rays begin


def stand_mesh():
    pieces = [parts.base_plate(0.20, 0.48)]
    height = BEAM_HEIGHT - 0.012
    for y in (-0.20, 0.20):
        pieces.append(mt.box(COLUMN, COLUMN, height, 0.001, 0.004, "aluminium").moved(y=y, z=0.012 + height / 2))
    pieces.append(mt.box(*BEAM, 0.002, 0.005, "slate", 3).moved(z=BEAM_HEIGHT))
    return mt.joined(pieces)


def trolley_mesh():
    """Frame in the middle of the beam."""
    x, y, z = TROLLEY
    low = -BEAM[2] / 2
    sides = [mt.box(0.008, y, z + 0.02, 0.001, 0.003, "amber").moved(x=s * (x / 2 - 0.004), z=0.0) for s in (-1, 1)]
    wheels = [
        mt.cylinder(0.009, 0.006, 0.001, 24, "graphite").along("x").moved(s * (x / 2 - 0.010), w * 0.014, 0.024)
        for s in (-1, 1)
        for w in (-1, 1)
    ]
    floor = mt.box(x, y, 0.006, 0.001, 0.003, "amber").moved(z=low - 0.012)
    return mt.joined([*sides, *wheels, floor, parts.bearing(0.0062, 0.02).moved(z=low - 0.019)])


def coil_mesh():
    """Frame in the middle of its face, which looks down."""
    radius, height, _ = COIL
    core = mt.cylinder(0.010, 0.002, 0.0003, 28, "steel").moved(z=0.001)
    shoe = mt.tube(radius, 0.0195, 0.006, 0.0006, 40, "steel").moved(z=0.003)
    body = mt.cylinder(radius - 0.0015, height - 0.002, 0.001, 40, "coral").moved(z=height / 2 + 0.001)
    bands = [mt.collar(0.02, radius - 0.0008, z, z + 0.0024, 0.0004, 40, "brass") for z in (0.012, 0.018, 0.024)]
    rod = mt.cylinder(0.006, ROD_M, 0.0004, 24, "steel").moved(z=height + ROD_M / 2 - 0.001)
    return mt.joined([core, shoe, body, *bands, rod])


def add_steel(model, name, place, x, y, height):
    """A thing of this area and height; round ones are as wide as long."""
    mass = STEEL * x * y * height
    model.body(
        name,
        place,
        mass=mass,
        inertia=box_inertia(mass, x, y, height),
        mesh=f"{name}.obj",
        shape=(shape_box(x, y, height), (0, 0, 0), (0, 0, 0)),
        friction=(0.8, 0.01),
        **{"collision margin": 0.0002},
    )


def build(models):
    folder = MeshFolder(models, "magnet")
    folder.add("stand.obj", stand_mesh())
    folder.add("trolley.obj", trolley_mesh())
    folder.add("coil.obj", coil_mesh())
    folder.add("disc.obj", mt.cylinder(DISC[0], DISC[1], 0.001, 40, "steel"))
    folder.add("bar.obj", mt.box(*BAR, 0.001, 0.002, "aluminium"))
    knob = mt.collar(0.012, WEIGHT[0] + 0.0003, -0.006, 0.006, 0.0004, 40, "graphite")
    folder.add("weight.obj", mt.cylinder(WEIGHT[0], WEIGHT[1], 0.002, 40, "brass") + knob)
    folder.close()

    model = Model(
        "A magnet of 10 N on a crane. It holds a disc of 1.8 N, could lift the bar, and not the weight of 12 N.\n"
        "Joints of stand: `travel` (m, to the right) and `lift` (m, up).",
        namespace="/ambf/env/magnet/",
        meshes=folder.seen_from(3),
    )
    height = BEAM_HEIGHT - 0.012
    model.body(
        "stand",
        mesh="stand.obj",
        compound=[
            placed(shape_box(0.20, 0.48, 0.012), (0, 0, 0.006)),
            *(placed(shape_box(COLUMN, COLUMN, height), (0, y, 0.012 + height / 2)) for y in (-0.20, 0.20)),
            placed(shape_box(*BEAM), (0, 0, BEAM_HEIGHT)),
        ],
        friction=(0.6, 0.01),
        **{"publish children names": True, "collision margin": 0.0002, "collision groups": [1]},
    )
    weightless = {"gravity": vector((0, 0, 0)), "collision margin": 0.0002}
    # Stand, trolley and coil share no group: they do not touch each other.
    trolley = (TROLLEY[0], TROLLEY[1], TROLLEY[2] + 0.037)  # with wheels and bearing
    model.body(
        "trolley",
        (0, 0, BEAM_HEIGHT),
        mass=0.3,
        inertia=cylinder_inertia(0.3, 0.03, 0.05, "y"),
        mesh="trolley.obj",
        shape=(shape_box(*trolley), (0, 0, -0.0055), (0, 0, 0)),
        **{"collision groups": [2]},
        **weightless,
    )
    radius, tall, coil = COIL
    mass, com, inertia = combined_inertia(
        [
            (coil, (0, 0, tall / 2), cylinder_inertia(coil, radius, tall)),
            (ROD, (0, 0, tall + ROD_M / 2), cylinder_inertia(ROD, 0.006, ROD_M)),
        ]
    )
    model.body(
        "coil",
        (0, 0, COIL_HEIGHT),
        mass=mass,
        com=com,
        inertia=inertia,
        mesh="coil.obj",
        compound=[
            placed(shape_box(SQUARE * radius, SQUARE * radius, tall), (0, 0, tall / 2)),
            placed(shape_round("CYLINDER", 0.006, ROD_M), (0, 0, tall + ROD_M / 2)),
        ],
        friction=(0.8, 0.01),
        **{"collision groups": [3]},  # its rod runs through the beam
        **weightless,
    )
    model.joint(
        "travel",
        "prismatic",
        "stand",
        "trolley",
        (0, 0, BEAM_HEIGHT),
        (0, 1, 0),
        limits=(-TRAVEL, TRAVEL),
        damping=1.0,
        **parts.holding_motor(2.0, 0.003),
    )
    model.joint(
        "lift",
        "prismatic",
        "trolley",
        "coil",
        (0, 0, BEAM_HEIGHT),
        (0, 0, 1),
        limits=(-0.10, 0.10),
        child_point=(0, 0, BEAM_HEIGHT),
        damping=1.0,
        **parts.holding_motor(2.0, 0.012),
    )
    starts = [(0, 0, SUNK), *parts.circle_of(6, 0.012, SUNK), *parts.circle_of(6, 0.024, SUNK)]
    model.add("sensors", "face", "coil", type="Proximity", range=RANGE, array=parts.rays(starts, (0, 0, -1)))
    model.add("actuators", "magnet", "coil", type="Magnet", sensor="SENSOR face", trigger="sensor", strength=STRENGTH)
    floor = 0.012
    disc, weight = SQUARE * DISC[0], SQUARE * WEIGHT[0]
    add_steel(model, "disc", (0, 0, COIL_HEIGHT - DISC[1] / 2 - 0.0001), disc, disc, DISC[1])
    add_steel(model, "bar", (0, -SIDE, floor + BAR[2] / 2), *BAR)
    add_steel(model, "weight", (0, SIDE, floor + WEIGHT[1] / 2), weight, weight, WEIGHT[1])
    model.write(models / "descriptions" / "multi-bodies" / "touch" / "magnet.yaml")
