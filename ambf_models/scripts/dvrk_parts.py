"""What the arms of the da Vinci Research Kit share: frames, links made of plates and tubes, servos, markers.

Parts are made in an arm's plane at its home pose: (u, v, w) with u along the yaw axis away from the patient, v up the
shaft, w across the linkage, from the remote centre. `Link` turns them into the frame of a body, and its colliding
shapes with them.
"""

import math

import adf_kinematics as kinematics
import mesh_tools as mt
import numpy as np
import outlines
from adf_writer import box_inertia, placed, shape_box, shape_round, velocity_servo

# The planes in the world, as the files of the original stand: v is +z; u is +y and w +x, or u is -y and w -x.
TO_LEFT = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
TO_RIGHT = np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
# What follows a moving command within 2 % at 0.5 Hz, and still brakes from a step with the efforts of the real motors:
# v = (P error + D rate) / (1 + D), 10 /s of the error and 95 % of the commanded rate (model/joint_controller.h).
GAIN, RATE_GAIN = 200.0, 19.0


def servo(max_effort):
    """Joint entries for a motor of at most `max_effort` (Nm or N) that keeps its last target when commands end."""
    motor = velocity_servo(GAIN, max_effort * 1e-3)
    return {**motor, "controller": {"P": GAIN, "I": 0.0, "D": RATE_GAIN}, "hold": True}


def place(center, plane, at):
    """A point (u, v) of an arm's plane in the world."""
    return tuple(np.array(center) + plane @ np.array([*at, 0.0]))


def add_bodies(model, folder, links, targets, masses, passive):
    """`links`: function that makes the Link by name, None for a marker; `targets`: colour, collision group and further
    entries of markers; `masses`: mass (kg), centre of mass in the body frame (m), box with the same inertia (m)."""
    for name, make in links.items():
        mesh = name.replace(" link", "").replace(" ", "_") + ".obj"
        if make is None:
            color, group, more = targets[name]
            model.body(name, **marker(folder.add(mesh, marker_mesh(color)), group, **more))
            continue
        made = make()
        folder.add(mesh, made.mesh())
        marks = {"passive": True} if name in passive else {}
        entries = made.entries(*masses.get(name, (0.0, None, None)))
        model.body(name, mesh=mesh, **entries, **marks, **{"collision groups": [0]})


class Link:
    """One body: its frame at home, its mesh and what collides."""

    def __init__(self, origin, rpy, center, plane):
        """`origin` (u, v, w) of the body's frame, `rpy` its orientation in the world, `center` the world position of
        the remote centre."""
        self.position = tuple(np.array(center, dtype=float) + plane @ np.array(origin, dtype=float))
        self.rpy = rpy
        self.plane, self.center = plane, np.array(center, dtype=float)
        self._to_body = np.array(kinematics.rpy(*rpy)).T @ plane
        self._origin = np.array(origin, dtype=float)
        self.parts, self.shapes = [], []

    def to_body(self, point):
        return self._to_body @ (np.array(point, dtype=float) - self._origin)

    def in_plane(self, point):
        """(u, v, w) at home of a point of the body's frame."""
        return self._origin + self._to_body.T @ np.array(point, dtype=float)

    def _add(self, mesh, turn, middle):
        """`turn`: 3x3 from the part's axes to (u, v, w)."""
        where = self.to_body(middle)
        self.parts.append(mesh.turned(self._to_body @ turn).moved(*where))

    def _collide(self, shape, turn, middle):
        self.shapes.append(placed(shape, self.to_body(middle), rpy_of(self._to_body @ turn)))

    def bar(self, start, end, width, thickness, w, color, collides=True):
        """Flat bar with round ends between two points (u, v); its middle plane at `w`."""
        start, end = np.array(start), np.array(end)
        length = float(np.linalg.norm(end - start))
        angle = math.atan2(end[1] - start[1], end[0] - start[0])
        turn = mt.rotation_about("z", angle)
        outline = outlines.stadium(length, width / 2, 6)
        plate = mt.extrude(outline, thickness, min(0.002, 0.2 * thickness), 1, color)
        self._add(plate, turn, (*start, w))
        if collides:
            self._collide(shape_box(length + width, width, thickness), turn, (*((start + end) / 2), w))

    def box(self, low, high, bevel, color, collides=True):
        """Box between two corners (u, v, w)."""
        low, high = np.array(low), np.array(high)
        size = high - low
        self._add(mt.box(*size, bevel, color=color, segments=1), np.eye(3), (low + high) / 2)
        if collides:
            self._collide(shape_box(*size), np.eye(3), (low + high) / 2)

    def rod(self, start, end, radius, color, bevel=0.001, collides=False, segments=20):
        """Cylinder between two points (u, v, w)."""
        start, end = np.array(start, dtype=float), np.array(end, dtype=float)
        length = float(np.linalg.norm(end - start))
        turn = along((end - start) / length)
        self._add(mt.cylinder(radius, length, bevel, segments, color), turn, (start + end) / 2)
        if collides:
            self._collide(shape_round("CYLINDER", radius, length), turn, (start + end) / 2)

    def pipe(self, start, end, outer, inner, color):
        """Tube between two points; collides as a full cylinder, since shaft and tube are of one file."""
        start, end = np.array(start, dtype=float), np.array(end, dtype=float)
        length = float(np.linalg.norm(end - start))
        turn = along((end - start) / length)
        self._add(mt.tube(outer, inner, length, 0.0005, 18, color), turn, (start + end) / 2)
        self._collide(shape_round("CYLINDER", outer, length), turn, (start + end) / 2)

    def pin(self, point, radius, w_low, w_high, color="steel", collides=False):
        """Axle across the linkage at a point (u, v)."""
        self.rod((*point, w_low), (*point, w_high), radius, color, collides=collides)

    def shape(self, mesh, turn, middle):
        """A mesh of its own, its axes turned to (u, v, w)."""
        self._add(mesh, np.array(turn, dtype=float), middle)

    def mesh(self):
        return mt.joined(self.parts)

    def entries(self, mass, com, size):
        """Entries of Model.body. `com` in the body frame; the inertia is that of a box of `size` (body axes)."""
        common = {"position": self.position, "orientation": self.rpy, "compound": self.shapes, "restitution": 0.0}
        if mass == 0.0:
            return common
        return {**common, "mass": mass, "com": com, "inertia": box_inertia(mass, *size)}


def along(direction):
    """A rotation that turns z to a unit direction."""
    z = np.array(direction, dtype=float)
    x = np.cross(np.eye(3)[np.argmin(np.abs(z).round(9))], z)  # the same of equal ones, however a machine rounds
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def rpy_of(R):
    """Roll, pitch, yaw of a rotation; at a pitch of 90 degrees with the roll 0. Half a turn is positive."""
    R = np.where(np.abs(R) < 1e-12, 0.0, R)  # the sign of noise differs between machines
    if math.hypot(R[0, 0], R[1, 0]) < 1e-9:
        return (0.0, math.copysign(math.pi / 2, -R[2, 0]), math.atan2(-R[0, 1], R[1, 1]))
    return (
        math.atan2(R[2, 1], R[2, 2]),
        math.atan2(-R[2, 0], math.hypot(R[0, 0], R[1, 0])),
        math.atan2(R[1, 0], R[0, 0]),
    )


def stand(height, color="graphite"):
    """Column on the floor that carries an arm's foot: (mesh, compound), its top at the origin."""
    column = mt.cylinder(0.045, height - 0.02, 0.002, 28, color).moved(z=-(height + 0.02) / 2)
    foot = mt.box(0.42, 0.42, 0.03, 0.006, 0.04, "night", 2).moved(z=-height + 0.015)
    plate = mt.cylinder(0.065, 0.02, 0.002, 28, "steel").moved(z=-0.01)
    shapes = [
        placed(shape_round("CYLINDER", 0.045, height), (0, 0, -height / 2)),
        placed(shape_box(0.42, 0.42, 0.03), (0, 0, -height + 0.015)),
    ]
    return mt.joined([column, foot, plate]), shapes


def marker_mesh(color):
    """A ball with three stubs along the axes: what programs move to show where a tip shall be."""
    ball = mt.lathe(
        [
            (0.004 * math.sin(math.pi * k / 6) if 0 < k < 6 else 0.0, -0.004 * math.cos(math.pi * k / 6))
            for k in range(7)
        ],
        12,
        color,
    )
    stubs = [mt.cylinder(0.0012, 0.008, 0.0, 8, color).moved(z=0.006).along(axis) for axis in "xyz"]
    return mt.joined([ball, *stubs])


def marker(mesh, group, **more):
    """Entries of a body that marks a target: static, at the world's origin, touched by its own group only."""
    ball = {"shape": "SPHERE", "geometry": {"radius": 0.006}}
    return {"mesh": mesh, "shape": (ball, (0.003, 0.003, 0.003), (0, 0, 0)), "collision groups": [group], **more}
