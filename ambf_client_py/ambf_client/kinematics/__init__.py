"""Kinematics of known arms, of batches of joint vectors and poses: see docs/kinematics.md.

>>> from ambf_client.kinematics import load_arm
>>> psm = load_arm("PSM")
>>> answer = psm.inverse(psm.forward(psm.home))
"""

from ._adf import chain_of_adf
from ._answer import INVALID, OUT_OF_LIMITS, SINGULAR, SOLVED, UNREACHABLE, Answer
from ._arm import AdfJoint, Arm, Jaw, JawHalf, Row
from ._chain import Axes, Step, pose_difference
from ._inverse import Chain
from ._load import arm_names, load_arm, tool_names

__all__ = [
    "INVALID",
    "OUT_OF_LIMITS",
    "SINGULAR",
    "SOLVED",
    "UNREACHABLE",
    "AdfJoint",
    "Answer",
    "Arm",
    "Axes",
    "Chain",
    "Jaw",
    "JawHalf",
    "Row",
    "Step",
    "arm_names",
    "chain_of_adf",
    "load_arm",
    "pose_difference",
    "tool_names",
]
