"""The control panels, used by mouse and keyboard on a virtual display; what they command is seen on the topics."""

import os
import shutil
import subprocess
import time

import pytest
from harness import SLOWNESS, eventually

from ambf_msgs.msg import RigidBodyCmd


@pytest.fixture(scope="module")
def display():
    """A display: the one there is, or a virtual one."""
    if os.environ.get("DISPLAY"):
        yield
        return
    if shutil.which("Xvfb") is None:
        pytest.skip("no display, no Xvfb")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1100x24", "-nolisten", "tcp", "-noreset"]
    server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as number:
        os.environ["DISPLAY"] = ":" + number.readline().strip()
    yield
    del os.environ["DISPLAY"]
    server.kill()
    server.wait()


class User:
    """Sits at a panel."""

    def __init__(self, window):
        self.window = window

    def wait(self, condition, what="", seconds=10.0):
        """Lets the window live until the condition holds."""

        def look():
            self.window.root.update()
            return condition()

        return eventually(look, seconds, what)

    def rest(self, seconds):
        end = time.monotonic() + seconds * SLOWNESS
        while time.monotonic() < end:
            self.window.root.update()
            time.sleep(0.005)

    def click_slider(self, row, value):
        """Presses the mouse where the slider has that value."""
        slider = row.slider
        slider.event_generate("<Button-1>", x=int(slider.position_of(value)), y=12)
        self.window.root.update()

    def type(self, entry, text):
        entry.focus_force()
        entry.delete(0, "end")
        entry.insert(0, text)
        entry.event_generate("<Return>")
        self.window.root.update()


@pytest.fixture
def panel(display, bench, ros):
    """panel(*names): (window, user)"""
    from ambf_client import Client
    from ambf_tools.cli.simulation import Simulation
    from ambf_tools.panels.window import PanelWindow

    client = Client("panel_test")
    client.connect()
    windows = []

    def make(*names):
        window = PanelWindow(client, Simulation().listing, list(names))
        windows.append(window)
        user = User(window)
        user.rest(0.3)
        return window, user

    yield make
    for window in windows:
        window.close()
    client.clean_up()


def commands_of(ros, name):
    return ros.listen(f"/ambf/env/{name}/Command", RigidBodyCmd)


def test_all_robots_are_shown_with_their_joints_and_limits(panel):
    window, _ = panel()
    assert [group.robot.name for group in window.joints.groups] == ["Base"]
    turn, lift = window.joints.groups[0].rows
    assert (turn.name, lift.name) == ("turn", "lift")
    assert (turn.modes["position"].unit, lift.modes["position"].unit) == ("rad", "m")


def test_joints_of_a_second_copy_are_known_as_those_of_the_first(panel):
    import scenes
    from ambf_tools.cli.simulation import Simulation

    Simulation().services.load(text=scenes.BENCH, pose=[5.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    window, _ = panel("Base1")
    turn, lift = window.joints.groups[0].rows
    assert (turn.modes["position"].unit, lift.modes["position"].unit) == ("rad", "m")


def test_a_click_on_a_slider_commands_that_joint_and_no_other(panel, ros):
    window, user = panel()
    heard = commands_of(ros, "Base")
    row = window.joints.row("turn")
    user.click_slider(row, 0.5)
    message = user.wait(lambda: heard.messages and heard.messages[-1], "a command on the topic")
    assert message.joint_cmds_types[0] == RigidBodyCmd.TYPE_POSITION
    assert message.joint_cmds[0] == pytest.approx(0.5, abs=0.05)
    assert list(message.joint_cmds_types[1:]) in ([], [-1])
    user.wait(lambda: abs(row.measured - message.joint_cmds[0]) < 0.05, "the joint gets there, and is seen to")
    assert "1 commanded" in window.status.cget("text")


def test_numbers_are_typed_and_nonsense_is_not_taken(panel, ros):
    window, user = panel()
    heard = commands_of(ros, "Base")
    row = window.joints.row("lift")
    user.type(row.entry, "0,03")
    user.wait(lambda: heard.messages and heard.messages[-1].joint_cmds[1] == pytest.approx(0.03))
    user.wait(lambda: row.measured == pytest.approx(0.03, abs=0.01))
    for nonsense in ("high", "nan", "inf"):
        user.type(row.entry, nonsense)
        assert row.value == pytest.approx(0.03) and row.entry.get() == "0.030"


def test_limits_of_the_model_are_kept_and_other_ranges_widen(panel):
    from ambf_tools.panels.joints import Robot, modes_of

    position, velocity, _ = modes_of(Robot("r", None, {"a": (-0.5, 0.5)}), "a")
    assert (position.strict, position.lower, position.upper) == (True, -0.5, 0.5) and not velocity.strict
    window, user = panel()
    row = window.joints.row("turn")  # has no limits
    row.command(7.0)
    assert row.value == 7.0 and row.slider.high == 7.0
    row.modes["position"] = position
    row.set_mode("position", notify=False)
    row.command(7.0)
    assert row.value == 0.5


def test_modes_velocity_and_effort(panel, ros):
    window, user = panel()
    heard = commands_of(ros, "Base")
    row = window.joints.row("turn")
    row.mode_box.set("velocity")
    row.mode_box.event_generate("<<ComboboxSelected>>")
    user.click_slider(row, 0.5)
    user.wait(lambda: heard.messages and heard.messages[-1].joint_cmds_types[0] == RigidBodyCmd.TYPE_VELOCITY)
    at = row.measured
    user.wait(lambda: row.measured > at + 0.1, "it turns")
    row.mode_box.set("effort")
    row.mode_box.event_generate("<<ComboboxSelected>>")
    user.wait(lambda: heard.messages[-1].joint_cmds_types[0] == RigidBodyCmd.TYPE_FORCE)
    assert heard.messages[-1].joint_cmds[0] == 0.0, "a new mode begins with nothing"


def test_hold_zero_and_release(panel, ros):
    window, user = panel()
    heard = commands_of(ros, "Base")
    turn = window.joints.row("turn")
    turn.command(0.4)
    user.wait(lambda: turn.measured == pytest.approx(0.4, abs=0.05))
    window.joints.groups[0].hold()
    assert turn.value == pytest.approx(0.4, abs=0.05)
    window.joints.groups[0].zero()
    user.wait(lambda: heard.messages[-1].joint_cmds[0] == 0.0 and len(heard.messages[-1].joint_cmds) == 2)
    user.wait(lambda: abs(turn.measured) < 0.05)
    window.joints.groups[0].release()
    user.wait(lambda: set(heard.messages[-1].joint_cmds_types) <= {-1}, "they are let go")
    assert window.joints.commanded == 0


def test_keys_move_the_slider_that_was_clicked(panel):
    window, user = panel()
    row = window.joints.row("turn")
    user.click_slider(row, 0.0)
    before, span = row.value, row.slider.high - row.slider.low
    row.slider.focus_force()
    for _ in range(5):
        row.slider.event_generate("<Right>")
    user.window.root.update()
    assert row.value == pytest.approx(before + 0.05 * span)


def test_search_hides_the_others(panel):
    window, user = panel()

    def shown():
        return [row.name for group in window.joints.groups for row in group.rows if row.winfo_manager()]

    assert shown() == ["turn", "lift"]
    window.joints.search.focus_force()
    window.joints.search.insert(0, "LI")
    window.joints.search.event_generate("<KeyRelease>")
    user.rest(0.1)
    assert shown() == ["lift"]
    window.joints.search.insert("end", "x")
    window.joints.search.event_generate("<KeyRelease>")
    user.rest(0.1)
    assert shown() == []


def test_plots_follow_what_is_measured_and_commanded(panel):
    window, user = panel()
    row = window.joints.row("turn")
    row.plot_box.invoke()
    row.command(0.3)
    user.wait(lambda: row.curve.measured and row.curve.measured[-1][1] == pytest.approx(0.3, abs=0.05))
    assert row.curve.commanded[-1][1] == pytest.approx(0.3)
    lines = [item for item in window.joints.plot.find_all() if window.joints.plot.type(item) == "line"]
    assert len([item for item in lines if window.joints.plot.itemcget(item, "fill") == row.curve.colour]) >= 2


def test_objects_are_moved_turned_and_pushed(panel, ros):
    window, user = panel()
    heard = commands_of(ros, "Table")
    window.tabs.select(1)
    window.body.choose("/ambf/env/Table")
    user.wait(lambda: window.body.rows[1].measured == pytest.approx(-1.0))
    user.click_slider(window.body.rows[0], 1.0)
    near = pytest.approx(1.0, abs=0.05)
    user.wait(lambda: heard.messages and heard.messages[-1].pose.position.x == near, "the slider's end is commanded")
    message = heard.messages[-1]
    assert message.cartesian_cmd_type == RigidBodyCmd.TYPE_POSITION
    assert message.pose.position.y == pytest.approx(-1.0), "what was not touched stays where it is"
    user.wait(lambda: window.body.rows[0].measured == pytest.approx(heard.messages[-1].pose.position.x))
    heard = commands_of(ros, "Box")
    window.body.choose("/ambf/env/Box")
    user.rest(0.3)
    window.body.rows[2].set_mode("force")
    window.body.rows[2].command(4.0)
    user.wait(lambda: heard.messages and heard.messages[-1].wrench.force.z == pytest.approx(4.0))
    assert heard.messages[-1].cartesian_cmd_type == RigidBodyCmd.TYPE_FORCE
    at = window.body.rows[2].measured
    user.wait(lambda: window.body.rows[2].measured > at + 0.2, "it rises")
    assert heard.messages[-1].wrench.force.z == pytest.approx(4.0), "the push goes on"
    window.body.release()
    user.wait(lambda: heard.messages[-1].wrench.force.z == 0.0)


def test_objects_are_found_by_typing(panel):
    window, user = panel()
    window.tabs.select(1)
    user.rest(0.2)
    choice = window.body.choice
    choice.focus_force()
    choice.insert(0, "pla")
    choice.event_generate("<KeyRelease>")
    user.rest(0.1)
    assert list(choice["values"]) == ["/ambf/env/Plate"]
    choice.event_generate("<Return>")
    user.window.root.update()
    assert window.body.handle.get_name() == "/ambf/env/Plate"


def test_a_camera_has_a_pose_only(panel):
    window, user = panel()
    window.body.choose("/ambf/env/cameras/eye")
    assert list(window.body.rows[0].mode_box["values"]) == ["off", "pose"]
    window.body.hold()
    window.body.rows[2].command(1.5)
    user.wait(lambda: window.body.rows[2].measured == pytest.approx(1.5))


def test_closing_lets_go_of_everything(panel, ros):
    window, user = panel()
    heard = commands_of(ros, "Base")
    window.joints.row("turn").command(0.2)
    user.wait(lambda: heard.messages)
    window.close()
    eventually(lambda: set(heard.messages[-1].joint_cmds_types) <= {-1})
    at = len(heard.messages)
    time.sleep(0.3)
    more = len(heard.messages) - at
    assert more <= 2, "nothing is sent any more"


def test_an_ended_simulator_is_said(panel, bench):
    window, user = panel()
    user.wait(lambda: "connected" in window.status.cget("text"))
    bench.stop()
    user.wait(lambda: "no new step" in window.status.cget("text"), "the status says so", 15)


def test_a_robot_of_39_bodies(display, start, master, compat, ros):
    from ambf_client import Client
    from ambf_tools.cli.simulation import Simulation
    from ambf_tools.panels.window import PanelWindow

    robots = compat / "multi-bodies/robots"
    files = ",".join(str(robots / f"blender-{name}.yaml") for name in ("neuro-robot", "psm", "mtm"))
    start("-a", files, master_uri=master.uri, allowed=[".*"]).wait_loaded(3)
    eventually(lambda: any("mtm" in topic for topic in master.published()), 60)
    with Client("panel_test") as client:
        window = PanelWindow(client, Simulation().listing, [])
        user = User(window)
        user.wait(lambda: len(window.joints.groups) == 3, "all three robots", 20)
        user.rest(1.0)
        assert sum(len(group.rows) for group in window.joints.groups) > 20
        begin = time.process_time()
        user.rest(2.0)
        share = (time.process_time() - begin) / (2.0 * SLOWNESS)
        # All rows in motion, drawn 25 times a second, with a client for three robots: it still answers at once.
        assert share < 0.9
        row = window.joints.row("baselink-yawlink")
        user.click_slider(row, 0.4)
        user.wait(lambda: abs(row.measured - row.value) < 0.1, "it moves", 15)
        window.close()


def test_the_command_line_opens_it(display, bench, master):
    import sys

    from harness import ROOT

    env = dict(os.environ, PYTHONPATH=f"{ROOT}/ambf_client_py:{os.environ.get('PYTHONPATH', '')}")
    command = [sys.executable, "-m", "ambf_tools.cli", "panel", "Base"]
    process = subprocess.Popen(command, env=env, stderr=subprocess.PIPE, text=True)
    try:
        from Xlib import display as x

        def title_is_there():
            assert process.poll() is None, process.stderr.read()
            windows = x.Display().screen().root.query_tree().children
            return any("AMBF control panel" in str(window.get_wm_name()) for window in windows)

        eventually(title_is_there, 20, "the window")
    finally:
        process.kill()
        process.wait()


def test_without_a_display_it_says_so(bench, run_python):
    done = run_python("-m", "ambf_tools.cli", "panel", code=1, DISPLAY="")
    assert "no window can be opened" in done.stderr
