"""Commands that change something: what is loaded, saved and set, how time goes, states that are kept."""

import argparse
import contextlib
import math
import sys
import time
from pathlib import Path
from typing import Any

from ambf_client.services import Loaded, RequestRefused, SimulatorUnavailable, checked

from ambf_tools.cli.look import MODES, a_kind, connect_body
from ambf_tools.cli.output import Output, counted, number, vector
from ambf_tools.cli.simulation import NO_SIMULATOR, CommandError, Simulation
from ambf_tools.progress import bar

THROTTLED, PAUSED = 2, 3
_STEPS_A_CALL = 100  # so that the progress bar moves and Ctrl-C is heard
# Options of `set`: the handle's method, what it sets.
_CARTESIAN = {
    "pos": ("set_pos", "position"),
    "rpy": ("set_rpy", "orientation"),
    "quat": ("set_rot", "orientation"),
    "force": ("set_force", "force"),
    "torque": ("set_torque", "torque"),
    "vel": ("set_linear_vel", "velocity"),
    "angvel": ("set_angular_vel", "angular velocity"),
}


def set_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Commands a body (or a camera, or a light), for some time, and says where it is then."""
    joints = [*options.joint, *options.joint_vel, *options.joint_effort]
    cartesian = [name for name in _CARTESIAN if getattr(options, name)]
    kinds = [
        group for group in ({"pos", "rpy", "quat"}, {"force", "torque"}, {"vel", "angvel"}) if group & {*cartesian}
    ]
    if not cartesian and not joints:
        if options.hold is not None:
            return _set_hold(simulation, [simulation.object_or_joint(options.name).name], options.hold, output)
        raise CommandError("nothing to set: give --pos, --rpy, --force, --vel, --joint, ... (ambf-cli set --help)", 2)
    if len(kinds) > 1 or (options.rpy and options.quat):
        raise CommandError("one of pose, force and velocity, please: the last one would win", 2)
    if options.quat and math.hypot(*options.quat) < 1e-6:
        raise CommandError("--quat: zeros are no orientation", 2)
    client, handle = connect_body(options.name, simulation)
    with client:
        for setter, what in (_CARTESIAN[name] for name in cartesian):
            if not hasattr(handle, setter):
                raise CommandError(f"{handle.get_name()}: {a_kind(handle)} has no {what}")
        _check_joints(handle, joints)
        if options.hold is not None:
            simulation.services.hold([simulation.object(options.name).name], options.hold)
        end = time.monotonic() + options.seconds if options.seconds > 0 else math.inf
        with contextlib.suppress(KeyboardInterrupt):
            while True:
                try:
                    _apply(handle, options)
                except TypeError as problem:  # of what is moved by others: vehicles, sensors
                    raise CommandError(str(problem)) from None
                left = end - time.monotonic()
                if left <= 0:
                    break
                time.sleep(min(0.02, left))  # also feeds the watchdog of forces
        position, angles = handle.get_pos(), handle.get_rpy()
        where = (position.x, position.y, position.z)
        data: dict[str, Any] = {"name": handle.get_name(), "position": where, "rpy": angles}
        text = f"{handle.get_name()}: position {vector(where)} m, orientation {vector(angles)} rad"
        if joints:
            values = {n: handle.get_joint_pos(n) for n, _ in joints}
            data["joints"] = values
            text += "; " + ", ".join(f"{n} {number(v)}" for n, v in values.items())
        output.result(data, text)


def _apply(handle: Any, options: argparse.Namespace) -> None:
    """Sets what is asked for; a setter sends at once."""
    for name, (setter, _) in _CARTESIAN.items():
        if getattr(options, name):
            getattr(handle, setter)(getattr(options, name))
    for name, setter in (
        ("joint", "set_joint_pos"),
        ("joint_vel", "set_joint_vel"),
        ("joint_effort", "set_joint_effort"),
    ):
        values = dict(getattr(options, name))
        if values:
            getattr(handle, setter)(values)


def _set_hold(simulation: Simulation, names: list[str], hold: bool, output: Output) -> None:
    simulation.services.hold(names, hold)
    what = "keeps its position target when its command ends" if hold else "is let go when its command ends"
    output.result({"names": names, "hold": hold}, [f"{name} {what}" for name in names])


def _check_joints(handle: Any, joints: list[tuple[str, float]]) -> None:
    if not joints:
        return
    if not hasattr(handle, "find_joint"):
        raise CommandError(f"{handle.get_name()}: {a_kind(handle)} has no joints")
    for wanted, _ in joints:
        if handle.find_joint(wanted)[0] is None:
            names = ", ".join(handle.get_joint_names()) or "none"
            raise CommandError(f"{handle.get_name()} has no joint '{wanted}'; it has: {names}")


def load_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Loads files, one after the other; says of each how it went."""
    pose = None
    if options.pos or options.rpy:
        pose = [*(options.pos or (0.0, 0.0, 0.0)), *(options.rpy or (0.0, 0.0, 0.0))]
    results: list[dict[str, Any]] = []
    failures: list[Exception] = []
    for file in options.files:
        path = str(Path(file).expanduser().resolve())
        try:
            loaded = simulation.services.load(path, name_prefix=options.prefix, pose=pose, check_only=options.check)
        except (RequestRefused, SimulatorUnavailable) as problem:
            failures.append(problem)
            results.append({"file": path, "error": str(problem), "findings": getattr(problem, "findings", [])})
            if len(options.files) > 1:
                print(f"ambf-cli: {problem}", file=sys.stderr, flush=True)
            if isinstance(problem, SimulatorUnavailable):
                break  # for the others, too
            continue
        results.append({"file": path, **vars(loaded)})
        if not output.as_json:
            output.result(None, _loaded_lines(file, loaded, options.check))
    if output.as_json:
        output.result(results, [])
    if not failures:
        return
    output.reported = True
    gone = isinstance(failures[-1], SimulatorUnavailable)
    left = len(options.files) - (len(results) - len(failures))
    done = "checked" if options.check else "loaded"
    text = f"{left} of {len(options.files)} files were not {done}" if len(options.files) > 1 else str(failures[0])
    raise CommandError(text, NO_SIMULATOR if gone else 1)


def _loaded_lines(file: str, loaded: Loaded, checked_only: bool) -> list[str]:
    what = f"{counted(len(loaded.objects), 'object')}, {counted(len(loaded.joints), 'joint')}"
    findings = [finding for finding in loaded.findings if finding.severity != "information" or checked_only]
    return [f"{file}: checked" if checked_only else f"{loaded.model}: {what}", *(f"  {each}" for each in findings)]


def unload_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Removes a model."""
    removed = simulation.services.unload(simulation.model(options.model).name)
    output.result({"removed": removed}, f"{len(removed)} objects and joints removed")


def save_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Writes a model as an ADF file."""
    path = str(Path(options.file).expanduser().resolve()) if options.file else ""
    if options.bundle and not path:
        raise CommandError("--bundle needs a folder: ambf-cli save MODEL FOLDER --bundle")
    saved = simulation.services.save(
        simulation.model(options.model).name,
        path,
        current_pose=options.current_pose,
        overwrite=options.overwrite,
        bundle=options.bundle,
    )
    findings = [f"  {finding}" for finding in saved.findings]
    output.result(vars(saved), [f"{saved.path}: {saved.size} bytes", *findings])


def save_scene_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Writes the scene as a folder that starts it again."""
    saved = simulation.services.save_scene(
        str(Path(options.folder).expanduser().resolve()),
        current_pose=options.current_pose,
        overwrite=options.overwrite,
        bundle=options.bundle,
    )
    findings = [f"  {finding}" for finding in saved.findings]
    output.result(vars(saved), [saved.message, *findings])


def remove_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Removes an object or a joint."""
    removed = simulation.services.remove(simulation.object_or_joint(options.name).name)
    output.result({"removed": removed}, [f"removed {each}" for each in removed])


def tool_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Gives a PSM another instrument."""
    from ambf_client import Client
    from ambf_client.instruments import exchange_tool

    client = Client("ambf_cli", namespace=simulation.world.rpartition("/")[0])
    client.connect()
    with client:
        try:
            done = exchange_tool(client, options.arm, options.tool)
        except KeyError as problem:
            raise CommandError(str(problem.args[0])) from None
    data = {
        "instrument": done.instrument,
        "tool": done.arm.tool,
        "namespace": done.namespace,
        "model": done.model,
        "removed": done.removed,
    }
    output.result(data, f"{done.namespace} has {done.instrument} ({done.arm.tool}); {done.model}")


def step_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Runs steps; the world waits afterwards."""
    import rospy

    step = _stepper(simulation)
    left, answer = options.n, None
    shown = not output.as_json and options.n > _STEPS_A_CALL
    with bar(options.n, shown, unit="step") as progress:
        while left > 0 or answer is None:
            count = min(left, _STEPS_A_CALL)
            try:
                answer = checked(step(n=count), "step")
            except (rospy.ServiceException, OSError) as problem:
                raise SimulatorUnavailable(f"{simulation.world}/Step: {problem}") from None
            left -= count
            progress.update(count)
    output.result(
        {"sim_step": answer.sim_step, "sim_time": answer.sim_time},
        f"at step {answer.sim_step}, {answer.sim_time:.6f} s; waiting (ambf-cli resume)",
    )


def _stepper(simulation: Simulation) -> Any:
    import rospy
    from ambf_client._messages import srv

    return rospy.ServiceProxy(f"{simulation.world}/Step", srv.Step, persistent=True)


def pause_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Makes the world wait, as stepping does."""
    options.n = 0
    step_command(simulation, options, output)


def resume_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Lets the world run by itself again."""
    from ambf_client._messages import msg

    before = simulation.first(simulation.world + "/State", msg.WorldState).sim_step
    simulation.send(simulation.world + "/Command", msg.WorldCmd(enable_step_throttling=False, n_skip_steps=1))
    try:
        now = simulation.first(simulation.world + "/State", msg.WorldState, lambda m: m.sim_step > before, 3.0)
    except CommandError:
        rates = simulation.first(simulation.world + "/Rates", msg.WorldRates)
        why = f"it is {MODES[rates.mode]}"
        if rates.halted_by.endswith("diverged"):  # a diverged world counts as paused, too; frozen bodies stop nothing
            why = f"{rates.halted_by}; `ambf-cli reset` puts everything back"
        elif rates.mode == PAUSED:
            why = "it was paused in its window: press space there"
        raise CommandError(f"the world does not run: {why}") from None
    output.result({"sim_step": now.sim_step, "sim_time": now.sim_time}, f"running, at step {now.sim_step}")


def reset_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Puts everything back."""
    from ambf_client._messages import msg
    from std_msgs.msg import Empty

    rates = simulation.world + "/Rates"
    before = simulation.first(rates, msg.WorldRates).epoch
    simulation.send(simulation.world + "/Command/Reset" + ("/Bodies" if options.bodies else ""), Empty())
    after = simulation.first(rates, msg.WorldRates, lambda message: message.epoch != before)
    what = "bodies are back where they started" if options.bodies else "everything is back where it started"
    output.result({"sim_step": after.sim_step, "sim_time": after.sim_time, "epoch": after.epoch}, what)


def snapshot_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Keeps the state."""
    path = str(Path(options.file).expanduser().resolve()) if options.file else ""
    kept = simulation.services.snapshot(options.name, path)
    text = f"kept as {kept.name}: step {kept.sim_step}, {kept.sim_time:.6f} s, {kept.size} bytes"
    output.result({**vars(kept), "file": path}, text + (f" in {path}" if path else ""))


def forget_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Lets go of a kept state."""
    simulation.services.forget(options.name)
    output.result({"name": options.name}, f"{options.name} is forgotten")


def restore_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Goes back to a kept state."""
    if bool(options.name) == bool(options.file):
        kept = ", ".join(simulation.listing.snapshots) or "none"
        raise CommandError(f"restore takes a name or --file; kept: {kept}", 2)
    path = str(Path(options.file).expanduser().resolve()) if options.file else ""
    state = simulation.services.restore(options.name, path)
    output.result(
        {"sim_step": state.sim_step, "sim_time": state.sim_time},
        f"back at step {state.sim_step}, {state.sim_time:.6f} s",
    )
