"""Suturing in the manner of AMBF 3.0's public suites: a pad with four pairs of holes, a needle with forty links of
thread, two arms with ghosts in their fingers and Constraint actuators, and a stereo endoscope. Names, namespaces and
order of joints are those that scripts of such suites look for; meshes, places and masses are our own.

The arms have the kinematics of a dVRK patient-side manipulator with a large needle driver: each body's frame is that of
its joint by modified Denavit-Hartenberg parameters, the base's that of the remote centre.
"""

import math

import mesh_tools as mt
import numpy as np
from adf_writer import (
    Model,
    block,
    cylinder_inertia,
    placed,
    shape_box,
    shape_round,
    vector,
)
from mesh_folder import MeshFolder
from suturing_arms import BASES, FINGER, NAMESPACE, arm, arm_ghosts, at, frame, ghost, header, looking, untouched

PAD = (0.200, 0.100, 0.020)  # m
TRENCH = 0.010  # m, between the two banks of the pad
SOFT = 0.018  # m, on either side of the middle: a needle goes through
HOLES = [(-0.024 + 0.016 * i) for i in range(4)]  # x of the pairs
NEEDLE_RADIUS, NEEDLE_THICKNESS = 0.0096, 0.0005
NEEDLE_ARC = (math.radians(173.8), math.radians(46.5))  # base to tip, about the needle frame's z
NEEDLE_AT = (0.030, 0.032, 0.0206)
LINKS, LINK, THREAD_RADIUS = 40, 0.0024, 0.0002


# --- the phantom -------------------------------------------------------------------------------------------------


def arc(count):
    """Points on the needle, base to tip."""
    angles = np.linspace(*NEEDLE_ARC, count)
    return [(NEEDLE_RADIUS * math.cos(a), NEEDLE_RADIUS * math.sin(a), 0.0) for a in angles]


def needle_mesh():
    points = arc(29)
    radii = [NEEDLE_THICKNESS * min(1.0, (29 - i) / 6.0) for i in range(29)]
    return mt.joined(
        [
            mt.capsule(radius, math.dist(a, b) + 2 * radius, 10, "brass").turned(turn_to(a, b)).moved(*middle(a, b))
            for a, b, radius in zip(points, points[1:], radii, strict=False)
        ]
    )


def middle(a, b):
    return [(x + y) / 2 for x, y in zip(a, b, strict=True)]


def turn_to(a, b):
    """Turns z to the direction from a to b, both in the plane z = 0."""
    heading = math.atan2(b[1] - a[1], b[0] - a[0])
    return mt.rotation_about("z", heading) @ mt.rotation_about("y", math.pi / 2)


def needle_shape(parts=8):
    points = arc(parts + 1)
    out = []
    for a, b in zip(points, points[1:], strict=False):
        heading = math.atan2(b[1] - a[1], b[0] - a[0])
        length = math.dist(a, b) + 2 * NEEDLE_THICKNESS
        out.append(placed(shape_round("CAPSULE", NEEDLE_THICKNESS, length, "x"), middle(a, b), (0.0, 0.0, heading)))
    return out


def pad_mesh():
    x, y, z = PAD
    bank = (y - TRENCH) / 2
    floor = mt.box(x, y, z / 2, 0.001, 0.003, "sand").moved(z=z / 4)
    banks = [
        mt.box(x - 0.002, bank, z * 0.6, 0.002, 0.003, "coral").moved(y=side * (TRENCH + bank) / 2, z=z * 0.7)
        for side in (-1, 1)
    ]
    return mt.joined([floor, *banks])


def add_meshes(files):
    folder = MeshFolder(files, "suturing")
    folder.add("needle.obj", needle_mesh())
    folder.add("pad.obj", pad_mesh())
    folder.add("hole.obj", mt.torus(0.0016, 0.0004, 24, 10, "graphite"))
    folder.add("thread.obj", mt.capsule(THREAD_RADIUS, LINK + 2 * THREAD_RADIUS, 8, "plum"))
    folder.add("base.obj", mt.cylinder(0.008, 0.016, 0.002, 24, "graphite"))
    folder.add("shaft.obj", mt.cylinder(0.0042, 0.24, 0.0005, 24, "carbon").moved(z=-0.12))
    folder.add("wrist.obj", mt.cylinder(0.003, 0.006, 0.0008, 20, "brass"))
    folder.add("finger.obj", mt.box(0.0022, FINGER, 0.0028, 0.0004, color="shell").moved(y=FINGER / 2))
    folder.close()


def lock(linear, angular):
    return {key: dict.fromkeys("xyz", value) for key, value in (("linear", linear), ("angular", angular))}


def limits(linear, angular):
    return {
        key: {"low": dict.fromkeys("xyz", -value), "high": dict.fromkeys("xyz", value)}
        for key, value in (("linear", linear), ("angular", angular))
    }


def six_dof(stiffness, damping, angle):
    """Joint entries of a spring that does not let its bodies part and turns by `angle` at most."""
    return {
        "joint limits": limits(0.0, angle),
        "stiffness": lock(0.0, stiffness),
        "damping": lock(0.0, damping),
        "equilibrium point": lock(0.0, 0.0),
    }


def hole_frames():
    """(name, frame) of the eight holes; z points out of the tissue, up and away from its bank's middle."""
    for i, x in enumerate(HOLES):
        for kind, side in (("Entry", 1.0), ("Exit", -1.0)):
            tilt = frame(mt.rotation_about("x", side * 0.6), (x, side * (TRENCH / 2 + 0.0006), PAD[2] - 0.0006))
            yield f"{kind}{i + 1}", tilt


def phantom():
    model = Model(
        "Pad with four pairs of holes, needle and thread. CameraFrame carries the endoscope.",
        meshes="./meshes/suturing",
        namespace=NAMESPACE + "phantom/",
    )
    model.body("CameraFrame", **at(looking((0.0, -0.085, 0.125), (0.0, 0.0, 0.015), (1, 0, 0))), **untouched(0.0))
    # Tissue that a needle goes through is drawn only: what stops it lies below, and beside the holes.
    x, y, z = PAD
    bank = y / 2 - SOFT
    boxes = [placed(shape_box(x, y, z / 4), (0, 0, z / 8))]
    boxes += [placed(shape_box(x, bank, z), (0, side * (SOFT + bank / 2), z / 2)) for side in (-1, 1)]
    model.body("Phantom", mesh="pad.obj", compound=boxes)
    for name, T in hole_frames():
        model.body(name, **at(T), mesh="hole.obj", **untouched(0.2))
        where, up = T[:3, 3], T[:3, 2]
        model.joint(f"Phantom-{name}", "six dof spring", "Phantom", name, where, up, **six_dof(100.0, 50.0, 0.1))
    ring = cylinder_inertia(0.1, NEEDLE_RADIUS, 0.001)
    model.body(
        "Needle",
        NEEDLE_AT,
        mass=0.1,
        inertia=ring,
        com=(-0.0016, 0.0054, 0.0),
        mesh="needle.obj",
        compound=needle_shape(),
        damping=(0.9, 0.9),
        **{"controller": dict.fromkeys(("linear", "angular"), {"P": 50.0, "I": 0.0, "D": 0.0})},
        **{"controller output type": "VELOCITY"},
    )
    add_thread(model)
    return model


def add_thread(model):
    """From the needle's base on, in a straight line along -x; each link's z points back to the one before."""
    base = [a + b for a, b in zip(NEEDLE_AT, arc(2)[0], strict=True)]
    turn = mt.rotation_about("y", math.pi / 2)
    before = "Needle"
    for i in range(LINKS):
        name = "Thread" if i == 0 else f"Thread_{i:03}"
        start = (base[0] - i * LINK, base[1], base[2])
        model.body(
            name,
            **at(frame(turn, (start[0] - LINK / 2, start[1], start[2]))),
            mass=0.0005,
            inertia=(1e-8, 1e-8, 1e-8),
            mesh="thread.obj",
            shape=(shape_round("CAPSULE", THREAD_RADIUS, LINK), (0, 0, 0), (0, 0, 0)),
            damping=(0.5, 0.5),
            **{"collision groups": [1 + i % 2], "passive": True},
        )
        if i == 0:
            model.joint("Needle-Thread", "fixed", before, name, start, (1, 0, 0))
        else:
            of_spring = six_dof(0.0002, 0.00002, 0.5236)
            model.joint(f"{before}-{name}", "six dof spring", before, name, start, (1, 0, 0), **of_spring)
        before = name


def hole_ghosts():
    lines = header("Ghosts that feel what is in a hole.", "phantom/", "ghost objects", [n for n, _ in hole_frames()])
    for name, _ in hole_frames():
        lines += ["", ghost(f"ghost{name}", f"GHOST {name}", f"BODY {name}", (0.005, 0.005, 0.00045), (0, 0, 0))]
    return "\n".join(lines) + "\n"


# --- the world ---------------------------------------------------------------------------------------------------


def eye(name, x):
    resolution = {"width": 640, "height": 480}
    return {
        "namespace": "cameras/",
        "name": name,
        "location": vector((x, 0.0, -0.01)),
        "look at": vector((x, 0.0, -1.0)),
        "up": vector((0, 1, 0)),
        "clipping plane": {"near": 0.001, "far": 10.0},
        "field view angle": 1.0,
        "monitor": 0 if x < 0 else 1,
        "parent": "BODY CameraFrame",
        "publish image": True,
        "publish image interval": 5,
        "publish image resolution": resolution,
        "publish depth": True,
        "publish depth resolution": resolution,
    }


def world():
    lines = [
        "# The bench with the suturing scene through a stereo endoscope, 4 mm between its eyes.",
        "# Generated by ambf_models/scripts/generate.py: change the script, not this file.",
        "adf version: 1.0",
        f"namespace: {NAMESPACE}",
        "environment: ../descriptions/world/lab_bench.yaml",
        "gravity: {x: 0.0, y: 0.0, z: -9.81}",
        "max iterations: 200",
        "lights: [light2]",
        "cameras: [cameraL, cameraR]",
        "",
        block(
            "light2",
            {
                "namespace": "lights/",
                "name": "light2",
                "location": vector((0.0, 0.0, 0.02)),
                "direction": vector((0, 0, -1)),
                "spot exponent": 0.3,
                "cutoff angle": 1.3,
                "shadow quality": 3,
                "parent": "BODY CameraFrame",
            },
        ),
    ]
    for name, x in (("cameraL", -0.002), ("cameraR", 0.002)):
        lines += ["", block(name, eye(name, x))]
    return "\n".join(lines) + "\n"


def launch():
    files = ["phantom", "ghosts", "psm1", "ghosts_actuators_psm1", "psm2", "ghosts_actuators_psm2"]
    lines = [
        "# Suturing with names of AMBF 3.0's suites: -l 0,1,2,3,4,5 loads all of it.",
        "# Generated by ambf_models/scripts/generate.py: change the script, not this file.",
        "world config: ./world.yaml",
        "color config: ../descriptions/color/colors.yaml",
        "input devices config: ../descriptions/input_devices/input_devices.yaml",
        "multibody configs:",
    ]
    lines += [f'  - "./{name}.yaml" # {i}' for i, name in enumerate(files)]
    return "\n".join(lines) + "\n"


def build(models):
    files = models / "suturing"
    add_meshes(files)
    phantom().write(files / "phantom.yaml")
    (files / "ghosts.yaml").write_text(hole_ghosts(), encoding="utf-8")
    for name in BASES:
        (files / f"{name}.yaml").write_text(arm(name), encoding="utf-8")
        (files / f"ghosts_actuators_{name}.yaml").write_text(arm_ghosts(name), encoding="utf-8")
    (files / "world.yaml").write_text(world(), encoding="utf-8")
    (files / "launch.yaml").write_text(launch(), encoding="utf-8")
