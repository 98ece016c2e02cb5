"""The command line of ambf-cli: its commands with their options, and how each is started.

Long: the options of all commands stand in one place, as `ambf-cli help` shows them.
"""

import argparse
import json
import os
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Sequence
from types import FrameType
from typing import Any

from ambf_tools.cli.arguments import (
    FASTEST_HZ,
    LARGEST,
    MOST_FORCE,
    MOST_LENGTH,
    MOST_SPEED,
    SLOWEST_HZ,
    Parser,
    assignment,
    between,
    count,
    list_of,
    not_negative,
    number_or_word,
    rate,
    within,
)
from ambf_tools.cli.entry import INTERRUPTED

EXIT_CODES = """exit codes: 0 done; 1 refused or failed, the message says why; 2 a mistake on the command line;
3 no ROS master or no simulator; 130 interrupted"""
AFTER_IMPORT = 0.02  # s, until Ctrl-C during an import is tried again


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs ambf-cli; returns its exit code."""
    parser = build_parser()
    _complete(parser)
    options, rest = parser.parse_known_args(arguments)
    if len(rest) == 1 and getattr(options, "yaml", None) == "" and not rest[0].startswith("-"):
        options.yaml = rest.pop()  # behind an option: argparse takes what may be left out for left out there
    if rest:
        parser.error(f"unrecognized arguments: {' '.join(rest)}")
    # Imported here: completion and --help need no ROS.
    from ambf_tools.cli.output import Output

    output = Output(options.json)
    interrupted = _interruptible()
    try:
        options.run(options, output)
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        # ambf-cli echo ... | head
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except Exception as problem:
        if interrupted.is_set():
            return INTERRUPTED  # imports and ROS make other exceptions of it
        return _fail_of(problem, output)
    return 0


def _interruptible() -> threading.Event:
    """Ctrl-C raises KeyboardInterrupt from now on, also where shells ignore it; set once it has."""
    interrupted = threading.Event()

    def interrupt(number: int, frame: FrameType | None) -> None:
        interrupted.set()
        if _imports(frame):
            signal.setitimer(signal.ITIMER_REAL, AFTER_IMPORT)
        else:
            raise KeyboardInterrupt

    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, interrupt)
        signal.signal(signal.SIGALRM, interrupt)
    return interrupted


def _imports(frame: FrameType | None) -> bool:
    """Whether this code runs in an import: there Python may lose an exception, with a traceback, and go on."""
    while frame is not None:
        if frame.f_code.co_filename.startswith("<frozen importlib"):
            return True
        frame = frame.f_back
    return False


def _fail_of(problem: Exception, output: Any) -> int:
    if isinstance(problem, ImportError):
        return _fail(output, f"{problem}. Is the environment set (./dev shell), and is AMBF built?", 3)
    foreseen = isinstance(problem, RuntimeError | LookupError | OSError | ValueError)
    if not foreseen or isinstance(problem, KeyError | IndexError):
        return _fail(output, _unexpected(problem), 1)
    return _fail(output, str(problem), _code_of(problem))


def _unexpected(problem: Exception) -> str:
    """A mistake of ours: one line, with what a report of it needs."""
    place = traceback.extract_tb(problem.__traceback__)[-1]
    text = " ".join(str(problem).split())
    where = f"{os.path.basename(place.filename)}:{place.lineno}"
    return f"unexpected {type(problem).__name__}: {text} ({where}; please report it)"


def _code_of(problem: Exception) -> int:
    from ambf_client.services import SimulatorUnavailable

    return int(getattr(problem, "code", 3 if isinstance(problem, SimulatorUnavailable) else 1))


def _fail(output: Any, message: str, code: int) -> int:
    if output.as_json and not output.reported:
        print(json.dumps({"error": message, "code": code}), flush=True)
    print(f"ambf-cli: {message}", file=sys.stderr, flush=True)
    return code


def _complete(parser: argparse.ArgumentParser) -> None:
    try:
        import argcomplete
    except ImportError:
        return
    argcomplete.autocomplete(parser, always_complete_options="long")


# --- what runs -------------------------------------------------------------------------------------------------------

Runner = Callable[[argparse.Namespace, Any], None]


def _simulated(module: str, name: str) -> Runner:
    """A command that needs a simulator: module.name(simulation, options, output)."""

    def run(options: argparse.Namespace, output: Any) -> None:
        import importlib

        from ambf_tools.cli.simulation import Simulation

        command = getattr(importlib.import_module(f"ambf_tools.cli.{module}"), name)
        command(Simulation(options.ns), options, output)

    return run


def _plain(module: str, name: str) -> Runner:
    """A command that needs none: module.name(options, output)."""

    def run(options: argparse.Namespace, output: Any) -> None:
        import importlib

        getattr(importlib.import_module(f"ambf_tools.{module}"), name)(options, output)

    return run


def _print_completion(options: argparse.Namespace, output: Any) -> None:
    from argcomplete.shell_integration import shellcode

    print(shellcode(["ambf-cli"], shell=options.shell))


# --- what is completed -----------------------------------------------------------------------------------------------


def _names(kind: str) -> Callable[..., list[str]]:
    """Completes the names of a running simulator's objects; quiet when there is none."""

    def complete(prefix: str, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
        from ambf_tools.cli.simulation import Simulation

        try:
            listing = Simulation(getattr(parsed_args, "ns", "")).listing
        except Exception:  # errors in the middle of typing only disturb
            return []
        full = (
            listing.snapshots
            if kind == "snapshots"
            else [each.name for each in getattr(listing, kind) if kind != "objects" or each.topic]
        )
        # Full names where one is begun, else their last parts, which do as well.
        return list(full) if prefix.startswith("/") else sorted({name.rpartition("/")[2] for name in full})

    return complete


def _joint_assignments(prefix: str, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Completes the first half of NAME=VALUE."""
    return [] if "=" in prefix else [f"{name}=" for name in _names("joints")(prefix, parsed_args)]


def _registered(action: argparse.Action, kind: str) -> None:
    """Completes the names of topics or services."""

    def complete(**_: Any) -> list[str]:
        from ambf_client._master import Master

        try:
            publishers, subscribers, services = Master("/ambf_cli").ask("getSystemState")
        except Exception:  # as above
            return []
        return sorted({name for name, _ in (services if kind == "services" else publishers + subscribers)})

    action.completer = complete  # type: ignore[attr-defined]


# --- the words -------------------------------------------------------------------------------------------------------


def build_parser() -> argparse.ArgumentParser:
    """The parser of ambf-cli."""
    common = Parser(add_help=False)
    common.add_argument("--json", action="store_true", default=argparse.SUPPRESS, help="print JSON, for programs")
    common.add_argument(
        "--ns", metavar="PREFIX", default=argparse.SUPPRESS, help="the simulator below this namespace, of several"
    )
    parser = Parser(
        prog="ambf-cli",
        description="Looks at a running AMBF simulation, and changes it.",
        epilog=f"Names may be shortened to any part that fits only one. {EXIT_CODES}",
    )
    parser.set_defaults(json=False, ns="")
    parser.add_argument("--json", action="store_true", help="print JSON, for programs")
    parser.add_argument("--ns", metavar="PREFIX", default="", help="the simulator below this namespace, of several")
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")

    def verb(name: str, run: Runner, text: str) -> argparse.ArgumentParser:
        made = verbs.add_parser(name, parents=[common], help=text, description=text[0].upper() + text[1:] + ".")
        made.set_defaults(run=run)
        return made

    _add_looking(verb)
    _add_acting(verb)
    _add_topics(verb)
    _add_recording(verb)
    return parser


Verb = Callable[[str, Runner, str], argparse.ArgumentParser]


def _completed(action: argparse.Action, kind: str) -> None:
    action.completer = _names(kind)  # type: ignore[attr-defined]


def _add_pose(made: argparse.ArgumentParser, position: str, angles: str) -> None:
    made.add_argument("--pos", nargs=3, type=within(MOST_LENGTH), metavar=("X", "Y", "Z"), help=position)
    made.add_argument("--rpy", nargs=3, type=within(LARGEST), metavar=("R", "P", "Y"), help=angles)


def _add_looking(verb: Verb) -> None:
    made = verb("list", _simulated("look", "list_command"), "what is in the world: objects, joints, models")
    made.add_argument("pattern", nargs="?", default="", help="only names that contain this, or fit it (*, ?)")
    made.add_argument("--kind", default="", help="only objects of this kind: rigid_body, camera, light, ...")
    what = made.add_mutually_exclusive_group()
    what.add_argument("--joints", action="store_true", help="joints, with types and limits")
    what.add_argument("--models", action="store_true", help="loaded files")
    what.add_argument("--snapshots", action="store_true", help="kept states")

    made = verb("info", _simulated("look", "info_command"), "everything about an object, a joint, or the world")
    _completed(made.add_argument("name", nargs="?", default="", help="default: the world"), "objects")

    made = verb("echo", _simulated("look", "echo_command"), "print states as they come")
    _completed(made.add_argument("name", help="an object, World, or rates"), "objects")
    made.add_argument("--field", default="", help="only this one, e.g. pose.position.x or joint_positions.2")
    made.add_argument(
        "-n", "--count", type=count, default=0, help="end after so many; 0 (the default): go on until Ctrl-C"
    )
    made.add_argument("--rate", type=rate, default=0.0, metavar="HZ", help="show at most so many a second; 0: all")

    made = verb("joints", _simulated("look", "joints_command"), "the joints below a body: measured values and limits")
    _completed(made.add_argument("name", help="the body, usually a robot's base"), "objects")
    made.add_argument("--watch", action="store_true", help="until Ctrl-C")

    made = verb("tf", _simulated("frames", "tf_command"), "broadcast where cameras are on /tf, for rviz")
    _completed(
        made.add_argument(
            "names", nargs="*", metavar="NAME", help="these objects, or patterns (*, ?); default: all cameras"
        ),
        "objects",
    )
    hertz = between(SLOWEST_HZ, FASTEST_HZ)
    made.add_argument("--rate", type=hertz, default=50.0, metavar="HZ", help="at most (default: %(default)s)")

    made = verb("rates", _simulated("look", "rates_command"), "real-time factor, rates, loads, threads")
    made.add_argument("--watch", action="store_true", help="until Ctrl-C")

    made = verb(
        "commands", _simulated("look", "commands_command"), "who commands what: ages, periods, what was refused"
    )
    made.add_argument("--watch", action="store_true", help="until Ctrl-C")

    made = verb("devices", _simulated("devices", "devices_command"), "list, watch, set or check input devices")
    made.add_argument(
        "action", nargs="?", default="list", choices=("list", "watch", "set", "forces", "check"),
        help="list [NAME]: what they are, or the values of one that can be changed; watch: rates and faults, until "
        "Ctrl-C; set NAME PARAMETER VALUE..; forces on|off: of all hands; check NAME: asks for motions and buttons, "
        "and with forces on pushes the hand",
    )  # fmt: skip
    made.add_argument("name", nargs="?", default="", help="the device, or any part of its name that fits only one")
    made.add_argument("parameter", nargs="?", default="", help="as list NAME shows it; '-' counts as a space")
    made.add_argument("value", nargs="*", type=number_or_word, help="one number, or three by axis; or a name")
    made.add_argument(
        "--for", dest="seconds", type=not_negative, default=20.0, metavar="SECONDS",
        help="check: how long each answer may take (default: %(default)s)",
    )  # fmt: skip


def _add_acting(verb: Verb) -> None:
    made = verb("set", _simulated("act", "set_command"), "command a body, its joints, a camera or a light")
    _completed(made.add_argument("name"), "objects")
    _add_pose(made, "position, m", "roll, pitch, yaw, rad")
    made.add_argument("--quat", nargs=4, type=within(LARGEST), metavar=("X", "Y", "Z", "W"), help="orientation")
    for flag, unit in (
        ("--force", "N, at the centre of mass, world axes"),
        ("--torque", "N m, world axes"),
    ):
        made.add_argument(flag, nargs=3, type=within(MOST_FORCE), metavar=("X", "Y", "Z"), help=unit)
    for flag, unit in (("--vel", "m/s, world axes"), ("--angvel", "rad/s, world axes")):
        made.add_argument(flag, nargs=3, type=within(MOST_SPEED), metavar=("X", "Y", "Z"), help=unit)
    for flag, unit in (
        ("--joint", "position, rad or m"),
        ("--joint-vel", "rad/s or m/s"),
        ("--joint-effort", "N m or N"),
    ):
        action = made.add_argument(
            flag, nargs="+", action="extend", default=[], type=assignment, metavar="NAME=VALUE", help=unit
        )
        action.completer = _joint_assignments  # type: ignore[attr-defined]
    made.add_argument(
        "--hold", action=argparse.BooleanOptionalAction,
        help="keep position targets of the body and its joints, or of one joint, when their command ends; --no-hold: "
        "let them go",
    )  # fmt: skip
    made.add_argument(
        "--for", dest="seconds", type=not_negative, default=1.0, metavar="SECONDS",
        help="how long; 0: until Ctrl-C (default: %(default)s)",
    )  # fmt: skip

    made = verb("panel", _plain("panels.window", "panel_command"), "open a window with sliders for joints and bodies")
    _completed(made.add_argument("names", nargs="*", metavar="BODY", help="default: all robots"), "objects")

    made = verb("load", _simulated("act", "load_command"), "load ADF or URDF files into the running simulation")
    made.add_argument("files", nargs="+", metavar="FILE")
    made.add_argument("--prefix", default="", help="put before the names of all objects and joints")
    _add_pose(made, "of the model's origin, m", "rad")
    made.add_argument("--check", action="store_true", help="report what is wrong with them, load nothing")

    made = verb("unload", _simulated("act", "unload_command"), "remove everything that came with a file")
    _completed(made.add_argument("model", help="as in ambf-cli list --models"), "models")
    made = verb("save", _simulated("act", "save_command"), "write a model as an ADF file, edited where it changed")
    _completed(made.add_argument("model", help="as in ambf-cli list --models"), "models")
    made.add_argument("file", nargs="?", default="", help="default: the file that the model was read from")
    made.add_argument(
        "--current-pose", action="store_true", help="bodies where they are now; default: as they were read"
    )
    made.add_argument("--overwrite", action="store_true", help="replace a file that exists")
    made.add_argument(
        "--bundle", action="store_true", help="FILE is a folder, for the file, its meshes and their textures"
    )
    made = verb("save-scene", _simulated("act", "save_scene_command"), "write the whole scene as a folder to start")
    made.add_argument("folder", help="gets a launch file, a world file and a file for each model")
    made.add_argument("--current-pose", action="store_true", help="everything as it is now; default: as it was read")
    made.add_argument("--overwrite", action="store_true", help="replace files that exist")
    made.add_argument("--bundle", action="store_true", help="with copies of meshes and their textures")

    made = verb("remove", _simulated("act", "remove_command"), "remove one object or joint")
    _completed(made.add_argument("name"), "objects")

    made = verb("tool", _simulated("act", "tool_command"), "give a PSM another instrument while all runs")
    made.add_argument("arm", help="its namespace or the last part of it: PSM1")
    made.add_argument("tool", help="lnd, prograsp, maryland, scissors, or a tool's name of the kinematics")

    made = verb("step", _simulated("act", "step_command"), "run steps, then let the world wait")
    made.add_argument("n", nargs="?", type=count, default=1, help="how many (default: 1)")
    verb("pause", _simulated("act", "pause_command"), "let the world wait, as step does")
    verb("resume", _simulated("act", "resume_command"), "let the world run by itself again")
    made = verb("reset", _simulated("act", "reset_command"), "put everything back to where it started")
    made.add_argument("--bodies", action="store_true", help="only bodies; time goes on")

    made = verb("snapshot", _simulated("act", "snapshot_command"), "keep the state of the simulation")
    made.add_argument("name", nargs="?", default="", help="default: one is chosen")
    made.add_argument("--file", default="", help="write it to this file, too")
    made = verb("restore", _simulated("act", "restore_command"), "go back to a kept state")
    _completed(made.add_argument("name", nargs="?", default=""), "snapshots")
    made.add_argument("--file", default="", help="a file that snapshot wrote")
    made = verb("forget", _simulated("act", "forget_command"), "let go of a kept state")
    _completed(made.add_argument("name", help="a name that list --snapshots shows"), "snapshots")


def _add_topics(verb: Verb) -> None:
    made = verb("topics", _plain("cli.topics", "topics_command"), "all topics or services, of any program, with types")
    made.add_argument("pattern", nargs="?", default="", help="only names that contain this, or fit it (*, ?)")
    made.add_argument("--services", action="store_true", help="services instead of topics")

    made = verb("publish", _plain("cli.topics", "publish_command"), "publish a message of any type")
    _registered(made.add_argument("topic", help="its name, or an end of it that fits only one"), "topics")
    made.add_argument("yaml", nargs="?", default="", help="fields by name, as YAML; default: all at their defaults")
    made.add_argument("--type", default="", metavar="PACKAGE/TYPE", help="default: what the topic has")
    made.add_argument("--rate", type=rate, default=0.0, metavar="HZ", help="again and again (default: once)")
    made.add_argument(
        "--for",
        dest="seconds",
        type=not_negative,
        default=0.0,
        metavar="SECONDS",
        help="with --rate; 0 (the default): until Ctrl-C",
    )
    made.add_argument("--template", action="store_true", help="print what there is to fill in, publish nothing")

    made = verb("call", _plain("cli.topics", "call_command"), "call a service of any type and print its answer")
    _registered(made.add_argument("service", help="its name, or an end of it that fits only one"), "services")
    made.add_argument("yaml", nargs="?", default="", help="fields of the request by name, as YAML")
    made.add_argument("--template", action="store_true", help="print what there is to fill in, call nothing")


def _add_recording(verb: Verb) -> None:
    made = verb("record", _plain("cli.recording", "record_command"), "record topics into a bag, losing none")
    made.add_argument(
        "topics", nargs="*", metavar="TOPIC", help="names, patterns (* and ?), or re:EXPRESSION; default: all of AMBF"
    )
    made.add_argument("-o", "--output", default="", help="the bag; with --subject or --study: its folder")
    made.add_argument(
        "--every",
        type=between(0, 1_000_000, whole=True),
        default=0,
        metavar="N",
        help="states of every N-th step (1: all of them), and the commands of Step requests; 0 (the default): states "
        "as they are published",
    )
    made.add_argument("--subject", default="", help="who is recorded: becomes part of the name")
    made.add_argument("--study", default="", help="what is recorded: becomes part of the name")
    made.add_argument(
        "--for",
        dest="seconds",
        type=not_negative,
        default=0.0,
        metavar="SECONDS",
        help="how long; 0 (the default): until Ctrl-C",
    )
    made.add_argument(
        "--min-free", type=not_negative, default=1.0, metavar="GIB", help="end when less is free (default: %(default)s)"
    )

    made = verb("bag", _plain("cli.recording", "bag_command"), "look into a bag, check it for gaps, repair it")
    made.add_argument("action", choices=("info", "check", "repair"))
    made.add_argument("file")

    made = verb("inputs", _plain("cli.inputs", "inputs_command"), "what a recording of inputs holds")
    made.add_argument("file")

    made = verb("dataset", _plain("cli.datasets", "dataset_command"), "episodes for learning: record, convert, check")
    made.add_argument("action", choices=("record", "convert", "check", "info"))
    made.add_argument("source", help="record: the id of an environment; convert: a data set, or a bag; else a data set")
    made.add_argument("target", nargs="?", default="", help="record, convert: where to write")
    made.add_argument("--format", choices=("lerobot-2.1", "lerobot-3.0", "robomimic"), default="lerobot-2.1")
    made.add_argument("--episodes", type=count, default=10, help="record (default: %(default)s)")
    made.add_argument("--seed", type=count, default=0, help="record: of the first episode (default: %(default)s)")
    made.add_argument("--policy", choices=("expert", "random"), default="expert", help="record (default: %(default)s)")
    sides = between(8, 4096, whole=True)
    made.add_argument("--pictures", type=sides, nargs=2, metavar=("W", "H"), help="record: also a picture a row")
    made.add_argument("--video", action="store_true", help="record, convert: pictures as videos, with some loss")
    made.add_argument("--open-h", action="store_true", help="check: also Open-H's rules")
    bags = made.add_argument_group(
        "convert of bags", "an episode a bag, and a new one where the world was reset; options may be repeated"
    )
    bags.add_argument("--also", action="append", default=[], metavar="BAG", help="more of them")
    rates = between(1, 1000, whole=True)
    bags.add_argument("--fps", type=rates, help="rows a second (default: 30)")
    for name, what in (("state", "what is observed"), ("command", "what is commanded, the actions")):
        bags.add_argument(f"--{name}", action="append", default=[], metavar="TOPIC:FIELD,..", help=what)
    bags.add_argument("--camera", action="append", default=[], metavar="NAME=TOPIC", help="pictures, rgb8 or JPEG")
    bags.add_argument("--verdict", metavar="TOPIC", help="the State of a task, which says the success")
    bags.add_argument("--success", choices=("yes", "no"), help="instead: of all episodes")
    bags.add_argument("--task", default="", help="in words")
    bags.add_argument("--robot", default="", help="its name")

    made = verb("latency", _plain("latency", "latency_command"), "measure how long commands and states take")
    objects, queues = (list_of(between(1, most, whole=True)) for most in (200, 10_000))
    made.add_argument("--objects", type=objects, default=[1, 10, 30], metavar="N,..", help="default: 1,10,30")
    made.add_argument("--queues", type=queues, default=[1, 10], metavar="N,..", help="default: 1,10")
    made.add_argument(
        "--rate", type=between(1.0, 1e4), default=1000.0, metavar="HZ", help="of commands (default: 1000)"
    )
    made.add_argument(
        "--for", dest="seconds", type=not_negative, default=5.0, metavar="SECONDS", help="each (default: %(default)s)"
    )
    made.add_argument("--png", default="", metavar="FILE", help="draw histograms into this file")

    made = verb("completion", _print_completion, "print what makes your shell complete ambf-cli")
    made.add_argument("shell", nargs="?", default="bash", choices=("bash", "zsh", "fish"))
