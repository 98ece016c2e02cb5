"""The simulation in this process: no ROS, no window, no clock. Steps are those of the simulator, bit for bit.

    from ambf_core import MODELS, World

    world = World(MODELS / "multi-bodies/robots/arm7.yaml", world=MODELS / "world/arm7_world.yaml")
    world.commands.set_joints([0.1, 0.5], joints=["joint1", "joint2"])
    world.step(1000)
    print(world.state.joint_position)

SI units and radians everywhere; quaternions are x, y, z, w; poses and velocities are of the world's frame.
"""

from ._errors import Diverged, LoadError
from .arms import Arm, arm_names
from .arrays import ActuatorMode, BodyMode, Commands, JointMode, State
from .batch import WorldBatch
from .models import MODELS
from .pictures import CameraInfo, Picture, View
from .tasks import Task
from .views import WorldView
from .windows import Window
from .world import Parameter, World

__all__ = [
    "MODELS",
    "ActuatorMode",
    "Arm",
    "BodyMode",
    "CameraInfo",
    "Commands",
    "Diverged",
    "JointMode",
    "LoadError",
    "Parameter",
    "Picture",
    "State",
    "Task",
    "View",
    "Window",
    "World",
    "WorldBatch",
    "WorldView",
    "arm_names",
]
