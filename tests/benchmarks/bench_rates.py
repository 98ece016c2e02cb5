"""The dissertation's Fig. 3.20 with the whole program: an ellipse (Eq. 3.10) at rates of the physics thread (-p) from
1000 to 10 Hz, with one and two devices on one tool.

Prints the rms distance of the tool from its reference, and the largest force that a hand gets, as the devices' threads
see them. The target: rms at 50 Hz at most 1.2 times that at 1 kHz, stable to 10 Hz. The same without clocks and ROS:
ambf_device_sessions_tests --gtest_filter='Rates.*' (docs/effectors.md).
"""

import argparse
import math
import os
import signal
import subprocess
import time

import support

# An iteration of 100 ms has 100 steps.
WORLD = """
namespace: /ambf/env/
max iterations: 100
gravity: {x: 0, y: 0, z: 0}
"""
TOOL = """
bodies: [BODY tool]
namespace: /ambf/env/
BODY tool:
  {{name: tool, mass: {mass}, inertia: {{ix: 0.001, iy: 0.001, iz: 0.001}}, gravity: {{x: 0, y: 0, z: 0}},
  damping: {{linear: 0, angular: 0}}, location: {{position: {{x: 0, y: 0, z: 1}}}},
  collision shape: SPHERE, collision geometry: {{radius: 0.02}}}}
"""
DEVICES = """
input devices: [Device0, Device1]
Device0: &device
  hardware name: Scripted
  driver: {motion: ellipse, size: 0.02, rate: 4.0, force: 10.0}
  controller gain: {linear: {P: 500, D: 10}, angular: {P: 0.3, D: 0.006}}
  haptic gain: {linear: 0.03, angular: 0}
  haptic gain kind: ratio
  workspace scaling: 5
  ramp: 0.1
  root link: tool
Device1: *device
"""
RATES_HZ = (1000, 250, 100, 50, 25, 10)


def norm(a, b=None):
    return math.hypot(a.x - (b.x if b else 0.0), a.y - (b.y if b else 0.0), a.z - (b.z if b else 0.0))


def measure(mass, count, rate, seconds, master):
    """(rms distance in m, largest force on the first hand in N)."""
    import rospy

    from ambf_msgs.msg import DeviceMapping

    seen = []
    with support.scratch() as folder:
        folder = support.Path(folder)
        (folder / "tool.yaml").write_text(TOOL.format(mass=mass))
        (folder / "devices.yaml").write_text(DEVICES)
        (folder / "world.yaml").write_text(WORLD)
        launch = "world config: world.yaml\ninput devices config: devices.yaml\nmultibody configs: [tool.yaml]\n"
        (folder / "launch.yaml").write_text(launch)
        command = [support.SIMULATOR, "-g", "false", "--launch_file", folder / "launch.yaml", "-l", "0"]
        command += ["-n", count, "-e", "true", "-p", rate]
        simulator = subprocess.Popen(
            list(map(str, command)), env=dict(os.environ, ROS_MASTER_URI=master.uri), stderr=subprocess.DEVNULL
        )
        topic = "/ambf/env/physical_device_0/Device0/Mapping"
        subscriber = rospy.Subscriber(topic, DeviceMapping, seen.append, tcp_nodelay=True)
        try:
            while not any(message.engaged for message in seen[-1:]):
                time.sleep(0.1)
            time.sleep(1.0)
            at = len(seen)
            time.sleep(seconds)
            messages = seen[at:]
        finally:
            subscriber.unregister()
            simulator.send_signal(signal.SIGINT)
            simulator.wait(20)
    squares = [norm(each.T_world_ref.position, each.T_world_sde.position) ** 2 for each in messages]
    return math.sqrt(sum(squares) / len(squares)), max(norm(each.wrench_u_wanted.force) for each in messages)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=4.0)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ["ROS_MASTER_URI"] = master.uri
    import rospy

    rospy.init_node("bench_rates", anonymous=True, disable_signals=True)
    rows, missed = [], False
    try:
        for mass in (1.0, 0.1):
            for count in (1, 2):
                found = {rate: measure(mass, count, rate, options.seconds, master) for rate in RATES_HZ}
                missed = missed or found[50][0] > 1.2 * found[1000][0] or found[10][0] > 0.1
                cells = [f"{1e3 * rms:.2f} / {force:.3f}" for rms, force in found.values()]
                rows.append([f"{mass:g} kg, {count} device{'s' if count > 1 else ''}", *cells])
    finally:
        master.kill()
    support.table(rows, ["rms mm / largest force N at", *(f"{rate} Hz" for rate in RATES_HZ)])
    raise SystemExit(1 if missed else 0)


if __name__ == "__main__":
    main()
