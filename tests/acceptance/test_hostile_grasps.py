"""Commands to actuators and sensors that no sane client sends: refused and counted; the simulation goes on (PR2)."""

import random
import struct
from io import BytesIO

import scenes
from geometry_msgs.msg import Point, Pose, Quaternion
from harness import BENCH_ALLOWED, eventually
from std_msgs.msg import String

from ambf_msgs.msg import ActuatorCmd, ActuatorState, SensorCmd, SensorState, WorldCmd, WorldRates
from ambf_msgs.srv import Step

SCENE = (
    scenes.model(
        {
            "hand": scenes.box("hand", 2.0, (0.0, 0.0, 1.0)),
            "cube": scenes.box("cube", 0.5, (0.3, 0.0, 1.0)),
        }
    )
    + """\
actuators: [ACTUATOR grip]
ACTUATOR grip: {name: grip, type: Constraint, parent: BODY hand}
sensors: [SENSOR eye]
SENSOR eye:
  name: eye
  type: Proximity
  parent: BODY hand
  range: 0.5
  array: [{offset: {x: 0, y: 0, z: 0}, direction: {x: 1, y: 0, z: 0}}]
"""
)
ODD = (float("nan"), float("inf"), -float("inf"), 1e308, -1e-308, 0.0, 1.0, 1e7)
NAMES = (
    "", "cube", "BODY cube", "hand", "BODY hand", "eye", "SENSOR eye", "World", "/ambf/env/World", "/", "no one",
    "%s%n", "\x1b[2J", "a" * 5000, "cube\n[ERROR] forged",
)  # fmt: skip


class RawActuator(ActuatorCmd):
    raw = b""

    def serialize(self, buff):
        buff.write(self.raw)


class RawSensor(SensorCmd):
    raw = b""

    def serialize(self, buff):
        buff.write(self.raw)


def bytes_of(message):
    buffer = BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def number(dice):
    return dice.choice(ODD) if dice.random() < 0.3 else dice.uniform(-1.0, 1.0)


def actuator_command(dice):
    offset = Pose(
        position=Point(number(dice), number(dice), number(dice)),
        orientation=Quaternion(number(dice), number(dice), number(dice), number(dice)),
    )
    return ActuatorCmd(
        actuate=dice.random() < 0.8,
        body_name=String(dice.choice(NAMES)),
        use_offset=dice.random() < 0.5,
        body_offset=offset,
        use_sensor_data=dice.random() < 0.3,
        sensor_identifier=String(dice.choice(NAMES)),
    )


def damaged(dice, message):
    """A length that lies, a torn end, or bytes of noise."""
    raw = bytearray(bytes_of(message))
    for _ in range(dice.randrange(1, 4)):
        place = dice.randrange(len(raw))
        raw[place] = dice.randrange(256)
    if dice.random() < 0.5:
        place = dice.randrange(len(raw) - 3)
        raw[place : place + 4] = struct.pack("<I", 500_000_000)
    return bytes(raw[: dice.randrange(len(raw) + 1)]) if dice.random() < 0.5 else bytes(raw)


def test_random_commands_are_refused_and_counted_and_harm_nothing(tmp_path, master, start, ros):
    launch = scenes.write(tmp_path, SCENE)
    allowed = [*BENCH_ALLOWED, r"refused", r"more refused commands", r"beyond which no command takes a body"]
    simulator = start("--launch_file", launch, "-l", "0", master_uri=master.uri, allowed=allowed)
    simulator.wait_loaded()
    grip = ros.listen("/ambf/env/grip/State", ActuatorState)
    eye = ros.listen("/ambf/env/eye/State", SensorState)
    rates = ros.listen("/ambf/env/World/Rates", WorldRates)
    commands = ros.talk("/ambf/env/grip/Command", ActuatorCmd)
    raw_commands = ros.talk("/ambf/env/grip/Command", RawActuator)
    sensor_commands = ros.talk("/ambf/env/eye/Command", SensorCmd)
    raw_sensor_commands = ros.talk("/ambf/env/eye/Command", RawSensor)
    step = ros.service("/ambf/env/World/Step", Step)
    dice = random.Random(15)
    for i in range(300):
        commands.publish(actuator_command(dice))
        sensor_commands.publish(SensorCmd(actuate=[dice.random() < 0.5] * dice.choice((0, 1, 7, 100_000))))
        for talk, raw, message in (
            (raw_commands, RawActuator(), actuator_command(dice)),
            (raw_sensor_commands, RawSensor(), SensorCmd(actuate=[True] * 9)),
        ):
            raw.raw = damaged(dice, message)
            talk.publish(raw)
        if i % 30 == 0:
            names = [dice.choice(("grip", "eye", "no one", "cube", "a" * 5000)) for _ in range(dice.randrange(3))]
            step(n=1, actuator_names=names, actuator_cmds=[actuator_command(dice) for _ in range(len(names))])

    def refused(rates):
        return dict(zip(rates.refused_names, rates.refused_counts, strict=True))

    rates.next(lambda m: refused(m).get("/ambf/env/grip", 0) > 100 and "/ambf/env/eye" in refused(m), 30.0)
    assert len(simulator.log()) < 50_000, "one line for many"
    assert "\x1b" not in simulator.log() and "\n[ERROR] forged" not in simulator.log()

    # What is sane is obeyed as before, once what was in force is over.
    commands.publish(ActuatorCmd(actuate=False))
    ros.talk("/ambf/env/World/Command", WorldCmd).publish(WorldCmd())  # ends the throttle of the Step service
    grip.next(lambda m: not m.actuated)

    def holds():
        commands.publish(ActuatorCmd(actuate=True, body_name=String("cube")))
        return grip.last().actuated

    eventually(holds, what="the cube is held")
    state = eye.last()
    assert state.count == len(state.measurement) == 1
    assert simulator.running()
