"""The panel's topics: the real program, ROS and ambf-cli; a user with mouse and keyboard."""

import os
import signal
import time
from pathlib import Path

import scenes
import x11
from program import drawn

TAB = 6  # Topics
THROTTLED = 2  # a mode of WorldRates
BOX = "/ambf/env/Box"
# Texts in a window as large as the screen, from the panel's left edge and the top.
EDITOR, REQUEST = (150, 415), (150, 400)
KEYS = {
    ":": ("semicolon", "Shift_L"),
    "{": ("bracketleft", "Shift_L"),
    "}": ("bracketright", "Shift_L"),
    " ": ("space",),
}


def opened(server, user, start, tmp_path, monkeypatch, topic):
    """A window with the panel open at its topics, that one chosen."""
    settings = tmp_path / "config/ambf/panel.conf"
    settings.parent.mkdir(parents=True)
    settings.write_text(f"tab {TAB}\ntopic {topic}\n")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    simulator = start(server.name, "--launch_file", scenes.write(tmp_path), "-l", "0", ros=True)
    window = user.window(1)
    window.configure(x=0, y=0, width=x11.SCREEN[0], height=x11.SCREEN[1])
    user.display.sync()
    drawn(user)
    user.key("Tab")
    return simulator


def helper_of(simulator):
    """The process id of its `ambf-cli serve`; 0: there is none."""
    for entry in Path("/proc").iterdir():
        try:
            command = (entry / "cmdline").read_bytes().split(b"\0")
            parent = int((entry / "stat").read_text().rpartition(") ")[2].split()[1])
        except (OSError, ValueError, IndexError):
            continue
        if parent == simulator.process.pid and b"serve" in command and any(b"ambf-cli" in word for word in command):
            return int(entry.name)
    return 0


def listens(master, topic):
    listeners = dict(map(tuple, master._ask("getSystemState")[1]))
    return any("ambf_topics" in node for node in listeners.get(topic, ()))


def click(user, place):
    user.point(x11.SCREEN[0] - 400 + place[0], place[1])
    user.button(1, True)
    user.button(1, False)
    time.sleep(0.5)  # keys are the panel's once a picture has shown where they go


def write(user, text):
    for character in text:
        user.key(*KEYS.get(character, (character,)))


def test_a_killed_helper_is_started_again_and_watches_on(server, user, start, tmp_path, master, ros, monkeypatch):
    simulator = opened(server, user, start, tmp_path, monkeypatch, BOX + "/State")
    x11.eventually(lambda: listens(master, BOX + "/State"), 30.0, "the chosen topic is listened to")
    first = helper_of(simulator)
    assert first
    os.kill(first, signal.SIGKILL)
    simulator.says("topics in the panel: ambf-cli was ended by signal 9; it is started again")
    x11.eventually(lambda: helper_of(simulator) not in (0, first), 30.0, "another one")
    x11.eventually(lambda: listens(master, BOX + "/State"), 30.0, "it listens again")
    second = helper_of(simulator)
    simulator.process.terminate()
    assert simulator.ends(30.0) == 143
    x11.eventually(lambda: not Path(f"/proc/{second}").exists(), 10.0, "it ends with the simulator")
    assert f"ambf_topics_{second}_" not in str(master._ask("getSystemState")), "and says so to the master"


def test_a_message_that_is_written_moves_a_body(server, user, start, tmp_path, master, ros, monkeypatch):
    from ambf_msgs.msg import RigidBodyState

    states = ros.listen(BOX + "/State", RigidBodyState)
    opened(server, user, start, tmp_path, monkeypatch, BOX + "/Command")
    before = states.last(30.0).pose.position.z
    x11.eventually(lambda: listens(master, BOX + "/Command"), 30.0, "the chosen topic is listened to")

    def sent():
        click(user, EDITOR)
        user.key("a", "Control_L")
        write(user, "wrench: {force: {z: 900}}")
        user.key("Return", "Control_L")
        time.sleep(2.0)
        return states.last().pose.position.z > before + 0.01

    x11.eventually(sent, 40.0, "the box is pushed up")


def test_a_service_that_is_called_answers(server, user, start, tmp_path, master, ros, monkeypatch):
    from ambf_msgs.msg import WorldRates

    rates = ros.listen("/ambf/env/World/Rates", WorldRates)
    opened(server, user, start, tmp_path, monkeypatch, "/ambf/env/World/Step")
    assert rates.last(30.0).mode != THROTTLED
    x11.eventually(lambda: any("ambf_topics" in str(each) for each in master._ask("getSystemState")), 30.0, "a helper")

    def called():
        click(user, REQUEST)
        user.key("Return", "Control_L")
        time.sleep(2.0)
        return rates.last().mode == THROTTLED

    x11.eventually(called, 40.0, "the world waits after its steps")
