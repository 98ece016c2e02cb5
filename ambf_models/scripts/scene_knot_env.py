"""The original's KnotEnv (dissertation, Fig. 6.12), ten times as large as life: two threads of beads and rods between
two mounts on a base.

Names, order, places, masses, joints and the primitives that collide are those of the original's file, so that scripts
and scalings of devices for it fit; the meshes are ours, and the pieces of a thread are evenly spaced (the original's
differ by up to 2 mm). `scene_thread` has a thread of Table 6.2 in two hands.
"""

import math

import mesh_tools as mt
import outlines
import shaped_holes as sh
from adf_writer import Model, addon_gains, box_inertia, cylinder_inertia, shape_box, shape_round
from mesh_folder import MeshFolder
from scene_practice import ball_mesh
from scene_puzzles import STILL
from scene_worlds import View

BASE, BASE_AT = (1.555, 2.261, 0.048), (1.088, 0.0, -1.174)
MOUNT, MOUNT_AT = (0.618, 2.261, 0.412), (0.0, 0.0, -0.993)
TOP, TOP_AT = (0.541, 1.978, 0.053), (0.0, 0.0, -0.760)
POST, POSTS = (0.396, 0.223, 0.537), {"L": (0.0, -0.779, -0.475), "R": (0.0, 0.779, -0.470)}
THREADS = (0.1, -0.1)  # x
RIGHT, LEFT, HEIGHT = 0.641, -0.650, -0.294  # y of the threads' ends, and z
# The pieces of the first thread from right to left, as the original numbers them: a rod and the bead at its end.
ORDER = ("", "_001", "_003", "_002", "_007", "_006", "_004", "_005", "_015", "_014", "_012", "_013", "_008", "_009")
ORDER = (*ORDER, "_011", "_010")
PITCH = (RIGHT - LEFT) / len(ORDER)
BEAD, ROD = 0.017, (0.0175, 0.076)
BEND = 0.175
STIFFER = ("_004", "_011")  # rods that turn about the thread by half as much
TABLE, TABLE_MIDDLE, TABLE_TOP = (3.2, 3.2, 0.08), (0.75, 0.0), -1.199


def numbered(kind, number, thread):
    """The second thread's pieces have an _001 behind their names, but for the first two."""
    if thread == 0:
        return f"{kind}{number}"
    return f"{kind}_001_002" if not number else f"{kind}{number}_001"


def beads(thread):
    """From right to left."""
    ends = ("BeadRAttachRight", *(f"BeadR{n}" for n in ORDER[:-1]), "BeadRAttachLeft")
    if thread == 0:
        return ends
    first, last = (f"{ends[end]}_001" for end in (0, -1))
    return (first, *(numbered("BeadR", n, 1) for n in ORDER[:-1]), last)


def rods(thread):
    return tuple(numbered("ThreadR", n, thread) for n in ORDER)


def add_bodies(model):
    """In the order of their names, as in the original's file."""
    groups = {"collision groups": [0]}
    made = {}
    for name, mass, size, at in (
        ("Base", 10.0, BASE, BASE_AT),
        ("BaseMount", 10.0, MOUNT, MOUNT_AT),
        ("BaseMountTop", 10.0, TOP, TOP_AT),
        ("ThreadMountL", 1.0, POST, POSTS["L"]),
        ("ThreadMountR", 1.0, POST, POSTS["R"]),
    ):
        shape = (shape_box(*size), (0, 0, 0), (0, 0, 0))
        mesh = "post.obj" if size is POST else f"{name}.obj"
        made[name] = {"position": at, "mass": mass, "inertia": box_inertia(mass, *size), "mesh": mesh, "shape": shape}
    ball, rod = {"shape": "SPHERE", "geometry": {"radius": BEAD}}, shape_round("CYLINDER", *ROD)
    for thread, x in enumerate(THREADS):
        color = ("coral", "sky")[thread]
        for k, name in enumerate(beads(thread)):
            made[name] = {
                "position": (x, RIGHT - k * PITCH, HEIGHT),
                "mass": 0.002,
                "inertia": (0.4 * 0.002 * BEAD * BEAD,) * 3,
                "mesh": "bead.obj",
                "color": "ivory",
                "shape": (ball, (0, 0, 0), (0, 0, 0)),
            }
        for k, name in enumerate(rods(thread)):
            made[name] = {
                "position": (x, RIGHT - (k + 0.5) * PITCH, HEIGHT),
                "orientation": (math.pi / 2, 0.0, 0.0),
                "mass": 0.005,
                "inertia": cylinder_inertia(0.005, *ROD),
                "mesh": "rod.obj",
                "color": color,
                "shape": (rod, (0, 0, 0), (0, 0, 0)),
            }
    for name in sorted(made, key=str.lower):
        model.body(name, **made[name], **STILL, **groups)


def add_joints(model):
    """In the order of the bodies that they carry; the ends' second joints follow those of the left ends."""

    def joined(parent, child, kind="fixed", axis=(0, 0, 1), **more):
        at = tuple(model.bodies[child]["location"]["position"].values())
        model.joint(f"{parent}-{child}", kind, parent, child, at, axis, **more)

    def turning(parent, child, axis, bend=BEND, p=7.0, **more):
        joined(parent, child, "revolute", axis, limits=(-bend, bend), **addon_gains(p), **more)

    joined("Base", "BaseMount", **addon_gains(20000.0))
    joined("BaseMount", "BaseMountTop", **addon_gains(20000.0))
    before = {}  # a piece: the one on its right, and whether it bends there or turns about the thread
    for thread in range(len(THREADS)):
        for rod, right, left in zip(rods(thread), beads(thread)[:-1], beads(thread)[1:], strict=True):
            before[rod], before[left] = right, rod
    order = [name for name in model.bodies if name in before]
    across = (1, 0, 0)
    for bead in (name for name in order if name.startswith("Bead")):
        turning(before[bead], bead, across)
    for mount, end in (
        ("L", "Left"),
        ("R", "Right"),
        ("R", "Right_001"),
        ("L", "Left_001"),
    ):
        turning(f"ThreadMount{mount}", f"BeadRAttach{end}", across, p=1002.0, detached=True)
    for mount in POSTS:
        joined("BaseMountTop", f"ThreadMount{mount}", **addon_gains(11000.0))
    stiffer = {numbered("ThreadR", number, thread) for number in STIFFER for thread in (0, 1)}
    for rod in (name for name in order if name.startswith("Thread")):
        turning(before[rod], rod, (0, -1, 0), 0.087 if rod in stiffer else BEND)


def knot_env(folder):
    model = Model(
        "Two threads of rods and beads between two mounts (dissertation, Fig. 6.12), ten times as large as life.\n"
        "Names, places and joints as in the original's KnotEnv; frames: middles. Bead and rod bend about x and turn\n"
        "about the thread, in turns, by 0.175 rad each: a thread of 16 rods makes half a ring at most.",
        "/ambf/env/KnotEnv/",
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    add_bodies(model)
    add_joints(model)
    return model


def plate_mesh(size, color):
    return mt.extrude(outlines.rectangle(size[0], size[1], 0.03, 6), size[2], 0.008, 2, color)


def post_mesh():
    """With two eyes on its inner side, where the threads begin."""
    body = mt.extrude(outlines.rectangle(POST[0], POST[1], 0.02, 4), POST[2], 0.012, 2, "aluminium")
    eyes = [mt.cylinder(0.03, POST[1] + 0.012, 0.004, 24, "graphite").along("y").moved(x, 0, 0.178) for x in THREADS]
    return mt.joined([body, *eyes])


def build(models):
    studies = models / "studies"
    studies.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "knot_env")
    folder.add("Base.obj", plate_mesh(BASE, "night"))
    folder.add("BaseMount.obj", plate_mesh(MOUNT, "graphite"))
    folder.add("BaseMountTop.obj", plate_mesh(TOP, "slate"))
    folder.add("post.obj", post_mesh())
    folder.add("bead.obj", ball_mesh(BEAD, "shell"))
    folder.add("rod.obj", mt.cylinder(*ROD, 0.003, 20, "shell"))
    folder.add("table.obj", sh.table_mesh(TABLE))
    folder.close()
    knot_env(folder).write(studies / "knot_env.yaml")
    title = f"The table of the threads' scene; its top is at z = {TABLE_TOP}."
    made = sh.table(folder, title, "table.obj", TABLE_MIDDLE, TABLE_TOP, TABLE, 0.8)
    made.write(studies / "knot_env_table.yaml")
    view = View((2.3, 0.55, 0.75), (0.15, 0.0, -0.62), 0.6)
    title = "A table with the threads' scene in view, from where the operator sits."
    world = sh.world(title, "knot_env_table.yaml", (0.1, 0.0, -0.6), 1.6, view)
    (studies / "knot_env_world.yaml").write_text(world, encoding="utf-8")
    title = "The original's KnotEnv, ten times as large as life: -l 0."
    text = sh.launch(title, "knot_env_world.yaml", ("./knot_env.yaml",))
    (studies / "launch_knot_env.yaml").write_text(text, encoding="utf-8")
