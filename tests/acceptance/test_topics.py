"""What is offered on ROS, under which names and types, how often, and with which contents."""

import re
import time

import pytest
import scenes
from harness import ROOT, SLOWNESS, eventually

from ambf_msgs.msg import CameraState, LightState, RigidBodyCmd, RigidBodyState, WorldRates, WorldState

WORLD_TOPICS = {
    "/ambf/env/World/State": "ambf_msgs/WorldState",
    "/ambf/env/World/Rates": "ambf_msgs/WorldRates",
    "/ambf/env/World/CommandRates": "ambf_msgs/WorldCommandRates",
    "/ambf/env/World/Contacts": "ambf_msgs/WorldContacts",
    "/ambf/env/World/Success": "ambf_msgs/WorldSuccess",
    "/ambf/env/World/StepCommands": "ambf_msgs/StepCommands",
}
WORLD_SUBSCRIPTIONS = {"World/Command", "World/Command/Reset", "World/Command/Reset/Bodies"}
SERVICES = {"Load", "Unload", "Remove", "Save", "List", "Step", "Snapshot", "Restore", "Record", "Received", "Hold"}
SERVICES |= {"Forget", "Tune"}


def body_names(path):
    """`name` of the bodies that are not passive, from the text of a file."""
    blocks = re.split(r"^(?=\S)", path.read_text(), flags=re.M)
    # Those without topics, and those elsewhere, are left out.
    unwanted = re.compile(r"^  (passive: (true|1)|namespace:)", re.M | re.I)
    blocks = [b for b in blocks if b.startswith("BODY ") and not unwanted.search(b)]
    return [re.search(r"^  name: (.+)", block, re.M).group(1).replace(" ", "") for block in blocks]


def test_the_shipped_scene_offers_a_pair_for_every_object(master, start):
    simulator = start(master_uri=master.uri, allowed=[r"peg_transfer.*(gains cannot be stable|warnings\))"])
    scene = ROOT / "ambf_models/descriptions/multi-bodies/puzzles/peg_transfer.yaml"
    bodies = body_names(scene)
    assert len(bodies) > 5
    expected = dict(WORLD_TOPICS)
    expected.update({f"/ambf/env/{name}/State": "ambf_msgs/RigidBodyState" for name in bodies})
    expected.update({f"/ambf/env/cameras/{n}/State": "ambf_msgs/CameraState" for n in ("main_camera", "close_camera")})
    lights = ("key_light", "fill_light", "back_light")
    expected.update({f"/ambf/env/lights/{n}/State": "ambf_msgs/LightState" for n in lights})
    eventually(lambda: expected.items() <= master.published().items(), 20.0, f"{expected} in {master.published()}")
    commands = {topic.replace("/State", "/Command") for topic in expected if topic.endswith("/State")}
    commands |= {f"/ambf/env/{name}" for name in WORLD_SUBSCRIPTIONS}
    eventually(lambda: commands <= set(master.state()[1]), 20.0, "every object hears its commands")
    services = {name for name in master.state()[2] if name.startswith("/ambf/")}
    assert services == {f"/ambf/env/World/{name}" for name in SERVICES}
    simulator.stop()
    eventually(lambda: not master.names(), 5.0, "all is unregistered")


@pytest.mark.tsan
def test_a_robot_of_the_original_moves_on_command(master, start, ros, compat):
    """The one test that goes all the way: ADF, physics thread, topics, commands, throttling, services, exit."""
    from ambf_msgs.msg import WorldCmd
    from ambf_msgs.srv import List, Step

    psm = compat / "multi-bodies/robots/blender-psm.yaml"
    simulator = start(
        "--launch_file",
        compat / "launch.yaml",
        "-a",
        psm,
        master_uri=master.uri,
        allowed=[r"blender-psm\.yaml"],
    )
    base = "/ambf/env/psm/baselink"
    eventually(lambda: f"{base}/State" in master.published(), 30.0, "the robot's topics")
    state = ros.listen(f"{base}/State", RigidBodyState)
    first = state.last()
    assert first.name.data == "baselink"
    assert first.identifier.data.endswith("BODY base link")
    assert first.joint_names == []  # its file does not want them
    bodies = {f"/ambf/env/psm/{name}/State" for name in body_names(psm)}
    eventually(lambda: bodies <= set(master.published()), 20.0, "a topic for every body")

    talk = ros.talk(f"{base}/Command", RigidBodyCmd)
    talk.publish(RigidBodyCmd(publish_joint_names=True, publish_joint_positions=True))
    first = state.next(lambda m: len(m.joint_names) > 6)
    assert len(first.joint_names) == len(first.joint_positions) == len(first.joint_velocities)
    command = RigidBodyCmd(joint_cmds=[0.2], joint_cmds_types=[1])
    begin = first.joint_positions[0]

    def moved():
        talk.publish(command)
        return abs(state.last().joint_positions[0] - 0.2) < 0.02

    eventually(moved, 10.0, f"joint 0 goes from {begin} to 0.2", 0.005)

    listing = ros.service("/ambf/env/World/List", List)("")
    assert listing.success and {o.topic for o in listing.objects if o.kind == "rigid_body" and o.topic}
    step = ros.service("/ambf/env/World/Step", Step)
    one = step(n=1)
    assert one.success
    two = step(n=25, wanted_states=[base])
    assert two.sim_step == one.sim_step + 25
    assert two.rigid_bodies[0].sim_step == two.sim_step
    world = ros.talk("/ambf/env/World/Command", WorldCmd)
    world.publish(WorldCmd(False, False, 1))
    state.next(lambda m: m.sim_step > two.sim_step + 10, what="it runs on")
    code, _ = simulator.stop()
    assert code == 0


def test_states_are_complete(bench, ros):
    slide = ros.listen("/ambf/env/Slide/State", RigidBodyState).last()
    assert slide.name.data == "Slide"
    assert slide.identifier.data == "/ambf/env/BODY Slide"
    assert slide.mass == pytest.approx(0.5)
    assert slide.pInertia.x == pytest.approx(0.5 * 0.01 / 6.0, rel=1e-4)
    assert slide.pose.position.z == pytest.approx(0.5, abs=1e-3)
    assert slide.sim_step > 0 and slide.sim_time > 0.0 and slide.wall_time > 0.0
    assert slide.sim_time == pytest.approx(slide.sim_step * 0.001, rel=1e-3)
    assert slide.header.stamp.to_sec() == pytest.approx(ros.rospy.Time.now().to_sec(), abs=5.0)

    plate = ros.listen("/ambf/env/Plate/State", RigidBodyState).last()
    assert plate.joint_names == ["lift"]
    assert [name.split("/")[-1] for name in plate.children_names] == ["Slide"]
    base = ros.listen("/ambf/env/Base/State", RigidBodyState).last()
    assert base.joint_names == ["turn", "lift"]
    assert len(base.joint_positions) == len(base.joint_velocities) == len(base.joint_efforts) == 2
    assert base.children_names == []  # not asked for by its file

    eye = ros.listen("/ambf/env/cameras/eye/State", CameraState).last()
    assert eye.name.data == "eye"
    assert eye.pose.position.x == pytest.approx(3.0)
    sun = ros.listen("/ambf/env/lights/sun/State", LightState).last()
    assert sun.name.data == "sun"
    assert sun.pose.position.z == pytest.approx(3.0)

    world = ros.listen("/ambf/env/World/State", WorldState).last()
    assert world.sim_step > 0 and world.n_devices == 0
    rates = ros.listen("/ambf/env/World/Rates", WorldRates)
    latest = rates.next(lambda m: m.real_time_factor > 0.5, 10.0, "a settled real-time factor")
    assert latest.mode == WorldRates.REAL_TIME
    assert latest.solver == "direct"
    assert latest.fixed_time_step == pytest.approx(0.001)
    assert latest.bodies_awake + latest.bodies_asleep == 5
    assert len(latest.phase_names) == len(latest.phase_seconds) > 0
    assert latest.topics == 2 * 7 + 9 and latest.subscribers >= 6
    assert {"physics", "publisher", "commands"} <= {thread.name for thread in latest.threads}


def test_publishing_lists_on_request_lasts(bench, ros):
    state = ros.listen("/ambf/env/Base/State", RigidBodyState)
    assert state.last().children_names == []
    ros.talk("/ambf/env/Base/Command", RigidBodyCmd).publish(RigidBodyCmd(publish_children_names=True))
    assert len(state.next(lambda m: m.children_names).children_names) == 2
    later = state.last().sim_step + 800  # the watchdog has expired by then
    assert len(state.next(lambda m: m.sim_step > later).children_names) == 2


@pytest.mark.alone
@pytest.mark.skipif(SLOWNESS > 1.0, reason="rates are for programs at full speed")
def test_rates_follow_commands(bench, ros):
    state = ros.listen("/ambf/env/Box/State", RigidBodyState)
    state.last()
    assert state.rate() == pytest.approx(50.0, rel=0.2)
    talk = ros.talk("/ambf/env/Box/Command", RigidBodyCmd)
    at = len(state.messages)
    for _ in range(200):
        talk.publish(RigidBodyCmd())
        time.sleep(0.005)
    busy = state.messages[at:]
    assert len(busy) > 500  # of 1000; python itself is slow
    steps = [message.sim_step for message in busy]
    assert len(set(steps)) > 0.95 * len(steps)  # something new each time
    time.sleep(0.8)
    assert state.rate() == pytest.approx(50.0, rel=0.2)


@pytest.mark.alone
def test_override_replaces_all_rates(tmp_path, master, start, ros):
    start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0"),
        *("--override_min_comm_freq", "200", "--override_max_comm_freq", "200"),
        master_uri=master.uri,
    )
    state = ros.listen("/ambf/env/Box/State", RigidBodyState)
    state.last(20.0)
    assert state.rate() == pytest.approx(200.0, rel=0.2 * SLOWNESS)


def test_names_that_ros_does_not_allow_get_topics(tmp_path, master, start, ros):
    text = scenes.model(
        {
            "a": scenes.box("a", 1.0, (0, 0, 0)).replace("name: a", "name: left-arm.link"),
            "b": scenes.box("b", 1.0, (1, 0, 0)).replace("name: b", "name: left_arm_link"),
        }
    )
    start("--launch_file", scenes.write(tmp_path, text), "-l", "0", master_uri=master.uri)
    wanted = {"/ambf/env/left_arm_link/State", "/ambf/env/left_arm_link1/State"}
    eventually(lambda: wanted <= set(master.published()), 20.0, "both have topics of their own")
    names = {ros.listen(topic, RigidBodyState).last().name.data for topic in wanted}
    assert names == {"left-arm.link", "left_arm_link"}
