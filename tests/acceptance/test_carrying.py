"""A person's way: a gamepad and a space mouse carry a ring to another peg (bar 8; keyboard and mouse: window/)."""

import contextlib
import os
import socket
import struct
import time

from carrying import ON_A_PEG, Carrier
from harness import ROOT, eventually

from ambf_msgs.msg import RigidBodyState

RIGHT_PEG = (0.0, 0.026)  # x, y, m
SPEED = 0.05  # m/s at full deflection, of the shipped device file


class Stick:
    """A hand on a device that springs back: full deflection for as long as the way takes."""

    def nudge(self, *way):
        for axis, metres in enumerate(way):
            if metres == 0.0:
                continue
            self.deflect(axis, metres > 0.0, True)
            time.sleep(abs(metres) / SPEED)
            self.deflect(axis, metres > 0.0, False)


class Gamepad(Stick):
    """Records of joydev: time, value, type, number."""

    AXES = ((1, 1), (0, 1), (4, -1))  # number and sign of: towards the operator, right, up
    TRIGGER = 5

    def __init__(self, fifo):
        self.fifo = fifo
        self.send(self.TRIGGER, -32767)

    def send(self, number, value):
        os.write(self.fifo, struct.pack("IhBB", 0, value, 2, number))

    def deflect(self, axis, forward, pressed):
        number, sign = self.AXES[axis]
        self.send(number, pressed * sign * (32767 if forward else -32767))

    def close_jaw(self):
        self.send(self.TRIGGER, 32767)

    def open_jaw(self):
        self.send(self.TRIGGER, -32767)


class SpaceMouse(Stick):
    """Packets of spacenavd: 0, x (right), y (up), z (away), rx, ry, rz, ms; 1 or 2 and a button's number."""

    AXES = ((2, -1), (0, 1), (1, 1))
    FULL = 350

    def __init__(self, connection):
        self.connection = connection

    def send(self, *numbers):
        self.connection.sendall(struct.pack("8i", *numbers, *[0] * (8 - len(numbers))))

    def deflect(self, axis, forward, pressed):
        motion = [0, 0, 0]
        number, sign = self.AXES[axis]
        motion[number] = pressed * sign * (self.FULL if forward else -self.FULL)
        self.send(0, *motion)

    def close_jaw(self):
        self.send(1, 0)

    def open_jaw(self):
        self.send(2, 0)


def test_a_gamepad_carries_a_ring_to_another_peg(tmp_path, master, start, ros):
    shipped = ROOT / "ambf_models/descriptions"
    devices = (shipped / "input_devices/input_devices.yaml").read_text()
    changed = devices.replace(
        "\n  hardware name: Gamepad\n  driver: {", "\n  hardware name: Gamepad\n  driver: {path: js0, "
    )
    assert changed != devices
    (tmp_path / "devices.yaml").write_text(changed)
    launch = tmp_path / "launch.yaml"
    launch.write_text(
        f"world config: {shipped}/world/peg_transfer_world.yaml\n"
        "input devices config: devices.yaml\n"
        f"multibody configs: [{shipped}/multi-bodies/puzzles/peg_transfer.yaml]\n"
    )
    os.mkfifo(tmp_path / "js0")
    simulator = start("--launch_file", launch, "-l", "0", "-i", "Gamepad", master_uri=master.uri)
    simulator.wait_log("device 'Gamepad' is connected")
    fifo = os.open(tmp_path / "js0", os.O_WRONLY)
    Carrier(ros, Gamepad(fifo)).carry()
    simulator.stop()
    os.close(fifo)


def test_a_space_mouse_carries_a_ring_to_another_peg(tmp_path, master, start, ros):
    path = tmp_path / "spnav.sock"
    with contextlib.closing(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)) as daemon:
        daemon.bind(str(path))
        daemon.listen()
        simulator = start("-i", "SpaceMouse", master_uri=master.uri, environment={"SPNAV_SOCKET": str(path)})
        daemon.settimeout(20.0)
        connection, _ = daemon.accept()
        simulator.wait_loaded()
        Carrier(ros, SpaceMouse(connection)).carry()
        simulator.stop()
        connection.close()


def test_two_partners_hand_a_ring_over(master, start, ros):
    launch = ROOT / "ambf_models/descriptions/launch_two_users.yaml"
    simulator = start("--launch_file", launch, "-i", "Giver,Taker", master_uri=master.uri)
    simulator.wait_loaded()
    ring = ros.listen("/ambf/env/ring3/State", RigidBodyState)
    x, y = RIGHT_PEG

    def is_on_the_peg():
        at = ring.last().pose.position
        return abs(at.x - x) < 0.005 and abs(at.y - y) < 0.005 and at.z < ON_A_PEG

    eventually(is_on_the_peg, 40.0, "the ring comes from the left peg, from hand to hand, to the right one", 0.1)
    assert max(m.pose.position.z for m in ring.messages) > 0.06
