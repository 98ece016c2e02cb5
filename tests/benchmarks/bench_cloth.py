"""A cloth between two jointed hands in real time, all topics on (rows 5.8 and 5.9 of the dissertation's tables).

A client moves the hands at 100 Hz: down, closed, up and down again with the cloth between them, and reads its nodes. It
goes by simulated time, so that they do the same where that lags behind. Each cloth is loaded into the running simulator
after a part of the run without it, and unloaded before another. Real-time factor 1.00 +-0.01, lateness p99.9 within 1.5
times that of these two parts: of each second, and the median of those, for one in which the host takes the processor
away says nothing.
"""

import argparse
import itertools
import math
import os
import statistics
import time
from pathlib import Path

import support

SCENE = support.ROOT / "ambf_models/descriptions/multi-bodies/soft/cloth_two_hands.yaml"
SIDE = 0.30  # m, of the cloth
HANDS = ("left_hand", "right_hand")
DOWN, UP, OPEN, CLOSED = -0.1095, 0.10, 0.030, 0.004  # m, of the lifts and of each finger
TISSUE = "kind: sheet, young modulus: 1e5, thickness: 0.0005, density: 900, poisson ratio: 0.3, touches: none"
CLOTHS = {
    "30 x 30, bending distance 2": (30, "kLST: 0.5, kDP: 0.03, kDF: 0.6, piterations: 1, bending constraint: 2"),
    "60 x 60, one iteration": (60, "kLST: 0.5, kDP: 0.03, kDF: 0.6, piterations: 1"),
    "60 x 60, two iterations": (60, "kLST: 0.5, kDP: 0.03, kDF: 0.6, piterations: 2"),
    "30 x 30, tissue": (30, None),
}


def write_mesh(path, count):
    at = [SIDE * (i / (count - 1) - 0.5) for i in range(count)]
    lines = [f"v {x:.6f} {y:.6f} 0" for x in at for y in at]
    for i in range(count - 1):
        for j in range(count - 1):
            a, b = i * count + j + 1, (i + 1) * count + j + 1
            lines += [f"f {a} {b} {b + 1}", f"f {a} {b + 1} {a + 1}"]
    path.write_text("\n".join(lines) + "\n")


def write_scenes(folder):
    """The two hands alone, and each cloth as a model of its own: (file, {name: file})."""
    text = SCENE.read_text()
    meshes = (SCENE.parent / "../../../meshes/cloth_two_hands/high_res/").resolve()
    head, rest = text.replace("../../../meshes/cloth_two_hands/high_res/", f"{meshes}/").split("soft bodies:", 1)
    hands, cloths = folder / "hands.yaml", {}
    hands.write_text(head + rest[rest.index("BODY ") : rest.index("SOFT cloth:")])
    for name, (count, config) in CLOTHS.items():
        mesh, cloths[name] = folder / f"cloth{count}.obj", folder / f"cloth_{len(cloths)}.yaml"
        write_mesh(mesh, count)
        cloths[name].write_text(
            "adf version: 1.0\nnamespace: /ambf/env/cloth_two_hands/\nsoft bodies: [SOFT cloth]\n"
            + f"SOFT cloth:\n  name: cloth\n  mesh: {mesh}\n  collision margin: 0.0015\n"
            + "  location: {position: {x: -0.09, y: 0.0, z: 0.0135}}\n"
            + (f"  mass: 0.04\n  config: {{{config}}}\n" if config else f"  tissue: {{{TISSUE}}}\n")
        )
    return hands, cloths


def play(client, seconds, rates, cloth=None):
    """One part of the run. What the simulator says of each of its seconds, and how far who lifted the cloth."""
    stand = client.wait_for("stand")
    grips = [client.wait_for(f"{hand}_grip") for hand in HANDS]
    client.world.reset_bodies()
    begun, ends, lifted, held = stand.get_sim_time(), time.monotonic() + seconds, 0.0, 0
    rates.clear()
    while time.monotonic() < ends:
        now = stand.get_sim_time() - begun
        swing = 0.5 - 0.5 * math.cos(math.tau * max(0.0, now - 3.5) / 4.0)
        lift = DOWN * min(1.0, now / 1.5) if now < 3.5 else DOWN + (UP - DOWN) * swing
        jaw = OPEN if now < 2.0 else OPEN + (CLOSED - OPEN) * min(1.0, 2.0 * (now - 2.0))
        for hand in HANDS:
            stand.set_joint_pos(f"{hand}-lift", lift)
            stand.set_joint_pos(f"{hand}-a", jaw)
            stand.set_joint_pos(f"{hand}-b", jaw)
        if cloth is not None and (nodes := cloth.get_nodes()) is not None and len(nodes):
            lifted = max(lifted, float(nodes[:, 2].max()))
            held = max(held, sum(grip.is_actuated() for grip in grips))
        time.sleep(0.01)
    # Rates come five times a second, and are of the last full one; the first two have the reset in them.
    kept = [b for a, b in itertools.pairwise(rates) if physics_of(a).lateness_max != physics_of(b).lateness_max]
    return kept[2:], f"{lifted:.3f} by {held}"


def physics_of(second):
    return next(thread for thread in second.threads if thread.name == "physics")


def figures(part):
    """Of a part's seconds: physics thread's load, %, and lateness p99.9, us, median and of the worst."""
    late = [1e6 * physics_of(second).lateness_p999 for second in part]
    return 100 * statistics.mean(physics_of(second).load for second in part), statistics.median(late), max(late)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=30.0, help="of each part of the run")
    options = parser.parse_args()
    print(support.machine())
    master, rows = support.Master(), []
    os.environ["ROS_MASTER_URI"] = master.uri
    import rospy  # they read the variable as they are imported
    from ambf_client import Client

    from ambf_msgs.msg import WorldRates

    with support.scratch() as folder:
        hands, cloths = write_scenes(Path(folder))
        simulator = support.Simulator(folder, "-a", hands, master_uri=master.uri)
        try:
            with Client("bench_cloth") as client:
                rates = []
                rospy.Subscriber(f"{client.world.get_name()}/Rates", WorldRates, rates.append)
                before, _ = play(client, options.seconds, rates)
                for name, file in cloths.items():
                    loaded = client.load(str(file))
                    watch = support.Watch()
                    part, lifted = play(client, options.seconds, rates, client.wait_for("cloth"))
                    busy = watch.shares()[0]
                    client.unload(loaded)
                    after, _ = play(client, options.seconds, rates)
                    alone, run = figures(before + after), figures(part)
                    before = after
                    factor = (part[-1].sim_time - part[0].sim_time) / (part[-1].wall_time - part[0].wall_time)
                    rows.append(
                        [
                            name,
                            f"{factor:.4f}",
                            f"{alone[0]:.0f}, {run[0]:.0f}",
                            f"{alone[1]:.0f}, {run[1]:.0f}",
                            f"{run[1] / alone[1]:.2f}",
                            f"{alone[2]:.0f}, {run[2]:.0f}",
                            f"{part[-1].sub_steps_given_up - part[0].sub_steps_given_up}",
                            lifted,
                            f"{100 * busy:.0f}",
                        ]
                    )
        finally:
            simulator.stop()
            master.kill()
    support.table(
        rows,
        [
            "cloth",
            "real-time factor",
            "physics thread without, with, %",
            "lateness us p99.9",
            "ratio",
            "in the worst second",
            "given up",
            "lifted to, m, by hands",
            "machine busy %",
        ],
    )


if __name__ == "__main__":
    main()
