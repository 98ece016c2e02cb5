"""The ROS abstraction layer of AMBF 3.0: one face over ROS 1 and ROS 2 (docs/third_generation.md).

>>> from ros_abstraction_layer import ral
>>> node = ral("my_script")
>>> node.subscriber("/ambf/env/World/State", WorldState, print)

The environment variable ROS_VERSION chooses: 1, also where it is not set, or 2.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .ros1 import ral

__all__ = ["ral"]


def __getattr__(name: str) -> Any:
    """`ral`, once it is asked for: ambf_client needs parts of this package whatever ROS_VERSION says."""
    if name != "ral":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}: it has {', '.join(__all__)}")
    version = os.environ.get("ROS_VERSION", "1")
    if version == "1":
        from .ros1 import ral
    elif version == "2":
        from .ros2 import ral  # type: ignore[assignment]
    else:
        raise ImportError(f"ROS_VERSION is {version!r}: ros_abstraction_layer knows 1 and 2")
    globals()["ral"] = ral
    return ral
