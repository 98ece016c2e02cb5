"""What docs/learning.md shows runs, and so do the examples."""

import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


def page_programs():
    return re.findall(r"```python\n(.*?)```", (ROOT / "docs/learning.md").read_text(), re.DOTALL)


def test_the_programs_of_the_page_run(capsys):
    programs = [each for each in page_programs() if "ambf_gym" not in each]
    assert len(programs) == 3
    for program in programs:
        exec(compile(program, "docs/learning.md", "exec"), {})
    said = capsys.readouterr().out
    assert "(16, 7)" in said and "(240, 320, 3) float32 /ambf/env" in said


def test_an_environment_of_ones_own_takes_less_than_60_lines():
    pytest.importorskip("gymnasium")
    from gymnasium.utils.env_checker import check_env

    (program,) = [each for each in page_programs() if "ambf_gym" in each]
    assert 20 < len(program.splitlines()) < 60
    names = {}
    exec(compile(program, "docs/learning.md", "exec"), names)
    assert np.isfinite(names["reward"]) and names["reward"] < 0 and names["truncated"] is False
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(names["env"].unwrapped, skip_render_check=True)


def test_random_search_comes_nearer_to_the_goal():
    script = ROOT / "ambf_client_py/examples/learning/reach_with_random_search.py"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(each for each in sys.path if each)}
    command = [sys.executable, str(script), "--worlds", "4", "--rounds", "4"]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=120)
    assert done.returncode == 0, done.stderr
    far = [float(number) for number in re.findall(r": ([\d.]+) mm", done.stdout)]
    assert len(far) == 4 and far[-1] < far[0] and far == sorted(far, reverse=True)
