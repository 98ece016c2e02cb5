"""Hours of use in one go: does a simulator that never ends stay as it was?

Loads and unloads models, removes single bodies, sends commands, keeps and restores snapshots, kills and restarts the
ROS master, and meanwhile watches memory, threads, open files and the real-time factor. At every pause the simulator
holds what it held at the start, so that what grows from pause to pause leaks.

    ./dev shell -- python tests/soak/soak.py --seconds 36000

Ends with 1 when something grew, was answered wrongly or fell behind; the log of the simulator is then kept.
"""

import argparse
import os
import random
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/acceptance"), str(ROOT / "tests/benchmarks")]
import support  # noqa: E402
from harness import Master, Simulator, eventually  # noqa: E402

MODELS = ROOT / "ambf_models/descriptions/multi-bodies"
LOADED = ("robots/arm7.yaml", "grippers/two_finger.yaml", "mechanisms/four_bar.yaml", "vehicles/toy_car.yaml")
WORLD = "/ambf/env/World"
# Between the second quarter of the run and the last. The allocator's heaps grow in steps of this size and are kept.
MEMORY_GROWTH = 6.0  # MB


class Soak:
    def __init__(self, folder, master, seed):
        import rospy

        from ambf_msgs.msg import WorldRates
        from ambf_msgs.srv import List, Load, Remove, Restore, Snapshot, Unload

        self.rospy, self.master, self.random = rospy, master, random.Random(seed)
        expected = [r"the master at .* does not answer"]
        self.simulator = Simulator(folder, "-l", "1", master_uri=master.uri, allowed=expected)
        self.services = {}
        for kind in (List, Load, Remove, Restore, Snapshot, Unload):
            name = f"{WORLD}/{kind.__name__}"
            rospy.wait_for_service(name, timeout=30)
            self.services[kind.__name__] = rospy.ServiceProxy(name, kind)
        self.rates = []
        self.subscriber = rospy.Subscriber(f"{WORLD}/Rates", WorldRates, self._on_rates)
        self.samples, self.counts, self.faults = [], {}, []
        self.at_start = self.objects()
        self.topics = self.expected_topics()

    def _on_rates(self, message):
        self.rates.append(message.real_time_factor)

    def call(self, service, **request):
        answer = self.services[service](**request)
        self.counts[service] = self.counts.get(service, 0) + 1
        if not answer.success:
            self.faults.append(f"{service} {request}: {answer.message}")
        return answer

    def objects(self):
        return sorted(o.name for o in self.services["List"](model="").objects)

    def expected_topics(self):
        eventually(lambda: len(self.master.names()) > len(self.at_start), 30, "the topics")
        time.sleep(0.5)
        return self.master.names()

    def pose(self):
        from geometry_msgs.msg import Point, Pose, Quaternion

        x, y = (self.random.uniform(-3.0, 3.0) for _ in range(2))
        return Pose(Point(x, y, self.random.uniform(0.5, 2.0)), Quaternion(0, 0, 0, 1))

    def command(self, name):
        """Pushes a body for a moment, as a client that comes and goes."""
        from ambf_msgs.msg import RigidBodyCmd

        publisher = self.rospy.Publisher(f"{name}/Command", RigidBodyCmd, queue_size=10)
        deadline = time.monotonic() + 5.0
        while publisher.get_num_connections() == 0 and time.monotonic() < deadline:
            time.sleep(0.005)
        if publisher.get_num_connections() == 0:
            self.faults.append(f"{name}/Command is not heard")
        command = RigidBodyCmd()
        command.cartesian_cmd_type = RigidBodyCmd.TYPE_FORCE
        for _ in range(10):
            command.wrench.force.x, command.wrench.force.z = (self.random.uniform(-1.0, 1.0) for _ in range(2))
            publisher.publish(command)
            time.sleep(0.002)
        publisher.unregister()
        self.counts["commands"] = self.counts.get("commands", 0) + 10

    def cycle(self):
        """Models come, are pushed, lose a body, and go."""
        models = []
        for _ in range(self.random.randint(1, 3)):
            path = MODELS / self.random.choice(LOADED)
            answer = self.call("Load", path=str(path), text="", name_prefix="", pose=self.pose(), check_only=False)
            models.append(answer)
        for answer in models:
            self.command(self.random.choice(list(answer.objects)))
        if self.random.random() < 0.3:
            self.call("Snapshot", name="soak", path="")
            self.call("Restore", name="soak", path="")
        for answer in models:
            if self.random.random() < 0.5:
                self.call("Remove", name=self.random.choice(list(answer.objects)))
        for answer in models:
            self.call("Unload", model=answer.model)

    def restart_master(self):
        self.master.kill()
        time.sleep(self.random.uniform(0.0, 1.5))
        self.master.start()
        eventually(lambda: self.topics <= self.master.names(), 10.0, "all topics after the master's restart")
        self.counts["master restarts"] = self.counts.get("master restarts", 0) + 1

    def pause(self):
        """Everything is as at the start: what is measured now must not grow."""
        if self.objects() != self.at_start:
            self.faults.append(f"objects are left over or lost: {set(self.objects()) ^ set(self.at_start)}")
        eventually(lambda: self.master.names() == self.topics, 10.0, "topics as at the start")
        time.sleep(0.3)
        self.samples.append({"time": time.monotonic(), **support.process_numbers(self.simulator.pid)})

    def run(self, seconds, master_every):
        begin = reported = master_due = time.monotonic()
        master_due += master_every
        cycles = 0
        while time.monotonic() - begin < seconds and not self.faults:
            self.cycle()
            cycles += 1
            if time.monotonic() > master_due:
                self.restart_master()
                master_due = time.monotonic() + master_every
            if cycles % 3 == 0:
                self.pause()
            if time.monotonic() - reported > max(10.0, seconds / 60):
                reported = time.monotonic()
                print(f"{reported - begin:7.0f} s, {cycles} cycles: {self.state()}", flush=True)
        self.counts["cycles"] = cycles

    def state(self):
        if not self.samples:
            return "not measured yet"
        last, rates = self.samples[-1], self.rates[-20:] or [float("nan")]
        return (
            f"{last['memory']:.1f} MB, {last['threads']} threads, {last['files']} files, real-time factor "
            f"{statistics.median(rates):.3f}"
        )

    def verdict(self):
        """What is wrong, as lines; prints what was measured."""
        faults = list(self.faults)
        print(", ".join(f"{count} {name}" for name, count in sorted(self.counts.items())))
        quarter = len(self.samples) // 4
        if quarter < 3:
            return [*faults, f"too few pauses ({len(self.samples)}) to judge growth: let it run for longer"]
        early, late = self.samples[quarter : 2 * quarter], self.samples[-quarter:]
        for what, allowed in (("memory", MEMORY_GROWTH), ("threads", 1), ("files", 3)):
            before, after = (statistics.median(s[what] for s in part) for part in (early, late))
            print(f"{what}: first {self.samples[0][what]:.1f}, second quarter {before:.1f}, last quarter {after:.1f}")
            if after - before > allowed:
                faults.append(f"{what} grew from {before:.1f} to {after:.1f}")
        print(f"real-time factor: median {statistics.median(self.rates):.4f}, lowest second {min(self.rates):.4f}")
        if statistics.median(self.rates) < 0.9:
            faults.append("it fell behind the wall clock")
        faults += self.simulator.complaints()
        return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--master-every", type=float, default=20.0, help="s between restarts of the master")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print(support.machine())
    master = Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    import rospy

    rospy.init_node("soak", anonymous=True, disable_signals=True, disable_rosout=True)
    folder = Path(tempfile.mkdtemp(prefix="ambf-soak-"))
    soak = None
    try:
        soak = Soak(folder, master, options.seed)
        soak.run(options.seconds, options.master_every)
        soak.subscriber.unregister()
        faults = soak.verdict()
        code, seconds = soak.simulator.stop()
        print(f"ended with {code} in {seconds:.2f} s")
        faults += [f"exit code {code}"] if code != 0 else []
    finally:
        if soak is not None and soak.simulator.running():
            soak.simulator.stop()
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
