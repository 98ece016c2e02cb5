"""Jaws of PSMs open outward: each half is on the side to which it turns as they open, so that halves never cross."""

import math

import pytest
import yaml
from harness import ROOT

MODELS = ROOT / "ambf_models"
FILES = [
    *(MODELS / "descriptions/multi-bodies/robots").glob("psm*.yaml"),
    *(MODELS / "dvrk").glob("psm?.yaml"),
    *(MODELS / "instruments").glob("*.yaml"),
]
HALVES = ("tool gripper1 link", "tool gripper2 link")


def across(shape):
    """Range along the body's x of a box that is turned by quarters, or of a bar, by its corners."""
    at, turn = shape["offset"]["position"], shape["offset"]["orientation"]
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(turn[k]), math.cos(turn[k])) for k in "rpy")
    row = (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr)  # x of the body, by the shape's axes
    half = sum(abs(each) * size / 2 for each, size in zip(row, (shape["geometry"][k] for k in "xyz"), strict=True))
    return at["x"] - half, at["x"] + half


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_each_half_of_a_jaw_is_on_the_side_to_which_it_opens(path):
    model, found = yaml.safe_load(path.read_text()), 0
    for half in HALVES:
        joint = next(
            model[name]
            for name in model["joints"]
            if name.endswith(f"tool pitch link-{half}") and model[name]["type"] == "revolute"
        )
        opens = -joint["child axis"]["z"]  # along x: where the half's tip, at +y, goes as the joint's value rises
        body = model[f"BODY {half}"]
        shapes = [each for each in body["compound collision shape"] if each["shape"] == "BOX"]
        assert abs(opens) == 1 and shapes
        for shape in shapes:
            low, high = (opens * each for each in across(shape))
            assert min(low, high) > -1e-6, (half, shape)
            found += 1
    assert found >= 2
