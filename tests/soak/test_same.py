"""The short form of same.py, for CI: runs are the same, and it sees one that is not."""

import sys
from pathlib import Path

import pytest

pytest.importorskip("gymnasium")
sys.path.insert(0, str(Path(__file__).parent))
import same  # noqa: E402

ID = "ambf/PsmReach-v0"


def test_a_run_beside_others_is_the_same(monkeypatch):
    monkeypatch.setattr(same, "OTHERS", ("Arm7Reach", "RingWire"))
    assert same.beside(ID, 500) == same.last_of(same.run(ID, 500))


def test_another_world_is_another_digest(monkeypatch):
    plain = same.last_of(same.run(ID, 500))
    assert same.main(["--share", "0.02", "--only", "history", "--id", ID]) == 0
    monkeypatch.setitem(same.RANGES, ID, {"baselink-yawlink": {"damping": [0.0, 0.201]}})
    assert same.last_of(same.run(ID, 500)) != plain
    monkeypatch.setattr(same, "fresh", lambda *arguments: "another")
    assert same.main(["--share", "0.02", "--only", "history", "--id", ID]) == 1
