"""Open chains of ADF files: the joints between two bodies, with their pivots, axes, offsets and limits."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import yaml

from ._chain import Array, Step, rotation, translation
from ._inverse import Chain

_MOVING = ("revolute", "continuous", "prismatic", "hinge", "slider")


# Sine of the angle to the opposite direction below which axes count as opposite (docs/equations.md).
_OPPOSITE = 1.5926e-3


def rotation_between(a: Array, b: Array) -> Array:
    """4x4 shortest rotation that maps unit vector a onto b; opposite ones turn about a x n_x, or b x n_y."""
    cross = np.cross(a, b)
    cos, sin = float(a @ b), float(np.linalg.norm(cross))
    if cos > 0.0 or sin > _OPPOSITE:
        return axis_angle(cross / sin if sin > 0.0 else np.array([0.0, 0.0, 1.0]), float(np.arctan2(sin, cos)))
    # Rounded axes of files are never quite opposite: their cross product would be noise. Half a turn, then the rest.
    about = np.cross(a, [1.0, 0.0, 0.0])
    if np.linalg.norm(about) < 1e-3:
        about = np.cross(b, [0.0, 1.0, 0.0])
    half = axis_angle(about / np.linalg.norm(about), np.pi)
    return rotation_between(half[:3, :3] @ a, b) @ half


def axis_angle(axis: Array, angle: float) -> Array:
    """4x4 rotation by an angle (rad) about a unit vector."""
    x, y, z = axis
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    made = np.identity(4)
    made[:3, :3] += np.sin(angle) * k + (1.0 - np.cos(angle)) * (k @ k)
    return made


def chain_of_adf(path: str | Path, root: str, tip: str) -> Chain:
    """The chain from the body frame of `root` to that of `tip` (names in the file), for FK, IK and Jacobians.

    Joints are those between them, in their order, at the file's positions, offsets and limits. KeyError if nothing
    connects the two, ValueError if a joint between them is neither revolute, prismatic nor fixed, has an axis of no
    length, or none of them moves.
    """
    with open(path, encoding="utf-8") as file:
        model: dict[str, Any] = yaml.safe_load(file)
    bodies = {key: model[key] for key in model.get("bodies", [])}
    keys = {body.get("name", key): key for key, body in bodies.items()}
    for name in (root, tip):
        if name not in keys:
            raise KeyError(f"{path} has no body {name!r}")
    between = _between([{"name": key, **model[key]} for key in model.get("joints", [])], keys[root], keys[tip])
    if between is None:
        raise KeyError(f"no joints lead from {root!r} to {tip!r} in {path}")
    steps: list[Step] = []
    limits: list[tuple[float, float]] = []
    names: list[str] = []
    carried = np.identity(4)
    for joint in between:
        kind = joint["type"]
        before, after = _fixed_parts(joint, bodies[joint["parent"]], bodies[joint["child"]])
        if kind == "fixed":
            carried = carried @ before @ after
            continue
        if kind not in _MOVING:
            raise ValueError(f"joint {joint['name']!r} of {path} is {kind}: no chain of axes leads through it")
        steps.append(Step(carried @ before, len(steps), kind in ("prismatic", "slider")))
        carried = after
        limits.append(_limits(joint))
        names.append(joint["name"])
    if not steps:
        raise ValueError(f"no joint between {root!r} and {tip!r} in {path} moves")
    low, high = (np.array([limit[side] for limit in limits]) for side in (0, 1))
    return Chain(steps, low, high, tip=carried, home=np.clip(np.zeros(len(steps)), low, high), names=names)


def _between(joints: list[dict[str, Any]], root: str, tip: str) -> list[dict[str, Any]] | None:
    """The shortest way from parents to children."""
    ways: dict[str, list[dict[str, Any]]] = {root: []}
    reached = [root]
    for body in reached:
        if body == tip:
            return ways[body]
        for joint in joints:
            # Points in loops carry nothing.
            if joint["parent"] == body and joint["child"] not in ways and joint["type"] != "p2p":
                ways[joint["child"]] = [*ways[body], joint]
                reached.append(joint["child"])
    return None


def _limits(joint: dict[str, Any]) -> tuple[float, float]:
    """Infinite without both limits, or with the lower above the upper: such joints are free."""
    given = joint.get("joint limits", {})
    low, high = float(given.get("low", np.inf)), float(given.get("high", -np.inf))
    return (low, high) if low <= high and joint["type"] != "continuous" else (-np.inf, np.inf)


def _vector(owner: dict[str, Any], key: str) -> Array:
    given = owner.get(key, {})
    return np.array([float(given.get(axis, 0.0)) for axis in "xyz"])


def _fixed_parts(joint: dict[str, Any], parent: dict[str, Any], child: dict[str, Any]) -> tuple[Array, Array]:
    """Transforms before and after the motion along or about z, from the parent's to the child's body frame."""
    parent_axis, child_axis = (_vector(joint, key) for key in ("parent axis", "child axis"))
    if min(np.linalg.norm(parent_axis), np.linalg.norm(child_axis)) == 0.0:
        raise ValueError(f"joint {joint['name']!r} has an axis of no length")
    parent_axis, child_axis = parent_axis / np.linalg.norm(parent_axis), child_axis / np.linalg.norm(child_axis)
    to_z = rotation_between(np.array([0.0, 0.0, 1.0]), parent_axis)
    turn = float(joint.get("child offset", joint.get("offset", 0.0))) - float(joint.get("joint offset", 0.0))
    pivot = _vector(joint, "parent pivot") * float(parent.get("scale", 1.0))
    before = translation(*pivot) @ to_z @ rotation(2, turn)
    child_pivot = _vector(joint, "child pivot") * float(child.get("scale", 1.0))
    after = to_z.T @ rotation_between(child_axis, parent_axis) @ translation(*-child_pivot)
    return before, after
