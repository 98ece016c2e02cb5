"""Actuators from outside: grasp, carry, release; what is refused; lists, steps and snapshots."""

import pytest
import scenes
from geometry_msgs.msg import Pose, Quaternion
from harness import BENCH_ALLOWED, eventually
from std_msgs.msg import String

from ambf_msgs.msg import ActuatorCmd, ActuatorState
from ambf_msgs.srv import Step

HANDS = (
    scenes.model(
        {
            "hand": scenes.box("hand", 2.0, (0.0, 0.0, 1.0)),
            "cube": scenes.box("cube", 0.5, (0.3, 0.0, 1.0)),
            "other": scenes.box("other", 0.5, (0.0, 0.5, 1.0)),
        }
    )
    + """\
actuators: [ACTUATOR grip]
ACTUATOR grip:
  name: grip
  type: Constraint
  parent: BODY hand
  location: {position: {x: 0.1, y: 0.0, z: 0.0}, orientation: {r: 0.0, p: 0.0, y: 0.0}}
"""
)


@pytest.fixture
def simulator(tmp_path, master, start, ros):
    launch = scenes.write(tmp_path, HANDS)
    made = start("--launch_file", launch, "-l", "0", master_uri=master.uri, allowed=BENCH_ALLOWED)
    made.wait_loaded()
    yield made
    made.stop()


@pytest.fixture
def client(simulator):
    from ambf_client import Client

    with Client() as made:
        yield made


def distance(one, other):
    return sum((a - b) ** 2 for a, b in zip(one.position, other.position, strict=True)) ** 0.5


def test_the_client_grasps_carries_and_lets_go(simulator, client, ros):
    grip, hand, cube = client.wait_for("grip"), client.wait_for("hand"), client.wait_for("cube")
    state = ros.listen("/ambf/env/grip/State", ActuatorState).next()
    assert state.type.data == "Constraint"
    assert state.parent_name.data == "/ambf/env/hand"
    assert state.identifier.data == "/ambf/env/ACTUATOR grip"
    assert state.pose.position.x == pytest.approx(0.1)
    assert not grip.is_actuated()

    grip.actuate("BODY cube")
    eventually(grip.is_actuated)
    for _ in range(40):
        hand.set_linear_vel(0.0, 0.0, 0.5)
        assert hand.wait_for_next_state()
    eventually(lambda: cube.position[2] > 1.02)
    assert distance(hand, cube) == pytest.approx(0.3, abs=2e-3)  # states of the two may be a step apart
    grip.deactuate()
    eventually(lambda: not grip.is_actuated())

    offset = Pose()
    offset.position.x, offset.orientation.w = -0.15, 1.0
    grip.actuate("other", pose=offset)
    other = client.wait_for("other")
    eventually(lambda: grip.is_actuated() and distance(hand, other) == pytest.approx(0.25, abs=2e-3))
    grip.deactuate()


def test_a_silent_client_loses_its_grasp_and_wrong_commands_are_refused(simulator, client, ros):
    simulator.allowed += [r"command to '.*' refused", r"watchdog", r"expired"]
    talk = ros.talk("/ambf/env/grip/Command", ActuatorCmd)
    state = ros.listen("/ambf/env/grip/State", ActuatorState)
    talk.publish(ActuatorCmd(actuate=True, body_name=String("hand")))
    simulator.wait_log("'/ambf/env/grip' refused: it cannot hold the body that it sits on")
    assert not state.next().actuated
    talk.publish(ActuatorCmd(actuate=True, body_name=String("/ambf/env/BODY cube")))
    held = state.next(lambda m: m.actuated)
    released = state.next(lambda m: m.sim_step > held.sim_step and not m.actuated)
    assert released.sim_step - held.sim_step == pytest.approx(500, abs=150)


def test_steps_snapshots_and_lists_know_actuators(simulator, client, ros):
    simulator.allowed += [r"command to '.*' refused", r"refused: command to 'grip'", r"and \d+ more refused"]
    listed = {each.name: each for each in client.list().objects}
    assert listed["/ambf/env/grip"].kind == "actuator"
    assert listed["/ambf/env/grip"].parent == "/ambf/env/hand"
    step = ros.service("/ambf/env/World/Step", Step)

    def actuate(name, n=5, **values):
        command = ActuatorCmd(actuate=True, body_name=String(name), **values)
        return step(n=n, actuator_names=["grip"], actuator_cmds=[command], wanted_states=["grip", "cube"])

    nan = Pose(orientation=Quaternion(0.0, 0.0, 0.0, float("nan")))
    for answer, reason in (
        (actuate("BODY hand"), "it cannot hold the body that it sits on"),
        (actuate("/ambf/env/World"), "it cannot hold the world"),
        (actuate("no such body"), "there is no body 'no such body'"),
        (actuate(""), "there is no body ''"),
        (actuate("BODY"), "there is no body 'BODY' (or several fit)"),
        (actuate("cube", use_offset=True, body_offset=nan), "body_offset: orientation is not finite"),
    ):
        assert not answer.success
        assert reason in answer.message
    assert actuate("cube").actuators[0].actuated

    client.world.snapshot("held")
    first = step(n=700, wanted_states=["grip", "cube"])
    assert not first.actuators[0].actuated, "its watchdog let go"
    client.world.restore("held")
    assert step(n=0, wanted_states=["grip"]).actuators[0].actuated
    second = step(n=700, wanted_states=["grip", "cube"])
    assert second.rigid_bodies[0].pose == first.rigid_bodies[0].pose
    assert client.remove("/ambf/env/grip") == ["/ambf/env/grip"]


def test_a_grasp_repeats_in_a_replay_of_inputs(tmp_path, master, start, ros):
    """Commands of actuators name objects."""
    file = tmp_path / "grasp.ambfin"
    launch = scenes.write(tmp_path, HANDS)
    made = start(
        "--launch_file", launch, "-l", "0", "--record-input", file, master_uri=master.uri, allowed=BENCH_ALLOWED
    )
    made.wait_loaded()
    state = ros.listen("/ambf/env/grip/State", ActuatorState)
    command = ros.talk("/ambf/env/grip/Command", ActuatorCmd)
    grasp = ActuatorCmd(actuate=True, body_name=String("BODY cube"), use_offset=True)
    grasp.body_offset.position.x, grasp.body_offset.orientation.w = 0.05, 1.0
    command.publish(grasp)
    state.next(lambda message: message.actuated, what="it holds the cube")
    assert made.stop()[0] == 0
    again = start("--replay-input", file)
    assert again.process.wait(60.0) == 0, again.log()
