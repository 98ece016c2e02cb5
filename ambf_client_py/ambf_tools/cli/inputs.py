"""The command about recordings of inputs: inputs."""

import argparse
import time

from ambf_tools import read_input
from ambf_tools.cli.output import Output, counted, number, table
from ambf_tools.cli.simulation import CommandError


def inputs_command(options: argparse.Namespace, output: Output) -> None:
    """What a recording of inputs holds."""
    try:
        trial = read_input.read(options.file)
    except (read_input.InputError, OSError) as problem:
        raise CommandError(str(problem)) from None
    devices = [
        {
            "name": device.name,
            "hertz": 1.0 / device.period,
            "cycles": len(device.cycles["time"]),
            "samples": len(device.samples["time"]),
            "set_points": len(device.set_points["time"]),
            "obeyed": int((device.set_points["step"] > 0).sum()),
        }
        for device in trial.devices
    ]
    data = {
        "path": trial.path,
        "start": trial.start,
        "seconds": trial.seconds,
        "launch_file": trial.launch_file,
        "device_file": trial.device_file,
        "frames": len(trial.frames["time"]),
        "changes": trial.changes,
        "requests": trial.requests,
        "devices": devices,
        "problem": trial.problem,
    }
    began = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(trial.start))
    requests = ", ".join(f"{name} {count}" for name, count in sorted(trial.requests.items()))
    output.result(
        data,
        [
            f"{trial.path}: {number(trial.seconds, 1)} s from {began}, {counted(len(trial.frames['time']), 'frame')}",
            f"launch file {trial.launch_file}",
            *(f"scene: {what} {name}".rstrip() for what, name in trial.changes),
            f"obeyed besides devices: {requests or 'nothing'}",
            *table(
                ["device", "hertz", "cycles", "samples", "set-points", "obeyed"], [tuple(d.values()) for d in devices]
            ),
            *([f"{trial.problem}"] if trial.problem else []),
        ],
    )
