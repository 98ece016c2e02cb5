"""A thread that two hands draw round two pegs and through their jaws (the dissertation's Fig. 6.12, Table 6.2).

52 capsules of 2 g, joined by ball joints. Jaws hold by resistive rays alone; these begin on patches that are wrapped
onto their round pads (Alg. 13, key `wrap`).
"""

import math

import mesh_tools as mt
import numpy as np
import scene_grippers as grippers
import touch_parts as parts
from adf_writer import (
    Model,
    box_inertia,
    combined_inertia,
    cylinder_inertia,
    placed,
    shape_box,
    shape_round,
    vector,
)
from mesh_folder import MeshFolder

PITCH, RADIUS, MASS = 0.008, 0.002, 0.002  # of a link, m and kg
# What a thread's twist and bending take up. Without it links spin about their own axes between the rays of the jaws.
LINK_DAMPING = (0.05, 10.0)
HEIGHT = 0.085  # of the thread
BASE = (0.36, 0.46, 0.012)
BASE_X = 0.055
BLOCK = (0.13, 0.12)  # x and y of the block that the thread lies on, between the pegs and the jaws
BLOCK_X = 0.005
PEG, PEG_TOP = 0.008, 0.104  # radius, m
PEG_Y = 0.024  # of both, to each side
ROOM = 0.0001  # between thread and pegs, thread and block, at the start
TAIL = 0.17  # x of the thread's ends
HAND_X = 0.10
FIRM, LOOSE = 0.0065, 0.018  # opening of each finger, m
PAD_AT = 0.71 * grippers.FINGER[2]  # of the pads from a palm
PAD_BULGE, PAD_WIDTH, PAD_ROUND = 0.002, 0.021, 0.03
RANGE = 0.020
PATCH = (0.018, 3, 0.018, 4)  # width, columns, height, rows
PATCH_OFF = 0.0003  # of the patch from the pad
PLATE = (0.05, 0.085, 0.012)  # that carries a hand, in its frame
PLATE_AT = (0.0, -0.0125, 0.078)
SLIDE = (0.05, 0.018, 0.04)
SLIDE_AT = (0.0, -0.054, 0.078)
HAND_MASS, FINGER_MASS = 0.7, 0.08
PULL = 0.06  # m to each side


def path():
    """Places of the joints: a straight leg, round both pegs, back again; two neighbours are PITCH apart."""
    # Middles of chords touch the pegs, so that no link begins inside one.
    around = math.hypot(PEG + RADIUS + ROOM, PITCH / 2)
    y = PEG_Y + around
    quarter = [0.5 * math.pi * k / 600 for k in range(600)]
    fine = [(TAIL * (1.0 - k / 4000), y) for k in range(4000)]
    fine += [(-around * math.sin(a), PEG_Y + around * math.cos(a)) for a in quarter]
    fine += [(-around, PEG_Y * (1.0 - k / 1200)) for k in range(1200)]
    fine += [(x, -other) for x, other in reversed(fine)]
    places = [fine[0]]
    for point in fine:
        apart = math.dist(point, places[-1])
        if apart >= PITCH:
            share = PITCH / apart
            places.append(tuple(a + (b - a) * share for a, b in zip(places[-1], point, strict=True)))
    return places


def link_mesh(color):
    return mt.capsule(RADIUS, PITCH + 2 * RADIUS, 14, color).along("x")


def pad_outline():
    """In x and y: round towards -y."""
    half = math.asin(PAD_WIDTH / 2 / PAD_ROUND)
    arc = [-half + 2.0 * half * k / 16 for k in range(17)]
    front = [(PAD_ROUND * math.sin(a), -PAD_BULGE + PAD_ROUND * (1.0 - math.cos(a))) for a in arc]
    return np.array([*front, (PAD_WIDTH / 2, 0.004), (-PAD_WIDTH / 2, 0.004)])


def finger_mesh(side):
    """The two-finger gripper's with a round pad."""
    pad = mt.extrude(pad_outline(), 0.52 * grippers.FINGER[2], 0.0006, 2, "rubber").moved(z=-PAD_AT)
    return grippers.finger_mesh(1.0) + pad if side > 0 else finger_mesh(1.0).turned(mt.rotation_about("z", math.pi))


def finger_hull(side):
    x, y, z = grippers.FINGER
    box = mt.box(x, y, z).moved(y=y / 2 + 0.0002, z=-z / 2)
    hull = box + mt.extrude(pad_outline(), 0.52 * z).moved(z=-PAD_AT)
    return hull if side > 0 else hull.turned(mt.rotation_about("z", math.pi))


def patch_mesh(side):
    """Flat, in front of the pad; its normals look at it."""
    width, columns, height, rows = PATCH
    vertices = [
        (width * (k / columns - 0.5), -0.008, height * (i / rows - 0.5) - PAD_AT)
        for i in range(rows + 1)
        for k in range(columns + 1)
    ]
    faces = []
    for i in range(rows):
        for k in range(columns):
            a = i * (columns + 1) + k
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            faces += [(a, c, b), (b, c, d)]
    mesh = mt.Mesh(vertices, faces, "rubber")
    return mesh if side > 0 else mesh.turned(mt.rotation_about("z", math.pi))


def hand_mesh():
    plate = mt.box(*PLATE, 0.001, 0.003, "aluminium").moved(*PLATE_AT)
    slide = mt.box(*SLIDE, 0.001, 0.003, "graphite").moved(*SLIDE_AT)
    return mt.joined([grippers.palm_mesh(), plate, slide])


def stand_mesh():
    top = HEIGHT - RADIUS - ROOM
    pieces = [parts.base_plate(BASE[0], BASE[1]).moved(x=BASE_X)]
    tall = top - BASE[2]
    pieces.append(mt.box(*BLOCK, tall, 0.0004, 0.006, "shell", 3).moved(x=BLOCK_X, z=BASE[2] + tall / 2))
    for s in (-1, 1):
        peg = mt.cylinder(PEG, PEG_TOP - top + 0.002, 0.002, 36, "steel")
        pieces.append(peg.moved(y=s * PEG_Y, z=(PEG_TOP + top - 0.002) / 2))
        rail_y = s * (hand_at(1)[1] + SLIDE_AT[2])
        rail = mt.box(2 * PULL + SLIDE[0] + 0.02, 0.014, 0.010, 0.001, 0.002, "steel")
        pieces.append(rail.moved(HAND_X, rail_y, BASE[2] + 0.005))
        for k in (-1, 1):
            stop = mt.box(0.006, 0.020, 0.014, 0.001, 0.002, "rubber")
            pieces.append(stop.moved(HAND_X + k * (PULL + SLIDE[0] / 2 + 0.007), rail_y, BASE[2] + 0.007))
    return mt.joined(pieces)


def hand_at(side):
    """Fingers point to the middle and open upwards and downwards."""
    return (HAND_X, side * (PEG_Y + PEG + RADIUS + PAD_AT), HEIGHT)


def add_hand(model, name, side):
    at, turn = hand_at(side), (math.pi / 2, 0.0, math.pi if side > 0 else 0.0)
    px, py, pz = grippers.PALM
    weightless = {"gravity": vector((0, 0, 0))}
    _, com, inertia = combined_inertia(
        [
            (HAND_MASS - 0.2, (0, 0, pz / 2), box_inertia(HAND_MASS - 0.2, px, py, pz)),
            (0.2, PLATE_AT, box_inertia(0.2, *PLATE)),
        ]
    )
    model.body(
        name,
        at,
        turn,
        mass=HAND_MASS,
        com=com,
        inertia=inertia,
        mesh="hand.obj",
        compound=[placed(shape_box(px, py, pz), (0, 0, pz / 2)), placed(shape_box(*PLATE), PLATE_AT)],
        **{"publish children names": True},
        **weightless,
    )
    model.joint(
        f"{name}-pull",
        "prismatic",
        "stand",
        name,
        at,
        (1, 0, 0),
        limits=(-PULL, PULL),
        damping=1.0,
        **parts.holding_motor(3.0, 0.02),
    )
    fx, fy, fz = grippers.FINGER
    for finger, sign in (("a", 1.0), ("b", -1.0)):
        child, place = f"{name}_finger_{finger}", (at[0], at[1], at[2] + sign * FIRM)
        model.body(
            child,
            place,
            turn,
            mass=FINGER_MASS,
            com=(0, sign * (fy / 2 + 0.0002), -fz / 2),
            inertia=box_inertia(FINGER_MASS, fx, fy, fz),
            mesh=f"finger_{finger}.obj",
            hull=f"finger_{finger}.obj",
            friction=(0.0, 0.0),
            restitution=0.0,
            **{"collision groups": [1] if finger == "a" else [2], "collision margin": 0.0001},
            **weightless,
        )
        model.joint(
            f"{name}-{finger}",
            "prismatic",
            name,
            child,
            at,
            (0, 0, sign),
            child_point=place,
            limits=(0.0, grippers.STROKE),
            damping=0.5,
            **parts.holding_motor(20.0, 0.06),
        )
        entries = parts.resistance(parts.THREAD, RANGE, [])
        del entries["array"]
        entries["visible size"] = 0.0008
        wrap = {"onto": f"finger_{finger}.obj", "offset": PATCH_OFF}
        model.add("sensors", f"{name}_rays_{finger}", child, mesh=f"patch_{finger}.obj", wrap=wrap, **entries)


def add_thread(model):
    """Its joints; every sixth link has another colour, so that its motion is seen."""
    places = path()
    for k, ((x0, y0), (x1, y1)) in enumerate(zip(places, places[1:], strict=False)):
        model.body(
            f"link{k}",
            ((x0 + x1) / 2, (y0 + y1) / 2, HEIGHT),
            (0.0, 0.0, math.atan2(y1 - y0, x1 - x0)),
            mass=MASS,
            inertia=cylinder_inertia(MASS, RADIUS, PITCH, "x"),
            mesh="link_light.obj" if k % 6 == 0 else "link.obj",
            shape=(shape_round("CAPSULE", RADIUS, PITCH + 2 * RADIUS, "x"), (0, 0, 0), (0, 0, 0)),
            friction=(0.3, 0.0),
            restitution=0.0,
            damping=LINK_DAMPING,
            **{"collision margin": 0.0002},
        )
        if k > 0:
            model.joint(f"knot{k}", "p2p", f"link{k - 1}", f"link{k}", (x0, y0, HEIGHT), (0, 0, 1), passive=True)


def build(models):
    folder = MeshFolder(models, "thread")
    folder.add("stand.obj", stand_mesh())
    folder.add("hand.obj", hand_mesh())
    for name, side in (("a", 1.0), ("b", -1.0)):
        folder.add(f"finger_{name}.obj", finger_mesh(side))
        folder.add(f"finger_{name}.obj", finger_hull(side), "low_res")
        folder.add(f"patch_{name}.obj", patch_mesh(side))
    folder.add("link.obj", link_mesh("plum"))
    folder.add("link_light.obj", link_mesh("ivory"))
    folder.close()
    model = Model(
        "A thread of 52 links of 2 g, round two pegs and through the jaws of two hands (Fig. 6.12 and Table 6.2 of\n"
        "the dissertation). Joints of stand: left_hand-pull, right_hand-pull (m) draw; <hand>-a, <hand>-b open the\n"
        f"fingers: {FIRM} m holds firmly, at {LOOSE} m the thread is easily drawn through the jaws.",
        namespace="/ambf/env/thread/",
        meshes=folder.seen_from(3),
        low_resolution=True,
    )
    top = HEIGHT - RADIUS - ROOM
    model.body(
        "stand",
        mesh="stand.obj",
        compound=[
            placed(shape_box(*BASE), (BASE_X, 0, BASE[2] / 2)),
            placed(shape_box(*BLOCK, top - BASE[2]), (BLOCK_X, 0, (BASE[2] + top) / 2)),
            *(
                placed(shape_round("CYLINDER", PEG, PEG_TOP - top + 0.01), (0, s * PEG_Y, (PEG_TOP + top - 0.01) / 2))
                for s in (-1, 1)
            ),
        ],
        friction=(0.5, 0.0),
        **{"publish children names": True},
    )
    add_thread(model)
    for name, side in (("left_hand", 1.0), ("right_hand", -1.0)):
        add_hand(model, name, side)
    model.write(models / "descriptions" / "multi-bodies" / "touch" / "thread.yaml")
