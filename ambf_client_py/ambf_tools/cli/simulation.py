"""The simulation that a command is about: found at the ROS master, reached by services and topics."""

import contextlib
import difflib
import os
import threading
import time
from typing import Any

from ambf_client._master import Master, MasterSilent, describe_uri
from ambf_client.kinds import handle_class
from ambf_client.services import JointInfo, Listing, Model, ObjectInfo, Services

CONNECT_TIMEOUT = 5.0  # s
FIRST_MESSAGE_TIMEOUT = 5.0  # s


class CommandError(RuntimeError):
    """Why a command cannot be carried out. code: the exit code of ambf-cli."""

    def __init__(self, message: str, code: int = 1) -> None:
        super().__init__(message)
        self.code = code


NO_SIMULATOR = 3


class Simulation:
    """One simulator. Raises CommandError with what to do about it when there is none, or several."""

    def __init__(self, namespace: str = "") -> None:
        self._master = Master(f"/ambf_cli_{os.getpid()}")
        try:
            view = self._master.look()
        except MasterSilent:
            raise CommandError(
                f"no ROS master answers at {describe_uri(self._master.uri)}. Start a simulator (it brings a master "
                "along), or set ROS_MASTER_URI to the master that yours uses.",
                NO_SIMULATOR,
            ) from None
        worlds = sorted(name for name, kind in view.objects.items() if kind == "ambf_msgs/WorldState")
        if namespace:
            worlds = [world for world in worlds if world.startswith("/" + namespace.strip("/") + "/")]
        if not worlds:
            below = f" below {namespace}" if namespace else ""
            raise CommandError(
                f"the ROS master at {self._master.uri} knows no AMBF simulator{below}. Start one, without --no-ros.",
                NO_SIMULATOR,
            )
        if len(worlds) > 1:
            raise CommandError(f"several simulators run; choose by --ns: {', '.join(worlds)}", 2)
        self.world = worlds[0]
        self.services = Services(self.world)
        self._listing: Listing | None = None
        self._become_node()

    @staticmethod
    def _become_node() -> None:
        import rospy

        if not rospy.core.is_initialized():
            rospy.init_node("ambf_cli", anonymous=True, disable_signals=True, disable_rosout=True)

    @property
    def listing(self) -> Listing:
        """What is in the world; asked once."""
        if self._listing is None:
            self._listing = self.services.list()
        return self._listing

    # --- names -----------------------------------------------------------------------------------------------------

    def object(self, name: str, need_topic: bool = True) -> ObjectInfo:
        """The object of that name, or the only one whose name ends with it, or contains it."""
        found: ObjectInfo = self._find(name, self.listing.objects, "object")
        if need_topic and not found.topic:
            raise CommandError(f"{found.name} has no topics: it is `passive: true` in its file")
        return found

    def handle_classes(self) -> dict[str, Any]:
        """The handle class of each object that has topics now, by its topic without /State."""
        try:
            view = self._master.look()
        except (MasterSilent, LookupError):  # busy, or something vanished meanwhile
            return {}
        return {topic: handle_class(kind) for topic, kind in view.objects.items()}

    def joint(self, name: str) -> JointInfo:
        """As object(), for joints."""
        found: JointInfo = self._find(name, self.listing.joints, "joint")
        return found

    def object_or_joint(self, name: str) -> ObjectInfo | JointInfo:
        """As object(), among both. An object goes before a joint of the very same name."""
        objects = self.listing.objects
        taken = {each.name for each in objects}
        joints = [each for each in self.listing.joints if each.name not in taken]
        found: ObjectInfo | JointInfo = self._find(name, [*objects, *joints], "object or joint", "objects and joints")
        return found

    def model(self, name: str) -> Model:
        """As object(), for models."""
        found: Model = self._find(name, self.listing.models, "model")
        return found

    @staticmethod
    def _find(name: str, among: list[Any], what: str, plural: str = "") -> Any:
        tests = (
            lambda n: n == name,
            lambda n: n.endswith("/" + name),
            lambda n: name in n,
            lambda n: name.lower() in n.lower(),
        )
        for test in tests:
            fits = [each for each in among if test(each.name)]
            if len(fits) == 1:
                return fits[0]
            if fits:
                names = [each.name for each in fits]
                more = f" and {len(names) - 8} more" if len(names) > 8 else ""
                raise CommandError(f"'{name}' fits several {plural or what + 's'}: {', '.join(names[:8])}{more}")
        short = {each.name.rpartition("/")[2]: each.name for each in among}
        close = difflib.get_close_matches(name.rpartition("/")[2], short, 3, 0.5)
        hint = f"; did you mean {' or '.join(close)}?" if close else f"; `ambf-cli list` shows all {len(among)}"
        raise CommandError(f"there is no {what} '{name}'{hint}")

    # --- topics ----------------------------------------------------------------------------------------------------

    def first(self, topic: str, kind: Any, condition: Any = None, timeout: float = FIRST_MESSAGE_TIMEOUT) -> Any:
        """The first message of a topic that fulfils the condition."""
        import rospy

        found: list[Any] = []
        came = threading.Event()

        def take(message: Any) -> None:
            if not found and (condition is None or condition(message)):
                found.append(message)
                came.set()

        subscriber = rospy.Subscriber(topic, kind, take, tcp_nodelay=True)
        try:
            if not came.wait(timeout):
                raise CommandError(f"{topic} sent nothing fitting within {timeout:g} s")
        finally:
            subscriber.unregister()
        return found[0]

    def send(self, topic: str, message: Any) -> None:
        """Sends one message, surely: waits until the simulator listens, and until it is on its way."""
        import rospy

        publisher = rospy.Publisher(topic, type(message), queue_size=10, tcp_nodelay=True)
        deadline = time.monotonic() + CONNECT_TIMEOUT
        while publisher.get_num_connections() == 0:
            if time.monotonic() > deadline:
                raise CommandError(f"the simulator does not listen to {topic}")
            time.sleep(0.005)
        publisher.publish(message)
        # Closing the topic at once could overtake the message.
        time.sleep(0.1)
        with contextlib.suppress(rospy.ROSException):
            publisher.unregister()
