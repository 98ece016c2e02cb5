"""The process that reads foreign meshes is killed again and again: what the physics thread feels, and what is left.

Rounds take turns: a file that is read, one whose reader is killed, one that asks for gigabytes, one that is malformed.
Bars: one error each, the next file loads, nothing is left, lateness p99.9 within 1.5 of that of the quiet part.
"""

import argparse
import os
import signal
import threading
import time
from pathlib import Path

import support
from bench_models import lateness
from harness import Simulator

from ambf_msgs.msg import Diagnostic, WorldRates
from ambf_msgs.srv import Load, Unload

WORLD = "/ambf/env/World"
WEDGE = "OFF\n# {number}\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
HUGE = "OFF\n# {number}\n700000000 1 0\n0 0 0\n3 0 0 0\n"
MALFORMED = "OFF\n# {number}\n4 4 0\n0 0 zero\n"
LONG = "OFF\n# {number}\n200000 1 0\n" + "0 0 0\n" * 200000 + "3 0 1 2\n"  # long enough to be hit


def readers_of(parent):
    """Process ids of the readers that the simulator has started."""
    found = []
    for task in Path(f"/proc/{parent}/task").iterdir():
        try:
            found += [int(child) for child in (task / "children").read_text().split()]
        except OSError:  # that thread has ended
            continue
    return found


class Killer(threading.Thread):
    """While `armed`, kills each reader that it sees."""

    def __init__(self, parent):
        super().__init__(daemon=True)
        self.parent, self.armed, self.running, self.killed = parent, False, True, set()

    def run(self):
        while self.running:
            if not self.armed:
                time.sleep(0.001)
                continue
            for process in readers_of(self.parent):
                try:
                    os.kill(process, signal.SIGKILL)
                    self.killed.add(process)
                except ProcessLookupError:
                    pass


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=1000)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    import rospy
    from geometry_msgs.msg import Pose, Quaternion

    rospy.init_node("bench_readers", anonymous=True, disable_signals=True, disable_rosout=True)
    pose = Pose(orientation=Quaternion(0, 0, 0, 1))
    try:
        with support.scratch() as folder:
            simulator = Simulator(folder, "-l", "0", master_uri=master.uri)
            process = simulator.process.pid
            rates = []
            rospy.Subscriber(f"{WORLD}/Rates", WorldRates, rates.append)
            for kind in ("Load", "Unload"):
                rospy.wait_for_service(f"{WORLD}/{kind}", timeout=20)
            load = rospy.ServiceProxy(f"{WORLD}/Load", Load, persistent=True)
            unload = rospy.ServiceProxy(f"{WORLD}/Unload", Unload, persistent=True)
            empty = "namespace: /ambf/env/\nbodies: []\n"  # once, so that the services' connections are open
            unload(model=load(path="", text=empty, name_prefix="", pose=pose, check_only=False).model)
            killer = Killer(process)
            killer.start()
            time.sleep(12.0)
            quiet = [lateness([each]) for each in rates[2:]]
            files, begin, wrong = len(os.listdir(f"/proc/{process}/fd")), len(rates), []
            kinds = (("read", WEDGE), ("killed", LONG), ("huge", HUGE), ("malformed", MALFORMED))
            for number in range(options.rounds):
                kind, content = kinds[number % len(kinds)]
                mesh = Path(folder) / f"mesh{number}.off"
                mesh.write_text(content.format(number=number))
                text = f"namespace: /ambf/env/\nbodies: [B]\nB: {{name: B, mass: 1, mesh: {mesh}}}\n"
                killer.armed = kind == "killed"
                answer = load(path="", text=text, name_prefix="", pose=pose, check_only=False)
                killer.armed = False
                mesh.unlink()
                errors = [each.message for each in answer.diagnostics if each.severity == Diagnostic.ERROR]
                if len(errors) != (0 if kind == "read" else 1):
                    wrong.append((kind, errors))
                unload(model=answer.model)
            time.sleep(3.0)
            during = [lateness([each]) for each in rates[begin:]]
            left, files_after = len(readers_of(process)), len(os.listdir(f"/proc/{process}/fd"))
            killer.running = False
            simulator.stop()
    finally:
        master.kill()
    print(f"{options.rounds} rounds, {len(killer.killed)} readers killed")
    print(f"otherwise than wanted: {len(wrong)} {wrong[:3]}")
    print(f"readers left: {left}; open files {files} before, {files_after} after")
    rows = []
    for name, seconds in (("quiet", quiet), ("rounds", during)):
        ordered = sorted(seconds)
        rows.append([name, str(len(ordered)), f"{1e3 * ordered[len(ordered) // 2]:.3f}", f"{1e3 * ordered[-1]:.3f}"])
    support.table(rows, ["part", "reports", "p99.9, median report, ms", "worst report, ms"])


if __name__ == "__main__":
    main()
