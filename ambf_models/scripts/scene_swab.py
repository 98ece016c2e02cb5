"""A gauze swab, a lobe of liver with a fold of omentum over its thin end, two forceps that lay the swab on it, and a
gloved finger that presses: a cloth of links on tissue. Sizes are those of life. docs/tissue.md"""

import math

import mesh_tools as mt
import numpy as np
import scene_cloth
import scene_tissue
import touch_parts as parts
from adf_writer import Model, color_components, pose, shape_box, shape_round, vector
from mesh_folder import MeshFolder
from scene_peritoneum import Vessels, add_grip, forceps_mesh

BOARD = (0.21, 0.20, 0.010)  # m
BOARD_X = 0.008
LIVER, ROUND, DOME = (0.095, 0.150, 0.040), 0.015, 0.004  # before it is shaped: thick at -y, thin at +y
LIVER_X = -0.030
THIN, NARROW, BLUNT = 0.50, 0.36, 0.25  # by which the thin end is lower and narrower, and the thick end narrower
LIVER_TISSUE = {"young modulus": 5.0e3, "poisson ratio": 0.45, "density": 1060.0}
LIVER_SIZE = 0.026
# A fold of the omentum: fat between two layers of peritoneum.
OMENTUM_TISSUE = {"young modulus": 5.0e4, "poisson ratio": 0.45, "density": 950.0, "thickness": 0.0012}
WIDE, FIRST, HELD = 0.033, 0.006, 0.008  # m: half of its width, y where it begins, how much of its end is held
FATTY = {"diffuse": dict.fromkeys("rgb", 1.0), "specular": dict.fromkeys("rgb", 0.5), "shininess": 50}
CELL = 0.0088
SIDE, COUNT, MASS = 0.060, 13, 0.004  # of the swab: m, nodes along it, kg when it is moist
SWAB_AT = (0.064, -0.014)
# kKHR: what a finger presses on tissue would creep away beneath it else.
CONFIG = {"kLST": 0.5, "kDP": 0.03, "kDF": 1.0, "kKHR": 1.0, "piterations": 4, "bending constraint": 2}
MARGIN = 0.0005
SWAB_MARGIN = 0.0010
TILT = {"left": math.radians(28), "right": math.radians(-28)}
FORCEPS_AT = {"left": (0.037, -0.040, 0.080), "right": (0.037, 0.012, 0.080)}
FINGER, FINGER_LENGTH = 0.008, 0.065  # m, its radius
GLOVE = 0.0012  # m, by which it is drawn thicker: over what the swab and the liver give way into each other
FINGER_AT, FINGER_TILT = (-0.030, -0.065, 0.080), math.radians(20)


class Gauze:
    """The swab's picture: a loose weave, and the blue strip that X-rays show."""

    SIDE, THREADS = 512, 40  # pixels, threads a side
    PALE, GAP = np.array([246.0, 245.0, 240.0]), np.array([186.0, 185.0, 178.0])
    STRIP = np.array([38.0, 92.0, 190.0])

    def pixels(self):
        place = (np.arange(self.SIDE) + 0.5) / self.SIDE
        thread = np.abs(np.sin(math.pi * self.THREADS * place))
        gap = (1.0 - thread[:, None]) * (1.0 - thread[None, :])
        color = self.PALE + np.sqrt(gap)[..., None] * (self.GAP - self.PALE)
        strip = np.clip(1.0 - np.abs(place - 0.24) / 0.022, 0.0, 1.0)[None, :] * (0.75 + 0.25 * thread[:, None])
        color = color + np.clip(3.0 * strip, 0.0, 1.0)[..., None] * (self.STRIP - color)
        edge = np.minimum(place, 1.0 - place)
        hem = np.minimum(edge[:, None], edge[None, :])
        color[(hem > 0.030) & (hem < 0.036)] *= 0.86
        return np.clip(color, 0.0, 255.0).astype(np.uint8)


class Fat(Vessels):
    """The omentum's picture: lobules of fat, and the vessels between its layers."""

    LOBULE, BETWEEN = np.array([238.0, 190.0, 92.0]), np.array([196.0, 132.0, 58.0])

    def pixels(self):
        w, h = self.SIZE
        vessels = super().pixels().astype(float)
        share = np.clip((self.PALE - vessels) / (self.PALE - self.DARK), 0.0, 1.0).mean(axis=2, keepdims=True)
        chance = np.random.default_rng(11)
        seeds = chance.uniform((0.0, 0.0), (w, h), (420, 2))
        x, y = np.meshgrid(np.arange(w) + 0.5, np.arange(h) + 0.5)
        first, second = np.full((h, w), 1e9), np.full((h, w), 1e9)
        for at in seeds:
            away = np.hypot(x - at[0], y - at[1])
            second = np.minimum(second, np.maximum(first, away))
            first = np.minimum(first, away)
        border = np.clip(1.0 - (second - first) / 7.0, 0.0, 1.0)[..., None]
        color = self.LOBULE + border * (self.BETWEEN - self.LOBULE)
        color += np.clip(1.6 * share, 0.0, 1.0) * (self.DARK - color)
        return np.clip(color, 0.0, 255.0).astype(np.uint8)


def shaped(points):
    """Of places of the rounded block: a lobe with a domed upper side that tapers towards +y."""
    x, y, z = np.array(points, dtype=float).T
    z = z + DOME * np.cos(math.pi * x / LIVER[0]) * np.cos(math.pi * y / LIVER[1]) * (0.5 + z / LIVER[2])
    share = y / LIVER[1] + 0.5
    low = -0.5 * LIVER[2]
    z = low + (z - low) * (1.0 - THIN * share**3)
    return np.column_stack([x * (1.0 - NARROW * share**2 - BLUNT * (1.0 - share) ** 6), y, z])


def liver_mesh(spacing):
    block = scene_tissue.rounded_block(LIVER, ROUND, spacing, "liver")
    return mt.Mesh(shaped(block.vertices), block.faces, "liver")


def down_the_end(way):
    """y, z of the block's upper side and its end at +y, `way` (m) behind FIRST."""
    flat = 0.5 * LIVER[1] - ROUND - FIRST
    if way < flat:
        return FIRST + way, 0.5 * LIVER[2]
    turn = min(0.5 * math.pi, (way - flat) / ROUND)
    y, z = flat + FIRST + ROUND * math.sin(turn), 0.5 * LIVER[2] - ROUND * (1.0 - math.cos(turn))
    return y, z - max(0.0, way - flat - 0.5 * math.pi * ROUND)


def omentum_length():
    return 0.5 * LIVER[1] - ROUND - FIRST + 0.5 * math.pi * ROUND + LIVER[2] - 2.0 * ROUND


def omentum_mesh():
    """Lies on the lobe, half of its thickness and the margin above it, and hangs down its thin end."""
    length = omentum_length()
    nx, ny = round(2 * WIDE / CELL), round(length / CELL)

    def on_lobe(x, way):
        y, z = down_the_end(way)
        return shaped([(x, y, z)])[0]

    out, step = 0.5 * OMENTUM_TISSUE["thickness"] + MARGIN, 1e-5
    vertices, faces, flat = [], [], []
    for i in range(nx + 1):
        for j in range(ny + 1):
            x, way = WIDE * (2.0 * i / nx - 1.0), length * j / ny
            along_x = on_lobe(x + step, way) - on_lobe(x - step, way)
            normal = np.cross(along_x, on_lobe(x, way + step) - on_lobe(x, way - step))
            vertices.append(on_lobe(x, way) + out * normal / np.linalg.norm(normal))
            flat.append((x, way - 0.5 * length, 0.0))
    for i in range(nx):
        for j in range(ny):
            a, b = i * (ny + 1) + j, (i + 1) * (ny + 1) + j
            faces += [(a, b, b + 1), (a, b + 1, a + 1)] if (i + j) % 2 else [(a, b, a + 1), (b, b + 1, a + 1)]
    made = mt.Mesh(flat, faces).printed("fat", 2 * WIDE, length + 0.01, right=(1, 0, 0), up=(0, 1, 0))
    made.vertices[:] = vertices
    return made


def swab_mesh():
    return scene_cloth.sheet_mesh(SIDE, COUNT).printed("gauze", SIDE, SIDE)


def finger_mesh():
    """Gloved, up to +z: thicker at its joint, and the glove's cuff at its end."""
    radius = FINGER + GLOVE
    profile = [(radius * math.sin(a), FINGER - radius * math.cos(a)) for a in np.linspace(0.0, 0.5 * math.pi, 9)]
    profile[0] = (0.0, -GLOVE)
    for z in np.linspace(0.012, FINGER_LENGTH, 18):
        knuckle = 0.0009 * math.exp(-(((z - 0.030) / 0.008) ** 2))
        profile.append((radius + knuckle + 0.0008 * z / FINGER_LENGTH, float(z)))
    profile.append((0.0, FINGER_LENGTH))
    cuff = mt.torus(radius + 0.0008, 0.0011, 32, 10, "sky").moved(z=FINGER_LENGTH - 0.001)
    return mt.joined([mt.lathe(profile, 32, "sky"), cuff])


def add_tissue(model):
    middle = (LIVER_X, 0, BOARD[2] + 0.5 * LIVER[2])
    below = {"box": vector((0.2, 0.2, 0.016)), "location": pose((0, 0, -0.5 * LIVER[2])), "fixed": True}
    model.add(
        "soft bodies",
        "liver",
        mesh="liver.obj",
        **{"color components": color_components("liver")},
        location=pose(middle),
        tissue={
            "kind": "solid",
            **LIVER_TISSUE,
            "element size": LIVER_SIZE,
            "friction": 0.7,
            "touches": "others",
            "regions": [below],
        },
        **{"collision mesh": "liver.obj", "collision margin": MARGIN},
    )
    y, z = down_the_end(omentum_length())
    x, y, z = shaped([(0.0, y, z)])[0]
    end = {"box": vector((0.1, 0.02, 2.0 * HELD)), "location": pose((x, y, z)), "fixed": True}
    model.add(
        "soft bodies",
        "omentum",
        mesh="omentum.obj",
        **{"color components": FATTY},
        location=pose(middle),
        tissue={"kind": "sheet", **OMENTUM_TISSUE, "friction": 0.3, "touches": "others", "regions": [end]},
        **{"collision mesh": "../high_res/omentum.obj", "collision margin": MARGIN},
    )


def add_forceps(model, side):
    model.body(
        f"{side}_forceps",
        FORCEPS_AT[side],
        (TILT[side], 0, 0),
        mesh="forceps.obj",
        shape=(shape_box(0.006, 0.004, 0.056), (0, 0, 0.032), (0, 0, 0)),
        **{"collision groups": [20]},
    )
    down = (0.0, -math.sin(TILT[side]), -math.cos(TILT[side]))  # of the world, seen from the tilted body
    starts = [(x, y, 0.001) for x in (-0.002, 0.002) for y in (-0.002, 0.002)]
    add_grip(model, side, parts.rays(starts, down))


def build(models):
    folder = MeshFolder(models, "swab")
    folder.print("gauze", Gauze())
    folder.print("fat", Fat())
    folder.add("board.obj", mt.box(*BOARD, 0.002, 0.004, "teal", 3).moved(BOARD_X, 0, BOARD[2] / 2))
    folder.add("liver.obj", liver_mesh(0.0048))
    folder.add("liver.obj", liver_mesh(0.0095), "low_res")
    folder.add("omentum.obj", omentum_mesh())
    folder.add("swab.obj", swab_mesh())
    folder.add("forceps.obj", forceps_mesh().repainted("teal", "night"))
    folder.add("finger.obj", finger_mesh())
    folder.close()
    model = Model(
        "A gauze swab beside a lobe of liver with a fold of omentum over its thin end. Pose commands move two\n"
        "forceps, which hold what their rays meet, and a gloved finger. ambf_client_py/examples/lay_swab.py lays the\n"
        "swab on both, presses on it and draws it away. docs/tissue.md",
        namespace="/ambf/env/swab/",
        meshes=folder.seen_from(3),
        low_resolution=True,
    )
    model.body(
        "board",
        mesh="board.obj",
        shape=(shape_box(*BOARD), (BOARD_X, 0, BOARD[2] / 2), (0, 0, 0)),
        friction=(0.5, 0.01),
    )
    for side in ("left", "right"):
        add_forceps(model, side)
    model.body(
        "finger",
        FINGER_AT,
        (0, FINGER_TILT, 0),
        mesh="finger.obj",
        shape=(shape_round("CAPSULE", FINGER, FINGER_LENGTH, "z"), (0, 0, FINGER_LENGTH / 2), (0, 0, 0)),
        friction=(0.8, 0.01),
    )
    add_tissue(model)
    model.add(
        "soft bodies",
        "swab",
        mesh="swab.obj",
        mass=MASS,
        location=pose((*SWAB_AT, BOARD[2] + SWAB_MARGIN)),
        config=CONFIG,
        **{"collision mesh": "../high_res/swab.obj", "collision margin": SWAB_MARGIN},
    )
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "swab.yaml")
