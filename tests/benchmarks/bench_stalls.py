"""Random stalls (dissertation Fig. 3.3): the whole program is stopped for 1 to 15 ms, again and again.

Between stalls simulated and wall time must differ by less than one step, since what was missed is made up for at once;
stalls longer than what the simulation may catch up in one turn are given up, counted, and never cause a spiral.
"""

import argparse
import os
import random
import signal
import statistics
import time

import support
from harness import Simulator, eventually


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0)
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    import rospy

    from ambf_msgs.msg import WorldRates, WorldState

    rospy.init_node("bench_stalls", anonymous=True, disable_signals=True, disable_rosout=True)
    random_ = random.Random(1)
    rows = []
    try:
        with support.scratch() as folder:
            for label, shortest, longest in (
                ("none", 0, 0),
                ("1 to 15 ms", 1e-3, 15e-3),
                ("50 to 200 ms", 50e-3, 200e-3),
            ):
                simulator = Simulator(folder, "-l", "1", master_uri=master.uri)
                states, rates = [], []
                listeners = [
                    rospy.Subscriber("/ambf/env/World/State", WorldState, states.append),
                    rospy.Subscriber("/ambf/env/World/Rates", WorldRates, rates.append),
                ]
                try:
                    eventually(lambda states=states, rates=rates: states and rates, 20, "the world's topics")
                    time.sleep(1.0)
                    states.clear()
                    given_up, stalls = rates[-1].sub_steps_given_up, 0
                    end = time.monotonic() + options.seconds
                    while time.monotonic() < end:
                        time.sleep(random_.uniform(0.05, 0.4))
                        if longest > 0:
                            os.kill(simulator.pid, signal.SIGSTOP)
                            time.sleep(random_.uniform(shortest, longest))
                            os.kill(simulator.pid, signal.SIGCONT)
                            stalls += 1
                    time.sleep(1.5)
                    given_up = rates[-1].sub_steps_given_up - given_up
                    gaps = [1e3 * (s.wall_time - s.sim_time) for s in states]  # ms
                    drift = gaps[-1] - gaps[0] - given_up * 1e3 * rates[-1].fixed_time_step
                    jitter = [abs(b - a) for a, b in zip(gaps, gaps[1:], strict=False)]
                    rows.append(
                        [
                            label,
                            stalls,
                            given_up,
                            f"{gaps[-1] - gaps[0]:.2f}",
                            f"{drift:.2f}",
                            f"{statistics.median(jitter):.3f}",
                            f"{rates[-1].real_time_factor:.4f}",
                        ]
                    )
                finally:
                    for listener in listeners:
                        listener.unregister()
                    simulator.stop()
    finally:
        master.kill()
    head = [
        "stalls",
        "how many",
        "steps given up",
        "wall - sim ms",
        "of it unexplained",
        "jitter ms p50",
        "factor after",
    ]
    support.table(rows, head)


if __name__ == "__main__":
    main()
