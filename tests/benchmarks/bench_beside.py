"""PsmReach beside what others learn with: env steps a CPU second of FetchReach-v4, and steps of a PSM in MuJoCo.

python3 -m venv other && other/bin/pip install gymnasium-robotics==1.4.2 mujoco==3.3.7
./dev shell -- python tests/benchmarks/bench_beside.py --python other/bin/python

FetchReach-v4 makes 20 steps of 2 ms of physics for an env step, PsmReach 20 of 1 ms. The PSM in MuJoCo is an open chain
(the parallel linkage is left out: its end link turns about the remote centre) with the masses, inertias, axes, gains
and the step of ours: SurRoL's kind of model. One thread each, in turns, the best of some rounds counts.

Bars: PsmReach 1.5 times FetchReach-v4; its physics 0.8 of what the same world makes in step(20).
"""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

# What the other Python runs: one round of each, as JSON.
THERE = """
import json, sys, time
import numpy as np
out = {}
import mujoco
model = mujoco.MjModel.from_xml_string(open(sys.argv[1]).read())
data = mujoco.MjData(model)
mujoco.mj_step(model, data, 200)
begun = time.process_time()
for _ in range(500):
    data.ctrl[:] = data.qpos
    mujoco.mj_step(model, data, 20)
out["steps"] = 10000 / (time.process_time() - begun)
assert np.isfinite(data.qpos).all()
import gymnasium, gymnasium_robotics
gymnasium.register_envs(gymnasium_robotics)
env = gymnasium.make("FetchReach-v4")
random = np.random.default_rng(1)
actions = random.uniform(-1, 1, (50, 4)).astype(np.float32)
env.reset(seed=1)
begun = time.process_time()
for episode in range(20):
    env.reset()
    for action in actions:
        env.step(action)
out["fetch"] = 1000 / (time.process_time() - begun)
print(json.dumps(out))
"""
CHAIN = ("base link", "yaw link", "pitch end link", "main insertion link", "tool roll link", "tool pitch link")
GRIPPERS = ("tool gripper1 link", "tool gripper2 link")
PITCH_AXIS_OF = "yaw link-pitch back link"  # what the parallel linkage turns its end link about, as that joint does


def chain(file):
    """MJCF of the PSM's open chain, from its ADF."""
    import yaml

    adf = yaml.safe_load(Path(file).read_text())
    joints = {
        (adf[key]["parent"][5:], adf[key]["child"][5:]): adf[key] for key in adf["joints"] if "parent" in adf[key]
    }
    actuators = []

    def body(name, above, inside):
        block, joint = adf[f"BODY {name}"], joints[above, name]
        turned = joints["yaw link", "pitch back link"] if joint["type"] == "p2p" else joint
        relative = np.linalg.inv(pose(adf[f"BODY {above}"]["location"])) @ pose(block["location"])
        axis, at = three(turned["child axis"]), three(joint.get("child pivot", {"x": 0, "y": 0, "z": 0}))
        kind = "slide" if joint["type"] == "prismatic" else "hinge"
        label, gains = name.replace(" ", "_"), adf[f"JOINT {PITCH_AXIS_OF}"]["controller"]
        actuators.append(f'<position joint="{label}" kp="{gains["P"]}" kv="{gains["D"]}"/>')
        mass, inertia = block["mass"], block.get("inertia", {"ix": 1e-5, "iy": 1e-5, "iz": 1e-5})
        com = three(block.get("inertial offset", {}).get("position", {"x": 0, "y": 0, "z": 0}))
        return (
            f'<body name="{label}" pos="{row(relative[:3, 3])}" quat="{row(quaternion(relative[:3, :3]))}">'
            f'<inertial pos="{row(com)}" mass="{mass}" diaginertia="{row(inertia.values())}"/>'
            f'<joint name="{label}" type="{kind}" axis="{row(axis)}" pos="{row(at)}" damping="0.002"/>{inside}</body>'
        )

    inside = "".join(body(name, CHAIN[-1], "") for name in GRIPPERS)
    for above, name in reversed(list(zip(CHAIN, CHAIN[1:], strict=False))):
        inside = body(name, above, inside)
    return (
        '<mujoco><option timestep="0.001" gravity="0 0 0" integrator="implicitfast"/>'
        f'<compiler angle="radian" balanceinertia="true"/><worldbody>{inside}</worldbody>'
        f"<actuator>{''.join(actuators)}</actuator></mujoco>"
    )


def three(vector):
    return np.array([vector["x"], vector["y"], vector["z"]], float)


def row(numbers):
    return " ".join(f"{each:.9g}" for each in numbers)


def pose(location):
    r, p, y = (location["orientation"][each] for each in "rpy")
    (cr, cp, cy), (sr, sp, sy) = np.cos([r, p, y]), np.sin([r, p, y])
    out = np.eye(4)
    out[:3, :3] = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]]) @ [[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]
    out[:3, :3] = out[:3, :3] @ [[1, 0, 0], [0, cr, -sr], [0, sr, cr]]
    out[:3, 3] = three(location["position"])
    return out


def quaternion(turn):
    """w x y z."""
    w = np.sqrt(max(0.0, 1 + np.trace(turn))) / 2
    if w > 1e-6:
        return [w, *(np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / (4 * w))]
    axis = np.sqrt(np.maximum(0.0, (np.diag(turn) + 1) / 2))
    first = int(np.argmax(axis))
    return [0.0, *(axis * np.where(turn[first] + np.eye(3)[first] < 0, -1, 1))]


def here(env):
    """Env steps a CPU second of PsmReach, and steps of physics a second of what its world took of that."""
    actions = np.random.default_rng(1).uniform(-1, 1, (50, 3)).astype(np.float32)
    world, inside = env.unwrapped.world, []
    advance = world.step

    def step(n=1):
        begun = time.process_time()
        advance(n)
        inside.append(time.process_time() - begun)

    world.step = step
    spent = 0.0
    for _ in range(20):
        env.reset()
        begun = time.process_time()
        for action in actions:
            env.step(action)
        spent += time.process_time() - begun
    world.step = advance
    return 1000 / spent, 20 * 1000 / sum(inside)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--python", required=True, help="of an environment with gymnasium-robotics and mujoco")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    import ambf_gym
    import support

    print(support.machine())
    files = ambf_gym.PsmReach.files
    model = Path("psm_chain.xml").resolve()
    model.write_text(chain(files[0]))
    env = ambf_gym.make("ambf/PsmReach-v0")
    env.reset(seed=1)
    rounds = []
    for _ in range(options.rounds):
        done = subprocess.run(
            [options.python, "-c", THERE, model], capture_output=True, text=True, check=False, env={"PATH": ""}
        )
        if done.returncode != 0:
            sys.exit(done.stderr)
        there = json.loads(done.stdout.splitlines()[-1])
        rounds.append([*here(env), there["fetch"], there["steps"]])
        print(" ".join(f"{each:.0f}" for each in rounds[-1]), flush=True)
    model.unlink()
    ours, physics, fetch, mujoco = np.max(rounds, axis=0)
    print(f"PsmReach {ours:.0f} env steps a CPU second, FetchReach-v4 {fetch:.0f}: {ours / fetch:.2f} times")
    print(f"of the steps of its world, {physics:.0f} a CPU second: {20 * ours / physics:.2f}")
    print(f"an open-chain PSM in MuJoCo: {mujoco:.0f} steps a CPU second; ours, a closed one: {physics:.0f}")


if __name__ == "__main__":
    main()
