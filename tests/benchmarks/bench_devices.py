"""Input devices: does each keep its rate, and how old are set-points and forces, with all topics up?

Eight devices (two gamepads on FIFOs, a space mouse on a socket, an arm and a tracker behind ROS, three scripted ones)
move puzzle1 beside PSM, ECM and MTM (dissertation Fig. 3.19: five devices near 1 kHz), under SCHED_FIFO and without.
The target: each at least 995 cycles a second, real-time factor 1 +-0.005, once all is loaded (5 s). Devices read one
after the other: ambf_sequential_devices_benchmark.
"""

import argparse
import ctypes
import math
import os
import platform
import resource
import signal
import socket
import struct
import subprocess
import threading
import time

import support

FILE = """
input devices: [Pad0, Pad1, Puck, Arm, Tracker, Scripted0, Scripted1, Scripted2]
Pad0: {{hardware name: Gamepad, driver: {{path: js0}}, root link: {bodies[0]}}}
Pad1: {{hardware name: Gamepad, driver: {{path: js1}}, root link: {bodies[1]}}}
Puck: {{hardware name: SpaceNavigator, driver: {{path: spnav.sock}}, root link: {bodies[2]}}}
Arm: {{hardware name: MTMR, driver: {{pose: local/measured_cp}}, root link: {bodies[3]}}}
Tracker: {{hardware name: any, driver: {{type: ros_generic, pose: /tracker/pose}}, root link: {bodies[0]}}}
Scripted0: {{hardware name: Scripted, driver: {{motion: circle, size: 0.005, force: 5.0}}, root link: {bodies[1]}}}
Scripted1: {{hardware name: Scripted, driver: {{motion: line, size: 0.005, force: 5.0}}, root link: {bodies[2]}}}
Scripted2: {{hardware name: Scripted, driver: {{motion: ellipse, size: 0.002, force: 5.0}}, root link: {bodies[3]}}}
"""
SCENES = {  # launch file, -l, four bodies of it
    "PSM+ECM+MTM+puzzle1": (
        support.COMPAT_LAUNCH,
        "5,6,4,11",
        ["CirclePuzzle", "SquarePuzzle", "TrianglePuzzle", "Torus"],
    ),
    "peg transfer": (support.OWN_LAUNCH, "1", ["left_gripper", "right_gripper", "left_gripper", "right_gripper"]),
}
ROS_HZ, NODE_HZ = 200.0, 100.0
LOADED_S = 5.0
CAP_SYS_NICE, PR_CAPBSET_DROP = 23, 24


class Hardware:
    """What stands in for the eight devices, in a thread: records, packets and messages."""

    def __init__(self, folder):
        self.folder = folder
        for name in ("js0", "js1"):
            os.mkfifo(folder / name)
        self.server = socket.socket(socket.AF_UNIX)
        self.server.bind(str(folder / "spnav.sock"))
        self.server.listen(1)
        self.running = True
        self.threads = [threading.Thread(target=self.nodes), threading.Thread(target=self.ros)]

    def start(self):
        for thread in self.threads:
            thread.start()

    def stop(self):
        self.running = False
        for thread in self.threads:
            thread.join()
        self.server.close()

    def nodes(self):
        pads, puck = [], None
        self.server.settimeout(0.1)
        while self.running and (puck is None or len(pads) < 2):
            try:
                if len(pads) < 2:
                    pads.append(os.open(self.folder / f"js{len(pads)}", os.O_WRONLY | os.O_NONBLOCK))
                elif puck is None:
                    puck, _ = self.server.accept()
            except OSError:  # not opened by the simulator yet
                time.sleep(0.02)
        begin = time.monotonic()
        while self.running:
            angle = 6.0 * (time.monotonic() - begin)
            try:
                for pad in pads:
                    os.write(pad, struct.pack("IhBB", 0, int(8000 * math.sin(angle)), 2, 4))
                puck.sendall(struct.pack("<8i", 0, int(50 * math.sin(angle)), 0, 0, 0, 0, 0, 8))
            except OSError:  # the simulator has ended
                break
            time.sleep(1.0 / NODE_HZ)
        for pad in pads:
            os.close(pad)

    def ros(self):
        import rospy
        from geometry_msgs.msg import PoseStamped

        arm = rospy.Publisher("/MTMR/local/measured_cp", PoseStamped, queue_size=1, tcp_nodelay=True)
        tracker = rospy.Publisher("/tracker/pose", PoseStamped, queue_size=1, tcp_nodelay=True)
        message = PoseStamped()
        message.pose.orientation.w = 1.0
        while self.running:
            message.header.stamp = rospy.Time.now()
            message.pose.position.x = 0.005 * math.sin(message.header.stamp.to_sec() % 1e3)
            for publisher in (arm, tracker):
                publisher.publish(message)
            time.sleep(1.0 / ROS_HZ)
        arm.unregister()
        tracker.unregister()


def without_real_time():
    """In the child: nobody may ask for SCHED_FIFO, root included."""
    ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, CAP_SYS_NICE, 0, 0, 0)
    resource.setrlimit(resource.RLIMIT_RTPRIO, (0, 0))


def measure(scene, fifo, seconds, master):
    """(devices of the last WorldDeviceRates, cycles a second of each, lowest real-time factor of a second)."""
    import rospy

    from ambf_msgs.msg import WorldDeviceRates, WorldRates

    times, factors = [], []
    launch, number, bodies = SCENES[scene]
    with support.scratch() as folder:
        folder = support.Path(folder)
        (folder / "devices.yaml").write_text(FILE.format(bodies=bodies))
        text = launch.read_text().replace("./", f"{launch.parent}/")
        lines = [line for line in text.splitlines() if not line.startswith("input devices config")]
        (folder / "launch.yaml").write_text("\n".join([*lines, "input devices config: devices.yaml", ""]))
        hardware = Hardware(folder)
        command = [support.SIMULATOR, "-g", "false", "--launch_file", folder / "launch.yaml", "-l", number]
        command += ["-n", "8", "-e", "true"]
        simulator = subprocess.Popen(
            list(map(str, command)),
            env=dict(os.environ, ROS_MASTER_URI=master.uri),
            stderr=subprocess.DEVNULL,
            preexec_fn=None if fifo else without_real_time,
        )
        subscribers = [
            rospy.Subscriber("/ambf/env/World/DeviceRates", WorldDeviceRates, times.append),
            rospy.Subscriber("/ambf/env/World/Rates", WorldRates, lambda m: factors.append(m.real_time_factor)),
        ]
        hardware.start()
        try:
            time.sleep(LOADED_S)
            first, counted = len(times), len(factors)
            time.sleep(seconds)
            first, last = times[first], times[-1]
            span = (last.header.stamp - first.header.stamp).to_sec()
            pairs = zip(first.devices, last.devices, strict=True)
            return last.devices, [(b.cycles - a.cycles) / span for a, b in pairs], min(factors[counted:])
        finally:
            for subscriber in subscribers:
                subscriber.unregister()
            simulator.send_signal(signal.SIGINT)
            simulator.wait(20)
            hardware.stop()


def spread(percentiles):
    return " / ".join(f"{1e6 * getattr(percentiles, part):.0f}" for part in ("p50", "p99", "p999", "max"))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--scene", choices=SCENES, help="default: the first one whose files are here")
    options = parser.parse_args()
    scene = options.scene or next(name for name, (launch, _, _) in SCENES.items() if launch.is_file())
    print(f"{support.machine()}, kernel {platform.release()}; {scene}, {options.seconds:g} s")
    master = support.Master()
    os.environ["ROS_MASTER_URI"] = master.uri
    import rospy

    rospy.init_node("bench_devices", anonymous=True, disable_signals=True)
    rows, slow = [], False
    try:
        for fifo in (True, False):
            watch = support.Watch()
            devices, rates, factor = measure(scene, fifo, options.seconds, master)
            busy, stolen = watch.shares()
            name = "SCHED_FIFO" if all(device.real_time_priority for device in devices) else "ordinary"
            print(f"{name}: real-time factor at least {factor:.4f}, processors {busy:.0%} busy, {stolen:.1%} stolen")
            for device, rate in zip(devices, rates, strict=True):
                if not device.connected:
                    raise SystemExit(f"{device.name} is not connected: {device.message}")
                rows.append(
                    [
                        name,
                        device.name,
                        device.driver,
                        f"{rate:.1f}",
                        spread(device.period),
                        spread(device.set_point_age),
                        spread(device.sample_to_force),
                        device.slips,
                        device.faults,
                    ]
                )
            slow = slow or (fifo and min(rates) < 995.0)
    finally:
        master.kill()
    parts = "us p50 / p99 / p99.9 / max"
    head = ["threads", "device", "driver", "cycles/s", f"period, {parts}", f"set-point age, {parts}"]
    head += [f"sample to force, {parts}", "slips", "faults"]
    support.table(rows, head)
    raise SystemExit(1 if slow else 0)


if __name__ == "__main__":
    main()
