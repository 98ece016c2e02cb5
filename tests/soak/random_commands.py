"""Minutes of random legal commands: does every robot and every scene of a task stay whole?

Each joint that takes commands gets, at times of its own, a position within its limits, a velocity that crosses its
range in a second or more, an effort that its motor can give, or nothing; hands of a scene get poses, twists and
wrenches, its pieces (where it has no hands) pushes of up to twice their weight. In this process, as fast as it goes;
the short form for CI is `Robots/RandomCommands` in tests/robots. Judged every 10 ms of simulated time: all numbers are
finite, nothing diverged or froze, joints are within their limits + 1 mrad or mm, pivots of a joint at most 3 mm apart
while it is thrown about (what would stay open: 0.02 mm after being held for 1.5 s, or up to 6 s where something still
falls).

    ./dev shell -- python tests/soak/random_commands.py --seconds 600
    ./dev shell -- python tests/soak/random_commands.py --only psm --wall 30

Ends with 1 when a robot or scene did not stay whole, and names what came first.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np
import yaml

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/benchmarks"))
import support  # noqa: E402
from ambf_core import BodyMode, Diverged, JointMode, World  # noqa: E402

MODELS = ROOT / "ambf_models"
SCENES = MODELS / "descriptions"
ROBOTS = [path for kind in ("robots", "grippers") for path in sorted((SCENES / f"multi-bodies/{kind}").glob("*.yaml"))]
LIMIT, GAP, GAP_AT_REST = 1e-3, 3e-3, 0.02e-3  # rad or m; m
AT_REST = 0.1  # m/s, rad/s
CHUNK = 10  # steps between two judgements
SHARES = {"position": 0.45, "velocity": 0.25, "effort": 0.2, "none": 0.1}
POSES = (BodyMode.POSE, BodyMode.TWIST, BodyMode.WRENCH, BodyMode.NONE)
SPEED, TURNING = 0.1, 1.0  # m/s, rad/s: most of what a hand's twist asks for


def scene(world, *files, hands=(), pushed=(), room=0.03):
    """hands: bodies that get poses within `room` (m) of home; pushed: pieces that get wrenches."""
    return {"world": MODELS / world, "files": [MODELS / each for each in files]} | {
        "hands": hands,
        "pushed": pushed,
        "room": room,
    }


def robot(path):
    return scene("descriptions/world/empty_world.yaml", path)


DVRK = ("suj", "psm1", "psm2", "psm3", "ecm", "mounts", "mtmr", "mtml", "table", "board")
SUTURING = ("phantom", "ghosts", "psm1", "ghosts_actuators_psm1", "psm2", "ghosts_actuators_psm2")
PEGS = ("descriptions/world/peg_transfer_world.yaml", "descriptions/multi-bodies/puzzles/peg_transfer.yaml")
# N or Nm that a PSM's motors give. Files of the suturing arms keep their original's bounds, up to 5000 Nm.
SUTURING_EFFORTS = {
    "yawlink": 3.3161,
    "pitchlink": 3.3161,
    "maininsertionlink": 9.8779,
    "toolrolllink": 0.33,
    "toolpitchlink": 0.25,
    "toolyawlink": 0.2,
    "toolgripper1link": 0.16,
    "toolgripper2link": 0.16,
}
GRIPPERS = ("/ambf/env/left_gripper", "/ambf/env/right_gripper")
TOUCH = "descriptions/multi-bodies/touch/"
SUBJECTS = {path.stem: robot(path) for path in ROBOTS} | {
    "suturing_psm2": robot(MODELS / "suturing/psm2.yaml"),
    "launch_dvrk": scene("dvrk/world.yaml", *(f"dvrk/{each}.yaml" for each in DVRK)),
    "peg_transfer": scene(*PEGS, "descriptions/tasks/peg_transfer.yaml", hands=GRIPPERS),
    "needle_board": scene(*PEGS, "descriptions/tasks/needle_board.yaml", hands=GRIPPERS),
    "needle": scene(
        "suturing/world.yaml", *(f"suturing/{each}.yaml" for each in SUTURING), "descriptions/tasks/needle.yaml"
    ),
    "ring_wire": scene(
        "descriptions/world/ring_wire_world.yaml", "descriptions/tasks/ring_wire.yaml", hands=("ring_wire/ring",)
    ),
    "tissue_retract": scene(
        "descriptions/world/ring_wire_world.yaml",
        "descriptions/tasks/tissue_retract.yaml",
        hands=("right_gripper",),
        room=0.015,
    ),
    "puzzle1": scene(
        "studies/study_b_world.yaml", "studies/puzzle1.yaml", "descriptions/tasks/puzzle1.yaml", pushed=("Puzzle",)
    ),
    "puzzle2": scene(
        "studies/practice_world.yaml", "studies/puzzle2.yaml", "descriptions/tasks/puzzle2.yaml", pushed=("_A", "_B")
    ),
    "puzzle4": scene(
        "studies/world.yaml", "studies/puzzle4.yaml", "descriptions/tasks/puzzle4.yaml", pushed=("Puzzle",)
    ),
    "puzzle5": scene(
        "studies/world.yaml", "studies/puzzle5.yaml", "descriptions/tasks/puzzle5.yaml", pushed=("Puzzle",)
    ),
    "four_hands": scene(
        "studies/four_hands_world.yaml",
        "studies/puzzle1.yaml",
        "studies/four_hands.yaml",
        "descriptions/tasks/four_hands.yaml",
        hands=tuple(f"hands/{user}_{side}" for user in ("user1", "user2") for side in ("left", "right")),
        room=0.3,
    ),
    "screwdriver_env": scene(
        "studies/screwdriver_env_world.yaml",
        "studies/screwdriver_env.yaml",
        "descriptions/tasks/screwdriver_env.yaml",
        pushed=("SDHandle",),
    ),
    "knot_env": scene("studies/knot_env_world.yaml", "studies/knot_env.yaml"),
    "toy_car2": scene("descriptions/world/original_world.yaml", "original/toy_car2.yaml"),
    "sophie": scene("descriptions/world/original_world.yaml", "original/sophie.yaml"),
    "screwdriver": scene(
        "descriptions/world/screwdriver_world.yaml", TOUCH + "screwdriver.yaml", "descriptions/tasks/screwdriver.yaml"
    ),
    "thread": scene("descriptions/world/thread_world.yaml", TOUCH + "thread.yaml"),
}


def vector(block):
    return [float(block.get(axis, 0.0)) for axis in "xyz"] if block else [0.0, 0.0, 0.0]


def turned(quaternions, vectors):
    """Vectors turned by quaternions x y z w, row by row."""
    axis, w = quaternions[:, :3], quaternions[:, 3:]
    return vectors + 2.0 * np.cross(axis, np.cross(axis, vectors) + w * vectors)


class Places:
    """Where the files put the joints' pivots, and what their motors can give."""

    def __init__(self):
        self.joints, self.parents, self.children, self.slides = [], [], [], []
        self.parent_pivots, self.child_pivots, self.axes, self.efforts = [], [], [], {}

    def note(self, file, world, bodies, joints):
        """The file's objects are the world's rows from `bodies` and `joints` on, in its order."""
        data = yaml.load(file.read_text(), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
        here = {name: bodies + i for i, name in enumerate(data.get("bodies") or [])}
        listed = data.get("joints") or []
        if len(world.bodies) - bodies != len(here) or len(world.joints) - joints != len(listed):
            raise SystemExit(f"{file}: {len(here)} bodies and {len(listed)} joints, of which not all were made")
        for i, key in enumerate(listed):
            block, name = data[key], world.joints[joints + i]
            if not name.endswith(block["name"].replace(" ", "")):
                raise SystemExit(f"{file}: {key} is not {name}")
            if "max motor impulse" in block:
                self.efforts[joints + i] = float(block["max motor impulse"]) / 0.001  # of a step of 1 ms
                if file.parent.name == "suturing":
                    self.efforts[joints + i] = SUTURING_EFFORTS[name.split("-")[-1]]
            if block["type"] in ("6dof", "6dof spring"):
                continue
            ends = [
                here[block[end]] if block[end] in here else self.elsewhere(world, block[end])
                for end in ("parent", "child")
            ]
            self.joints.append(joints + i)
            self.parents.append(ends[0])
            self.children.append(ends[1])
            self.slides.append(block["type"] in ("prismatic", "linear spring"))
            self.parent_pivots.append(vector(block.get("parent pivot")))
            self.child_pivots.append(vector(block.get("child pivot")))
            axis = np.array(vector(block.get("parent axis") or {"z": 1.0}))
            self.axes.append(axis / np.linalg.norm(axis))

    @staticmethod
    def elsewhere(world, name):
        """A body of another file: BODY x, or /its/namespace/BODY x."""
        return world.body(name.replace("BODY ", "").replace(" ", ""))

    def finish(self):
        shape = (len(self.joints), 3)
        self.parent_pivots, self.child_pivots, self.axes = (
            np.array(each, float).reshape(shape) for each in (self.parent_pivots, self.child_pivots, self.axes)
        )
        self.slides = np.array(self.slides, bool)

    def gaps(self, poses):
        """m, of each of `joints`, without what is free along the axis of a sliding one."""
        parents, children = poses[self.parents], poses[self.children]
        gaps = children[:, :3] + turned(children[:, 3:], self.child_pivots)
        gaps -= parents[:, :3] + turned(parents[:, 3:], self.parent_pivots)
        axes = turned(parents[:, 3:], self.axes)
        gaps -= np.where(self.slides, (gaps * axes).sum(1), 0.0)[:, None] * axes
        return np.linalg.norm(gaps, axis=1)


class Subject:
    def __init__(self, what, kinds, seed):
        self.random, self.places, self.faults = np.random.default_rng(seed), Places(), {}
        self.kinds, shares = [JointMode[each.upper()] for each in kinds], np.array([SHARES[each] for each in kinds])
        self.shares = shares / shares.sum()
        self.world = World(world=what["world"])
        for file in what["files"]:
            bodies, joints = len(self.world.bodies), len(self.world.joints)
            self.world.load(file)
            self.places.note(file, self.world, bodies, joints)
        self.places.finish()
        world = self.world
        world.step(0)
        self.free = np.flatnonzero(world.commandable)
        limits = world.joint_limits
        self.low = np.where(np.isfinite(limits[:, 0]), limits[:, 0], -3.0)
        self.high = np.where(np.isfinite(limits[:, 1]), limits[:, 1], 3.0)
        self.limited = np.isfinite(limits).all(axis=1)
        self.due = np.zeros(len(world.joints))
        self.hands = [world.body(each) for each in what["hands"]]
        self.pushed = [row for row, name in enumerate(world.bodies) if any(each in name for each in what["pushed"])]
        self.hands_due = np.zeros(len(world.bodies))
        self.room, self.home = what["room"], world.state.body_pose.copy()
        self.beyond, self.gap, self.given = (0.0, ""), (0.0, ""), 0

    def fault(self, kind, text):
        """The first of its kind."""
        self.faults.setdefault(kind, f"{kind} at {float(self.world.state.sim_time):.2f} s: {text}")

    def command_joints(self, now, kinds, shares):
        commands = self.world.commands
        for row in self.free[self.due[self.free] <= now]:
            kind = self.random.choice(kinds, p=shares)
            if kind == JointMode.EFFORT and row not in self.places.efforts:
                kind = JointMode.NONE  # a joint without a motor
            width = self.high[row] - self.low[row]
            most = {JointMode.VELOCITY: width, JointMode.EFFORT: self.places.efforts.get(row, 0.0)}.get(kind, 0.0)
            at = self.random.uniform(self.low[row], self.high[row])
            commands.joint_value[row] = at if kind == JointMode.POSITION else self.random.uniform(-most, most)
            commands.joint_mode[row] = kind
            self.due[row] = now + self.random.uniform(0.02, 1.0)
            self.given += 1

    def command_bodies(self, now):
        world, random = self.world, self.random
        for row in (*self.hands, *self.pushed):
            if self.hands_due[row] > now:
                continue
            kind = BodyMode.WRENCH if row in self.pushed else random.choice(POSES)
            if kind == BodyMode.NONE:
                world.commands.body_mode[row] = kind
            elif kind == BodyMode.WRENCH:
                push = random.uniform(-2.0, 2.0, 3) * world.masses[row] * 9.81
                world.commands.set_body(row, [*push, 0.0, 0.0, 0.0], kind)
            elif kind == BodyMode.TWIST:
                twist = [*random.uniform(-SPEED, SPEED, 3), *random.uniform(-TURNING, TURNING, 3)]
                world.commands.set_body(row, twist, kind)
            else:
                place = self.home[row, :3] + random.uniform(-self.room, self.room, 3)
                (x, y, z, w), (s, c) = self.home[row, 3:], (f(random.uniform(-0.5, 0.5)) for f in (np.sin, np.cos))
                about_z = [c * x - s * y, c * y + s * x, c * z + s * w, c * w - s * z]
                world.commands.set_body(row, [*place, *(np.array(about_z) / np.linalg.norm(about_z))], kind)
            self.hands_due[row] = now + random.uniform(0.05, 1.0)
            self.given += 1

    def judge(self):
        world, state = self.world, self.world.state
        for name in ("body_pose", "body_twist", "joint_position", "joint_velocity", "joint_effort"):
            if not np.isfinite(getattr(state, name)).all():
                self.fault("not finite", name)
        if state.frozen_bodies.any():
            self.fault("diverged", ", ".join(world.frozen()))
        low, high = world.joint_limits.T
        beyond = np.where(self.limited, np.maximum(low - state.joint_position, state.joint_position - high), 0.0)
        gaps = self.places.gaps(state.body_pose)
        if len(beyond) and (worst := int(beyond.argmax())) >= 0 and beyond[worst] > self.beyond[0]:
            self.beyond = (float(beyond[worst]), world.joints[worst])
            if beyond[worst] > LIMIT:
                self.fault("beyond a limit", world.joints[worst])
        if len(gaps) and gaps.max() > self.gap[0]:
            self.gap = (float(gaps.max()), world.joints[self.places.joints[int(gaps.argmax())]])
            if gaps.max() > GAP:
                self.fault("open", self.gap[1])

    def run(self, seconds, wall):
        """Simulated seconds, the real-time factor, and the largest gap afterwards."""
        started, step = time.monotonic(), 0
        try:
            while step * 1e-3 < seconds and time.monotonic() - started < wall and "diverged" not in self.faults:
                self.command_joints(step * 1e-3, self.kinds, self.shares)
                self.command_bodies(step * 1e-3)
                self.world.step(CHUNK)
                step += CHUNK
                self.judge()
            factor = step * 1e-3 / (time.monotonic() - started)
            self.due[:] = 0.0
            self.world.commands.clear()
            self.command_joints(0.0, (JointMode.POSITION,), (1.0,))
            self.world.step(1000)
            for _ in range(10):
                self.world.step(500)
                if np.abs(self.world.state.body_twist).max() < AT_REST:
                    break
            self.judge()
        except Diverged as error:
            self.fault("diverged", str(error))
            return step * 1e-3, step * 1e-3 / (time.monotonic() - started), float("nan")
        gaps = self.places.gaps(self.world.state.body_pose)
        rest = float(gaps.max(initial=0.0))
        if rest > GAP_AT_REST:
            self.fault("open at rest", f"{self.world.joints[self.places.joints[int(gaps.argmax())]]}")
        return step * 1e-3, factor, rest


def short(name):
    return name.split("/")[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=600.0, help="simulated, of each")
    parser.add_argument("--wall", type=float, default=float("inf"), help="s of this clock after which one ends earlier")
    parser.add_argument("--only", nargs="*", default=list(SUBJECTS), choices=list(SUBJECTS), metavar="NAME")
    parser.add_argument("--kinds", nargs="+", default=list(SHARES), choices=list(SHARES), help="what joints are given")
    parser.add_argument("--seed", type=int, default=16)
    options = parser.parse_args()
    print(f"{support.machine()}; joints are given {', '.join(options.kinds)}", flush=True)
    print("| robot or scene | simulated s | real-time factor | commands | past a limit | gap, mm | held, mm |")
    print("|---|---|---|---|---|---|---|", flush=True)
    faults = []
    for name in options.only:
        subject = Subject(SUBJECTS[name], options.kinds, options.seed)
        seconds, factor, rest = subject.run(options.seconds, options.wall)
        (beyond, where), (gap, whose) = subject.beyond, subject.gap
        print(
            f"| {name} | {seconds:.0f} | {factor:.1f} | {subject.given} | {beyond:.2g} {short(where)} "
            f"| {1e3 * gap:.2g} {short(whose)} | {1e3 * rest:.2g} |",
            flush=True,
        )
        faults += [f"{name}: {each}" for each in subject.faults.values()]
        subject.world.close()
    print("\n".join(faults) if faults else "all stayed whole")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
