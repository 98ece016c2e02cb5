"""Arguments of AMBF 2.0 and of AMBF 3.0, distinguished by their types."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, TypeVar

from ros_abstraction_layer._layer import Layer

DISCOVERY_ATTEMPTS = 5  # of Client.connect, 1 s apart, as in 3.0

_Init = TypeVar("_Init", bound=Callable[..., None])


def takes_ral(init: _Init) -> _Init:
    """Decorator of a constructor, which then takes a `ral` as well, at any position or by name, and keeps it.

    In 3.0 it comes first, `RigidBody(ral, a_name, time_out)`, and for the world last, `World(a_name, ral)`.
    """

    @functools.wraps(init)
    def call(self: Any, *arguments: Any, ral: Any = None, **named: Any) -> None:
        layers = [each for each in (*arguments, ral) if isinstance(each, Layer)]
        if layers:
            self.ral = layers[0]
        elif ral is not None:
            raise TypeError(f"ral must be a ral of ros_abstraction_layer, not {ral!r}")
        init(self, *(each for each in arguments if not isinstance(each, Layer)), **named)

    return call  # type: ignore[return-value]


def attempts_and_namespace(second: Any, third: Any) -> tuple[int, str]:
    """The arguments of a Client behind its name, in either order: the number of attempts and the namespace."""
    if isinstance(second, str):
        second, third = third if third != "" else DISCOVERY_ATTEMPTS, second
    if isinstance(second, bool) or not isinstance(second, int) or second < 0 or not isinstance(third, str):
        raise TypeError(
            "Client(client_name, max_discovery_attempts, namespace) takes a number of attempts (an int, not negative) "
            f"and a namespace (a text), in either order, not {second!r} and {third!r}"
        )
    return second, third
