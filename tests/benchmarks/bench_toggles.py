"""Throttled stepping through ROS (dissertation Fig. 3.18): 10^5 toggles at random times must run exactly their steps.

Then the closed loop that learning uses: toggle, wait for the state of the step, toggle again (the original: about 490 a
second, p50 2.0 ms). Ends with 1 when a toggle was lost.
"""

import argparse
import os
import random
import statistics
import sys
import threading
import time

import support
from harness import Simulator, eventually

WORLD = "/ambf/env/World"


class Clock:
    def __init__(self):
        import rospy

        from ambf_msgs.msg import WorldCmd, WorldState

        self.kind, self.level, self.step = WorldCmd, False, -1
        self.came = threading.Condition()
        self.talk = rospy.Publisher(f"{WORLD}/Command", WorldCmd, queue_size=100_000, tcp_nodelay=True)
        self.state = rospy.Subscriber(f"{WORLD}/State", WorldState, self._on_state, tcp_nodelay=True)
        eventually(lambda: self.talk.get_num_connections() > 0 and self.step > 0, 20, "the world's topics")

    def _on_state(self, message):
        with self.came:
            self.step = message.sim_step
            self.came.notify_all()

    def toggle(self, steps):
        self.level = not self.level
        self.talk.publish(self.kind(True, self.level, steps))

    def wait(self, step):
        with self.came:
            if not self.came.wait_for(lambda: self.step >= step, 10.0):
                raise SystemExit(f"step {step} was not run within 10 s, {self.step} was")

    def hold(self):
        """Stops the world; the step at which it waits."""
        self.talk.publish(self.kind(True, self.level, 1))
        time.sleep(0.5)
        return self.step


def open_loop(clock, toggles, rate, random_):
    """Toggles at random times, without looking: (steps granted, steps run, toggles a second)."""
    first, granted, begin = clock.hold(), 0, time.monotonic()
    due = begin
    for _ in range(toggles):
        steps = random_.choice((1, 1, 1, 2, 5))
        granted += steps
        clock.toggle(steps)
        due += random_.expovariate(rate)
        while (ahead := due - time.monotonic()) > 2e-4:
            time.sleep(ahead)
    seconds = time.monotonic() - begin
    last = -1
    while clock.step != last:
        last = clock.step
        time.sleep(0.5)
    return granted, clock.step - first, toggles / seconds


def closed_loop(clock, toggles, steps):
    """(toggles a second, ms p50, ms p95)"""
    step, times, begin = clock.hold(), [], time.monotonic()
    for _ in range(toggles):
        sent = time.monotonic()
        step += steps
        clock.toggle(steps)
        clock.wait(step)
        times.append((time.monotonic() - sent) * 1e3)
    times.sort()
    return toggles / (time.monotonic() - begin), statistics.median(times), times[int(0.95 * len(times))]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--toggles", type=int, default=100_000)
    parser.add_argument("--rate", type=float, default=2000.0, help="toggles a second, at random times")
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    import rospy

    rospy.init_node("bench_toggles", anonymous=True, disable_signals=True, disable_rosout=True)
    lost = 0
    try:
        with support.scratch() as folder:
            free = ("-t", "1", "-p", "100000", "-s", "100")
            simulator = Simulator(folder, *free, "-l", "0", master_uri=master.uri)
            try:
                clock = Clock()
                granted, run, rate = open_loop(clock, options.toggles, options.rate, random.Random(1))
                lost = granted - run
                print(f"open loop: {options.toggles} toggles at {rate:.0f}/s, {granted} steps granted, {run} run")
                rows = []
                for steps, original in ((1, "488, 2.0 / 2.2"), (10, "375, 2.0 / 3.7"), (50, "250, 3.0 / 4.3")):
                    speed, p50, p95 = closed_loop(clock, max(100, options.toggles // 50), steps)
                    rows.append([steps, f"{speed:.0f}", f"{speed * steps:.0f}", f"{p50:.2f} / {p95:.2f}", original])
                print("closed loop (the original: its PSM, fast physics)")
                head = ["steps a toggle", "toggles/s", "steps/s", "ms p50 / p95", "original"]
                support.table(rows, head)
            finally:
                simulator.stop()
    finally:
        master.kill()
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
