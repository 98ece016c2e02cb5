"""A person's way with files: a dropped robot gets its loop closed, is moved, saved, and started again where it was."""

import time

import numpy as np
import pytest
import worlds
import x11
from program import drawn

pytestmark = pytest.mark.alone  # a hand that pulls wants pictures in time

BAR = """
<link name="{name}">
  <inertial><origin xyz="{com}"/><mass value="0.2"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial>
  <visual><origin xyz="{com}"/><geometry><box size="{size}"/></geometry>
    <material name="{name}"><color rgba="{rgba}"/></material></visual>
  <collision><origin xyz="{com}"/><geometry><box size="{size}"/></geometry></collision>
</link>
"""
HINGE = """
<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/><origin xyz="{xyz}"/>
  <axis xyz="1 0 0"/><limit effort="0.001" velocity="1"/><dynamics damping="0.05"/></joint>
"""
# A parallelogram in the plane that the camera looks at, open at the lower right; its motors are too weak to hold.
ROBOT = (
    '<?xml version="1.0"?>\n<robot name="bars">\n<link name="ground"/>\n'
    + BAR.format(name="left", com="0 0 0.1", size="0.02 0.02 0.2", rgba="1 0 0 1")
    + BAR.format(name="coupler", com="0 0.1 -0.1", size="0.03 0.15 0.15", rgba="0 1 0 1")
    + BAR.format(name="right", com="0 0 -0.1", size="0.02 0.02 0.2", rgba="0 0 1 1")
    + HINGE.format(name="low", parent="ground", child="left", xyz="0 -0.1 0.05")
    + HINGE.format(name="up", parent="left", child="coupler", xyz="0 0 0.2")
    + HINGE.format(name="over", parent="coupler", child="right", xyz="0 0.2 0")
    + "</robot>\n"
)
# What closes it: joints alone, by the names of links.
LOOP = """
namespace: /ambf/env/
joints: [JOINT close]
JOINT close:
  name: close
  type: revolute
  parent: BODY ground
  child: BODY right
  parent pivot: {x: 0, y: 0.1, z: 0.05}
  child pivot: {x: 0, y: 0, z: -0.2}
  parent axis: {x: 1, y: 0, z: 0}
  child axis: {x: 1, y: 0, z: 0}
  enable motor: false
"""
BODIES = ("left", "coupler", "right")
CHECK_BOX = 323  # px below the top of the panel: "Move in the scene"


def write_scene(folder):
    """A world without gravity, so that nothing moves unless somebody pulls."""
    launch = worlds.write(folder, {"one": (1.0, 0.0, "")})
    world = folder / "world.yaml"
    world.write_text(world.read_text().replace("z: -9.81", "z: 0.0"))
    (folder / "bars.urdf").write_text(ROBOT)
    (folder / "loop.yaml").write_text(LOOP)
    empty = folder / "things.yaml"
    empty.write_text("namespace: /test/\nbodies: [BODY mark]\nBODY mark: {name: mark, mass: 0}\n")
    return launch


def position(state):
    p = state.pose.position
    return p.x, p.y, p.z


def select_under_pointer(user):
    user.hold("Control_L", True)
    user.button(1, True)
    time.sleep(0.2)
    user.button(1, False)
    user.hold("Control_L", False)


def sideways_arrow(user):
    """A point of the gizmo's arrow along y; none while it is not shown."""
    pixels = np.frombuffer(user.picture(), np.uint8).reshape(x11.SCREEN[1], x11.SCREEN[0], 4).astype(int)
    blue, green, red = (pixels[:, :, i] for i in range(3))
    rows, columns = np.nonzero((abs(red - 69) < 20) & (abs(green - 194) < 20) & (abs(blue - 71) < 20))
    return (int(np.median(columns)), int(np.median(rows))) if len(rows) > 30 else None


def show_gizmo(user, left, top, width):
    """Ticks "Move in the scene" in the panel; puts the pointer on the arrow along y."""
    panel = left + width - min(400, width // 2)
    user.point(left + 20, top + 20)
    user.key("Tab")
    user.point(panel + 22, top + CHECK_BOX)
    time.sleep(1.0)
    user.button(1, True)
    time.sleep(0.1)
    user.button(1, False)
    at = x11.eventually(lambda: sideways_arrow(user), 10.0, "the gizmo")
    user.point(*at)
    time.sleep(0.3)
    return at


def test_a_dropped_robot_is_closed_moved_saved_and_starts_where_it_was(server, user, start, tmp_path, master, ros):
    from ambf_msgs.msg import RigidBodyState
    from ambf_msgs.srv import List, Save

    simulator = start(server.name, "--launch_file", write_scene(tmp_path), "-l", "0", ros=True)
    window = user.window()
    for name in ("bars.urdf", "loop.yaml"):
        user.drop(window, [tmp_path / name])
        simulator.says(f"loaded '{name}'")
    drawn(user)
    states = {name: ros.listen(f"/ambf/env/{name}/State", RigidBodyState) for name in BODIES}
    before = {name: position(state.last()) for name, state in states.items()}

    left, top, width, height = user.place()
    user.point(left + width // 2, top + height // 2 - height // 6)  # the coupler
    user.window()
    select_under_pointer(user)
    at = show_gizmo(user, left, top, width)
    user.button(1, True)
    for _ in range(16):
        at = at[0] + width // 64, at[1]
        user.point(*at)
        time.sleep(0.1)
    x11.eventually(lambda: abs(position(states["coupler"].last())[1] - before["coupler"][1]) > 0.01, 20.0, "a pull")
    user.button(1, False)
    user.key("p", "Control_L")
    x11.eventually(lambda: position(states["left"].last()) == position(states["left"].last()), 5.0, "a pause")

    names = ros.service("/test/World/List", List)()
    saved = ros.service("/test/World/Save", Save)(path=str(tmp_path / "scene"), current_pose=True)
    assert saved.success, saved.message
    moved = {name: position(state.last()) for name, state in states.items()}
    assert (tmp_path / "scene/models/loop.yaml").read_text() == LOOP, "nothing of it has changed"
    assert f"--launch_file {tmp_path}/scene/launch.yaml -l 0,1,2" in saved.message
    simulator.close()

    again = start(server.name, "--launch_file", tmp_path / "scene/launch.yaml", "-l", "0,1,2", ros=True)
    again.says("loaded 'loop.yaml'")
    assert "error" not in again.log(), again.log()
    listing = ros.service("/test/World/List", List)()
    assert [o.name for o in listing.objects] == [o.name for o in names.objects]
    assert [(j.name, j.parent, j.child) for j in listing.joints] == [(j.name, j.parent, j.child) for j in names.joints]
    for name in BODIES:
        now = ros.listen(f"/ambf/env/{name}/State", RigidBodyState)
        assert position(now.last()) == pytest.approx(moved[name], abs=1e-4), name
