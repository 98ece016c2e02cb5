"""What words on the command line may be: numbers in their ranges, lists, assignments. Needs no ROS."""

import argparse
import difflib
import math
import re
from collections.abc import Callable
from typing import Any

LARGEST = 1e9  # of counts, of durations in s, of sizes in GiB: more than that is a slip
MOST_LENGTH, MOST_SPEED, MOST_FORCE = 1e6, 1e6, 1e9  # in commands: the simulator takes no more
SLOWEST_HZ, FASTEST_HZ = 1e-3, 1e3  # of what is shown or sent at a rate

_NEGATIVE = re.compile(r"-((\d+\.?\d*|\.\d+)(e[-+]?\d+)?|inf(inity)?|nan)$", re.IGNORECASE)
_WORD = re.compile(r"[a-z]{2,}")


class Parser(argparse.ArgumentParser):
    """Takes all that reads as a negative number for one, not for an option: argparse knows no exponents."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self._negative_number_matcher = _NEGATIVE

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """A word that is none of the choices gets the nearest ones as a hint, instead of all of them."""
        if action.choices is None or value in action.choices:
            return
        choices = [str(choice) for choice in action.choices]
        near = difflib.get_close_matches(str(value), choices, 1, 0.5)
        what = str(action.metavar or action.dest).lower()
        hint = f"did you mean {near[0]}?" if near else f"there are: {', '.join(choices)}"
        raise argparse.ArgumentError(None, f"there is no {what} '{value}'; {hint}")


def finite(text: str) -> float:
    """Any number but infinities and NaN."""
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is no number") from None
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text} is no finite number")
    return value


def between(low: float, high: float, whole: bool = False) -> Callable[[str], Any]:
    """A number in a range; a whole one."""

    def read(text: str) -> float | int:
        value = _whole(text) if whole else finite(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is not between {low:g} and {high:g}")
        return value

    return read


def within(most: float) -> Callable[[str], float]:
    """A number of either sign."""
    return between(-most, most)


def number_or_word(text: str) -> float | str:
    """A number of either sign, or a word of at least two letters."""
    try:
        float(text)
    except ValueError:
        if _WORD.fullmatch(text):
            return text
    return within(LARGEST)(text)


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is no whole number") from None


def not_negative(text: str) -> float:
    """A number from 0: durations, limits."""
    return _from_zero(text, finite(text))


def count(text: str) -> int:
    """A whole number from 0."""
    return int(_from_zero(text, _whole(text)))


def _from_zero(text: str, value: float) -> float:
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text} must not be negative")
    if value > LARGEST:
        raise argparse.ArgumentTypeError(f"{text} must not be more than {LARGEST:g}")
    return value


def rate(text: str) -> float:
    """So many a second; 0 has a meaning of its own."""
    value = not_negative(text)
    if value != 0.0 and not SLOWEST_HZ <= value <= FASTEST_HZ:
        raise argparse.ArgumentTypeError(f"{text} is neither 0 nor between {SLOWEST_HZ:g} and {FASTEST_HZ:g}")
    return value


def assignment(text: str) -> tuple[str, float]:
    """NAME=VALUE"""
    name, sign, value = text.rpartition("=")
    if not sign or not name:
        raise argparse.ArgumentTypeError(f"'{text}' should read NAME=VALUE")
    return name, within(MOST_FORCE)(value)


def list_of(kind: Callable[[str], Any]) -> Callable[[str], list[Any]]:
    """Several of a kind, with commas between."""

    def read(text: str) -> list[Any]:
        return [kind(part) for part in text.split(",")]

    return read
