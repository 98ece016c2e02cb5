"""Programs of AMBF 3.0: the client's face of that generation, beside that of 2.0, in one process."""

import importlib
import inspect
import math
import time

import ambf_client
import pytest
import scenes
import tf_function
from ambf_client import BaseObject, Camera, Client, GhostObject, RigidBody, WatchDog, World
from harness import Simulator, eventually
from ros_abstraction_layer import ral as Ral
from std_msgs.msg import Empty

BOX = "/ambf/env/Box"


@pytest.mark.parametrize(
    "arguments, named, attempts, prefix",
    [
        ((), {}, 5, "/"),
        (("name", 3), {}, 3, "/"),
        (("name", "/left/ambf"), {}, 5, "/left/ambf/"),
        (("name", 3, "left"), {}, 3, "/left/"),
        (("name", "left", 3), {}, 3, "/left/"),
        ((), {"max_discovery_attempts": 0, "namespace": "left"}, 0, "/left/"),
    ],
)
def test_a_client_is_made_as_in_either_generation(arguments, named, attempts, prefix):
    client = Client(*arguments, **named)
    assert (client._attempts, client._objects._prefix) == (attempts, prefix)
    assert client.ral is None
    assert client.get_ral() is None


@pytest.mark.parametrize("wrong", [(True,), (-1,), (2.5,), (None,), ("a", "b"), (1, 2)])
def test_arguments_that_fit_neither_are_named(wrong):
    with pytest.raises(TypeError, match=r"max_discovery_attempts.*namespace"):
        Client("name", *wrong)
    with pytest.raises(RuntimeError, match=r"connect\(\)"):
        Client("name").get_time()


@pytest.mark.parametrize(
    "module, names",
    [
        *((f"ambf_{name}", [kind]) for name, kind in [("client", "Client"), ("world", "World"), ("object", "Object")]),
        *((f"ambf_{name}", [kind]) for name, kind in [("rigid_body", "RigidBody"), ("base_object", "BaseObject")]),
        *((f"ambf_{name}", [name.title()]) for name in ("camera", "light", "actuator", "vehicle")),
        ("ambf_sensor", ["Sensor", "ContactSensor", "SensorBase", "SensorType"]),
        ("ambf_ghost_object", ["GhostObject"]),
        ("watch_dog", ["WatchDog"]),
    ],
)
def test_modules_of_the_third_generation_hold_the_same_classes(module, names):
    for name in names:
        assert getattr(importlib.import_module(f"ambf_client.{module}"), name) is getattr(ambf_client, name)


def test_handles_are_made_as_in_either_generation(ros):
    ral = Ral("handles")
    for made in (RigidBody(ral, BOX), RigidBody(BOX, ral=ral), RigidBody(BOX, 0.1, ral), RigidBody(BOX)):
        assert made._name == made.get_name() == BOX
    assert RigidBody(ral, BOX, 0.3)._time_out == RigidBody(ral, BOX, time_out=0.3)._time_out == 0.3
    assert RigidBody(ral, BOX).ral is ral
    assert RigidBody(BOX).ral is None
    assert World("/ambf/env/World", ral).ral is WatchDog(ral, time_out=1.0).ral is BaseObject(ral, BOX, 1.0).ral is ral
    with pytest.raises(TypeError, match="ros_abstraction_layer"):
        RigidBody(BOX, ral="node")


def test_the_client_of_the_third_generation(bench, ros, capsys):
    client = Client("third", 5)
    client.connect(120)
    ral = client.get_ral()
    assert isinstance(ral, Ral)
    assert ral is client.ral
    assert ral.node_name() == "third"
    assert not client.is_shutdown()
    begin = client.get_time()
    client.create_rate(100).sleep()
    assert 0.0 < client.get_time() - begin < time.time()
    assert client.get_time() == pytest.approx(time.time(), abs=10.0)
    assert client.msg_related_classes["ambf_msgs/GhostObjectState"] is GhostObject
    assert {"RigidBody", "GhostObject", "ContactSensor", "World"} <= set(client.object_types)
    capsys.readouterr()
    assert client.get_obj_handle("psm1_target_ik") is None
    assert "no object 'psm1_target_ik'" in capsys.readouterr().err

    box = client.get_obj_handle("Box")
    assert box.ral is ral
    assert box._state.name.data == "Box"
    assert box._name == BOX
    box.set_joint_pos({})
    box.resize_joint_cmd_array(3)
    box.resize_joint_cmd_array(1, compress_cmd_array=True)
    assert len(box._cmd.joint_cmds) == len(box._cmd.joint_cmds_types) == 1

    eye = client.create_obj("/ambf/env/later/eye/State", "ambf_msgs/msg/CameraState")
    assert isinstance(eye, Camera)
    assert client.create_obj("/ambf/env/Box/State", "ambf_msgs/RigidBodyState") is box
    with pytest.raises(ValueError, match="known: .*ambf_msgs/RigidBodyState"):
        client.create_obj("/ambf/env/mud/State", "ambf_msgs/MudState")
    with pytest.raises(TypeError, match="ROS 1"):
        Client("wrong", ral="node").connect()
    client.clean_up()


def test_several_clients_share_a_process_and_may_share_a_node(bench, ros):
    shared = Ral("shared")
    clients = [Client("first"), Client("second"), Client("third", ral=shared), Client("fourth")]
    clients[3].ral = shared
    for each in clients:
        each.connect()
    assert clients[0].ral is not clients[1].ral
    assert clients[2].ral is clients[3].ral is shared
    boxes = [each.get_obj_handle("Box") for each in clients]
    assert len({id(box) for box in boxes}) == 4
    boxes[2].set_force(4.0, 0.0, 0.0)
    eventually(lambda: all(box.get_linear_vel().x > 0.05 for box in boxes), 30.0)
    clients[0].clean_up()
    clients[2].clean_up()
    assert boxes[1].wait_for_next_state()
    assert boxes[3].wait_for_next_state()
    speed = boxes[3].get_linear_vel().x
    boxes[3].set_force(4.0, 0.0, 0.0)
    eventually(lambda: boxes[1].get_linear_vel().x > speed + 0.05, 30.0)
    for each in clients:
        each.clean_up()


FOUR = """
import time
from ambf_client import Client
from ros_abstraction_layer import ral
shared = ral("shared") if {shared} else None
clients = [Client(f"client{{i}}", ral=shared) for i in range(4)]
for each in clients:
    each.connect()
bodies = [each.get_obj_handle("Box") for each in clients]
print("ready", flush=True)
while not clients[0].is_shutdown():
    for body in bodies:
        body.set_force(0.0, 0.0, 0.0)
    time.sleep(0.01)
print("after the loop", all(each.is_shutdown() for each in clients))
"""


@pytest.mark.parametrize("shared", [False, True])
def test_ctrl_c_ends_all_clients_of_a_process(tmp_path, script, own_master, shared):
    simulator = Simulator(
        tmp_path, "--launch_file", scenes.write(tmp_path), "-l", "0", master_uri=own_master.uri, allowed=[".*"]
    )
    four = script(FOUR.format(shared=shared), own_master.uri)
    four.wait_line("ready", 30.0)
    took = four.interrupt()
    empty = script("import rospy, time\nprint('ready', flush=True)\ntime.sleep(60)", own_master.uri)
    empty.wait_line("ready", 30.0)
    assert took < 1.0 + 4.0 * empty.interrupt(), four.text()  # a busy machine delays the end of any process
    assert "after the loop True" in four.text() or "KeyboardInterrupt" in four.text()  # the latter in a call of ours
    simulator.stop()


# --- ros_abstraction_layer -------------------------------------------------------------------------------------------


def test_times_and_names_of_a_layer(ros):
    ral = Ral("layer", "/psm1/")
    assert (ral.ros_version(), ral.node_name(), ral.namespace()) == (1, "layer", "psm1")
    assert ral.parse_argv(["program", "-x", "a:=b"]) == ["program", "-x"]
    begin = ral.now()
    assert ral.to_sec(ral.now() - begin) >= 0.0
    assert ral.to_sec(ral.create_duration(0.25)) == 0.25
    assert ral.to_sec(ral.create_time()) == 0.0
    state = RigidBody(BOX)._state
    state.header.stamp = ral.now_msg()
    for each in (state, state.header, state.header.stamp):
        assert ral.get_timestamp(each) is state.header.stamp
    assert ral.to_sec(state) == pytest.approx(ral.to_sec(begin), abs=60.0)
    ral.create_rate(1000).sleep()
    ral.spin()
    assert not ral.is_shutdown()
    child = ral.create_child("/arm/")
    assert (child.namespace(), child.node_name()) == ("psm1/arm", "layer")
    with pytest.raises(RuntimeError, match="/arm/"):
        ral.create_child("/arm/")


def test_topics_of_a_layer(ros):
    ral = Ral("talker")
    heard = []
    listener = ral.subscriber("a/topic/", Empty, heard.append, queue_size=5)
    assert ral.get_topic_name(listener) == "/a/topic"
    with pytest.raises(TimeoutError, match="/a/topic"):
        ral.check_connections(0.05)
    ral.check_connections(0.0)
    child = ral.create_child("a")
    talker = child.publisher("topic", Empty, latch=True, tcp_nodelay=True)
    assert child.get_topic_name(talker) == "/a/topic"
    ral.check_connections(5.0)
    eventually(lambda: talker.get_num_connections() == 1)
    talker.publish(Empty())
    eventually(lambda: heard)
    assert ["/a/topic", "std_msgs/Empty"] in ral.get_published_topics()
    lonely = child.subscriber("b", Empty, print)
    ral.check_connections(5.0, check_children=False)
    with pytest.raises(TimeoutError, match="/a/b"):
        ral.check_connections(0.05)
    for end in (listener, talker, lonely):
        end.unregister()


@pytest.mark.parametrize(
    "wrong, error, known",
    [
        (lambda ral: ral.sleep(1.0), AttributeError, "ral has no 'sleep'; it has .*create_rate"),
        (lambda ral: Ral.wait_for_message, AttributeError, "ral has no 'wait_for_message'; it has .*subscriber"),
        (lambda ral: ral.create_rate(1.0, hertz=1.0), TypeError, r"ral.create_rate: .*hertz.*known: \(hz\)"),
        (lambda ral: ral.publisher("a", Empty, latched=True), TypeError, "latched; known: .*latch"),
        (lambda ral: ral.subscriber("a", Empty, print, buffer=1), TypeError, "buffer; known: .*buff_size"),
        (lambda ral: Ral(), TypeError, r"known: \(node_name, namespace='', node=None\)"),
    ],
)
def test_what_a_layer_does_not_know_is_an_error_that_names_what_it_does(ros, wrong, error, known):
    with pytest.raises(error, match=known):
        wrong(Ral("asked"))


def test_the_environment_chooses_the_layer(script, master):
    text = "from ros_abstraction_layer import ral\nprint('version', ral.ros_version())"
    for version, expected in (("1", "version 1"), ("2", "no rclpy"), ("3", "knows 1 and 2")):
        run = script(text, master.uri, environment={"ROS_VERSION": version})
        run.finish()
        assert expected in run.text()


def test_shutting_down_ends_the_node(script, master):
    text = """
from ros_abstraction_layer import ral
layer = ral("ending")
layer.on_shutdown(lambda: print("called back", flush=True))
layer.spin_and_execute(print, "executed", {argument})
print("down", layer.is_shutdown(), flush=True)
try:
    layer.shutdown()
except RuntimeError as error:
    print("raised", error, flush=True)
"""
    run = script(text.format(argument=7), master.uri)
    assert run.finish() == 0, run.text()
    assert run.lines[:3] == ["executed 7", "called back", "down True"]
    assert "raised" in run.lines[3]


@pytest.mark.parametrize("axes", ["sxyz", "szyx", "rxyz", "rzyx"])
def test_angles_and_quaternions_turn_into_each_other(axes):
    angles = (0.3, -0.7, 1.9)
    assert tf_function.euler_from_quaternion(tf_function.quaternion_from_euler(*angles, axes), axes) == pytest.approx(
        angles
    )
    first = "xyz".index(axes[1])  # the first angle is about the first axis that is named
    about = [math.sqrt(0.5) if axis in (first, 3) else 0.0 for axis in range(4)]
    assert tf_function.quaternion_from_euler(math.pi / 2, 0.0, 0.0, axes) == pytest.approx(about)
    with pytest.raises(ValueError, match="sxyz"):
        tf_function.quaternion_from_euler(*angles, axes="xyz")


def test_no_public_name_of_a_layer_is_without_words():
    for name in Ral._public():
        assert inspect.getdoc(getattr(Ral, name)), name
