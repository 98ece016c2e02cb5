"""Instruments of a PSM, exchanged while the simulation runs.

    from ambf_client import Client
    from ambf_client.instruments import exchange_tool

    psm = exchange_tool(client, "PSM1", "prograsp").arm    # kinematics with that tool: FK, IK, limits

An exchange is two steps of the world's services: Remove (or Unload, of one that came by an exchange) takes the
instrument's bodies, their joints with them, and Load brings the new ones, placed at the carriage's pose and the joints'
values of that moment. Nothing else moves. The joints come last in the base's list then; command them by name. What this
client commands the joints that stay goes on; another client that sends values by their place in the list has to look.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import yaml

from . import rotations
from .kinematics import Arm, load_arm
from .kinematics._adf import _fixed_parts, _limits
from .kinematics._chain import Array, rotation

if TYPE_CHECKING:
    from .client import Client

CARRIER = "maininsertionlink"  #: the body of a PSM that carries instruments
FILE_NAMESPACE = "/ambf/env/psm/"  #: what the files are written for


class Instrument(NamedTuple):
    """A file of ambf_models/instruments, and the tool of kinematics that it is."""

    file: str
    tool: str


INSTRUMENTS = {
    "lnd": Instrument("lnd.yaml", "LARGE_NEEDLE_DRIVER:400006"),
    "prograsp": Instrument("prograsp.yaml", "PROGRASP_FORCEPS:400093"),
    "maryland": Instrument("maryland.yaml", "MARYLAND_BIPOLAR"),
    "scissors": Instrument("scissors.yaml", "CURVED_SCISSORS"),
}


@dataclass(frozen=True)
class Exchanged:
    """What an exchange has done."""

    instrument: str  #: its word in INSTRUMENTS
    arm: Arm  #: the PSM's kinematics with it
    namespace: str  #: the PSM's, e.g. /ambf/env/psm1/
    model: str  #: what unload() takes
    removed: list[str]  #: full names of the bodies and joints that went


def exchange_tool(client: Client, arm: str, instrument: str) -> Exchanged:
    """Gives a PSM another instrument while all runs: a word of INSTRUMENTS, or a tool's name of kinematics.

    arm: the PSM's namespace or the last part of it ("PSM1", "psm1", "/ambf/env/psm1/"). Joints keep their values, but
    for a jaw that opens less wide. KeyError: no such PSM or instrument. What the simulator refuses raises
    RequestRefused; the PSM is then without an instrument, and a second call gives it one.
    """
    word = word_of(instrument)
    listing = client.list()
    bodies = [each.name for each in listing.objects if each.kind == "BODY" or each.topic]
    namespace = namespace_of(arm, bodies)
    joints = {_short(each.name): each.name for each in listing.joints if each.name.startswith(namespace)}
    base = client.wait_for(f"{namespace}baselink", 5.0)
    carrier = client.wait_for(namespace + CARRIER, 5.0)
    measured = {name: base.get_joint_pos(name) for name in joints if base.find_joint(name)[0] is not None}
    positions = {name: float(value) for name, value in measured.items() if value is not None}
    held = {_short(name) for name in parts_of(word)}
    there = [name for name in bodies if name.startswith(namespace) and _short(name) in held]
    pose = np.array(carrier.matrix)
    removed: list[str] = []
    # What an exchange has brought goes as a model, so that nothing of it is left.
    for model in listing.models:
        if model.objects and set(model.objects) <= set(there):
            removed += client.unload(model)
    for name in there:
        if name not in removed:
            removed += client.remove(name)
    loaded = client.load(str(file_of(word)), text=mounted(word, namespace, pose, positions))
    return Exchanged(word, load_arm("PSM", INSTRUMENTS[word].tool), namespace, loaded.model, removed)


def word_of(instrument: str) -> str:
    """The word in INSTRUMENTS of an instrument: itself, a tool's name of kinematics, or that without its number."""
    for word, each in INSTRUMENTS.items():
        if instrument.lower() == word or instrument.upper() in (each.tool, each.tool.partition(":")[0]):
            return word
    raise KeyError(f"no instrument is named {instrument!r}; there are {', '.join(INSTRUMENTS)}")


def namespace_of(arm: str, bodies: Iterable[str]) -> str:
    """The namespace of a PSM among the full names of bodies, with its last slash."""
    found = sorted(name[: name.rindex("/") + 1] for name in bodies if _short(name) == CARRIER)
    wanted = arm.strip("/").lower()
    fits = [each for each in found if each.strip("/").lower() == wanted or each.split("/")[-2].lower() == wanted]
    if not fits and len(found) == 1 and wanted in ("psm", "psm1"):
        fits = found  # robots/psm.yaml alone
    if len(fits) != 1:
        raise KeyError(f"{arm!r} is no PSM of this world; there are {', '.join(found) or 'none'}")
    return fits[0]


def file_of(word: str) -> Path:
    """The instrument's file."""
    here = Path(__file__).resolve().parent
    tried = (here / "../../../../share/ambf/models", here / "../../ambf_models", here / "models")
    folder = next((each for each in tried if (each / "instruments").is_dir()), tried[1])
    return (folder / "instruments" / INSTRUMENTS[word].file).resolve()


def parts_of(word: str) -> list[str]:
    """Names of the bodies that an instrument's file holds."""
    model = _read(word)
    return [str(model[block]["name"]) for block in model["bodies"]]


def mounted(word: str, namespace: str, T_world_carrier: Array, positions: Mapping[str, float]) -> str:
    """ADF text of an instrument on a PSM: its bodies where the carriage's pose and the joints' values put them.

    positions: of the PSM's joints, by name (spaces do not count). A joint that is not there takes 0; one beyond the
    instrument's limits takes the nearest value within. Pure: ambf_core's World.load takes the text, too.
    """
    model = _read(word)
    values = {_short(name): value for name, value in positions.items()}
    poses: dict[str, Array] = {f"{FILE_NAMESPACE}BODY main insertion link": np.asarray(T_world_carrier, dtype=float)}
    for block in model["joints"]:
        joint = model[block]
        if joint["type"] != "revolute":
            continue
        before, after = _fixed_parts({"name": block, **joint}, {}, {})
        low, high = _limits(joint)
        q = float(np.clip(values.get(_short(joint["name"]), 0.0), low, high))
        poses[joint["child"]] = poses[joint["parent"]] @ before @ rotation(2, q) @ after
    for block in model["bodies"]:
        pose = poses[block]
        roll, pitch, yaw = rotations.rpy_from_quaternion(rotations.quaternion_from_matrix(pose[:3, :3]))
        model[block]["location"] = {
            "position": dict(zip("xyz", map(float, pose[:3, 3]), strict=True)),
            "orientation": {"r": float(roll), "p": float(pitch), "y": float(yaw)},
        }
    model["high resolution path"] = f"{(file_of(word).parent / model['high resolution path']).resolve()}/"
    text: str = yaml.safe_dump(model, sort_keys=False)
    return text.replace(FILE_NAMESPACE, namespace)


def _read(word: str) -> dict[str, Any]:
    read: dict[str, Any] = yaml.safe_load(file_of(word).read_text(encoding="utf-8"))
    return read


def _short(name: str) -> str:
    """The last part of a full name, without spaces, as topics and joint names have it."""
    return name.rpartition("/")[2].removeprefix("BODY ").removeprefix("JOINT ").replace(" ", "")
