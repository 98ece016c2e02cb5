"""The same commands at the same steps give the same state_hash here and by World/Step over ROS."""

import importlib.util
import os
import shutil
import time

import numpy as np
import pytest
import scenes
from harness import BENCH_ALLOWED, ROOT, SIMULATOR, eventually

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("rospy") is None or shutil.which("rosmaster") is None or not SIMULATOR.exists(),
    reason="no ROS",
)

TASKS = ROOT / "ambf_models/descriptions/launch_tasks.yaml"

# What is commanded before the steps of each call: joints of Base (type, value), wrench on Box (force x, torque z). All
# are float32, as messages carry joints.
CALLS = [
    (5, [(1, 0.5), (1, 0.125)], None),
    (1, [(1, 0.5), (2, -0.25)], (2.0, 0.0)),
    (20, [(0, 0.75), (2, -0.25)], (2.0, 0.5)),
    (700, [(2, 1.5), (1, 0.0625)], None),
]


def over_ros(hashes_of_steps, step):
    from ambf_msgs.msg import RigidBodyCmd

    for n, joints, wrench in CALLS:
        base = RigidBodyCmd(joint_cmds=[value for _, value in joints], joint_cmds_types=[kind for kind, _ in joints])
        box = RigidBodyCmd(cartesian_cmd_type=RigidBodyCmd.TYPE_FORCE if wrench else 0)
        if wrench:
            box.wrench.force.x, box.wrench.torque.z = wrench
        answer = step(n=n, rigid_body_names=["/ambf/env/Base", "/ambf/env/Box"], rigid_body_cmds=[base, box])
        assert answer.success, answer.message
        hashes_of_steps.append(answer.sim_step)


def here(world):
    from ambf_core import BodyMode

    for n, joints, wrench in CALLS:
        for name, (kind, value) in zip(("turn", "lift"), joints, strict=True):
            world.commands.set_joints(value, kind, [name])
        if wrench:
            world.commands.set_body("Box", [wrench[0], 0, 0, 0, 0, wrench[1]], BodyMode.WRENCH)
        else:
            world.commands.body_mode[world.body("Box")] = BodyMode.NONE
        world.step(n)
        yield int(world.state.sim_step), world.hash()


def test_a_world_has_the_hashes_of_the_step_service(tmp_path, master, start, ros):
    import rospy
    from ambf_core import World
    from ambf_tools import read_input

    from ambf_msgs.srv import Step

    recording = tmp_path / "inputs"
    simulator = start(
        "--launch_file", scenes.write(tmp_path), "-l", "0", "--record-input", recording,
        allowed=BENCH_ALLOWED, master_uri=master.uri,
    )  # fmt: skip
    rospy.wait_for_service("/ambf/env/World/Step", 20.0)
    step = rospy.ServiceProxy("/ambf/env/World/Step", Step)
    begun = step(n=0).sim_step  # from here on the world waits
    time.sleep(0.1)
    assert step(n=0).sim_step == begun
    ends = []
    over_ros(ends, step)
    simulator.stop()
    eventually(lambda: not simulator.running(), 10.0, "the simulator has ended")
    frames = read_input.read(recording).frames
    recorded = dict(zip(frames["sim_step"].tolist(), frames["state_hash"].tolist(), strict=True))

    with World(tmp_path / "model.yaml", world=tmp_path / "world.yaml", colors=tmp_path / "colors.yaml") as world:
        world.step(begun)
        assert world.hash() == recorded[begun]
        assert list(here(world)) == [(end, recorded[end]) for end in ends]


RANGES = {
    "joint2": {"damping": [0.5, 2.0], "P": [8.0, 10.0]},
    "link7": {"linear damping": [0.0, 0.2], "mass": [0.5, 2.0], "color": [[0, 0, 0], [1, 1, 1]]},
    "gravity": [[0, 0, -10.3], [0, 0, -9.3]],
    "delay": [0, 2],
    "noise": [0.0, 0.01],
}
NO_FILES = {**RANGES, "link7": {"linear damping": [0.0, 0.2]}}


def episodes(env, actions=34):
    """Of two seeds: what reset and each step return."""
    trace = []
    for seed in (3, 4):
        trace.append(env.reset(seed=seed))
        act = env.unwrapped.expert()
        for _ in range(actions):
            trace.append(env.step(act(trace[-1][0])))
    return trace


def same(got, id, actions=34, **options):
    """Whether these are the episodes of a world in this process."""
    import ambf_gym

    core = ambf_gym.make(id, **options)
    for step, (a, b) in enumerate(zip(got, episodes(core, actions), strict=True)):
        seen, wanted = (each[0] if isinstance(each[0], dict) else {"": each[0]} for each in (a, b))
        for key in seen:
            assert (seen[key] == wanted[key]).all(), (step, key, seen[key] - wanted[key])
        infos = [{k: np.asarray(v).tolist() for k, v in each[-1].get("randomization", {}).items()} for each in (a, b)]
        assert infos[0] == infos[1] and a[1:-1] == b[1:-1], step
        assert bare(a[-1]) == bare(b[-1]), step
    core.close()


def bare(info):
    return {key: value for key, value in info.items() if key != "randomization"}


@pytest.mark.parametrize(
    ("id", "number"),
    [
        ("ambf/RingLift-v0", "1,9"),
        ("ambf/Arm7Reach-v0", 2),
        ("ambf/PsmReach-v0", 15),
        ("ambf/EcmTrack-v0", 16),
    ],
)
def test_an_environment_is_the_same_over_ros(master, start, monkeypatch, id, number):
    ambf_gym = pytest.importorskip("ambf_gym")
    from ambf_client import SimulatorUnavailable

    launch = ("--launch_file", TASKS) if id == "ambf/RingLift-v0" else ()
    simulator = start(*launch, "-l", number, master_uri=master.uri, allowed=BENCH_ALLOWED)
    if number == 2:
        monkeypatch.setattr("ambf_gym.over_ros._DRAWING", 1.0)
        with pytest.raises(ValueError, match="has no window"):
            ambf_gym.make(id, backend="ros", render_mode="human")
    env = ambf_gym.make(id, backend="ros")
    got = episodes(env)
    same(got, id)
    # In a world from which an environment before it removed what all have no use for.
    for further, actions in (("ambf/PegTransfer-v0", 34), ("ambf/AmbfEnv-v0", 20)) if launch else ():
        env.close()
        env = ambf_gym.make(further, backend="ros")
        same(episodes(env, actions), further, actions)
    simulator.stop()
    eventually(lambda: not simulator.running(), 10.0, "the simulator has ended")
    if launch:
        for call in (lambda: env.step(env.action_space.sample()), env.unwrapped.world.snapshot):
            with pytest.raises(SimulatorUnavailable):
                call()
    else:
        start("-l", number, master_uri=master.uri, allowed=BENCH_ALLOWED)
        again = env.reset(seed=3)
        assert (again[0]["observation"] == got[0][0]["observation"]).all(), "the next reset reconnects"
    env.close()


@pytest.mark.parametrize(
    ("id", "numbers", "actions"),
    [("RingWire", "0", 60), ("NeedleRegrasp", "1,10", 30), ("TissueRetract", "11", 16), ("NeedleDrive", "12,13", 50)],
)
def test_a_judge_over_ros_says_the_same_of_each_step(master, start, id, numbers, actions):
    """The ring is at the wire's end and done; the left hand holds the needle; the flap is lifted; a needle is in."""
    ambf_gym = pytest.importorskip("ambf_gym")

    start("--launch_file", TASKS, "-l", numbers, master_uri=master.uri, allowed=BENCH_ALLOWED)
    env = ambf_gym.make(f"ambf/{id}-v0", backend="ros")
    got = episodes(env, actions)
    env.close()
    last = got[actions]
    holds = {
        "RingWire": last[4]["is_success"],
        "NeedleRegrasp": last[0]["observation"][[13, 27]].tolist() == [1, 0] if id == "NeedleRegrasp" else None,
        "TissueRetract": last[0]["achieved_goal"][2] > 0.02,
        "NeedleDrive": last[0]["observation"][-6:].tolist().count(1) == 1,
    }
    assert holds[id]
    same(got, f"ambf/{id}-v0", actions)


@pytest.mark.skipif(not os.environ.get("DISPLAY"), reason="no display")
def test_people_watch_in_the_window_of_a_simulator_that_has_one(master, start):
    """Actions take the time that they simulate there."""
    ambf_gym = pytest.importorskip("ambf_gym")
    id, options = "ambf/Arm7Reach-v0", {"backend": "ros", "render_mode": "human"}
    start("-l", "2", master_uri=master.uri, allowed=BENCH_ALLOWED, display=os.environ["DISPLAY"]).wait_loaded()
    env = ambf_gym.make(id, **options)
    assert env.metadata["render_modes"] == ["human"] and env.render_mode == "human"
    begun = time.monotonic()
    got = episodes(env, 15)
    assert time.monotonic() - begun > 2 * 14 * 0.02
    assert env.render() is None
    env.close()
    same(got, id, 15)


def test_randomisation_over_ros_is_that_of_a_world_here(master, start):
    """Parameters by the service Tune, masses by loading changed text; all of it is undone."""
    ambf_gym = pytest.importorskip("ambf_gym")
    from ambf_client import Client, RequestRefused

    id = "ambf/Arm7Reach-v0"
    start("-l", "2", master_uri=master.uri, allowed=BENCH_ALLOWED)
    with pytest.raises(ValueError, match="lights of a running simulator"):
        ambf_gym.make(id, backend="ros", randomization={"lights": {"key_light": {"cutoff angle": [0.5, 0.6]}}})
    for ranges in (NO_FILES, RANGES):
        env = ambf_gym.make(id, backend="ros", randomization=ranges)
        got = episodes(env, 12)
        assert got[0][1]["randomization"].keys() == got[13][1]["randomization"].keys()
        env.close()
        same(got, id, 12, randomization=ranges)
    env = ambf_gym.make(id, backend="ros")
    same(episodes(env, 12), id, 12)
    env.close()
    with Client("tuner") as client:
        for change, problem in (
            (("joint2", "friction", 0.5), "called 'joint2'"),
            (("link7", "stickiness", 0.5), "no parameter 'stickiness'"),
            (("link7", "friction", -1.0), "friction"),
        ):
            with pytest.raises(RequestRefused, match=problem):
                client.world.set_parameter(*change)
        client.world.set_parameter("link7", "linear P", [1.0, 2.0, 3.0])
        with pytest.raises(ValueError, match="3 numbers"):
            client.world.set_gravity([0.0, -9.81])


FURTHER = """
bodies: [BODY one]
namespace: /test/
BODY one: {name: one, mass: 1, shape: SPHERE, geometry: {radius: 0.1},
  location: {position: {x: 3, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}
"""


def test_what_a_world_over_ros_cannot_do_raises(master, start, monkeypatch):
    ambf_gym = pytest.importorskip("ambf_gym")
    from ambf_client import Client
    from ambf_core import BodyMode
    from ambf_gym import over_ros

    allowed = [*BENCH_ALLOWED, "diverged at step", "more than .* m/s or rad/s"]
    start("-l", 2, master_uri=master.uri, allowed=allowed)
    env = ambf_gym.Arm7Reach(backend="ros")
    world, none = env.world, np.zeros(7, np.float32)
    first, _ = env.reset(seed=1)
    at = world.state.sim_step.item()
    world._shown.remove(world.body("link7"))
    world.commands.set_body("link7", [1, 0, 0, 0, 0, 0], BodyMode.WRENCH)
    with pytest.raises(ValueError, match="link7.*over ROS"):
        world.step(1)
    world._shown.append(world.body("link7"))
    assert world.state.sim_step == at
    assert np.isnan(world.state.joint_commanded).all() and (world.state.contact_bodies == -1).all()

    for link in range(1, 8):
        world.commands.set_body(f"link{link}", [9e8] * 6, BodyMode.WRENCH)
    _, _, _, truncated, info = env.step(none)
    assert truncated and "log" in info["diverged"] and world.state.diverged
    again, _ = env.reset(seed=1)
    assert (again["observation"] == first["observation"]).all() and not world.state.diverged
    assert env.step(none)[3] is False

    with Client("watcher") as client:
        assert len(client.world.list().snapshots) == 1
        env.close()
        assert client.world.list().snapshots == []
        for call in (lambda: world.step(1), env.reset, world.snapshot, world.reconnect):
            with pytest.raises(RuntimeError, match="closed"):
                call()

        ours = {"world": ambf_gym.Arm7Reach.ground}
        further = client.world.load(text=FURTHER)
        with pytest.raises(ValueError, match="/test/one, which this task's files do not load"):
            over_ros.RosWorld(*ambf_gym.Arm7Reach.files, **ours)
        client.world.unload(further)
        monkeypatch.setattr(over_ros, "_STEP", 0.002)
        with pytest.raises(ValueError, match="steps of 0.002 s"):
            over_ros.RosWorld(*ambf_gym.Arm7Reach.files, **ours)
        monkeypatch.undo()
        link = "/ambf/env/arm7/link7"
        over_ros.RosWorld(*ambf_gym.Arm7Reach.files, without=[link], **ours).close()
        assert link not in [each.name for each in client.world.list().objects], "full names, too"
