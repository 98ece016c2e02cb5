"""Clients survive what happens to simulators and masters, and end when they are told to."""

import os
import signal
import subprocess
import sys
import time

import pytest
import scenes
from harness import Simulator, eventually

FOLLOW = """
import sys, threading, time
from ambf_client import Client

client = Client()
client.on_object_added(lambda name: name.endswith("/Table") and print("added", name))
client.on_object_removed(lambda name: name.endswith("/Table") and print("removed", name))
client.connect()
table = client.wait_for("Table", 20.0)
count = 0

def follow():
    global count
    while True:
        count += 1
        table.set_pos(float(count % 1000), 0.0, 0.0)
        if table.wait_for_next_state(0.5) and count % 20 == 0:
            print("state", table.get_sim_step(), round(table.get_pos().x))
        time.sleep(0.005)

threading.Thread(target=follow, daemon=True).start()
for line in sys.stdin:
    print("names", *client.get_obj_names())
"""


@pytest.fixture
def run(tmp_path, own_master, masters_to_end):
    """A simulator that may be killed."""
    running = []
    launch = scenes.write(tmp_path)

    def make():
        running.append(Simulator(tmp_path, "--launch_file", launch, "-l", "0", master_uri=own_master.uri))
        return running[-1]

    yield make
    for simulator in running:
        if simulator.running():
            simulator.stop()


def more(script, part, seconds=10.0):
    """Waits for another line with that in it."""
    return script.wait_line(part, seconds, len([line for line in script.lines if part in line]) + 1)


def test_a_killed_simulator_is_said_once_and_its_return_too(run, script, own_master):
    first = run()
    client = script(FOLLOW, own_master.uri)
    client.wait_line("state")
    os.kill(first.pid, signal.SIGKILL)
    client.wait_line("simulator is gone")
    client.wait_line("removed /ambf/env/Table")
    assert "/ambf/env/Table/State" in own_master.state()[0]  # the master does not know yet: a ghost
    client.type("names")
    assert client.wait_line("names") == "names"
    time.sleep(1.0)
    run()
    client.wait_line("simulator is back", 20.0)
    client.wait_line("added /ambf/env/Table", count=2)
    more(client, "state")  # states again, and commands obeyed: it follows
    eventually(lambda: len({line.split()[2] for line in client.lines[-8:] if line.startswith("state")}) > 1)
    assert client.text().count("simulator is gone") == 1
    assert client.text().count("simulator is back") == 1
    assert "Traceback" not in client.text()


def test_ghosts_of_a_dead_simulator_are_no_objects(run, script, own_master):
    os.kill(run_up(run, own_master).pid, signal.SIGKILL)
    text = """
from ambf_client import Client
client = Client()
client.connect()
print("names", client.get_obj_names(), client.get_obj_handle("Box"), client.get_world_handle())
"""
    client = script(text, own_master.uri)
    assert client.finish() == 0, client.text()
    assert "names [] None None" in client.text()
    assert "there is no simulator" in client.text()


def run_up(run, master):
    simulator = run()
    eventually(lambda: "/ambf/env/World/Step" in master.state()[2], 20.0)
    return simulator


def test_a_killed_master_is_survived_and_a_new_one_told_of_us(run, script, own_master):
    simulator = run_up(run, own_master)
    client = script(FOLLOW, own_master.uri)
    client.wait_line("state")
    own_master.kill()
    client.wait_line("master does not answer")
    more(client, "state")  # what is connected goes on
    time.sleep(1.0)
    own_master.start()
    client.wait_line("master is back")
    # Known again, so that simulators and others find us: also one that starts now.
    me = "/ambf_client"
    for index, topic in ((0, "/ambf/env/Table/Command"), (1, "/ambf/env/Table/State")):
        eventually(lambda i=index, t=topic: any(n.startswith(me) for n in own_master.state()[i].get(t, ())), 10.0)
    simulator.stop()
    client.wait_line("simulator is gone")
    run()
    client.wait_line("simulator is back", 20.0)
    more(client, "state")
    assert client.text().count("does not answer") == 1


def test_a_client_waits_for_a_master_that_comes_late(run, script, own_master):
    own_master.kill()
    client = script(FOLLOW, own_master.uri)
    client.wait_line("waiting for a ROS master")
    time.sleep(0.5)
    own_master.start()
    run()
    client.wait_line("state", 30.0)


def a_second():
    """Longer on a busy machine, where the mere start and end of a process take their time (0.3 s on a calm one)."""
    begin = time.monotonic()
    subprocess.run([sys.executable, "-c", "import rospy"], check=True)
    return 1.0 + 4.0 * (time.monotonic() - begin)


LOOPS = {
    "asks rospy": "while not rospy.is_shutdown():\n    time.sleep(0.01)\nprint('after the loop')",
    "sleeps": "time.sleep(1000)",
    "for ever": "while True:\n    table.set_pos(1.0, 0.0, 0.0)",
    "waits for a state": "while True:\n    table.wait_for_next_state(1000.0)",
    "steps": "while True:\n    client.world.step(1)",
    "a long step": "client.world.step(10_000_000)",
    "rate": "rate = rospy.Rate(50)\nwhile True:\n    rate.sleep()",
    "spin": "rospy.spin()",
    "waits for an object": "client.wait_for('Fox', 1000.0)",
}


@pytest.mark.parametrize("name, own_node", [*((name, False) for name in LOOPS), ("sleeps", True), ("asks rospy", True)])
def test_ctrl_c_ends_everything_within_a_second(run, script, own_master, name, own_node):
    run_up(run, own_master)
    text = f"""
import rospy, time
from ambf_client import Client
if {own_node}:
    rospy.init_node("mine")
client = Client()
client.connect()
table = client.wait_for("Table", 20.0)
print("ready")
{LOOPS[name]}
"""
    client = script(text, own_master.uri)
    client.wait_line("ready")
    time.sleep(0.5)
    assert client.interrupt() < a_second(), client.text()
    assert ("after the loop" in client.text()) == (name == "asks rospy")


def test_ctrl_c_while_waiting_for_a_master_ends_it(script, own_master):
    own_master.kill()
    client = script("from ambf_client import Client\nClient().connect()\n", own_master.uri)
    client.wait_line("waiting for a ROS master")
    assert client.interrupt() < a_second()


def test_a_simulator_that_dies_in_a_step_is_an_error_and_the_next_is_stepped(run, script, own_master):
    simulator = run_up(run, own_master)
    text = """
from ambf_client import Client, SimulatorUnavailable
client = Client()
client.connect()
world, box = client.world, client.wait_for("Box")
print("first", world.step(5).sim_step)
try:
    world.step(1_000_000_000)
except SimulatorUnavailable as error:
    print("lost:", error)
input()
client.wait_for("Box", 20.0)
begin = world.step(0).sim_step
print("again", world.step(5).sim_step - begin, box.get_sim_step() - begin)
"""
    client = script(text, own_master.uri)
    client.wait_line("first")
    time.sleep(0.5)
    os.kill(simulator.pid, signal.SIGKILL)
    client.wait_line("lost:")
    run_up(run, own_master)
    client.type("go on")
    client.wait_line("again 5 5")
    assert client.finish() == 0, client.text()


def test_scripts_end_by_themselves_without_clean_up(run, script, own_master):
    run_up(run, own_master)
    text = "from ambf_client import Client\nc = Client()\nc.connect()\nc.wait_for('Box', 20.0).set_force(1, 0, 0)\n"
    client = script(text, own_master.uri)
    assert client.finish(20.0) == 0, client.text()
    assert "Traceback" not in client.text()


@pytest.mark.parametrize("how", ["ends", "is interrupted", "is interrupted in a step", "in one without end"])
def test_a_world_does_not_wait_for_a_script_that_ended(run, script, own_master, how):
    run_up(run, own_master)
    rest = {"ends": "", "is interrupted": "time.sleep(1000)", "is interrupted in a step": "client.world.step(3000)"}
    rest["in one without end"] = "client.world.step(4_000_000_000)"
    text = f"""
import time
from ambf_client import Client
client = Client()
client.connect()
client.wait_for("Box", 20.0)
client.world.step(5)
print("stepped")
{rest[how]}
"""
    first = script(text, own_master.uri)
    first.wait_line("stepped")
    if how != "ends":
        time.sleep(0.3)
        first.interrupt()
    first.finish()
    text = """
from ambf_client import Client
with Client() as client:
    world = client.world
    print("goes on", world.wait_for_sim_step(world.get_sim_step() + 100, 10.0), world.step(3).sim_step > 0)
"""
    second = script(text, own_master.uri)
    assert second.finish() == 0, second.text()
    assert "goes on True True" in second.text()


def test_ctrl_c_is_a_keyboard_interrupt_at_any_moment_and_the_world_goes_on(run, script, own_master):
    """Also while it connects, and between two steps."""
    run_up(run, own_master)
    text = """
print("starts")
from ambf_client import Client
client = Client()
client.connect()
box = client.wait_for("Box", 20.0)
print("steps")
for n in range(1_000_000):
    box.set_force(0.1, 0.0, 0.0)
    client.world.step(1)
"""
    for moment in range(8):
        client = script(text, own_master.uri)
        client.wait_line("starts" if moment % 2 else "steps")
        time.sleep(0.07 * moment if moment % 2 else 0.017 * moment)
        assert client.interrupt() < a_second(), client.text()
        client.finish()
        last = [line for line in client.lines if not line.startswith("[ambf_client]")][-1]  # a watchdog may follow
        assert last == "KeyboardInterrupt", (moment, client.text())
    text = """
from ambf_client import Client
with Client() as client:
    world = client.world
    print("goes on", world.wait_for_sim_step(world.get_sim_step() + 100, 10.0))
"""
    last = script(text, own_master.uri)
    assert last.finish() == 0 and "goes on True" in last.text(), last.text()


def test_ctrl_c_during_imports_arrives_after_them(script, own_master):
    """C extensions would make an ImportError of it."""
    text = """
import builtins, os, signal, sys
import_module = builtins.__import__
def interrupted(name, *rest):
    if name == "numpy":
        os.kill(os.getpid(), signal.SIGINT)
    return import_module(name, *rest)
builtins.__import__ = interrupted
try:
    import ambf_client
except KeyboardInterrupt:
    print("all modules:", "ambf_client.world" in sys.modules)
"""
    client = script(text, own_master.uri)
    assert client.finish() == 0, client.text()
    assert "all modules: True" in client.text()
    assert "Traceback" not in client.text()
