"""Master tool manipulators of the da Vinci Research Kit, right and left, with their parallelogram.

Names, order, types and home frames are those of the original AMBF's MTM, which is a right one. Numbers: the published
kinematics (lengths, limits, efforts). The short link keeps parallel to the forearm, the front arm to the upper arm.
Chosen, since no source has them: the short link's length where sources differ (0.101 m of 0.100 and 0.101 m), the
masses (the original's, which are placeholders), inertias (of boxes as large as the links), the gripper's springs,
shapes.
"""

import math

import dvrk_parts as dvrk
import numpy as np
from adf_writer import PASSIVE, Model, vector
from dvrk_parts import Link, servo
from mesh_folder import MeshFolder

HALF = math.pi / 2
# u is forward from the base to the hand, v up, w to the side; all from the shoulder's axis.
PLANE = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
YAW_FRAME = 0.19  # m: the shoulder's frame, above its pitch axis
UPPER, FOREARM, WRIST_HEIGHT, SHORT = 0.2794, 0.3645, 0.1506, 0.101  # m
ELBOW = (0.0, -UPPER)
FRONT_TOP, FRONT_BOTTOM = (SHORT, 0.0), (SHORT, -UPPER)
U, V = FOREARM, WRIST_HEIGHT - UPPER  # the wrist's centre, where the axes of all four gimbals meet
ROLL_FRAME = U - 0.039
LEVER = (ROLL_FRAME + 0.009, 0.008)  # (u, distance from the roll's axis) of the gripper's levers
LEVER_LENGTH, OPEN = 0.062, math.radians(30)  # m, rad: of each of the two levers
LEVER_SPRING, LEVER_DAMPING = 0.1, 0.0005  # Nm/rad, Nms/rad
FLOOR = 1.46  # m below the shoulder's axis

LIMITS = {  # rad, of the right arm
    "yaw": (-1.13446, 0.698132),
    "shoulder": (-0.31416, 1.13446),
    "elbow": (-0.872665, 0.610865),
    "platform": (-1.6580, 3.5779),
    "pitch": (-1.6580, 3.2288),
    "wrist yaw": (-0.785398, 0.785398),
    "roll": (-8.37758, 7.85398),
}
LEFT_LIMITS = {"yaw": (-0.698132, 1.13446), "shoulder": (-0.261799, 1.13446), "platform": (-3.5779, 1.6580)}
EFFORTS = {  # Nm
    "yaw": 1.8608,
    "shoulder": 3.2166,
    "elbow": 1.9598,
    "platform": 0.30901,
    "pitch": 0.096844,
    "wrist yaw": 0.096844,
    "roll": 0.022876,
}
FREE = (-1.6, 1.6)  # rad: limits of the parallelogram's passive joints, wider than what the driven ones allow

# Mass (kg), centre of mass in the body frame (m), box with the same inertia (m, body axes).
MASSES = {
    "ArmFront": (0.15, (0.0, -0.14, 0.0), (0.03, 0.30, 0.02)),
    "ArmParallel": (0.9, (-0.12, 0.0, 0.0), (0.32, 0.06, 0.06)),
    "ArmParallel1": (0.15, (0.045, 0.0, 0.0), (0.14, 0.04, 0.02)),
    "BottomArm": (0.8, (-0.19, 0.0, 0.0), (0.40, 0.05, 0.04)),
    "OutPitch Shoulder": (1.0, (0.0, 0.0, -0.06), (0.10, 0.15, 0.20)),
    "WristPitch": (0.2, (0.0, 0.04, 0.0), (0.03, 0.10, 0.08)),
    "WristPlatform": (0.4, (0.0, 0.0, -0.08), (0.04, 0.12, 0.14)),
    "WristRoll": (0.1, (0.0, 0.0, -0.015), (0.03, 0.03, 0.05)),
    "WristYaw": (0.2, (0.0, -0.035, -0.03), (0.03, 0.07, 0.07)),
    "Gripper1": (0.012, (0.03, 0.0, 0.0), (0.062, 0.008, 0.016)),
    "Gripper2": (0.012, (0.03, 0.0, 0.0), (0.062, 0.008, 0.016)),
}
TARGETS = {"target_ik": ("coral", 14, {}), "target_fk": ("sage", 5, {})}  # colour, collision group, further entries
ORIGINAL_PASSIVE = {  # as in the original's file: without State and Command of their own
    "ArmFront",
    "ArmParallel",
    "ArmParallel1",
    "BottomArm",
    "OutPitch Shoulder",
    "WristPitch",
    "WristPlatform",
    "WristYaw",
}


class Master:
    """One arm. `side` is 1 for the right one, -1 for the left one, whose linkage and wrist are mirrored."""

    def __init__(self, name, base, side, limits):
        """`base`: world position of the shoulder's axis."""
        self.name, self.base, self.side, self.limits = name, base, side, limits

    def link(self, at, rpy, w=0.0):
        return Link((*at, self.side * w), rpy, self.base, PLANE)

    def box(self, made, low, high, bevel, color):
        """Box between two corners, given for the right arm."""
        w = sorted((self.side * low[2], self.side * high[2]))
        made.box((*low[:2], w[0]), (*high[:2], w[1]), bevel, color)

    def pin(self, made, at, radius, w_low, w_high, color="steel"):
        made.pin(at, radius, *sorted((self.side * w_low, self.side * w_high)), color)

    def top_panel(self):
        """What hangs the arm to the console."""
        made = self.link((0, 0), (0.0, 0.0, HALF))
        made.rod((0, YAW_FRAME + 0.008, 0), (0, YAW_FRAME + 0.03, 0), 0.05, "graphite", 0.002, True)
        made.box((-0.13, YAW_FRAME + 0.028, -0.08), (0.075, YAW_FRAME + 0.05, 0.08), 0.008, "shell")
        return made

    def shoulder(self):
        made = self.link((0, YAW_FRAME), (0.0, 0.0, -math.pi))
        made.rod((0, 0.14, 0), (0, YAW_FRAME + 0.006, 0), 0.042, "aluminium", 0.002, True)
        made.rod((0, 0.166, 0), (0, 0.174, 0), 0.0427, "teal", 0.0005)
        self.box(made, (-0.050, 0.098, -0.056), (0.050, 0.148, 0.100), 0.010, "shell")
        for low, high in ((-0.052, -0.040), (0.084, 0.096)):
            self.box(made, (-0.030, -0.034, low), (0.030, 0.110, high), 0.005, "shell")
        self.pin(made, (0, 0), 0.011, -0.058, 0.102)
        return made

    def upper_arm(self):
        """Two plates that hold the forearm between them."""
        made = self.link((0, 0), (HALF, -HALF, 0.0))
        for w in (-0.020, 0.020):
            made.bar((0, 0), ELBOW, 0.052, 0.009, w, "aluminium")
        made.pin(ELBOW, 0.012, -0.030, 0.030)
        self.pin(made, (0, 0), 0.020, -0.038, 0.050, "graphite")
        return made

    def short_link(self):
        made = self.link((0, 0), (HALF, 0.0, 0.0), 0.065)
        made.bar((0, 0), FRONT_TOP, 0.034, 0.012, self.side * 0.065, "slate")
        self.pin(made, (0, 0), 0.022, 0.052, 0.076, "graphite")
        self.pin(made, FRONT_TOP, 0.010, 0.053, 0.073)
        return made

    def front_arm(self):
        made = self.link(FRONT_TOP, (HALF, 0.0, 0.0), 0.0344)
        made.bar(FRONT_TOP, FRONT_BOTTOM, 0.024, 0.008, self.side * 0.0344, "slate")
        self.pin(made, FRONT_TOP, 0.009, 0.029, 0.055)
        self.pin(made, FRONT_BOTTOM, 0.009, 0.029, 0.041)
        return made

    def forearm(self):
        made = self.link(ELBOW, (-HALF, 0.0, -math.pi))
        end = (U, -UPPER)
        made.bar(ELBOW, end, 0.042, 0.022, 0.0, "aluminium")
        self.pin(made, FRONT_BOTTOM, 0.007, -0.013, 0.041)
        made.rod((U, -UPPER - 0.026, 0), (U, V - 0.126, 0), 0.0245, "graphite", 0.002, True)
        return made

    def platform(self):
        made = self.link((U, V), (0.0, 0.0, -math.pi))
        self.box(made, (U - 0.016, V - 0.124, -0.098), (U + 0.016, V - 0.110, 0.017), 0.004, "shell")
        self.box(made, (U - 0.016, V - 0.124, -0.098), (U + 0.016, V + 0.018, -0.084), 0.004, "shell")
        self.pin(made, (U, V), 0.014, -0.086, -0.071)
        return made

    def pitch(self):
        made = self.link((U, V), (-HALF, 0.0, -math.pi))
        self.box(made, (U - 0.012, V - 0.084, -0.070), (U + 0.012, V + 0.014, -0.058), 0.003, "slate")
        self.box(made, (U - 0.012, V - 0.084, -0.070), (U + 0.012, V - 0.072, 0.013), 0.003, "slate")
        made.rod((U, V - 0.073, 0), (U, V - 0.060, 0), 0.011, "steel")
        return made

    def yaw(self):
        made = self.link((U, V), (0.0, 0.0, -HALF))
        made.box((U - 0.058, V - 0.060, -0.010), (U + 0.012, V - 0.049, 0.010), 0.003, "aluminium")
        made.box((U - 0.058, V - 0.060, -0.010), (U - 0.047, V + 0.012, 0.010), 0.003, "aluminium")
        made.rod((U - 0.048, V, 0), (ROLL_FRAME, V, 0), 0.009, "steel")
        return made

    def roll(self):
        """The handle's stem; its levers are bodies of their own."""
        made = self.link((ROLL_FRAME, V), (HALF, HALF, -HALF))
        made.rod((ROLL_FRAME, V, 0), (ROLL_FRAME + 0.014, V, 0), 0.013, "graphite", 0.002, True)
        made.rod((ROLL_FRAME + 0.012, V, 0), (ROLL_FRAME + 0.046, V, 0), 0.0045, "night", 0.001, True)
        return made

    def lever(self, sign):
        """Half of the gripper, open: its frame's x is along the lever, y outwards."""
        start = (LEVER[0], V + sign * LEVER[1])
        end = (start[0] + LEVER_LENGTH * math.cos(OPEN), start[1] + sign * LEVER_LENGTH * math.sin(OPEN))
        made = self.link(start, dvrk.rpy_of(PLANE @ lever_axes(sign)))
        made.bar(start, end, 0.010, 0.016, 0.0, "ivory")
        made.pin(start, 0.004, -0.010, 0.010)
        return made

    def links(self):
        """In the order of the original's file, then ours."""
        return {
            "ArmFront": self.front_arm,
            "ArmParallel": self.upper_arm,
            "ArmParallel1": self.short_link,
            "BottomArm": self.forearm,
            "OutPitch Shoulder": self.shoulder,
            "target_fk": None,
            "target_ik": None,
            "Top Panel": self.top_panel,
            "WristPitch": self.pitch,
            "WristPlatform": self.platform,
            "WristRoll": self.roll,
            "WristYaw": self.yaw,
            "Gripper1": lambda: self.lever(1.0),
            "Gripper2": lambda: self.lever(-1.0),
        }

    def add_joints(self, model):
        """In the order of the original's file, then ours."""
        across, up, back = (0, -1, 0), (0, 0, 1), (-1, 0, 0)

        def joint(parent, child, at, axis, w=0.0, kind="revolute", **more):
            where = tuple(np.array(self.base) + PLANE @ np.array([*at, self.side * w]))
            model.joint(f"{parent}-{child}", kind, parent, child, where, axis, **more)

        def driven(name):
            return {"limits": self.limits[name], **servo(EFFORTS[name])}

        free = {"limits": FREE, "damping": 0.001, **PASSIVE}
        wrist = (U, V)
        joint("ArmFront", "BottomArm", FRONT_BOTTOM, across, **free)
        joint("ArmParallel", "ArmParallel1", (0, 0), across, 0.065, **free)
        joint("ArmParallel", "BottomArm", ELBOW, across, **driven("elbow"))
        joint("ArmParallel1", "ArmFront", FRONT_TOP, across, 0.0344, **free)
        joint("BottomArm", "WristPlatform", wrist, up, **driven("platform"))
        joint("OutPitch Shoulder", "ArmParallel", (0, 0), across, **driven("shoulder"))
        joint("Top Panel", "OutPitch Shoulder", (0, YAW_FRAME), up, **driven("yaw"))
        joint("WristPitch", "WristYaw", wrist, up, **driven("wrist yaw"))
        joint("WristPlatform", "WristPitch", wrist, across, **driven("pitch"))
        joint("WristYaw", "WristRoll", (ROLL_FRAME, V), back, **driven("roll"))
        for number, sign in ((1, 1.0), (2, -1.0)):
            spring = {"stiffness": LEVER_SPRING, "damping": LEVER_DAMPING, "equilibrium point": OPEN}
            at, axis = (LEVER[0], V + sign * LEVER[1]), (0, -sign, 0)
            open_at = {"home": OPEN, "limits": (0.0, OPEN)}
            joint("WristRoll", f"Gripper{number}", at, axis, 0.0, "torsion spring", **open_at, **spring)

    def stand(self):
        """A post behind the arm with a beam over it: what carries the console's panel."""
        top = YAW_FRAME + 0.05
        made = self.link((0, top), (0.0, 0.0, 0.0))
        made.box((-0.30, top, -0.03), (0.06, top + 0.05, 0.03), 0.006, "graphite")
        made.rod((-0.27, -FLOOR + 0.02, 0), (-0.27, top + 0.01, 0), 0.036, "graphite", 0.002, True)
        made.box((-0.45, -FLOOR, -0.20), (0.00, -FLOOR + 0.03, 0.20), 0.006, "night")
        return made

    def make(self, folder):
        """The arm on no stand; its meshes go to `folder`."""
        which = "right" if self.side > 0 else "left"
        model = Model(
            f"Master tool manipulator of the da Vinci Research Kit, {which} (docs/models.md). Gravity does not act on\n"
            "it, as in the original's file; its motors keep their last target.",
            namespace=f"/ambf/env/{'mtm' if self.side > 0 else 'mtml'}/",
            meshes=folder.seen_from(3),
            gravity=vector((0, 0, 0)),
            **{"ignore inter-collision": True},
        )
        dvrk.add_bodies(model, folder, self.links(), TARGETS, MASSES, ORIGINAL_PASSIVE)
        self.add_joints(model)
        return model

    def build(self, models):
        folder = MeshFolder(models, self.name)
        model = self.make(folder)
        stand = self.stand()
        model.body("stand", mesh=folder.add("stand.obj", stand.mesh()), passive=True, **stand.entries(0.0, None, None))
        folder.close()
        # With the published masses its motors could not carry it: there is no file with gravity.
        model.write(models / "descriptions" / "multi-bodies" / "robots" / f"{self.name}.yaml")


def lever_axes(sign):
    """Axes (columns, in u, v, w) of an open lever's frame: x along it, y outwards."""
    c, s = math.cos(OPEN), sign * math.sin(OPEN)
    return np.array([[c, -sign * s, 0.0], [s, sign * c, 0.0], [0.0, 0.0, sign]])


RIGHT = Master("mtmr", (-0.5, 0.0, -0.19), 1.0, LIMITS)
LEFT = Master("mtml", (-0.5, -0.5, -0.19), -1.0, {**LIMITS, **LEFT_LIMITS})


def build(models):
    RIGHT.build(models)
    LEFT.build(models)
