"""What words on the command line may be: numbers in their ranges, lists, assignments. Needs no ROS."""

import argparse
import math
import re
from collections.abc import Callable
from typing import Any

_NEGATIVE = re.compile(r"-((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|inf(inity)?|nan)$", re.IGNORECASE)


class Parser(argparse.ArgumentParser):
    """Takes all that reads as a negative number for one, not for an option: argparse knows no exponents."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self._negative_number_matcher = _NEGATIVE


def finite(text: str) -> float:
    """Any number but infinities and NaN."""
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is no number") from None
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text} is no finite number")
    return value


def not_negative(text: str) -> float:
    """A number from 0: durations, limits."""
    value = finite(text)
    if value < 0.0:
        raise argparse.ArgumentTypeError(f"{text} must not be negative")
    return value


def count(text: str) -> int:
    """A whole number from 0."""
    try:
        value = int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is no whole number") from None
    if value < 0:
        raise argparse.ArgumentTypeError("must not be negative")
    return value


def rate(text: str) -> float:
    """So many a second."""
    value = finite(text)
    if not 0.0 <= value <= 1000.0:
        raise argparse.ArgumentTypeError("must be between 0 and 1000")
    return value


def assignment(text: str) -> tuple[str, float]:
    """NAME=VALUE"""
    name, sign, value = text.rpartition("=")
    if not sign or not name:
        raise argparse.ArgumentTypeError(f"'{text}' should read NAME=VALUE")
    return name, finite(value)


def list_of(kind: Callable[[str], Any]) -> Callable[[str], list[Any]]:
    """Several of a kind, with commas between."""

    def read(text: str) -> list[Any]:
        return [kind(part) for part in text.split(",")]

    return read
