"""Arms of the CRTK in running simulators. The fixtures are those of tests/conftest.py."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
