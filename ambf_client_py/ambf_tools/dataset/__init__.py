"""Data sets for learning: episodes of ambf_gym's environments in LeRobot's formats 2.1 and 3.0, and in robomimic's.

from ambf_tools import dataset

recorded = dataset.record("ambf/PegTransfer-v0", episodes=50)
dataset.write(recorded, "pegs", "lerobot-2.1")
print(dataset.check("pegs"))
"""

from __future__ import annotations

from pathlib import Path

from . import lerobot, robomimic
from .check import Finding, check
from .episodes import FORMATS, Dataset, DatasetError, Episode
from .recorder import record, replay

__all__ = ["FORMATS", "Dataset", "DatasetError", "Episode", "Finding", "check", "read", "record", "replay", "write"]


def write(data: Dataset, path: str | Path, format: str) -> None:
    """Writes a folder (LeRobot) or a file (robomimic) that does not exist yet; format: one of FORMATS."""
    if format not in FORMATS:
        raise DatasetError(f"format '{format}': one of {', '.join(FORMATS)}")
    if Path(path).exists():
        raise DatasetError(f"{path} exists")
    if format == "robomimic":
        robomimic.write(data, path)
    else:
        lerobot.write(data, path, format.removeprefix("lerobot-"))


def read(path: str | Path) -> Dataset:
    """Reads any of the formats."""
    return lerobot.read(path) if Path(path).is_dir() else robomimic.read(path)
