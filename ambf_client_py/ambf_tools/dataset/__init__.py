"""Data sets for learning: episodes of ambf_gym's environments in LeRobot's formats 2.1 and 3.0, and in robomimic's.

from ambf_tools import dataset

recorded = dataset.record("ambf/PegTransfer-v0", episodes=50)
dataset.write(recorded, "pegs", "lerobot-2.1")
print(dataset.check("pegs"))
"""

from __future__ import annotations

from pathlib import Path

from . import lerobot, robomimic
from .bags import Stream, from_bags
from .check import Finding, check
from .episodes import FORMATS, Dataset, DatasetError, Episode
from .recorder import record, replay

__all__ = ["FORMATS", "Dataset", "DatasetError", "Episode", "Finding", "Stream"]
__all__ += ["check", "from_bags", "read", "record", "replay", "write"]


def write(data: Dataset, path: str | Path, format: str, video: bool = False) -> None:
    """Writes a folder (LeRobot) or a file (robomimic) that does not exist yet; format: one of FORMATS.

    video: pictures as videos (LeRobot), which lose some detail, instead of PNGs, which lose nothing.
    """
    if format not in FORMATS:
        raise DatasetError(f"format '{format}': one of {', '.join(FORMATS)}")
    if Path(path).exists():
        raise DatasetError(f"{path} exists")
    if video and (format == "robomimic" or not data.pictures()):
        raise DatasetError("robomimic's files hold no videos" if data.pictures() else "there are no pictures")
    if format == "robomimic":
        robomimic.write(data, path)
    else:
        lerobot.write(data, path, format.removeprefix("lerobot-"), video)


def read(path: str | Path) -> Dataset:
    """Reads any of the formats."""
    return lerobot.read(path) if Path(path).is_dir() else robomimic.read(path)
