"""What programs for CRTK arms count on, through ROS: states, queries, commands, moves, the jaw, services."""

import subprocess

import numpy as np
import pytest
from ambf_client.kinematics import load_arm
from crtk_arm import DESCRIPTIONS, ECM, MTMR, PSM, Arm, close_to
from crtk_double import matrix
from geometry_msgs.msg import PoseStamped, Quaternion, TwistStamped, WrenchStamped
from harness import SIMULATOR, eventually
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Empty, Float64MultiArray, String

from ambf_msgs.srv import Save
from crtk_msgs.msg import CartesianImpedance, OperatingState
from crtk_msgs.srv import QueryForwardKinematics, QueryInverseKinematics

pytestmark = pytest.mark.skipif(not SIMULATOR.exists(), reason=f"no {SIMULATOR.name}")
REFUSALS = [r"CRTK", r"refused"]
HOME = [0.0, 0.0, 0.12, 0.0, 0.0, 0.0]
AWAY = [0.2, -0.1, 0.15, 0.5, 0.2, -0.3]


def serve(start, master, place, description):
    """The robot at this place of the shipped launch file, which stands free there."""
    crtk = DESCRIPTIONS / description
    return start("-l", place, "--crtk", crtk, allowed=REFUSALS, master_uri=master.uri)


@pytest.fixture
def psm(start, master, ros):
    simulator = serve(start, master, PSM, "psm.yaml")
    eventually(lambda: "/PSM1/tool_type" in master.published(), 30.0, "the arm's topics")
    arm = Arm(ros, "PSM1")
    arm.home()
    yield arm
    simulator.stop()


def by_stamp(listener, stamp):
    return eventually(lambda: next((m for m in listener.messages if m.header.stamp == stamp), None), 5.0, "same stamp")


def test_queries_belong_together(psm):
    local = psm.ros.listen("/PSM1/local/measured_cp", PoseStamped)
    twist = psm.ros.listen("/PSM1/measured_cv", TwistStamped)
    psm.joints("move_jp", AWAY)
    joints = psm.fresh(psm.measured_js, lambda m: m.position[0] > 0.05)
    stamp = joints.header.stamp
    pose, local_pose = by_stamp(psm.measured_cp, stamp), by_stamp(local, stamp)
    assert joints.name == load_arm("PSM").names and len(joints.position) == len(joints.velocity) == 6
    assert joints.header.frame_id == pose.header.frame_id
    kinematics = load_arm("PSM")
    forward = kinematics.forward(list(joints.position))
    assert np.abs(matrix(pose.pose) - forward).max() < 1e-6
    assert np.abs(matrix(local_pose.pose) - forward).max() < 1e-6
    moving = by_stamp(twist, stamp).twist
    expected = kinematics.jacobian(list(joints.position), "spatial") @ joints.velocity
    sent = [getattr(part, axis) for part in (moving.linear, moving.angular) for axis in "xyz"]
    assert np.abs(expected - sent).max() < 1e-6 and np.abs(sent).max() > 1e-3
    jacobian = psm.ros.listen("/PSM1/body/jacobian", Float64MultiArray).last()
    assert [dimension.size for dimension in jacobian.layout.dim] == [6, 6] and len(jacobian.data) == 36


def test_moves_are_busy_then_idle_and_arrive(psm):
    first = len(psm.states)
    psm.wait_idle_after(lambda: psm.joints("move_jp", AWAY))
    assert [message.is_busy for message in psm.states[first:]] == [True, False]
    psm.fresh(psm.measured_js, close_to(AWAY))
    set_point = psm.fresh(psm.setpoint_js)
    assert list(set_point.position) == AWAY and not any(set_point.velocity)
    assert psm.reached.last().data
    # To where it is, by names in another order, and by pose.
    psm.wait_idle_after(lambda: psm.joints("move_jp", AWAY))
    names = load_arm("PSM").names
    psm.wait_idle_after(lambda: psm.joints("move_jp", HOME[::-1], name=names[::-1]))
    psm.fresh(psm.measured_js, close_to(HOME))
    goal = psm.fresh(psm.setpoint_cp).pose
    goal.position.x += 0.02
    psm.wait_idle_after(lambda: psm.pose("move_cp", goal))
    moved = psm.fresh(psm.measured_cp).pose
    assert abs(moved.position.x - goal.position.x) < 5e-4 and abs(moved.position.z - goal.position.z) < 5e-4


def test_unreachable_and_malformed_moves_end_at_once(psm):
    before = list(psm.fresh(psm.setpoint_js).position)
    goal = psm.fresh(psm.setpoint_cp).pose
    goal.position.x += 5.0
    for send, said in (
        (lambda: psm.pose("move_cp", goal), "move_cp was ignored"),
        (lambda: psm.joints("move_jp", [0.1]), "expected 6"),
        (lambda: psm.joints("move_jp", [float("nan")] * 6), "not finite"),
        (lambda: psm.joints("move_jp", HOME, name=["a", "b", "c", "d", "e", "f"]), "it names 'a'"),
    ):
        warnings, reached = len(psm.warnings.messages), len(psm.reached.messages)
        psm.wait_idle_after(send)
        eventually(lambda: len(psm.reached.messages) > reached, 5.0, "goal_reached")  # noqa: B023
        assert not psm.reached.messages[-1].data
        # One warning about the same every two seconds.
        heard = psm.warnings.messages
        eventually(lambda: any(said in m.data for m in heard[max(0, warnings - 1) :]), 5.0, said)  # noqa: B023
    assert list(psm.fresh(psm.setpoint_js).position) == before


def test_servo_commands(psm):
    states = len(psm.states)
    for _ in range(10):
        psm.joints("servo_jr", [0.01, 0, 0, 0, 0, 0])
    psm.fresh(psm.setpoint_js, close_to([0.1, *HOME[1:]], 1e-12))
    psm.joints("servo_jp", [0.1, 0, 9.0, 0, 0, 0])
    psm.fresh(psm.setpoint_js, close_to([0.1, 0, 0.24, 0, 0, 0], 1e-12))
    psm.joints("servo_jp", [0.1, 0, 0.2, 0, 0])
    psm.joints("servo_jp", [0.1, 0, 0.12, 0, 0, 0])
    psm.fresh(psm.measured_js, close_to([0.1, 0, 0.12, 0, 0, 0]))
    goal = psm.fresh(psm.setpoint_cp).pose
    psm.pose("servo_cp", goal)
    psm.fresh(psm.setpoint_js)
    assert (
        max(abs(a - b) for a, b in zip(psm.fresh(psm.setpoint_js).position, [0.1, 0, 0.12, 0, 0, 0], strict=True))
        < 1e-6
    )
    goal.position.x += 0.01
    psm.pose("servo_cp", goal)
    psm.fresh(psm.measured_cp, lambda m: abs(m.pose.position.x - goal.position.x) < 5e-4)
    psm.joints("servo_jf", effort=[0.0] * 6)
    free = psm.fresh(psm.setpoint_js, lambda m: len(m.effort) == 6)
    assert not free.position
    psm.fresh(psm.setpoint_cp, lambda m: m.header.stamp.is_zero())
    psm.joints("servo_jp", HOME)
    psm.fresh(psm.setpoint_cp, lambda m: not m.header.stamp.is_zero())
    assert len(psm.states) == states, "servo commands never show as busy"


def test_states_and_what_they_allow(psm, ros):
    psm.command("pause")
    psm.wait(lambda: psm.state.state == "PAUSED", "is paused")
    before = list(psm.fresh(psm.setpoint_js).position)
    psm.joints("servo_jp", AWAY)
    eventually(lambda: any("PAUSED" in m.data for m in psm.warnings.messages), 5.0, "the refusal is said")
    assert list(psm.fresh(psm.setpoint_js).position) == before
    psm.command("resume")
    psm.wait(lambda: psm.state.state == "ENABLED", "is enabled")
    psm.joints("move_jp", AWAY)
    psm.wait(lambda: psm.state.is_busy, "moves")
    psm.command("disable")
    psm.wait(lambda: psm.state.state == "DISABLED" and not psm.state.is_busy, "is disabled")
    late = ros.listen("/PSM1/operating_state", OperatingState)
    assert late.last().state == "DISABLED" and not late.last().header.stamp.is_zero()
    stamps = [message.header.stamp for message in psm.states]
    assert stamps == sorted(set(stamps))


def test_the_jaw_is_an_arm_of_its_own(psm):
    jaw = psm.ros.listen("/PSM1/jaw/measured_js", JointState)
    psm.wait_idle_after(lambda: psm.joints("jaw/move_jp", [0.8]))
    assert len(psm.fresh(jaw, close_to([0.8], 0.02)).name) == 1
    psm.joints("jaw/servo_jp", [0.2])
    psm.fresh(jaw, close_to([0.2], 0.02))
    psm.fresh(psm.measured_js, close_to(HOME))


def test_kinematics_as_services(psm, ros):
    forward = ros.service("/PSM1/forward_kinematics", QueryForwardKinematics)
    inverse = ros.service("/PSM1/inverse_kinematics", QueryInverseKinematics)
    there = forward(jp=AWAY)
    assert there.result and np.abs(matrix(there.cp) - load_arm("PSM").forward(AWAY)).max() < 1e-9
    back = inverse(cp=there.cp, jp=AWAY)
    assert back.result and np.abs(np.subtract(back.jp, AWAY)).max() < 1e-6
    assert not forward(jp=[0.0] * 9).result
    there.cp.position.x += 5.0
    assert not inverse(cp=there.cp, jp=AWAY).result


def test_a_saved_scene_is_without_what_the_arms_load(psm, ros, tmp_path):
    saved = ros.service("/ambf/env/World/Save", Save)(path=str(tmp_path / "scene"))
    assert saved.success, saved.message
    assert {each.name for each in (tmp_path / "scene/models").iterdir()} == {"lab_low_room.yaml", "psm.yaml"}
    assert any("--crtk" in each.message for each in saved.diagnostics)


def test_tools_change_kinematics_and_unknown_ones_are_requested_again(psm, ros):
    tool, requested = ros.listen("/PSM1/tool_type", String), ros.listen("/PSM1/tool_type_request", Empty)
    assert tool.last().data == "LARGE_NEEDLE_DRIVER:400006"
    before = psm.fresh(psm.measured_cp).pose.position.z
    exchange = ros.talk("/PSM1/set_tool_type", String)
    exchange.publish("PROGRASP_FORCEPS:400093")
    eventually(lambda: tool.last().data == "PROGRASP_FORCEPS:400093", 10.0, "the other tool")
    psm.fresh(psm.measured_cp, lambda m: abs(m.pose.position.z - before + 0.0016) < 1e-4)
    exchange.publish("A_HAMMER")
    requested.last()
    psm.wait_idle_after(lambda: psm.joints("move_jp", AWAY))
    psm.fresh(psm.measured_js, close_to(AWAY))


def test_measured_wrenches_are_those_of_the_measured_efforts(psm):
    body = psm.ros.listen("/PSM1/body/measured_cf", WrenchStamped)
    psm.joints("move_jp", AWAY)
    psm.fresh(psm.measured_js, lambda m: abs(m.position[0]) > 0.02)
    stamp = body.last().header.stamp
    measured, joints = by_stamp(body, stamp).wrench, by_stamp(psm.measured_js, stamp)
    wrench = [getattr(part, axis) for part in (measured.force, measured.torque) for axis in "xyz"]
    jacobian = load_arm("PSM").jacobian(list(joints.position), "body")
    assert np.abs(jacobian.T @ wrench - joints.effort).max() < 1e-3 and np.abs(joints.effort).max() > 1e-3


def test_endoscopes_have_types(start, master, ros):
    simulator = serve(start, master, ECM, "ecm.yaml")
    eventually(lambda: "/ECM/endoscope_type" in master.published(), 30.0, "the arm's topics")
    arm = Arm(ros, "ECM")
    arm.home()
    kind = ros.listen("/ECM/endoscope_type", String)
    assert kind.last().data == "HD_STRAIGHT"
    straight = matrix(arm.fresh(arm.measured_cp).pose)
    ros.talk("/ECM/set_endoscope_type", String).publish("SD_DOWN")
    eventually(lambda: kind.last().data == "SD_DOWN", 10.0, "the other endoscope")
    turned = arm.fresh(arm.measured_cp, lambda m: np.abs(matrix(m.pose) - straight).max() > 0.1)
    angle = np.arccos((np.trace(straight[:3, :3].T @ matrix(turned.pose)[:3, :3]) - 1) / 2)
    assert abs(angle - np.radians(30.0)) < 1e-3
    assert simulator.stop()[0] == 0


def test_frames_are_broadcast_and_the_version_is_told(psm, ros):
    import genpy.dynamic
    import rospy
    import rosservice

    heard = rospy.wait_for_message("/tf", rospy.AnyMsg, 20.0)
    header = heard._connection_header
    assert header["type"] == "tf2_msgs/TFMessage" and header["md5sum"] == "94810edda583a504dfda3829e70d7eec"
    kind = genpy.dynamic.generate_dynamic(header["type"], header["message_definition"])["tf2_msgs/TFMessage"]
    frames = {each.child_frame_id: each for each in kind().deserialize(heard._buff).transforms}
    assert set(frames) == {"PSM1", "PSM1_local"} and frames["PSM1"].header.frame_id == "PSM1_base"
    tip, there = frames["PSM1"].transform.translation, psm.fresh(psm.measured_cp).pose.position
    assert max(abs(tip.x - there.x), abs(tip.y - there.y), abs(tip.z - there.z)) < 1e-3
    version = rosservice.get_service_headers("/PSM1/crtk_version", rosservice.get_service_uri("/PSM1/crtk_version"))
    assert version["type"] == "std_srvs/Trigger" and version["md5sum"] == "937c9679a518e3a18d831e57125ea522"


def test_what_is_not_offered_has_no_topic(psm, master):
    names = {name for part in master.state() for name in part if name.startswith("/PSM1/")}
    assert not [name for name in names if "interpolate" in name or name.endswith(("_jv", "_ci", "gripper"))]


def test_masters_have_grippers(start, master, ros):
    simulator = serve(start, master, MTMR, "mtmr.yaml")
    eventually(lambda: "/MTMR/gripper/closed" in master.published(), 30.0, "the arm's topics")
    arm = Arm(ros, "MTMR")
    arm.home()
    gripper = ros.listen("/MTMR/gripper/measured_js", JointState)
    assert 0.0 <= gripper.last().position[0] < 1.1
    assert isinstance(ros.listen("/MTMR/gripper/closed", Bool).last().data, bool)
    goal = [0.1, 0.2, -0.1, 0.2, 0.1, 0.1, 0.3]
    arm.wait_idle_after(lambda: arm.joints("move_jp", goal))
    arm.fresh(arm.measured_js, close_to(goal, 0.02))
    # Held by a spring at the tip, 1 cm away: it goes there, and the wrist keeps its orientation.
    pose = arm.fresh(arm.measured_cp).pose
    locked = ros.listen("/MTMR/orientation_locked", Bool)
    assert not locked.last().data
    ros.talk("/MTMR/lock_orientation", Quaternion).publish(pose.orientation)
    eventually(lambda: locked.last().data, 10.0, "the orientation is locked")
    spring = CartesianImpedance(force_orientation=Quaternion(w=1.0), torque_orientation=pose.orientation)
    spring.force_position.x, spring.force_position.y = pose.position.x + 0.01, pose.position.y
    spring.force_position.z = pose.position.z
    for side in (spring.position_positive, spring.position_negative):
        side.p.x = side.p.y = side.p.z = -60.0
        side.d.x = side.d.y = side.d.z = -8.0
    ros.talk("/MTMR/servo_ci", CartesianImpedance).publish(spring)
    there = arm.fresh(arm.measured_cp, lambda m: abs(m.pose.position.x - spring.force_position.x) < 1e-3)
    q, p = there.pose.orientation, pose.orientation
    assert abs(q.x * p.x + q.y * p.y + q.z * p.z + q.w * p.w) > 0.999
    assert simulator.stop()[0] == 0


def test_mistakes_of_descriptions_are_told_and_cost_only_their_arm(start, master, ros, tmp_path):
    file = tmp_path / "arms.yaml"
    file.write_text(
        "crtk arms:\n"
        "  WRONG:\n    kinematics: PSN\n    base: /ambf/env/psm/BODY base link\n"
        "  LOST:\n    kinematics: ECM\n    base: /ambf/env/psm/BODY base link\n    joints: [a, b, c, d]\n"
        "  RIGHT:\n    kinematics: PSM\n    base: /ambf/env/psm/BODY base link\n"
    )
    checked = subprocess.run([SIMULATOR, "--check", file], capture_output=True, text=True, check=False)
    assert checked.returncode == 1 and "arms.yaml:3:17: error: [WRONG: kinematics]" in checked.stdout
    assert "did you mean 'PSM'?" in checked.stdout
    assert subprocess.run([SIMULATOR, "--check", *DESCRIPTIONS.glob("*.yaml")], capture_output=True).returncode == 0
    simulator = start("-l", PSM, "--crtk", file, allowed=[r"arms\.yaml:"], master_uri=master.uri)
    eventually(lambda: "/RIGHT/measured_js" in master.published(), 30.0, "the topics of the arm that is right")
    simulator.wait_log(r"arms\.yaml:7:11: error: \[LOST: base\].*no joint 'a'")
    assert not any(name.startswith(("/WRONG", "/LOST")) for name in master.published())


def test_an_arm_whose_joints_go_is_at_fault(psm):
    from ambf_client import Client

    client = Client()
    client.connect()
    client.world.remove("/ambf/env/psm/BODY tool pitch link")
    client.clean_up()
    psm.wait(lambda: psm.state.state == "FAULT", "is at fault")
