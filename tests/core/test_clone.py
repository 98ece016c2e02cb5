"""The example that clones an expert: a short form of it runs from the recording to the rates, and fits unseen rows."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("gymnasium")
pytest.importorskip("pyarrow")

SCRIPT = Path(__file__).resolve().parents[2] / "ambf_client_py/examples/learning/clone_peg_transfer.py"


@pytest.fixture
def script():
    spec = importlib.util.spec_from_file_location("clone_peg_transfer", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_clone_of_some_episodes_is_near_the_expert_in_another_one(script, tmp_path, capsys, monkeypatch):
    """Too short to succeed always: docs/learning.md has the rate of the whole one."""
    data, model = tmp_path / "data", tmp_path / "clone.npz"
    words = ["--episodes", "3", "--epochs", "80", "--judged", "1", "--data", str(data), "--model", str(model)]
    _, expert = script.main(words)
    assert expert == 1.0 and "expert: 100.0 % of 1 unseen" in capsys.readouterr().out

    recorded = script.dataset.read(data)
    assert len(recorded.episodes) == 3 and script.dataset.check(data) == []
    inputs, actions = script.rows_of(recorded)
    assert len(inputs) == sum(len(episode) - script.ASIDE for episode in recorded.episodes)
    starts = [episode.columns["observation.state"][script.ASIDE, 3:6] for episode in recorded.episodes]
    assert np.ptp(starts, axis=0).min() > 0.005, "no two episodes begin alike"

    other = script.dataset.record(script.ID, 1, 99, script.begin_aside(script.expert), randomization=script.RANGES)
    unseen, wanted = script.rows_of(other)
    clone = script.load(model)
    error = np.sqrt(np.mean((clone.layers(unseen)[-1] - wanted) ** 2, axis=0))
    assert (error < 0.8 * wanted.std(axis=0)).all() and error.mean() < 0.5 * wanted.std(axis=0).mean()

    monkeypatch.setenv("CLONE", str(model))
    columns = other.episodes[0].columns
    seen = {"observation": columns["observation.state"][10], "desired_goal": columns["observation.desired_goal"][10]}
    played = script.make_policy(None)(seen)
    now = script.features(seen["observation"], seen["desired_goal"])
    assert played == pytest.approx(np.clip(clone.layers(np.concatenate([now, now])[None])[-1][0], -1, 1), abs=1e-6)
