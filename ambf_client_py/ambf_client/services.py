"""The simulator's services: loading and removing at run time, lists, snapshots."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import rospy
from geometry_msgs.msg import Vector3
from ros_abstraction_layer._interrupt import raise_if_interrupted

from . import _numbers
from ._messages import Message, srv
from .handle import Handle

Names = list[str]  # inside the class, list is a method
_SEVERITIES = {0: "information", 1: "warning", 2: "error"}


@dataclass(frozen=True)
class Finding:
    """Something the simulator found in its input, with everything needed to mend it."""

    severity: str  # "information", "warning" or "error"
    file: str
    line: int  # 1-based; 0: unknown
    column: int
    block: str
    key: str
    message: str
    hint: str

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line or "", self.column or "") if part)
        where = " ".join(part for part in (self.block, self.key) if part)
        parts = [part for part in (place, where, f"{self.severity}: {self.message}", self.hint) if part]
        return "; ".join(parts)


class SimulatorUnavailable(ConnectionError):
    """No simulator answers; whether the request was carried out is not known."""


class RequestRefused(RuntimeError):
    """The simulator did not do what was asked, and says why. findings: everything it found."""

    def __init__(self, message: str, findings: list[Finding]) -> None:
        super().__init__("\n  ".join([message, *map(str, findings)]))
        self.findings = findings


@dataclass(frozen=True)
class Loaded:
    """What came with a file."""

    model: str  # what unload takes; empty after check_only
    objects: list[str]  # full names
    joints: list[str]
    findings: list[Finding]


@dataclass(frozen=True)
class Model:
    """One loaded file."""

    name: str
    path: str
    objects: list[str]
    joints: list[str]


@dataclass(frozen=True)
class ObjectInfo:
    """One object of the world. topic: its topics without /State; empty: it has none."""

    name: str
    kind: str
    model: str
    parent: str
    topic: str


@dataclass(frozen=True)
class JointInfo:
    """One joint of the world. limits: (lower, upper) in rad or m; None: it has none."""

    name: str
    type: str
    model: str
    parent: str
    child: str
    limits: tuple[float, float] | None


@dataclass(frozen=True)
class Listing:
    """What is in the world."""

    structure_version: int
    models: list[Model]
    objects: list[ObjectInfo]
    joints: list[JointInfo]
    snapshots: list[str]


@dataclass(frozen=True)
class Kept:
    """A kept state of the simulation. size: bytes; 0 for one that was restored."""

    name: str
    sim_step: int
    sim_time: float  # s
    size: int


@dataclass(frozen=True)
class Saved:
    """A model that was written as a file, or a scene: then its launch file. size: bytes; message: what was done."""

    path: str
    size: int
    findings: list[Finding]
    message: str = ""


@dataclass(frozen=True)
class StepResult:
    """The step at which the world now waits."""

    sim_step: int
    sim_time: float  # s, double precision


ModelId = str | Model | Loaded  # a model's name, or what list or load returned
ThingId = str | ObjectInfo | JointInfo | Handle  # an object's or joint's name, its entry in a list, an object's handle


class Services:
    """The services of one world.

    All raise RequestRefused where the simulator says no, SimulatorUnavailable where none answers.
    """

    def __init__(self, world_topic: str) -> None:
        self._world = world_topic

    def load(
        self, path: str = "", *, text: str = "", name_prefix: str = "", pose: Any = None, check_only: bool = False
    ) -> Loaded:
        """Loads a model: an ADF or URDF file on the simulator's machine, or ADF text.

        name_prefix is put before the whole name of every object and joint, e.g. "/left". pose: of the model's origin in
        the world (as for set_pose; m, rad). check_only: reports, loads nothing.
        """
        request = srv.LoadRequest(path=os.fsdecode(path), check_only=bool(check_only))
        request.text, request.name_prefix = _text(text, "load"), _text(name_prefix, "load")
        if pose is not None:
            (p, q) = _numbers.pose(pose, "load")
            request.pose.position.x, request.pose.position.y, request.pose.position.z = p
            o = request.pose.orientation
            o.x, o.y, o.z, o.w = q
        answer = self.call("Load", srv.Load, request)
        return Loaded(answer.model, list(answer.objects), list(answer.joints), _findings(answer))

    def unload(self, model: ModelId) -> Names:
        """Removes everything that came with a model; returns the names of what was removed."""
        request = srv.UnloadRequest(model=_model_name(model, "unload"))
        return list(self.call("Unload", srv.Unload, request).removed)

    def save(
        self,
        model: ModelId,
        path: str = "",
        *,
        current_pose: bool = False,
        overwrite: bool = False,
        bundle: bool = False,
    ) -> Saved:
        """Writes a model as an ADF file of the simulator's machine: the text it was read from, edited where it changed.

        path: empty for the file that the model was read from. current_pose: with bodies where they are now in the
        world, else as they were read. overwrite: a file that exists is replaced. bundle: path is a folder, which gets
        the file and copies of its meshes and their textures, so that it can be moved anywhere.
        """
        request = srv.SaveRequest(model=_model_name(model, "save"), path=os.fsdecode(path))
        if bundle and not request.path:
            raise ValueError("save(bundle=True) needs a folder as path")
        if bundle:
            request.path = os.path.join(request.path, "")
        request.current_pose, request.overwrite = bool(current_pose), bool(overwrite)
        answer = self.call("Save", srv.Save, request)
        return Saved(answer.path, int(answer.size), _findings(answer), answer.message)

    def save_scene(
        self,
        folder: str | os.PathLike[str],
        *,
        current_pose: bool = False,
        overwrite: bool = False,
        bundle: bool = False,
    ) -> Saved:
        """Writes the whole scene as a folder of the simulator's machine: a launch file, a world file, a file a model.

        The simulator starts with it as the answer's `message` says. current_pose: bodies, cameras, lights and values
        that were changed, as they are now. bundle: with copies of meshes and their textures.
        """
        request = srv.SaveRequest(model="", path=os.fsdecode(folder).rstrip("/"))
        if not request.path:
            raise ValueError("save_scene needs a folder")
        if bundle:
            request.path = os.path.join(request.path, "")
        request.current_pose, request.overwrite = bool(current_pose), bool(overwrite)
        answer = self.call("Save", srv.Save, request)
        return Saved(answer.path, int(answer.size), _findings(answer), answer.message)

    def remove(self, name: ThingId) -> Names:
        """Removes one object or joint, and what cannot stay without it; returns the names of what was removed."""
        request = srv.RemoveRequest(
            name=_text(self.name_of(name), "remove", "a handle or an object or joint of list()")
        )
        return list(self.call("Remove", srv.Remove, request).removed)

    def name_of(self, thing: ThingId) -> str:
        """The full name of what a handle or an entry of list() stands for; a name as it is."""
        if isinstance(thing, Handle):
            topic = thing._topic
            return next((each.name for each in self.list().objects if each.topic == topic), topic)
        return thing.name if isinstance(thing, ObjectInfo | JointInfo) else thing

    def list(self, model: ModelId = "") -> Listing:
        """What is in the world, or only what came with one model."""
        answer = self.call("List", srv.List, srv.ListRequest(model=_model_name(model, "list")))
        return Listing(
            int(answer.structure_version),
            [Model(m.name, m.path, [*m.objects], [*m.joints]) for m in answer.models],
            [ObjectInfo(o.name, o.kind, o.model, o.parent, o.topic) for o in answer.objects],
            [
                JointInfo(j.name, j.type, j.model, j.parent, j.child, (j.lower, j.upper) if j.limited else None)
                for j in answer.joints
            ],
            [*answer.snapshots],
        )

    def snapshot(self, name: str = "", path: str = "") -> Kept:
        """Keeps the whole state under a name (one is chosen if empty) and, with path, in a file of the simulator's."""
        request = srv.SnapshotRequest(name=_text(name, "snapshot"), path=os.fsdecode(path))
        answer = self.call("Snapshot", srv.Snapshot, request)
        return Kept(answer.name, answer.sim_step, answer.sim_time, answer.size)

    def restore(self, name: str | Kept = "", path: str = "") -> Kept:
        """Puts the simulation back into a kept state: by its name, or from a file."""
        name = _text(name.name if isinstance(name, Kept) else name, "restore", "what snapshot returned")
        answer = self.call("Restore", srv.Restore, srv.RestoreRequest(name=name, path=os.fsdecode(path)))
        return Kept(name, answer.sim_step, answer.sim_time, 0)

    def forget(self, name: str | Kept) -> None:
        """Lets go of a kept state; its file, if it has one, stays."""
        name = _text(name.name if isinstance(name, Kept) else name, "forget", "what snapshot returned")
        self.call("Forget", srv.Forget, srv.ForgetRequest(name=name))

    def hold(self, names: Names, hold: bool) -> None:
        """Whether position targets of these bodies and joints stay in force when their commands end."""
        self.call("Hold", srv.Hold, srv.HoldRequest(names=names, hold=hold))

    def tune(self, changes: Sequence[tuple[str, str, tuple[float, float, float]]]) -> None:
        """Sets parameters of bodies and joints by name, all or none; of the world (an empty name) "gravity"."""
        request = srv.TuneRequest()
        for name, parameter, (x, y, z) in changes:
            request.names.append(_text(name, "tune"))
            request.parameters.append(_text(parameter, "tune"))
            request.values.append(Vector3(x, y, z))
        self.call("Tune", srv.Tune, request)

    def call(self, service: str, kind: Any, request: Message) -> Message:
        """The answer to a request, if it says success. service: its name below the world's."""
        proxy = rospy.ServiceProxy(f"{self._world}/{service}", kind)
        try:
            answer = proxy(request)
        except (rospy.ServiceException, OSError) as error:
            raise_if_interrupted(error)
            raise SimulatorUnavailable(f"{proxy.resolved_name}: {error}") from error
        return checked(answer, service)


class Tuning:
    """What World inherits: values that may change while it runs. They act from its next step on, until its reset."""

    _services: Services

    def set_parameter(self, name: ThingId, parameter: str, value: float | Sequence[float]) -> None:
        """Sets friction, damping or a gain of a body or joint: one number, or x, y, z of what is per axis.

        Parameters: "friction", "rolling friction", "restitution", "linear damping", "angular damping"; of a body's
        controller "linear P", "angular I", ..; of a joint "P", "I", "D", "damping" (docs/panel.md). Raises
        RequestRefused for others, and for values that no file may have.
        """
        each = np.broadcast_to(np.asarray(value, dtype=float), 3)
        self._services.tune(
            [(self._services.name_of(name), parameter, _numbers.triple(each, None, None, "set_parameter"))]
        )

    def set_gravity(self, gravity: Sequence[float]) -> None:
        """m/s2, world axes; bodies with a gravity of their own keep it."""
        self._services.tune([("", "gravity", _numbers.triple(gravity, None, None, "set_gravity"))])


def checked(answer: Message, what: str) -> Message:
    """The answer, if it says success."""
    if not answer.success:
        findings = _findings(answer) if hasattr(answer, "diagnostics") else []
        raise RequestRefused(f"{what}: {answer.message or 'refused'}", findings)
    return answer


def _model_name(model: Any, what: str) -> str:
    if isinstance(model, Loaded):
        model = model.model
    elif isinstance(model, Model):
        model = model.name
    return _text(model, what, "what load or list().models returned")


def _text(value: Any, what: str, else_: str = "") -> str:
    if not isinstance(value, str):
        raise TypeError(f"{what} takes text{' or ' + else_ if else_ else ''}, not {value!r}")
    return value


def _findings(answer: Message) -> list[Finding]:
    def read(d: Message) -> Finding:
        severity = _SEVERITIES.get(d.severity, "error")
        return Finding(severity, d.file, d.line, d.column, d.block, d.key, d.message, d.hint)

    return [read(d) for d in answer.diagnostics]
