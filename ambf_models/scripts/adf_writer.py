"""Writes scenes as ADF text: bodies and joints are given in world coordinates, the writer works out pivots, axes and
offsets.

Numbers are written with all their digits, so that joints and closed loops meet to the last bit. A joint is placed by
its point and axis in the world at the home pose; from these and the two body poses follow `parent pivot`, `child
pivot`, `parent axis`, `child axis` and, where the home pose is not the joint's zero, `offset`.
"""

import copy
import math
import re
from pathlib import Path

import adf_kinematics as kinematics
from mesh_io import METALS, PALETTE

ZERO = (0.0, 0.0, 0.0)
PREFIXES = {
    "sensors": "SENSOR",
    "actuators": "ACTUATOR",
    "ghost objects": "GHOST",
    "vehicles": "VEHICLE",
    "soft bodies": "SOFT",
    "tasks": "TASK",
}


# --- text -----------------------------------------------------------------------------------------


def number(value):
    """Shortest text that reads back as the same double; noise below 1e-15 of a metre or radian is zero."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if abs(value) < 1e-15:
        return "0.0"
    text = repr(float(value))
    # Without a point YAML 1.1 takes it for a word.
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def flow(mapping):
    return "{" + ", ".join(f"{key}: {scalar(value)}" for key, value in mapping.items()) + "}"


def scalar(value):
    if isinstance(value, dict):
        return flow(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(scalar(v) for v in value) + "]"
    if isinstance(value, str):
        return value
    return number(value)


def vector(v):
    return {"x": float(v[0]), "y": float(v[1]), "z": float(v[2])}


def pose(position, orientation=ZERO):
    return {"position": vector(position), "orientation": dict(zip("rpy", map(float, orientation), strict=True))}


def block(name, entries):
    """One top-level block; lists of maps get a line for each item."""
    lines = [f"{name}:"]
    for key, value in entries.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            lines.append(f"  {key}:")
            lines += [f"    - {flow(item)}" for item in value]
        else:
            lines.append(f"  {key}: {scalar(value)}")
    return "\n".join(lines)


# --- shapes and their inertia ---------------------------------------------------------------------


def shape_box(x, y, z):
    return {"shape": "BOX", "geometry": {"x": float(x), "y": float(y), "z": float(z)}}


def shape_ground():
    """The half space below z = 0: as a floor far cheaper than a box beneath meshes that reach into it."""
    return {"shape": "PLANE", "geometry": {"normal": {"x": 0.0, "y": 0.0, "z": 1.0}, "offset": 0.0}}


def shape_round(kind, radius, height, axis="z"):
    """CYLINDER or CAPSULE (a capsule's height counts its caps)."""
    return {"shape": kind, "geometry": {"radius": float(radius), "height": float(height), "axis": axis.upper()}}


def placed(shape, position, orientation=ZERO):
    return {**shape, "offset": pose(position, orientation)}


def box_inertia(mass, x, y, z):
    return (mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12)


def cylinder_inertia(mass, radius, height, axis="z"):
    across = mass * (3 * radius * radius + height * height) / 12
    return tuple(0.5 * mass * radius * radius if a == axis else across for a in "xyz")


def tube_inertia(mass, outer, inner, height):
    square = outer * outer + inner * inner
    across = mass * (3 * square + height * height) / 12
    return (across, across, 0.5 * mass * square)


def combined_inertia(parts):
    """Parts: (mass, centre, diagonal inertia about the part's centre). Returns mass, centre, diagonal inertia about
    the centre. Products of inertia are left out: the parts must lie on a common symmetry axis or plane closely
    enough."""
    mass = sum(p[0] for p in parts)
    centre = tuple(sum(p[0] * p[1][i] for p in parts) / mass for i in range(3))
    inertia = [0.0, 0.0, 0.0]
    for m, c, diagonal in parts:
        d = [c[i] - centre[i] for i in range(3)]
        square = sum(v * v for v in d)
        for i in range(3):
            inertia[i] += diagonal[i] + m * (square - d[i] * d[i])
    return mass, centre, tuple(inertia)


# --- a model file ---------------------------------------------------------------------------------


class Model:
    """Collects the blocks of one ADF file."""

    def __init__(self, title, namespace="/ambf/env/", meshes=None, low_resolution=False, **header):
        """`meshes`: folder of the meshes as seen from the file, without high_res or low_res; `low_resolution`: it has
        meshes for collision."""
        self.title, self.namespace, self.header = title, namespace, header
        self.meshes, self.low_resolution = meshes, low_resolution
        self.bodies, self.joints = {}, {}
        self.others = {kind: {} for kind in PREFIXES}  # blocks by name

    def add(self, kind, name, parent=None, **entries):
        """A block of a kind in PREFIXES. `parent`: name of a body; keys that are no Python names go in as
        **{"matching key": ...}."""
        if name in self.others[kind]:
            raise ValueError(f"two {kind} named {name}")
        sits_on = {"parent": f"BODY {parent}"} if parent else {}
        self.others[kind][name] = {"name": name, **sits_on, **entries}

    def body(
        self,
        name,
        position=ZERO,
        orientation=ZERO,
        mass=0.0,
        inertia=None,
        com=ZERO,
        mesh=None,
        color=None,
        shape=None,
        compound=None,
        hull=None,
        friction=(0.5, 0.01),
        restitution=0.1,
        damping=(0.04, 0.1),
        **more,
    ):
        """`orientation`: roll, pitch, yaw. `shape`: (shape, position, orientation) in the body frame; `compound`:
        list of placed shapes; `hull`: low-resolution mesh taken as convex hull. One of the three, or none for a body
        that touches nothing."""
        if name in self.bodies:
            raise ValueError(f"two bodies named {name}")
        entries = {"name": name}
        if mesh:
            entries["mesh"] = mesh
        entries["mass"] = float(mass)
        if mass > 0.0:
            entries["inertia"] = dict(zip(("ix", "iy", "iz"), map(float, inertia), strict=True))
        entries["inertial offset"] = pose(com)
        entries["location"] = pose(position, orientation)
        if shape is not None:
            primitive, where, turn = shape
            entries["collision shape"] = primitive["shape"]
            entries["collision geometry"] = primitive["geometry"]
            entries["collision offset"] = pose(where, turn)
        elif compound is not None:
            entries["compound collision shape"] = compound
        elif hull is not None:
            entries["collision mesh"] = hull
            entries["collision mesh type"] = "CONVEX_HULL"
            entries["collision offset"] = pose(ZERO)
        else:
            raise ValueError(f"{name} has no collision shape")
        entries["friction"] = {"static": float(friction[0]), "rolling": float(friction[1])}
        entries["restitution"] = float(restitution)
        if mass > 0.0:
            entries["damping"] = {"linear": float(damping[0]), "angular": float(damping[1])}
        if color is not None:
            entries["color components"] = color_components(color)
        entries.update(more)
        self.bodies[name] = entries

    def _pose_of(self, name):
        return kinematics.pose_of(self.bodies[name]["location"])

    def joint(self, name, kind, parent, child, point, axis, home=0.0, limits=None, child_point=None, **more):
        """`point`, `axis` in the world at the home pose; the joint's value there shall be `home` (rad or m). For a
        prismatic joint whose pivots are apart give `child_point` too: then `home` is the distance along the axis."""
        if name in self.joints:
            raise ValueError(f"two joints named {name}")
        R_parent, p_parent = self._pose_of(parent)
        R_child, p_child = self._pose_of(child)
        length = math.sqrt(sum(v * v for v in axis))
        axis = [v / length for v in axis]
        parent_axis = kinematics.rotate_back(R_parent, axis)
        child_axis = kinematics.rotate_back(R_child, axis)
        entries = {
            "name": name,
            "type": kind,
            "parent": f"BODY {parent}",
            "child": f"BODY {child}",
            "parent pivot": vector(kinematics.rotate_back(R_parent, kinematics.plus(point, p_parent, -1.0))),
            "child pivot": vector(
                kinematics.rotate_back(R_child, kinematics.plus(child_point or point, p_child, -1.0))
            ),
            "parent axis": vector(parent_axis),
            "child axis": vector(child_axis),
        }
        if kind not in ("p2p",):
            turn = kinematics.turn_about_axis(R_parent, R_child, parent_axis, child_axis)
            offset = turn - (home if kind in kinematics.REVOLUTE else 0.0)
            offset = math.remainder(offset, 2.0 * math.pi)
            if abs(offset) > 1e-12:
                entries["offset"] = offset
        if limits is not None:
            entries["joint limits"] = {"low": float(limits[0]), "high": float(limits[1])}
        entries.update(more)
        self.joints[name] = entries

    def vehicle(self, name, chassis, wheels):
        """`wheels`: their maps, in the order of commands."""
        self.others["vehicles"][name] = {"name": name, "chassis": f"BODY {chassis}", "wheels": wheels}

    def text(self):
        lines = [f"# {line}" for line in self.title.strip().splitlines()]
        lines += [
            "# Generated by ambf_models/scripts/generate.py: change the script, not this file.",
            "",
            "adf version: 1.0",
            f"namespace: {self.namespace}",
        ]
        if self.meshes:
            lines.append(f"high resolution path: {self.meshes}/high_res/")
            if self.low_resolution:
                lines.append(f"low resolution path: {self.meshes}/low_res/")
        lines += [f"{key}: {scalar(value)}" for key, value in self.header.items()]
        kinds = [("bodies", "BODY", self.bodies), ("joints", "JOINT", self.joints)]
        kinds += [(kind, prefix, self.others[kind]) for kind, prefix in PREFIXES.items()]
        for key, prefix, blocks in kinds:
            if blocks:
                lines += [f"{key}:"] + [f"  - {prefix} {name}" for name in blocks]
        for _, prefix, blocks in kinds:
            for name, entries in blocks.items():
                lines += ["", block(f"{prefix} {name}", entries)]
        return "\n".join(lines) + "\n"

    def with_gravity(self):
        """The same robot with the world's gravity; its title must say that gravity does not act."""
        heavy = copy.deepcopy(self)
        del heavy.header["gravity"]
        heavy.title, changed = re.subn(
            r"Gravity\s+does\s+not\s+act\s+on\s+it,\s+as\s+in\s+the\s+original's\s+file;",
            "Gravity acts on it;",
            self.title,
        )
        if changed != 1:
            raise ValueError(f"no sentence about gravity in {self.title!r}")
        return heavy

    def write(self, path):
        path = Path(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(self.text(), encoding="utf-8")


def color_components(name):
    r, g, b, specular, shininess = PALETTE[name]
    return {
        "diffuse": {"r": r, "g": g, "b": b},
        "specular": dict.fromkeys("rgb", specular),
        "ambient": {"level": 0.4},
        "shininess": shininess,
        "transparency": 1.0,
        **({"metallic": 1.0} if name in METALS else {}),
    }


def velocity_servo(gain, max_impulse):
    """Joint entries for a motor that is commanded a speed: gain * error for position commands (1/s), at most
    `max_impulse` a step (N m s or N s; a thousandth of the largest torque or force at 1 kHz). Solved together with
    the joint, hence stable at any inertia."""
    return {
        "controller": {"P": float(gain), "I": 0.0, "D": 0.0},
        "controller output type": "VELOCITY",
        "enable motor": True,
        "enable feedback": True,
        "max motor impulse": float(max_impulse),
    }


def spring_servo(stiffness, damping, max_impulse):
    """Joint entries for fingers that grip: force = `stiffness` * error (N m/rad or N/m) less `damping` * speed, solved
    together with the joint. Fingers commanded to the same opening then share a load about the middle, and how far the
    target lies inside of what they hold sets the grip. Without a command the motor holds still with `max_impulse`."""
    return {
        "controller": {"P": float(stiffness), "I": 0.0, "D": float(damping)},
        "controller output type": "FORCE",
        "enable motor": True,
        "enable feedback": True,
        "max motor impulse": float(max_impulse),
    }


def addon_gains(p):
    """Joint entries as the editor of the original's files writes them: D is P times 2 ms."""
    return {"controller": {"P": p, "I": 0.0, "D": round(0.002 * p, 9)}}


PASSIVE = {"enable motor": False, "enable feedback": False, "passive": True}
