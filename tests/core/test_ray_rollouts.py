"""The example's ledger: each seed's episode is there once, though workers die. And episodes are what seeds make."""

import sys
from pathlib import Path

import pytest

pytest.importorskip("gymnasium")
import ambf_gym  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "ambf_client_py/examples/learning"))
import ray_rollouts  # noqa: E402
from ray_rollouts import Episode, Ledger  # noqa: E402


def made(seeds):
    return [Episode(seed, True, 50, -1.0, f"{seed:x}") for seed in seeds]


def test_every_seed_is_run_once_though_workers_die():
    ledger = Ledger(range(10))
    first, second = ledger.hand_out("a", 3), ledger.hand_out("b", 3)
    assert (first, second) == ([0, 1, 2], [3, 4, 5])
    ledger.hand_in("a", made(first))
    ledger.lose("b")
    ledger.lose("c")  # which had none
    assert not ledger.finished and list(ledger.waiting) == [3, 4, 5, 6, 7, 8, 9], "what was lost comes first"
    while seeds := ledger.hand_out("a", 4):
        ledger.hand_in("a", made(seeds))
    assert ledger.finished and sorted(ledger.done) == list(range(10))
    assert ledger.hand_out("a", 4) == []


def test_what_is_not_a_workers_is_refused():
    ledger = Ledger(range(4))
    seeds = ledger.hand_out("a", 2)
    with pytest.raises(ValueError, match="not handed in"):
        ledger.hand_out("a", 2)
    for wrong in ([], [0], [0, 1, 2], [2, 3]):
        with pytest.raises(ValueError, match="hands in"):
            ledger.hand_in("a", made(wrong))
    with pytest.raises(ValueError, match="hands in"):
        ledger.hand_in("b", made([2]))  # as one that was lost and comes back
    ledger.hand_in("a", made(seeds))
    with pytest.raises(ValueError, match="hands in"):
        ledger.hand_in("a", made(seeds))
    assert sorted(ledger.done) == seeds
    with pytest.raises(ValueError, match="twice"):
        Ledger([1, 2, 1])


def test_an_episode_is_what_its_seed_makes_of_it():
    ids = [ambf_gym.make("ambf/PsmReach-v0") for _ in range(2)]
    one = [ray_rollouts.run(ids[0], lambda env: env.expert(), seed) for seed in (4, 5)]
    other = [ray_rollouts.run(ids[1], lambda env: env.expert(), seed) for seed in (5, 4)]
    assert one == other[::-1] and one[0].digest != one[1].digest
    assert [(each.success, each.steps) for each in one] == [(True, 50)] * 2
    lazy = ray_rollouts.run(ids[0], lambda env: lambda observation: [0, 0, 0], 4)
    assert not lazy.success and lazy.digest != one[0].digest
    for each in ids:
        each.close()
