"""A skin pad with a wound in a clamp, a curved needle and its thread: the needle and the forceps that hold the thread's
end are moved by pose commands. docs/tissue.md"""

import math

import mesh_tools as mt
import touch_parts as parts
from adf_writer import Model, color_components, placed, pose, shape_box, shape_round, vector
from mesh_folder import MeshFolder

BASE = (0.100, 0.070)  # x, y of the plate
PLATE = 0.012
ELEMENT = 0.003
LIP, WOUND = (0.012, 0.018, 0.009), 0.003  # of each lip, of what is between them: whole elements
SKIN = 0.002  # of the upper layer, which is only drawn
BOTTOM = 0.020
TOP = BOTTOM + LIP[2]
OUTER = WOUND / 2 + LIP[0]
CLAMP = (0.014, 0.024, TOP + 0.001)  # its height from the bench
RADIUS = 0.026 / math.pi  # half a circle of 26 mm, as CT-1 needles have about
WIRE = 0.00035
NEEDLE_AT = (0.0, 0.0, TOP + 0.0225)
THREAD, THREAD_M = 0.00015, 0.120
FORCEPS_AT = (0.060, 0.0, TOP + 0.030)  # its tip: the end of the thread
SEEN = 0.004  # of the rays between its jaws
TILT = math.radians(35)  # of the forceps, outwards
ALONE = {"collision groups": [20]}


def arc(angle):
    """From the tip at 0 to the rear at pi; the frame is in the middle of the circle."""
    return (RADIUS * math.cos(angle), 0.0, RADIUS * math.sin(angle))


def needle_mesh():
    body = mt.ngon_tube([arc(math.pi * k / 40) for k in range(4, 41)], WIRE, 10, "steel")
    tip = []
    for k in range(6):  # a cone: rings ever narrower
        a, b = arc(math.pi * k / 50), arc(math.pi * (k + 1) / 50)
        tip.append(mt.ngon_tube([a, b], WIRE * (0.25 + 0.15 * k), 10, "steel"))
    return mt.joined([body, *tip])


def lip_mesh(side):
    """A box of two layers whose faces are divided, so that it bends as it is drawn."""
    nx, ny = 8, 12
    layers = [(0.0, LIP[2] - SKIN, 5, "coral"), (LIP[2] - SKIN, LIP[2], 2, "skin")]
    made = []
    for low, high, nz, color in layers:
        places, faces = {}, []

        def at(i, j, k, places=places, low=low, high=high, nz=nz):
            return places.setdefault((i, j, k), len(places)), (
                side * (WOUND / 2 + LIP[0] * i / nx),
                LIP[1] * (j / ny - 0.5),
                low + (high - low) * k / nz,
            )

        vertices = {}
        sizes = (nx, ny, nz)
        for axis in range(3):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            for end in (0, sizes[axis]):
                for p in range(sizes[u]):
                    for q in range(sizes[v]):
                        corners = []
                        for dp, dq in ((0, 0), (1, 0), (1, 1), (0, 1)):
                            cell = [0, 0, 0]
                            cell[axis], cell[u], cell[v] = end, p + dp, q + dq
                            index, place = at(*cell)
                            vertices[index] = place
                            corners.append(index)
                        if (end == 0) != (side < 0):
                            corners.reverse()
                        a, b, c, d = corners
                        faces += [(a, b, c), (a, c, d)]
        made.append(mt.Mesh([vertices[k] for k in range(len(vertices))], faces, color))
    return mt.joined(made)


def pad_mesh():
    return mt.joined([lip_mesh(side) for side in (-1, 1)]).moved(z=-LIP[2] / 2)


def coarse_pad():
    lip = mt.Mesh(
        [(x, y, z) for x in (0, LIP[0]) for y in (-LIP[1] / 2, LIP[1] / 2) for z in (-LIP[2] / 2, LIP[2] / 2)],
        [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6)]
        + [(0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)],
        "skin",
    )
    return mt.joined([lip.moved(x=WOUND / 2), lip.moved(x=-WOUND / 2 - LIP[0])])


def stand_mesh():
    pieces = [parts.base_plate(*BASE)]
    for side in (-1, 1):
        x = side * (OUTER + 0.0001 + CLAMP[0] / 2)
        height = CLAMP[2] - PLATE
        pieces.append(mt.box(CLAMP[0], CLAMP[1], height, 0.001, 0.002, "aluminium", 3).moved(x, 0, PLATE + height / 2))
        for y in (-0.007, 0.007):
            pieces.append(mt.screw(0.0028, 0.0018).moved(x, y, CLAMP[2]))
    return mt.joined(pieces)


def forceps_mesh():
    """Two blades that meet in the tip, at the origin, and reach up to +z."""
    blades = []
    for side in (-1, 1):
        blade = mt.box(0.0016, 0.003, 0.045, 0.0003, 0.0006, "steel", 3).moved(z=0.0225)
        blade = blade.turned(mt.rotation_about("y", side * math.radians(4.0))).moved(x=side * 0.0008)
        blades.append(blade)
    back = mt.box(0.0100, 0.0046, 0.012, 0.001, 0.0015, "teal", 3).moved(z=0.046)
    return mt.joined([*blades, back])


def thread_points():
    """From the needle's rear in a bow to the forceps; its slack falls at once."""
    start = tuple(a + b for a, b in zip(NEEDLE_AT, arc(math.pi), strict=True))
    apart = FORCEPS_AT[0] - start[0]

    def bow(height, n=24):
        return [
            (
                start[0] + apart * k / n,
                0.0,
                start[2] + (FORCEPS_AT[2] - start[2]) * k / n + height * math.sin(math.pi * k / n),
            )
            for k in range(n + 1)
        ]

    low, high = 0.0, 0.1
    for _ in range(60):
        middle = (low + high) / 2
        points = bow(middle)
        length = sum(math.dist(a, b) for a, b in zip(points, points[1:], strict=False))
        low, high = (middle, high) if length < THREAD_M else (low, middle)
    return points


def add_needle(model, needle_at, forceps_at, points, segment):
    """The needle, its thread along these places, and the forceps that hold the thread's end."""
    pieces = []
    for k in range(6):
        a = math.pi * (k + 0.5) / 6
        pieces.append(placed(shape_round("CAPSULE", WIRE, RADIUS * math.pi / 6, "z"), arc(a), (0, -a, 0)))
    model.body("needle", needle_at, mesh="needle.obj", compound=pieces, **ALONE)
    model.body(
        "forceps",
        forceps_at,
        (0, TILT, 0),
        mesh="forceps.obj",
        shape=(shape_box(0.006, 0.004, 0.048), (0, 0, 0.028), (0, 0, 0)),
        **ALONE,
    )
    model.add(
        "actuators",
        "stitch",
        "needle",
        type="Needle",
        arc=[vector(arc(a)) for a in (0.0, math.pi / 2, math.pi)],
        thread="SOFT thread",
        **{"puncture force": 0.05, "friction": 2.0, "strength": 5.0},
    )
    # Across the last millimetre of the thread, which they hold from the start.
    back = [a - b for a, b in zip(points[-2], points[-1], strict=True)]
    ahead = [part / math.hypot(*back) for part in back]
    turned = (
        ahead[0] * math.cos(TILT) - ahead[2] * math.sin(TILT),
        ahead[0] * math.sin(TILT) + ahead[2] * math.cos(TILT),
    )
    starts = [(turned[0] * s, -SEEN / 2, turned[1] * s) for s in (0.0003, 0.0006, 0.0009)]
    model.add("sensors", "between", "forceps", type="Proximity", range=SEEN, array=parts.rays(starts, (0, 1, 0)))
    model.add(
        "actuators",
        "grip",
        "forceps",
        type="Constraint",
        sensor="SENSOR between",
        trigger="sensor",
        hardness=300.0,
        damping=0.5,
    )
    model.add(
        "soft bodies",
        "thread",
        **{"color components": color_components("plum"), "collision groups": [21]},  # not needle and forceps
        location=pose((0, 0, 0)),
        tissue={
            "kind": "thread",
            "points": [vector(point) for point in points],
            "radius": THREAD,
            "young modulus": 1.0e8,
            "density": 1150.0,
            "element size": segment,
            "friction": 0.3,
        },
    )


def build(models):
    folder = MeshFolder(models, "suture_pad")
    folder.add("stand.obj", stand_mesh())
    folder.add("needle.obj", needle_mesh())
    folder.add("forceps.obj", forceps_mesh())
    folder.add("pad.obj", pad_mesh())
    folder.add("pad.obj", coarse_pad(), "low_res")
    folder.close()
    model = Model(
        "A skin pad with a wound, held by its outer sides; a curved needle with its thread, and forceps that hold the\n"
        "thread's end until a command says otherwise. Pose commands move both: the needle's frame is in the middle of\n"
        "its circle, the tip at +x; turned by 2 pi about y it goes through both lips. docs/tissue.md\n"
        "ambf_client_py/examples/sew_stitch.py sews.",
        namespace="/ambf/env/suture_pad/",
        meshes=folder.seen_from(3),
        low_resolution=True,
    )
    height = CLAMP[2] - PLATE
    model.body(
        "stand",
        mesh="stand.obj",
        compound=[
            placed(shape_box(*BASE, PLATE), (0, 0, PLATE / 2)),
            *(
                placed(
                    shape_box(CLAMP[0], CLAMP[1], height),
                    (side * (OUTER + 0.0001 + CLAMP[0] / 2), 0, PLATE + height / 2),
                )
                for side in (-1, 1)
            ),
        ],
        friction=(0.4, 0.01),
    )
    add_needle(model, NEEDLE_AT, FORCEPS_AT, thread_points(), 0.0015)
    model.add(
        "soft bodies",
        "pad",
        mesh="pad.obj",
        location=pose((0, 0, BOTTOM + LIP[2] / 2)),
        tissue={
            "kind": "solid",
            "young modulus": 2.0e4,
            "poisson ratio": 0.45,
            "density": 1070.0,
            "element size": 1.0004 * ELEMENT,
            "friction": 0.5,
            "regions": [
                {
                    "box": {"x": 0.001, "y": 2 * LIP[1], "z": 2 * LIP[2]},
                    "location": pose((side * OUTER, 0, 0)),
                    "fixed": True,
                }
                for side in (-1, 1)
            ],
        },
        **{"collision mesh": "pad.obj", "collision margin": 0.0002},
    )
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "suture_pad.yaml")
