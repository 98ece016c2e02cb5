"""What docs/learning.md shows runs, and so do the examples."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_programs_of_the_page_run(capsys):
    programs = re.findall(r"```python\n(.*?)```", (ROOT / "docs/learning.md").read_text(), re.DOTALL)
    assert len(programs) == 2
    for program in programs:
        exec(compile(program, "docs/learning.md", "exec"), {})
    assert "(16, 7)" in capsys.readouterr().out


def test_random_search_comes_nearer_to_the_goal():
    script = ROOT / "ambf_client_py/examples/learning/reach_with_random_search.py"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(each for each in sys.path if each)}
    command = [sys.executable, str(script), "--worlds", "4", "--rounds", "4"]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, timeout=120)
    assert done.returncode == 0, done.stderr
    far = [float(number) for number in re.findall(r": ([\d.]+) mm", done.stdout)]
    assert len(far) == 4 and far[-1] < far[0] and far == sorted(far, reverse=True)
