"""Patient cart of the da Vinci Research Kit: four set-up arms of six joints on a column.

Names, order, types and home frames are those of the original AMBF's file, which has five joints an arm (the
endoscope's four); the missing ones come last, as bodies L5 (the endoscope's L4 and L5). Numbers: the published
kinematics (columns, links, mounts of the arms) and the original's masses. Chosen, since no source has them: limits that
let every joint reach the published simulated positions, motors' forces, masses of the added links, centres of mass,
inertias (of boxes as large as the links), shapes. The original's frames of PSM3's last links are lower than its
published axes: the frames are kept, the axes are where they are published.
"""

import math

import adf_kinematics as kinematics
import dvrk_parts as dvrk
import mesh_tools as mt
import numpy as np
import robot_files
from adf_writer import Model, vector
from dvrk_parts import Link, servo
from mesh_folder import MeshFolder
from suturing_arms import frame, step

HALF = math.pi / 2
ZERO = (0.0,) * 6
# Published rows after the column's slide: (alpha, a, theta, d) of joints 2 to 6, modified Denavit-Hartenberg.
OUT, REACH = 0.0896, 0.4318  # m: from a column to its first axis, from one upright axis to the next
PSM_END = ((HALF, 0.0, 0.0, 0.4089), (-HALF, 0.0, -HALF, -0.1029))
ROWS = {
    "psm1": ((0, 0, 0, 0.4166), (0, REACH, 0, 0.1429), (0, REACH, HALF, -0.1302), *PSM_END),
    "psm2": ((0, 0, 0, 0.4166), (0, REACH, 0, 0.1429), (0, REACH, HALF, -0.1302), *PSM_END),
    "psm3": ((0, 0, 0, 0.3404), (0, 0.5842, 0, 0.1429), (0, REACH, HALF, 0.2571), *PSM_END),
    "ecm": (
        (0, 0, 0, 0.4166),
        (0, REACH, 0, 0.1429),
        (0, REACH, HALF, -0.3459),
        (-0.7853, 0, HALF, 0),
        (0, -0.0667, 0, 0),
    ),
}
# Columns in the original's world: place, and the direction in which the arm reaches.
COLUMNS = {
    "ecm": ((0.0, 0.0, 0.43), 0.0),
    "psm1": ((-0.1016, 0.1016, 0.43), HALF),
    "psm2": ((-0.1016, -0.1016, 0.43), -HALF),
    "psm3": ((0.0, 0.0, 0.1264), 0.0),
}
# The arm's base in the last link's frame.
MOUNT = {"psm": (0.4864, 0.0, 0.1524), "ecm": (0.6126, 0.0, 0.1016)}
MOUNT_TURN = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
# Heights (m) and orientations of the original's frames at home; they lie on the joints' axes.
UP = (0.0, -HALF, 0.0)
HOME_HEIGHTS = {
    "ecm": (0.761, 0.761, 0.932, 0.880),
    "psm1": (0.761, 0.761, 0.932, 0.932, 0.859),
    "psm2": (0.761, 0.761, 0.932, 0.932, 0.859),
    "psm3": (0.381, 0.381, 0.381, 0.381, 0.581),
}
HOME_TURNS = {
    "ecm": (UP, (0, 0, HALF), (0, 0, -math.pi), (0, 0, 0)),
    "psm1": ((HALF, -HALF, 0), (0, 0, 0), (0, 0, HALF), (0, 0, 0), (-HALF, 0, 0)),
    "psm2": ((-HALF, -HALF, 0), (0, 0, math.pi), (0, 0, -HALF), (0, 0, math.pi), (HALF, 0, 0)),
    "psm3": (UP, (0, 0, HALF), (0, 0, -math.pi), (0, 0, -HALF), (-HALF, 0, -HALF)),
}
LAST_FRAME = 0.061  # m: of L4, from the axis before it
SIMULATED = {  # the published positions of a simulated cart; m, rad
    "ecm": (0.6647, 0.5782, -1.2662, 3.7818, 0.0, 0.0),
    "psm1": (0.0007, -0.5892, -0.8590, -0.6241, -0.2479, -0.4422),
    "psm2": (0.0628, 0.0913, 1.9073, -0.1297, 0.4351, 0.0353),
    "psm3": (-0.0261, -1.5892, 1.3076, 0.6994, 0.1361, 0.3359),
}
MASSES = {  # kg
    "ecm": (8.19, 4.285, 3.374, 3.459, 1.0, 1.5),
    "psm1": (8.19, 4.285, 3.374, 0.955, 3.171, 1.5),
    "psm2": (8.19, 4.285, 3.374, 0.955, 3.171, 1.5),
    "psm3": (6.048, 9.214, 3.374, 1.46, 3.171, 1.5),
}
SLIDE = {"psm3": (-0.05, 1.222)}  # m; the others':
SLIDE_OF_OTHERS = (-0.38, 0.843)
TURN = (-4.0, 4.0)  # rad
FORCE, TORQUE = 1000.0, 200.0  # N, Nm: brakes that hold
ARMS = ("ecm", "psm1", "psm2", "psm3")


def frames_of(arm, q):
    """World poses (4x4) of the frames of joints 1 to 6."""
    place, direction = COLUMNS[arm]
    T = frame(mt.rotation_about("z", direction), place) @ frame(np.eye(3), (OUT, 0.0, q[0]))
    frames = [T]
    for (alpha, a, theta, d), angle in zip(ROWS[arm], q[1:], strict=True):
        frames.append(frames[-1] @ step(alpha, a, theta + angle, d))
    return frames


def home_frames(arm):
    """World poses of the bodies L0 to L5 at zero: the original's, then ours."""
    joints = frames_of(arm, ZERO)
    bodies = []
    for k, (height, turn) in enumerate(zip(HOME_HEIGHTS[arm], HOME_TURNS[arm], strict=True)):
        # L0 and L1 share an axis; joint k + 1 carries L<k>.
        place = joints[k][:3, 3].copy()
        if k == 4:
            place = joints[3][:3, 3] + LAST_FRAME * joints[4][:3, 2]
        bodies.append(frame(np.array(kinematics.rpy(*turn)), (*place[:2], height)))
    return bodies + joints[len(bodies) :]


def mount_of(arm, q):
    """World pose of the base of the arm that the set-up arm carries."""
    return frames_of(arm, q)[5] @ frame(MOUNT_TURN, MOUNT[arm[:3]])


# --- shapes, each in the frame of the link's joint, at zero ----------------------------------------------------------


def carriage(made, arm):
    height = ROWS[arm][0][3]
    made.box((-0.055, -0.055, height - 0.19), (0.010, 0.055, height - 0.03), 0.008, "graphite")
    made.rod((0, 0, height - 0.20), (0, 0, height - 0.045), 0.050, "graphite", 0.003, True)


def upright_arm(made, arm, number):
    """From one upright axis to the next: L1 and L2."""
    length, rise = ROWS[arm][number][1], ROWS[arm][number][3]
    top = 0.0 if rise > 0 else -0.005
    made.box((0.0, -0.042, top - 0.045), (length, 0.042, top + 0.030), 0.014, "shell")
    made.rod((0, 0, top - 0.050), (0, 0, top + 0.036), 0.055, "shell", 0.006, True)
    made.rod((0, 0, top - 0.010), (0, 0, top - 0.002), 0.0556, "teal", 0.0005)
    low, high = sorted((top, rise + (-0.055 if rise > 0 else 0.055)))
    made.rod((length, 0, low - 0.045), (length, 0, high), 0.048, "shell", 0.006, True)


def upright_end(made, arm):
    """L3: bearing of the next axis, which is level (endoscope: tilted)."""
    made.rod((0, 0, -0.040), (0, 0, 0.050), 0.050, "graphite", 0.004, True)
    if arm != "ecm":
        made.rod((0, -0.030, 0), (0, -0.068, 0), 0.040, "steel", 0.002, True)


def level_arm(made):
    """L4: goes below the arm that it carries."""
    made.rod((0, 0, -0.340), (0, 0, -0.315), 0.044, "graphite", 0.002, True)
    made.box((-0.045, -0.205, -0.325), (0.045, 0.045, -0.275), 0.010, "shell")
    made.box((-0.045, -0.205, -0.325), (0.045, -0.158, 0.050), 0.012, "shell")


def mount(made):
    """L5: the turning plate under a manipulator's foot."""
    made.rod((0, 0, -0.055), (0, 0, -0.036), 0.045, "steel", 0.002, True)
    made.box((-0.265, -0.060, -0.037), (0.050, 0.060, -0.0185), 0.005, "graphite")


def scope_yoke(made):
    """L4 of the endoscope's arm."""
    made.rod((0, 0, -0.030), (0, 0, 0.030), 0.045, "shell", 0.004, True)
    made.box((-0.085, -0.030, -0.028), (0.0, 0.030, -0.004), 0.006, "shell")


def scope_mount(made):
    """L5 of the endoscope's arm."""
    made.rod((0, 0, -0.092), (0, 0, 0.004), 0.034, "steel", 0.002, True)
    made.box((-0.195, -0.072, -0.092), (0.050, 0.072, -0.0715), 0.005, "graphite")


def shaped(made, arm, number):
    if number == 0:
        carriage(made, arm)
    elif number in (1, 2):
        upright_arm(made, arm, number)
    elif number == 3:
        upright_end(made, arm)
    elif arm == "ecm":
        (scope_yoke if number == 4 else scope_mount)(made)
    else:
        (level_arm(made) if number == 4 else mount(made))


# Centre of mass in the joint's frame (m), box with the same inertia (m, axes of the body's frame are the joint's at
# zero but for quarter turns, so that boxes with two equal sides fit them all).
def weight_of(arm, number):
    long = ROWS[arm][number][1] if number in (1, 2) else 0.0
    centers = {0: (-0.02, 0.0, ROWS[arm][0][3] - 0.11), 1: (long / 2, 0, 0), 2: (long / 2, 0, 0)}
    if arm != "ecm":
        centers |= {4: (0.0, -0.15, -0.15), 5: (-0.10, 0.0, -0.03)}
    side = long if long > 0.0 else 0.16 if number == 0 else 0.24
    return centers.get(number, (0.0, 0.0, 0.0)), (side, side, side)


def column():
    """Base link: what stands on the floor."""
    made = Link((0, 0, 0), (0.0, 0.0, 0.0), (0, 0, 0), np.eye(3))
    made.box((-0.42, -0.36, 0.05), (0.42, 0.36, 0.17), 0.03, "graphite")
    made.box((-0.26, -0.13, 0.16), (0.035, 0.13, 1.75), 0.03, "shell")
    made.box((-0.27, -0.14, 1.74), (0.045, 0.14, 1.80), 0.015, "graphite")
    for x in (-0.36, 0.36):
        for y in (-0.31, 0.31):
            made.rod((x, y - 0.02, 0.04), (x, y + 0.02, 0.04), 0.04, "rubber", 0.006)
    made.box((0.030, -0.02, 0.20), (0.036, 0.02, 1.72), 0.001, "steel", False)
    for side in (-1.0, 1.0):
        y = sorted((side * 0.126, side * 0.132))
        made.box((-0.122, y[0], 0.45), (-0.082, y[1], 1.72), 0.001, "steel", False)
    return made


def make(folder, positions):
    """The cart with its set-up arms at these positions; its meshes go to `folder`."""
    model = Model(
        "Patient cart of the da Vinci Research Kit with its four set-up arms (docs/models.md). Gravity does not act\n"
        "on it, as in the original's file; its motors keep their last target.",
        namespace="/ambf/env/",
        meshes=folder.seen_from(3),
        gravity=vector((0, 0, 0)),
        **{"ignore inter-collision": True},
    )
    base = column()
    folder.add("base_link.obj", base.mesh())
    model.body("base link", mesh="base_link.obj", **base.entries(0.0, None, None))
    # The original's first, so that indices stay.
    known = [(arm, k) for arm in ARMS for k in range(len(HOME_HEIGHTS[arm]))]
    links = known + [(arm, k) for arm in ARMS for k in range(6) if (arm, k) not in known]
    frames = {arm: frames_of(arm, positions[arm]) for arm in ARMS}
    for arm, k in links:
        now = frames[arm][k]
        T_body = now @ np.linalg.inv(frames_of(arm, ZERO)[k]) @ home_frames(arm)[k]
        made = Link((np.linalg.inv(now) @ T_body)[:3, 3], dvrk.rpy_of(T_body[:3, :3]), now[:3, 3], now[:3, :3])
        shaped(made, arm, k)
        mesh = folder.add(f"suj_{arm}_L{k}.obj", made.mesh())
        center, size = weight_of(arm, k)
        model.body(f"suj {arm} L{k}", mesh=mesh, **made.entries(MASSES[arm][k], made.to_body(center), size))
    for arm, k in links:
        add_joint(model, arm, k, positions[arm][k], frames[arm])
    return model


def add_joint(model, arm, k, position, frames):
    parent, child = "base link" if k == 0 else f"suj {arm} L{k - 1}", f"suj {arm} L{k}"
    point, axis = frames[k][:3, 3], tuple(frames[k][:3, 2])
    if k > 0:
        turning = {"limits": TURN, **servo(TORQUE)}
        model.joint(f"{parent}-{child}", "revolute", parent, child, tuple(point), axis, position, **turning)
        return
    start = tuple(point - position * frames[0][:3, 2])
    limits = SLIDE.get(arm, SLIDE_OF_OTHERS)
    more = {"child_point": tuple(point), **servo(FORCE)}
    model.joint(f"{parent}-{child}", "prismatic", parent, child, start, axis, position, limits, **more)


def build(models):
    folder = MeshFolder(models, "suj")
    model = make(folder, dict.fromkeys(ARMS, ZERO))
    folder.close()
    robot_files.write(model, models, "suj")
