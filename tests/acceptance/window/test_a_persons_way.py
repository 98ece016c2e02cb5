"""The first thing to try: in the default scene a person takes a gripper by keyboard and mouse and carries a ring."""

import time

import pytest
from carrying import Carrier
from program import drawn

pytestmark = pytest.mark.alone  # hands that steer by what they see want pictures in time

KEY_SPEED, PIXEL, NOTCH = 0.05, 2e-4, 5e-4  # m/s, m, m with Shift: usual ones of keyboard_mouse
AWAY, TOWARDS = 4, 5  # the wheel, as mouse buttons


class KeyboardAndMouse:
    """Keys for the long ways, the mouse for what is left."""

    KEYS = (("d", "e"), ("Right", "Left"), ("Up", "Down"))  # towards the operator and away, right, up

    def __init__(self, user):
        self.user = user
        left, top, width, height = user.place()
        self.x, self.y = left + width // 2, top + height // 2
        user.point(self.x, self.y)
        user.key("g")

    def nudge(self, *way):
        for keys, metres in zip(self.KEYS, way, strict=True):
            if abs(metres) > 0.012:
                key = keys[0] if metres > 0.0 else keys[1]
                self.user.hold(key, True)
                time.sleep((abs(metres) - 0.006) / KEY_SPEED)
                self.user.hold(key, False)
        dx, dy, dz = (metres if abs(metres) <= 0.012 else 0.0 for metres in way)
        self.x, self.y = self.x + round(dy / PIXEL), self.y - round(dz / PIXEL)
        self.user.point(self.x, self.y)
        notches = round(abs(dx) / NOTCH)
        if notches == 0:
            return
        time.sleep(0.4)  # Shift must not slow the pointer's motion down
        self.user.hold("Shift_L", True)
        for _ in range(notches):
            self.user.button(TOWARDS if dx > 0.0 else AWAY, True)
            self.user.button(TOWARDS if dx > 0.0 else AWAY, False)
        time.sleep(0.4)
        self.user.hold("Shift_L", False)

    def close_jaw(self):
        self.user.key("Return")

    def open_jaw(self):
        self.user.key("Return")


def test_keyboard_and_mouse_carry_a_ring_to_another_peg(server, user, start, master, ros):
    from ambf_msgs.msg import RigidBodyState

    simulator = start(server.name, ros=True)
    user.window()
    drawn(user)
    gripper = ros.listen("/ambf/env/right_gripper/State", RigidBodyState)
    still = gripper.last().pose.position
    user.hold("Up", True)
    time.sleep(0.5)
    user.hold("Up", False)
    assert abs(gripper.last().pose.position.z - still.z) < 1e-4, "nothing moves before G"
    Carrier(ros, KeyboardAndMouse(user)).carry()
    user.key("g")
    assert "Keyboard" not in simulator.log(), "what nobody asked for is not reported"
