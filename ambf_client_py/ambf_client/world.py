"""The world: its time, stepping by a client, resets, and what is in it."""

from __future__ import annotations

import numbers
import os
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import rospy
from std_msgs.msg import Empty

from ._generations import takes_ral
from ._messages import Message, msg, stamp_of
from ._removal import take_away
from ._stepping import Stepper
from .base_object import BaseObject
from .devices import Device, DeviceServices
from .handle import Gate, Handle
from .kinds import register_handle
from .services import Kept, Listing, Loaded, ModelId, Saved, Services, SimulatorUnavailable, StepResult, ThingId, Tuning
from .success import SuccessWatch

Names = list[str]  # inside the class, list is a method
Devices = list[Device]
Topics = list[tuple[str, str, bool]]
_MOST_SKIPS = 100  # as the original
_MOST_STEPS = 2**32 - 1  # of one call: ambf_msgs/Step counts in 32 bits
_RESET_TIME = 10.0  # s; a loaded machine may need some of them


@register_handle
class World(Handle, Tuning):
    """The simulated world.

    Two ways to drive it step by step: step(), which returns when its steps are done and all handles show them; and the
    original's, enable_throttling() and then update() for each n_skip_steps steps.
    """

    object_type = "WORLD"
    state_type = msg.WorldState
    command_type = msg.WorldCmd
    command_queue = None  # a script's last words release the world

    @takes_ral
    def __init__(self, a_name: str) -> None:
        """a_name: the world's topics without /State."""
        super().__init__(a_name, 2.0)
        self._reset_pub: Any = None
        self._reset_bodies_pub: Any = None
        self._services = Services(a_name)
        self._success = SuccessWatch(a_name)
        self._devices = DeviceServices(self._services)
        self._handles: Callable[[], Sequence[BaseObject]] = tuple
        self._resolve: Callable[[Any], BaseObject] = _not_resolved
        self._changed: Callable[[Names, Names], None] = _nothing
        self._stepper = Stepper(self, self._gate, self._services)

    def _serve(
        self,
        gate: Gate,
        handles: Callable[[], Sequence[BaseObject]],
        resolve: Callable[[Any], BaseObject],
        changed: Callable[[Names, Names], None],
    ) -> None:
        """Connects the world with its client."""
        self._gate = gate
        self._handles, self._resolve, self._changed = handles, resolve, changed
        self._stepper = Stepper(self, gate, self._services)

    # --- stepping --------------------------------------------------------------------------------------------------

    def step(self, n: int = 1, commands: Mapping[Any, Message] | None = None, *, only: bool = False) -> StepResult:
        """Runs n steps and returns when they are done; all handles got from the client then show that very step.

        From the first call on the world waits for the next; release() lets it run again. Meanwhile setters do not send:
        what they set goes with the next step, and holds until it is changed or cleared. commands: {handle or name:
        message}, set before the steps (see set_command). n = 0 runs nothing and shows the present state. only: no other
        commands go with these steps, and `commands` hold as the simulator's watchdog says; so requests of a bag are
        repeated exactly (read_bag's step_commands()).

        Raises RequestRefused if the simulator refuses (nothing is run then), SimulatorUnavailable if it ends meanwhile.
        """
        if not _is_integer(n) or not 0 <= n <= _MOST_STEPS:
            raise ValueError(f"the number of steps must be an integer from 0 to {_MOST_STEPS}, not {n!r}")
        resolved = {self._resolve(name): command for name, command in (commands or {}).items()}
        return self._stepper.step(int(n), resolved, self._handles(), only)

    def is_stepping(self) -> bool:
        """Whether the world waits for this client's next step()."""
        return self._gate.stepping

    def release(self) -> None:
        """Lets the world run by itself again, after step() or throttling."""
        self.enable_throttling(False)
        self.update()

    def enable_throttling(self, data: bool) -> None:
        """Says whether the world shall wait for update(); takes effect with the next update()."""
        with self._command_lock:
            self._cmd.enable_step_throttling = bool(data)

    def set_num_step_skips(self, n: int) -> None:
        """How many steps an update() runs, 1 to 100; 5 by default."""
        if not _is_integer(n) or not 1 <= n <= _MOST_SKIPS:
            raise ValueError(f"n_skip_steps must be an integer from 1 to {_MOST_SKIPS}, not {n!r}")
        with self._command_lock:
            self._cmd.n_skip_steps = int(n)

    def update(self) -> None:
        """Toggles the step clock and sends: a throttled world runs n_skip_steps steps. Does not wait for them."""
        self._stepper.end(self._handles())
        with self._command_lock:
            self._cmd.step_clock = not self._cmd.step_clock
            self.acknowledge_wd()
            self._publish()
            self._gate.waits = False

    def clear_cmd(self) -> None:
        """Forgets throttling; sent with the next update(). The clock keeps its level, or a step would be lost."""
        with self._command_lock:
            self._cmd.enable_step_throttling = False

    def run_publisher(self) -> None:
        """Sends the command as it is, without toggling the clock; forgets throttling if 2 s passed since update()."""
        with self._command_lock:
            if self.is_wd_expired():
                self.console_print(self._name)
                self.clear_cmd()
            self._publish()

    def is_commanded(self) -> bool:
        """Always False: world commands are sent by update() only."""
        return False

    # --- resets ----------------------------------------------------------------------------------------------------

    def reset(self) -> None:
        """Puts everything back to where it started, time and step count too.

        Between steps it returns when that is done, or raises SimulatorUnavailable; otherwise it returns at once.
        """
        self._reset(self._reset_pub, lambda state: int(state.sim_step) == 0)

    def reset_bodies(self) -> None:
        """Puts bodies back to where they started; time goes on. Returns as reset() does."""
        step = self.get_sim_step()
        self._reset(self._reset_bodies_pub, lambda state: int(state.sim_step) == step)

    # --- what is in it ---------------------------------------------------------------------------------------------

    def load(
        self, path: str = "", *, text: str = "", name_prefix: str = "", pose: Any = None, check_only: bool = False
    ) -> Loaded:
        """Loads a model: an ADF or URDF file on the simulator's machine, or ADF text; its objects can be got at once.

        name_prefix is put before the whole name of every object and joint, e.g. "/left". pose: of the model's origin in
        the world (as for set_pose; m, rad). check_only: reports, loads nothing.
        """
        loaded = self._services.load(path, text=text, name_prefix=name_prefix, pose=pose, check_only=check_only)
        if not check_only:
            self._changed(loaded.objects, [])
        return loaded

    def unload(self, model: ModelId) -> Names:
        """Removes everything that came with a model: its name, or what load or list returned; returns the names."""
        return self._taken(lambda: self._services.unload(model))

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
        return self._services.save(model, path, current_pose=current_pose, overwrite=overwrite, bundle=bundle)

    def save_scene(
        self,
        folder: str | os.PathLike[str],
        *,
        current_pose: bool = False,
        overwrite: bool = False,
        bundle: bool = False,
    ) -> Saved:
        """Writes the whole scene as a folder of the simulator's machine: a launch file, a world file, a file a model.

        The answer's `message` is the command that starts it. current_pose: bodies, cameras, lights and values that
        were changed, as they are now; else as they were read. bundle: with copies of meshes and their textures.
        """
        return self._services.save_scene(folder, current_pose=current_pose, overwrite=overwrite, bundle=bundle)

    def remove(self, name: ThingId) -> Names:
        """Removes one object or joint, and what cannot stay without it; returns the names.

        It is named by its name, its handle, or its entry in list().
        """
        return self._taken(lambda: self._services.remove(name))

    def _taken(self, take: Callable[[], Names]) -> Names:
        def take_and_note() -> Names:
            removed = take()
            self._changed([], removed)
            return removed

        return take_away(self._handles(), take_and_note)

    def list(self, model: ModelId = "") -> Listing:
        """What is in the world, or only what came with one model."""
        return self._services.list(model)

    def snapshot(self, name: str = "", path: str = "") -> Kept:
        """Keeps the whole state under a name (one is chosen if empty) and, with path, in a file of the simulator's."""
        return self._services.snapshot(name, path)

    def restore(self, name: str | Kept = "", path: str = "") -> Kept:
        """Puts the simulation back into a kept state, by its name or from a file; what follows repeats bit for bit."""
        kept = self._services.restore(name, path)
        if self._gate.stepping:
            self.step(0)
        return kept

    def forget(self, name: str | Kept) -> None:
        """Lets go of a kept state; the simulator keeps 4096 states, and 256 MB of them."""
        self._services.forget(name)

    def devices(self) -> Devices:
        """The input devices of the simulation, in the order of -i. Raises SimulatorUnavailable where there are none."""
        return self._devices.list()

    def set_device(self, name: str, parameter: str, value: float | str | Sequence[float]) -> None:
        """Changes a value of an input device: a name of Device.parameters; one number, or three by axis (SI units).

        "mode", "rotation reference" and "scheme" take words, too: world.set_device("User1", "scheme", "aiao") sets who
        of two users moves the tool that they share, and who feels it.
        """
        self._devices.set(name, parameter, value)

    def set_device_forces(self, on: bool) -> None:
        """Switches the forces that all hands feel on or off, as -e does at the start."""
        self._devices.set_forces(on)

    def hold(self, *names: ThingId, hold: bool = True) -> None:
        """Keeps the last position targets of bodies and joints when their commands end; hold=False lets them go.

        Otherwise a simulator lets go of what nothing came for in 0.5 s: an arm sinks when its script has ended. Of a
        body: its pose, and joints commanded through it. They are named by names, handles or entries of list(). Holds
        until a reset, which goes back to what the file says (`hold: true`).
        """
        self._services.hold([self._services.name_of(name) for name in names], hold)

    # --- tasks -----------------------------------------------------------------------------------------------------

    def get_success(self, timeout: float = 2.0) -> dict[str, bool]:
        """Each sensor with `success when` by its full name, and whether its task is done; waits for an answer."""
        return self._success.newest(timeout)

    def wait_for_success(self, sensor: Any = None, timeout: float = 10.0) -> bool:
        """Waits until the task of a sensor (name or handle) is done, without one all. False: not within timeout s."""
        name = None if sensor is None else self._resolve(sensor).get_name()
        return self._success.wait(name, timeout)

    # --- inside ----------------------------------------------------------------------------------------------------

    def open_topics(self) -> Topics:
        """The open topics as (name, type, whether this side publishes)."""
        return super().open_topics() + self._success.open_topics()

    def set_active(self) -> None:
        """Connects the handle to its topics. Client.connect does it."""
        if not self._active:
            self._reset_pub = rospy.Publisher(self._topic + "/Command/Reset", Empty, queue_size=1, tcp_nodelay=True)
            self._reset_bodies_pub = rospy.Publisher(
                self._topic + "/Command/Reset/Bodies", Empty, queue_size=1, tcp_nodelay=True
            )
        super().set_active()

    def set_inactive(self) -> None:
        """Closes the handle's topics."""
        self._stepper.close()
        for publisher in (self._reset_pub, self._reset_bodies_pub):
            if publisher is not None:
                publisher.unregister()
        self._reset_pub = self._reset_bodies_pub = None
        self._success.close()
        super().set_inactive()

    def _new_command(self) -> Message:
        command = super()._new_command()
        command.n_skip_steps = 5
        return command

    def _publish(self) -> None:
        # Unlike other commands it is not repeated: it must not be lost on a topic that is just being connected.
        self.wait_for_connection(1.0)
        super()._publish()

    def _release_at_end(self) -> None:
        """The node is ending, perhaps in the middle of a step of another thread: only what cannot wait for anybody."""
        if self._gate.waits and self._pub is not None:
            self._pub.publish(self._new_command())  # which throttles nothing

    def _greeting(self) -> Message:
        return None

    def _reset(self, publisher: Any, is_reset: Callable[[Message], bool]) -> None:
        if publisher is None:
            return
        deadline = time.monotonic() + 1.0
        while publisher.get_num_connections() == 0 and time.monotonic() < deadline:
            time.sleep(0.001)
        count, before = self._received_count, stamp_of(self._state)
        publisher.publish(Empty())
        if self._gate.stepping:
            # States of earlier steps may still arrive; a world that waits makes no others except by what was asked for.
            with self._arrived:
                done = self._arrived.wait_for(
                    lambda: self._received_count > count and stamp_of(self._state) != before and is_reset(self._state),
                    _RESET_TIME,
                )
            if not done:
                raise SimulatorUnavailable(f"{self._topic} was not reset within {_RESET_TIME:g} s")
            self.step(0)


def _is_integer(value: Any) -> bool:
    """Also numpy's; but True is none."""
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)


def _not_resolved(name: Any) -> BaseObject:
    raise LookupError(f"there is no object {name}: the world belongs to no client")


def _nothing(added: Names, removed: Names) -> None:
    pass
