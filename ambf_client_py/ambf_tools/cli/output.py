"""How results are printed: tables and lines for people, JSON for programs."""

import json
import math
import sys
from collections.abc import Iterable, Sequence
from typing import Any


class Output:
    """Prints the results of one command. With as_json: one JSON document a result, nothing else."""

    def __init__(self, as_json: bool) -> None:
        self.as_json = as_json
        self.reported = False  # the result reported the failure itself: no JSON about the error beside it

    def result(self, data: Any, text: str | Iterable[str]) -> None:
        """Prints a result: `data` as JSON, or the lines of text."""
        if self.as_json:
            print(json.dumps(plain(data), ensure_ascii=False), flush=True)
            return
        for line in [text] if isinstance(text, str) else text:
            print(line, flush=True)

    def note(self, text: str) -> None:
        """Says something beside the result."""
        if not self.as_json:
            print(text, file=sys.stderr, flush=True)


def plain(value: Any) -> Any:
    """ROS messages, dataclasses and arrays as what JSON knows. NaN and infinities become null."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, str | int):
        return value
    if isinstance(value, dict):
        return {str(key): plain(inner) for key, inner in value.items()}
    if isinstance(value, bytes):
        return list(value)
    if isinstance(value, list | tuple | set):
        return [plain(inner) for inner in value]
    if hasattr(value, "to_sec"):
        return value.to_sec()
    if hasattr(value, "__slots__") and hasattr(value, "_type"):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if hasattr(value, "__dict__"):
        return {name: plain(inner) for name, inner in vars(value).items()}
    return plain(value.tolist()) if hasattr(value, "tolist") else str(value)


def counted(count: int, noun: str) -> str:
    """The count with its noun: "1 joint", "2 joints"."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> list[str]:
    """Lines of a table; numbers are right-aligned."""
    cells = [[_cell(value) for value in row] for row in rows]
    numeric = [bool(cells) and all(_is_number(row[i]) for row in cells) for i in range(len(head))]
    widths = [max(len(row[i]) for row in [list(head), *cells]) for i in range(len(head))]

    def line(row: Sequence[str]) -> str:
        parts = [
            text.rjust(width) if right else text.ljust(width)
            for text, width, right in zip(row, widths, numeric, strict=True)
        ]
        return "  ".join(parts).rstrip()

    return [line(head), line(["-" * width for width in widths]), *(line(row) for row in cells)]


def number(value: float, digits: int = 4) -> str:
    """A number as people like it: 0.0123, 12.34, 1.2e-05; - where there is none."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "-"
    if abs(value) < 1e-9:  # what solvers leave of a zero
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        text = f"{value:.{digits}f}"
        return text.rstrip("0").rstrip(".") if "." in text else text
    return f"{value:.{digits}g}"


def vector(values: Iterable[float]) -> str:
    """Several numbers in one line."""
    return "  ".join(number(value) for value in values)


def _cell(value: Any) -> str:
    return number(value) if isinstance(value, float) else str(value)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return text == "-"
    return True
