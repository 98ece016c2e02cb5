"""Input devices from outside: scripted ones, chosen with -n and -i, move tools of a scene."""

import pytest
from harness import eventually

from ambf_msgs.msg import DeviceMapping, RigidBodyState
from ambf_msgs.srv import SetDevice

GRIPPER = """
bodies: [BODY tool]
joints: []
namespace: /ambf/env/
high resolution path: ./
low resolution path: ./
BODY tool:
  name: tool
  mass: 0.5
  inertia: {ix: 0.001, iy: 0.001, iz: 0.001}
  location: {position: {x: 0, y: 0, z: 0.5}}
  gravity: {x: 0, y: 0, z: 0}
  collision shape: SPHERE
  collision geometry: {radius: 0.02}
"""

DEVICES = """
input devices: [Still, Line, Wrong, Own]
Still: {hardware name: Scripted, root link: tool}
Own:
  hardware name: Scripted
  simulated multibody: gripper.yaml
  location: {position: {x: 0.3, y: 0, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}
Line:
  hardware name: Scripted
  driver: {type: scripted, motion: line, axis: z, size: 0.05, rate: 3}
  root link: tool
  workspace scaling: 2
Wrong: {hardware name: Scripted}
"""


OWN_GRIPPER = """
bodies: [BODY finger, BODY palm]
joints: [JOINT knuckle]
namespace: /ambf/env/
high resolution path: ./
low resolution path: ./
BODY palm: {name: palm, mass: 0.5, location: {position: {x: 0, y: 0, z: 0.1}}, gravity: {x: 0, y: 0, z: 0},
  collision shape: SPHERE, collision geometry: {radius: 0.02}}
BODY finger: {name: finger, mass: 0.1, location: {position: {x: 0, y: 0, z: 0.05}}, gravity: {x: 0, y: 0, z: 0},
  collision shape: SPHERE, collision geometry: {radius: 0.01}}
JOINT knuckle: {name: knuckle, type: revolute, parent: BODY palm, child: BODY finger, joint limits: {low: 0, high: 1},
  parent pivot: {x: 0, y: 0, z: -0.03}, child pivot: {x: 0, y: 0, z: 0.02},
  parent axis: {x: 1, y: 0, z: 0}, child axis: {x: 1, y: 0, z: 0}}
"""


@pytest.fixture
def launch_file(tmp_path):
    (tmp_path / "gripper.yaml").write_text(OWN_GRIPPER)
    (tmp_path / "tool.yaml").write_text(GRIPPER)
    (tmp_path / "devices.yaml").write_text(DEVICES)
    launch = tmp_path / "launch.yaml"
    launch.write_text("input devices config: devices.yaml\nmultibody configs: [tool.yaml]\n")
    return launch


def test_a_device_named_with_i_moves_its_tool(launch_file, master, start, ros):
    simulator = start("--launch_file", launch_file, "-l", "0", "-i", "Line", master_uri=master.uri, allowed=["Wrong"])
    simulator.wait_log("device 'Line' moves '/ambf/env/tool'")
    state = ros.listen("/ambf/env/tool/State", RigidBodyState)
    heights = []

    def swings():
        heights.append(state.next().pose.position.z)
        return max(heights) - min(heights) > 0.1  # 2 x 0.05 m to each side

    eventually(swings, 20.0, "the tool follows the device")
    assert "device 'Still'" not in simulator.log()
    assert "waited for" not in simulator.log(), "while the models were loaded, nothing was missing"


def test_a_name_that_is_not_in_the_file_ends_the_program(launch_file, start):
    simulator = start("--launch_file", launch_file, "-l", "0", "-i", "Line, 7", "--no-ros", allowed=["Wrong", "-i 7"])
    eventually(lambda: not simulator.running(), 20.0, "it ends")
    assert "-i 7: " in simulator.log()
    assert "lists Still, Line, Wrong" in simulator.log()
    assert simulator.process.returncode == 2


def test_schemes_of_a_shared_tool_and_the_topics_of_a_devices_own_one(launch_file, master, start, ros):
    simulator = start(
        "--launch_file", launch_file, "-i", "Still,Line,Own", "-l", "0", master_uri=master.uri, allowed=["Wrong"]
    )
    simulator.wait_log("device 'Own' moves '/ambf/env/simulated_device/Own'")
    own = ros.listen("/ambf/env/simulated_device/Own/State", RigidBodyState).last()
    assert own.pose.position.x == pytest.approx(0.3, abs=0.01), "its root link is put at `location`"
    assert own.pose.position.z == pytest.approx(0.5, abs=0.01)
    assert own.joint_names == ["knuckle"]
    topics = master.published()
    assert not {"/ambf/env/palm/State", "/ambf/env/finger/State"} & set(topics), "its other bodies have none"

    still = ros.listen("/physical_device_0/Still/Mapping", DeviceMapping)
    line = ros.listen("/physical_device_1/Line/Mapping", DeviceMapping)
    change = ros.service("/World/SetDevice", SetDevice)
    assert not change("Own", "scheme", [4]).success, "it shares no tool"
    assert change("Line", "scheme", [4]).success  # aiao: the first moves, the second turns it
    still.next(lambda m: m.linear_stiffness.x > 0.0 and m.angular_stiffness.x == 0.0, what="the first moves it")
    line.next(lambda m: m.linear_stiffness.x == 0.0 and m.angular_stiffness.x > 0.0, what="the second turns it")
