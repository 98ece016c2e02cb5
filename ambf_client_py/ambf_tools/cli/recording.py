"""Commands about bags: record, bag."""

import argparse
import contextlib
import signal
import time
from pathlib import Path
from typing import Any

from ambf_tools.cli.output import Output, number, table
from ambf_tools.cli.simulation import CommandError
from ambf_tools.progress import bar
from ambf_tools.record import GIBIBYTE, Recorder, RecordingError, Status, bag_name, readable_bytes, repair
from ambf_tools.recording.topic_sources import is_pattern, matches

NOT_ASKED_FOR = "Not asked for: states were recorded at the rates of their topics; record --every 1 asks for each step."
EVERYTHING = ["/*/State", "/*/Command", "/*/Rates", "/*/StepCommands", "/*/Mapping", "/*/DeviceRates"]


def record_command(options: argparse.Namespace, output: Output) -> None:
    """Records until Ctrl-C, or --for is over."""
    if options.subject or options.study:
        path = Path(options.output or ".") / bag_name(options.subject or "nobody", options.study or "trial")
    else:
        path = Path(options.output or time.strftime("ambf_%Y-%m-%d-%H-%M-%S.bag"))
    # One folder is made for a study; a name with a typing error is none.
    folder = path.expanduser().absolute().parent
    if not (folder.parent if options.subject or options.study else folder).is_dir():
        raise CommandError(f"there is no folder {folder}")
    try:
        recorder = Recorder(
            path,
            options.topics or EVERYTHING,
            every=options.every,
            min_free_bytes=int(options.min_free * GIBIBYTE),
            duration=options.seconds,
            report_missing=False,
        )
        recorder.start()
    except (RecordingError, ValueError, OSError) as problem:
        raise CommandError(str(problem)) from None
    output.note(f"recording into {recorder.path}" + ("" if options.seconds else "; Ctrl-C ends it"))
    status = _watch(recorder, options.seconds, output)
    missed = [
        name
        for name in status.missing
        if name in options.topics
        and is_pattern(name)
        and not any(matches(topic, [], [name]) for topic in status.topics)
    ]
    silent = [topic for topic, (count, _) in sorted(status.topics.items()) if not count]
    output.result(
        {"path": str(recorder.path), **vars(status)},
        [
            f"{recorder.path}: {status.messages} messages of {_recorded(status)} topics in {status.seconds:.1f} s, "
            f"{readable_bytes(status.bytes)}, {status.lost} lost; {status.reason}",
            *(f"  {topic}: {why}" for topic, why in sorted(status.failures.items())),
            *([f"  on which nobody sent anything: {', '.join(silent)}"] if silent else []),
            *(f"  no topic fits {pattern}" for pattern in missed),
        ],
    )
    if not status.complete or status.lost or status.cut_short:
        failed = "the bag is not complete" if not status.complete else "messages were lost" if status.lost else ""
        raise CommandError(failed or f"the recording was cut short: {status.reason}")


def _recorded(status: Status) -> int:
    return sum(1 for count, _ in status.topics.values() if count)


def _watch(recorder: Recorder, seconds: float, output: Output) -> Status:
    # SIGTERM, too, shall leave a complete bag and a report; so shall SIGINT where a script runs this in the background:
    # shells switch it off there.
    ends = (signal.SIGINT, signal.SIGTERM)
    previous = [signal.signal(end, signal.default_int_handler) for end in ends]
    layout = "{desc} {elapsed}" if not seconds else "{desc} {bar} {elapsed}<{remaining}"
    with (
        contextlib.suppress(KeyboardInterrupt),
        bar(seconds or None, not output.as_json, bar_format=layout) as progress,
    ):
        while not recorder.wait(0.25):
            now = recorder.status
            progress.set_description_str(
                f"{now.messages} messages of {_recorded(now)} topics, {readable_bytes(now.bytes)}, {now.lost} lost"
            )
            progress.n = min(now.seconds, seconds) if seconds else now.seconds
            progress.refresh()
    for end, handler in zip(ends, previous, strict=True):
        signal.signal(end, handler)
    return recorder.stop()


def bag_command(options: argparse.Namespace, output: Output) -> None:
    """Looks into a bag, checks it for gaps, or repairs it."""
    from ambf_tools import read_bag

    if options.action == "repair":
        _repair(options.file, output)
        return
    try:
        with read_bag.open(options.file) as bag:
            if options.action == "info":
                rows = [(topic.name, topic.type, topic.messages) for topic in bag.topics.values()]
                seconds = bag.end - bag.start
                data = {"topics": list(bag.topics.values()), "start": bag.start, "seconds": seconds}
                output.result(data, [*table(["topic", "type", "messages"], rows), "", f"{number(seconds, 2)} s"])
                return
            found = bag.continuity()
    except read_bag.BagError as problem:
        raise CommandError(str(problem)) from None
    head = ["topic", "messages", "lost", "not asked for", "restarts", "steps a message", "largest"]
    counts = [
        (n, c.messages, c.lost, c.not_asked_for, c.restarts, c.typical_stride, c.largest_stride)
        for n, c in found.items()
    ]
    lines = table(head, counts)
    if any(c.not_asked_for and not c.every for c in found.values()):
        lines += ["", NOT_ASKED_FOR]
    output.result(found, lines)
    if any(topic.lost for topic in found.values()):
        raise CommandError("messages are missing")


def _repair(file: str, output: Output) -> None:
    import rosbag

    if Path(file).exists() and not Path(file).is_file():
        raise CommandError(f"{file} is no bag: it is no file")

    last = 0
    with bar(None, not output.as_json, unit="B", unit_scale=True) as progress:

        def show(done: int, size: int) -> None:
            nonlocal last
            progress.total = size
            progress.update(done - last)
            last = done

        try:
            path: Any = repair(file, show)
        except (OSError, rosbag.ROSBagException) as problem:
            raise CommandError(f"{file} cannot be repaired: {problem}") from None
    output.result({"path": str(path)}, f"{path} is complete")
