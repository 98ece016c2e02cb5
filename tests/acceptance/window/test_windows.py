"""Several windows of one program: one for each visible camera."""

import os
import pathlib
import signal
import time

import pytest
import worlds
import x11
from program import drawn, still

FRONT, SIDE = (1.0, 0.0, ""), (0.1, 1.1, "")

MODEL_WITH_CAMERA = """
adf version: 1.0
namespace: /extra/
bodies: [BODY block]
cameras: [CAMERA third]
BODY block:
  name: block
  shape: Box
  geometry: {x: 0.05, y: 0.05, z: 0.05}
  mass: 0.0
CAMERA third:
  name: third
  parent: BODY block
  location: {x: -1.0, y: 0.2, z: 0.4}
  look at: {x: 0.0, y: 0.0, z: 0.0}
"""


def overlap(a, b):
    return a[0] < b[0] + b[2] and b[0] < a[0] + a[2] and a[1] < b[1] + b[3] and b[1] < a[1] + a[3]


@pytest.fixture
def two(server, user, start, tmp_path):
    """A program with two windows that both show something."""
    simulator = start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT, "two": SIDE}), "-l", "0")
    for number in (1, 2):
        user.window(number)
        drawn(user, number)
    return simulator


def test_every_visible_camera_has_a_window_of_its_own(server, user, start, tmp_path):
    cameras = {"one": FRONT, "two": SIDE, "unseen": (2.0, 2.0, "visible: false")}
    start(server.name, "--launch_file", worlds.write(tmp_path, cameras), "-l", "0")
    for number in (1, 2):
        user.window(number)
        drawn(user, number)
        assert user.title(number) == f"AMBF Simulator Window {number}"
    assert len(user.windows()) == 2
    assert not overlap(user.place(1), user.place(2)), "side by side, not on top of each other"
    for _, _, width, height in (user.place(1), user.place(2)):
        assert width / height == pytest.approx(1.6, abs=0.02)
        assert 2 * height == pytest.approx(0.8 * x11.SCREEN[1], rel=0.15), "one over the other, as large as fits"
    same = user.picture_of(1) == user.picture_of(2)
    assert not same


def test_closing_one_window_leaves_the_other_and_closing_the_last_ends_the_program(two, user):
    user.ask_to_close(user.window(1))
    x11.eventually(lambda: set(user.windows()) == {2}, 10.0, lambda: user.windows())
    before = user.picture_of(2)
    x11.eventually(lambda: user.picture_of(2) != before, 20.0, "window 2 goes on (it shows the time)")
    user.ask_to_close(user.window(2))
    assert two.ends() == 0


def test_q_in_either_window_ends_the_program(two, user):
    user.window(2)
    user.key("q")
    assert two.ends() == 0


def test_a_camera_that_is_loaded_gets_a_window_and_one_that_goes_loses_it(server, user, start, tmp_path, master, ros):
    from ambf_msgs.srv import Load, Unload

    start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT}), "-l", "0", ros=True)
    user.window(1)
    (tmp_path / "extra.yaml").write_text(MODEL_WITH_CAMERA)
    answer = ros.service("/test/World/Load", Load)(path=str(tmp_path / "extra.yaml"))
    assert answer.success, answer.message
    user.window(2)
    drawn(user, 2)
    assert ros.service("/test/World/Unload", Unload)(model=answer.model).success
    x11.eventually(lambda: set(user.windows()) == {1}, 10.0, lambda: user.windows())


def test_the_window_of_a_world_without_cameras_stays_when_cameras_come_and_go(
    server, user, start, tmp_path, master, ros
):
    from ambf_msgs.srv import Load, Unload

    start(
        server.name, "--launch_file", worlds.write(tmp_path, {"one": (1.0, 0.0, "visible: false")}), "-l", "0", ros=True
    )
    user.window(1)
    drawn(user)
    (tmp_path / "extra.yaml").write_text(MODEL_WITH_CAMERA)
    answer = ros.service("/test/World/Load", Load)(path=str(tmp_path / "extra.yaml"))
    assert answer.success, answer.message
    time.sleep(1.0)
    assert set(user.windows()) == {1}, "the one window looks through the new camera"
    assert ros.service("/test/World/Unload", Unload)(model=answer.model).success
    time.sleep(1.0)
    assert set(user.windows()) == {1}
    drawn(user)


def test_the_mouse_moves_the_camera_of_its_own_window_only(two, user):
    user.window(1)
    user.key("u")  # no labels: they show the time
    user.key("p", "Control_L")
    one, two_ = still(lambda: (user.picture_of(1), user.picture_of(2)))
    left, top, width, height = user.place(1)
    middle = (left + width // 2, top + height // 2)
    user.drag(3, middle, (middle[0] + 60, middle[1] + 20))
    x11.eventually(lambda: user.picture_of(1) != one, 20.0, "window 1 looks elsewhere")
    x11.eventually(lambda: user.picture_of(2) == two_, 20.0, "window 2 as it was")


def test_full_screen_is_shared_by_the_windows_of_a_monitor_and_given_back(two, user):
    before = {number: user.place(number) for number in (1, 2)}
    user.window(1)
    user.key("f")
    half = (x11.SCREEN[0] // 2, x11.SCREEN[1])
    x11.eventually(
        lambda: all(user.place(n)[2:] == half for n in (1, 2)), 20.0, lambda: [user.place(n) for n in (1, 2)]
    )
    assert not overlap(user.place(1), user.place(2))
    user.window(1)
    user.key("f")
    x11.eventually(
        lambda: all(user.place(n)[2:] == before[n][2:] for n in (1, 2)), 20.0, lambda: [user.place(n) for n in (1, 2)]
    )


def test_a_lone_window_fills_its_monitor(server, user, start, tmp_path):
    start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT}), "-l", "0")
    user.window()
    drawn(user)
    user.key("f")
    x11.eventually(lambda: user.place(1) == (0, 0, *x11.SCREEN), 20.0, lambda: user.place(1))


def test_a_resized_window_is_drawn_in_its_new_size(two, user):
    window = user.window(1)
    user.resize(window, 300, 200)
    x11.eventually(lambda: user.place(1)[2:] == (300, 200), 10.0, lambda: user.place(1))
    drawn(user, 1)
    user.resize(window, 700, 260)
    drawn(user, 1)
    drawn(user, 2)


def test_a_stereo_camera_shows_two_pictures_side_by_side(server, user, start, tmp_path):
    cameras = {"one": (1.0, 0.0, "stereo: {mode: passive, eye separation: 0.1, focal length: 1.0}")}
    start(server.name, "--launch_file", worlds.write(tmp_path, cameras), "-l", "0")
    user.window()
    drawn(user)
    _, _, width, height = user.place(1)
    picture, row = user.picture_of(1), 4 * width

    def red_columns(left, right):
        """Where the red box is, within a part of the middle rows."""
        found = []
        for x in range(left, right):
            for y in range(height // 4, 3 * height // 4, 4):
                blue, green, red = picture[y * row + 4 * x : y * row + 4 * x + 3]
                if red > 2 * green + 20 and red > 2 * blue + 20:
                    found.append(x - left)
                    break
        return found

    half = width // 2
    left, right = red_columns(0, half), red_columns(width - half, width)
    assert left and right, "the box is seen by both eyes"
    # It stands about as far away as the focal length: nearly in the same place of both, but not quite the same picture.
    assert abs(left[0] - right[0]) < 0.1 * half
    assert picture[: 4 * half] != picture[4 * (width - half) : 4 * width]


def test_controlling_devices_are_in_the_title(server, user, start, tmp_path):
    cameras = {"one": (1.0, 0.0, "controlling devices: [MTML, MTMR]")}
    start(server.name, "--launch_file", worlds.write(tmp_path, cameras), "-l", "0")
    user.window()
    x11.eventually(lambda: user.title() == "AMBF Simulator Window 1 - MTML - MTMR", 20.0, user.title)


def test_files_may_be_dropped_on_either_window(two, user, tmp_path):
    names = ["plain.yaml", "with space.ambf", "ümläut ß.yaml"]
    for name in names:
        (tmp_path / name).write_text(worlds.BOX)
    (tmp_path / "a folder.yaml").mkdir()
    (tmp_path / "broken.yaml").write_text("bodies: [BODY a\n  }{")
    user.drop(user.window(1), [tmp_path / names[0], tmp_path / "a folder.yaml", tmp_path / names[1]])
    user.drop(user.window(2), [tmp_path / "broken.yaml", tmp_path / names[2]])
    for name in names:
        two.says(f"loaded '{name}'")
    two.says("'a folder.yaml' is a folder")
    two.says("broken.yaml:")
    user.drop(user.window(2), [tmp_path / names[2], tmp_path / names[2]])  # again, twice at once
    x11.eventually(lambda: two.log().count(f"loaded '{names[2]}") == 3, 20.0, two.log)
    for number in (1, 2):
        drawn(user, number)


def main_thread_seconds(pid):
    """Processor time of the thread that draws."""
    fields = pathlib.Path(f"/proc/{pid}/task/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def test_minimised_windows_cost_nothing(two, user):
    def cost(seconds=3.0):
        begin = main_thread_seconds(two.process.pid)
        time.sleep(seconds)
        return main_thread_seconds(two.process.pid) - begin

    shown = cost()
    for number in (2, 1):
        user.minimise(user.windows()[number])
    time.sleep(0.5)
    assert cost() < 0.2 * shown


def test_what_the_first_gesture_needs_is_there_without_any_event(server, user, start, tmp_path):
    """Nobody touches anything: both windows draw on by themselves."""
    start(server.name, "--launch_file", worlds.write(tmp_path, {"one": FRONT, "two": SIDE}), "-l", "0")
    for number in (1, 2):
        x11.eventually(lambda n=number: n in user.windows(), 30.0, f"window {number}")
        drawn(user, number)
        before = user.picture_of(number)
        x11.eventually(lambda n=number, b=before: user.picture_of(n) != b, 20.0, "the time goes on")


@pytest.mark.parametrize("flag", [(), ("--keep-running-without-display",)])
def test_the_death_of_the_display_server_ends_it_or_leaves_it_headless(server, user, start, tmp_path, flag):
    launch = worlds.write(tmp_path, {"one": FRONT, "two": SIDE})
    simulator = start(server.name, "--launch_file", launch, "-l", "0", *flag)
    for number in (1, 2):
        user.window(number)
        drawn(user, number)
    server.kill()
    simulator.says("the display server is gone")
    if not flag:
        assert simulator.ends() == 0
        return
    simulator.says("running on without windows")
    time.sleep(1.0)
    assert simulator.process.poll() is None
    simulator.process.send_signal(signal.SIGTERM)
    assert simulator.ends() == 143


def test_a_person_moves_a_gripper_with_keys(server, user, start, master, ros):
    from ambf_msgs.msg import RigidBodyState

    start(server.name, "-l", "1", "-i", "Keyboard", ros=True)
    user.window()
    drawn(user)
    gripper = ros.listen("/ambf/env/right_gripper/State", RigidBodyState)
    still = gripper.last().pose.position
    user.hold("Up", True)
    time.sleep(0.5)
    user.hold("Up", False)
    assert abs(gripper.last().pose.position.z - still.z) < 1e-3, "nothing moves before G"
    user.key("g")
    time.sleep(0.5)
    user.hold("Up", True)
    x11.eventually(lambda: gripper.last().pose.position.z > still.z + 0.02, 20.0, "it goes up")
    user.hold("Up", False)
    open_jaw = gripper.last().joint_positions
    user.key("Return")
    x11.eventually(
        lambda: max(abs(a - b) for a, b in zip(open_jaw, gripper.last().joint_positions, strict=True)) > 0.1,
        20.0,
        lambda: f"its jaw closes: {open_jaw}, {gripper.last().joint_positions}",
    )
    user.key("g")
