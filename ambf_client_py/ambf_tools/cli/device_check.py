"""ambf-cli devices check: asks a person for motions and buttons, and says whether the device reports them.

Axes are those of the operator's view: x towards the operator, y to the right, z up.
"""

import math
import queue
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

from ambf_client import rotations
from ambf_client.devices import Device

from ambf_tools.cli.output import Output
from ambf_tools.cli.simulation import CommandError, Simulation

Triple = tuple[float, float, float]

MOTION = 0.03  # m that count as a push
ROLL = 0.35  # rad that count as a roll
SHARE = 0.8  # of the motion that must be along the axis that was asked for
FORCE = 0.5  # N, of the pushes
FELT = 0.4  # N that must have been written to the hand
PUSH_TIME = 1.0  # s
COMMAND_PERIOD = 0.01  # s; a wrench ends 0.1 s after its last message

DIRECTIONS: dict[str, Triple] = {
    "to the right": (0.0, 1.0, 0.0),
    "up": (0.0, 0.0, 1.0),
    "towards you": (1.0, 0.0, 0.0),
}


@dataclass(frozen=True)
class Hand:
    """One sample of the device."""

    position: Triple  # in the operator's view, m
    orientation: tuple[float, float, float, float]
    buttons: int  # bit i: button i
    force: Triple  # written to the hand, N


@dataclass(frozen=True)
class Step:
    """One step of the check. remark: what came instead; empty when it is good."""

    asked: str
    remark: str


class Operator(Protocol):
    """The device, and the person who holds it."""

    def ask(self, text: str) -> None:
        """Says what to do."""

    def sample(self) -> Hand | None:
        """The newest sample; waits for one. None: the time for this answer is over."""

    def begin(self) -> None:
        """The time for the next answer begins now."""

    def push(self, force: Triple) -> Hand | None:
        """Pushes the hand along these axes for a second; the sample at its end."""


def check(operator: Operator, device: Device, forces: bool) -> list[Step]:
    """Goes through all steps."""
    steps = [_motion(operator, name, axis) for name, axis in DIRECTIONS.items()]
    if device.orientation:
        steps.append(_roll(operator))
    steps += [_button(operator, button) for button in range(device.buttons)]
    if forces and device.force:
        steps += [_force(operator, name, axis) for name, axis in DIRECTIONS.items()]
    return steps


def describe(delta: Triple) -> str:
    """A motion by its main axis: "to the left by 3.2 cm"."""
    names = ("away from you", "towards you"), ("to the left", "to the right"), ("down", "up")
    main = max(range(3), key=lambda i: abs(delta[i]))
    return f"{names[main][delta[main] > 0]} by {100 * abs(delta[main]):.1f} cm"


def _answer(operator: Operator, text: str, done: Callable[[Hand, Hand], str | None]) -> Step:
    """Waits until done(first, newest) is no longer None: its remark."""
    operator.ask(text)
    operator.begin()
    first = newest = operator.sample()
    while first is not None and newest is not None:
        remark = done(first, newest)
        if remark is not None:
            return Step(text, remark)
        newest = operator.sample()
    return Step(text, "no sample came" if first is None else "nothing happened in time")


def _motion(operator: Operator, name: str, axis: Triple) -> Step:
    def done(first: Hand, newest: Hand) -> str | None:
        delta = _minus(newest.position, first.position)
        size = math.dist(newest.position, first.position)
        if size < MOTION:
            return None
        return "" if _dot(delta, axis) >= SHARE * size else f"the hand moved {describe(delta)}"

    return _answer(operator, f"push the hand {name}", done)


def _roll(operator: Operator) -> Step:
    def done(first: Hand, newest: Hand) -> str | None:
        x, y, z, w = rotations.multiply(newest.orientation, _conjugate(first.orientation))
        if w < 0.0:
            x, y, z, w = -x, -y, -z, -w
        size = math.sqrt(x * x + y * y + z * z)
        if 2.0 * math.atan2(size, w) < ROLL:
            return None
        # Clockwise, as the operator sees it, is against the axis that points towards him.
        return "" if -x >= SHARE * size else f"the hand turned about {'xyz'[_main((x, y, z))]} of the view"

    return _answer(operator, "roll the hand clockwise", done)


def _button(operator: Operator, button: int) -> Step:
    def done(first: Hand, newest: Hand) -> str | None:
        pressed = newest.buttons & ~first.buttons
        if pressed == 0:
            return None
        return "" if pressed >> button & 1 else f"button {pressed.bit_length() - 1} came"

    return _answer(operator, f"press button {button}", done)


def _force(operator: Operator, name: str, axis: Triple) -> Step:
    text = f"hold the hand loosely: it is pushed {name}"
    operator.ask(text)
    hand = operator.push((FORCE * axis[0], FORCE * axis[1], FORCE * axis[2]))
    if hand is None:
        return Step(text, "no sample came")
    along = _dot(hand.force, axis)
    return Step(text, "" if along >= FELT else f"{along:.2f} N of {FORCE} N were written to the hand")


def _minus(a: Triple, b: Triple) -> Triple:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _dot(a: Triple, b: Triple) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def _main(v: Triple) -> int:
    return max(range(3), key=lambda i: abs(v[i]))


def _conjugate(q: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    return -q[0], -q[1], -q[2], q[3]


class RosOperator:
    """The device's topics, and a terminal."""

    def __init__(self, device: Device, seconds: float, output: Output) -> None:
        import rospy
        from ambf_client._messages import msg

        self._seconds, self._output = seconds, output
        self._samples: queue.Queue[Any] = queue.Queue(1000)
        self._end = 0.0
        self._command = msg.ObjectCmd
        self._subscriber = rospy.Subscriber(device.topic + "/Mapping", msg.DeviceMapping, self._take, tcp_nodelay=True)
        self._publisher = rospy.Publisher(device.topic + "/Command", msg.ObjectCmd, queue_size=10, tcp_nodelay=True)

    def close(self) -> None:
        """Ends its topics."""
        self._subscriber.unregister()
        self._publisher.unregister()

    def ask(self, text: str) -> None:
        """Says what to do."""
        self._output.note(text[0].upper() + text[1:] + " ...")

    def begin(self) -> None:
        """The time for the next answer begins now, with samples from now on."""
        while not self._samples.empty():
            self._samples.get_nowait()
        self._end = time.monotonic() + self._seconds

    def sample(self) -> Hand | None:
        """The next sample within the time."""
        message = self._next()
        return None if message is None else _hand(message)

    def push(self, force: Triple) -> Hand | None:
        """Commands the force, which is in the operator's view, for a second."""
        self.begin()
        end = time.monotonic() + PUSH_TIME
        message = None
        while time.monotonic() < end:
            message = self._next()
            if message is None:
                return None
            q = message.T_world_u.orientation
            matrix = rotations.matrix_from_quaternion((q.x, q.y, q.z, q.w))
            command = self._command()
            wrench = command.wrench.force
            wrench.x, wrench.y, wrench.z = (float(row @ force) for row in matrix[:3, :3])
            self._publisher.publish(command)
            time.sleep(COMMAND_PERIOD)
            while not self._samples.empty():
                message = self._samples.get_nowait()
        return None if message is None else _hand(message)

    def _take(self, message: Any) -> None:
        if self._samples.full():
            self._samples.get_nowait()
        self._samples.put(message)

    def _next(self) -> Any:
        try:
            return self._samples.get(timeout=max(0.0, self._end - time.monotonic()))
        except queue.Empty:
            return None


def _hand(message: Any) -> Hand:
    p, q, f = message.T_u_iid.position, message.T_u_iid.orientation, message.wrench_u_written.force
    return Hand((p.x, p.y, p.z), (q.x, q.y, q.z, q.w), message.buttons, (f.x, f.y, f.z))


def check_device(simulation: Simulation, device: Device, forces: bool, seconds: float, output: Output) -> None:
    """Checks a device by its topics; raises CommandError when something is wrong with it."""
    if not forces and device.force:
        output.note("Forces are off: `ambf-cli devices forces on` before the check lets it push the hand.")
    operator = RosOperator(device, seconds, output)
    try:
        steps = check(operator, device, forces)
    finally:
        operator.close()
    output.result(steps, [f"{step.asked}: {step.remark or 'good'}" for step in steps])
    wrong = [step for step in steps if step.remark]
    if wrong:
        raise CommandError(f"{device.name}: {len(wrong)} of {len(steps)} steps were not as asked for")
