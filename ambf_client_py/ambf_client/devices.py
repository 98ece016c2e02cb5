"""Input devices: what they are, and what can be changed while they run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from . import _numbers
from ._messages import Message, srv
from .services import Services

Triple = tuple[float, float, float]

# Parameters whose numbers have names, from 0.
WORDS = {
    "mode": (
        "clutch", "jaw", "linear stiffness", "angular stiffness", "linear damping", "angular damping", "haptic linear",
        "haptic angular",
    ),
    "rotation reference": ("camera", "world"),
    "scheme": ("as in the files", "siso", "siao", "aiso", "aiao", "sino", "aino"),
}  # fmt: skip


@dataclass(frozen=True)
class DeviceParameter:
    """A value of a device that can be changed. value: one number, or three by axis."""

    name: str
    unit: str
    value: float | Triple
    min: float
    max: float


@dataclass(frozen=True)
class Device:
    """One input device. topic: its topics without /State, /Command and /Mapping."""

    name: str
    hardware_name: str
    driver: str  # type of the driver; empty: none answers to the hardware name
    topic: str
    effector: str  # full name of the body that it moves, or of the root link that it waits for
    cameras: list[str]  # full names; the first is its frame of reference
    color: Triple  # 0 .. 1
    orientation: bool  # six degrees of freedom, else three
    force: bool  # the hardware exerts forces
    torque: bool
    gripper: bool
    buttons: int  # number of them
    rate: float  # Hz, of its thread
    max_force: float  # N, of the hardware
    message: str  # why it does not work now, and what to set; empty: it does
    parameters: dict[str, DeviceParameter]


Devices = list[Device]  # inside the class, list is a method


class DeviceServices:
    """The services of one world's input devices. Raise as Services does."""

    def __init__(self, services: Services) -> None:
        self._services = services

    def list(self) -> Devices:
        """All of them, in the order of -i."""
        return [_device(each) for each in self._ask().devices]

    def forces(self) -> bool:
        """Whether hands feel forces."""
        return bool(self._ask().forces)

    def set(self, name: str, parameter: str, value: float | str | Sequence[float]) -> None:
        """Changes a value of the device from its next cycle on. value: numbers, or a word of WORDS."""
        if isinstance(value, str):
            value = number_of(parameter, value)
        numbers = [value] if isinstance(value, int | float) else list(value)
        request = srv.SetDeviceRequest(device=name, parameter=parameter)
        request.value = [_numbers.number(each, "set_device") for each in numbers]
        self._services.call("SetDevice", srv.SetDevice, request)

    def set_forces(self, on: bool) -> None:
        """Switches the forces of all hands on or off."""
        request = srv.SetDeviceRequest(parameter="forces", value=[1.0 if on else 0.0])
        self._services.call("SetDevice", srv.SetDevice, request)

    def _ask(self) -> Message:
        return self._services.call("Devices", srv.Devices, srv.DevicesRequest())


def number_of(parameter: str, word: str) -> float:
    """The number that a word of WORDS stands for. Raises ValueError."""
    words = WORDS.get(parameter, ())
    if word not in words:
        known = f"one of: {', '.join(words)}" if words else "a number"
        raise ValueError(f"'{word}' is no {parameter}: that is {known}")
    return float(words.index(word))


def _device(info: Message) -> Device:
    parameters = {}
    for each in info.parameters:
        v = each.value
        value = (v.x, v.y, v.z) if each.by_axis else v.x
        parameters[each.name] = DeviceParameter(each.name, each.unit, value, each.min, each.max)
    red, green, blue = info.color
    return Device(
        info.name, info.hardware_name, info.driver, info.topic, info.effector, [*info.cameras], (red, green, blue),
        info.orientation, info.force, info.torque, info.gripper, info.buttons, info.rate, info.max_force, info.message,
        parameters,
    )  # fmt: skip
