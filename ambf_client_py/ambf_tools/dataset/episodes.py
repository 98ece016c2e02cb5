"""Episodes of a task, as all formats hold them: rows are what was seen before an action, and what came of it."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray

STATE, ACTION = "observation.state", "action"
REWARD, DONE, SUCCESS = "next.reward", "next.done", "next.success"
FORMATS = ("lerobot-2.1", "lerobot-3.0", "robomimic")


class DatasetError(ValueError):
    """A data set that cannot be read or written, and why."""


@dataclass
class Episode:
    """One episode. columns: one array a feature, (rows, ...) each; SI units."""

    columns: dict[str, NDArray[Any]]
    seed: int | None = None  # of reset
    randomization: dict[str, Any] = field(default_factory=dict)  # what reset drew

    def __len__(self) -> int:
        return len(self.columns[ACTION])

    @property
    def success(self) -> bool:
        """Whether the task was done at the end."""
        return bool(self.columns[SUCCESS][-1])


@dataclass
class Dataset:
    """Episodes of one environment; all have the same columns."""

    fps: int  # rows a second of simulated time
    task: str  # in words
    robot: str
    environment: str  # its id
    options: dict[str, Any] = field(default_factory=dict)  # of its constructor
    episodes: list[Episode] = field(default_factory=list)
    names: dict[str, list[str]] = field(default_factory=dict)  # of the numbers of a column, where they have some
    left_out: list[str] = field(default_factory=list)  # parts of its source that gave no episode, and why; not written

    def features(self) -> dict[str, tuple[str, tuple[int, ...]]]:
        """Type (numpy's name) and shape of one row of each column."""
        columns = self.episodes[0].columns
        return {name: (array.dtype.name, array.shape[1:] or (1,)) for name, array in columns.items()}

    def pictures(self) -> list[str]:
        """Names of the columns of pictures (height, width, 3) of 8 bits."""
        return [name for name, (kind, shape) in self.features().items() if kind == "uint8" and len(shape) == 3]

    @property
    def source(self) -> str:
        """Where its episodes come from, in words."""
        return self.environment or "recordings of " + ", ".join(self.options.get("bags", ["unknown origin"]))

    @property
    def synchronised(self) -> str:
        """How the columns of a row belong together, in words."""
        if self.environment:
            return "All that a row observes is of one step of the simulation."
        return (
            "A row holds the last state and picture at its time, by their stamps in simulated time, and the last"
            " command before the next row."
        )

    @property
    def frames(self) -> int:
        """Rows of all episodes."""
        return sum(map(len, self.episodes))


def check_writable(dataset: Dataset) -> None:
    """Raises DatasetError where no format could hold it."""
    if not dataset.episodes:
        raise DatasetError("there are no episodes")
    features = dataset.features()
    for needed in (ACTION, STATE, REWARD, DONE, SUCCESS):
        if needed not in features:
            raise DatasetError(f"there is no column '{needed}'")
    for number, episode in enumerate(dataset.episodes):
        found = {name: (array.dtype.name, array.shape[1:] or (1,)) for name, array in episode.columns.items()}
        if found != features:
            raise DatasetError(f"episode {number} has other columns than the first: {found}, not {features}")
        if len({len(array) for array in episode.columns.values()}) != 1 or len(episode) == 0:
            raise DatasetError(f"the columns of episode {number} have no rows, or not equally many")


def plain(value: Any) -> Any:
    """The same in what JSON knows."""
    return json.loads(json.dumps(value, default=lambda each: each.tolist() if hasattr(each, "tolist") else str(each)))
