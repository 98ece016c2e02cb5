"""The short form of attack.py, for CI: three rounds, without kills of the master.

In three rounds memory still settles, and the processors of CI have other tests to run: the hour is judged by attack.py.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from attack import Attack  # noqa: E402
from harness import SLOWNESS  # noqa: E402


def test_strangers_neither_end_nor_hold_up_nor_swell_the_simulator(tmp_path, master, ros):
    attack = Attack(tmp_path, master, seed=1)
    try:
        for _ in range(3):
            attack.round(2.0)
        figures = attack.figures()
    finally:
        code, _ = attack.close()
    assert not attack.faults and code == 0, (attack.faults, attack.simulator.log()[-2000:])
    assert len(attack.counts) == 13 and min(attack.counts.values()) > 0, attack.counts
    assert figures["slowest call"] < 5.0 * SLOWNESS, figures
    assert figures["slowest recovery"] < 5.0 * SLOWNESS, figures
    before, after = figures["memory"]
    assert after < before + 64.0, figures
