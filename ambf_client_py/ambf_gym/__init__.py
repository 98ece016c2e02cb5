"""Gymnasium environments over ambf_core.

    import ambf_gym

    env = ambf_gym.make("ambf/Arm7Reach-v0")
    observation, info = env.reset(seed=1)

Importing registers them, so that gymnasium.make("ambf_gym:ambf/Arm7Reach-v0") does, too.
"""

from functools import partial
from typing import Any

import gymnasium

from .arm7_reach import Arm7Reach
from .dvrk import EcmReach, EcmTrack, PsmReach
from .goals import GoalEnv
from .judged import JudgedEnv
from .needle import NeedlePick, NeedleRegrasp
from .needle_drive import NeedleDrive
from .old_env import AmbfEnv
from .peg_board import PegTransfer, RingLift
from .randomization import Randomization
from .ring_wire import RingWire
from .task_world import TaskWorld
from .tissue_retract import TissueRetract
from .two_hands import BiPegTransfer
from .vector import GoalVectorEnv

__all__ = [
    "AmbfEnv",
    "Arm7Reach",
    "BiPegTransfer",
    "GoalEnv",
    "GoalVectorEnv",
    "JudgedEnv",
    "NeedleDrive",
    "NeedlePick",
    "NeedleRegrasp",
    "PegTransfer",
    "Randomization",
    "RingLift",
    "RingWire",
    "TaskWorld",
    "TissueRetract",
    "make",
    "register",
]


def register(id: str, env_type: type[GoalEnv], max_episode_steps: int) -> None:
    """Registers an environment: gymnasium.make makes single ones, make_vec many over a WorldBatch."""
    single: Any = env_type
    vector = partial(GoalVectorEnv, env_type)
    gymnasium.register(id, entry_point=single, vector_entry_point=vector, max_episode_steps=max_episode_steps)


def make(id: str, **options: Any) -> gymnasium.Env[Any, Any]:
    """gymnasium.make of one of these environments; options go to its constructor."""
    return gymnasium.make(id, **options)


register("ambf/Arm7Reach-v0", Arm7Reach, max_episode_steps=50)
register("ambf/RingLift-v0", RingLift, max_episode_steps=60)
register("ambf/PegTransfer-v0", PegTransfer, max_episode_steps=80)
register("ambf/BiPegTransfer-v0", BiPegTransfer, max_episode_steps=160)
register("ambf/NeedlePick-v0", NeedlePick, max_episode_steps=60)
register("ambf/NeedleRegrasp-v0", NeedleRegrasp, max_episode_steps=150)
register("ambf/NeedleDrive-v0", NeedleDrive, max_episode_steps=110)
register("ambf/RingWire-v0", RingWire, max_episode_steps=100)
register("ambf/TissueRetract-v0", TissueRetract, max_episode_steps=40)
register("ambf/PsmReach-v0", PsmReach, max_episode_steps=50)
register("ambf/EcmReach-v0", EcmReach, max_episode_steps=50)
register("ambf/AmbfEnv-v0", AmbfEnv, max_episode_steps=100)
register("ambf/EcmTrack-v0", EcmTrack, max_episode_steps=EcmTrack.actions)
