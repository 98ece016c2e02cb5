"""Drivers of real hardware from outside: the records of a gamepad in a FIFO move a tool of a scene."""

import os
import struct

from harness import eventually

from ambf_msgs.msg import RigidBodyState

TOOL = """
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
input devices: [Pad]
Pad:
  hardware name: Gamepad
  driver: {path: js0, speed: 0.1}
  root link: tool
  workspace scaling: 1
"""
AXIS, RIGHT_STICK_UP = 2, 4


def send_axis(fifo, number, value):
    os.write(fifo, struct.pack("IhBB", 0, value, AXIS, number))


def test_a_gamepad_moves_a_tool_and_is_found_again(tmp_path, master, start, ros):
    (tmp_path / "tool.yaml").write_text(TOOL)
    (tmp_path / "devices.yaml").write_text(DEVICES)
    launch = tmp_path / "launch.yaml"
    launch.write_text("input devices config: devices.yaml\nmultibody configs: [tool.yaml]\n")
    os.mkfifo(tmp_path / "js0")
    simulator = start(
        "--launch_file", launch, "-l", "0", "-n", "1", master_uri=master.uri, allowed=["the hardware is gone"]
    )
    simulator.wait_log("device 'Pad' moves '/ambf/env/tool'")
    simulator.wait_log("device 'Pad' is connected")
    state = ros.listen("/ambf/env/tool/State", RigidBodyState)

    def height():
        return state.next().pose.position.z

    def rises_to(wanted):
        fifo = os.open(tmp_path / "js0", os.O_WRONLY)
        send_axis(fifo, RIGHT_STICK_UP, -32767)
        eventually(lambda: height() > wanted, 20.0, f"the tool rises above {wanted} m")
        os.close(fifo)  # unplugged, with the stick still up
        simulator.wait_log("the hardware is gone")

    start_m = height()
    rises_to(start_m + 0.05)
    eventually(lambda: abs(height() - height()) < 1e-5, 20.0, "it rests where it was left")
    rises_to(height() + 0.05)
