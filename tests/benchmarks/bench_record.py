"""Which recorder loses messages? Ours, rosbag record (C++) and rosbag's Python writer, on topics of 1 kHz each.

A loss is a gap in header.seq, which the simulator's publishers count up; it is told apart from steps that the simulator
itself did not publish. "held up" stops the recorder for a second in the middle. Ends with 1 when ours lost one.
"""

import argparse
import contextlib
import os
import signal
import struct
import subprocess
import sys
import time
from pathlib import Path

import support
from harness import Simulator, eventually
from scenes import cubes, write

sys.path.insert(0, str(support.ROOT / "ambf_client_py"))

# A recorder as one would write it in Python.
PLAIN = """
import sys, threading, rospy, rosbag
rospy.init_node("plain", anonymous=True, disable_rosout=True)
bag, lock = rosbag.Bag(sys.argv[1], "w"), threading.Lock()
import roslib.message
from ambf_msgs.msg import RigidBodyState
def take(message, topic):
    with lock:
        bag.write(topic, message)
subscribers = [rospy.Subscriber(t, RigidBodyState, take, t, queue_size=100, tcp_nodelay=True) for t in sys.argv[2:]]
rospy.spin()
with lock:
    bag.close()
"""


def cpu_seconds(pid):
    numbers = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(numbers[11]) + int(numbers[12])) / os.sysconf("SC_CLK_TCK")


class Ours:
    name = "ambf_tools.record"

    def __init__(self, path, topics):
        from ambf_tools.record import Recorder

        self.recorder = Recorder(path, topics, min_free_bytes=0).start()
        self.recorder.ready(len(topics), 30)
        self.pid = self.recorder.pid

    def stop(self):
        self.recorder.stop()


class Child:
    def __init__(self, command, wait):
        # Programs started by scripts may ignore SIGINT, which ends these two.
        reset = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.default_int_handler)}
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, start_new_session=True, **reset)
        time.sleep(wait)
        self.pid = self.process.pid

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.process.wait(60)
        self.process.kill()
        self.process.wait()


class RosbagRecord(Child):
    name = "rosbag record, unlimited buffer"

    def __init__(self, path, topics):
        super().__init__(["/usr/lib/rosbag/record", "-b", "0", "-O", str(path), *topics], 4.0)


class RosbagPython(Child):
    name = "rosbag in Python"

    def __init__(self, path, topics):
        super().__init__([sys.executable, "-c", PLAIN, str(path), *topics], 4.0)


def gaps(path):
    """(messages, lost) by header.seq"""
    import rosbag

    count, lost, last = 0, 0, {}
    with rosbag.Bag(str(path)) as bag:
        for topic, raw, _ in bag.read_messages(raw=True):
            (sequence,) = struct.unpack_from("<I", raw[1], 0)
            count += 1
            lost += max(0, sequence - last.get(topic, sequence) - 1)
            last[topic] = sequence
    return count, lost


def run(kind, folder, topics, seconds, hold):
    path = folder / "bench.bag"
    recorder = kind(path, topics)
    begin, before = time.monotonic(), cpu_seconds(recorder.pid)
    time.sleep(seconds / 2)
    if hold:
        os.kill(recorder.pid, signal.SIGSTOP)
        time.sleep(1.0)
        os.kill(recorder.pid, signal.SIGCONT)
    time.sleep(seconds / 2)
    share = (cpu_seconds(recorder.pid) - before) / (time.monotonic() - begin)
    recorder.stop()
    if not path.exists():
        from ambf_tools.record import repair

        repair(path)
    count, lost = gaps(path)
    path.unlink()
    return count, lost, share


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--topics", type=int, nargs="+", default=[10, 20, 50, 100])
    options = parser.parse_args()
    print(support.machine())
    master = support.Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    ours_lost = 0
    rows = []
    try:
        with support.scratch() as folder:
            folder = Path(folder)
            most = max(options.topics)
            launch = write(folder, cubes(most))
            rates = ("--override_min_comm_freq", "1000", "--override_max_comm_freq", "1000")
            simulator = Simulator(folder, "--launch_file", launch, "-l", "0", *rates, master_uri=master.uri)
            try:
                eventually(lambda: len(master.names()) >= 2 * (most + 2) + 13, 60)
                cases = [(count, False) for count in options.topics] + [(options.topics[0], True)]
                for count, hold in cases:
                    topics = [f"/ambf/env/Cube{i:03}/State" for i in range(count)]
                    for kind in (Ours, RosbagRecord, RosbagPython):
                        messages, lost, share = run(kind, folder, topics, options.seconds, hold)
                        if kind is Ours:
                            ours_lost += lost
                        what = f"{count}, held up" if hold else str(count)
                        rows.append([what, kind.name, messages, lost, f"{100 * share:.0f} %"])
                        print(*rows[-1], flush=True)
            finally:
                simulator.stop()
    finally:
        master.kill()
    support.table(rows, ["topics of 1 kHz", "recorder", "messages", "lost", "CPU of a core"])
    return 1 if ours_lost else 0


if __name__ == "__main__":
    sys.exit(main())
