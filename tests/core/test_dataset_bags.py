"""Data sets from bags: streams of several rates come to one, and each episode is of one world."""

import io

import numpy as np
import pytest

for module in ("h5py", "pandas", "pyarrow", "rosbag"):
    pytest.importorskip(module)
import rosbag  # noqa: E402
import rospy  # noqa: E402
from ambf_tools import dataset  # noqa: E402
from ambf_tools.cli.main import main  # noqa: E402
from sensor_msgs.msg import CompressedImage, Image  # noqa: E402

from ambf_msgs.msg import RigidBodyCmd, RigidBodyState, TaskState  # noqa: E402

ARM, TASK, CAMERA = "/ambf/env/psm/base", "/ambf/env/tasks/pegs", "/ambf/env/cameras/eye/ImageData"
STATE, COMMAND = dataset.Stream(f"{ARM}/State", ("joint_positions",)), dataset.Stream(f"{ARM}/Command", ("joint_cmds",))
WALL = 1000.0  # s since 1970: when the recording begins


def picture(step):
    """One whose red says the step."""
    rows = np.zeros((4, 6, 3), np.uint8)
    rows[..., 0] = step // 20
    return Image(encoding="rgb8", height=4, width=6, step=18, data=rows.tobytes())


def write(path, wrong=None, jpeg=False, length=1000, task_first=False, picture_late=False):
    """Two episodes of `length` steps: the world is reset in between. States of every second step, a command every 15
    steps, a picture every 40; the clock on the wall runs at half the speed. The second one succeeds at its end.

    task_first: a state of the task stands before that of the arm; picture_late: pictures arrive 90 ms late."""
    with rosbag.Bag(str(path), "w") as bag:
        for episode in (0, 1):
            for step in range(0, length, 1):
                wall = WALL + 2e-3 * (step + length * episode)
                stamp = rospy.Time.from_sec(wall)
                if step % 2 == 0:
                    state = RigidBodyState(sim_step=step, sim_time=step * 1e-3)
                    state.header.stamp = stamp
                    state.joint_positions = [step * 1e-3, np.nan if step == wrong else -float(episode)]
                    judged = TaskState(sim_step=step, sim_time=step * 1e-3, success=bool(episode and step > length / 2))
                    judged.header.stamp = stamp
                    earlier = rospy.Time.from_sec(wall - 1e-4) if task_first else stamp
                    bag.write(f"{TASK}/State", judged, earlier)
                    bag.write(STATE.topic, state, stamp)
                if step % 15 == 0:
                    bag.write(COMMAND.topic, RigidBodyCmd(joint_cmds=[float(step)]), stamp)
                if step % 40 == 0:
                    image = picture(step)
                    if jpeg:
                        from PIL import Image as Pil

                        packed = io.BytesIO()
                        Pil.frombytes("RGB", (6, 4), image.data).save(packed, "JPEG", quality=95)
                        image = CompressedImage(format="jpeg", data=packed.getvalue())
                    image.header.stamp = stamp
                    bag.write(CAMERA, image, rospy.Time.from_sec(wall + 0.09) if picture_late else stamp)
    return path


@pytest.fixture
def bag(tmp_path):
    return write(tmp_path / "trial.bag")


@pytest.mark.parametrize("order", [{}, {"task_first": True}, {"picture_late": True}])
def test_streams_come_to_one_rate_of_simulated_time(tmp_path, order):
    bag = write(tmp_path / "trial.bag", **order)
    made = dataset.from_bags([bag], 50, [STATE], [COMMAND], {"eye": CAMERA}, f"{TASK}/State", task="pegs")
    assert len(made.episodes) == 2, "a reset begins an episode"
    assert not made.left_out
    assert [episode.success for episode in made.episodes] == [False, True]
    for number, episode in enumerate(made.episodes):
        columns = episode.columns
        # From 0 to the last picture, at 0.96 s: rows every 20 ms whose next one is there, too.
        steps = columns["observation.sim_step"]
        np.testing.assert_array_equal(steps, np.arange(0, 960, 20))
        np.testing.assert_allclose(columns["observation.state"][:, 0], steps * 1e-3, atol=1e-6)
        assert (columns["observation.state"][:, 1] == -number).all()
        before_next = (steps + 19) // 15 * 15
        np.testing.assert_array_equal(columns["action"][:, 0], before_next)
        np.testing.assert_array_equal(columns["observation.images.eye"][:, 0, 0, 0], steps // 40 * 40 // 20)
        late = (steps + 20 > 500) if number else np.zeros(len(steps), bool)
        np.testing.assert_array_equal(columns["next.success"], late)
        np.testing.assert_array_equal(columns["next.reward"], late - 1.0)
        assert columns["next.done"].tolist() == [False] * (len(steps) - 1) + [True]
    assert made.episodes[0].columns["action"].shape[1] == 1
    assert made.names["observation.state"] == ["psm/base.joint_positions[0]", "psm/base.joint_positions[1]"]
    with pytest.raises(dataset.DatasetError, match="without an environment"):
        dataset.replay(made, 0)


def test_the_command_line_makes_each_format_of_them(bag, tmp_path, capsys):
    streams = ["--state", f"{STATE.topic}:joint_positions", "--command", f"{COMMAND.topic}:joint_cmds"]
    words = [*streams, "--verdict", f"{TASK}/State", "--camera", f"eye={CAMERA}", "--fps", "25", "--also", str(bag)]
    read = []
    for format in dataset.FORMATS:
        target = tmp_path / format
        assert main(["dataset", "convert", str(bag), str(target), *words, "--format", format]) == 0
        assert "4 episodes of recordings of trial.bag, trial.bag, 2 successful" in capsys.readouterr().out
        faults = [str(each) for each in dataset.check(target)]
        # robomimic wants actions from -1 to 1, which commands are not.
        assert faults == [f"error: demo_{i}/actions are not within -1 to 1" for i in range(4) if format == "robomimic"]
        read.append(dataset.read(target))
    for other in read[1:]:
        assert (other.names, other.options) == (read[0].names, read[0].options)
        for one, same in zip(read[0].episodes, other.episodes, strict=True):
            assert all((one.columns[name] == same.columns[name]).all() for name in one.columns)
    readme = (tmp_path / "lerobot-2.1/meta/README.md").read_text()
    assert "last command" in readme and "`psm/base.joint_cmds[0]`" in readme


def test_compressed_pictures_are_read(tmp_path):
    pytest.importorskip("PIL")
    bag = write(tmp_path / "a.bag", jpeg=True)
    made = dataset.from_bags([bag], 25, [STATE], [COMMAND], {"eye": CAMERA}, success=True)
    shown = made.episodes[0].columns["observation.images.eye"][..., 0].astype(int)
    assert np.abs(shown[:, 0, 0] - np.arange(0, 960, 40) // 20).max() <= 3


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"state": [dataset.Stream("/none", ("x",))]}, r"has no topic /none; it has /ambf/env/cameras/eye/ImageData, "),
        ({"state": [dataset.Stream(STATE.topic, ("joints",))]}, "has no field joints"),
        ({"action": [dataset.Stream(f"{TASK}/State", ("identifier",))]}, "'identifier' is no number"),
        ({"pictures": {"eye": "/none"}}, "has no topic /none"),
        ({"success": None}, "either the topic of a verdict"),
        ({"fps": 1, "state": [STATE]}, "at least one row"),
    ],
)
def test_what_is_not_there_is_said(tmp_path, change, message):
    bag = write(tmp_path / "a.bag", length=200)
    wanted = {"fps": 25, "state": [STATE], "action": [COMMAND], "success": True} | change
    with pytest.raises(dataset.DatasetError, match=message):
        dataset.from_bags([bag], **wanted)


def test_numbers_that_are_none_and_files_that_are_no_bags(tmp_path, capsys):
    with pytest.raises(dataset.DatasetError, match=r"'joint_positions\[1\]' is no number in message 5"):
        dataset.from_bags([write(tmp_path / "a.bag", wrong=10)], 25, [STATE], [COMMAND], success=True)
    (tmp_path / "b.bag").write_bytes(b"no")
    streams = ["--state", "/a:b", "--command", "/a:c", "--success", "no"]
    assert main(["dataset", "convert", str(tmp_path / "b.bag"), str(tmp_path / "c"), *streams]) == 1
    assert "b.bag is no bag" in capsys.readouterr().err
    assert main(["dataset", "convert", str(tmp_path / "b.bag"), str(tmp_path / "c"), *streams[:2]]) == 1
    assert "takes --state and --command" in capsys.readouterr().err
    with pytest.raises(dataset.DatasetError, match="TOPIC:FIELD,.. is wanted"):
        dataset.Stream.of("/a")


def test_what_gives_no_episode_is_said_and_bags_of_other_columns_are_refused(tmp_path, capsys):
    bag = write(tmp_path / "a.bag", length=200)
    with rosbag.Bag(str(bag), "a") as more:  # a third world, which ends at once
        stamp = rospy.Time.from_sec(WALL + 10)
        for step in (0, 2):
            state = RigidBodyState(sim_step=step, sim_time=step * 1e-3, joint_positions=[0.0, 0.0])
            state.header.stamp = stamp
            more.write(STATE.topic, state, stamp)
    words = ["--state", f"{STATE.topic}:joint_positions", "--command", f"{COMMAND.topic}:joint_cmds", "--success", "no"]
    assert main(["dataset", "convert", str(bag), str(tmp_path / "made"), *words]) == 0
    assert "left out: a.bag: part 2 has no time at which there are all streams" in capsys.readouterr().out
    with rosbag.Bag(str(tmp_path / "other.bag"), "w") as other:
        for step in range(100):
            stamp = rospy.Time.from_sec(WALL + step * 1e-2)
            state = RigidBodyState(sim_step=step, sim_time=step * 1e-2, joint_positions=[0.0])
            state.header.stamp = stamp
            other.write(STATE.topic, state, stamp)
            other.write(COMMAND.topic, RigidBodyCmd(joint_cmds=[0.0]), stamp)
    with pytest.raises(dataset.DatasetError, match="other.bag has .* and the bags before it"):
        dataset.from_bags([bag, tmp_path / "other.bag"], 25, [STATE], [COMMAND], success=True)
    assert main(["dataset", "info", str(tmp_path / "made"), "--fps", "25"]) == 1
    assert "--fps is for dataset convert of a .bag" in capsys.readouterr().err
    twice = ["--camera", f"a={CAMERA}", "--camera", f"a={CAMERA}"]
    assert main(["dataset", "convert", str(bag), str(tmp_path / "b"), *words, *twice]) == 1
    assert "wants a NAME of its own" in capsys.readouterr().err
