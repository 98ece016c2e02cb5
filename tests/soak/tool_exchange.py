"""A PSM's instrument is exchanged two hundred times while all runs: does anything else move, grow or wait?

PSM and ECM in real time, the PSM's joints commanded to hold, instruments in turns by `exchange_tool` (what `ambf-cli
tool` calls), over ROS. Bars: joints of neither arm that stay move 0.01 degree or 0.1 mm, nor do links 0.1 mm, in any
State between two exchanges; no thread, 2 MB of memory or 3 files more from the second quarter to the last; the physics
thread takes less than 1 ms of CPU an exchange more than without (mean, less two standard errors). The first exchange
takes the instrument of the PSM's own file, later ones what an exchange has brought: it is shown alone. --crtk: by the
CRTK's `set_tool_type`, which holds the PSM meanwhile.

    ./dev shell -- python tests/soak/tool_exchange.py --times 200
"""

import argparse
import math
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / f"tests/{part}") for part in ("acceptance", "benchmarks", "crtk")]
import support  # noqa: E402
from harness import Master, Ros, Simulator, eventually  # noqa: E402

MODELS = ROOT / "ambf_models/descriptions"
# Without the floor of launch_original.yaml, on which an instrument that is not drawn back stands.
LAUNCH = f"""world config: {MODELS}/world/empty_world.yaml
color config: {MODELS}/color/colors.yaml
input devices config: {MODELS}/input_devices/input_devices.yaml
multibody configs: [{MODELS}/multi-bodies/robots/psm.yaml, {MODELS}/multi-bodies/robots/ecm.yaml]
"""
HELD = {"baselink-yawlink": 0.3, "yawlink-pitchbacklink": -0.2, "pitchendlink-maininsertionlink": 0.13}
BASES = ("/ambf/env/psm/baselink", "/ambf/env/ecm/baselink")
LINKS = ("/ambf/env/psm/maininsertionlink", "/ambf/env/ecm/toollink")
SLIDES = "pitchendlink-maininsertionlink"
ANGLE, WAY, MEMORY, CPU = math.radians(0.01), 1e-4, 2.0, 1e-3


class Watch:
    """How far what stays has moved since `begin`, from every State that comes."""

    def __init__(self, rospy):
        from ambf_msgs.msg import RigidBodyState

        self.first, self.now, self.worst, self.whose = {}, {}, {"angle": 0.0, "way": 0.0}, {}
        self.states = 0
        for name in (*BASES, *LINKS):
            rospy.Subscriber(f"{name}/State", RigidBodyState, self.hear, callback_args=name)

    def hear(self, message, name):
        self.states += 1
        if name in LINKS:
            at = message.pose.position
            self.note((name, "place"), (at.x, at.y, at.z), "way")
            return
        for joint, position in zip(message.joint_names, message.joint_positions, strict=False):
            short = joint.rpartition("/")[2].replace(" ", "")
            if "tool" not in short:
                self.note((name, short), (position,), "way" if short == SLIDES else "angle")

    def note(self, key, value, kind):
        self.now[key] = value
        if key in self.first and (moved := math.dist(value, self.first[key])) > self.worst[kind]:
            self.worst[kind], self.whose[kind] = moved, f"{key[0]} {key[1]}"

    def begin(self):
        self.first = dict(self.now)

    def restart(self):
        self.first, self.worst, self.whose = {}, {"angle": 0.0, "way": 0.0}, {}

    def verdict(self, when):
        angle, way = math.degrees(self.worst["angle"]), 1e3 * self.worst["way"]
        whose = ", ".join(sorted(set(self.whose.values())))
        print(f"{when}: others moved {angle:.2g} degree, {way:.2g} mm at most ({whose})", flush=True)
        moved = self.worst["angle"] > ANGLE or self.worst["way"] > WAY
        return [f"{when}: something else moved ({whose})"] if moved else []


def physics_cpu(pid):
    """s of CPU that the physics thread has had ."""
    for task in Path(f"/proc/{pid}/task").iterdir():
        if (task / "comm").read_text().strip() == "physics":
            return int((task / "schedstat").read_text().split()[0]) * 1e-9
    raise SystemExit("no thread is named physics")


def cpu_of(pid, seconds=0.0, action=lambda: None):
    """CPU of physics, and the wall time, of an action and so many seconds."""
    cpu, begin = physics_cpu(pid), time.monotonic()
    action()
    time.sleep(seconds)
    return physics_cpu(pid) - cpu, time.monotonic() - begin


class ByClient:
    """Exchanges as `ambf-cli tool` makes them."""

    def __init__(self, client, psm, ecm):
        self.client, self.psm, self.ecm = client, psm, ecm

    def exchange(self, word):
        from ambf_client.instruments import exchange_tool

        exchange_tool(self.client, "PSM1", word)

    def command(self):
        command(self.psm, self.ecm)


class ByCrtk:
    """Exchanges by a CRTK arm, which holds the PSM; the client holds the ECM."""

    def __init__(self, ros, psm, ecm):
        from crtk_arm import Arm
        from std_msgs.msg import String

        self.psm, self.ecm = psm, ecm
        self.arm = Arm(ros, "PSM1")
        self.tool = ros.listen("/PSM1/tool_type", String)
        self.talker = ros.talk("/PSM1/set_tool_type", String)
        self.arm.home()

    def exchange(self, word):
        from ambf_client.instruments import INSTRUMENTS

        wanted = INSTRUMENTS[word].tool
        if self.tool.last().data == wanted:
            return
        self.talker.publish(wanted)
        self.tool.next(lambda message: message.data == wanted, 20.0)

    def command(self):
        if self.arm.measured_js.last().position[0] < 0.29:
            self.arm.wait_idle_after(lambda: self.arm.joints("move_jp", [*HELD.values(), 0.0, 0.0, 0.0]))
        command(None, self.ecm)


def command(psm, ecm):
    """For 4 s: until they are there."""
    for _ in range(40):
        if psm is not None:
            psm.set_joint_pos(HELD)
        ecm.set_joint_pos({name: 0.5 * value for name, value in HELD.items() if name in ecm.get_joint_names()})
        time.sleep(0.1)


def run(simulator, client, ros, options):
    import rospy
    from ambf_client.instruments import INSTRUMENTS

    psm = client.wait_for(BASES[0], 10.0)
    ecm = client.wait_for(BASES[1], 10.0)
    watch, pid, words = Watch(rospy), simulator.pid, list(INSTRUMENTS)
    eventually(lambda: {key[0] for key in watch.now} >= {*BASES, *LINKS}, 20.0, "states of both arms")
    way = ByCrtk(ros, psm, ecm) if options.crtk else ByClient(client, psm, ecm)
    way.command()
    reached = {name: psm.get_joint_pos(name) for name in HELD}
    print(f"held: {reached}")
    if any(abs(reached[name] - value) > 0.02 for name, value in HELD.items()):
        return ["the PSM is not where it was commanded to be"]
    print(f"watched: {', '.join(sorted(key[1] for key in watch.now))}")
    watch.begin()
    way.exchange(words[1 if options.crtk else 0])
    time.sleep(1.0)
    faults = watch.verdict("the first exchange")
    watch.restart()
    way.command()
    samples, extra, walls, quiet = [], [], [], []
    for turn in range(options.times):
        word = words[(turn + 2) % len(words)]
        idle, idle_wall = cpu_of(pid, 0.15)
        watch.begin()
        spent, wall = cpu_of(pid, 0.05, lambda word=word: way.exchange(word))
        quiet.append(idle / idle_wall)
        extra.append((spent, wall))
        walls.append(wall - 0.05)
        if turn % 4 == 3:  # as many of each: what is held is the same
            samples.append(support.process_numbers(pid))
    rate = statistics.mean(quiet)
    cpu = [spent - rate * wall for spent, wall in extra]
    faults += watch.verdict("all others")
    print(f"{options.times} exchanges, {watch.states} states; one takes {1e3 * statistics.median(walls):.0f} ms")
    error = statistics.stdev(cpu) / math.sqrt(len(cpu))
    print(
        f"physics: {1e3 * statistics.mean(cpu):.2f} ms an exchange beyond the {100 * rate:.1f} % of a core without "
        f"(standard error {1e3 * error:.2f} ms)"
    )
    if statistics.mean(cpu) - 2.0 * error > CPU:
        faults.append("physics took more than 1 ms an exchange")
    quarter = len(samples) // 4
    if quarter < 2:
        return [*faults, "too few exchanges to judge growth"]
    for what, allowed in (("memory", MEMORY), ("threads", 0), ("files", 3)):
        early, late = (
            statistics.median(each[what] for each in part)
            for part in (samples[quarter : 2 * quarter], samples[-quarter:])
        )
        print(f"{what}: first {samples[0][what]:.1f}, second quarter {early:.1f}, last quarter {late:.1f}")
        if late - early > allowed:
            faults.append(f"{what} grew from {early:.1f} to {late:.1f}")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--times", type=int, default=200)
    parser.add_argument("--crtk", action="store_true")
    options = parser.parse_args()
    print(support.machine(), flush=True)
    master = Master()
    os.environ.update(ROS_MASTER_URI=master.uri, ROS_IP="127.0.0.1")
    with tempfile.TemporaryDirectory(prefix="ambf-soak-") as folder:
        launch = Path(folder) / "launch.yaml"
        launch.write_text(LAUNCH)
        more = ["--crtk", MODELS / "crtk/psm.yaml"] if options.crtk else []
        allowed = ["CRTK"] if options.crtk else []
        arguments = ["--launch_file", launch, "-l", "0,1", *more]
        simulator = Simulator(folder, *arguments, master_uri=master.uri, allowed=allowed)
        try:
            simulator.wait_loaded(2)
            from ambf_client import Client

            ros = Ros()  # before the client: a program is one node
            client = Client("tool_exchange")
            client.connect()
            with client:
                faults = run(simulator, client, ros, options)
            code, _ = simulator.stop()
            faults += [f"exit code {code}"] if code != 0 else []
            faults += simulator.complaints()
        finally:
            if simulator.running():
                simulator.stop()
            master.kill()
    for fault in faults:
        print("FAULT:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
