"""Raven II: two arms with spherical linkages, left and right, each with its grasper.

Numbers are those of the published kinematics (docs/kinematics.md: RAVEN_LEFT, RAVEN_RIGHT; the axes of shoulder and
elbow and the tool's shaft meet in the remote centre) and the published masses of the links. Body frames are those of
the Denavit-Hartenberg rows, the graspers' those of the last row when they are shut. There is no file of the original's
to go by, so names are ours. Chosen, since no source has them: where the arms stand, the radii of the links (0.34 and
0.30 m), motors, masses of the tools, centres of mass and inertias (of boxes), shapes.
"""

import math

import numpy as np
import robot_files
from adf_writer import Model, vector
from dvrk_parts import Link, rpy_of, servo
from mesh_folder import MeshFolder

LA12, LA23 = math.radians(75), math.radians(52)
D4, WRIST = -0.47, 0.013  # m: shaft, and from the wrist's axis to the jaws'
RADIUS = (0.34, 0.30)  # m: of the two links about the remote centre
HEIGHT, APART = 0.30, 0.06  # m: of the remote centres above the bench, and half of the way between them
HOME = (math.radians(30), math.radians(90), 0.40, 0.0, 0.0, 0.0)
JAW_HOME = math.radians(45)  # each half
LIMITS = (  # rad, m
    (0.0, math.radians(90)),
    (math.radians(45), math.radians(135)),
    (0.230, 0.560),
    (-math.radians(182), math.radians(182)),
    (-math.radians(70), math.radians(70)),
)
# A half of the jaw carries the yaw (+-105 degrees) and half of the opening (up to 120 degrees).
JAW = (-math.radians(105), math.radians(165))
EFFORTS = (20.0, 20.0, 60.0, 0.6, 0.4)  # Nm, N
JAW_EFFORT = 0.3  # Nm
NAMES = ("shoulder", "elbow", "insertion", "tool_roll", "wrist")
LINKS = ("link1", "link2", "carriage", "shaft", "wrist")
MASSES = (0.494, 0.750, 0.231, 0.040, 0.008)  # kg; of the last two chosen
JAW_MASS, JAW_LENGTH = 0.002, 0.013  # kg, m
WORLD = np.eye(3)


def row(alpha, a, theta, d):
    """T = Rx(alpha) Tx(a) Rz(theta) Tz(d)"""
    ca, sa, ct, st = math.cos(alpha), math.sin(alpha), math.cos(theta), math.sin(theta)
    return np.array(
        [
            [ct, -st, 0.0, a],
            [st * ca, ct * ca, -sa, -sa * d],
            [st * sa, ct * sa, ca, ca * d],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


class Arm:
    def __init__(self, side):
        """`side`: -1 left, +1 right."""
        left = side < 0
        self.name = "left" if left else "right"
        self.side = side
        # The base frame's x is up, its z points from the arm's foot to the other arm.
        self.base = np.eye(4)
        self.base[:3, 0], self.base[:3, 2] = (0, 0, 1), (0, -side, 0)
        self.base[:3, 1] = np.cross(self.base[:3, 2], self.base[:3, 0])
        self.base[:3, 3] = (0.0, side * APART, HEIGHT)
        rows = (
            (0.0 if left else math.pi, 0.0, HOME[0] + math.radians(205 if left else 25), 0.0),
            (LA12, 0.0, HOME[1] + (math.pi if left else 0.0), 0.0),
            (math.pi - LA23 if left else LA23, 0.0, math.pi / 2 if left else -math.pi / 2, HOME[2]),
            (0.0, 0.0, HOME[3], D4),
            (math.pi / 2, 0.0, HOME[4] - math.pi / 2, 0.0),
            (math.pi / 2, WRIST, HOME[5], 0.0),
        )
        self.frames = []
        T = self.base
        for each in rows:
            T = T @ row(*each)
            self.frames.append(T)
        # From the remote centre: to the foot, along the elbow's axis, to the carriage.
        sign = -1.0 if left else 1.0
        self.center = self.base[:3, 3]
        self.out = [sign * self.frames[0][:3, 2], sign * self.frames[1][:3, 2], self.frames[2][:3, 2]]

    def link(self, frame, plane=WORLD, center=(0, 0, 0)):
        """A body in the frame of a row; parts in `plane` about `center`."""
        local = plane.T @ (frame[:3, 3] - np.array(center))
        return Link(tuple(local), rpy_of(frame[:3, :3]), tuple(center), plane)

    def arc(self, frame, start, end, radii, width, color):
        """From one direction to another, of straight pieces; the plane's u is along `start`. `radii`: at both."""
        across = np.cross(start, end)
        across /= np.linalg.norm(across)
        plane = np.column_stack([start, np.cross(across, start), across])
        made = self.link(frame, plane, self.center)
        total = math.acos(float(start @ end))
        points = []
        for share in np.linspace(0.0, 1.0, 6):
            radius = radii[0] + share * (radii[1] - radii[0])
            points.append(radius * np.array([math.cos(total * share), math.sin(total * share)]))
        for a, b in zip(points[:-1], points[1:], strict=True):
            made.bar(a, b, width, 0.024, 0.0, color)
        return made

    def base_link(self):
        """Column on the bench with the shoulder's bearing."""
        made = self.link(self.base)
        axis, r = self.out[0], RADIUS[0]
        made.rod(self.center + axis * (r + 0.022), self.center + axis * (r + 0.115), 0.038, "graphite", 0.003, True)
        made.rod(self.center + axis * (r + 0.045), self.center + axis * (r + 0.052), 0.0388, "teal", 0.0005)
        x, y, z = self.center + axis * (r + 0.085)
        made.box((x - 0.035, y - 0.028, 0.020), (x + 0.035, y + 0.028, z), 0.006, "shell")
        made.box((x - 0.11, y - 0.09, 0.0), (x + 0.11, y + 0.09, 0.022), 0.006, "night")
        return made

    def first(self):
        made = self.arc(self.frames[0], self.out[0], self.out[1], (RADIUS[0], RADIUS[0]), 0.046, "shell")
        for axis, length in ((self.out[0], 0.021), (self.out[1], 0.018)):
            foot = self.in_plane(made, axis)
            made.rod(foot * (RADIUS[0] - length), foot * (RADIUS[0] + length), 0.030, "graphite", 0.003, True)
        return made

    def second(self):
        """Ends in a rail beside the shaft, on the elbow's side; the carriage slides between rail and shaft."""
        along, beyond = self.rail()
        foot_of_rail = along * RADIUS[1] + beyond * 0.062
        end = foot_of_rail / np.linalg.norm(foot_of_rail)
        radius = float(np.linalg.norm(foot_of_rail))
        made = self.arc(self.frames[1], self.out[1], end, (RADIUS[1], radius), 0.040, "slate")
        foot = self.in_plane(made, self.out[1])
        made.rod(foot * (RADIUS[1] - 0.018), foot * (RADIUS[1] + 0.021), 0.026, "graphite", 0.003, True)
        along, beyond = self.in_plane(made, along), self.in_plane(made, beyond)
        made.bar((along * 0.20 + beyond * 0.054)[:2], (along * 0.63 + beyond * 0.054)[:2], 0.010, 0.050, 0.0, "shell")
        for shift in (-0.016, 0.016):
            at = beyond * 0.043 + np.array([0, 0, shift])
            made.rod(along * 0.20 + at, along * 0.63 + at, 0.0045, "steel", 0.0006)
        for r in (0.20, 0.63):
            for shift in (-0.016, 0.016):
                at = along * r + np.array([0, 0, shift])
                made.rod(at + beyond * 0.038, at + beyond * 0.052, 0.007, "graphite", 0.001)
        made.pipe(along * 0.045, along * 0.062, 0.0078, 0.0046, "steel")
        made.bar((along * 0.054 + beyond * 0.010)[:2], (along * 0.20 + beyond * 0.054)[:2], 0.008, 0.010, 0.0, "slate")
        return made

    @staticmethod
    def in_plane(made, direction):
        return made.plane.T @ direction

    def carriage(self):
        along, beyond = self.rail()
        plane = np.column_stack([np.cross(beyond, along), beyond, along])
        made = self.link(self.frames[2], plane, self.center)
        d = HOME[2]
        made.box((-0.024, 0.033, d - 0.030), (0.024, 0.048, d + 0.030), 0.003, "graphite")
        made.box((-0.022, -0.020, d - 0.002), (0.022, 0.035, d + 0.044), 0.006, "shell")
        for u in (-0.012, 0.012):
            for v in (-0.006, 0.014):
                made.rod((u, v, d + 0.044), (u, v, d + 0.0475), 0.0065, "teal", 0.0006)
        return made

    def rail(self):
        """Unit vectors along the shaft to the carriage, and from the shaft to the rail."""
        across = np.cross(self.out[1], self.out[2])
        return self.out[2], -np.cross(across / np.linalg.norm(across), self.out[2])

    def shaft(self):
        made = self.link(self.frames[3], self.frames[3][:3, :3], self.frames[3][:3, 3])
        made.rod((0, 0, 0.006), (0, 0, -D4), 0.0041, "carbon", 0.0004, True, 24)
        made.rod((0, 0, 0.0055), (0, 0, 0.011), 0.0043, "steel", 0.0004, False, 24)
        for w in (-0.0027, 0.0027):
            made.rod((0, w, 0.009), (0, w, -0.0012), 0.0012, "steel", 0.0002, False, 10)
        return made

    def wrist(self):
        frame = self.frames[4]
        made = self.link(frame, frame[:3, :3], frame[:3, 3])
        made.bar((0, 0), (WRIST, 0), 0.0044, 0.0036, 0.0, "steel")
        made.rod((0, 0, -0.0034), (0, 0, 0.0034), 0.0013, "brass", 0.0002, False, 14)
        made.rod((WRIST, -0.0032, 0), (WRIST, 0.0032, 0), 0.0010, "brass", 0.0002, False, 14)
        return made

    def grasper(self, number):
        """Half of the jaw, along x of its frame; the inner face through the axis."""
        sign = -1.0 if number == 1 else 1.0
        frame = self.frames[5] @ row(0.0, 0.0, sign * JAW_HOME, 0.0)
        made = self.link(frame, frame[:3, :3], frame[:3, 3])
        low, high = sorted((0.0, sign * 0.0021))
        made.box((-0.0005, low, -0.0019), (JAW_LENGTH, high, 0.0019), 0.0005, "steel")
        at = 0.0011 * sign
        made.rod((0, 0, at - 0.0009), (0, 0, at + 0.0009), 0.0018, "aluminium", 0.0002, False, 16)
        return made

    def add(self, model, folder):
        def body(name, made, mass=0.0, com=(0, 0, 0), size=(0.05, 0.05, 0.05)):
            mesh = folder.add(f"{self.name}_{name}.obj", made.mesh())
            com = tuple(made.to_body(com)) if mass else None
            model.body(f"{self.name}_{name}", mesh=mesh, **made.entries(mass, com, size), **{"collision groups": [0]})

        def middle(made, low, high):
            """In the plane of a part, from the world."""
            return made.plane.T @ (0.5 * (np.array(low) + np.array(high)) - made.center)

        body("base", self.base_link())
        c = self.center
        first, second = self.first(), self.second()
        at = middle(first, c + self.out[0] * 0.32, c + self.out[1] * 0.32)
        body("link1", first, MASSES[0], at, (0.25, 0.25, 0.25))
        at = middle(second, c + self.out[1] * 0.25, c + self.out[2] * 0.36)
        body("link2", second, MASSES[1], at, (0.2, 0.2, 0.3))
        body("carriage", self.carriage(), MASSES[2], (0.0, 0.025, HOME[2] + 0.01), (0.05, 0.06, 0.06))
        body("shaft", self.shaft(), MASSES[3], (0.0, 0.0, 0.24), (0.09, 0.09, 0.45))
        body("wrist", self.wrist(), MASSES[4], (0.006, 0.0, 0.0), (0.009, 0.006, 0.006))
        for number in (1, 2):
            body(f"grasper{number}", self.grasper(number), JAW_MASS, (0.006, 0.0, 0.0), (0.013, 0.004, 0.004))
        parent = "base"
        for k, (joint, child) in enumerate(zip(NAMES, LINKS, strict=True)):
            kind = "prismatic" if k == 2 else "revolute"
            point = self.frames[k][:3, 3]
            # A slide's pivots meet at its zero, where the carriage is at the remote centre.
            apart = {"child_point": tuple(point)} if k == 2 else {}
            model.joint(
                f"{self.name}_{joint}",
                kind,
                f"{self.name}_{parent}",
                f"{self.name}_{child}",
                tuple(self.center if k == 2 else point),
                tuple(self.frames[k][:3, 2]),
                home=HOME[k],
                limits=LIMITS[k],
                **apart,
                **servo(EFFORTS[k]),
            )
            parent = child
        for number, sign in ((1, -1.0), (2, 1.0)):
            frame = self.frames[5]
            model.joint(
                f"{self.name}_grasper{number}",
                "revolute",
                f"{self.name}_wrist",
                f"{self.name}_grasper{number}",
                tuple(frame[:3, 3]),
                tuple(sign * frame[:3, 2]),
                home=JAW_HOME,
                limits=JAW,
                **servo(JAW_EFFORT),
            )


def build(models):
    folder = MeshFolder(models, "raven2")
    model = Model(
        "Raven II: two surgical arms, left and right, on a bench (docs/models.md). Gravity does not act on it, as in\n"
        "the original's file; its motors keep their last target.",
        namespace="/ambf/env/raven2/",
        meshes=folder.seen_from(3),
        gravity=vector((0, 0, 0)),
        **{"ignore inter-collision": True},
    )
    for side in (-1, 1):
        Arm(side).add(model, folder)
    folder.close()
    robot_files.write(model, models, "raven2")
