"""Sensors by their topics and in answers of steps: every array filled, the Python handle, topics that come and go."""

import struct
import time

import pytest
import rospy
from ambf_client import Sensor
from harness import eventually
from sensor_msgs.msg import PointCloud2

from ambf_msgs.msg import SensorCmd, SensorState

# Above the bench, where nothing else is: three rays along z, one more that ends before what the third one meets.
SENSORS = """
bodies: [BODY post, BODY lid, BODY ball]
sensors: [SENSOR eyes, SENSOR depth]
namespace: /ambf/env/
BODY post: {name: post, mass: 0.0, location: {position: {x: 3, y: 0, z: 1}},
            inertial offset: {position: {x: 0.1, y: 0, z: 0}}, collision shape: BOX,
            collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
BODY lid: {name: lid, mass: 0.0, location: {position: {x: 3, y: 0, z: 1.5}}, collision shape: BOX,
           collision geometry: {x: 0.1, y: 0.1, z: 0.2}}
BODY ball: {name: ball, mass: 0.0, location: {position: {x: 3.3, y: 0, z: 1.4}}, collision shape: SPHERE,
            collision geometry: {radius: 0.1}}
SENSOR eyes:
  name: eyes
  type: Proximity
  parent: BODY post
  location: {position: {x: 0, y: 0, z: 0.1}}
  range: 0.5
  array:
  - {offset: {x: 0, y: 0.02, z: 0}, direction: {x: 0, y: 0, z: 1}}
  - {offset: {x: 0.6, y: 0, z: 0}, direction: {x: 0, y: 0, z: 1}}
  - {offset: {x: 0.3, y: 0, z: 0}, direction: {x: 0, y: 0, z: 1}}
  - {offset: {x: 0.3, y: 0, z: 0}, direction: {x: 0, y: 0, z: 0.2}}
  - {offset: {x: 0, y: -0.02, z: 0}, direction: {x: 0, y: 0, z: 1}}
SENSOR depth: {name: depth, type: Range, parent: BODY post, range: 0.5, array: [
  {offset: {x: 0, y: 0, z: 0.1}, direction: {x: 0, y: 0, z: 1}},
  {offset: {x: 0.6, y: 0, z: 0.1}, direction: {x: 0, y: 0, z: 1}}]}
"""


def test_a_sensor_says_what_each_element_senses(bench, client, tmp_path):
    path = tmp_path / "sensors.yaml"
    path.write_text(SENSORS)
    model = client.load(str(path)).model
    eyes = client.wait_for("eyes")
    assert isinstance(eyes, Sensor)
    result = client.world.step(1)
    assert eyes.get_sim_step() == result.sim_step  # its state is in the answer
    assert eyes.get_count() == 5
    assert [eyes.is_triggered(i) for i in range(5)] == [True, False, True, False, True]
    assert [eyes.get_range(i) for i in range(5)] == pytest.approx([0.5, 0.5, 0.5, 0.1, 0.5])
    # The lid's lower side is 0.3 m above the sensor, the ball's 0.2 m.
    assert eyes.get_all_measurements() == pytest.approx([0.4, 0.0, 0.6, 0.0, 0.4], abs=1e-6)
    assert [eyes.get_sensed_object(i) for i in range(5)] == ["/ambf/env/lid", "", "/ambf/env/ball", "", "/ambf/env/lid"]
    state = eyes._state
    assert list(state.sensed_objects_map) == [0, 1, 2, 1, 0]
    assert state.type.data == "Proximity"
    assert state.parent_name.data == "/ambf/env/post"
    assert state.identifier.data == "/ambf/env/SENSOR eyes"
    assert (state.pose.position.x, state.pose.position.z) == pytest.approx((0.0, 0.1))  # in the body's (mesh) frame

    depth = client.wait_for("depth")
    clouds = []
    points = rospy.Subscriber("/ambf/env/depth/points", PointCloud2, clouds.append)
    eventually(lambda: points.get_num_connections() > 0)
    client.world.step(1)
    assert depth.get_all_measurements() == pytest.approx([0.3, 0.5], abs=1e-6)  # m; the range where there is nothing
    eventually(lambda: clouds)
    assert (clouds[-1].width, clouds[-1].height, clouds[-1].header.frame_id) == (1, 1, "depth")
    assert struct.unpack("<3f", clouds[-1].data) == pytest.approx((0.0, 0.0, 0.4), abs=1e-6)
    points.unregister()

    lid = client.wait_for("lid")
    lid.set_pos(3.0, 0.0, 1.4)
    client.world.step(1)
    assert eyes.get_measurement(0) == pytest.approx(0.6, abs=1e-6)
    client.remove("ball")
    client.world.step(0)
    assert not eyes.is_triggered(2)
    assert eyes.get_sensed_object(2) == ""

    client.world.release()
    stamps = []
    subscriber = rospy.Subscriber("/ambf/env/eyes/State", SensorState, lambda message: stamps.append(time.monotonic()))
    commands = rospy.Publisher("/ambf/env/eyes/Command", SensorCmd, queue_size=1)
    eventually(lambda: len(stamps) > 5 and commands.get_num_connections() > 0)
    eyes_before = len(stamps)
    end = time.monotonic() + 0.6
    while time.monotonic() < end:
        commands.publish(SensorCmd(actuate=[True]))
        time.sleep(0.02)
    assert len(stamps) - eyes_before > 60  # commanded: beyond 50 Hz, as every object
    assert not eyes.is_triggered(2)  # and without another effect
    subscriber.unregister()
    commands.unregister()

    client.unload(model)
    eventually(lambda: not any(topic == "/ambf/env/eyes/State" for topic, _ in rospy.get_published_topics()))
