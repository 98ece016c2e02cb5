"""Programs in the manner of AMBF 3.0's suturing suites, one for each way of using it, at our scene on one simulator."""

import os
import re
import sys

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped
from harness import ROOT, Simulator, eventually
from sensor_msgs.msg import JointState, Joy

from ambf_msgs.msg import RigidBodyState

PROGRAMS = ROOT / "tests/client/suture"
LAUNCH = ROOT / "ambf_models/suturing/launch.yaml"
FLAGS = ("-p", "200", "-t1", "--override_max_comm_freq", "100", "--override_min_comm_freq", "100")


@pytest.fixture(scope="module")
def scene(master, tmp_path_factory):
    """The URI of the master of a running scene."""
    master.forget_dead()
    folder = tmp_path_factory.mktemp("suture")
    simulator = Simulator(folder, "--launch_file", LAUNCH, "-l", "0,1,2,3,4,5", *FLAGS, master_uri=master.uri)
    simulator.wait_loaded(6)
    yield master.uri
    simulator.stop()
    simulator.close()
    eventually(lambda: not master.names(), 5.0, "no topics are left behind")


@pytest.fixture
def program(script, scene):
    """program(name, *arguments): one of suture/, running in its folder, as suites are."""

    def run(name, *arguments):
        start = f"import runpy, sys\nsys.path.insert(0, {str(PROGRAMS)!r})\nsys.argv = {[name, *arguments]!r}\n"
        start += f"runpy.run_path({str(PROGRAMS / name)!r}, run_name='__main__')\n"
        return script(start, scene, environment={"PYTHONPATH": os.pathsep.join(sys.path)})

    return run


@pytest.mark.parametrize("name", ["arm_without_tool_id.py", "endoscope.py", "gui_control.py", "method_api.py"])
def test_programs_of_methods(program, name):
    made = program(name)
    assert made.finish(300.0) == 0, made.text()
    assert made.lines[-1] == "done", made.text()


def test_programs_of_crtk_topics(program):
    launcher = program("crtk_launcher.py", "--rate", "120")
    launcher.wait_line("serving", 60.0)
    user = program("crtk_user.py")
    assert user.finish(400.0) == 0, user.text() + launcher.text()
    assert user.lines[-1] == "done", user.text()
    launcher.interrupt()
    assert "Traceback" not in launcher.text() or "KeyboardInterrupt" in launcher.text(), launcher.text()


def test_a_master_moves_an_arm(program, ros):
    served = program("masters.py")
    served.wait_line("serving", 60.0)
    state = ros.listen("/ambf/env/psm1/toolyawlink/State", RigidBodyState)
    base = ros.listen("/ambf/env/psm1/baselink/State", RigidBodyState)
    hand = ros.talk("/MTMR/measured_cp", PoseStamped)
    jaw = ros.talk("/MTMR/gripper/measured_js", JointState)
    pedal = ros.talk("/footpedals/clutch", Joy)

    def place():
        position = state.last().pose.position
        return np.array((position.x, position.y, position.z))

    def hold(z):
        message = PoseStamped()
        message.pose.position.z = z
        hand.publish(message)

    begin = place()
    pedal.publish(Joy(buttons=[0]))
    jaw.publish(JointState(position=[0.2]))
    for i in range(41):
        hold(0.01 * i / 40)
        pedal.publish(Joy(buttons=[0]))
        state.next(lambda _: True)
    eventually(lambda: np.linalg.norm(place() - begin) > 0.008, 20.0, "the tip follows the hand")
    assert np.linalg.norm(place() - begin) < 0.012
    eventually(lambda: abs(base.last().joint_positions[6] - 0.2) < 0.02, 20.0, "so does the jaw")
    served.interrupt()


def test_the_evaluators_main_reports_what_happens(program, script, scene, ros):
    example = ROOT / "ambf_client_py/examples/suturing_evaluation.py"
    text = "import runpy, sys\nsys.argv = ['x', '--seconds', '10']\n"
    text += f"runpy.run_path({str(example)!r}, run_name='__main__')\n"
    watcher = script(text, scene, environment={"PYTHONPATH": os.pathsep.join(sys.path)})
    watcher.wait_line("watching 8 holes", 30.0)
    mover = program("through_a_hole.py")
    assert mover.finish(60.0) == 0, mover.text()
    assert watcher.finish(60.0) == 0, watcher.text()
    assert any(re.match(r"[\d.]+ s: into Entry2, [\d.]+ mm aside", line) for line in watcher.lines), watcher.text()
    assert any(re.match(r"Entry2: [\d.]+ mm deep", line) for line in watcher.lines), watcher.text()
