"""Windows drawn by the processor, under a virtual display: pictures a second, memory, and whether real time holds.

The target: 1024 x 512, at the quality the program picks itself, twice the pictures of the original (13 with
PSM+ECM+MTM, 22 with a box, 14 with 300 cubes), the real-time factor 1, less than 220 MB. Needs Xvfb and a ROS master.
"""

import argparse
import os
import shutil
import signal
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import support

BOX = """bodies: [BODY Box]
BODY Box: {name: Box, mass: 1.0, shape: BOX, geometry: {x: 0.2, y: 0.2, z: 0.2}, collision shape: BOX,
  collision geometry: {x: 0.2, y: 0.2, z: 0.2},
  location: {position: {x: 0.0, y: 0.0, z: 0.3}, orientation: {r: 0.0, p: 0.0, y: 0.0}}}
"""
SETTLING_S = 6.0  # loading, and the time in which the quality is found


def memory_mb(pid):
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024


def measure(rospy, arguments, seconds):
    from ambf_msgs.msg import WorldRates, WorldState

    simulator = subprocess.Popen(
        [support.SIMULATOR, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        time.sleep(SETTLING_S)
        pictures, factors = [], []
        listeners = [
            rospy.Subscriber("/ambf/env/World/State", WorldState, lambda m: pictures.append(m.graphics_loop_freq)),
            rospy.Subscriber("/ambf/env/World/Rates", WorldRates, lambda m: factors.append(m.real_time_factor)),
        ]
        time.sleep(seconds)
        memory = memory_mb(simulator.pid)
        for listener in listeners:
            listener.unregister()
        return statistics.median(pictures or [0]), min(factors or [0.0]), memory
    finally:
        simulator.send_signal(signal.SIGINT)
        simulator.wait(20)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--only", default="", help="scenes whose name contains this")
    options = parser.parse_args()
    print(support.machine())
    if shutil.which("Xvfb") is None:
        print("left out: there is no Xvfb")
        return
    master = support.Master()
    display = f":{200 + os.getpid() % 1000}"
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1", DISPLAY=display)
    server = subprocess.Popen(["Xvfb", display, "-screen", "0", "1280x1100x24"], stderr=subprocess.DEVNULL)
    try:
        time.sleep(1.0)
        import rospy

        rospy.init_node("bench_windows", anonymous=True, disable_signals=True)
        rows = []
        with tempfile.TemporaryDirectory() as folder:
            box = Path(folder) / "box.yaml"
            box.write_text(BOX)
            known = support.available(["PSM+ECM+MTM", "our PSM+ECM+MTM", "300 cubes"])
            scenes = {name: support.SCENES[name] for name in known}
            scenes["a box"] = ("-a", box)
            scenes["peg transfer"] = ("-l", "1")
            two_views = support.ROOT / "ambf_models/descriptions/launch_two_views.yaml"
            scenes["peg transfer, two windows"] = ("--launch_file", two_views)
            if support.available(["PSM+ECM+MTM"]):
                robots = support.COMPAT / "ambf_models/descriptions/multi-bodies/robots"
                files = ",".join(str(robots / f"blender-{name}.yaml") for name in ("psm", "ecm", "mtm"))
                scenes["PSM+ECM+MTM in our room, two windows"] = ("--launch_file", two_views, "-a", files)
            for name, arguments in ((n, a) for n, a in scenes.items() if options.only in n):
                pictures, factor, memory = measure(rospy, arguments, options.seconds)
                rows.append([name, f"{pictures:.0f}", f"{factor:.4f}", f"{memory:.0f}"])
        support.table(rows, ["scene", "pictures/s", "lowest real-time factor", "MB"])
    finally:
        server.kill()
        master.kill()


if __name__ == "__main__":
    main()
