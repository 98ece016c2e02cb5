#!/usr/bin/env python3
"""Checks that an ADF model is put together: at the listed body locations every joint's pivots meet and its axes agree.

    adf_kinematics.py FILE.yaml...     prints each joint's gap, misalignment and home value; exit status 1 on a fault

A revolute joint at value q puts its child at  R = Turn(parent axis, offset + q) R0,  p = parent pivot - R child
pivot,  where R0 is the shortest rotation from the child axis to the parent axis (dissertation Alg. 2) and poses are
those of the child in the parent's frame; a prismatic one keeps q out of R and adds q * parent axis to p
(dissertation §4.3.3). Here q is found from the locations and whatever is left over is reported. Needs PyYAML only
when run on files; the arithmetic is plain Python, in doubles.
"""

import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

TOLERANCE = 1e-9  # m and rad
OPPOSITE = 1.5926e-3  # sine of the angle below which two axes count as opposite (math/rotation.cpp)

REVOLUTE = ("revolute", "hinge", "continuous", "torsion spring")
PRISMATIC = ("prismatic", "slider", "linear spring")
POINT = ("p2p",)


# --- 3x3 matrices as row lists --------------------------------------------------------------------


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def transposed(a):
    return [[a[j][i] for j in range(3)] for i in range(3)]


def rotate(a, v):
    return [sum(a[i][k] * v[k] for k in range(3)) for i in range(3)]


def rotate_back(a, v):
    return rotate(transposed(a), v)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def plus(a, b, factor=1.0):
    return [x + factor * y for x, y in zip(a, b, strict=True)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(v):
    return math.sqrt(dot(v, v))


def unit(v):
    length = norm(v)
    if length < 1e-9:
        raise ValueError("an axis of length zero")
    return [x / length for x in v]


def rpy(roll, pitch, yaw):
    """Fixed-axis roll, pitch, yaw: Rz(yaw) Ry(pitch) Rx(roll)."""
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]


def turn(axis, angle):
    """Rotation by `angle` about a unit axis."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = axis
    k = 1.0 - c
    return [
        [c + x * x * k, x * y * k - z * s, x * z * k + y * s],
        [y * x * k + z * s, c + y * y * k, y * z * k - x * s],
        [z * x * k - y * s, z * y * k + x * s, c + z * z * k],
    ]


def shortest_rotation(a, b):
    """Rotation that maps unit vector a onto b (dissertation Alg. 2, with the antiparallel case done properly)."""
    v, c = cross(a, b), dot(a, b)
    s = norm(v)
    if c > 0.0:
        k = 1.0 / (1.0 + c)
        x, y, z = v
        skew = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
        square = product(skew, skew)
        return [[(i == j) + skew[i][j] + k * square[i][j] for j in range(3)] for i in range(3)]
    if s > OPPOSITE:
        return turn([x / s for x in v], math.atan2(s, c))
    k = cross(a, [1.0, 0.0, 0.0])
    if norm(k) < 1e-3:
        k = cross(b, [0.0, 1.0, 0.0])
    half = turn(unit(k), math.pi)
    return product(shortest_rotation(rotate(half, a), b), half)


def rotation_angle(r):
    """Angle of a rotation matrix, accurate near zero."""
    sine = 0.5 * norm([r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]])
    return math.atan2(sine, 0.5 * (r[0][0] + r[1][1] + r[2][2] - 1.0))


def turn_about_axis(R_parent, R_child, parent_axis, child_axis):
    """Angle by which the child is turned about the parent axis, beyond the shortest rotation between the axes."""
    rest = product(
        product(transposed(R_parent), R_child), transposed(shortest_rotation(unit(child_axis), unit(parent_axis)))
    )
    axis = unit(parent_axis)
    vee = [0.5 * (rest[2][1] - rest[1][2]), 0.5 * (rest[0][2] - rest[2][0]), 0.5 * (rest[1][0] - rest[0][1])]
    return math.atan2(dot(vee, axis), 0.5 * (rest[0][0] + rest[1][1] + rest[2][2] - 1.0))


# --- files ----------------------------------------------------------------------------------------


def xyz(node):
    return [float(node["x"]), float(node["y"]), float(node["z"])]


def pose_of(location):
    """(rotation, position) of a `location` node; absent parts are zero."""
    location = location or {}
    turned = location.get("orientation") or {"r": 0.0, "p": 0.0, "y": 0.0}
    at = location.get("position") or {"x": 0.0, "y": 0.0, "z": 0.0}
    return rpy(float(turned["r"]), float(turned["p"]), float(turned["y"])), xyz(at)


def place_child(joint, value):
    """(rotation, position) of the child in the parent's frame at a joint value; revolute, prismatic, fixed joints."""
    parent_axis, child_axis = unit(xyz(joint["parent axis"])), unit(xyz(joint["child axis"]))
    offset = float(joint.get("offset", joint.get("child offset", 0.0)))
    slides = joint["type"] in PRISMATIC
    angle = offset if slides else offset + value
    rotation = product(turn(parent_axis, angle), shortest_rotation(child_axis, parent_axis))
    position = plus(xyz(joint["parent pivot"]), rotate(rotation, xyz(joint["child pivot"])), -1.0)
    return rotation, plus(position, parent_axis, value) if slides else position


@dataclass
class JointReport:
    name: str
    kind: str
    gap: float = 0.0  # m, between the pivots (off the axis only, for a prismatic joint)
    misalignment: float = 0.0  # rad, of what the joint does not allow to turn
    home: float = 0.0  # rad or m at the listed locations
    faults: list = field(default_factory=list)


def check_joint(name, joint, bodies):
    report = JointReport(name, str(joint.get("type", "")))
    if joint.get("joint offset"):
        report.faults.append("`joint offset` is not handled here (our models use `offset`)")
    missing = [joint.get(role) for role in ("parent", "child") if joint.get(role) not in bodies]
    if missing:
        report.faults.append(f"no such body: {missing}")
        return report
    R_parent, p_parent = pose_of(bodies[joint["parent"]].get("location"))
    R_child, p_child = pose_of(bodies[joint["child"]].get("location"))
    parent_axis, child_axis = unit(xyz(joint["parent axis"])), unit(xyz(joint["child axis"]))
    parent_pivot = plus(p_parent, rotate(R_parent, xyz(joint["parent pivot"])))
    child_pivot = plus(p_child, rotate(R_child, xyz(joint["child pivot"])))
    between = plus(child_pivot, parent_pivot, -1.0)
    axis_world = rotate(R_parent, parent_axis)
    offset = float(joint.get("offset", joint.get("child offset", 0.0)))
    turned = turn_about_axis(R_parent, R_child, parent_axis, child_axis)
    rigid = product(turn(parent_axis, offset), shortest_rotation(child_axis, parent_axis))
    relative = product(transposed(R_parent), R_child)
    if report.kind in REVOLUTE:
        report.gap = norm(between)
        report.misalignment = math.atan2(
            norm(cross(axis_world, rotate(R_child, child_axis))), dot(axis_world, rotate(R_child, child_axis))
        )
        report.home = math.remainder(turned - offset, 2.0 * math.pi)
    elif report.kind in PRISMATIC or report.kind == "fixed":
        report.misalignment = rotation_angle(product(relative, transposed(rigid)))
        if report.kind == "fixed":
            report.gap = norm(between)
        else:
            report.home = dot(between, axis_world)
            report.gap = norm(plus(between, axis_world, -report.home))
    elif report.kind in POINT:
        report.gap = norm(between)
    else:
        report.faults.append(f"joint type '{report.kind}' is not known here")
    if report.gap > TOLERANCE:
        report.faults.append(f"pivots are {report.gap:.3e} m apart")
    if report.misalignment > TOLERANCE:
        report.faults.append(f"axes disagree by {report.misalignment:.3e} rad")
    limits = joint.get("joint limits")
    if limits and not float(limits["low"]) - TOLERANCE <= report.home <= float(limits["high"]) + TOLERANCE:
        report.faults.append(f"home value {report.home:.6f} lies outside its limits {limits}")
    return report


def check_model(model):
    """One report per listed joint of a parsed ADF model."""
    bodies = {name: model[name] for name in model.get("bodies", [])}
    return [check_joint(name, model[name], bodies) for name in model.get("joints", [])]


def check_file(path):
    import yaml

    return check_model(yaml.safe_load(Path(path).read_text(encoding="utf-8")))


def main(paths):
    bad = 0
    for path in paths:
        print(path)
        for report in check_file(path):
            print(
                f"  {report.name}: {report.kind}, gap {report.gap:.1e} m, axes {report.misalignment:.1e} rad, "
                f"home {report.home:.6g}"
            )
            for fault in report.faults:
                bad += 1
                print(f"    FAULT {fault}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
