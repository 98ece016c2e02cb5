"""Input devices: does each keep its rate, and how old are set-points and forces, with all topics up?

Scripted devices move both grippers of the peg-transfer scene (dissertation Fig. 3.19: five devices near 1 kHz). The
target: each at least 995 cycles a second, real-time factor 1 +-0.005.
"""

import argparse
import os
import signal
import subprocess

import support

DEVICE = """
Device{n}:
  hardware name: Scripted
  driver: {{type: scripted, motion: circle, axis: x, size: 0.005, rate: {rate}, hold: 1.0, force: 5.0}}
  haptic gain: {{linear: 50.0, angular: 0.0}}
  root link: {body}
"""


def write_launch(folder, count):
    names = ", ".join(f"Device{n}" for n in range(count))
    blocks = "".join(
        DEVICE.format(n=n, rate=1.0 + 0.1 * n, body=("left_gripper", "right_gripper")[n % 2]) for n in range(count)
    )
    (folder / "devices.yaml").write_text(f"input devices: [{names}]\n{blocks}")
    models = support.ROOT / "ambf_models/descriptions"
    launch = folder / "launch.yaml"
    launch.write_text(
        f"world config: {models}/world/peg_transfer_world.yaml\ncolor config: {models}/color/colors.yaml\n"
        f"input devices config: devices.yaml\nmultibody configs:\n  - {models}/multi-bodies/puzzles/peg_transfer.yaml\n"
    )
    return launch


def measure(count, seconds, master):
    """(last WorldDeviceRates, real-time factor of the last second)."""
    import rospy

    from ambf_msgs.msg import WorldDeviceRates, WorldRates

    newest = {}
    subscribers = [
        rospy.Subscriber("/ambf/env/World/DeviceRates", WorldDeviceRates, lambda m: newest.update(devices=m)),
        rospy.Subscriber("/ambf/env/World/Rates", WorldRates, lambda m: newest.update(world=m)),
    ]
    with support.scratch() as folder:
        launch = write_launch(support.Path(folder), count)
        command = [support.SIMULATOR, "-g", "false", "--launch_file", launch, "-l", "0", "-n", count, "-e", "true"]
        environment = dict(os.environ, ROS_MASTER_URI=master.uri)
        simulator = subprocess.Popen(list(map(str, command)), env=environment, stderr=subprocess.DEVNULL)
        try:
            support.time.sleep(seconds)
            return newest["devices"].devices, newest["world"].real_time_factor
        finally:
            for subscriber in subscribers:
                subscriber.unregister()
            simulator.send_signal(signal.SIGINT)
            simulator.wait(10)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--devices", default="1,2,5,8,15")
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ["ROS_MASTER_URI"] = master.uri
    import rospy

    rospy.init_node("bench_devices", anonymous=True, disable_signals=True)
    rows = []
    try:
        for count in map(int, options.devices.split(",")):
            devices, factor = measure(count, options.seconds, master)

            def worst(what, part, devices=devices):
                return max(1e6 * getattr(getattr(device, what), part) for device in devices)

            def spread(what):
                return " / ".join(f"{worst(what, part):.0f}" for part in ("p50", "p99", "p999", "max"))

            rows.append(
                [
                    count,
                    f"{min(device.rate for device in devices):.0f}",
                    spread("period"),
                    spread("set_point_age"),
                    spread("sample_to_force"),
                    sum(device.slips for device in devices),
                    sum(device.faults for device in devices),
                    f"{factor:.4f}",
                ]
            )
    finally:
        master.kill()
    times = "us p50 / p99 / p99.9 / max"
    support.table(
        rows,
        [
            "devices",
            "slowest, cycles/s",
            f"period, {times}",
            f"set-point age, {times}",
            f"sample to force, {times}",
            "slips",
            "faults",
            "real-time factor",
        ],
    )


if __name__ == "__main__":
    main()
