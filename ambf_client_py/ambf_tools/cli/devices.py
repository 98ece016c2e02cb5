"""Input devices: ambf-cli devices list, watch, set, forces, check."""

import argparse
from typing import Any

from ambf_client.devices import WORDS, Device, DeviceParameter, DeviceServices, number_of
from ambf_client.services import SimulatorUnavailable

from ambf_tools.cli.output import Output, number, table, vector
from ambf_tools.cli.simulation import CommandError, Simulation


def devices_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Does what options.action says."""
    services = DeviceServices(simulation.services)
    try:
        devices = services.list()
    except SimulatorUnavailable:
        raise CommandError("this simulation has no input devices; start it with -n or -i") from None
    if options.action == "list" and not options.name:
        list_devices(devices, services.forces(), output)
    elif options.action == "watch":
        watch_devices(simulation, output)
    elif options.action == "forces":
        if options.name not in ("on", "off"):
            raise CommandError("say `ambf-cli devices forces on` or `off`", 2)
        services.set_forces(options.name == "on")
        output.result({"forces": options.name == "on"}, f"forces of all hands are {options.name}")
    else:
        one_device(simulation, find_device(devices, options.name), services, options, output)


def one_device(
    simulation: Simulation, device: Device, services: DeviceServices, options: argparse.Namespace, output: Output
) -> None:
    """Commands about one device."""
    if options.action == "list":
        show_device(device, output)
    elif options.action == "set":
        parameter = options.parameter.replace("-", " ").replace("_", " ")
        if parameter not in device.parameters:
            raise CommandError(f"there is no parameter '{parameter}'; there are: {', '.join(device.parameters)}", 2)
        if not options.value:
            raise CommandError(f"say a value of {parameter}, or three by axis", 2)
        value = options.value
        if any(isinstance(each, str) for each in value):
            try:
                value = [number_of(parameter, " ".join(map(str, value)))]
            except ValueError as problem:
                raise CommandError(str(problem), 2) from None
        services.set(device.name, parameter, value)
        output.result({"device": device.name, parameter: value}, f"{device.name}: {parameter} is set")
    else:
        from ambf_tools.cli.device_check import check_device

        check_device(simulation, device, services.forces(), options.seconds, output)


def find_device(devices: list[Device], name: str) -> Device:
    """The one of this name, or the only one whose name contains it."""
    if not name:
        raise CommandError(f"say which device: {', '.join(each.name for each in devices)}", 2)
    fits = [each for each in devices if each.name == name] or [
        each for each in devices if name.lower() in each.name.lower()
    ]
    if len(fits) != 1:
        names = ", ".join(each.name for each in fits or devices)
        raise CommandError(f"'{name}' fits {'several devices' if fits else 'none of the devices'}: {names}")
    return fits[0]


def list_devices(devices: list[Device], forces: bool, output: Output) -> None:
    """All of them, a row each."""
    rows = [
        (each.name, each.hardware_name, each.driver or "none", each.rate, each.effector, "".join(each.cameras[:1]))
        for each in devices
    ]
    lines = table(["device", "hardware", "driver", "Hz", "moves", "camera"], rows)
    lines += [f"{each.name}: {each.message}" for each in devices if each.message]
    lines += ["", f"forces are {'on' if forces else 'off'}"]
    output.result({"forces": forces, "devices": devices}, lines)


def show_device(device: Device, output: Output) -> None:
    """One of them, with what can be changed."""

    def value_of(parameter: DeviceParameter) -> str:
        value = parameter.value
        if not isinstance(value, float):
            return vector(value)
        return WORDS[parameter.name][int(value)] if parameter.name in WORDS else number(value)

    offers = [word for word in ("orientation", "force", "torque", "gripper") if getattr(device, word)]
    lines = [
        device.name,
        f"  {device.hardware_name}, driver {device.driver or 'none'}: position {' '.join(offers)}, "
        f"{device.buttons} buttons, {number(device.rate)} Hz",
        f"  moves {device.effector}, seen by {', '.join(device.cameras) or 'no camera'}",
        f"  topics {device.topic}/State, /Command, /Mapping",
        *([f"  {device.message}"] if device.message else []),
        "",
        *table(["parameter", "value", "unit"], [(p.name, value_of(p), p.unit) for p in device.parameters.values()]),
    ]
    output.result(device, lines)


def watch_devices(simulation: Simulation, output: Output) -> None:
    """Rates and faults until Ctrl-C."""
    from ambf_client._messages import msg

    last = None
    while True:
        rates = simulation.first(
            simulation.world + "/DeviceRates",
            msg.WorldDeviceRates,
            lambda message, last=last: message.header.stamp != last,
        )
        last = rates.header.stamp
        output.result(rates, [*([] if output.as_json else ["\033[2J\033[H"]), *rates_lines(rates)])


def rates_lines(rates: Any) -> list[str]:
    """A row a device: over the whole run, times in ms."""

    def times(percentiles: Any) -> tuple[str, str]:
        if percentiles.count == 0:
            return "-", "-"
        return number(1e3 * percentiles.p999, 2), number(1e3 * percentiles.max, 2)

    rows = []
    for each in rates.devices:
        state = each.fault or ("connected" if each.connected else "not connected")
        rows.append(
            (each.name, state, round(each.rate), round(each.sample_rate))
            + times(each.period)
            + times(each.set_point_age)
            + times(each.sample_to_force)
            + (each.slips, each.faults, each.refused_samples)
        )
    head = ["device", "state", "Hz", "samples/s", "period p99.9 ms", "max", "to a step p99.9", "max"]
    head += ["to the force p99.9", "max", "late", "faults", "refused"]
    return [*table(head, rows), "", f"forces are {'on' if rates.forces else 'off'}"]
