"""Commands about topics and services of any type: topics, publish, call."""

import argparse
import fnmatch
import time
from typing import Any

import rospy
from ambf_client._master import Master, MasterSilent, describe_uri

from ambf_tools.cli.output import Output, table
from ambf_tools.cli.simulation import NO_SIMULATOR, CommandError
from ambf_tools.topics import texts
from ambf_tools.topics.listing import Listing, list_all, message_class, service_class
from ambf_tools.topics.sending import Sender, call


def _everything() -> Listing:
    """What there is; this process is a ROS node afterwards."""
    master = Master("/ambf_cli")
    try:
        master.ask("getPid")
        rospy.init_node("ambf_cli", anonymous=True, disable_signals=True, disable_rosout=True)
        return list_all(master, ignored_node=rospy.get_name())
    except MasterSilent:
        raise CommandError(f"no ROS master answers at {describe_uri(master.uri)}", NO_SIMULATOR) from None


def _named(name: str, among: list[Any], what: str) -> Any:
    """The one of that name, or the only one that ends with it."""
    exact = [each for each in among if each.name == name]
    fits = exact or [each for each in among if each.name.endswith("/" + name.lstrip("/"))]
    if len(fits) > 1:
        raise CommandError(f"'{name}' fits several {what}s: {', '.join(each.name for each in fits[:8])}")
    return fits[0] if fits else None


def topics_command(options: argparse.Namespace, output: Output) -> None:
    """All topics, or all services."""
    listing = _everything()

    def fits(name: str) -> bool:
        return not options.pattern or fnmatch.fnmatchcase(name, options.pattern) or options.pattern in name

    if options.services:
        services = [each for each in listing.services if fits(each.name)]
        output.result(services, table(["service", "type"], [(each.name, each.type or "-") for each in services]))
        return
    topics = [each for each in listing.topics if fits(each.name)]
    rows = [(each.name, each.type or "-", each.publishers, each.listeners) for each in topics]
    output.result(topics, table(["topic", "type", "publishers", "listeners"], rows))


def publish_command(options: argparse.Namespace, output: Output) -> None:
    """Publishes a message, once or at a rate."""
    known = _named(options.topic, _everything().topics, "topic")
    name = known.name if known else rospy.resolve_name(options.topic)
    kind = options.type or (known.type if known else "")
    if not kind:
        raise CommandError(f"the type of {name} is not known: give it by --type", 2)
    if known and known.type and known.type != kind:
        raise CommandError(f"{name} is of type {known.type}, not {kind}")
    found = message_class(kind)
    if options.template:
        text = texts.template(found)
        output.result({"topic": name, "type": kind, "template": text}, text.rstrip())
        return
    message = texts.fill(found, options.yaml)
    sender = Sender(name, found)
    listeners = known.listeners if known else 0
    what = sender.once(message, listeners)
    if options.rate > 0:
        sender.repeat(message, options.rate)
        end = time.monotonic() + options.seconds if options.seconds > 0 else float("inf")
        output.note(
            f"publishing on {name} at {options.rate:g} Hz" + ("" if options.seconds > 0 else "; Ctrl-C ends it")
        )
        try:
            while time.monotonic() < end:
                time.sleep(min(0.1, max(0.0, end - time.monotonic())))
        except KeyboardInterrupt:
            pass
        sender.repeat(None, 0.0)
        what = f"published {sender.count} times"
    time.sleep(0.1)  # closing the topic at once could overtake the message
    output.result({"topic": name, "type": kind, "count": sender.count}, f"{name}: {what}")


def call_command(options: argparse.Namespace, output: Output) -> None:
    """Calls a service and prints its answer, which may be that it refused."""
    known = _named(options.service, _everything().services, "service")
    if known is None:
        raise CommandError(f"there is no service {options.service}; `ambf-cli topics --services` shows all")
    if not known.type:
        raise CommandError(f"the service {known.name} does not answer")
    if options.template:
        text = texts.template(service_class(known.type)._request_class)
        output.result({"service": known.name, "type": known.type, "template": text}, text.rstrip())
        return
    answer = call(known.name, known.type, options.yaml)
    output.result(answer, str(answer).rstrip())
    # As our services have it, and std_srvs/Trigger and SetBool: what is false was not done.
    if getattr(answer, "success", True) is False:
        output.reported = True
        raise CommandError(f"{known.name} refused: {getattr(answer, 'message', '') or 'success is false'}")
