"""Scripts of the original's users, unchanged: the handles of what a simulator simulates, method by method."""

import math
import time

import ambf_client
import pytest
from documented import documented
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3, Wrench
from harness import eventually

from ambf_msgs import msg

pytestmark = pytest.mark.usefixtures("called")


def test_base_object_methods_of_a_camera_and_a_light(bench, client):
    camera = client.get_obj_handle("cameras/eye")
    light = client.get_obj_handle("sun")
    for handle, kind in ((camera, ambf_client.Camera), (light, ambf_client.Light)):
        assert type(handle) is kind
        assert isinstance(handle, ambf_client.BaseObject)
        assert kind("name", time_out=0.2).get_name() == "name"
    assert [camera.get_pos().x, camera.get_pos().z] == [3.0, 1.0]
    assert camera.get_children_names() == []
    assert camera.get_num_of_children() == 0
    assert camera.get_parent_name() == ""
    camera.set_pos(px=1.0, py=2.0, pz=3.0)
    eventually(lambda: camera.get_pos() == Point(1.0, 2.0, 3.0))
    camera.set_rpy(roll=0.1, pitch=0.2, yaw=0.3)
    eventually(lambda: camera.get_rpy() == pytest.approx((0.1, 0.2, 0.3)))
    camera.set_rot(quat=[0.0, 0.0, 1.0, 0.0])
    eventually(lambda: camera.get_rot() == Quaternion(0.0, 0.0, 1.0, 0.0))
    assert camera.get_rot_command() == Quaternion(0.0, 0.0, 1.0, 0.0)
    assert camera.get_pos_command() == Point(1.0, 2.0, 3.0)
    light.set_pose(pose=Pose(Point(0.0, 1.0, 2.0), Quaternion(0.0, 1.0, 0.0, 0.0)))
    eventually(lambda: light.get_pose()[:3] == pytest.approx([0.0, 1.0, 2.0]))


def test_base_object_methods_of_a_body(bench, client):
    body = client.get_obj_handle("Base")
    assert body.is_active()
    body.set_active()
    eventually(lambda: body.get_num_of_children() == 2)
    assert sorted(name.rpartition("/")[2] for name in body.get_children_names()) == ["Plate", "Slide"]
    step = body.get_sim_step()
    eventually(lambda: body.get_sim_step() > step + 20)
    assert body.get_identifier() == "Base" or body.get_identifier().endswith("Base")
    assert body.get_parent_name() == ""
    assert body.get_msg_header() is not None
    assert abs(body.get_msg_time_stamp().to_sec() - time.time()) < 5.0
    number = body.get_msg_seq_num()
    eventually(lambda: body.get_msg_seq_num() > number)
    assert body.get_msg_frame_id() == ""
    body.set_name(name="mine")
    assert body.get_name() == "mine"
    state = msg.RigidBodyState()
    state.sim_step = 77
    body.set_inactive()
    body.ros_cb(data=state)
    assert body.get_sim_step() == 77
    body.run_publisher()
    base = ambf_client.BaseObject("nothing", time_out=0.3)
    assert not base.is_active()


def test_rigid_body_motion(bench, client):
    box = client.get_obj_handle("Box")
    table = client.get_obj_handle("Table")
    assert isinstance(box, ambf_client.RigidBody)
    assert box.get_inertia().x == pytest.approx(2.0 * 0.01 / 6.0)
    table.set_pos(px=1.0, py=2.0, pz=0.5)
    eventually(lambda: table.get_pos() == Point(1.0, 2.0, 0.5))
    assert table.get_pos_command() == Point(1.0, 2.0, 0.5)
    table.set_rpy(roll=0.3, pitch=-0.2, yaw=1.0)
    eventually(lambda: table.get_rpy() == pytest.approx((0.3, -0.2, 1.0)))
    table.set_rot(quat=[0.0, 0.0, 0.0, 1.0])
    eventually(lambda: table.get_rpy() == pytest.approx((0.0, 0.0, 0.0)))
    assert table.get_rot_command() == Quaternion(0.0, 0.0, 0.0, 1.0)
    table.set_pose(pose=Pose(Point(0.0, -1.0, 0.0), Quaternion(1.0, 0.0, 0.0, 0.0)))
    eventually(lambda: table.get_pose() == pytest.approx([0.0, -1.0, 0.0, math.pi, 0.0, 0.0], abs=1e-6))
    # The original's pose_command takes its angles about z, y and x.
    table.pose_command(px=0.0, py=-2.0, pz=0.0, roll=0.3, pitch=0.0, yaw=0.0)
    eventually(lambda: table.get_pose() == pytest.approx([0.0, -2.0, 0.0, 0.0, 0.0, 0.3], abs=1e-6))
    table.set_pose(Pose(Point(0.0, -2.0, 5.0), Quaternion(0.0, 0.0, 0.0, 1.0)))
    eventually(lambda: table.get_pos().z == 5.0)

    box.set_linear_vel(vx=0.5, vy=0.0, vz=0.0)
    eventually(lambda: box.get_linear_vel().x == pytest.approx(0.5))
    box.set_angular_vel(ax=0.0, ay=0.0, az=0.4)
    eventually(lambda: box.get_angular_vel().z == pytest.approx(0.4))
    assert box.get_linear_velocity_command() == Vector3(0.5, 0.0, 0.0)
    assert box.get_angular_velocity_command() == Vector3(0.0, 0.0, 0.4)
    box.set_twist(twist=Twist(Vector3(0.0, 0.1, 0.0), Vector3()))
    eventually(lambda: box.get_linear_vel().y == pytest.approx(0.1))
    box.velocity_command(vx=0.0, vy=0.0, vz=0.2, ax=0.0, ay=0.0, az=0.0)
    eventually(lambda: box.get_linear_vel().z == pytest.approx(0.2))
    box.velocity_command(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    eventually(lambda: box.get_linear_vel() == Vector3(0.0, 0.0, 0.0))


def test_rigid_body_forces(bench, client):
    box = client.get_obj_handle("Box")
    lateral = Wrench(Vector3(0.0, 4.0, 0.0), Vector3())
    force, torque = box.get_force_command, box.get_torque_command
    pushes = [
        (lambda: box.set_force(fx=4.0, fy=0.0, fz=0.0), lambda: box.get_linear_vel().x, force, "x"),
        (lambda: box.set_torque(nx=0.0, ny=0.01, nz=0.0), lambda: box.get_angular_vel().y, torque, "y"),
        (lambda: box.set_wrench(wrench=lateral), lambda: box.get_linear_vel().y, force, "y"),
        (lambda: box.wrench_command(fx=0.0, fy=0.0, fz=4.0, nx=0.0, ny=0.0, nz=0.0),
         lambda: box.get_linear_vel().z, force, "z"),
    ]  # fmt: skip
    for push, speed, command, axis in pushes:
        before = speed()
        push()
        assert getattr(command(), axis) > 0.0
        eventually(lambda b=before, s=speed: s() > b + 0.02)
    # The client's watchdog takes back the wrench, and only that, after 0.1 s.
    eventually(lambda: box.get_force_command() == Vector3(0.0, 0.0, 0.0), 2.0)
    assert box.get_torque_command() == Vector3(0.0, 0.0, 0.0)


def test_rigid_body_joints(bench, client, capsys):
    base = client.get_obj_handle("Base")
    assert base.get_publish_children_name_flag()
    assert base.get_publish_joint_names_flag()
    assert base.get_publish_joint_positions_flag()
    for setter in (
        base.set_publish_children_names_flag,
        base.set_publish_joint_names_flag,
        base.set_publish_joint_positions_flag,
    ):
        setter(state=True)
    assert base.get_num_joints() == 2
    assert base.get_joint_names() == ["turn", "lift"]
    assert base.is_joint_idx_valid(joint_idx=1)
    assert not base.is_joint_idx_valid(joint_idx=2)
    assert base.get_joint_idx_from_name(joint_name="lift") == 1
    assert base.get_joint_name_from_idx(joint_idx=0) == "turn"
    base.set_joint_pos(joint_name_or_idx="turn", p=0.4)
    eventually(lambda: base.get_joint_pos(joint_name_or_idx=0) == pytest.approx(0.4, abs=0.01))
    base.set_joint_pos(1, 0.05)
    eventually(lambda: base.get_all_joint_pos() == pytest.approx([0.4, 0.05], abs=0.01))
    base.set_multiple_joint_pos(p_list=[0.1, -0.05], index_list=[0, 1])
    eventually(lambda: base.get_all_joint_pos() == pytest.approx([0.1, -0.05], abs=0.01))
    # Values are looked up by the index of the joint.
    base.set_multiple_joint_pos([99.0, 0.02], [1])
    eventually(lambda: base.get_all_joint_pos() == pytest.approx([0.1, 0.02], abs=0.01))
    base.set_joint_vel(joint_name_or_idx=0, v=0.5)
    eventually(lambda: base.get_joint_vel(joint_name_or_idx="turn") == pytest.approx(0.5, abs=0.02))
    base.set_multiple_joint_vel(v_list=[-0.5, 0.0], index_list=[0, 1])
    eventually(lambda: base.get_all_joint_vel()[0] == pytest.approx(-0.5, abs=0.02))
    base.set_joint_vel("turn", 0.0)
    eventually(lambda: base.get_joint_vel("turn") == pytest.approx(0.0, abs=0.02))
    base.set_joint_effort(joint_name_or_idx="turn", f=0.05)
    eventually(lambda: base.get_joint_vel("turn") > 0.2)
    base.set_multiple_joint_effort(f_list=[-0.1], index_list=[0])
    eventually(lambda: base.get_joint_vel("turn") < 0.0)
    assert isinstance(base.get_joint_effort(joint_name_or_idx="turn"), float)
    assert len(base.get_all_joint_effort()) == 2
    base.resize_joint_cmd_array(req_len=2)
    capsys.readouterr()
    assert base.get_joint_pos("elbow") is None
    assert "elbow" in capsys.readouterr().err
    base.set_joint_pos(7, 0.0)
    assert "no joint 7" in capsys.readouterr().err


def test_a_joint_never_commanded_is_left_alone(bench, client):
    base = client.get_obj_handle("Base")
    base.set_joint_vel("turn", 0.3)
    eventually(lambda: base.get_joint_vel("turn") == pytest.approx(0.3, abs=0.02))
    base.clear_cmd()
    other = ambf_client.Client()
    other.connect()
    # Joint 1 alone: the original sent an effort of zero to joint 0 with it, which frees it.
    handle = other.get_obj_handle("Base")
    handle.set_joint_pos(1, 0.03)
    assert list(handle._cmd.joint_cmds_types) == [-1, 1]
    eventually(lambda: handle.get_joint_pos(1) == pytest.approx(0.03, abs=0.005))
    other.clean_up()


def test_world_methods_and_the_old_step_clock(bench, client):
    world = client.get_world_handle()
    assert isinstance(world, ambf_client.World)
    world.set_active()
    assert world.is_active()
    with pytest.raises(ValueError):
        world.set_num_step_skips(0)
    with pytest.raises(ValueError):
        world.set_num_step_skips(101)
    box = client.get_obj_handle("Box")
    world.enable_throttling(data=True)
    world.set_num_step_skips(n=5)
    world.update()
    eventually(lambda: world.wait_for_next_state(0.5) and _waits(world))
    step = world.get_sim_step()
    for _ in range(20):
        world.update()
        step += 5
        assert world.wait_for_sim_step(step, 5.0)
        assert world.get_sim_step() == step
    assert box.wait_for_sim_step(step)
    assert box.get_sim_step() == step
    world.run_publisher()  # no toggle
    time.sleep(0.1)
    assert world.get_sim_step() == step
    world.clear_cmd()
    world.update()
    assert world.wait_for_sim_step(step + 100, 5.0)

    box.set_linear_vel(1.0, 0.0, 0.0)
    eventually(lambda: box.get_pos().x > 0.1)
    box.clear_cmd()
    # The two go by topics of their own: the reset may overtake the other.
    eventually(lambda: world.reset_bodies() or abs(box.get_pos().x) < 1e-6, interval=0.1)
    before = world.get_sim_step()
    world.reset()
    eventually(lambda: world.get_sim_step() < before)
    name = world.get_name()
    assert name == "/ambf/env/World"
    world.set_name(name="mine")
    assert world.get_name() == "mine"
    state = msg.WorldState()
    state.sim_step = 5
    other = ambf_client.World(a_name="/nowhere/World")
    other.ros_cb(data=state)
    assert other.get_sim_step() == 5


def _waits(world):
    at = world.get_sim_step()
    return world.wait_for_next_state() and world.get_sim_step() == at


def test_every_documented_method_was_called(called):
    """The last of this file."""
    assert documented(__name__) - called == set()
