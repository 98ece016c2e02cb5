"""Strangers attack a simulator, round after round: does it stay as it was, and does everybody else get answers?

A round is an attack by all of attackers.py at once and a rest, after which the simulator holds what it held at the
start. Meanwhile an honest client lists the world and watches its time. With --master-every, the master is killed, too.

    ./dev shell -- python tests/soak/attack.py --seconds 3600

Ends with 1 when memory grew by more than 2 % from the first quarter of the rests to the last, an honest call took a
second, time did not run again within a second of an attack's end, or the simulator ended.
"""

import argparse
import collections
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/acceptance"), str(ROOT / "tests/benchmarks")]
import scenes  # noqa: E402
import support  # noqa: E402
from harness import Master, Simulator, eventually  # noqa: E402

WORLD = "/ambf/env/World"
MEMORY_GROWTH = 0.02  # from the first quarter of the rests to the last
SLOWEST_CALL = 1.0  # s
RECOVERY = 1.0  # s, until the world's time runs again
RUNNING = 0.9  # of real time
WINDOW = 0.3  # s, in which the real-time factor is measured


class Honest:
    """A client that wants an answer all the time, and watches how the world's time goes on."""

    def __init__(self, rospy):
        from ambf_msgs.msg import WorldCmd, WorldState
        from ambf_msgs.srv import List

        self.rospy, self.message_type = rospy, WorldCmd
        self.list = rospy.ServiceProxy(f"{WORLD}/List", List)
        self.calls, self.failed = [], 0
        self.times = collections.deque(maxlen=200)  # (wall, simulated)
        self.subscriber = rospy.Subscriber(f"{WORLD}/State", WorldState, self._on_state)
        self.publishers = []
        self.register()
        self.ending = threading.Event()
        self.thread = threading.Thread(target=self._ask, daemon=True)
        self.thread.start()

    def register(self):
        """At the master that there is now: rospy does not do that again by itself."""
        from std_msgs.msg import Empty

        for publisher in self.publishers:
            publisher.unregister()
        self.publishers = [
            self.rospy.Publisher(f"{WORLD}/Command", self.message_type, queue_size=10),
            self.rospy.Publisher(f"{WORLD}/Command/Reset", Empty, queue_size=1),
        ]
        eventually(lambda: all(p.get_num_connections() for p in self.publishers), 10.0, "the honest client is heard")

    def release(self):
        """Ends the last throttling, and puts everything back."""
        command, reset = self.publishers
        command.publish(self.message_type(False, False, 0))
        reset.publish()

    def _on_state(self, message):
        self.times.append((time.monotonic(), message.sim_time))

    def _ask(self):
        while not self.ending.wait(0.05):
            begin = time.monotonic()
            try:
                self.list(model="none of that name")
                self.calls.append(time.monotonic() - begin)
            except (self.rospy.ServiceException, OSError):
                self.failed += 1  # while the master is gone

    def real_time_factor(self):
        now = time.monotonic()
        recent = [entry for entry in list(self.times) if now - entry[0] < WINDOW]
        if len(recent) < 3 or now - recent[-1][0] > WINDOW / 2:
            return 0.0
        (begin, first), (end, last) = recent[0], recent[-1]
        return (last - first) / (end - begin)

    def close(self):
        self.ending.set()
        self.thread.join(5.0)
        self.subscriber.unregister()


class Attack:
    def __init__(self, folder, master, seed):
        import rospy

        self.master, self.seed = master, seed
        self.simulator = Simulator(folder, "--launch_file", scenes.write(folder), "-l", "0", master_uri=master.uri)
        eventually(lambda: "/ambf/env/Box/Command" in master.names(), 30.0, "the topics")
        rospy.wait_for_service(f"{WORLD}/List", timeout=30)
        self.honest = Honest(rospy)
        self.counts = collections.Counter()
        self.rests, self.recoveries, self.faults = [], [], []
        eventually(lambda: self.honest.real_time_factor() > RUNNING, 20.0, "the world's time runs")

    def round(self, seconds):
        command = [sys.executable, str(Path(__file__).with_name("attackers.py")), str(seconds), str(self.seed)]
        self.seed += 1
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds + 60)
        if done.returncode == 0:
            self.counts.update(json.loads(done.stdout.splitlines()[-1]))
        elif self.simulator.running():
            self.faults.append(f"the attackers ended with {done.returncode}: {done.stderr[-500:]}")
        self.recover()

    def recover(self):
        """An attack has ended: the last throttling is released, what was thrown about is put back."""
        begin = time.monotonic()
        self.honest.release()
        while self.honest.real_time_factor() < RUNNING and time.monotonic() - begin < 30.0:
            time.sleep(0.01)
        # The window that shows it lies behind.
        self.recoveries.append(max(0.0, time.monotonic() - begin - WINDOW))
        time.sleep(1.0)
        if not self.simulator.running():
            self.faults.append(f"the simulator ended with {self.simulator.process.returncode}")
        else:
            self.rests.append(support.process_numbers(self.simulator.pid))

    def restart_master(self):
        self.master.kill()
        time.sleep(0.5)
        self.master.start()
        eventually(lambda: "/ambf/env/Box/Command" in self.master.names(), 10.0, "all topics are back")
        self.honest.register()
        self.counts["master restarts"] += 1

    def run(self, seconds, attack_seconds, master_every):
        begin = reported = master_due = time.monotonic()
        master_due += master_every
        while time.monotonic() - begin < seconds and not self.faults:
            self.round(attack_seconds)
            if self.rests and time.monotonic() - reported > max(10.0, seconds / 60):
                # Each minute of an hour: whether memory still grows, or has come to its level, and which memory it is.
                reported = time.monotonic()
                last = self.rests[-1]
                print(
                    f"{reported - begin:7.0f} s, {len(self.rests)} rounds: {last['memory']:.1f} MB, of it "
                    f"{last['heap']:.1f} MB no file's; slowest call so far {max(self.honest.calls):.2f} s",
                    flush=True,
                )
            if time.monotonic() > master_due:
                self.restart_master()
                master_due = time.monotonic() + master_every
        self.honest.close()

    def figures(self):
        """What was measured. memory: MB in the first and the last quarter of the rests."""
        quarter = max(1, len(self.rests) // 4)
        parts = (self.rests[:quarter], self.rests[-quarter:])
        return {
            "memory": [statistics.median(rest["memory"] for rest in part) for part in parts],
            "threads": [statistics.median(rest["threads"] for rest in part) for part in parts],
            "files": [statistics.median(rest["files"] for rest in part) for part in parts],
            "slowest call": max(self.honest.calls),
            "slowest recovery": max(self.recoveries),
        }

    def verdict(self):
        """What is wrong, as lines; prints what was measured."""
        faults = list(self.faults)
        print(", ".join(f"{count} {name}" for name, count in sorted(self.counts.items())))
        if len(self.rests) < 4:
            return [*faults, f"too few rounds ({len(self.rests)}) to judge growth: let it run for longer"]
        figures = self.figures()
        calls = len(self.honest.calls)
        print(f"{len(self.rests)} rounds, {calls} honest calls ({self.honest.failed} without a master): {figures}")
        before, after = figures["memory"]
        if after > before * (1.0 + MEMORY_GROWTH):
            faults.append(f"memory grew from {before:.1f} to {after:.1f} MB")
        if figures["slowest call"] > SLOWEST_CALL:
            faults.append(f"an honest call took {figures['slowest call']:.2f} s")
        if figures["slowest recovery"] > RECOVERY:
            faults.append(f"time ran again {figures['slowest recovery']:.2f} s after an attack")
        return faults

    def close(self):
        self.honest.close()
        return self.simulator.stop() if self.simulator.running() else (self.simulator.process.returncode, 0.0)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--attack-seconds", type=float, default=5.0, help="of each round")
    parser.add_argument("--master-every", type=float, default=60.0, help="s between kills of the master")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print(support.machine())
    master = Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    import rospy

    rospy.init_node("attack", anonymous=True, disable_signals=True, disable_rosout=True)
    folder = Path(tempfile.mkdtemp(prefix="ambf-attack-"))
    attack = None
    try:
        attack = Attack(folder, master, options.seed)
        attack.run(options.seconds, options.attack_seconds, options.master_every)
        faults = attack.verdict()
        code, seconds = attack.close()
        print(f"ended with {code} in {seconds:.2f} s")
        faults += [f"exit code {code}"] if code != 0 else []
    finally:
        if attack is not None:
            attack.close()
        master.kill()
    for fault in faults:
        print("FAULT:", fault)
    if faults:
        print("the simulator's log is in", folder)
    else:
        shutil.rmtree(folder)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
