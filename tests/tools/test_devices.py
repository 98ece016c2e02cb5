"""ambf-cli devices check, with a hand that a test moves; what devices list says about one."""

import math
from dataclasses import replace

import pytest
from ambf_client.devices import Device
from ambf_tools.cli.device_check import DIRECTIONS, Hand, check, describe
from ambf_tools.cli.devices import find_device
from ambf_tools.cli.simulation import CommandError

DEVICE = Device(
    "left hand", "MTML", "ros_arm", "/t", "/tool", ["/camera"], (1.0, 1.0, 1.0), True, True, True, True, 2, 1000.0, 4.0,
    "", {},
)  # fmt: skip


class ScriptedOperator:
    """Does what is asked; `mistakes` maps a text to what is done instead."""

    def __init__(self, mistakes=None):
        self.mistakes, self.hand, self.asked = (
            mistakes or {},
            Hand((0.1, 0.2, 0.3), (0.0, 0.0, 0.0, 1.0), 0, (0,) * 3),
            "",
        )
        self.count = 0

    def ask(self, text):
        self.asked = text

    def begin(self):
        self.count = 0
        self.hand = replace(self.hand, buttons=0)

    def sample(self):
        self.count += 1
        if self.count > 50:
            return None
        if self.count > 1:
            self.act(self.mistakes.get(self.asked, self.asked))
        return self.hand

    def act(self, text):
        for name, axis in DIRECTIONS.items():
            if text == f"push the hand {name}":
                moved = [p + 0.005 * a for p, a in zip(self.hand.position, axis, strict=True)]
                self.hand = replace(self.hand, position=tuple(moved))
        if text == "roll the hand clockwise":
            half = -0.02 * self.count
            self.hand = replace(self.hand, orientation=(math.sin(half), 0.0, 0.0, math.cos(half)))
        if text.startswith("press button"):
            self.hand = replace(self.hand, buttons=1 << int(text[-1]))

    def push(self, force):
        return replace(self.hand, force=tuple(-f if "forces" in self.mistakes else f for f in force))


def remarks(mistakes=None, forces=True):
    steps = check(ScriptedOperator(mistakes), DEVICE, forces)
    return {step.asked: step.remark for step in steps}


def test_a_device_that_reports_what_is_done_passes():
    assert set(remarks().values()) == {""}
    assert len(remarks()) == 3 + 1 + 2 + 3
    assert len(remarks(forces=False)) == 3 + 1 + 2


def test_exchanged_axes_and_buttons_are_named():
    found = remarks({"push the hand up": "push the hand towards you", "press button 0": "press button 1"})
    assert found["push the hand up"].startswith("the hand moved towards you")
    assert found["press button 0"] == "button 1 came"
    assert found["push the hand to the right"] == ""


def test_what_does_not_come_is_said():
    assert remarks({"roll the hand clockwise": "nothing"})["roll the hand clockwise"] == "nothing happened in time"


def test_a_force_in_the_wrong_direction_is_found():
    found = remarks({"forces": True})
    assert found["hold the hand loosely: it is pushed up"] == "-0.50 N of 0.5 N were written to the hand"


def test_motions_are_described_by_their_main_axis():
    assert describe((0.0, -0.031, 0.01)) == "to the left by 3.1 cm"
    assert describe((-0.05, 0.0, 0.0)) == "away from you by 5.0 cm"


def test_devices_are_found_by_any_part_that_fits_one():
    other = replace(DEVICE, name="right hand")
    assert find_device([DEVICE, other], "left") is DEVICE
    for name in ("hand", "middle", ""):
        with pytest.raises(CommandError):
            find_device([DEVICE, other], name)
