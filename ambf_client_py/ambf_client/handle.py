"""What objects and the world have in common: a pair of topics, the newest state, a command that keeps being sent."""

from __future__ import annotations

import copy
import threading
import time
import warnings
from collections.abc import Callable
from typing import Any

import rospy

from ._generations import takes_ral
from ._messages import Message, Stamp, deferred, stamp_of
from .watch_dog import WatchDog

_QUEUE = 10  # messages, as the original

# A publisher without a queue is meant where command_queue says so.
warnings.filterwarnings("ignore", "The publisher should be created with an explicit", SyntaxWarning, __name__)


class Gate:
    """Shared by all handles of a client: while it steps the world, commands travel with the steps only."""

    stepping = False
    waits = False  # the world was made to wait for this client, and was not released since


class Handle(WatchDog):
    """A pair of topics: the newest state to read, a command to set.

    A command is sent at once; the client then keeps sending it at its rate until clear_cmd(), so that the simulator's
    watchdog (0.5 s) does not let go of it. What was never commanded is sent nothing.
    """

    object_type = "HANDLE"
    state_type: Any = None  # ROS message of <topic>/State
    command_type: Any = None  # ROS message of <topic>/Command
    # Messages that wait for rospy's sending thread; the oldest go first. None: the caller's thread sends, so that
    # nothing is lost when the topic closes right after.
    command_queue: int | None = _QUEUE

    @takes_ral
    def __init__(self, a_name: str, time_out: float) -> None:
        """a_name: the object's topics without /State and /Command. time_out: of the client's watchdog, s."""
        super().__init__(time_out)
        self._name = a_name
        self._topic = a_name
        self._active = False
        self._closed = False
        self._commanded = False
        self._gate = Gate()
        self._cleared = False  # the next step sends that the command ended
        self._pose_commanded = False
        self.pub_flag = True  # False: commands are only kept, not sent
        self._command_lock = threading.RLock()
        self._cmd = self._new_command()
        self._connecting = threading.Lock()
        self._arrived = threading.Condition()
        self._state: Message = self.state_type() if self.state_type is not None else None
        self._received_count = 0
        self._not_before: Stamp = (0, 0)
        self._pub: Any = None
        self._sub: Any = None

    # --- the state -------------------------------------------------------------------------------------------------

    def ros_cb(self, data: Message) -> None:
        """Takes a state message. Those that are older than the last step (World.step) are late and left out."""
        with self._arrived:  # no step may be answered between the comparison and what follows from it
            if self._not_before != (0, 0):
                stamp = stamp_of(data)
                # A clock that was put back makes everything look old: much older is believed.
                if stamp < self._not_before and self._not_before[0] - stamp[0] < 10:
                    return
            self._accept(data)

    def _accept(self, data: Message) -> None:
        with self._arrived:
            self._state = data
            self._received_count += 1
            self._arrived.notify_all()

    def _accept_step(self, data: Message) -> None:
        """Takes a state that came with the answer to a step."""
        with self._arrived:
            self._not_before = stamp_of(data)
            self._accept(data)

    def wait_for_state(self, timeout: float = 2.0) -> bool:
        """Waits until a state has arrived (at once if one has). False: none came within timeout seconds."""
        with self._arrived:
            return self._arrived.wait_for(lambda: self._received_count > 0, timeout)

    def wait_for_next_state(self, timeout: float = 2.0) -> bool:
        """Waits for a state newer than the present one. False: none came within timeout seconds."""
        with self._arrived:
            count = self._received_count
            return self._arrived.wait_for(lambda: self._received_count > count, timeout)

    def wait_for_sim_step(self, step: int, timeout: float = 2.0) -> bool:
        """Waits until the state is that of simulation step `step` or later. False: it is not within timeout seconds."""
        with self._arrived:
            return self._arrived.wait_for(lambda: self._received_count > 0 and self.get_sim_step() >= step, timeout)

    def has_state(self) -> bool:
        """Whether a state has arrived; until then getters give zeros."""
        return self._received_count > 0

    def get_sim_step(self) -> int:
        """The simulation step that the state shows."""
        return int(self._state.sim_step)

    def get_sim_time(self) -> float:
        """Simulated time of the state (s, single precision)."""
        return float(self._state.sim_time)

    def get_name(self) -> str:
        """The object's name: its topics without /State."""
        return self._name

    def set_name(self, name: str) -> None:
        """Gives the handle another name; the topics stay."""
        self._name = name

    def get_msg_header(self) -> Message:
        """Header of the newest state message."""
        return self._state.header

    def get_msg_time_stamp(self) -> Message:
        """When the simulator made the state: a rospy.Time of the system clock."""
        return self._state.header.stamp

    def get_msg_seq_num(self) -> int:
        """Sequence number of the newest state message."""
        return int(self._state.header.seq)

    def get_msg_frame_id(self) -> str:
        """Frame of the newest state message; empty: the world."""
        return str(self._state.header.frame_id)

    # --- the command -----------------------------------------------------------------------------------------------

    def set_command(self, command: Message) -> None:
        """Makes a whole ROS message the command; it is sent at once and kept being sent."""
        if not isinstance(command, self.command_type):
            raise TypeError(f"{self._name} takes {self.command_type.__name__}, not {type(command).__name__}")
        with self._command_lock:
            self._cmd = copy.deepcopy(command)
            self._pose_commanded = True
            self._send_command()

    def clear_cmd(self) -> None:
        """Ends commanding: the object is let go at once, and nothing more is sent."""
        with self._command_lock:
            if self._sent_with_steps():
                self._cleared = self._commanded
            else:
                self._withdraw()
            self._cmd = self._new_command()
            self._pose_commanded = False
            self._commanded = False

    def is_commanded(self) -> bool:
        """Whether a command is being sent."""
        return self._commanded

    def is_active(self) -> bool:
        """Whether the handle is connected to its topics."""
        return self._active

    def set_active(self) -> None:
        """Connects the handle to its topics. Client.get_obj_handle does it."""
        with self._connecting:
            if self._active:
                return
            self._closed = False
            if self.command_type is not None and self._topic:
                self._pub = rospy.Publisher(
                    self._topic + "/Command",
                    self.command_type,
                    subscriber_listener=_Greeter(self),
                    tcp_nodelay=True,
                    queue_size=self.command_queue,
                )
            self._active = True
            if self.state_type is not None and self._topic:
                self._sub = rospy.Subscriber(
                    self._topic + "/State", deferred(self.state_type), self.ros_cb, queue_size=1, tcp_nodelay=True
                )

    def set_inactive(self) -> None:
        """Closes the handle's topics. What it commanded, the simulator lets go of after its watchdog's time."""
        self._active = False
        self._closed = True
        for end in (self._pub, self._sub):
            if end is not None:
                end.unregister()
        self._pub = self._sub = None

    def open_topics(self) -> list[tuple[str, str, bool]]:
        """The open topics as (name, type, whether this side publishes)."""
        ends = ((self._pub, True), (self._sub, False))
        return [(end.resolved_name, end.type, publishes) for end, publishes in ends if end is not None and end.type]

    def wait_for_connection(self, timeout: float = 2.0) -> bool:
        """Waits until the simulator hears commands. False: it does not within timeout seconds."""
        deadline = time.monotonic() + timeout
        while self._pub is not None and self._pub.get_num_connections() == 0:
            if time.monotonic() > deadline or rospy.is_shutdown():
                return False
            time.sleep(0.001)
        return self._pub is not None

    def run_publisher(self) -> None:
        """Sends the command once more; the client does this at its rate."""
        with self._command_lock:
            if not self._commanded or self._sent_with_steps():
                return
            if self.is_wd_expired():
                self._on_watchdog()
            self._publish()

    # --- for subclasses --------------------------------------------------------------------------------------------

    def _join(self, gate: Gate, list_world: Callable[[], Any]) -> None:
        """The client that made this handle shares its gate; list_world lists what is in the world (None: no world)."""
        self._gate = gate

    def _sent_with_steps(self) -> bool:
        """Whether the command goes with the client's steps now, and not on the topic."""
        return self._gate.stepping

    def _is_complete(self) -> bool:
        """Whether the newest state holds everything that set_active requested."""
        return True

    def _new_command(self) -> Message:
        """The command that commands nothing."""
        if self.command_type is None:
            return None
        return self.command_type()

    def _letting_go(self) -> Message:
        """The message that ends the command."""
        return self._new_command()

    def _send_command(self) -> None:
        """The command was changed: it is sent now, and from now on. Under the command lock."""
        self._commanded = True
        self.acknowledge_wd()
        if not self._sent_with_steps():
            self._publish()

    def _publish(self) -> None:
        command = self._current_command()
        if hasattr(command, "header"):
            command.header.stamp = rospy.Time.now()
        self._send_out(command)

    def _current_command(self) -> Message:
        """The command, as the object is now."""
        return self._cmd

    def _send_out(self, message: Message) -> None:
        """Sends a message, if there is somewhere to send it. Under the command lock."""
        if self._pub is None or not self.pub_flag or rospy.core.is_shutdown_requested():
            return
        try:
            self._pub.publish(message)
        except rospy.ROSException:
            # Closed at this very moment, because the script ends.
            if not rospy.core.is_shutdown_requested():
                raise

    def _withdraw(self) -> None:
        """Takes the command back from the simulator, but keeps it."""
        with self._command_lock:
            if self._commanded:
                self._send_out(self._letting_go())

    def _on_watchdog(self) -> None:
        """The watchdog expired: withdraws what must not outlive its author. Poses and joints may."""

    def _greeting(self) -> Message:
        """What a simulator that has just connected is sent; None: nothing."""
        return self._cmd if self._commanded and self.pub_flag and not self._sent_with_steps() else None


class _Greeter(rospy.SubscribeListener):  # type: ignore[misc]
    """A simulator that starts, or starts again, learns at once what is commanded."""

    def __init__(self, owner: Handle) -> None:
        super().__init__()
        self._owner = owner

    def peer_subscribe(self, topic_name: str, topic_publish: Any, peer_publish: Any) -> None:
        with self._owner._command_lock:
            greeting = self._owner._greeting()
            # Handles of one process share a topic's listeners; those of closed handles stay among them.
            if greeting is not None and not self._owner._closed:
                peer_publish(greeting)
