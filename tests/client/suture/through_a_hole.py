"""As 3.0's verification of its evaluators: bodies are reset, then the needle goes through a hole by poses."""

import numpy as np
from arms import Scene
from manager import SimulationManager

TIP = np.array((0.00662, 0.00697, 0.0))  # of the needle, in its frame (m)

manager = SimulationManager("verification")
manager.get_world_handle().reset_bodies()
scene = Scene(manager)
hole = scene.holes["Entry2"]
rate = manager.create_rate(100)
for z in np.concatenate((np.linspace(0.004, -0.003, 150), np.linspace(-0.003, 0.004, 100))):
    pose = hole.get_pose()
    pose[:3, 3] += pose[:3, :3] @ (0.0, 0.0, z) - pose[:3, :3] @ TIP
    scene.needle.set_pose(pose)
    rate.sleep()
scene.needle.set_force((0.0, 0.0, 0.0))
print("done", flush=True)
