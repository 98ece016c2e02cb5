"""Progress bars where something takes long: tqdm's, or none where it is not installed."""

from types import TracebackType
from typing import Any


class _Silent:
    """What tqdm offers and we use, without effect."""

    def __init__(self) -> None:
        self.n: float = 0
        self.total: float | None = None

    def update(self, n: float = 1) -> None:
        """Counts."""
        self.n += n

    def refresh(self) -> None:
        """Draws nothing."""

    def set_description_str(self, text: str) -> None:
        """Says nothing."""

    def __enter__(self) -> "_Silent":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        pass


def bar(total: float | None, shown: bool, **options: Any) -> Any:
    """A bar for so much work; drawn on standard error if `shown`, and if that is a terminal."""
    try:
        from tqdm import tqdm
    except ImportError:
        return _Silent()
    return tqdm(total=total, disable=None if shown else True, leave=False, **options)
