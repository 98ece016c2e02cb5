"""Instruments of a PSM, a file each: shaft, wrist and jaw, which join the carriage of `robots/psm.yaml` by name.

Programs put them in place of the instrument that a PSM has (ambf_client.instruments), at its joints' values. Published:
shaft and wrist (0.0091 or 0.0107 m), limits of the jaw where they are known. Chosen: masses, inertias, shapes and
lengths of jaws, and that an unknown jaw has the limits of the needle driver's.

Parts of a PSM do not touch each other, being of one file. What is here is of another one, so that joints without a
bound say it of each pair that could meet: shaft, wrist and jaw with the cannula's link.
"""

import math
from dataclasses import dataclass
from typing import Any

import dvrk_parts as dvrk
import scene_psm as psm
from adf_writer import PASSIVE, Model, vector
from dvrk_parts import servo
from mesh_folder import MeshFolder
from scene_dvrk import SeenFolder

HALF = math.pi / 2
CARRIER, CANNULA = "main insertion link", "pitch end link"
ROLL, WRIST, JAWS = "tool roll link", "tool pitch link", ("tool gripper1 link", "tool gripper2 link")
FREE = {"low": vector((-10, -10, -10)), "high": vector((10, 10, 10))}  # m, rad: more than any of them moves


@dataclass
class Instrument:
    title: str
    wrist: float  # m
    jaw: tuple  # rad: the opening's limits
    finger: Any  # function (height, side) that makes the Link of half the jaw


def half(height):
    return psm.link(0, height, (-HALF, 0.0, 0.0))


def hub(made, height, side):
    low, high = (side * 0.0011, 0.0) if side < 0 else (0.0, side * 0.0011)
    made.rod((low, height, 0.0), (high, height, 0.0), 0.0018, "aluminium", 0.0002, False, 18)
    return made


def layer(side, low, high):
    """Range across the jaw on its side of the middle."""
    return sorted((side * low, side * high))


def prograsp(height, side):
    """Broad, with a window."""
    made = half(height)
    low, high = layer(side, 0.0, 0.0022)
    made.box((-0.0026, height - 0.0045, low), (0.0026, height - 0.0005, high), 0.0005, "steel")
    made.box((-0.0026, height - 0.0165, low), (0.0026, height - 0.0125, high), 0.0005, "steel")
    for u in (-0.0026, 0.0012):
        made.box((u, height - 0.0135, low), (u + 0.0014, height - 0.0035, high), 0.0003, "steel")
    return hub(made, height, side)


def maryland(height, side):
    """Slender and bent aside."""
    made = half(height)
    bend = [(0.0, 0.0), (0.0, -0.0065), (0.0011, -0.0125), (0.0034, -0.0185)]
    for (a, b), width, thick in zip(zip(bend[:-1], bend[1:], strict=True), (36, 29, 21), (19, 15, 11), strict=True):
        start, end = ((u, height + v - (0.0008 if v == 0.0 else 0.0)) for u, v in (a, b))
        made.bar(start, end, width * 1e-4, thick * 1e-4, side * thick * 0.5e-4, "steel")
    return hub(made, height, side)


def scissors(height, side):
    """Blades beside each other, bent aside."""
    made = half(height)
    low, high = layer(side, 0.0, 0.0020)
    at = (-0.0012, 0.0) if side > 0 else (0.0, 0.0012)
    made.box((at[0], height - 0.0075, low), (at[1], height - 0.0005, high), 0.0002, "steel")
    low, high = layer(side, 0.0, 0.0013)
    made.box((at[0] + 0.0006, height - 0.0140, low), (at[1] + 0.0006, height - 0.0070, high), 0.0002, "steel")
    return hub(made, height, side)


WIDE, NARROW = (-math.radians(40), math.radians(80)), (-math.radians(20), math.radians(80))
INSTRUMENTS = {
    "lnd": Instrument("Large needle driver", psm.WRIST, WIDE, None),
    "prograsp": Instrument("ProGrasp forceps", 0.0107, NARROW, prograsp),
    "maryland": Instrument("Maryland forceps", 0.0107, WIDE, maryland),
    "scissors": Instrument("Curved scissors", psm.WRIST, WIDE, scissors),
}


def add_bodies(model, folder, name, instrument):
    height = psm.INSERTION_ZERO - psm.SHAFT - instrument.wrist
    finger = instrument.finger
    makers = {
        ROLL: psm.roll_link,
        WRIST: lambda: psm.wrist_link(instrument.wrist),
        JAWS[0]: (lambda: finger(height, -1.0)) if finger else (lambda: psm.finger(-1.0)),
        JAWS[1]: (lambda: finger(height, 1.0)) if finger else (lambda: psm.finger(1.0)),
    }
    for body, make in makers.items():
        made = make()
        # The shaft is the same of all.
        file = "shaft.obj" if body == ROLL else f"{name}_{body.removeprefix('tool ').removesuffix(' link')}.obj"
        entries = made.entries(*psm.MASSES[body])
        model.body(body, mesh=folder.add(file, made.mesh()), **entries, **{"collision groups": [0]})


def add_joints(model, instrument, holder):
    """`holder`: the PSM, of which the file has no body."""
    zero = psm.INSERTION_ZERO
    height = zero - psm.SHAFT
    yaw = psm.LIMITS["wrist"][1]
    finger = (-yaw + 0.5 * instrument.jaw[0], yaw + 0.5 * instrument.jaw[1])
    limits = {"roll": psm.LIMITS["roll"], "wrist": psm.LIMITS["wrist"], "finger": finger}
    pair = Model("")
    pair.bodies = {**holder.bodies, **model.bodies}

    def joint(parent, child, at, axis, kind="revolute", name=None, **more):
        where = dvrk.place(psm.CENTER, dvrk.TO_LEFT, at)
        pair.joint(name or f"{parent}-{child}", kind, parent, child, where, axis, **more)

    def driven(name):
        return {"limits": limits[name], **servo(psm.EFFORTS[name])}

    joint(CARRIER, ROLL, (0, zero - psm.ROLL_FRAME), (0, 0, -1), **driven("roll"))
    joint(ROLL, WRIST, (0, height), (1, 0, 0), **driven("wrist"))
    for jaw, axis in zip(JAWS, ((0, 1, 0), (0, -1, 0)), strict=True):
        joint(WRIST, jaw, (0, height - instrument.wrist), axis, **driven("finger"))
    for body in (ROLL, WRIST, *JAWS):
        free = {"joint limits": {"linear": FREE, "angular": FREE}}
        joint(CANNULA, body, (0, 0), (0, 0, 1), "six dof", f"{CANNULA}-{body} apart", **PASSIVE, **free)
    for entries in pair.joints.values():
        for name in (CARRIER, CANNULA):
            if entries["parent"] == f"BODY {name}":
                entries["parent"] = f"{model.namespace}BODY {name}"
    model.joints = pair.joints


def build(models):
    folder = MeshFolder(models, "instruments")
    holder = psm.make(SeenFolder(models, "psm"))
    for name, instrument in INSTRUMENTS.items():
        model = Model(
            f"{instrument.title}, an instrument of a PSM (docs/models.md): shaft, wrist and jaw, to be loaded beside\n"
            "robots/psm.yaml in place of its own. Gravity does not act on it.",
            namespace="/ambf/env/psm/",
            meshes="../meshes/instruments",
            gravity=vector((0, 0, 0)),
            **{"ignore inter-collision": True},
        )
        add_bodies(model, folder, name, instrument)
        add_joints(model, instrument, holder)
        model.write(models / "instruments" / f"{name}.yaml")
    folder.close()
