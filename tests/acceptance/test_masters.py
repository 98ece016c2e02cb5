"""Masters that are not there, die, come back, or are shared by two simulators."""

import os
import signal
import socket
import time
import urllib.parse
import xmlrpc.client

import pytest
import scenes
from harness import WORLD_NAMES, Client, Master, eventually

# Listens to one topic and writes how many messages came, until it is killed.
LISTENER = """
import sys, time, rospy
from ambf_msgs.msg import RigidBodyState
rospy.init_node("listener", anonymous=True, disable_signals=True, disable_rosout=True)
count = 0
def on(message):
    global count
    count += 1
    print(count, flush=True)
rospy.Subscriber("/ambf/env/Box/State", RigidBodyState, on)
time.sleep(1000)
"""

# Sends commands to a body until it is killed.
TALKER = """
import sys, time, rospy
from ambf_msgs.msg import RigidBodyCmd
rospy.init_node("talker", anonymous=True, disable_signals=True, disable_rosout=True)
talk = rospy.Publisher("/ambf/env/Table/Command", RigidBodyCmd, queue_size=10)
message = RigidBodyCmd(cartesian_cmd_type=1)
message.pose.position.x = float(sys.argv[1])
message.pose.orientation.w = 1.0
while True:
    talk.publish(message)
    time.sleep(0.02)
"""

# Prints where a body is, once.
WHERE = """
import rospy
from ambf_msgs.msg import RigidBodyState
rospy.init_node("where", anonymous=True, disable_signals=True, disable_rosout=True)
print(rospy.wait_for_message("/ambf/env/Table/State", RigidBodyState, 20).pose.position.x)
"""


def listening(port):
    return Master(port, running=False).answers()


def bench_names(namespace=""):
    """What the bench scene registers."""
    prefix = f"{namespace}/ambf/env"
    objects = ["Box", "Table", "Base", "Plate", "Slide", "cameras/eye", "lights/sun"]
    return {f"{prefix}/{name}/{end}" for name in objects for end in ("State", "Command")}


def own_connections(master):
    """To how many publishers the simulator holds, or tries to get, a connection."""
    (node,) = master.state()[0]["/ambf/env/World/State"]
    simulator = xmlrpc.client.ServerProxy(master._ask("lookupNode", node))
    return sum(connection[2] == "i" for connection in simulator.getBusInfo("/test")[2])


def test_a_master_is_started_where_none_is_and_stopped_at_the_end(tmp_path, start):
    master = Master(running=False)
    simulator = start("--launch_file", scenes.write(tmp_path), "-l", "0", master_uri=master.uri)
    eventually(lambda: bench_names() <= master.names(), 20.0, "topics at a master of its own")
    assert f"no master at {master.uri}" in simulator.log()
    code, _ = simulator.stop()
    assert code == 0
    assert not listening(master.port)


def test_its_master_ends_also_when_the_simulator_is_killed(tmp_path, start):
    master = Master(running=False)
    simulator = start("--launch_file", scenes.write(tmp_path), "-l", "0", master_uri=master.uri)
    eventually(lambda: bench_names() <= master.names(), 20.0, "topics at a master of its own")
    simulator.stop(signal.SIGKILL)
    eventually(lambda: not listening(master.port), 5.0, "the master is gone, too")


def test_its_master_is_replaced_when_it_dies(tmp_path, start):
    master = Master(running=False)
    simulator = start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0"), master_uri=master.uri, allowed=["does not answer"]
    )
    eventually(lambda: bench_names() <= master.names(), 20.0, "topics at a master of its own")
    os.kill(master._ask("getPid"), signal.SIGKILL)
    simulator.wait_log("does not answer")
    eventually(lambda: bench_names() <= master.names(), 10.0, "topics at another one")


def test_without_a_master_elsewhere_it_goes_on_and_joins_later(tmp_path, start, masters_to_end):
    # An address of this machine that does not look like it, so that no master is started.
    master = Master(running=False)
    masters_to_end.append(master)
    uri = f"http://127.0.0.2:{master.port}"
    simulator = start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0"), master_uri=uri, allowed=["Going on without topics"]
    )
    simulator.wait_log("Going on without topics")
    assert simulator.running() and not listening(master.port)
    master.start()
    eventually(lambda: bench_names() <= master.names(), 10.0, "topics once a master is there")
    simulator.wait_log("joined the master")


def test_no_ros_never_looks_for_a_master(tmp_path, start, own_master):
    simulator = start("--launch_file", scenes.write(tmp_path), "-l", "0", "--no_ros", master_uri=own_master.uri)
    simulator.wait_loaded()
    time.sleep(0.5)
    assert not own_master.state()[0]
    assert "ROS" not in simulator.log()
    assert simulator.stop()[0] == 0


def test_all_is_back_when_a_killed_master_returns(tmp_path, start, own_master):
    count = 100
    text = scenes.cubes(count).replace("Cube000", "Box").replace("Cube001", "Table").replace("mass: 1.0", "mass: 0.0")
    simulator = start(
        *("--launch_file", scenes.write(tmp_path, text), "-l", "0"),
        master_uri=own_master.uri,
        allowed=["does not answer", "WatchDog"],
    )
    all_names = 2 * (count + 2) + WORLD_NAMES
    eventually(lambda: len(own_master.names()) == all_names, 20.0, "all is registered")
    before = own_master.names()
    listener = Client(LISTENER, own_master.uri)
    try:
        eventually(lambda: len(listener.lines()) > 10, 20.0, "states flow")
        own_master.kill()
        simulator.wait_log("does not answer")
        # Connections go on without it.
        at = len(listener.lines())
        eventually(lambda: len(listener.lines()) > at + 35, 20.0, "states go on")
        own_master.start()
        begin = time.monotonic()
        eventually(lambda: own_master.names() == before, 10.0, "all is back")
        assert time.monotonic() - begin < 2.0 * (8 if os.environ.get("AMBF_SANITIZER") else 1)
        at = len(listener.lines())
        eventually(lambda: len(listener.lines()) > at + 10, 5.0, "and states still flow")
        # Newcomers are heard.
        talker = Client(TALKER, own_master.uri, 0.75)
        where = Client(WHERE, own_master.uri)
        eventually(lambda: float(Client(WHERE, own_master.uri).result()) == 0.75, 10.0, "a new client commands")
        talker.kill()
        where.kill()
    finally:
        listener.kill()
    assert simulator.stop()[0] == 0


def test_a_client_that_came_back_before_the_simulator_is_heard(tmp_path, start, own_master):
    """The new master knows the client already when the simulator registers."""
    simulator = start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0"),
        master_uri=own_master.uri,
        allowed=["does not answer", "WatchDog"],
    )
    eventually(lambda: bench_names() <= own_master.names(), 20.0, "topics")
    os.kill(simulator.pid, signal.SIGSTOP)  # it must not be first
    own_master.kill()
    own_master.start()
    talker = Client(TALKER, own_master.uri, 0.5)
    try:
        eventually(lambda: "/ambf/env/Table/Command" in own_master.state()[0], 20.0, "the client is registered")
        os.kill(simulator.pid, signal.SIGCONT)
        eventually(lambda: float(Client(WHERE, own_master.uri).result()) == 0.5, 20.0, "its commands arrive")
        assert own_connections(own_master) == 1
    finally:
        os.kill(simulator.pid, signal.SIGCONT)
        talker.kill()
    # It is still registered: roscpp alone would try to reach it for as long as the simulator runs.
    assert own_master.state()[0]["/ambf/env/Table/Command"]
    eventually(lambda: own_connections(own_master) == 0, 30.0, "the killed client is forgotten")


def test_two_simulators_do_not_share_a_world(tmp_path, start, own_master):
    launch = scenes.write(tmp_path)
    first = start("--launch_file", launch, "-l", "0", master_uri=own_master.uri)
    eventually(lambda: bench_names() <= own_master.names(), 20.0, "the first one's topics")
    second = start("--launch_file", launch, "-l", "0", master_uri=own_master.uri, allowed=["--ns NAME"])
    second.wait_log("already serves /ambf/env/World")
    time.sleep(0.5)
    publishers = own_master.state()[0]
    assert all(str(second.pid) not in node for nodes in publishers.values() for node in nodes)
    # Beside it with a prefix of its own.
    third = start("--launch_file", launch, "-l", "0", "--ns", "/second", master_uri=own_master.uri)
    eventually(lambda: bench_names("/second") <= own_master.names(), 20.0, "the third one's topics")
    assert third.running()
    # When the first one ends, the second one takes its place.
    first.stop()
    eventually(
        lambda: any(str(second.pid) in node for node in own_master.state()[0].get("/ambf/env/Box/State", ())),
        10.0,
        "the second one serves the world",
    )
    second.wait_log("is free now")


@pytest.mark.parametrize("with_signal", [signal.SIGINT, signal.SIGKILL])
def test_the_second_takes_over_when_the_first_ends_with_its_master(tmp_path, start, with_signal):
    launch = scenes.write(tmp_path)
    master = Master(running=False)
    first = start("--launch_file", launch, "-l", "0", master_uri=master.uri)
    eventually(lambda: bench_names() <= master.names(), 20.0, "the first one's topics")
    # roscpp reports each name that it cannot register while the master ends.
    expected = ["--ns NAME", "does not answer", "contact master", "connect to the master", "couldn't register"]
    second = start("--launch_file", launch, "-l", "0", master_uri=master.uri, allowed=expected)
    second.wait_log("already serves /ambf/env/World")
    first.stop(with_signal)
    eventually(
        lambda: (
            bench_names() <= master.names()
            and all(str(second.pid) in node for node in master.state()[0].get("/ambf/env/Box/State", ()))
        ),
        10.0,
        "the second one serves the world, at a master of its own",
    )
    assert second.stop()[0] == 0
    assert not listening(master.port)


def test_two_that_start_at_once_do_not_share_a_world_either(tmp_path, start, own_master):
    launch = scenes.write(tmp_path)
    both = [start("--launch_file", launch, "-l", "0", master_uri=own_master.uri, allowed=["--ns NAME"]) for _ in "12"]
    eventually(lambda: bench_names() <= own_master.names(), 20.0, "one of them serves the world")
    time.sleep(1.5)
    owners = {node for name in bench_names() for part in own_master.state() for node in part.get(name, ())}
    assert len(owners) == 1
    # Who serves in the end may have met the other's attempt before, and have said so.
    assert any("already serves" in simulator.log() for simulator in both)


def test_what_a_killed_simulator_left_behind_is_cleared_away(tmp_path, start, own_master):
    launch = scenes.write(tmp_path)
    dead = start("--launch_file", launch, "-l", "0", master_uri=own_master.uri)
    eventually(lambda: bench_names() <= own_master.names(), 20.0, "topics")
    dead.stop(signal.SIGKILL)
    assert bench_names() <= own_master.names()  # ghosts
    alive = start("--launch_file", launch, "-l", "0", master_uri=own_master.uri)
    eventually(
        lambda: any(str(alive.pid) in node for node in own_master.state()[0].get("/ambf/env/Slide/State", ())), 20.0
    )
    nodes = {node for part in own_master.state() for owners in part.values() for node in owners}
    assert not any(str(dead.pid) in node for node in nodes)


def test_many_may_ask_for_topics_at_once(tmp_path, start, own_master):
    """With roscpp's five places a recorder of all topics missed the first second of some."""
    simulator = start("--launch_file", scenes.write(tmp_path), "-l", "0", master_uri=own_master.uri)
    eventually(lambda: bench_names() <= own_master.names(), 20.0, "topics")
    with xmlrpc.client.ServerProxy(own_master.uri) as master:
        node = next(iter(own_master.state()[0]["/ambf/env/Box/State"]))
        address = urllib.parse.urlparse(master.lookupNode("/test", node)[2])
    os.kill(simulator.pid, signal.SIGSTOP)  # lets nobody in: all wait
    waiting = []
    try:
        for _ in range(40):
            waiting.append(socket.create_connection((address.hostname, address.port), timeout=0.5))
    finally:
        os.kill(simulator.pid, signal.SIGCONT)
        for each in waiting:
            each.close()
