"""Where cameras and other objects are, on /tf: for rviz and other programs that combine several sources."""

import argparse
import fnmatch
import threading
import time
from collections import Counter
from collections.abc import Iterable
from typing import Any

from ambf_tools.cli.output import Output
from ambf_tools.cli.simulation import CommandError, Simulation

WORLD = "world"
LOOK_AGAIN = 2.0  # s: objects come and go
# Optical axes (x right, y down, z ahead) in those of a camera (x backwards, y right, z up).
OPTICAL = (-0.5, -0.5, 0.5, 0.5)


def tf_command(simulation: Simulation, options: argparse.Namespace, output: Output) -> None:
    """Broadcasts until Ctrl-C."""
    import rospy
    from tf2_msgs.msg import TFMessage

    frames = Frames(simulation, options.names)
    placed = frames.update()
    hanging = frames.newly_hanging()
    if not placed:
        wanted = " ".join(options.names) or "camera"
        raise CommandError(
            hanging or f"there is no {wanted} that could be broadcast; `ambf-cli list` shows what is there"
        )
    out = rospy.Publisher("/tf", TFMessage, queue_size=10)
    still = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
    output.result(frames.names(), [f"on /tf below '{WORLD}': {', '.join(frames.names())}; Ctrl-C ends it"])
    still.publish(TFMessage(frames.optical()))
    looked = time.monotonic()
    if hanging:
        output.note(f"ambf-cli: {hanging}")
    while not rospy.is_shutdown():
        if time.monotonic() - looked >= LOOK_AGAIN:
            frames.update()
            if hanging := frames.newly_hanging():
                output.note(f"ambf-cli: {hanging}")
            still.publish(TFMessage(frames.optical()))
            looked = time.monotonic()
        moved = frames.moved()
        if moved:
            out.publish(TFMessage(moved))
        time.sleep(1.0 / options.rate)


class Frames:
    """The newest states of the chosen objects, as transforms. Callbacks of rospy's threads bring the states."""

    def __init__(self, simulation: Simulation, patterns: list[str]) -> None:
        self._simulation = simulation
        self._patterns = patterns
        self._lock = threading.Lock()
        self._states: dict[str, Any] = {}  # newest, not yet broadcast; by full name
        self._subscribers: dict[str, Any] = {}
        self._cameras: dict[str, str] = {}  # topics, by full name
        self._frames: dict[str, str] = {}  # of all objects, by full name
        self._hanging: dict[str, str] = {}  # objects that cannot be placed, and their parents; full names
        self._reported: set[str] = set()  # of these

    def names(self) -> list[str]:
        """The frames that are broadcast."""
        return sorted(self._frames[name] for name in self._subscribers)

    def update(self) -> bool:
        """Follows what is there now. False: nothing that was asked for."""
        import rospy

        try:
            objects = {each.name: each for each in self._simulation.services.list().objects}
        except RuntimeError:
            return False  # the simulator is gone, or busy: what is known stays
        classes = self._simulation.handle_classes()
        handles = {name: classes[each.topic] for name, each in objects.items() if each.topic in classes}
        handles = {name: handle for name, handle in handles.items() if "pose" in handle.state_type.__slots__}
        cameras = {name for name, handle in handles.items() if handle.has_pictures}
        self._frames = frame_names(objects, cameras)
        wanted = {name for name in handles if self._asked_for(name, name in cameras)}
        self._hanging = {
            name: objects[name].parent
            for name in wanted
            if objects[name].parent in objects and not objects[objects[name].parent].topic
        }
        wanted -= set(self._hanging)
        while parents := {objects[name].parent for name in wanted} & set(handles) - wanted:
            wanted |= parents
        for name in set(self._subscribers) - wanted:
            self._subscribers.pop(name).unregister()
        self._cameras = {name: objects[name].topic for name in wanted & cameras}
        for name in wanted - set(self._subscribers):
            topic, kind = f"{objects[name].topic}/State", handles[name].state_type
            self._subscribers[name] = rospy.Subscriber(
                topic, kind, self._take, callback_args=name, queue_size=1, tcp_nodelay=True
            )
        return bool(wanted)

    def newly_hanging(self) -> str:
        """Which objects are not broadcast since their parents publish no pose; each once. Empty: none."""
        new = {name: parent for name, parent in self._hanging.items() if name not in self._reported}
        self._reported = set(self._hanging)
        return "; ".join(
            f"{name} is left out: its parent {parent} is `passive: true` and publishes no pose"
            for name, parent in sorted(new.items())
        )

    def _asked_for(self, name: str, is_camera: bool) -> bool:
        if not self._patterns:
            return is_camera
        return any(fnmatch.fnmatchcase(name, each) or name.endswith("/" + each) for each in self._patterns)

    def _take(self, state: Any, name: str) -> None:
        with self._lock:
            self._states[name] = state

    def moved(self) -> list[Any]:
        """Transforms of states that came since the last call."""
        with self._lock:
            states, self._states = self._states, {}
        made = []
        for name, state in states.items():
            if name not in self._frames:
                continue
            parent = state.parent_name.data if hasattr(state, "parent_name") else ""  # empty: in the world
            pose = state.pose
            made.append(
                transform(
                    self._frames.get(parent, WORLD),
                    self._frames[name],
                    state.header.stamp,
                    pose.position,
                    pose.orientation,
                )
            )
        return made

    def optical(self) -> list[Any]:
        """From cameras to the axes of their pictures."""
        import rospy
        from geometry_msgs.msg import Quaternion, Vector3

        made = []
        for name, topic in sorted(self._cameras.items()):
            frame = self._frames[name]
            eyes = {"_optical": 0.0}
            if rospy.get_param(f"{topic}/mode", "MONO") == "STEREO":
                eyes["_left_optical"] = -0.5 * float(rospy.get_param(f"{topic}/stereo_eye_separation"))
            made += [
                transform(frame, frame + ending, rospy.Time(), Vector3(0.0, aside, 0.0), Quaternion(*OPTICAL))
                for ending, aside in eyes.items()
            ]
        return made


def frame_names(objects: Iterable[str], cameras: set[str]) -> dict[str, str]:
    """Short names, as pictures have them; of several objects with the same one only cameras keep it."""
    short = {name: name.rpartition("/")[2] for name in objects}
    count = Counter(short.values())
    return {name: last if count[last] == 1 or name in cameras else name.strip("/") for name, last in short.items()}


def transform(parent: str, child: str, stamp: Any, position: Any, orientation: Any) -> Any:
    """A TransformStamped."""
    from geometry_msgs.msg import TransformStamped, Vector3

    made = TransformStamped()
    made.header.stamp = stamp
    made.header.frame_id = parent
    made.child_frame_id = child
    made.transform.translation = Vector3(position.x, position.y, position.z)
    made.transform.rotation = orientation
    return made
