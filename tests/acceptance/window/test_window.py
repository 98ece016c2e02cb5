"""The program's window, as a user at a display sees and uses it."""

import pytest
import worlds
import x11
from program import changes, drawn, still


def test_the_window_shows_a_scene(server, user, start):
    start(server.name)
    user.window()
    drawn(user)
    assert user.title() == "AMBF Simulator Window 1"


def test_q_ends_the_program(server, user, start):
    simulator = start(server.name)
    user.window()
    drawn(user)
    user.key("q")
    assert simulator.ends() == 0


def test_control_p_pauses_and_resumes(server, user, start):
    start(server.name)
    user.window()
    drawn(user)
    user.key("p", "Control_L")
    x11.eventually(lambda: "paused" in user.title(), 20.0, lambda: user.title())
    user.key("p", "Control_L")
    x11.eventually(lambda: "paused" not in user.title(), 20.0, lambda: user.title())


def test_tab_shows_the_panel_and_its_button_pauses(server, user, start, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    start(server.name)
    window = user.window()
    drawn(user)
    place, shape = window.translate_coords(user.root, 0, 0), window.get_geometry()
    left, top = -place.x, -place.y
    edge = left + shape.width - min(400, shape.width // 2)

    def share_of_dark():
        """Of a strip near the panel's lower right corner, where nothing is written."""
        picture, width = user.picture(), x11.SCREEN[0]
        strip = [(x, top + shape.height - 4) for x in range(edge + 20, min(width, left + shape.width) - 20)]
        pixels = [picture[4 * (y * width + x) : 4 * (y * width + x) + 3] for x, y in strip]
        return sum(max(pixel) < 60 for pixel in pixels) / len(pixels)

    assert share_of_dark() < 0.5
    user.point(left + 20, top + 20)
    user.key("Tab")
    x11.eventually(lambda: share_of_dark() > 0.95, 20.0, "the panel over the right of the window")
    user.point(edge + 28, top + 20)
    user.button(1, True)
    user.button(1, False)
    x11.eventually(lambda: "paused" in user.title(), 20.0, lambda: user.title())
    user.key("Tab")
    x11.eventually(lambda: share_of_dark() < 0.5, 20.0, "the panel gone")
    user.key("p", "Control_L")
    x11.eventually(lambda: "paused" not in user.title(), 20.0, "the window's keys again")


@pytest.mark.parametrize("button", [1, 2, 3])
def test_the_mouse_moves_the_view_also_while_paused(server, user, start, button):
    start(server.name)
    user.window()
    drawn(user)
    user.key("p", "Control_L")
    x11.eventually(lambda: "paused" in user.title(), 20.0, lambda: user.title())
    user.key("u")  # labels show the time
    still(user.picture)
    changes(user, lambda: user.drag(button, (400, 300), (460, 330)))


def test_help_is_printed_and_shown(server, user, start):
    simulator = start(server.name)
    user.window()
    drawn(user)
    changes(user, lambda: user.key("h"))
    simulator.says("pause or resume")


def test_dropped_files_are_loaded(server, user, start, tmp_path):
    simulator = start(server.name)
    window = user.window()
    drawn(user)
    names = ["plain.yaml", "with space ümläut.yaml"]
    for name in names:
        (tmp_path / name).write_text(worlds.BOX)
    user.drop(window, [tmp_path / name for name in names])
    for name in names:
        simulator.says(f"loaded '{name}'")
    user.drop(window, [tmp_path / names[0]])  # again
    x11.eventually(lambda: simulator.log().count("loaded 'plain") == 2, 20.0, simulator.log)


def test_what_cannot_be_loaded_gives_a_message_and_no_harm(server, user, start, tmp_path):
    simulator = start(server.name)
    window = user.window()
    drawn(user)
    (tmp_path / "folder.yaml").mkdir()
    (tmp_path / "broken.yaml").write_text("bodies: [BODY a\n  }{")
    (tmp_path / "noise.ambf").write_bytes(bytes(range(256)) * 8)
    (tmp_path / "robot.xacro").write_text("<robot/>")
    names = ["folder.yaml", "broken.yaml", "noise.ambf", "robot.xacro", "gone.yaml"]
    user.drop(window, [tmp_path / name for name in names])
    simulator.says("'folder.yaml' is a folder")
    simulator.says("'robot.xacro' has macros")
    simulator.says("'gone.yaml' cannot be found")
    simulator.says("broken.yaml:")
    simulator.says("noise.ambf")
    assert simulator.process.poll() is None
    user.key("q")
    assert simulator.ends() == 0


def test_findings_of_dropped_files_are_told_once_and_no_launch_file_becomes_a_model(server, user, start, tmp_path):
    simulator = start(server.name)
    window = user.window()
    drawn(user)
    (tmp_path / "doubtful.yaml").write_text(worlds.BOX.replace("mass: 0.1", "masss: 0.1"))
    (tmp_path / "start.yaml").write_text("world config: world.yaml\nmultibody configs: [doubtful.yaml]\n")
    (tmp_path / "place.yaml").write_text("environment: ground.yaml\ncameras: []\n")
    names = ["doubtful.yaml", "start.yaml", "place.yaml"]
    user.drop(window, [tmp_path / name for name in names])
    simulator.says("this is a launch file, no model")
    simulator.says("this is a world file, no model")
    simulator.says("loaded 'doubtful.yaml'")
    user.key("q")
    assert simulator.ends() == 0
    log = simulator.log()
    for finding in ("masss", "this is a launch file", "this is a world file"):
        assert log.count(finding) == 1, log
    assert "(repeated" not in log
    assert "loaded 'start" not in log and "loaded 'place" not in log


def test_the_death_of_the_display_server_ends_it_cleanly(server, user, start):
    simulator = start(server.name)
    user.window()
    drawn(user)
    server.kill()
    assert simulator.ends() == 0
    assert "the display server is gone" in simulator.log()


def test_without_a_display_it_runs_headless_and_says_so(start):
    simulator = start(":987", "--run_for", "1")
    assert simulator.ends(60.0) == 0
    assert "no window: no display" in simulator.log()
    assert "steps per second" in simulator.log()
