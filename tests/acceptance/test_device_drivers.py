"""Drivers of real hardware from outside: a gamepad's records in a FIFO, a tracker behind ROS move a tool of a scene."""

import os
import struct

from harness import Client, eventually

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


TRACKED = """
input devices: [Tracker]
Tracker: {hardware name: any, driver: {type: ros_generic, pose: /tracker/pose}, root link: tool}
"""
# A hand that swings, until it is killed.
TRACKER = """
import math, time, rospy
from geometry_msgs.msg import PoseStamped
rospy.init_node("tracker", anonymous=True, disable_signals=True, disable_rosout=True)
talk = rospy.Publisher("/tracker/pose", PoseStamped, queue_size=1, tcp_nodelay=True)
message, begin = PoseStamped(), time.monotonic()
message.pose.orientation.w = 1.0
while True:
    message.header.stamp = rospy.Time.now()
    message.pose.position.z = 0.05 * math.sin(5.0 * (time.monotonic() - begin))
    talk.publish(message)
    time.sleep(0.01)
"""
# Prints how high the tool is, until it is killed.
HEIGHTS = """
import time, rospy
from ambf_msgs.msg import RigidBodyState
rospy.init_node("heights", anonymous=True, disable_signals=True, disable_rosout=True)
rospy.Subscriber("/ambf/env/tool/State", RigidBodyState, lambda state: print(state.pose.position.z, flush=True))
time.sleep(1000)
"""


def test_a_ros_device_goes_on_without_its_master_and_is_found_at_the_next(tmp_path, start, own_master):
    (tmp_path / "tool.yaml").write_text(TOOL)
    (tmp_path / "devices.yaml").write_text(TRACKED)
    launch = tmp_path / "launch.yaml"
    launch.write_text("input devices config: devices.yaml\nmultibody configs: [tool.yaml]\n")
    simulator = start(
        *("--launch_file", launch, "-l", "0", "-n", "1"),
        master_uri=own_master.uri,
        allowed=["does not answer", "Tracker"],
    )
    heights = Client(HEIGHTS, own_master.uri)
    trackers = [Client(TRACKER, own_master.uri)]

    def seen():
        return [float(line) for line in heights.lines()[-30:]]

    def swings():
        return len(seen()) == 30 and max(seen()) - min(seen()) > 0.005

    try:
        eventually(swings, 20.0, "the tool follows the tracker")
        connected = simulator.log().count("device 'Tracker' is connected")
        own_master.kill()
        simulator.wait_log("does not answer")
        eventually(swings, 5.0, "it does so without a master")
        assert simulator.log().count("device 'Tracker' is connected") == connected, "and was never lost"

        trackers[0].kill()
        simulator.wait_log("the hardware is gone")
        eventually(lambda: max(seen()) - min(seen()) < 1e-5, 20.0, "the tool rests where it was left")
        left = seen()[-1]
        own_master.start()
        trackers.append(Client(TRACKER, own_master.uri))
        eventually(swings, 30.0, "a new tracker at the new master moves it")
        assert abs(seen()[0] - left) < 0.1, "from where it was"
    finally:
        for client in [heights, *trackers]:
            client.kill()
