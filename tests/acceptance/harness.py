"""Tools of the acceptance tests: masters, simulators and the shared rospy node, seen from outside."""

import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import xmlrpc.client
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

SIMULATOR = Path(os.environ.get("AMBF_SIMULATOR", ROOT / "build/bin/ambf_simulator"))
COMPAT = Path(os.environ.get("AMBF_COMPAT_DIR", ROOT.parent / "shared/compat"))
# A sanitizer makes everything slower; only waiting times know of it.
SLOWNESS = 8.0 if os.environ.get("AMBF_SANITIZER") else 1.0

# Told by every run on an ordinary machine.
# Masters of tests that run beside each other call nodes that are gone: a port may be another simulator's by then, and
# roscpp takes "POST" for the length of a header.
ALWAYS_ALLOWED = [r"memory is not locked", r"a header of over a gigabyte was predicted in tcpros"]


def eventually(condition, seconds=10.0, what="", interval=0.01):
    """Waits until condition() is true and returns its value; fails otherwise."""
    deadline = time.monotonic() + seconds * SLOWNESS
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > deadline:
            pytest.fail(f"not within {seconds} s: {what or condition}")
        time.sleep(interval)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Master:
    """A rosmaster process and what it knows."""

    def __init__(self, port=None, running=True):
        self.port = port or free_port()
        self.uri = f"http://127.0.0.1:{self.port}"
        self.process = None
        if running:
            self.start()

    def start(self):
        self.process = subprocess.Popen(
            ["rosmaster", "--core", "-p", str(self.port)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
            env={name: value for name, value in os.environ.items() if name != "ROS_IP"},  # on all addresses
        )
        eventually(self.answers, 20.0, "the master answers")

    def kill(self):
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process = None

    def _ask(self, method, *arguments):
        with xmlrpc.client.ServerProxy(self.uri) as proxy:
            return getattr(proxy, method)("/acceptance", *arguments)[2]

    def answers(self):
        try:
            return self._ask("getPid") > 0
        except OSError:
            return False

    def state(self):
        """(publishers, subscribers, services), each {name: {nodes}}; empty when the master does not answer."""
        try:
            return tuple({name: set(nodes) for name, nodes in part} for part in self._ask("getSystemState"))
        except OSError:
            return {}, {}, {}

    def forget_dead(self):
        """Unregisters what simulators that were killed have left, so that the tests after them count their own."""
        methods = ("unregisterPublisher", "unregisterSubscriber", "unregisterService")
        for part, method in zip(self.state(), methods, strict=True):
            for name, nodes in part.items():
                for node in nodes:
                    found = re.match(r"/ambf_comm_node_(\d+)_", node)
                    if found is None or Path(f"/proc/{found.group(1)}").exists():
                        continue
                    service = method == "unregisterService"
                    address = self._ask("lookupService", name) if service else self._ask("lookupNode", node)
                    with xmlrpc.client.ServerProxy(self.uri) as proxy:
                        getattr(proxy, method)(node, name, address)

    def published(self):
        """{topic: type} of what simulators publish."""
        publishers = self.state()[0]
        ours = {t for t, nodes in publishers.items() if any(n.startswith("/ambf_comm_node") for n in nodes)}
        return {topic: kind for topic, kind in self._ask("getTopicTypes") if topic in ours}

    def names(self):
        """Everything registered by simulators: topics, subscriptions, services."""
        return {
            name
            for part in self.state()
            for name, nodes in part.items()
            if any(node.startswith("/ambf_comm_node") for node in nodes) and not name.startswith("/ambf_comm_node")
        }


class Simulator:
    """One simulator process. allowed: regular expressions of warnings that its test expects.

    display: headless without asking (""), asking for a window though there is none (None), or its name. user: the id of
    the user who runs it; None: who runs the tests.
    """

    def __init__(self, folder, *arguments, master_uri=None, environment=None, allowed=(), display="", user=None):
        self.log_file = Path(folder) / f"simulator_{time.monotonic_ns()}.log"
        self.allowed = [*ALWAYS_ALLOWED, *allowed]
        env = dict(os.environ, **(environment or {}))
        env.pop("ROS_IP", None)
        env.pop("ROS_HOSTNAME", None)
        if master_uri is not None:
            env["ROS_MASTER_URI"] = master_uri
        env.pop("DISPLAY", None)
        env.pop("WAYLAND_DISPLAY", None)
        if display:
            env["DISPLAY"] = display
        command = [str(SIMULATOR), *(("-g", "false") if display == "" else ()), *map(str, arguments)]
        with open(self.log_file, "w") as log:
            self.started = time.monotonic()
            self.process = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                env=env,
                start_new_session=True,
                user=user,
                group=user,
                extra_groups=None if user is None else [],
            )

    @property
    def pid(self):
        return self.process.pid

    def log(self):
        return self.log_file.read_text(errors="replace")

    def wait_log(self, pattern, seconds=10.0):
        return eventually(lambda: re.search(pattern, self.log()), seconds, f"{self.log_file} says {pattern}")

    def wait_loaded(self, models=1):
        eventually(lambda: self.log().count("loaded '") >= models, 60.0, "the models are loaded")

    def running(self):
        return self.process.poll() is None

    def stop(self, with_signal=signal.SIGINT, seconds=20.0):
        """Ends it; returns (exit code, seconds that took)."""
        begin = time.monotonic()
        if self.running():
            self.process.send_signal(with_signal)
        try:
            code = self.process.wait(seconds * SLOWNESS)
        except subprocess.TimeoutExpired:
            self.process.kill()
            pytest.fail(f"the simulator did not end within {seconds} s of {with_signal}:\n{self.log()}")
        return code, time.monotonic() - begin

    def complaints(self):
        lines = [line for line in self.log().splitlines() if re.search(r"warn|error|sanitizer|assert", line, re.I)]
        lines = [line for line in lines if not re.search(r"0 errors, 0 warnings", line)]
        return [line for line in lines if not any(re.search(pattern, line) for pattern in self.allowed)]

    def close(self):
        if self.running():
            self.stop()
        assert not self.complaints(), self.log()


class Ros:
    """The shared rospy node."""

    def __init__(self):
        import rospy

        self.rospy = rospy
        rospy.init_node("acceptance", anonymous=True, disable_signals=True, disable_rosout=True)
        self.open = []

    def listen(self, topic, kind, queue_size=None):
        """A Listener to a topic."""
        listener = Listener(self.rospy, topic, kind, queue_size)
        self.open.append(listener)
        return listener

    def talk(self, topic, kind):
        """A publisher, once the simulator hears it."""
        publisher = self.rospy.Publisher(topic, kind, queue_size=1000, tcp_nodelay=True)
        self.open.append(publisher)
        eventually(lambda: publisher.get_num_connections() > 0, 10.0, f"{topic} is heard")
        return publisher

    def service(self, name, kind):
        self.rospy.wait_for_service(name, timeout=10.0 * SLOWNESS)
        proxy = self.rospy.ServiceProxy(name, kind, persistent=True)
        self.open.append(proxy)
        return proxy

    def close(self):
        for thing in self.open:
            getattr(thing, "unregister", thing.close if hasattr(thing, "close") else None)()
        self.open.clear()


class Client:
    """A rospy program of its own, with its own master."""

    def __init__(self, program, uri, *arguments):
        env = dict(os.environ, ROS_MASTER_URI=uri, ROS_IP="127.0.0.1")
        self.output = Path(tempfile.mkstemp()[1])
        with self.output.open("w") as out:
            self.process = subprocess.Popen(
                [sys.executable, "-c", program, *map(str, arguments)], stdout=out, stderr=subprocess.DEVNULL, env=env
            )

    def lines(self):
        return self.output.read_text().splitlines()

    def result(self):
        code = self.process.wait(60)
        assert code == 0
        return self.lines()[-1]

    def kill(self):
        self.process.kill()
        self.process.wait()


class Listener:
    """Keeps what was received, with times of arrival."""

    def __init__(self, rospy, topic, kind, queue_size):
        self.messages = []
        self.times = []
        self.topic = topic
        self.subscriber = rospy.Subscriber(topic, kind, self._on, queue_size=queue_size, tcp_nodelay=True)

    def _on(self, message):
        self.times.append(time.monotonic())
        self.messages.append(message)

    def last(self, seconds=10.0):
        """The newest, once there is one."""
        eventually(lambda: self.messages, seconds, f"a message on {self.topic}")
        return self.messages[-1]

    def next(self, condition=lambda message: True, seconds=10.0, what=""):
        """The first message received from now on for which the condition holds."""
        at = len(self.messages)

        def look():
            nonlocal at
            while at < len(self.messages):
                at += 1
                if condition(self.messages[at - 1]):
                    return self.messages[at - 1]
            return None

        return eventually(look, seconds, what or f"a message on {self.topic} that fits", 0.001)

    def rate(self, seconds=1.0):
        """Messages a second of wall time."""
        first, begin = len(self.messages), time.monotonic()
        time.sleep(seconds)
        return (len(self.messages) - first) / (time.monotonic() - begin)

    def unregister(self):
        self.subscriber.unregister()


BENCH_ALLOWED = []
WORLD_NAMES = 9 + 13  # topics and services of the world, at the master
