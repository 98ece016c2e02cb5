"""Parameters of cameras and lights on ROS's parameter server: two-way, while the simulation runs."""

import pytest
from harness import eventually
from std_msgs.msg import Empty

from ambf_msgs.msg import CameraCmd, CameraState, LightState
from ambf_msgs.srv import Load, Unload

EYE, SUN = "/ambf/env/cameras/eye", "/ambf/env/lights/sun"
CAMERA_DEFAULTS = {
    "orthographic_view_width": 0.0,
    "stereo_eye_separation": 0.2,
    "stereo_focal_length": 0.5,
    "parent_name": "",
    "projection": "PERSPECTIVE",
    "mode": "MONO",
}

MODEL = """
adf version: 1.0
namespace: /extra/
bodies: [BODY tool]
cameras: [CAMERA scope]
BODY tool:
  name: tool
  shape: Box
  geometry: {x: 0.05, y: 0.05, z: 0.05}
  mass: 0.0
  location: {position: {x: 3.0, y: 0.0, z: 1.0}}
CAMERA scope:
  name: scope
  parent: BODY tool
  location: {x: 0.0, y: 0.0, z: 0.2}
  look at: {x: 1.0, y: 0.0, z: 0.0}
  clipping plane: {near: 0.05, far: 7.0}
"""


def _complete(found):
    """They are set one by one."""
    sun = {"type", "cutoff_angle", "parent_name"}
    return found.get(EYE, {}).keys() >= CAMERA_DEFAULTS.keys() and found.get(SUN, {}).keys() >= sun


@pytest.fixture
def parameters(bench, ros):
    """get(name) and set(name, value), once those of the bench are there."""

    class Parameters:
        @staticmethod
        def get(name, default=None):
            return ros.rospy.get_param(name, default)

        @staticmethod
        def set(name, value):
            ros.rospy.set_param(name, value)

        def becomes(self, name, value, seconds=10.0):
            def there():
                now = self.get(name)
                return now == value or (isinstance(value, float) and now == pytest.approx(value))

            eventually(there, seconds, f"{name} becomes {value!r}", 0.05)

    found = Parameters()
    eventually(lambda: _complete(found), 10.0, "parameters", 0.05)
    return found


def test_they_show_what_the_files_say(parameters):
    eye = parameters.get(EYE)
    for name, value in CAMERA_DEFAULTS.items():
        assert eye[name] == value, name
    assert 0.0 < eye["near_plane"] < eye["far_plane"]
    assert 0.0 < eye["field_view_angle"] < 3.2
    sun = parameters.get(SUN)
    assert sun["type"] == "SPOT"
    assert sun["cutoff_angle"] > 0.0
    assert sun["parent_name"] == ""


def test_what_is_set_takes_effect_and_stays(parameters):
    for name, value in {
        "near_plane": 0.02,
        "field_view_angle": 1,
        "projection": "ORTHOGRAPHIC",
        "mode": "STEREO",
    }.items():
        parameters.set(f"{EYE}/{name}", value)
    parameters.set(f"{SUN}/cutoff_angle", 0.4)
    parameters.set(f"{SUN}/type", "DIRECTIONAL")
    # A width appears because the view is orthographic now: that says that the simulation took it over.
    eventually(lambda: parameters.get(f"{EYE}/orthographic_view_width") > 0.0, 10.0, "a width", 0.05)
    for name, value in {
        "near_plane": 0.02,
        "field_view_angle": 1,
        "projection": "ORTHOGRAPHIC",
        "mode": "STEREO",
    }.items():
        assert parameters.get(f"{EYE}/{name}") == value
    assert parameters.get(f"{SUN}/type") == "DIRECTIONAL"


def test_a_world_reset_shows_on_the_server(parameters, ros):
    """The other way: what changes in the simulation changes there."""
    parameters.set(f"{EYE}/mode", "STEREO")
    parameters.set(f"{EYE}/projection", "ORTHOGRAPHIC")
    eventually(lambda: parameters.get(f"{EYE}/orthographic_view_width") > 0.0, 10.0, "a width", 0.05)
    ros.talk("/ambf/env/World/Command/Reset", Empty).publish()
    parameters.becomes(f"{EYE}/projection", "PERSPECTIVE")
    parameters.becomes(f"{EYE}/mode", "MONO")


@pytest.mark.parametrize(
    ("name", "value"),
    [
        (f"{EYE}/near_plane", 1e9),
        (f"{EYE}/field_view_angle", "wide"),
        (f"{EYE}/projection", "FISHEYE"),
        (f"{EYE}/mode", 3),
        (f"{EYE}/far_plane", [1, 2]),
        (f"{EYE}/parent_name", "no such thing"),
        (f"{SUN}/type", "LASER"),
        (f"{SUN}/cutoff_angle", -1.0),
    ],
)
def test_what_makes_no_sense_is_told_and_put_back(parameters, bench, name, value):
    before = parameters.get(name)
    bench.allowed += [r"not changed", r"stays where it hangs"]
    parameters.set(name, value)
    parameters.becomes(name, before)
    assert any("not changed" in line or "stays where it hangs" in line for line in bench.log().splitlines())


def test_a_camera_is_hung_on_a_body_and_let_go_again_without_a_jump(parameters, bench, ros, tmp_path):
    (tmp_path / "extra.yaml").write_text(MODEL)
    answer = ros.service("/ambf/env/World/Load", Load)(path=str(tmp_path / "extra.yaml"))
    assert answer.success, answer.message
    eye = ros.listen(f"{EYE}/State", CameraState)
    start = eye.last().pose.position
    parameters.set(f"{EYE}/parent_name", "/extra/BODY tool")
    moved = eye.next(lambda m: m.parent_name.data == "/extra/tool")  # the full name, whatever was written
    # In the tool's frame now, which stands at (3, 0, 1).
    assert moved.pose.position.x == pytest.approx(start.x - 3.0)
    assert moved.pose.position.z == pytest.approx(start.z - 1.0)
    parameters.set(f"{EYE}/parent_name", "")
    back = eye.next(lambda m: m.parent_name.data == "")
    assert back.pose.position.x == pytest.approx(start.x)
    # A light on a camera, which a client then moves.
    sun = ros.listen(f"{SUN}/State", LightState)
    parameters.set(f"{SUN}/parent_name", "/ambf/env/cameras/eye")
    sun.next(lambda m: m.parent_name.data == "/ambf/env/cameras/eye")
    # A reset of the world hangs it where its file says, and the parameter server says so, too.
    ros.talk("/ambf/env/World/Command/Reset", Empty).publish(Empty())
    sun.next(lambda m: m.parent_name.data == "")
    parameters.becomes(f"{SUN}/parent_name", "")


def test_objects_that_go_take_their_parameters_along(parameters, ros, tmp_path):
    (tmp_path / "extra.yaml").write_text(MODEL)
    answer = ros.service("/ambf/env/World/Load", Load)(path=str(tmp_path / "extra.yaml"))
    assert answer.success, answer.message
    parameters.becomes("/extra/scope/near_plane", 0.05)
    parameters.becomes("/extra/scope/parent_name", "BODY tool")
    parameters.set("/extra/scope/mine", 5)
    assert ros.service("/ambf/env/World/Unload", Unload)(model=answer.model).success
    eventually(lambda: parameters.get("/extra/scope") == {"mine": 5}, 10.0, "only the user's own are left", 0.05)
    ros.rospy.delete_param("/extra/scope")


def test_they_are_gone_with_the_simulator(parameters, bench):
    bench.stop()
    assert not parameters.get(EYE)
    assert not parameters.get(SUN)


def test_a_camera_moved_by_a_client_goes_on_from_there_after_its_lens_changed(parameters, ros):
    eye = ros.listen(f"{EYE}/State", CameraState)
    talk = ros.talk(f"{EYE}/Command", CameraCmd)
    command = CameraCmd(enable_position_controller=True)
    command.pose.position.x, command.pose.orientation.w = 0.7, 1.0
    talk.publish(command)
    eye.next(lambda m: m.pose.position.x == pytest.approx(0.7))
    parameters.set(f"{EYE}/field_view_angle", 0.5)
    parameters.becomes(f"{EYE}/field_view_angle", 0.5)
    assert eye.next().pose.position.x == pytest.approx(0.7)
