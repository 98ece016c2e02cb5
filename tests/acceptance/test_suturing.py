"""The suturing scene as programs of AMBF 3.0 use it: handles, the grasp logic of ghosts and actuator, a held needle and
resets, CRTK topics and joint errors by several `ral`, pictures in pairs, a recorder, the evaluators."""

import importlib.util
import threading

import numpy as np
import pytest
import rosbag
from ambf_client import Client
from geometry_msgs.msg import PoseStamped
from harness import ROOT, eventually
from ros_abstraction_layer import ral as Ral
from sensor_msgs.msg import CameraInfo, ChannelFloat32, Image, JointState
from std_msgs.msg import Bool

from ambf_msgs.msg import RigidBodyState

LAUNCH = ROOT / "ambf_models/suturing/launch.yaml"
EVALUATION = ROOT / "ambf_client_py/examples/suturing_evaluation.py"
FLAGS = ("-p", "200", "-t1", "--override_max_comm_freq", "100", "--override_min_comm_freq", "100")
NEEDLE_BASE = np.array((-0.00951, 0.00103, 0.0))  # m, in the needle's frame
GRIP = np.array((0.0, -0.0102, 0.0, 1.0))  # in toolyawlink's
OPEN, CLOSED, HELD_BELOW = 0.5, 0.0, 0.05  # rad


class Arm:
    """What programs of 3.0 make of the handles of one arm."""

    def __init__(self, client, name):
        self.client, self.world = client, client.world
        handles = [f"{name}/{part}" for part in ("baselink", "tool_id", "toolyawlink", "Actuator0")]
        self.base, self.tool_id, self.yaw, self.actuator = map(client.get_obj_handle, handles)
        self.ghosts = [client.get_obj_handle(f"{name}/{side}_finger_ghost") for side in ("left", "right")]
        self.grasped = False

    def move(self, q, steps=600):
        for joint, value in enumerate(q):
            self.base.set_joint_pos(joint, float(value))
        self.world.step(steps)

    def jaw(self, angle, steps=150):
        for joint in (6, 7):
            self.base.set_joint_pos(joint, angle)
        self.world.step(steps)
        now = self.world.get_sim_step()
        assert all(ghost.wait_for_sim_step(now, 5.0) for ghost in self.ghosts)
        if angle >= HELD_BELOW:
            self.actuator.deactuate()
            self.grasped = False
        elif not self.grasped:
            names = [name for ghost in self.ghosts for name in ghost.get_all_sensed_obj_names()]
            for wanted in ("Needle", "Thread"):
                fits = [name for name in names if wanted in name]
                if fits and not self.grasped:
                    self.actuator.actuate(fits[0])
                    self.grasped = True
        self.world.step(2)

    def bring(self, needle, steps=700):
        """Commands the needle into the open jaw, its base between the fingers."""
        pose = np.identity(4)
        pose[:3, :3] = self.yaw.matrix[:3, :3]
        pose[:3, 3] = (self.yaw.matrix @ GRIP)[:3] - pose[:3, :3] @ NEEDLE_BASE
        needle.set_pose(pose)
        self.world.step(steps)

    def held(self, needle):
        """Where the needle is in the jaw."""
        return np.linalg.inv(self.yaw.matrix) @ needle.matrix


@pytest.fixture
def suture(start, master, ros):
    """A client of 3.0 at the scene, stepping it."""
    start("--launch_file", LAUNCH, "-l", "0,1,2,3,4,5", *FLAGS, master_uri=master.uri)
    client = Client("suture", 5)
    client.connect()
    eventually(lambda: "/ambf/env/ghosts/psm2/Actuator0" in client.get_obj_names(), 20.0)
    client.world.step(50)
    yield client
    client.clean_up()


def test_a_needle_is_grasped_held_through_resets_and_released(suture):
    assert suture.get_obj_handle("psm1_target_ik") is None
    arm, needle, world = Arm(suture, "psm1"), suture.get_obj_handle("Needle"), suture.world
    assert arm.tool_id._name == "/ambf/env/psm1/tool_id/400006"
    assert suture.get_obj_handle("Entry1")._name == "/ambf/env/phantom/Entry1"  # beside ghostEntry1
    assert suture.get_obj_handle("CameraFrame") is not None
    assert [suture.get_obj_handle(f"camera{side}")._name[-1] for side in "LR"] == ["L", "R"]
    arm.move((-0.4, -0.22, 0.139, -1.64, -0.37, -0.11))
    assert arm.base.get_all_joint_pos()[:6] == pytest.approx((-0.4, -0.22, 0.139, -1.64, -0.37, -0.11), abs=1e-3)

    random = np.random.default_rng(17)
    for _ in range(3):  # a hundred by hand
        arm.move(np.array((0.0, 0.0, 0.13, 0.0, 0.0, 0.0)) + random.uniform(-0.2, 0.2, 6) * (1, 1, 0.05, 1, 1, 1))
        arm.jaw(OPEN)
        arm.bring(needle)
        before = needle.matrix
        arm.jaw(CLOSED)
        assert arm.grasped
        needle.set_force(0.0, 0.0, 0.0)  # ends the pose command
        assert np.linalg.norm(needle.matrix[:3, 3] - before[:3, 3]) < 1e-3  # it goes on to its pose until it is held
        world.step(1)
        assert arm.actuator.is_actuated()
        held = arm.held(needle)
        arm.move(random.uniform(-0.2, 0.2, 2), 400)
        assert np.abs(arm.held(needle) - held).max() < 1e-6, "no slip"
        arm.jaw(OPEN, 1)
        world.step(50)
        assert not arm.actuator.is_actuated()
        assert np.abs(arm.held(needle) - held).max() > 1e-4, "it falls"
        assert max(abs(needle.linear_velocity)) < 2.0, "it is not thrown"

    arm.bring(needle)
    arm.jaw(CLOSED)
    needle.set_force(0.0, 0.0, 0.0)
    world.step(20)
    held = arm.held(needle)
    for reset in (world.reset_bodies, world.reset):
        reset()
        world.step(500)
        assert arm.actuator.is_actuated()
        assert np.abs(arm.held(needle) - held).max() < 1e-6, "a held needle stays held"
        assert arm.base.get_joint_pos(2) == pytest.approx(0.13, abs=0.02), "joint commands go on"


def test_evaluators_see_entry_exit_depth_and_hand_over(suture):
    spec = importlib.util.spec_from_file_location("suturing_evaluation", EVALUATION)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    evaluation = module.evaluation_of(suture)
    needle, hole = evaluation.needle, evaluation.holes["Entry2"]
    for z in (0.004, -0.003, 0.004):  # of the tip in the hole's frame
        pose = hole.matrix @ np.array(((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, z), (0, 0, 0, 1)))
        pose[:3, 3] -= pose[:3, :3] @ module.TIP[:3]
        needle.set_pose(pose)
        for _ in range(80):
            suture.world.step(10)
            evaluation.sample()
    assert [(p.hole, p.entry) for p in evaluation.passages] == [("Entry2", True), ("Entry2", False)]
    assert all(p.lateral < 0.003 for p in evaluation.passages)
    assert 0.001 < evaluation.depth["Entry2"] < 0.004
    for giver, taker in ((True, False), (True, True), (False, True)):
        for name, holds in (("psm1", giver), ("psm2", taker)):
            grip = evaluation.grips[name]
            grip.actuate("Needle") if holds else grip.deactuate()
        suture.world.step(20)
        evaluation.sample()
    assert evaluation.hand_overs == [("psm1", "psm2")]


def test_topics_of_a_crtk_launcher_and_joint_errors_of_another_ral(suture):
    """One process serves CRTK topics of an arm, 120 times a second, and adds errors that it is given."""
    world, arm = suture.world, Arm(suture, "psm1")
    world.release()
    served, errors, heard = suture.get_ral(), np.zeros(6), []
    other = Ral("errors")  # a second one in the process
    wrong = other.subscriber(
        "/ambf/env/psm1/errors_model/set_errors/", ChannelFloat32, lambda m: errors.__setitem__(slice(None), m.values)
    )
    measured = served.publisher("CRTK/psm1/measured_js", JointState, 1)
    tip = served.publisher("/CRTK/psm1/measured_cp", PoseStamped, 1)
    servo = served.subscriber(
        "/CRTK/psm1/servo_jp",
        JointState,
        lambda m: [arm.base.set_joint_pos(i, q + errors[i]) for i, q in enumerate(m.position)],
        1,
    )
    stop = threading.Event()

    def serve():
        rate = suture.create_rate(120)
        while not stop.is_set() and not suture.is_shutdown():
            state = JointState(position=np.array(arm.base.get_all_joint_pos()[:6]) - errors)
            state.header.stamp = served.now_msg()
            measured.publish(state)
            tip.publish(PoseStamped(header=state.header))
            rate.sleep()

    thread = threading.Thread(target=serve)
    thread.start()
    user = Ral("user", "/CRTK/psm1")
    listener = user.subscriber("measured_js", JointState, heard.append)
    command, report = user.publisher("servo_jp", JointState), other.publisher("report/task2/", Bool, latch=True)
    errors_out = Ral("sender").publisher("/ambf/env/psm1/errors_model/set_errors", ChannelFloat32)
    user.check_connections(10.0, check_children=False)
    eventually(lambda: errors_out.get_num_connections() > 0)
    errors_out.publish(ChannelFloat32(values=[0.05] * 3 + [0.0] * 3))
    eventually(lambda: errors[0] > 0.04)
    goal = np.array((0.1, -0.1, 0.12, 0.2, 0.1, 0.0))
    command.publish(JointState(position=goal))
    eventually(lambda: heard and np.abs(np.array(heard[-1].position) - goal).max() < 2e-3, 60.0)
    assert np.array(arm.base.get_all_joint_pos()[:6]) == pytest.approx(goal + errors, abs=3e-3)
    times = [served.to_sec(message) for message in heard]
    assert times == sorted(times)
    report.publish(Bool(True))
    stop.set()
    thread.join()
    for end in (wrong, measured, tip, servo, listener, command, report, errors_out):
        end.unregister()


def test_pictures_come_in_pairs_and_states_are_recorded(suture, tmp_path):
    suture.world.release()
    seen, info, bag_lock = {"L": {}, "R": {}}, [], threading.Lock()
    ral = suture.get_ral()
    eyes = [
        ral.subscriber(
            f"/ambf/env/cameras/camera{side}/ImageData",
            Image,
            lambda message, side=side: seen[side].update({message.header.stamp: message}),
        )
        for side in "LR"
    ]

    def pairs():  # as a time synchroniser makes them
        return [(seen["L"][stamp], seen["R"][stamp]) for stamp in sorted(set(seen["L"]) & set(seen["R"]))]

    about = ral.subscriber("/ambf/env/cameras/cameraL/CameraInfo", CameraInfo, info.append, 1)
    with rosbag.Bag(str(tmp_path / "states.bag"), "w") as bag:

        def record(message):
            with bag_lock:
                bag.write("/ambf/env/phantom/Needle/State", message, message.header.stamp)

        recorder = ral.subscriber("/ambf/env/phantom/Needle/State", RigidBodyState, record)
        eventually(lambda: len(pairs()) > 2 and info, 60.0)
        recorder.unregister()
        with bag_lock:
            pass
    left, right = pairs()[-1]
    assert (left.width, left.height, left.encoding) == (640, 480, "rgb8")
    assert info[-1].width == 640
    shades = [np.frombuffer(picture.data, np.uint8).astype(int) for picture in (left, right)]
    assert all(np.ptp(shade) > 60 for shade in shades), "the scene is in both"
    assert np.abs(shades[0] - shades[1]).max() > 20, "from two places"
    with rosbag.Bag(str(tmp_path / "states.bag")) as bag:
        assert bag.get_message_count() > 2
    for each in (about, *eyes):
        each.unregister()
