"""The process's node. ROS 1 has one a process, whatever number of clients and layers share it."""

from __future__ import annotations

import time
from collections.abc import Callable

import rospy

from ._interrupt import end_on_interrupt, init_node
from ._master import MasterLink, describe_uri

_POLL_S = 0.1


def become_node(name: str, report: Callable[[str], None]) -> None:
    """Makes this process a ROS node, unless it is one. Waits for a master, and reports that it does."""
    if rospy.core.is_initialized():
        end_on_interrupt()
        return
    master = MasterLink("/" + name)
    if not master.answers():
        report(f"waiting for a ROS master at {describe_uri(master.uri)}")
        while not master.answers():
            time.sleep(_POLL_S)
    init_node(name)
