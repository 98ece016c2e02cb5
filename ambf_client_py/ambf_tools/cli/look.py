"""Commands that look: list, info, echo, joints, rates, commands."""

import argparse
import fnmatch
import queue
import time
from typing import Any

from ambf_client.services import JointInfo

from ambf_tools.cli.output import Output, counted, number, plain, table, vector
from ambf_tools.cli.simulation import CommandError, Simulation

MODES = ("real time", "free running", "throttled", "paused")
JOINTED = "rigid_body"


def list_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """What is in the world."""
    everything = simulation.listing

    def fits(name: str) -> bool:
        return not options.pattern or fnmatch.fnmatchcase(name, options.pattern) or options.pattern in name

    objects = [each for each in everything.objects if fits(each.name) and options.kind in ("", each.kind)]
    joints = [each for each in everything.joints if fits(each.name)]
    models = [each for each in everything.models if fits(each.name)]
    if options.joints:
        output.result(joints, table(*_joint_rows(joints)))
    elif options.models:
        loaded = [(each.name, len(each.objects), len(each.joints), each.path) for each in models]
        output.result(models, table(["model", "objects", "joints", "file"], loaded))
    elif options.snapshots:
        output.result(everything.snapshots, everything.snapshots)
    else:
        objects.sort(key=lambda each: (each.kind != JOINTED, each.kind, each.name))
        rows = [(each.name, each.kind, each.model, "" if each.topic else "no topics") for each in objects]
        counts = f"{len(objects)} objects, {len(everything.joints)} joints, {len(everything.models)} models"
        output.result(
            {"world": simulation.world, **{name: getattr(everything, name) for name in ("models", "snapshots")}}
            | {"objects": objects, "joints": joints},
            [*table(["object", "kind", "model", ""], rows), "", f"{counts} in {simulation.world}"],
        )


def _joint_rows(joints: list[Any]) -> tuple[list[str], list[tuple[Any, ...]]]:
    rows = []
    for each in joints:
        lower, upper = each.limits or (float("nan"), float("nan"))
        rows.append((each.name, each.type, lower, upper, each.parent, each.child))
    return ["joint", "type", "lower", "upper", "parent", "child"], rows


def info_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Everything about the world, an object or a joint."""
    if not options.name or options.name == "World":
        rates_command(simulation, argparse.Namespace(watch=False), output)
        return
    found = simulation.object_or_joint(options.name)
    if isinstance(found, JointInfo):
        lines = [found.name, f"  {found.type} joint of {found.model}", f"  {found.parent} -> {found.child}"]
        lines.append(f"  limits  {vector(found.limits)}" if found.limits else "  no limits")
        output.result(found, lines)
        return
    data: dict[str, Any] = {"name": found.name, "kind": found.kind, "model": found.model, "topic": found.topic}
    lines = [found.name, f"  {found.kind} of {found.model}" + (f", mounted on {found.parent}" if found.parent else "")]
    if found.topic:
        state = _state(simulation, found)
        data["state"] = plain(state)
        lines += _state_lines(state)
        lines.append(f"  topics  {found.topic}/State, {found.topic}/Command")
    else:
        lines.append("  no topics (passive)")
    output.result(data, lines)


def _state(simulation: Simulation, found: Any) -> Any:
    return simulation.first(found.topic + "/State", message_class(simulation, found.topic + "/State"))


def message_class(simulation: Simulation, topic: str) -> Any:
    """The message class of a topic, as the master knows it."""
    import roslib.message
    import rospy

    kinds = dict(rospy.get_published_topics())
    kind = roslib.message.get_message_class(kinds.get(topic, ""))
    if kind is None:
        raise CommandError(f"{topic} has no publisher")
    return kind


def _state_lines(state: Any) -> list[str]:
    from ambf_client import rotations

    p, q = state.pose.position, state.pose.orientation
    angles = rotations.rpy_from_quaternion((q.x, q.y, q.z, q.w))
    lines = [f"  position     {vector((p.x, p.y, p.z))} m", f"  orientation  {vector(angles)} rad (roll pitch yaw)"]
    if hasattr(state, "twist"):
        v, w = state.twist.linear, state.twist.angular
        lines += [f"  velocity     {vector((v.x, v.y, v.z))} m/s", f"  turning      {vector((w.x, w.y, w.z))} rad/s"]
    if hasattr(state, "mass"):
        lines.append(f"  mass         {number(state.mass)} kg")
    if hasattr(state, "joint_names") and state.joint_names:
        lines.append(f"  joints       {len(state.joint_names)} below it (ambf-cli joints)")
    lines.append(f"  at           step {state.sim_step}, {number(state.sim_time)} s")
    return lines


def echo_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Prints states as they come."""
    import rospy

    topic = _echo_topic(simulation, options.name)
    arrived: queue.Queue[Any] = queue.Queue(1000)

    def take(message: Any) -> None:
        if not arrived.full():
            arrived.put(message)

    subscriber = rospy.Subscriber(topic, message_class(simulation, topic), take, tcp_nodelay=True)
    shown, next_time = 0, 0.0
    try:
        while options.count <= 0 or shown < options.count:
            try:
                message = arrived.get(timeout=5.0)
            except queue.Empty:
                if shown == 0:
                    raise CommandError(f"{topic} sent nothing within 5 s") from None
                continue
            now = time.monotonic()
            if options.rate > 0 and now < next_time:
                continue
            next_time = now + (1.0 / options.rate if options.rate > 0 else 0.0)
            value = message
            for part in options.field.split(".") if options.field else []:
                try:
                    value = value[int(part)] if part.isdigit() else getattr(value, part)
                except (AttributeError, IndexError, TypeError):
                    raise CommandError(
                        f"{topic} has no field {options.field}; `ambf-cli echo` without --field shows all", 2
                    ) from None
            text = str(value).rstrip() if not isinstance(value, float) else number(value, 6)
            output.result(value, text if options.field else text + "\n---")
            shown += 1
    finally:
        subscriber.unregister()


def _echo_topic(simulation: Simulation, name: str) -> str:
    if name in ("World", "world"):
        return simulation.world + "/State"
    if name == "rates":
        return simulation.world + "/Rates"
    return simulation.object(name).topic + "/State"


def joints_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """The joints below a body, measured."""
    client, body = connect_body(options.name, simulation)
    with client:
        if not hasattr(body, "get_joint_names"):
            raise CommandError(f"{body.get_name()}: {a_kind(body)} has no joints")
        names = body.get_joint_names()
        if not names:
            raise CommandError(f"{body.get_name()} has no joints below it")
        listed = {body.find_joint(each.name)[0]: each for each in simulation.listing.joints}
        while True:
            rows, data = [], []
            values = (body.get_all_joint_pos(), body.get_all_joint_vel(), body.get_all_joint_effort())
            for index, name in enumerate(names):
                info = listed.get(index)
                measured = [column[index] if index < len(column) else float("nan") for column in values]
                lower, upper = info.limits if info and info.limits else (float("nan"), float("nan"))
                kind = info.type if info else ""
                rows.append((index, name, kind, *measured, lower, upper))
                keys = ("index", "name", "type", "position", "velocity", "effort", "lower", "upper")
                data.append(dict(zip(keys, rows[-1], strict=True)))
            head = ["#", "joint", "type", "position", "velocity", "effort", "lower", "upper"]
            lines = table(head, rows)
            if not options.watch:
                output.result(data, lines)
                return
            output.result(data, ["\033[2J\033[H" + body.get_name(), *lines])
            time.sleep(0.2)


def connect_body(name: str, simulation: Simulation) -> tuple[Any, Any]:
    """A client and its handle of a body."""
    from ambf_client import Client

    found = simulation.object(name)
    client = Client("ambf_cli", namespace=simulation.world.rpartition("/")[0])
    client.connect()
    try:
        return client, client.wait_for(found.topic, 5.0)
    except TimeoutError as problem:
        client.clean_up()
        raise CommandError(str(problem)) from None


def a_kind(handle: Any) -> str:
    """What a handle is, e.g. "a camera"."""
    kind = handle.object_type.lower().replace("_", " ")
    return f"an {kind}" if kind[0] in "aeiou" else f"a {kind}"


def rates_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """What the simulation achieves."""
    from ambf_client._messages import msg

    last = -1.0
    while True:
        rates = simulation.first(
            simulation.world + "/Rates", msg.WorldRates, lambda message, last=last: message.wall_time != last
        )
        last = rates.wall_time
        output.result(
            rates, [*(["\033[2J\033[H"] if options.watch and not output.as_json else []), *_rates_lines(rates)]
        )
        if not options.watch:
            return


def _rates_lines(rates: Any) -> list[str]:
    mode = MODES[rates.mode] if rates.mode < len(MODES) else str(rates.mode)
    lines = [
        f"{mode}, step {rates.sim_step}, simulated {number(rates.sim_time)} s, running {number(rates.wall_time)} s",
        f"real-time factor  {rates.real_time_factor:.4f}"
        + (f" of {number(rates.speed_factor)} asked for" if rates.speed_factor != 1 else ""),
        f"steps a second    {number(rates.steps_per_second, 1)} of {number(rates.fixed_time_step * 1e3)} ms; "
        f"{rates.sub_steps_given_up} given up so far",
        f"a step takes      {rates.step_seconds * 1e6:.0f} us ("
        + ", ".join(f"{n} {s * 1e6:.0f}" for n, s in zip(rates.phase_names, rates.phase_seconds, strict=False))
        + ")",
        f"solver            {rates.solver}; {rates.bodies_awake} bodies awake, {rates.bodies_asleep} asleep, "
        f"{rates.contacts} contacts",
        f"frames a second   {number(rates.frames_per_second, 1)}",
        f"communication     {rates.topics} topics, {counted(rates.subscribers, 'subscriber')}, "
        f"{number(rates.states_per_second, 0)} states a second; commands: {rates.accepted_commands} taken, "
        f"{rates.refused_commands} refused",
    ]
    if rates.halted_by:
        lines.insert(1, f"halted by         {rates.halted_by}")
    for name, count in zip(rates.refused_names, rates.refused_counts, strict=False):
        lines.append(f"  refused: {name} {count} times")
    rows = [
        (t.name, t.scheduler, number(t.frequency, 1), f"{100 * t.load:.0f} %")
        + tuple(f"{1e6 * v:.0f}" for v in (t.lateness_p50, t.lateness_p99, t.lateness_max))
        for t in rates.threads
        if t.frequency > 0 or t.priority > 0
    ]
    return [*lines, "", *table(["thread", "scheduler", "turns/s", "load", "late p50 us", "p99", "max"], rows)]


def commands_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """How commands fare, object by object."""
    from ambf_client._messages import msg

    last = None
    while True:
        rates = simulation.first(
            simulation.world + "/CommandRates",
            msg.WorldCommandRates,
            lambda message, last=last: message.header.stamp != last,
        )
        last = rates.header.stamp
        output.result(
            rates, [*(["\033[2J\033[H"] if options.watch and not output.as_json else []), *_commands_lines(rates)]
        )
        if not options.watch:
            return


def _commands_lines(rates: Any) -> list[str]:
    def milliseconds(seconds: float, known: bool = True) -> str:
        return number(1e3 * seconds, 2) if known and seconds >= 0.0 else "-"

    rows = []
    for each in sorted(rates.objects, key=lambda each: each.name):
        periods = (each.period_least, each.period_mean, each.period_most, each.period_deviation)
        rows.append(
            (each.name, each.source if each.received else "-", milliseconds(each.age) if each.in_force else "ended")
            + tuple(milliseconds(each_period, each.periods > 0) for each_period in periods)
            + tuple(milliseconds(delay, each.delays > 0) for delay in (each.delay_mean, each.delay_most))
            + (each.received, each.applied, each.coalesced, each.refused, each.expired)
        )
    head = ["object", "by", "age ms", "period min", "mean", "max", "+-", "to a step mean", "max"]
    head += ["received", "applied", "coalesced", "refused", "expired"]
    return table(head, rows) if rows else ["nothing has been commanded"]
