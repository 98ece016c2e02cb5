"""Checks one arm against what programs of the CRTK count on, row by row: python conformance_program.py NAME KINEMATICS
FRAME_RATE REAL_TIME_FACTOR SPEED ACCELERATION. Ends with the rows that hold, or an error."""

import sys
import time

import numpy as np
import rospy
import rostopic
from ambf_client.kinematics import load_arm
from crtk_double import Double, joints, matrix, near, until
from geometry_msgs.msg import PoseStamped, Quaternion, TwistStamped, Wrench, WrenchStamped
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from ambf_msgs.srv import Remove
from crtk_msgs.msg import OperatingState
from crtk_msgs.srv import QueryForwardKinematics, QueryInverseKinematics

NAME, KINEMATICS, BASE = sys.argv[1:4]
FACTOR, ACCELERATION, PATIENCE = map(float, sys.argv[4:7])
STAMPS_PER_S = 1.0 / FACTOR if sys.argv[7] == "wall" else 1.0  # seconds of stamps a simulated second
ALL = """measured_js measured_cp measured_cv setpoint_js setpoint_cp setpoint_cv goal_js goal_cp operating_state
 local/measured_cp local/setpoint_cp local/measured_cv local/setpoint_cv body/measured_cf spatial/measured_cf
 body/jacobian spatial/jacobian trajectory_j/ratio trajectory_j/ratio_v trajectory_j/ratio_a goal_reached desired_state
 error warning status"""
TAKEN = """state_command servo_jp servo_jr servo_jf servo_cp servo_cr servo_cv move_jp move_jr move_cp move_cr hold free
 body/servo_cf spatial/servo_cf body/set_cf_orientation_absolute use_gravity_compensation set_base_frame
 trajectory_j/set_ratio trajectory_j/set_ratio_v trajectory_j/set_ratio_a"""
MORE = {
    "PSM": (
        """jaw/measured_js jaw/setpoint_js tool_type tool_type_request arm_clutch IO/adapter IO/tool IO/arm_clutch
         IO/SUJ_clutch""",
        "jaw/servo_jp jaw/servo_jf jaw/move_jp set_tool_type emulate_tool_present emulate_adapter_present",
    ),
    "ECM": ("endoscope_type arm_clutch", "set_endoscope_type"),
    "MTMR": (
        "gripper/measured_js gripper/closed gripper/pinch orientation_locked",
        "servo_ci lock_orientation unlock_orientation",
    ),
}

rospy.init_node("conformance", anonymous=True, disable_rosout=True)
until(lambda: not rospy.Time.now().is_zero(), 20.0, "a clock")
arm = Double(NAME, PATIENCE)
kinematics = load_arm(KINEMATICS)
size = len(kinematics.names)
lower, upper = np.array(kinematics.lower), np.array(kinematics.upper)


def row_21_clients_waits_end():
    arm.enable()
    arm.home()
    arm.move_jp(kinematics.home)
    start = time.monotonic()
    arm.move_jp(kinematics.home)  # 15: to where it is
    assert time.monotonic() - start < 0.5 * PATIENCE
    arm.enable()
    arm.home()
    quiet()


def quiet():
    """What was sent has shown as busy, and as idle: clients do not wait for that where an arm is homed already."""

    def nothing_new():
        states = len(arm.states)
        time.sleep(0.3)
        return len(arm.states) == states and not arm.data.is_busy

    until(nothing_new, PATIENCE, "the arm rests")


def row_01_names_and_lengths():
    message = arm.last("measured_js")
    assert message.name == kinematics.names and len(message.position) == size
    assert len(message.velocity) in (0, size) and len(message.effort) in (0, size)


def same_stamp(*topics):
    """A message of each with one stamp, not zero."""

    def find():
        for first in reversed(arm.heard[topics[0]][-20:]):
            stamp = first.header.stamp
            found = [next((m for m in arm.heard[t][-40:] if m.header.stamp == stamp), None) for t in topics]
            if not stamp.is_zero() and all(found):
                return found
        return None

    return until(find, PATIENCE, f"one stamp of {topics}")


def rows_02_03_05_one_sample():
    js, cp, _cv = same_stamp("measured_js", "measured_cp", "measured_cv")
    assert js.header.frame_id == cp.header.frame_id
    assert cp._md5sum == "d3812c3cbc69362b77dc0b19b345f8f5"
    q = cp.pose.orientation
    assert abs(np.linalg.norm([q.x, q.y, q.z, q.w]) - 1.0) < 1e-6


def row_04_base_frame_times_kinematics():
    base = PoseStamped()
    base.pose.position.x, base.pose.orientation = 0.2, Quaternion(0.0, 0.0, 0.6, 0.8)
    arm.talkers["set_base_frame"].publish(base)

    def holds():
        js, cp, local = same_stamp("measured_js", "measured_cp", "local/measured_cp")
        forward = kinematics.forward(list(js.position))
        assert np.abs(matrix(local.pose) - forward).max() < 1e-6
        return np.abs(matrix(cp.pose) - matrix(base.pose) @ forward).max() < 1e-6

    until(holds, PATIENCE, "the base frame")
    home = PoseStamped()
    home.pose.orientation.w = 1.0
    arm.talkers["set_base_frame"].publish(home)
    until(lambda: np.abs(matrix(arm.last("setpoint_cp").pose) - kinematics.forward(arm.set_point())).max() < 1e-9)


def row_06_jaws_are_apart():
    assert not {"jaw", "gripper"} & set(arm.last("measured_js").name)
    for part in ("jaw", "gripper"):
        if f"{part}/measured_js" in " ".join(MORE.get(KINEMATICS, [""])):
            message = rospy.wait_for_message(f"/{NAME}/{part}/measured_js", JointState, PATIENCE)
            assert len(message.position) == len(message.name) == 1


def rows_07_08_the_last_servo_counts_and_is_never_busy():
    states = len(arm.states)
    for i in range(20):
        arm.servo_jp(shifted(0.001 * i))
    arm.set_point(shifted(0.019))
    arm.servo_jp(kinematics.home)
    arm.set_point(kinematics.home)
    assert len(arm.states) == states


def shifted(by):
    there = np.array(kinematics.home)
    there[0] += by
    return there


def row_09_malformed_servos_are_ignored():
    before, since, states = arm.set_point(), len(arm.heard["warning"]), len(arm.states)
    for message in (joints([0.1]), joints([float("nan")] * size), JointState(velocity=[0.1] * size)):
        arm.talkers["servo_jp"].publish(message)
    arm.warned("servo_jp was ignored", since)
    assert len(arm.heard["warning"]) - since <= 3  # once each
    assert near(arm.set_point(), before, 0.0) and len(arm.states) == states


def row_10_limits_clip():
    joint = int(np.argmin(upper - np.array(kinematics.home)))
    beyond, inside = np.array(kinematics.home), np.array(kinematics.home)
    beyond[joint], inside[joint] = upper[joint] + 1.0, upper[joint]
    arm.servo_jp(beyond)
    arm.set_point(inside)
    arm.move_jp(kinematics.home)


def row_11_increments_add_exactly():
    arm.servo_jp(kinematics.home)
    arm.set_point(kinematics.home)
    for _ in range(8):
        arm.talkers["servo_jr"].publish(joints([0.0078125] + [0.0] * (size - 1)))
    wanted = shifted(0.0)
    for _ in range(8):
        wanted[0] += 0.0078125
    arm.set_point(wanted, 0.0)


def row_12_the_set_point_as_command_moves_nothing():
    before = arm.last("setpoint_js")
    arm.talkers["servo_cp"].publish(arm.last("setpoint_cp"))
    after = arm.last("setpoint_js", lambda m: m.header.stamp > before.header.stamp)  # it was obeyed
    assert near(after.position, before.position, 1e-6)


def away():
    there = np.array(kinematics.home)
    return np.clip(there + [0.1 if not slides else 0.02 for slides in kinematics.prismatic], lower, upper)


def row_13_moves_are_busy_then_idle_and_arrive():
    first = len(arm.states)
    arm.move_jp(away())
    busy = [state.is_busy for state in arm.states[first:]]
    assert busy[0] and not busy[-1] and busy == sorted(busy, reverse=True)
    stamps = [state.header.stamp for state in arm.states]
    assert stamps == sorted(set(stamps))
    arm.last("measured_js", lambda m: near(m.position, away(), 0.01))
    assert not any(arm.last("setpoint_js").velocity)
    arm.move_jp(kinematics.home)


def row_14_a_second_move_goes_on_from_the_first():
    states, heard = len(arm.states), arm.heard["setpoint_js"]
    first = len(heard)
    target = np.clip(shifted(1.2), lower, upper)
    arm.talkers["move_jp"].publish(joints(target))
    arm.last("setpoint_js", lambda m: m.velocity and m.velocity[0] > 0.2)
    arm.move_jp(kinematics.home)
    assert [s.is_busy for s in arm.states[states:]].count(False) == 1
    rates = [(m.header.stamp.to_sec(), m.velocity[0] if m.velocity else 0.0) for m in list(heard)[first:]]
    for (t0, v0), (t1, v1) in zip(rates, rates[1:], strict=False):
        # Stamps of the wall say only nearly how much time was simulated: a step of the speed would be ten times this.
        passed = (t1 - t0) / STAMPS_PER_S
        assert abs(v1 - v0) <= ACCELERATION * ((2.0 if STAMPS_PER_S != 1.0 else 1.0) * passed + 0.02), (v0, v1, t1 - t0)


def row_16_unreachable_moves_end_at_once():
    # Of a busy machine the last set-points of the move before may come only now.
    arm.set_point(kinematics.home, 0.0)
    before, since = arm.set_point(), len(arm.heard["warning"])
    pose = arm.last("setpoint_cp")
    pose.pose.position.x += 5.0
    arm.move("move_cp", pose)
    arm.warned("move_cp was ignored", since)
    until(lambda: arm.heard["goal_reached"] and not arm.heard["goal_reached"][-1].data, PATIENCE, "not reached")
    assert near(arm.set_point(), before, 0.0)


def row_17_a_servo_ends_a_move():
    reached = len(arm.heard["goal_reached"])
    arm.talkers["move_jp"].publish(joints(np.clip(shifted(1.2), lower, upper)))
    arm.wait(lambda: arm.data.is_busy, "moves")
    arm.servo_jp(kinematics.home)
    arm.wait(lambda: not arm.data.is_busy, "is idle")
    until(lambda: len(arm.heard["goal_reached"]) > reached, PATIENCE, "goal_reached")
    assert not arm.heard["goal_reached"][reached].data
    arm.set_point(kinematics.home)
    arm.last("measured_js", lambda m: near(m.position, kinematics.home, 0.01))


TABLE = {
    "DISABLED": {"enable": "ENABLED", "home": "ENABLED"},
    "ENABLED": {"disable": "DISABLED", "pause": "PAUSED"},
    "PAUSED": {"disable": "DISABLED", "resume": "ENABLED"},
    "FAULT": {"disable": "DISABLED"},  # enable: its joints are not there
}
WAYS = {"DISABLED": ["disable"], "ENABLED": ["disable", "enable"], "PAUSED": ["disable", "enable", "pause"]}
INVALID = {"DISABLED": ["pause", "resume"], "ENABLED": ["resume"], "PAUSED": ["enable", "home"]}
INVALID["FAULT"] = ["enable", "pause", "resume", "home"]


def check_command(state, command):
    since = len(arm.heard["warning"])
    wanted = TABLE[state].get(command, state)
    arm.state_command(command)
    if command in INVALID[state]:
        # Each is said, but the same only once in two seconds.
        until(lambda: any(f"state_command {command} was" in m.data for m in arm.heard["warning"]), PATIENCE, command)
    arm.wait(lambda: arm.data.state == wanted, f"{command} in {state}")
    assert since <= len(arm.heard["warning"])


def check_nothing_moves(state):
    """DISABLED, the arm goes on by itself, but not where it is sent."""
    until(lambda: state == "DISABLED" or near(arm.set_point(), arm.set_point(), 0.0), PATIENCE, "the set-point rests")
    before, reached = arm.set_point(), len(arm.heard["goal_reached"])
    arm.servo_jp(away())
    arm.talkers["move_jp"].publish(joints(away()))
    until(lambda: len(arm.heard["goal_reached"]) > reached, PATIENCE, "the move is refused")
    after = arm.set_point()
    assert not near(after, away(), 1e-4) if state == "DISABLED" else near(after, before, 0.0)


def rows_18_19_states_and_what_they_allow():
    for state, way in WAYS.items():
        for command in ("enable", "disable", "pause", "resume", "home", "unhome"):
            for each in way:
                arm.state_command(each)
            arm.wait(lambda state=state: arm.data.state == state, f"is {state}")
            check_command(state, command)
            if state != "ENABLED" and arm.data.state == state:
                check_nothing_moves(state)
    arm.state("disable", "DISABLED")
    arm.enable()
    arm.home()


def row_20_states_are_latched():
    late = rospy.wait_for_message(f"/{NAME}/operating_state", OperatingState, PATIENCE)
    assert late.state == arm.data.state and not late.header.stamp.is_zero()


def rows_22_23_efforts():
    arm.talkers["servo_jf"].publish(joints(effort=[0.0] * size))
    message = arm.last("setpoint_js", lambda m: len(m.effort) == size)
    assert not message.position
    arm.last("setpoint_cp", lambda m: m.header.stamp.is_zero())
    arm.servo_jp(kinematics.home)
    arm.last("setpoint_cp", lambda m: not m.header.stamp.is_zero())
    arm.talkers["move_jp"].publish(joints(away()))
    arm.last("setpoint_js", lambda m: len(m.velocity) == size and any(m.velocity))
    arm.wait(lambda: not arm.data.is_busy, "is idle")


def row_24_jacobians():
    arm.talkers["move_jp"].publish(joints(away()))
    arm.last("measured_js", lambda m: np.abs(m.velocity).max() > 0.05)
    js, cv = same_stamp("measured_js", "measured_cv")
    twist = [getattr(part, axis) for part in (cv.twist.linear, cv.twist.angular) for axis in "xyz"]
    expected = kinematics.jacobian(list(js.position), "spatial") @ js.velocity
    assert np.abs(expected - twist).max() < 1e-6
    arm.wait(lambda: not arm.data.is_busy, "is idle")
    for frame in ("body", "spatial"):
        message = arm.last(f"{frame}/jacobian")
        assert [d.size for d in message.layout.dim] == [6, size] and len(message.data) == 6 * size
    wrench = WrenchStamped()
    wrench.wrench = Wrench()
    wrench.wrench.force.x, wrench.wrench.torque.z = 0.02, 0.002
    arm.talkers["body/servo_cf"].publish(wrench)
    arm.last("setpoint_js", lambda m: len(m.effort) == size and any(m.effort))
    until(lambda: len(same_stamp("setpoint_js", "measured_js")[0].effort), PATIENCE, "efforts")
    exerted, js = same_stamp("setpoint_js", "measured_js")
    expected = kinematics.jacobian(list(js.position), "body").T @ [0.02, 0, 0, 0, 0, 0.002]
    assert near(exerted.effort, expected, 1e-9), (exerted.effort, expected)
    arm.talkers["hold"].publish()
    arm.set_point()
    arm.move_jp(kinematics.home)


def servo_cv_moves_the_tip():
    arm.talkers["servo_cv"].publish(TwistStamped())
    arm.last("setpoint_js", lambda m: len(m.velocity) == size and not m.position)
    arm.last("setpoint_js", lambda m: len(m.position) == size)  # its sender fell silent
    arm.last("setpoint_cp", lambda m: not m.header.stamp.is_zero())


def row_25_topics_and_services():
    published, subscribed = ({name for name, *_ in part} for part in rostopic.get_topic_list())
    more = MORE.get(KINEMATICS, ("", ""))
    for names, there in ((ALL + " " + more[0], published), (TAKEN + " " + more[1], subscribed)):
        missing = [name for name in names.split() if f"/{NAME}/{name}" not in there]
        assert not missing, missing
    ours = {name for name in published | subscribed if name.startswith(f"/{NAME}/")}
    assert not [name for name in ours if "interpolate" in name or name.endswith(("_jv", "servo_cs", "servo_js"))]
    fk = rospy.ServiceProxy(f"/{NAME}/forward_kinematics", QueryForwardKinematics)
    ik = rospy.ServiceProxy(f"/{NAME}/inverse_kinematics", QueryInverseKinematics)
    there = fk(jp=list(away()))
    back = ik(cp=there.cp, jp=list(away()))
    assert there.result and back.result and near(back.jp, away(), 1e-6)


def ratios_slow_moves():
    rospy.Publisher(f"/{NAME}/trajectory_j/set_ratio", Float64, queue_size=1, latch=True).publish(Float64(0.5))
    topic = f"/{NAME}/trajectory_j/ratio"
    until(lambda: rospy.wait_for_message(topic, Float64, PATIENCE).data == 0.5, PATIENCE, "the ratio")


def rows_18_19_fault():
    remove = rospy.ServiceProxy("/ambf/env/World/Remove", Remove)
    assert remove(BASE).success
    arm.wait(lambda: arm.data.state == "FAULT" and not arm.data.is_busy, "is at fault")
    for command in ("enable", "pause", "resume", "home", "unhome"):
        check_command("FAULT", command)
    arm.servo_jp(away())
    assert arm.data.state == "FAULT"
    check_command("FAULT", "disable")


row_21_clients_waits_end()
for check in [value for name, value in sorted(globals().items()) if name.startswith("row") and "21" not in name]:
    if check is not rows_18_19_fault:
        check()
        print(check.__name__, flush=True)
servo_cv_moves_the_tip()
ratios_slow_moves()
rows_18_19_fault()
print("all rows hold")
