"""PR2: the mobile robot with two arms, and its grippers by themselves.

Names, order, types, pivots, masses, limits and home frames are those of the original AMBF's files; frames are turned by
whole right angles, where the original rounds. Wheels touch the floor and hands touch what lies around (collision group
0, besides the original's groups). Chosen, since no source has them: motors (about those of the real robot), centres
of mass and inertias (of boxes about what is drawn), shapes, which are ours.
"""

import math

import adf_kinematics as kinematics
import numpy as np
from adf_writer import Model, spring_servo, vector
from dvrk_parts import Link, servo
from mesh_folder import MeshFolder
from touch_parts import rays

HALF = math.pi / 2
WORLD = np.eye(3)
FLOOR = -0.475  # m
BASE, CASTER_Z, WHEEL = (-0.478, 0.0, -0.424), -0.396, (0.079, 0.034)  # wheel: radius, width
SPINE, SHOULDER, HEIGHT = -0.528, 0.188, 0.316  # x of the torso, y and z of the shoulders
LIFT, ELBOW, WRIST, PALM, TIP = -0.428, -0.028, 0.293, 0.370, 0.461  # x along an arm
UP, SIDE, ALONG = (0.0, 0.0, 0.0), (-HALF, 0.0, 0.0), (0.0, HALF, 0.0)  # turns of frames: z is up, across, along
ARM_LIMITS = {  # rad, of the left one
    "shoulder_pan": (-0.715, 2.285),
    "shoulder_lift": (-0.524, 1.396),
    "upper_arm_roll": (-1.571, 1.571),
    "elbow_flex": (-1.571, 0.0),
    "forearm_roll": (-1.571, 1.571),
    "wrist_flex": (-1.396, 1.396),
    "wrist_roll": (-2.967, 2.967),
}
EFFORTS = {  # Nm
    "shoulder_pan": 30.0,
    "shoulder_lift": 30.0,
    "upper_arm_roll": 30.0,
    "elbow_flex": 30.0,
    "forearm_roll": 30.0,
    "wrist_flex": 10.0,
    "wrist_roll": 10.0,
}
TORSO_FORCE = 5000.0  # N: the torso carries what is above the base, 125 kg


def part(position, rpy):
    return Link(position, rpy, (0, 0, 0), WORLD)


def base():
    made = part(BASE, UP)
    x, y, z = BASE
    made.box((x - 0.33, -0.33, z + 0.115), (x + 0.33, 0.33, z + 0.245), 0.030, "shell")
    made.box((x - 0.29, -0.29, z + 0.240), (x + 0.29, 0.29, z + 0.270), 0.012, "graphite")
    made.box((x - 0.30, -0.17, z + 0.265), (x + 0.06, 0.17, z + 0.330), 0.020, "shell")
    made.box((-0.655, -0.110, z + 0.325), (-0.585, 0.110, 0.200), 0.010, "slate")  # the torso slides on it
    made.box((x + 0.22, -0.045, z + 0.265), (x + 0.285, 0.045, z + 0.320), 0.010, "night")
    made.box((x + 0.326, -0.20, z + 0.165), (x + 0.333, 0.20, z + 0.195), 0.002, "teal", False)
    return made


def caster(x, y):
    made = part((x, y, CASTER_Z), UP)
    made.rod((x, y, -0.345), (x, y, -0.310), 0.045, "graphite", 0.004, True)
    made.box((x - 0.028, y - 0.028, CASTER_Z - 0.018), (x + 0.028, y + 0.028, -0.340), 0.006, "slate")
    return made


def wheel(x, y):
    made = part((x, y, CASTER_Z), SIDE)
    radius, width = WHEEL
    made.rod((x, y - width / 2, CASTER_Z), (x, y + width / 2, CASTER_Z), radius, "rubber", 0.008, True, 36)
    outer = y + math.copysign(width / 2, y - math.copysign(0.225, y))
    made.rod((x, outer - 0.0015, CASTER_Z), (x, outer + 0.0015, CASTER_Z), 0.042, "aluminium", 0.0005)
    return made


def torso():
    made = part((SPINE, 0, HEIGHT), (0.0, -HALF, 0.0))
    made.box((-0.690, -0.150, -0.088), (-0.545, 0.150, 0.230), 0.030, "graphite")
    made.box((-0.665, -0.105, 0.225), (-0.460, 0.105, 0.480), 0.030, "shell")
    made.box((-0.645, -0.185, 0.130), (-0.545, 0.185, 0.226), 0.020, "shell")
    made.rod((-0.545, 0, 0.475), (-0.545, 0, 0.635), 0.055, "graphite", 0.006, True)
    made.box((-0.500, -0.040, 0.470), (-0.440, 0.040, 0.500), 0.006, "graphite", False)
    return made


def head_pan():
    made = part((-0.545, 0, 0.697), UP)
    made.rod((-0.545, 0, 0.636), (-0.545, 0, 0.668), 0.080, "graphite", 0.005, True, 36)
    made.box((-0.590, -0.105, 0.664), (-0.440, -0.085, 0.730), 0.008, "shell")
    made.box((-0.590, 0.085, 0.664), (-0.440, 0.105, 0.730), 0.008, "shell")
    return made


def head_tilt():
    made = part((-0.477, 0, 0.697), SIDE)
    made.box((-0.560, -0.080, 0.674), (-0.410, 0.080, 0.745), 0.012, "shell")
    made.box((-0.575, -0.125, 0.742), (-0.400, 0.125, 0.815), 0.018, "shell")
    made.box((-0.402, -0.110, 0.752), (-0.396, 0.110, 0.806), 0.002, "tinted", False)
    for y, radius in ((-0.085, 0.016), (-0.040, 0.012), (0.050, 0.012), (0.085, 0.016)):
        made.rod((-0.400, y, 0.779), (-0.388, y, 0.779), radius, "night", 0.002)
    return made


def laser():
    made = part((-0.429, 0, 0.543), SIDE)
    made.rod((-0.429, -0.055, 0.543), (-0.429, 0.055, 0.543), 0.038, "slate", 0.004, True)
    made.box((-0.412, -0.030, 0.522), (-0.380, 0.030, 0.566), 0.006, "night")
    return made


def shoulder_pan(y):
    made = part((SPINE, y, HEIGHT), UP)
    made.rod((SPINE, y, 0.235), (SPINE, y, 0.430), 0.095, "shell", 0.020, True, 40)
    made.rod((SPINE, y, 0.428), (SPINE, y, 0.436), 0.070, "graphite", 0.003)
    for side in (-1, 1):
        low, high = sorted((y + side * 0.062, y + side * 0.084))
        made.box((SPINE, low, HEIGHT - 0.060), (LIFT + 0.050, high, HEIGHT + 0.060), 0.009, "shell")
    return made


def shoulder_lift(y):
    made = part((LIFT, y, HEIGHT), SIDE)
    made.rod((LIFT, y - 0.058, HEIGHT), (LIFT, y + 0.058, HEIGHT), 0.070, "graphite", 0.008, True, 36)
    return made


def upper_arm(y):
    made = part((LIFT, y, HEIGHT), ALONG)
    made.rod((LIFT + 0.078, y, HEIGHT), (ELBOW - 0.070, y, HEIGHT), 0.060, "shell", 0.018, True, 36)
    for side in (-1, 1):
        low, high = sorted((y + side * 0.043, y + side * 0.057))
        made.box((ELBOW - 0.115, low, HEIGHT - 0.036), (ELBOW + 0.034, high, HEIGHT + 0.036), 0.006, "slate")
    return made


def elbow(y):
    made = part((ELBOW, y, HEIGHT), SIDE)
    made.rod((ELBOW, y - 0.040, HEIGHT), (ELBOW, y + 0.040, HEIGHT), 0.052, "graphite", 0.006, True, 32)
    return made


def forearm(y):
    made = part((ELBOW, y, HEIGHT), ALONG)
    made.rod((ELBOW + 0.058, y, HEIGHT), (WRIST - 0.052, y, HEIGHT), 0.047, "shell", 0.014, True, 32)
    for side in (-1, 1):
        low, high = sorted((y + side * 0.034, y + side * 0.044))
        made.box((WRIST - 0.090, low, HEIGHT - 0.026), (WRIST + 0.024, high, HEIGHT + 0.026), 0.004, "slate")
    return made


def wrist_flex(y):
    made = part((WRIST, y, HEIGHT), SIDE)
    made.rod((WRIST, y - 0.032, HEIGHT), (WRIST, y + 0.032, HEIGHT), 0.032, "graphite", 0.005, True, 28)
    return made


def hand(y):
    """Wrist's last link with the gripper's palm."""
    made = part((WRIST, y, HEIGHT), ALONG)
    made.rod((WRIST + 0.034, y, HEIGHT), (WRIST + 0.050, y, HEIGHT), 0.030, "aluminium", 0.002, True)
    made.box((WRIST + 0.048, y - 0.045, HEIGHT - 0.026), (PALM - 0.008, y + 0.045, HEIGHT + 0.026), 0.008, "graphite")
    for z in (HEIGHT - 0.018, HEIGHT + 0.018):
        made.box((PALM - 0.014, y - 0.022, z - 0.003), (PALM + 0.008, y + 0.022, z + 0.003), 0.001, "slate")
    return made


def finger(side, y):
    """`side`: +1 the left one, +y of the middle."""
    made = part((PALM, y + side * 0.010, HEIGHT), UP if side > 0 else (math.pi, 0.0, 0.0))
    low, high = sorted((y + side * 0.004, y + side * 0.017))
    made.box((PALM - 0.006, low, HEIGHT - 0.013), (PALM + 0.030, high, HEIGHT + 0.013), 0.003, "slate")
    low, high = sorted((y + side * 0.008, y + side * 0.021))
    made.box((PALM + 0.022, low, HEIGHT - 0.011), (TIP + 0.006, high, HEIGHT + 0.011), 0.004, "slate")
    return made


def fingertip(side, y):
    made = part((TIP, y + side * 0.015, HEIGHT), (0.0, math.pi, 0.0) if side > 0 else (0.0, 0.0, math.pi))
    low, high = sorted((y + side * 0.0006, y + side * 0.012))
    made.box((TIP - 0.008, low, HEIGHT - 0.010), (TIP + 0.034, high, HEIGHT + 0.010), 0.003, "rubber")
    at = y + side * 0.015
    made.rod((TIP, at, HEIGHT - 0.012), (TIP, at, HEIGHT + 0.012), 0.004, "steel", 0.0005, True)
    return made


def middle_of(made):
    """Box about a part's colliding shapes in its frame: middle and size."""
    corners = []
    for shape in made.shapes:
        where = np.array([shape["offset"]["position"][k] for k in "xyz"])
        corners += [where]
    vertices = np.array(made.mesh().vertices)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return tuple(0.5 * (low + high)), tuple(high - low)


class Robot:
    def __init__(self, model, folder):
        self.model, self.folder = model, folder

    def body(self, name, made, mass, groups, friction=(0.5, 0.01)):
        com, size = middle_of(made)
        mesh = self.folder.add(f"{name.removesuffix('_link')}.obj", made.mesh())
        entries = made.entries(mass, com, size)
        self.model.body(name, mesh=mesh, friction=friction, **entries, **{"collision groups": groups})

    def joint(self, parent, child, point, axis, kind="revolute", limits=None, **more):
        more = {**({"limits": limits} if limits else {}), **more}
        self.model.joint(f"{parent}-{child}", kind, parent, child, point, axis, **more)


def casters():
    """Prefix, x, y, of the caster's axis; in the order of the original."""
    for end, x in (("b", -0.703), ("f", -0.253)):
        for side, y in (("l", 0.225), ("r", -0.225)):
            yield end + side, x, y


def add_bodies(robot):
    robot.body("base_link", base(), 116.0, [0, 5, 6, 7, 8, 9, 15, 16, 17, 18, 19])
    for name, x, y in casters():
        robot.body(f"{name}_caster_rotation_link", caster(x, y), 3.473, [1])
        for side, shift in (("l", 0.049), ("r", -0.049)):
            robot.body(f"{name}_caster_{side}_wheel_link", wheel(x, y + shift), 0.44, [0, 2], (0.8, 0.01))
    robot.body("torso_lift_link", torso(), 36.248, [1])
    seen_by_arms = [5, 7, 8, 9, 15, 16, 17, 18]
    robot.body("head_pan_link", head_pan(), 6.339, seen_by_arms)
    robot.body("head_tilt_link", head_tilt(), 4.479, [0])
    for arm, y in (("l", SHOULDER), ("r", -SHOULDER)):
        robot.body(f"{arm}_shoulder_pan_link", shoulder_pan(y), 25.799, [2])
        robot.body(f"{arm}_shoulder_lift_link", shoulder_lift(y), 2.75, [3])
        robot.body(f"{arm}_upper_arm_roll_link", upper_arm(y), 0.1, [5])
        robot.body(f"{arm}_elbow_flex_link", elbow(y), 1.903, [6])
        robot.body(f"{arm}_forearm_roll_link", forearm(y), 0.1, [7])
        robot.body(f"{arm}_wrist_flex_link", wrist_flex(y), 0.614, [8])
        robot.body(f"{arm}_wrist_roll_link", hand(y), 0.1, [0, 9])
        for side, sign, mass, groups in (("l", 1, 0.171, (16, 18)), ("r", -1, 0.174, (15, 17))):
            robot.body(f"{arm}_gripper_{side}_finger_link", finger(sign, y), mass, [0, groups[0]])
            robot.body(f"{arm}_gripper_{side}_finger_tip_link", fingertip(sign, y), 0.044, [0, groups[1]], (1.0, 0.01))
        if arm == "l":
            robot.body("laser_tilt_mount_link", laser(), 0.591, seen_by_arms)


def add_joints(robot):
    x, y, z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    for name, cx, cy in casters():
        rotation = f"{name}_caster_rotation_link"
        robot.joint("base_link", rotation, (cx, cy, CASTER_Z), z, "continuous", **servo(8.0))
        for side, shift in (("l", 0.049), ("r", -0.049)):
            at = (cx, cy + shift, CASTER_Z)
            robot.joint(rotation, f"{name}_caster_{side}_wheel_link", at, y, "continuous", **servo(8.0))
    torso_link, pan = "torso_lift_link", "head_pan_link"
    robot.joint("base_link", torso_link, (SPINE, 0, HEIGHT), z, "prismatic", (0.0, 0.33), **servo(TORSO_FORCE))
    robot.joint(torso_link, pan, (-0.545, 0, 0.697), z, limits=(-3.007, 3.007), **servo(3.0))
    robot.joint(pan, "head_tilt_link", (-0.477, 0, 0.697), y, limits=(-0.471, 1.396), **servo(18.0))
    for arm, at in (("l", SHOULDER), ("r", -SHOULDER)):
        places = (
            ("shoulder_pan", SPINE, z),
            ("shoulder_lift", LIFT, y),
            ("upper_arm_roll", LIFT, x),
            ("elbow_flex", ELBOW, y),
            ("forearm_roll", ELBOW, x),
            ("wrist_flex", WRIST, y),
            ("wrist_roll", WRIST, x),
        )
        parent = torso_link
        for name, along, axis in places:
            low, high = ARM_LIMITS[name]
            if arm == "r" and name == "shoulder_pan":
                low, high = -high, -low
            child = f"{arm}_{name}_link"
            robot.joint(parent, child, (along, at, HEIGHT), axis, limits=(low, high), **servo(EFFORTS[name]))
            parent = child
        for side, sign in (("l", 1), ("r", -1)):
            link, tip = f"{arm}_gripper_{side}_finger_link", f"{arm}_gripper_{side}_finger_tip_link"
            where, turn = (PALM, at + sign * 0.010, HEIGHT), (0, 0, sign)
            robot.joint(parent, link, where, turn, limits=(0.0, 0.785), **spring_servo(60.0, 0.25, 0.02))
            where, turn = (TIP, at + sign * 0.015, HEIGHT), (0, 0, -sign)
            robot.joint(link, tip, where, turn, limits=(0.0, 0.548), **spring_servo(5.0, 0.009, 0.01))
        if arm == "l":
            at = (-0.429, 0, 0.543)
            robot.joint(torso_link, "laser_tilt_mount_link", at, y, limits=(-0.785, 1.484), **servo(10.0))


def build_robot(models):
    folder = MeshFolder(models, "pr2")
    model = Model(
        "PR2, the mobile robot with two arms (docs/models.md). Its wheels stand at z = -0.475.",
        namespace="/ambf/env/",
        meshes=folder.seen_from(3),
        **{"ignore inter-collision": False},
    )
    robot = Robot(model, folder)
    add_bodies(robot)
    add_joints(robot)
    folder.close()
    model.write(models / "descriptions" / "multi-bodies" / "robots" / "pr2.yaml")


# --- the gripper by itself, its palm's frame at the wrist, fingers along -x ------------------------

PALM_AT, TURNS = (0.5, 0.0, -0.5), (-2.851, 0.123)  # m; rad: of the left finger about z, of the right one about -z
PIVOTS, FINGER = ((-0.189, -0.026), (-0.187, 0.032)), (0.168, 0.009)  # m: on the palm; of the tip, on the finger
GRIPPER_LIMITS = (-0.3, 0.548)  # rad, of all four joints


def palm(size):
    made = part(PALM_AT, UP)
    x, y, z = PALM_AT

    def at(u, v, w):
        return (x + u * size, y + v * size, z + w * size)

    made.rod(at(-0.105, 0, -0.040), at(-0.105, 0, 0.040), 0.082 * size, "shell", 0.006, True, 40)
    for w in (-0.036, 0.028):
        made.box(at(-0.204, -0.052, w), at(-0.130, 0.052, w + 0.008), 0.002, "slate")
    made.rod(at(-0.030, 0, 0), at(0, 0, 0), 0.034 * size, "aluminium", 0.002, True, 32)
    return made


class Half:
    """A finger with its tip, of one size, in the world."""

    def __init__(self, side, palm_size, size):
        """`side`: 0 left, 1 right."""
        turn = TURNS[side]
        self.size = size
        self.rpy = (0.0, 0.0, turn) if side == 0 else (0.0, math.pi, -turn)
        self.frame = np.array(kinematics.rpy(*self.rpy))
        self.pivot = np.array(PALM_AT) + palm_size * np.array((*PIVOTS[side], 0.0))
        self.tip = self.pivot + self.frame @ (size * np.array((*FINGER, 0.0)))
        # The tip's x points back to the palm, its y away from the other finger, as the finger's does.
        self.tip_rpy = (math.pi, 0.0, turn + math.pi) if side == 0 else (0.0, 0.0, -turn)

    def finger(self, color):
        s = self.size
        made = Link((0, 0, 0), self.rpy, self.pivot, self.frame)
        made.bar((0, 0), (0.050 * s, 0.030 * s), 0.034 * s, 0.050 * s, 0.0, color)
        made.bar((0.050 * s, 0.030 * s), (FINGER[0] * s, FINGER[1] * s), 0.028 * s, 0.050 * s, 0.0, color)
        made.pin((0, 0), 0.008 * s, -0.037 * s, 0.037 * s, collides=True)
        made.pin((FINGER[0] * s, FINGER[1] * s), 0.006 * s, -0.027 * s, 0.027 * s)
        return made

    def fingertip(self):
        s = self.size
        frame = np.array(kinematics.rpy(*self.tip_rpy))
        made = Link((0, 0, 0), self.tip_rpy, self.tip, frame)
        made.box((-0.055 * s, -0.033 * s, -0.020 * s), (0.030 * s, -0.020 * s, 0.020 * s), 0.003, "rubber")
        made.box((-0.048 * s, -0.022 * s, -0.022 * s), (0.024 * s, 0.012 * s, 0.022 * s), 0.006 * s, "slate")
        return made


def build_gripper(models, folder, name, title, color, palm_size, size, gains):
    """`gains`: P and D of fingers and of tips."""
    model = Model(
        f"{title} (docs/models.md). It floats: gravity does not act on it.",
        namespace="/ambf/env/",
        meshes=folder.seen_from(3),
        gravity=vector((0, 0, 0)),
        **{"ignore inter-collision": True},
    )
    prefix = "r_gripper"
    halves = {"l": Half(0, palm_size, size), "r": Half(1, palm_size, size)}
    parts = {f"{prefix}_palm_link": (palm(palm_size), 0.58)}
    for side, mass in (("l", 0.171), ("r", 0.174)):
        parts[f"{prefix}_{side}_finger_link"] = (halves[side].finger(color), mass)
        parts[f"{prefix}_{side}_finger_tip_link"] = (halves[side].fingertip(), 0.044)
    for body, (made, mass) in parts.items():
        middle, extent = middle_of(made)
        entries = made.entries(mass, middle, extent)
        if body.endswith("palm_link"):
            angular = {"P": 20.0 * palm_size**2, "D": 0.4 * palm_size**2}
            entries["controller"] = {"linear": {"P": 200.0, "D": 20.0}, "angular": angular}
        mesh = folder.add(f"{name}_{body.removeprefix('r_gripper_').removesuffix('_link')}.obj", made.mesh())
        model.body(body, mesh=mesh, friction=(1.0, 0.01), **entries, **{"collision groups": [0]})
    for side, sign in (("l", 1), ("r", -1)):
        half, link = halves[side], f"{prefix}_{side}_finger_link"
        for parent, child, at, turn, (p, d) in (
            (f"{prefix}_palm_link", link, half.pivot, sign, gains[0]),
            (link, f"{prefix}_{side}_finger_tip_link", half.tip, -sign, gains[1]),
        ):
            motor = spring_servo(p, d, 0.05)
            name_of = f"{parent}-{child}"
            limits = {"limits": GRIPPER_LIMITS}
            model.joint(name_of, "revolute", parent, child, tuple(at), (0, 0, turn), **limits, **motor)
    reach = {"range": 0.105 * size, "array": rays([(-0.2 * palm_size, 0.0, -0.01)], (-1, 0, 0))}
    model.add("sensors", "Proximity0", f"{prefix}_palm_link", type="Proximity", **reach)
    held = {"position": vector((-0.14 * palm_size, 0, 0)), "orientation": {"r": 0.0, "p": 0.0, "y": 0.0}}
    model.add("actuators", "Constraint0", f"{prefix}_palm_link", type="Constraint", location=held)
    model.write(models / "descriptions" / "multi-bodies" / "grippers" / f"{name}.yaml")


def build_grippers(models):
    folder = MeshFolder(models, "pr2_grippers")
    title = "The PR2's gripper"
    build_gripper(models, folder, "pr2_gripper", title, "teal", 1.0, 1.0, ((10.0, 0.1), (2.0, 0.01)))
    title = "The PR2's gripper in small and red, its palm 0.7 and its fingers 0.6 times as large"
    build_gripper(models, folder, "pr2_gripper_small_red", title, "coral", 0.7, 0.6, ((5.0, 0.07), (1.0, 0.005)))
    folder.close()


def build(models):
    build_robot(models)
    build_grippers(models)
