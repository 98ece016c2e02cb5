"""A membrane over organs, clamped along its rim, and two forceps that pose commands move: a sheet of tissue.
docs/tissue.md"""

import math

import mesh_tools as mt
import numpy as np
import scene_tissue
import touch_parts as parts
from adf_writer import Model, color_components, placed, pose, shape_box, shape_round, vector
from mesh_folder import MeshFolder

INSIDE = (0.168, 0.132)  # x, y of what the frame leaves free
RAIL, RAIL_TOP = 0.012, 0.0284  # m
PLATE = (0.208, 0.172, 0.008)
RIM = 0.030  # m, height of the membrane's rim
CELL = 0.006  # m
BULGE = 0.026  # m, of the membrane as loaded
YOUNG, POISSON, DENSITY, THICKNESS = 2.0e5, 0.45, 1060.0, 0.0005
MARGIN = 0.001
LIVER_AT, LIVER = (-0.030, 0.008, 0.028), (0.040, 0.040, 0.019)  # half lengths
GALL_AT, GALL = (0.006, -0.036, 0.027), (0.016, 0.011, 0.011)
BOWEL, BOWEL_Z = 0.0105, 0.0275
# Its middle, from one end to the other.
BOWEL_WAY = [(0.066, -0.040), (0.030, -0.012), (0.066, 0.004), (0.030, 0.024), (0.062, 0.042)]
FORCEPS_AT = {"left": (-0.030, 0.0, 0.080), "right": (0.040, 0.0, 0.080)}
TILT = {"left": math.radians(-30), "right": math.radians(30)}
RANGE = 0.006  # m below a tip
WET = {
    "diffuse": {"r": 1.0, "g": 0.93, "b": 0.91},
    "specular": dict.fromkeys("rgb", 0.6),
    "shininess": 70,
    "transparency": 0.75,
}
ALONE = {"collision groups": [20]}


class Vessels:
    """The membrane's picture: pale, with vessels that branch from its rim."""

    SIZE = (512, 400)  # pixels along x and y
    PALE, DARK = np.array([232.0, 186.0, 168.0]), np.array([150.0, 44.0, 48.0])

    def twigs(self):
        """Pieces (from, to, radius) in pixels, always the same."""
        chance = np.random.default_rng(7)
        w, h = self.SIZE
        tips = [((0.0, 0.35 * h), 0.1, 4.0), ((w, 0.6 * h), 3.3, 3.8), ((0.55 * w, 0.0), 1.4, 3.4)]
        tips += [((0.3 * w, float(h)), -1.3, 3.0)]
        while tips:
            (x, y), way, radius = tips.pop()
            for _ in range(int(chance.integers(5, 9))):
                way += float(chance.normal(0.0, 0.22))
                ahead = (x + 9.0 * math.cos(way), y + 9.0 * math.sin(way))
                yield (x, y), ahead, radius
                (x, y), radius = ahead, 0.985 * radius
            if radius > 0.7:
                side = float(chance.choice([-1.0, 1.0]))
                tips += [((x, y), way + 0.25 * side, 0.88 * radius), ((x, y), way - 0.7 * side, 0.62 * radius)]

    def pixels(self):
        w, h = self.SIZE
        x, y = np.meshgrid(np.arange(w) + 0.5, np.arange(h) + 0.5)
        share = np.zeros((h, w))
        for a, b, radius in self.twigs():
            along = np.array(b) - np.array(a)
            near = tuple(  # the pixels that it may reach: rows, columns
                slice(max(0, int(min(a[k], b[k]) - radius - 2)), max(0, int(max(a[k], b[k]) + radius + 3)))
                for k in (1, 0)
            )
            from_x, from_y = x[near] - a[0], y[near] - a[1]
            t = np.clip((from_x * along[0] + from_y * along[1]) / (along @ along), 0.0, 1.0)
            away = np.hypot(from_x - t * along[0], from_y - t * along[1])
            share[near] = np.maximum(share[near], np.clip(radius + 0.5 - away, 0.0, 1.0))
        color = self.PALE + 0.75 * share[..., None] * (self.DARK - self.PALE)
        return np.clip(color, 0.0, 255.0).astype(np.uint8)


def ellipsoid(half, segments, color):
    ball = scene_tissue.sphere(1.0, segments, color)
    return mt.Mesh(ball.vertices * np.array(half), ball.faces, color)


def hull(half, color):
    """62 corners, as many as hulls may have, a little out, so that the membrane lies on what is seen."""
    return ellipsoid([1.03 * length for length in half], 12, color)


def bowel_points():
    """A smooth way through BOWEL_WAY (Catmull and Rom)."""
    way = [BOWEL_WAY[0], *BOWEL_WAY, BOWEL_WAY[-1]]
    points = []
    for a, b, c, d in zip(way, way[1:], way[2:], way[3:], strict=False):
        a, b, c, d = (np.array(p) for p in (a, b, c, d))
        for t in np.linspace(0.0, 1.0, 8, endpoint=False):
            at = 0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3)
            points.append((*at, BOWEL_Z))
    return [*points, (*BOWEL_WAY[-1], BOWEL_Z)]


def bowel_mesh():
    points = bowel_points()
    waves = mt.ngon_tube(points, BOWEL, 20, "coral")
    ends = [scene_tissue.sphere(BOWEL, 20, "coral").moved(*at) for at in (points[0], points[-1])]
    return mt.joined([waves, *ends])


def membrane_mesh():
    """A row of triangles lies in the clamp on each side; the diagonals of squares take turns."""
    width, depth = INSIDE[0] + 2 * CELL, INSIDE[1] + 2 * CELL
    nx, ny = round(width / CELL), round(depth / CELL)

    def height(x, y):
        return BULGE * max(0.0, 1.0 - (2 * x / INSIDE[0]) ** 4) * max(0.0, 1.0 - (2 * y / INSIDE[1]) ** 4)

    vertices = []
    for i in range(nx + 1):
        for j in range(ny + 1):
            x, y = width * (i / nx - 0.5), depth * (j / ny - 0.5)
            vertices.append((x, y, 0.0))
    faces = []
    for i in range(nx):
        for j in range(ny):
            a, b = i * (ny + 1) + j, (i + 1) * (ny + 1) + j
            faces += [(a, b, b + 1), (a, b + 1, a + 1)] if (i + j) % 2 else [(a, b, a + 1), (b, b + 1, a + 1)]
    flat = mt.Mesh(vertices, faces).printed("vessels", width, depth, right=(1, 0, 0), up=(0, 1, 0))
    flat.vertices[:, 2] = [height(x, y) for x, y, _ in flat.vertices]
    return flat


def rails():
    """Middle x, y and lengths of the frame's sides."""
    x, y = (INSIDE[0] + RAIL) / 2, (INSIDE[1] + RAIL) / 2
    long, deep = INSIDE[0] + 2 * RAIL, INSIDE[1]
    return [(0, y, long, RAIL), (0, -y, long, RAIL), (x, 0, RAIL, deep), (-x, 0, RAIL, deep)]


def frame_mesh():
    pieces = [mt.box(*PLATE, 0.0015, 0.006, "night", 3).moved(z=PLATE[2] / 2)]
    for x, y, width, depth in rails():
        height = RAIL_TOP - PLATE[2]
        pieces.append(mt.box(width, depth, height, 0.0008, 0.001, "aluminium", 2).moved(x, y, PLATE[2] + height / 2))
        pieces.append(mt.box(width, depth, 0.003, 0.0008, 0.001, "aluminium", 2).moved(x, y, RIM + 0.0018))
    for x in (-1, 0, 1):
        for y in (-1, 1):
            at = (x * (INSIDE[0] + RAIL) / 2, y * (INSIDE[1] + RAIL) / 2, RIM + 0.0033)
            pieces.append(mt.screw(0.0028, 0.0018).moved(*at))
    return mt.joined(pieces)


def forceps_mesh():
    """Two blades that meet in the tip, at the origin, and reach up to +z."""
    blades = []
    for side in (-1, 1):
        blade = mt.box(0.0018, 0.0034, 0.055, 0.0003, 0.0007, "steel", 3).moved(z=0.0275)
        blade = blade.turned(mt.rotation_about("y", side * math.radians(4.0))).moved(x=side * 0.0009)
        blades.append(blade)
    back = mt.box(0.0110, 0.0050, 0.014, 0.001, 0.0015, "teal", 3).moved(z=0.058)
    return mt.joined([*blades, back])


def add_organs(model):
    model.body("liver", LIVER_AT, mesh="liver.obj", hull="liver.obj", friction=(0.3, 0.01))
    model.body("gall", GALL_AT, mesh="gall.obj", hull="gall.obj", friction=(0.3, 0.01))
    points = [np.array(point) for point in bowel_points()][::2]
    pieces = []
    for a, b in zip(points, points[1:], strict=False):
        way = b - a
        length = float(np.linalg.norm(way))
        turn = (math.pi / 2, 0.0, math.atan2(way[1], way[0]) + math.pi / 2)
        middle = tuple(float(v) for v in (a + b) / 2)
        pieces.append(placed(shape_round("CAPSULE", BOWEL, length + 2 * BOWEL, "z"), middle, turn))
    model.body("bowel", mesh="bowel.obj", compound=pieces, friction=(0.3, 0.01))


def add_grip(model, side, rays):
    """Forceps hold what their rays meet."""
    model.add("sensors", f"{side}_eyes", f"{side}_forceps", type="Proximity", range=RANGE, array=rays)
    model.add(
        "actuators",
        f"{side}_grip",
        f"{side}_forceps",
        type="Constraint",
        sensor=f"SENSOR {side}_eyes",
        hardness=300.0,
        damping=0.3,
    )


def add_forceps(model, side):
    model.body(
        f"{side}_forceps",
        FORCEPS_AT[side],
        (0, TILT[side], 0),
        mesh="forceps.obj",
        shape=(shape_box(0.006, 0.004, 0.056), (0, 0, 0.032), (0, 0, 0)),
        **ALONE,
    )
    down = (math.sin(TILT[side]), 0.0, -math.cos(TILT[side]))  # of the world, seen from the tilted body
    starts = [(x, y, 0.001) for x in (-0.003, 0.003) for y in (-0.003, 0.003)]
    add_grip(model, side, parts.rays(starts, down))


def add_membrane(model):
    rim = []
    for x, y, width, depth in rails():
        size = vector((width + 0.001, depth + 0.001, 0.004))
        rim.append({"box": size, "location": pose((x, y, 0)), "fixed": True})
    model.add(
        "soft bodies",
        "peritoneum",
        mesh="peritoneum.obj",
        **{"color components": {**color_components("skin"), **WET}},
        location=pose((0, 0, RIM)),
        tissue={
            "kind": "sheet",
            "thickness": THICKNESS,
            "young modulus": YOUNG,
            "poisson ratio": POISSON,
            "density": DENSITY,
            "friction": 0.2,
            "touches": "none",
            "regions": rim,
        },
        **{"collision mesh": "../high_res/peritoneum.obj", "collision margin": MARGIN},
    )


def build(models):
    folder = MeshFolder(models, "peritoneum")
    folder.print("vessels", Vessels())
    folder.add("frame.obj", frame_mesh())
    folder.add("liver.obj", ellipsoid(LIVER, 48, "liver"))
    folder.add("liver.obj", hull(LIVER, "liver"), "low_res")
    folder.add("gall.obj", ellipsoid(GALL, 32, "sage"))
    folder.add("gall.obj", hull(GALL, "sage"), "low_res")
    folder.add("bowel.obj", bowel_mesh())
    folder.add("forceps.obj", forceps_mesh())
    folder.add("peritoneum.obj", membrane_mesh())
    folder.close()
    model = Model(
        "A membrane over liver, gall bladder and bowel, clamped along its rim, and two forceps that pose commands\n"
        "move: each holds the nodes that the rays below its tip meet. ambf_client_py/examples/lift_membrane.py lifts\n"
        "it. docs/tissue.md",
        namespace="/ambf/env/peritoneum/",
        meshes=folder.seen_from(3),
        low_resolution=True,
    )
    height = RAIL_TOP - PLATE[2]
    model.body(
        "frame",
        mesh="frame.obj",
        compound=[
            placed(shape_box(*PLATE), (0, 0, PLATE[2] / 2)),
            *(placed(shape_box(w, d, height), (x, y, PLATE[2] + height / 2)) for x, y, w, d in rails()),
        ],
        friction=(0.4, 0.01),
    )
    add_organs(model)
    for side in ("left", "right"):
        add_forceps(model, side)
    add_membrane(model)
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "peritoneum.yaml")
