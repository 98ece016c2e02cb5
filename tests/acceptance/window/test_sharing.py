"""Several users at one simulation: a camera moved by mouse and ROS in turn, and bodies dragged in two windows."""

import math
import os
import signal
import time

import pytest
import worlds
import x11
from program import drawn

pytestmark = pytest.mark.alone  # hands that drag want pictures in time

FRONT, SIDE = (1.0, 0.0, ""), (0.1, 1.1, "")

# A free block on the floor, in the middle of both windows; so flat that it never comes to rest on an edge.
BLOCK = """
adf version: 1.0
namespace: /test/
bodies: [BODY block]
BODY block:
  name: block
  shape: Box
  geometry: {x: 0.4, y: 0.4, z: 0.2}
  collision shape: Box
  collision geometry: {x: 0.4, y: 0.4, z: 0.2}
  mass: 1.0
  color components: {diffuse: {r: 0.2, g: 0.5, b: 0.3}}
  location: {position: {x: 0.0, y: 0.0, z: 0.1}}
"""
AT_REST, LIFTED = 0.1, 0.13  # m


class Block:
    """Where the block is."""

    def __init__(self, ros):
        from ambf_msgs.msg import RigidBodyState

        self.state = ros.listen("/test/block/State", RigidBodyState)

    def height(self):
        return self.state.messages[-1].pose.position.z if self.state.messages else 0.0

    def is_lifted(self):
        x11.eventually(lambda: self.height() > LIFTED, 20.0, lambda: f"lifted: {self.height()}")

    def falls(self):
        x11.eventually(lambda: abs(self.height() - AT_REST) < 0.01, 20.0, lambda: f"fallen: {self.height()}")


@pytest.fixture
def shared(server, user, start, tmp_path, master, ros):
    """A program with two windows in picking mode, and the block."""
    launch = worlds.write(tmp_path, {"one": FRONT, "two": SIDE}, things=BLOCK)
    simulator = start(server.name, "--launch_file", launch, "-l", "0", ros=True)
    for number in (1, 2):
        user.window(number)
        drawn(user, number)
    block = Block(ros)
    x11.eventually(lambda: block.state.messages, 20.0, "states of the block")
    user.window(1)
    user.key("p")
    return simulator, block


def middle(user, number):
    left, top, width, height = user.place(number)
    return left + width // 2, top + height // 2


def press_and_lift(user, number, block):
    """Presses on the block and pulls it upwards; the button stays down."""
    x, y = middle(user, number)
    user.point(x, y)
    user.button(1, True)
    for i in range(1, 21):
        user.point(x, y - 5 * i)
        time.sleep(0.05)
    block.is_lifted()
    return x, y - 100


def test_a_body_is_dragged_in_either_of_two_windows(shared, user):
    _, block = shared
    for number in (1, 2, 1):
        other = 3 - number
        before = user.picture_of(other)
        press_and_lift(user, number, block)
        x11.eventually(lambda o=other, b=before: user.picture_of(o) != b, 20.0, "the other window shows it, too")
        user.button(1, False)
        block.falls()


def test_a_press_counts_where_it_was_though_the_picture_comes_late(shared, user):
    simulator, block = shared
    x, y = middle(user, 1)
    user.point(x, y)
    time.sleep(0.3)
    os.kill(simulator.process.pid, signal.SIGSTOP)  # a slow picture
    user.button(1, True)
    for i in range(1, 21):
        user.point(x, y - 5 * i)
    os.kill(simulator.process.pid, signal.SIGCONT)
    block.is_lifted()
    user.button(1, False)


def test_a_button_let_go_outside_of_the_window_ends_the_drag(shared, user):
    _, block = shared
    press_and_lift(user, 1, block)
    outside = (3, 3)
    left, top, width, height = user.place(1)
    assert not (left <= outside[0] < left + width and top <= outside[1] < top + height)
    user.point(*outside)
    user.button(1, False)
    block.falls()
    x, y = middle(user, 1)
    for i in range(12):  # nothing hangs at the pointer any more
        user.point(x, y - 5 * i)
        time.sleep(0.05)
    time.sleep(0.5)
    assert abs(block.height() - AT_REST) < 0.01


def test_closing_the_window_in_the_middle_of_a_drag_lets_go(shared, user):
    simulator, block = shared
    press_and_lift(user, 1, block)
    user.ask_to_close(user.windows()[1])
    x11.eventually(lambda: set(user.windows()) == {2}, 10.0, lambda: user.windows())
    block.falls()
    user.button(1, False)
    assert simulator.process.poll() is None
    user.window(2)
    press_and_lift(user, 2, block)
    user.button(1, False)
    block.falls()


def test_mouse_and_ros_move_one_camera_in_turn_each_from_where_it_is(server, user, start, tmp_path, master, ros):
    """Dissertation §3.4.3."""
    from ambf_msgs.msg import CameraCmd, CameraState

    start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT}), "-l", "0", ros=True)
    user.window()
    drawn(user)
    eye = ros.listen("/test/cameras/one/State", CameraState)
    talk = ros.talk("/test/cameras/one/Command", CameraCmd)
    x11.eventually(lambda: eye.messages, 20.0, "states of the camera")

    def place():
        position = eye.messages[-1].pose.position
        return (position.x, position.y, position.z)

    def rests():
        """Where it is once it does not move."""
        seen = []

        def still():
            seen.append(place())
            return len(seen) > 10 and all(math.dist(each, seen[-1]) < 1e-9 for each in seen[-10:])

        x11.eventually(still, 20.0, lambda: f"a camera at rest: {seen[-3:]}")
        return seen[-1]

    def pan():
        """By the mouse; how far that was."""
        before = rests()
        x, y = middle(user, 1)
        user.drag(1, (x, y), (x + 40, y + 10))
        x11.eventually(lambda: math.dist(place(), before) > 1e-3, 20.0, "the mouse moves the camera")
        return math.dist(before, rests())

    first = pan()
    assert first > 0.01
    for target in ((1.5, 0.3, 0.9), (0.8, -0.4, 0.6)):
        command = CameraCmd(enable_position_controller=True)
        command.pose = eye.messages[-1].pose
        command.pose.position.x, command.pose.position.y, command.pose.position.z = target
        talk.publish(command)
        x11.eventually(lambda t=target: math.dist(place(), t) < 1e-6, 20.0, lambda: f"ROS moves it: {place()}")
        assert math.dist(rests(), target) < 1e-6, "and it stays there"
        shift = pan()
        assert 0.01 < shift < 5 * first, "the mouse goes on from where ROS left it"
        assert math.dist(place(), target) < 5 * first
