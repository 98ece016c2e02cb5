"""Reads arms.yaml."""

from __future__ import annotations

import functools
from copy import deepcopy
from importlib import resources
from typing import Any

import numpy as np
import yaml

from ._arm import AdfJoint, Arm, Jaw, JawHalf, Row
from ._chain import Array, Step, rotation, translation

_DEGREE = np.pi / 180.0
_INDEXED = ("rows", "limits_deg", "max_effort")


@functools.cache
def _file() -> dict[str, dict[str, Any]]:
    text = resources.files(__package__).joinpath("arms.yaml").read_text(encoding="utf-8")
    read: dict[str, dict[str, Any]] = yaml.safe_load(text)
    return read


def arm_names() -> list[str]:
    """Names of the arms that are known."""
    return list(_file())


def tool_names(arm: str) -> list[str]:
    """Names of an arm's tools; none for an arm without."""
    return list(_described(arm).get("tools", {}))


def load_arm(name: str, tool: str | None = None) -> Arm:
    """An arm of arm_names() with one of its tools, the default one if None. KeyError for unknown names."""
    described = _described(name)
    tools = described.get("tools", {})
    tool = tool or described.get("default_tool", "")
    if tool and tool not in tools:
        raise KeyError(f"{name} has no tool {tool!r}; there are {', '.join(tools) or 'none'}")
    return _made(name, tool, _changed(described, tools.get(tool, {})))


def _described(name: str) -> dict[str, Any]:
    if name not in _file():
        raise KeyError(f"no arm is named {name!r}; there are {', '.join(_file())}")
    own = _file()[name]
    return _changed(_described(own["same_as"]), own) if "same_as" in own else own


def _changed(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    made = deepcopy(base)
    for key, value in changes.items():
        if key not in _INDEXED:
            made[key] = value
            continue
        for index, entry in value.items():
            if key == "rows":
                while len(made["rows"]) <= index:
                    made["rows"].append({})
                made["rows"][index].update(entry)
            elif key == "limits_deg":
                made["joints"][index].pop("limits", None)
                made["joints"][index][key] = entry
            else:
                made["joints"][index][key] = entry
    return made


def _limits(described: dict[str, Any]) -> tuple[float, float]:
    low, high = described["limits"] if "limits" in described else (v * _DEGREE for v in described["limits_deg"])
    return float(low), float(high)


def _pose(described: dict[str, Any]) -> Array:
    made = translation(*described.get("xyz", (0.0, 0.0, 0.0)))
    if "matrix" in described:
        made[:3, :3] = described["matrix"]
    roll, pitch, yaw = (v * _DEGREE for v in described.get("rpy_deg", (0.0, 0.0, 0.0)))
    turned: Array = made @ rotation(2, yaw) @ rotation(1, pitch) @ rotation(0, roll)
    return turned


def _made(name: str, tool: str, described: dict[str, Any]) -> Arm:
    joints = described["joints"]
    limits = [_limits(joint) for joint in joints]
    rows = [
        Row(r["joint"], r["alpha_deg"] * _DEGREE, r["a"], r["d"], r["theta_deg"] * _DEGREE, r.get("ratio", 1.0))
        for r in described["rows"]
    ]
    steps: list[Step] = []
    foot = _pose(described.get("foot", {}))
    carried = np.identity(4)  # what standard tables have behind an axis
    for row in rows:
        link = rotation(0, row.alpha) @ translation(row.a, 0.0, 0.0)
        along = rotation(2, row.theta) @ translation(0.0, 0.0, row.d)
        modified = described["dh"] == "modified"
        before = link @ along if modified else carried @ along
        carried = np.identity(4) if modified else translation(row.a, 0.0, 0.0) @ rotation(0, row.alpha)
        before = before if steps else foot @ before
        steps.append(Step(before, row.joint, joints[row.joint]["type"] == "prismatic", row.ratio))
    jaw = described.get("jaw")
    adf = described.get("adf", {})
    coupling = described.get("coupling")
    return Arm(
        steps=steps,
        lower=np.array([low for low, _ in limits]),
        upper=np.array([high for _, high in limits]),
        tip=carried @ _pose(described.get("tip", {})),
        home=np.array([joint["home"] for joint in joints], dtype=float),
        names=[joint["name"] for joint in joints],
        name=name,
        tool=tool,
        solver=described["solver"],
        rows=rows,
        max_effort=np.array([joint.get("max_effort", 0.0) for joint in joints]),
        jaw=Jaw(jaw["name"], *_limits(jaw), jaw["max_effort"]) if jaw else None,
        coupling=None if coupling is None else np.array(coupling),
        adf_joints=[AdfJoint(j["joint"], j.get("sign", 1.0), j.get("offset", 0.0)) for j in adf.get("joints", [])],
        adf_jaw=[JawHalf(j["joint"], j["wrist"]) for j in adf.get("jaw", [])],
    )
