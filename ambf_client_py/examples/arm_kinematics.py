"""Where a PSM's tip is, how it gets elsewhere, and why it cannot get everywhere. Needs no simulator.

python3 arm_kinematics.py [ARM] [TOOL]
"""

import sys

import numpy as np
from ambf_client.kinematics import arm_names, load_arm, tool_names

np.set_printoptions(precision=4, suppress=True)


def main() -> None:
    name = sys.argv[1] if len(sys.argv) > 1 else "PSM"
    tool = sys.argv[2] if len(sys.argv) > 2 else None
    if name not in arm_names():
        sys.exit(f"no arm is named {name}; there are {', '.join(arm_names())}")
    if tool and tool not in tool_names(name):
        sys.exit(f"{name} has no tool {tool}; there are {', '.join(tool_names(name)) or 'none'}")
    arm = load_arm(name, tool)
    print(f"{arm.name} {arm.tool}: {', '.join(arm.names)}")

    pose = arm.forward(arm.home)
    print(f"home {arm.home} has the tip at {pose[:3, 3]} m")

    # A straight line of 10 mm along the tip's own z, each pose solved from the one before.
    joints = arm.home
    for step in np.linspace(0.0, 0.01, 6)[1:]:
        wanted = pose.copy()
        wanted[:3, 3] += step * pose[:3, 2]
        answer = arm.inverse(wanted, seed=joints)
        joints = answer.joints
        print(f"{1000 * step:4.0f} mm: {answer.status}, joints {joints}")

    # The joint velocities that move the tip by 10 mm/s along its z.
    velocity = np.linalg.pinv(arm.jacobian(joints, "body")) @ [0.0, 0.0, 0.01, 0.0, 0.0, 0.0]
    print(f"10 mm/s along the tip's z: {velocity}")

    wanted[:3, 3] += 2.0 * pose[:3, 2]
    answer = arm.inverse(wanted, seed=joints)
    print(f"2 m further: {answer.status}, {float(answer.distance):.3f} m and {float(answer.angle):.3f} rad are missing")
    if answer.status == "out_of_limits":
        print(f"  {arm.names[int(answer.joint)]} would be {float(answer.excess):.3f} beyond its limit")


if __name__ == "__main__":
    main()
