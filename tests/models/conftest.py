"""Lets tests import what they share and the scripts that made the scenes."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "ambf_models/scripts")]
