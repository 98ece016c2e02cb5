"""A handle class of the user's own, for a kind of object and message types that this package does not know."""

import threading

import pytest
import rospy
from ambf_client import BaseObject, kinds, register_handle
from geometry_msgs.msg import PoseStamped
from harness import eventually
from std_msgs.msg import Float64


class Dial(BaseObject):
    """A made-up kind: a pose, and an angle to command."""

    object_type = "DIAL"
    state_type = PoseStamped
    command_type = Float64

    def __init__(self, a_name: str) -> None:
        super().__init__(a_name, 0.1)

    def turn_to(self, angle):
        command = Float64(angle)
        self.set_command(command)


@pytest.fixture
def dial(ros):
    """Publishes a dial's state 100 times a second; the commands that came."""
    received = []
    publisher = rospy.Publisher("/ambf/env/Dial/State", PoseStamped, queue_size=1)
    subscriber = rospy.Subscriber("/ambf/env/Dial/Command", Float64, lambda message: received.append(message.data))
    state = PoseStamped()
    state.pose.position.z, state.pose.orientation.w = 2.0, 1.0
    ending = threading.Event()

    def run():
        while not ending.wait(0.01):
            state.header.stamp = rospy.Time.now()
            publisher.publish(state)

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    yield received
    ending.set()
    thread.join()
    publisher.unregister()
    subscriber.unregister()


def test_a_registered_class_is_the_handle_of_its_kind(dial, client, monkeypatch):
    monkeypatch.setattr("ambf_client.kinds._handles", dict(kinds._handles))  # forgets the class after the test
    client.refresh()
    assert "/ambf/env/Dial" not in client.get_obj_names()
    assert register_handle(Dial) is Dial
    handle = client.wait_for("Dial")
    assert type(handle) is Dial
    assert handle.position.tolist() == [0.0, 0.0, 2.0]
    handle.turn_to(0.5)
    eventually(lambda: dial and dial[-1] == 0.5)
    with pytest.raises(TypeError):
        handle.set_command(PoseStamped())
