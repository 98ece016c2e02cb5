"""A recording that is begun and ended in the window: the real program, ROS and ambf-cli."""

import worlds
import x11
from program import drawn


def recorded_by(user, simulator):
    user.key("b", "Control_L", "Shift_L")
    simulator.says("recording into ")


def bag_in(folder):
    bags = [path for path in folder.iterdir() if ".bag" in path.name]
    assert len(bags) == 1, bags
    return bags[0]


def begun(server, user, start, tmp_path, monkeypatch):
    """A window whose user keeps pictures and bags in a folder of the test."""
    folder = tmp_path / "kept here"
    folder.mkdir()
    settings = tmp_path / "config/ambf/panel.conf"
    settings.parent.mkdir(parents=True)
    settings.write_text(f"pictures {folder}\n")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    launch = worlds.write(tmp_path, {"one": (1.0, 0.0, "")})
    simulator = start(server.name, "--launch_file", launch, "-l", "0", ros=True)
    user.window(1)
    drawn(user)
    return simulator, folder


def test_a_key_begins_a_bag_and_ends_it(server, user, start, tmp_path, master, ros, monkeypatch):
    from ambf_tools import read_bag

    simulator, folder = begun(server, user, start, tmp_path, monkeypatch)
    recorded_by(user, simulator)
    user.key("b", "Control_L", "Shift_L")
    simulator.says("recorded: ")
    assert ", 0 lost" in simulator.log()
    with read_bag.open(str(bag_in(folder))) as bag:
        assert bag.topics["/test/World/State"].messages > 0


def test_the_end_of_the_program_completes_the_bag(server, user, start, tmp_path, master, ros, monkeypatch):
    simulator, folder = begun(server, user, start, tmp_path, monkeypatch)
    recorded_by(user, simulator)
    simulator.process.terminate()
    simulator.ends(60.0)
    assert "recorded: " in simulator.log()
    assert bag_in(folder).suffix == ".bag"


def test_a_program_that_is_killed_leaves_a_complete_bag(server, user, start, tmp_path, master, ros, monkeypatch):
    simulator, folder = begun(server, user, start, tmp_path, monkeypatch)
    recorded_by(user, simulator)
    simulator.process.kill()
    simulator.process.wait()
    x11.eventually(lambda: bag_in(folder).suffix == ".bag", 60.0, "a complete bag")
