"""A lobe of liver in a dish, and a steel ball and a cube that lie on it: tissue that gives way and pushes back, with a
hard lump in it. docs/tissue.md"""

import math

import mesh_tools as mt
import numpy as np
from adf_writer import Model, placed, pose, shape_box
from mesh_folder import MeshFolder

LOBE, ROUND = (0.12, 0.09, 0.034), 0.012  # m
HOLLOW = -0.005  # m, of its upper side
YOUNG, POISSON, DENSITY, ELEMENT = 5.0e3, 0.45, 1060.0, 0.012  # healthy liver (docs/tissue.md)
DISH = (0.16, 0.13, 0.02)  # outside
WALL = 0.006
FLOOR = 0.008
BALL, BALL_MASS = 0.011, 0.030
CUBE, CUBE_MASS = 0.018, 0.016
LUMP = 0.011  # m, radius of a stiff lump within the lobe
LUMP_AT = (-0.03, 0.015, 0.004)


def rounded_block(size, radius, spacing, color, swell=0.0):
    """A block with round edges, its faces divided into squares of about `spacing`; `swell` raises its middle (m)."""
    half = np.array(size) / 2
    counts = [max(1, round(length / spacing)) for length in size]
    numbers, vertices, faces = {}, [], []

    def number(i):
        if i not in numbers:
            at = np.array([2.0 * half[k] * i[k] / counts[k] - half[k] for k in range(3)])
            core = np.clip(at, -(half - radius), half - radius)
            out = at - core
            at = core + out * (radius / np.linalg.norm(out)) if np.any(out) else at
            hump = math.cos(0.5 * math.pi * at[0] / half[0]) * math.cos(0.5 * math.pi * at[1] / half[1])
            at[2] += swell * hump * (0.5 + at[2] / size[2])
            numbers[i] = len(vertices)
            vertices.append(at)
        return numbers[i]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, counts[axis]):
            for i in range(counts[u]):
                for j in range(counts[v]):

                    def corner(du, dv, i=i, j=j, axis=axis, side=side, u=u, v=v):
                        place = [0, 0, 0]
                        place[axis], place[u], place[v] = side, i + du, j + dv
                        return number(tuple(place))

                    a, b, c, d = corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)
                    square = [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
                    faces += square if side else [t[::-1] for t in square]
    return mt.Mesh(vertices, faces, color)


def dish_mesh():
    floor = mt.box(DISH[0], DISH[1], FLOOR, 0.002, 0.010, "aluminium", 3).moved(z=FLOOR / 2)
    walls = []
    for x, y, width, depth in dish_walls():
        walls.append(mt.box(width, depth, DISH[2], 0.0015, 0.0028, "aluminium", 3).moved(x, y, DISH[2] / 2))
    return mt.joined([floor, *walls])


def dish_walls():
    x, y = (DISH[0] - WALL) / 2, (DISH[1] - WALL) / 2
    return [(x, 0, WALL, DISH[1]), (-x, 0, WALL, DISH[1]), (0, y, DISH[0], WALL), (0, -y, DISH[0], WALL)]


def sphere(radius, segments, color):
    angles = [math.pi * (k / (segments // 2) - 0.5) for k in range(segments // 2 + 1)]
    profile = [(radius * math.cos(a), radius * math.sin(a)) for a in angles[1:-1]]
    return mt.lathe([(0.0, -radius), *profile, (0.0, radius)], segments, color)


def build(models):
    folder = MeshFolder(models, "tissue")
    folder.add("lobe.obj", rounded_block(LOBE, ROUND, 0.004, "liver", HOLLOW))
    folder.add("lobe.obj", rounded_block(LOBE, ROUND, 0.008, "liver", HOLLOW), "low_res")
    folder.add("dish.obj", dish_mesh())
    folder.add("ball.obj", sphere(BALL, 40, "steel"))
    folder.add("cube.obj", mt.box(CUBE, CUBE, CUBE, 0.0015, 0.002, "ivory", 3))
    folder.close()
    model = Model(
        "A lobe of liver in a dish, with a hard lump in it, and a steel ball and a cube that lie on it.\n"
        "ambf_client_py/examples/press_tissue.py feels for the lump. docs/tissue.md",
        namespace="/ambf/env/tissue/",
        meshes=folder.seen_from(3),
        low_resolution=True,
    )
    model.body(
        "dish",
        mesh="dish.obj",
        compound=[
            placed(shape_box(DISH[0], DISH[1], FLOOR), (0, 0, FLOOR / 2)),
            *(placed(shape_box(w, d, DISH[2]), (x, y, DISH[2] / 2)) for x, y, w, d in dish_walls()),
        ],
        friction=(0.6, 0.01),
    )
    top = FLOOR + LOBE[2]
    model.body(
        "ball",
        (0.022, -0.012, top + BALL + 0.004),
        mass=BALL_MASS,
        inertia=3 * (0.4 * BALL_MASS * BALL * BALL,),
        mesh="ball.obj",
        shape=({"shape": "SPHERE", "geometry": {"radius": BALL}}, (0, 0, 0), (0, 0, 0)),
        friction=(0.5, 0.01),
        damping=(0.1, 0.4),
    )
    model.body(
        "cube",
        (-0.020, -0.022, top + CUBE / 2 + 0.004),
        mass=CUBE_MASS,
        inertia=3 * (CUBE_MASS * CUBE * CUBE / 6.0,),
        mesh="cube.obj",
        shape=(shape_box(CUBE, CUBE, CUBE), (0, 0, 0), (0, 0, 0)),
        friction=(0.5, 0.01),
        damping=(0.1, 0.2),
    )
    model.add(
        "soft bodies",
        "lobe",
        mesh="lobe.obj",
        location=pose((0, 0, FLOOR + LOBE[2] / 2 + 0.001)),
        tissue={
            "kind": "solid",
            "young modulus": YOUNG,
            "poisson ratio": POISSON,
            "density": DENSITY,
            "element size": ELEMENT,
            "friction": 0.5,
            "relaxation": {"share": 0.7, "time": 2.0},
            "regions": [
                {
                    "box": {"x": LOBE[0], "y": LOBE[1], "z": 0.002},
                    "location": pose((0, 0, -LOBE[2] / 2)),
                    "fixed": True,
                },
                {
                    "sphere": LUMP,
                    "location": pose(LUMP_AT),
                    "stiffness": 20.0,
                },
            ],
        },
        **{"collision mesh": "lobe.obj", "collision margin": 0.0005},
    )
    model.write(models / "descriptions" / "multi-bodies" / "soft" / "tissue.yaml")
