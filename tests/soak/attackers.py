"""Thirteen strangers who attack a running simulator at once, each from a thread, for some seconds.

    python attackers.py SECONDS SEED

Started by attack.py as a process of its own, in the environment of the simulator's master. Ends with 0 and prints how
often each one acted; what the simulator answers is not judged here.
"""

import io
import json
import os
import random
import socket
import struct
import sys
import threading
import time
import urllib.request
import xmlrpc.client

import rosgraph
import rospy
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3, Wrench

from ambf_msgs.msg import RigidBodyCmd, WorldCmd
from ambf_msgs.srv import Forget, List, Load, Remove, Restore, Snapshot, Step, StepRequest, Unload

WORLD = "/ambf/env/World"
BODY = "/ambf/env/Box"
CUBE = "bodies: [BODY C]\nnamespace: /attack/\nBODY C: {name: C, mass: 1, collision shape: Box, collision geometry: "
CUBE += "{x: 0.1, y: 0.1, z: 0.1}, location: {position: {x: 2, y: 2, z: 1}, orientation: {r: 0, p: 0, y: 0}}}\n"
HALF_OPEN = 32  # connections that each of two attackers leaves open


def raw(kind):
    """Messages of this kind that are sent as the bytes that they are given."""

    class Raw(kind):
        raw = b""

        def serialize(self, buff):
            buff.write(self.raw)

    return Raw


def bytes_of(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


class Attackers:
    def __init__(self, seed):
        self.random = random.Random(seed)
        master = rosgraph.Master("/attack")
        node = next(nodes[0] for topic, nodes in master.getSystemState()[0] if topic == f"{WORLD}/State")
        self.uri = master.lookupNode(node)
        protocol = xmlrpc.client.ServerProxy(self.uri).requestTopic("/attack", f"{BODY}/State", [["TCPROS"]])[2]
        self.address = (protocol[1], protocol[2])
        self.RawCommand, self.RawStep = raw(RigidBodyCmd), raw(StepRequest)
        self.bodies = rospy.Publisher(f"{BODY}/Command", RigidBodyCmd, queue_size=10)
        self.world = rospy.Publisher(f"{WORLD}/Command", WorldCmd, queue_size=10)
        kinds = (Forget, List, Load, Remove, Restore, Snapshot, Unload)
        self.call = {kind: rospy.ServiceProxy(f"{WORLD}/{kind.__name__}", kind) for kind in kinds}
        self.open = []

    def number(self):
        """Seldom one that makes sense."""
        odd = [float("nan"), float("inf"), 1e300, -1e308, 1e9, -1e6, 9e8, 0.0]
        return self.random.choice([*odd, self.random.uniform(-10.0, 10.0)])

    def vector(self, kind=Vector3):
        return kind(*(self.number() for _ in range(3)))

    def publish_raw(self, content):
        message = self.RawCommand()
        message.raw = content
        self.bodies.publish(message)

    def lying_lengths(self):
        claimed = struct.pack("<I", self.random.randrange(1 << 32))
        self.publish_raw(bytes_of(RigidBodyCmd())[:-7] + claimed + b"\0\0\0")

    def random_bytes(self):
        self.publish_raw(self.random.randbytes(self.random.randrange(4096)))

    def cut_messages(self):
        whole = bytes_of(RigidBodyCmd(joint_cmds=[0.1] * 100))
        self.publish_raw(whole[: self.random.randrange(len(whole))])

    def absurd_commands(self):
        command = RigidBodyCmd(cartesian_cmd_type=self.random.randrange(-2, 5))
        command.wrench, command.twist = (Wrench(self.vector(), self.vector()), Twist(self.vector(), self.vector()))
        command.pose = Pose(self.vector(Point), Quaternion(*(self.number() for _ in range(4))))
        self.bodies.publish(command)

    def wild_commands(self):
        force = Wrench(Vector3(0.0, 0.0, self.random.choice([-9e8, 1e5, 9e8])), Vector3())
        self.bodies.publish(RigidBodyCmd(cartesian_cmd_type=RigidBodyCmd.TYPE_FORCE, wrench=force))

    def steps(self):
        proxy = rospy.ServiceProxy(f"{WORLD}/Step", Step)
        if self.random.random() < 0.5:
            proxy.request_class = self.RawStep
            request = self.RawStep()
            request.raw = bytes_of(StepRequest())[:4] + struct.pack("<I", self.random.randrange(1 << 32))
            proxy.call(request)
        else:
            proxy.call(StepRequest(n=1, wanted_states=["x"] * 20_000))

    def tcp(self):
        """Garbage and endless lengths at the port of topics and services; some connections stay half open."""
        connection = socket.create_connection(self.address, timeout=2.0)
        length = self.random.choice([0, 1, 999_999_999, 0xFFFFFFFF, self.random.randrange(1 << 16)])
        connection.sendall(struct.pack("<I", length) + self.random.randbytes(self.random.randrange(2000)))
        self.keep_or_close(connection)

    def xml(self):
        depth = self.random.choice([1, 100, 20_000])
        value = b"<value><array><data>" * depth + b"</data></array></value>" * depth
        name = self.random.choice([b"getPid", b"requestTopic", b"publisherUpdate", b"\xff\0"])
        call = b"<methodCall><methodName>%s</methodName><params><param>%s</param></params></methodCall>" % (name, value)
        if self.random.random() < 0.3:
            call = self.random.randbytes(1000)
        with urllib.request.urlopen(self.uri, call, timeout=2.0) as answer:
            answer.read()

    def loads(self):
        text = list(CUBE)
        broken = self.random.random() < 0.7
        for _ in range(self.random.randrange(1, 8) if broken else 0):
            text[self.random.randrange(len(text))] = self.random.choice("{}[]:,-&*'\"0\t\n")
        answer = self.call[Load](text="".join(text), name_prefix="", path="", check_only=self.random.random() < 0.3)
        if answer.success and answer.model:
            self.call[Unload](model=answer.model)

    def snapshots(self):
        name = self.random.choice(["a", "a" * 300, "n\0l", "\n", "b"])
        path = self.random.choice(["", "", "/dev/zero", "/dev/full", "/proc/self/mem", "/nowhere/x", "x" * 5000])
        act = self.random.choice([Snapshot, Snapshot, Restore, Forget])
        if act is Forget:
            self.call[act](name=name)
        else:
            self.call[act](name=name, path=path)

    def names(self):
        name = self.random.choice(["", "\0", "x" * 1_000_000, "../..", "%s%n", "/ambf/env/nothing"])
        act = self.random.choice([Remove, Unload, List])
        if name != "":  # of nothing, List names all
            self.call[act](name) if act is Remove else self.call[act](model=name)

    def throttling(self):
        self.world.publish(WorldCmd(self.random.random() < 0.5, self.random.random() < 0.5, self.random.randrange(100)))

    def dying_clients(self):
        """Subscribers whose processes are killed: their connections are reset in the middle of a message."""
        fields = (b"callerid=/dies", b"topic=%s/State" % BODY.encode(), b"type=*", b"md5sum=*")
        header = b"".join(struct.pack("<I", len(field)) + field for field in fields)
        connection = socket.create_connection(self.address, timeout=2.0)
        connection.sendall(struct.pack("<I", len(header)) + header)
        connection.recv(64)
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.keep_or_close(connection)

    def keep_or_close(self, connection):
        if self.random.random() < 0.9:
            connection.close()
            return
        self.open.append(connection)
        if len(self.open) > HALF_OPEN:
            self.open.pop(0).close()

    def all(self):
        return [
            *(self.lying_lengths, self.random_bytes, self.cut_messages, self.absurd_commands, self.wild_commands),
            *(self.steps, self.tcp, self.xml, self.loads, self.snapshots, self.names, self.throttling),
            self.dying_clients,
        ]


def main():
    seconds, seed = float(sys.argv[1]), int(sys.argv[2])
    rospy.init_node("attackers", anonymous=True, disable_signals=True, disable_rosout=True)
    attackers = Attackers(seed)
    counts = {act.__name__: 0 for act in attackers.all()}
    end = time.monotonic() + seconds

    def attack(act):
        while time.monotonic() < end:
            try:
                act()
            except Exception:  # refusals, resets and timeouts are what an attacker expects
                time.sleep(0.001)
            counts[act.__name__] += 1
            time.sleep(0.001)  # all get their turn with Python's lock

    threads = [threading.Thread(target=attack, args=(act,), daemon=True) for act in attackers.all()]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(seconds + 5.0)
    print(json.dumps(counts), flush=True)
    os._exit(0)  # as a killed program: nothing is unregistered


if __name__ == "__main__":
    main()
