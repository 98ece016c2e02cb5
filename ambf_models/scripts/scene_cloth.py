"""A checked cloth of 25 x 25 nodes that falls over a ball on a stand, and a loose ball beside it: a soft body in the
world of rigid ones. docs/soft_bodies.md"""

import math

import mesh_tools as mt
import numpy as np
from adf_writer import Model, placed, pose, shape_box, shape_round
from mesh_folder import MeshFolder

SIDE, COUNT = 0.32, 25  # m, nodes along it
MASS, MARGIN = 0.05, 0.003  # kg, m
BALL, HEIGHT = 0.065, 0.145  # m, radius of the ball on the stand and height of its middle
LOOSE, LOOSE_MASS = 0.024, 0.06
FOOT, POST = (0.13, 0.13, 0.012), 0.012
START = 0.235  # m, height of the cloth as loaded
TURN = 0.35  # rad


class Check:
    """The cloth's picture: a check of two shades, woven of threads that go over and under each other."""

    SIDE, PERIOD, THREADS = 640, 128, 160  # pixels, pixels, threads a side
    PALE, DARK = np.array([238.0, 233.0, 222.0]), np.array([30.0, 104.0, 128.0])

    def pixels(self):
        place = np.arange(self.SIDE) + 0.5
        stripe = (place % self.PERIOD < self.PERIOD / 2).astype(float)
        thread = np.sin(math.pi * self.THREADS * place / self.SIDE)
        share = 0.5 * (stripe[:, None] + stripe[None, :])
        over = thread[:, None] * thread[None, :]
        shade = 1.0 - 0.05 * (0.5 + 0.5 * over)
        color = (self.PALE + share[..., None] * (self.DARK - self.PALE)) * shade[..., None]
        hem = np.minimum(np.minimum(place, self.SIDE - place)[:, None], np.minimum(place, self.SIDE - place)[None, :])
        color[hem < 8.0] = 0.75 * self.DARK
        return np.clip(color, 0.0, 255.0).astype(np.uint8)


def sheet_mesh(side, count):
    """Level, seen from above; the diagonals of its squares take turns, so that it folds alike both ways."""
    at = side * (np.arange(count) / (count - 1) - 0.5)
    vertices = [(x, y, 0.0) for x in at for y in at]
    faces = []
    for i in range(count - 1):
        for j in range(count - 1):
            a, b = i * count + j, (i + 1) * count + j
            if (i + j) % 2:
                faces += [(a, b, b + 1), (a, b + 1, a + 1)]
            else:
                faces += [(a, b, a + 1), (b, b + 1, a + 1)]
    return mt.Mesh(vertices, faces)


def cloth_mesh(side=SIDE, count=COUNT):
    return sheet_mesh(side, count).printed("check", side, side)


def sphere(radius, segments, color):
    angles = [math.pi * (k / (segments // 2) - 0.5) for k in range(segments // 2 + 1)]
    profile = [(radius * math.cos(a), radius * math.sin(a)) for a in angles[1:-1]]
    return mt.lathe([(0.0, -radius), *profile, (0.0, radius)], segments, color)


def stand_mesh():
    foot = mt.box(*FOOT, 0.002, 0.012, "graphite", 4).moved(z=FOOT[2] / 2)
    post = mt.cylinder(POST, HEIGHT - FOOT[2], 0.001, 28, "aluminium").moved(z=(HEIGHT + FOOT[2]) / 2)
    return mt.joined([foot, post, sphere(BALL, 40, "ivory").moved(z=HEIGHT)])


def build(models):
    folder = MeshFolder(models, "cloth")
    folder.print("check", Check())
    folder.add("cloth.obj", cloth_mesh())
    folder.add("stand.obj", stand_mesh())
    folder.add("ball.obj", sphere(LOOSE, 28, "coral"))
    folder.close()
    model = Model(
        "A cloth that falls over a ball on a stand, and a loose ball. SoftBodyCmd to `cloth` pulls it.\n"
        "docs/soft_bodies.md",
        namespace="/ambf/env/cloth/",
        meshes=folder.seen_from(3),
    )
    post = HEIGHT - FOOT[2]
    model.body(
        "stand",
        mesh="stand.obj",
        compound=[
            placed(shape_box(*FOOT), (0, 0, FOOT[2] / 2)),
            placed(shape_round("CYLINDER", POST, post), (0, 0, FOOT[2] + post / 2)),
            placed({"shape": "SPHERE", "geometry": {"radius": BALL}}, (0, 0, HEIGHT)),
        ],
        friction=(0.6, 0.01),
    )
    inertia = 3 * (0.4 * LOOSE_MASS * LOOSE * LOOSE,)
    model.body(
        "ball",
        (0.10, 0.155, LOOSE),
        mass=LOOSE_MASS,
        inertia=inertia,
        mesh="ball.obj",
        shape=({"shape": "SPHERE", "geometry": {"radius": LOOSE}}, (0, 0, 0), (0, 0, 0)),
        friction=(0.6, 0.01),
        damping=(0.1, 0.4),
    )
    model.add(
        "soft bodies",
        "cloth",
        mesh="cloth.obj",
        mass=MASS,
        location=pose((0, 0, START), (0, 0, TURN)),
        config={"kLST": 0.5, "kDP": 0.03, "kDF": 0.8, "piterations": 4},
        **{"collision margin": MARGIN},
    )
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "cloth.yaml")
