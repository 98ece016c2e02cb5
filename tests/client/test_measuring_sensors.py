"""Contact sensors, IMUs, force torque sensors and World/Contacts through the public face."""

import pytest
from ambf_client import ContactSensor, Sensor
from geometry_msgs.msg import WrenchStamped
from harness import eventually
from sensor_msgs.msg import Imu, JointState

from ambf_msgs.msg import ContactForces, WorldContacts

SCENE = """\
adf version: 1.0
namespace: /ambf/env/
bodies: [BODY Desk, BODY Weight, BODY Tool]
joints: [JOINT wrist]
sensors: [SENSOR feel, SENSOR imu, SENSOR gauge]
BODY Desk: {name: Desk, mass: 0.0, location: {position: {x: 4.0, y: 0.0, z: 0.0}}, collision shape: BOX,
            collision geometry: {x: 1.0, y: 1.0, z: 0.1}}
BODY Weight: {name: Weight, mass: 2.0, location: {position: {x: 4.0, y: 0.0, z: 0.1001}}, collision shape: BOX,
              collision geometry: {x: 0.1, y: 0.1, z: 0.1}, gravity: {x: 0.0, y: 0.0, z: -9.81}}
BODY Tool: {name: Tool, mass: 0.5, location: {position: {x: 4.4, y: 0.0, z: 0.5}},
            gravity: {x: 0.0, y: 0.0, z: -9.81}, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}}
JOINT wrist: {name: wrist, type: fixed, parent: BODY Desk, child: BODY Tool, parent axis: {x: 0, y: 0, z: 1},
              child axis: {x: 0, y: 0, z: 1}, parent pivot: {x: 0.4, y: 0, z: 0.3}, child pivot: {x: 0, y: 0, z: -0.2}}
SENSOR feel: {name: feel, type: Contact, parent: BODY Desk}
SENSOR imu: {name: imu, type: IMU, parent: BODY Tool, location: {orientation: {r: 1.5707963, p: 0, y: 0}}}
SENSOR gauge: {name: gauge, type: Force Torque, joint: JOINT wrist,
               location: {position: {x: 0, y: 0, z: -0.2}, orientation: {r: 1.5707963, p: 0, y: 0}}}
"""


def test_sensors_measure_what_mechanics_says(bench, client, ros, master):
    loaded = client.load(text=SCENE)
    assert {"/ambf/env/feel", "/ambf/env/imu", "/ambf/env/gauge"} <= set(loaded.objects)
    feel = client.wait_for("feel")
    assert isinstance(feel, ContactSensor)
    assert isinstance(client.wait_for("imu"), Sensor)
    eventually(lambda: feel.get_num_contact_events() == 1)
    assert feel.get_parent_name() == "/ambf/env/Desk"
    assert feel.get_all_contact_object_names() == ["/ambf/env/BODY Weight"]
    assert feel.get_contact_object_name(0) == "/ambf/env/BODY Weight"
    assert feel.get_contact_object_name(1) is None
    for point in feel.get_contact_event(0).contact_data:
        assert point.contact_normal.z == pytest.approx(-1.0, abs=1e-3)
        assert point.contact_point.z == pytest.approx(0.05, abs=1e-3)

    def settled(message):
        return sum(force.z for force in message.forces) == pytest.approx(-2.0 * 9.81, rel=0.02)

    forces = ros.listen("/ambf/env/feel/forces", ContactForces).next(settled)
    assert set(forces.object_names) == {"/ambf/env/BODY Weight"}

    # The sensors' y axes point up.
    wrench = ros.listen("/ambf/env/gauge/Wrench", WrenchStamped).next(
        lambda m: m.wrench.force.y == pytest.approx(0.5 * 9.81, rel=0.01)
    )
    assert wrench.header.frame_id == "/ambf/env/gauge"
    assert abs(wrench.wrench.torque.x) < 0.01
    assert ros.listen("/ambf/env/gauge/JointState", JointState).last().name == ["wrist"]
    gravity = ros.listen("/ambf/env/imu/Imu", Imu).last().linear_acceleration
    # The bench's world has no gravity of its own.
    assert [gravity.x, gravity.y, gravity.z] == pytest.approx([0.0, 0.0, 0.0], abs=0.05)

    contacts = ros.listen("/ambf/env/World/Contacts", WorldContacts).next(lambda m: m.total > 0)
    assert {"/ambf/env/Desk", "/ambf/env/Weight"} <= set(contacts.names)
    assert len(contacts.points) == len(contacts.forces) == len(contacts.body_a) == contacts.total

    client.remove("/ambf/env/Desk")
    eventually(lambda: feel.get_num_contact_events() == 0)
    client.unload(loaded)
    eventually(lambda: not any("gauge" in name or "imu" in name for name in master.names()), 5.0, "topics are gone")
