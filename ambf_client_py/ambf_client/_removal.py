"""Commands while objects go: those of a body's joints go by place in its list of joints, which gets shorter."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

from .base_object import BaseObject
from .jointed import JointedObject

_LIST_TIME = 0.5  # s, for a state with the new list; a paused world may send none


def take_away(handles: Iterable[BaseObject], take: Callable[[], list[str]]) -> list[str]:
    """take()s objects away, and returns their names once the handles know the lists of what is left.

    Until then this client sends no command of a body: none goes by the list of before.
    """
    held = [each for each in handles if isinstance(each, JointedObject) and each.is_commanded() and each.pub_flag]
    before = [(each, each.get_joint_names()) for each in held]
    for each in held:
        each.pub_flag = False
    try:
        removed = take()
        until = time.monotonic() + _LIST_TIME
        shorter = []
        for each, names in before:
            space = each.get_name().rpartition("/")[0] + "/"
            gone = {name[len(space) :].replace(" ", "") for name in removed if name.startswith(space)}
            if not gone.intersection(names):
                each.pub_flag = True  # it loses nothing: no longer silent than need be
            elif each.get_name() not in removed:
                shorter.append((each, names))
        for each, names in shorter:
            while each.get_joint_names() == names and time.monotonic() < until:
                each.wait_for_next_state(max(0.0, until - time.monotonic()))
    finally:
        for each in held:
            each.pub_flag = True
    return removed
