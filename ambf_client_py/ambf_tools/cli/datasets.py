"""The command about data sets for learning: dataset."""

import argparse
from typing import Any

from ambf_tools.cli.output import Output, counted
from ambf_tools.cli.simulation import CommandError


def dataset_command(options: argparse.Namespace, output: Output) -> None:
    """Records, converts, checks or describes a data set."""
    try:
        from ambf_tools import dataset

        if options.action != "convert" or not options.source.endswith(".bag"):
            _refuse_options_of_bags(options)
        _COMMANDS[options.action](options, output, dataset)
    except ImportError as problem:
        raise CommandError(f"{problem}: pip install h5py pandas pyarrow gymnasium") from None
    except (ValueError, OSError) as problem:
        raise CommandError(str(problem)) from None


def _record(options: argparse.Namespace, output: Output, dataset: Any) -> None:
    seen = {"observation": "both", "picture_size": tuple(options.pictures)} if options.pictures else {}
    made = dataset.record(options.source, options.episodes, options.seed, options.policy, **seen)
    dataset.write(made, _target(options), options.format, options.video)
    _describe(made, options.target, output)


def _convert(options: argparse.Namespace, output: Output, dataset: Any) -> None:
    made = _of_bags(options, dataset) if options.source.endswith(".bag") else dataset.read(options.source)
    dataset.write(made, _target(options), options.format, options.video)
    _describe(made, options.target, output)


def _refuse_options_of_bags(options: argparse.Namespace) -> None:
    given = vars(options)
    for name in ("also", "fps", "state", "command", "camera", "verdict", "success", "task", "robot"):
        if given[name]:
            raise CommandError(f"--{name} is for dataset convert of a .bag, not for dataset {options.action} of this")


def _of_bags(options: argparse.Namespace, dataset: Any) -> Any:
    if not options.state or not options.command:
        raise CommandError("dataset convert of a bag takes --state and --command (docs/datasets.md)")
    if (options.verdict is None) == (options.success is None):
        raise CommandError("dataset convert of a bag takes --verdict TOPIC or --success yes|no")
    pictures = dict(each.partition("=")[::2] for each in options.camera)
    if not all(name and topic for name, topic in pictures.items()):
        raise CommandError("--camera takes NAME=TOPIC")
    if len(pictures) < len(options.camera):
        raise CommandError("each --camera NAME=TOPIC wants a NAME of its own")
    return dataset.from_bags(
        [options.source, *options.also],
        options.fps or 30,
        [dataset.Stream.of(each) for each in options.state],
        [dataset.Stream.of(each) for each in options.command],
        pictures,
        options.verdict,
        None if options.success is None else options.success == "yes",
        options.task,
        options.robot,
    )


def _info(options: argparse.Namespace, output: Output, dataset: Any) -> None:
    _describe(dataset.read(options.source), options.source, output)


def _check(options: argparse.Namespace, output: Output, dataset: Any) -> None:
    found = dataset.check(options.source, options.open_h)
    findings = [{"level": each.level, "message": each.message} for each in found]
    output.result({"path": options.source, "findings": findings}, [*map(str, found), counted(len(found), "finding")])
    errors = sum(each.level == "error" for each in found)
    if errors:
        raise CommandError(f"{options.source} has {counted(errors, 'error')}")


def _target(options: argparse.Namespace) -> str:
    if not options.target:
        raise CommandError(f"dataset {options.action} takes where to write")
    return str(options.target)


def _describe(made: Any, path: str, output: Output) -> None:
    successes = sum(episode.success for episode in made.episodes)
    data = {
        "path": path,
        "environment": made.environment,
        "task": made.task,
        "fps": made.fps,
        "episodes": len(made.episodes),
        "successes": successes,
        "frames": made.frames,
        "left_out": made.left_out,
        "features": {name: [kind, list(shape)] for name, (kind, shape) in made.features().items()},
    }
    lines = [
        f"{path}: {counted(len(made.episodes), 'episode')} of {made.source}, {successes} successful,"
        f" {counted(made.frames, 'row')} at {made.fps} a second",
        *(f"  {name}: {kind} {'x'.join(map(str, shape))}" for name, (kind, shape) in made.features().items()),
        *(f"left out: {each}" for each in made.left_out),
    ]
    output.result(data, lines)


_COMMANDS = {"record": _record, "convert": _convert, "check": _check, "info": _info}
