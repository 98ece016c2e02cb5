"""A cloth between two jointed hands in real time, all topics on (rows 5.8 and 5.9 of the dissertation's tables).

A client moves the hands at 100 Hz: down, closed, up and down again with the cloth between them, and reads its nodes. It
goes by simulated time, so that they do the same where that lags behind. Real-time factor 1.00 +-0.01, lateness p99.9
within 1.5 times that of the same run without the cloth.
"""

import argparse
import math
import os
import subprocess
import sys
import time
from pathlib import Path

import support

SCENE = support.ROOT / "ambf_models/descriptions/multi-bodies/soft/cloth_two_hands.yaml"
SIDE = 0.30  # m, of the cloth
HANDS = ("left_hand", "right_hand")
DOWN, UP, OPEN, CLOSED = -0.1095, 0.10, 0.030, 0.004  # m, of the lifts and of each finger
TISSUE = "kind: sheet, young modulus: 1e5, thickness: 0.0005, density: 900, poisson ratio: 0.3, touches: none"
CLOTHS = {
    "none": None,
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


def write_scene(folder, cloth):
    """The scene of two hands with another cloth, or none."""
    text = SCENE.read_text()
    meshes = (SCENE.parent / "../../../meshes/cloth_two_hands/high_res/").resolve()
    text = text.replace("../../../meshes/cloth_two_hands/high_res/", f"{meshes}/")
    begin = text.index("SOFT cloth:")
    if cloth is None:
        text = text[:begin].replace("soft bodies:\n  - SOFT cloth\n", "")
    else:
        count, config = cloth
        mesh = folder / f"cloth{count}.obj"
        write_mesh(mesh, count)
        text = (
            text[:begin]
            + f"SOFT cloth:\n  name: cloth\n  mesh: {mesh}\n  collision margin: 0.0015\n"
            + "  location: {position: {x: -0.09, y: 0.0, z: 0.0135}}\n"
            + (f"  mass: 0.04\n  config: {{{config}}}\n" if config else f"  tissue: {{{TISSUE}}}\n")
        )
    path = folder / "scene.yaml"
    path.write_text(text)
    return path


def move_hands(seconds, with_cloth):
    """Of a process beside the simulator; prints how far the cloth was lifted, and how many hands held it meanwhile."""
    from ambf_client import Client

    with Client("bench_cloth") as client:
        stand = client.wait_for("stand")
        cloth = client.wait_for("cloth") if with_cloth else None
        grips = [client.wait_for(f"{hand}_grip") for hand in HANDS]
        ends, begun, lifted, held = time.monotonic() + seconds, stand.get_sim_time(), 0.0, 0
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
        print(f"{lifted:.3f} by {held}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=30.0)
    parser.add_argument("--hands", type=int, choices=(0, 1), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.hands is not None:
        move_hands(options.seconds, bool(options.hands))
        return
    print(support.machine())
    master, rows, alone = support.Master(), [], None
    try:
        with support.scratch() as folder:
            for name, cloth in CLOTHS.items():
                scene = write_scene(Path(folder), cloth)
                hands = subprocess.Popen(
                    [
                        sys.executable,
                        __file__,
                        "--hands",
                        str(int(cloth is not None)),
                        "--seconds",
                        str(options.seconds - 3.0),
                    ],
                    env={**os.environ, "ROS_MASTER_URI": master.uri},
                    stdout=subprocess.PIPE,
                    text=True,
                )
                run = support.summary_of(("-a", scene), options.seconds, master=master)
                lifted = hands.communicate(timeout=60)[0].strip().splitlines()[-1:]
                alone = alone or run
                late = run["lateness p99.9"] / alone["lateness p99.9"]
                rows.append(
                    [
                        name,
                        f"{run['real-time factor']:.4f}",
                        f"{run['steps per second']:.1f}",
                        f"{run['process CPU']:.0f}",
                        f"{run['lateness p99.9']:.0f}",
                        f"{late:.2f}",
                        f"{run['steps given up']:.0f}",
                        lifted[0] if cloth and lifted else "-",
                        f"{100 * run['busy']:.0f}",
                    ]
                )
    finally:
        master.kill()
    support.table(
        rows,
        [
            "cloth",
            "real-time factor",
            "steps/s",
            "CPU %",
            "lateness us p99.9",
            "of that without",
            "given up",
            "lifted to, m, by hands",
            "machine busy %",
        ],
    )


if __name__ == "__main__":
    main()
