"""Pictures of worlds in this process: of the very step, the same for the same state, and without OpenGL until asked."""

import subprocess
import sys
import threading

import numpy as np
import pytest
from ambf_core import MODELS, View, World, WorldBatch

gymnasium = pytest.importorskip("gymnasium")
import ambf_gym  # noqa: E402

VIEW = View((3.0, 1.0, 0.6), (1.0, 1.0, 0.3), far=10.0)
ID = "ambf/PsmReach-v0"


def draw(world, camera=VIEW, **wanted):
    return world.picture(camera, 160, 120, **wanted)


def pixel_of(info, point):
    x, y, z, w = info.pose[3:]
    axes = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    seen = axes.T @ (np.asarray(point) - info.pose[:3])
    return (info.matrix @ seen / seen[2])[:2], seen[2]


def test_a_picture_is_of_the_newest_step(make_world):
    world = make_world(renderer="osmesa")
    box, seen = world.body("box"), []
    for steps in (0, 100, 100):
        world.step(steps)
        picture = draw(world, depth=True, mask=True)
        assert picture.sim_step == world.state.sim_step
        assert picture.rgb.shape == (120, 160, 3) and picture.rgb.dtype == np.uint8
        rows, columns = np.nonzero(picture.mask == box)
        middle, ahead = pixel_of(picture.info, world.state.body_pose[box, :3])
        assert abs(columns.mean() - middle[0]) < 1 and abs(rows.mean() - middle[1]) < 1
        near = np.nanmin(picture.depth[picture.mask == box])
        assert ahead - 0.09 < near < ahead - 0.04, "the box is 0.1 m wide"
        assert (picture.mask == world.body("floor")).any() and np.isnan(picture.depth[picture.mask == -1]).all()
        seen.append(rows.mean())
    assert seen[0] < seen[1] - 1 and seen[1] < seen[2] - 1, "it falls"


def test_equal_states_give_equal_pictures(make_world):
    first, second = make_world(renderer="osmesa"), make_world(renderer="osmesa")
    first.step(150)
    wanted = draw(first)
    for _ in range(3):  # another history of pictures
        second.step(20)
        draw(second, View((1.0, 4.0, 2.0), (1.0, 1.0, 0.0)))
    second.reset()
    second.step(150)
    assert first.hash() == second.hash()
    assert (draw(second).rgb == wanted.rgb).all()
    second.step(50)
    assert (draw(second).rgb != wanted.rgb).any()


def test_a_batch_draws_what_single_worlds_do(scene):
    with WorldBatch(text=scene, n=2, workers=2, renderer="osmesa") as batch, World(text=scene) as world:
        batch.commands.set_joints(np.array([[0.0, 0.0], [0.5, 0.5]]))
        world.commands.set_joints([0.5, 0.5])
        batch.step(100)
        world.step(100)
        one, two = batch.pictures(VIEW, 80, 60, depth=True)
        alone = world.picture(VIEW, 80, 60, depth=True)
        assert (two.rgb == alone.rgb).all() and np.array_equal(two.depth, alone.depth, equal_nan=True)
        assert (one.rgb != two.rgb).any()
        assert (batch.view(1).picture(VIEW, 80, 60).rgb == two.rgb).all()
        (only,) = batch.pictures(VIEW, 80, 60, worlds=np.array([False, True]), rgb=False, mask=True)
        assert only.rgb is None and (only.mask == world.body("lower")).any()


def test_what_cannot_be_drawn_raises(make_world):
    world = make_world()
    with pytest.raises(LookupError, match="side_camera"):
        world.picture("side_camera")
    for view in (View((0, 0, 1), (0, 0, 1)), View((0, 0, float("nan")), (0, 0, 1)), View((0, 0, 1), (1, 0, 1), 4.0)):
        with pytest.raises(ValueError, match="View"):
            world.picture(view)
    with pytest.raises(ValueError, match="0 x 10"):
        world.picture(VIEW, 0, 10)
    with pytest.raises(ValueError, match="renderer"):
        make_world(renderer="pencil")
    draw(world)
    raised = []

    def elsewhere():
        with pytest.raises(RuntimeError, match="thread that drew its first one"):
            draw(world)
        raised.append(True)

    thread = threading.Thread(target=elsewhere)
    thread.start()
    thread.join()
    assert raised
    world.close()
    with pytest.raises(RuntimeError, match="closed"):
        draw(world)
    with pytest.raises(ValueError, match="over ROS"):
        ambf_gym.PsmReach(backend="ros", render_mode="rgb_array")
    for options in ({"observation": "smell"}, {"render_mode": "ansi"}):
        with pytest.raises(ValueError, match=str(*options.values())):
            ambf_gym.PsmReach(**options)
    with pytest.raises(ValueError, match="have no window"):
        gymnasium.make_vec(ID, 2, render_mode="human")


def test_the_camera_of_a_file_is_found():
    files = MODELS / "multi-bodies/robots/psm.yaml"
    with World(files, world=MODELS / "world/psm_world.yaml", renderer="osmesa") as world:
        assert world.cameras == ["/ambf/env/cameras/main_camera"]
        picture = world.picture("main_camera", 64, 48)
        assert picture.rgb.std() > 10 and (world.picture("", 64, 48).rgb == picture.rgb).all()


def test_opengl_is_loaded_with_the_first_picture(tmp_path, scene):
    (tmp_path / "scene.yaml").write_text(scene)
    program = f"""
from ambf_core import View, World
loaded = lambda: [each for each in ("libambf_view", "OSMesa") if each in open("/proc/self/maps").read()]
world = World("scene.yaml", renderer="osmesa")
world.step(10)
assert loaded() == [], loaded()
world.picture(View{tuple(VIEW)}, 20, 20)
assert loaded() == ["libambf_view", "OSMesa"], loaded()
"""
    environment = {"PYTHONPATH": ":".join(each for each in sys.path if each)}  # and no DISPLAY
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def picture_of(env, seed, actions):
    seen = [env.reset(seed=seed)[0]]
    for action in actions:
        seen.append(env.step(np.full(3, action, np.float32))[0])
    return seen


def test_pictures_as_observations_repeat_and_show_the_goal():
    env = ambf_gym.make(ID, observation="both", render_mode="rgb_array")
    inner = env.unwrapped
    assert env.observation_space["picture"].shape == (84, 84, 3)
    first = picture_of(env, 3, (1, 0.5))
    frame = env.render()
    assert frame.shape == (480, 640, 3) and frame.dtype == np.uint8
    mask = inner.world.picture(inner.view, 84, 84, mask=True)
    rows, columns = np.nonzero(mask.mask == inner.world.body("target_ik"))
    goal, _ = pixel_of(mask.info, first[-1]["desired_goal"])
    assert np.hypot(columns.mean() - goal[0], rows.mean() - goal[1]) < 4, "the mark is at the goal"
    picture_of(env, 4, (-1, -1))
    again = picture_of(env, 3, (1, 0.5))
    other = ambf_gym.make(ID, observation="pictures")
    fresh = picture_of(other, 3, (1, 0.5))
    vector = gymnasium.make_vec(ID, 2, observation="pictures")
    many = vector.reset(seed=3)[0]
    for a, b, c in zip(first, again, fresh, strict=True):
        assert (a["picture"] == b["picture"]).all() and (a["observation"] == b["observation"]).all()
        assert (a["picture"] == c["observation"]).all(), "in a fresh environment, too"
    assert (many["observation"][0] == first[0]["picture"]).all()
    assert (first[0]["picture"] != first[-1]["picture"]).any()
    vector.close()
    other.close()
    env.close()
