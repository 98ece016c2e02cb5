"""Loading and unloading robots while the simulation runs (dissertation Fig. 4.10), and what its physics thread feels.

The original had no way to load or unload at run time; starting it with one robot more takes it about 0.1 s.
"""

import argparse
import os
import time

import support
from harness import Simulator

from ambf_msgs.msg import WorldRates
from ambf_msgs.srv import Load, Unload

WORLD = "/ambf/env/World"
ROBOTS = {
    "kuka (compat)": support.COMPAT / "ambf_models/descriptions/multi-bodies/robots/blender-kuka-lbr-med.yaml",
    "PSM (compat)": support.COMPAT / "ambf_models/descriptions/multi-bodies/robots/blender-psm.yaml",
    "arm7 (ours)": support.ROOT / "ambf_models/descriptions/multi-bodies/robots/arm7.yaml",
}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=20)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    import rospy
    from geometry_msgs.msg import Point, Pose, Quaternion

    rospy.init_node("bench_models", anonymous=True, disable_signals=True, disable_rosout=True)
    rows = []
    try:
        for robot, path in ROBOTS.items():
            if not path.is_file():
                print(f"left out: {robot} ({path} is missing)")
                continue
            with support.scratch() as folder:
                simulator = Simulator(folder, "-l", "0", master_uri=master.uri)
                rates = []
                subscriber = rospy.Subscriber(f"{WORLD}/Rates", WorldRates, rates.append)
                try:
                    for kind in ("Load", "Unload"):
                        rospy.wait_for_service(f"{WORLD}/{kind}", timeout=20)
                    load = rospy.ServiceProxy(f"{WORLD}/Load", Load, persistent=True)
                    unload = rospy.ServiceProxy(f"{WORLD}/Unload", Unload, persistent=True)
                    time.sleep(2.5)
                    quiet = lateness(rates)
                    begin, at, names, loads, unloads = len(rates), time.monotonic(), [], [], []
                    for number in range(options.robots):
                        place = (10.0 * (number % 5), 10.0 + 10.0 * (number // 5))  # m; these robots are large
                        pose = Pose(Point(*place, 0.5), Quaternion(0, 0, 0, 1))
                        answer = load(path=str(path), text="", name_prefix="", pose=pose, check_only=False)
                        if not answer.success:
                            raise SystemExit(answer.message)
                        names.append(answer.model)
                        loads.append(time.monotonic() - at)
                        at = time.monotonic()
                    time.sleep(1.2)
                    during = lateness(rates[begin:])
                    for name in names:
                        at = time.monotonic()
                        if not unload(model=name).success:
                            raise SystemExit(f"{name} was not unloaded")
                        unloads.append(time.monotonic() - at)
                finally:
                    subscriber.unregister()
                    simulator.stop()
            rows.append(
                [
                    robot,
                    f"{1e3 * loads[0]:.0f}",
                    f"{1e3 * sum(loads[1:]) / max(1, len(loads) - 1):.0f}",
                    f"{1e3 * max(loads[1:], default=0):.0f}",
                    f"{1e3 * sum(unloads) / len(unloads):.0f}",
                    f"{1e3 * max(unloads):.0f}",
                    f"{quiet * 1e3:.2f}",
                    f"{during * 1e3:.2f}",
                ]
            )
    finally:
        master.kill()
    print(f"1 to {options.robots} robots, ms each; lateness p99.9 of the physics thread, worst second, ms")
    head = ["robot", "first load", "mean load", "longest", "mean unload", "longest", "late, quiet", "late, loading"]
    support.table(rows, head)


def lateness(rates):
    return max((t.lateness_p999 for r in rates for t in r.threads if t.name == "physics"), default=float("nan"))


if __name__ == "__main__":
    main()
