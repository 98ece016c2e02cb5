"""The short form of episodes.py, for CI: it finds what it shall find, and nothing in some resets."""

import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("gymnasium")
sys.path.insert(0, str(Path(__file__).parent))
import episodes  # noqa: E402

ID = "ambf/Arm7Reach-v0"


def test_a_spread_is_told_from_an_uneven_one():
    even = np.linspace(2, 4, 101)
    gap, distance = episodes.spread(even, 2, 4)
    assert gap == 0 and distance < 0.011
    assert episodes.spread(even[:91], 2, 4)[0] == pytest.approx(0.1)
    assert episodes.spread(even[:51] * 2 - 2, 2, 4)[1] < 0.02
    assert episodes.spread(2 + 2 * ((even - 2) / 2) ** 2, 2, 4)[1] == pytest.approx(0.25, abs=0.02)
    assert episodes.spread([1.9, 3.0], 2, 4)[0] == np.inf
    assert episodes.spread(np.stack([even, even[::-1] * 0 + 3], axis=1), [2, 2], [4, 4])[0] == 0.5


def test_what_is_drawn_is_judged(monkeypatch):
    drawn = {"joint1": {"P": [5.0, 20.0]}, "delay": [0, 3]}
    monkeypatch.setitem(episodes.RANGES, ID, drawn)
    rows, faults = episodes.randomised(ID, 20)
    assert faults == [] and [row[1] for row in rows] == ["joint1 P", "delay"]
    monkeypatch.setitem(episodes.RANGES, ID, {"joint1": {"P": [5.0, 5.0 + 1e-10]}})
    monkeypatch.setattr(episodes, "has", lambda env, name, key, value: value < 5.0 + 5e-11)
    faults = episodes.randomised(ID, 20)[1]
    assert [each.partition("joint1 P ")[2] for each in faults] == ["is not what info says", "makes no difference"]


@pytest.mark.parametrize("over_and_over", [episodes.reset_over_and_over, episodes.make_over_and_over])
def test_growth_is_seen(over_and_over):
    case = episodes.Case("some", ID, {}, 5)
    numbers = list(over_and_over(case, 5))
    assert len(numbers) == 5 and numbers[0]["threads"] == numbers[-1]["threads"]
    assert numbers[1]["files"] == numbers[-1]["files"]

    def grows(case, times):
        for k in range(times):
            yield {"memory": 100.0 + 0.03 * max(0, k - 99), "threads": 1 + (k == 199), "files": 3}

    row, faults = episodes.growth(grows, case, 200)
    assert row[2] == "+3.00 %" and faults == ["some: 1 threads more", "some: memory grew by 3.00 %"]
