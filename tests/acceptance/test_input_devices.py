"""Input devices from outside: scripted ones, chosen with -n and -i, move tools of a scene."""

import pytest
from harness import eventually

from ambf_msgs.msg import RigidBodyState

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
input devices: [Still, Line, Wrong]
Still: {hardware name: Scripted, root link: tool}
Line:
  hardware name: Scripted
  driver: {type: scripted, motion: line, axis: z, size: 0.05, rate: 3}
  root link: tool
  workspace scaling: 2
Wrong: {hardware name: Scripted}
"""


@pytest.fixture
def launch_file(tmp_path):
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


def test_a_name_that_is_not_in_the_file_ends_the_program(launch_file, start):
    simulator = start("--launch_file", launch_file, "-l", "0", "-i", "Line, 7", "--no-ros", allowed=["Wrong", "-i 7"])
    eventually(lambda: not simulator.running(), 20.0, "it ends")
    assert "-i 7: " in simulator.log()
    assert "lists Still, Line, Wrong" in simulator.log()
    assert simulator.process.returncode == 2
