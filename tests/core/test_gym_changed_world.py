"""Masses, scales, colours and lights, drawn for each episode by changing the files' text before it is loaded."""

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium")
import ambf_gym  # noqa: E402
import yaml  # noqa: E402
from ambf_core import World  # noqa: E402
from ambf_gym.changed_world import ChangedWorld, _of_body  # noqa: E402

RING_KG = 0.0019186510955717712
RING_M, BOARD_M = 0.003, 0.026  # the radius of the ring's tube; the top of the board


class Arm(ambf_gym.Arm7Reach):
    """Quickly settled."""

    def settle(self, world):
        world.commands.set_joints(0.5)
        world.step(200)


def test_a_mass_moves_otherwise_and_is_undone():
    ranges = {"link7": {"mass": [0.5, 3.0], "linear damping": [0.1, 0.2]}}
    env, plain = Arm(randomization=ranges), Arm()
    options = {"goal": [0.3, 0.0, 0.5]}
    moved, fallen, masses = [], [], []
    start = plain.reset(seed=1, options=options)[0]["achieved_goal"]
    for seed in (1, 2, 3, 1):
        observation, info = env.reset(seed=seed, options=options)
        drawn = info["randomization"]
        assert drawn.keys() == {"link7 mass", "link7 linear damping"}
        assert env.world.masses[env.world.body("link7")] == drawn["link7 mass"]
        moved.append(env.step(np.ones(7, np.float32))[0]["observation"])
        assert env.world.parameter("link7", "linear damping") == pytest.approx(drawn["link7 linear damping"])
        masses.append(drawn["link7 mass"])
        fallen.append(start[2] - observation["achieved_goal"][2])
    assert len(set(masses)) == 3 and all(0.5 <= each <= 3.0 for each in masses)
    assert list(np.argsort(masses[:3])) == list(np.argsort(fallen[:3])), "heavier is lower"
    assert np.ptp(fallen) > 1e-4
    assert (moved[0] == moved[3]).all(), "the same seed, the same episode"
    env._randomization = None
    for each in (env, plain):
        each.reset(seed=1, options=options)
        for _ in range(3):
            each.step(np.ones(7, np.float32))
    assert env.world.hash() == plain.world.hash()
    env.close()
    plain.close()


def test_a_scale_is_one_of_shapes_and_the_files_own_values_change_nothing():
    def rests(**ranges):
        env = ambf_gym.RingLift(randomization={"ring2": ranges})
        info = env.reset(seed=1)[1]["randomization"]
        pose = env.world.state.body_pose[env.world.body("ring2")]
        height, state = pose[2], env.world.hash()
        env.close()
        return height, state, info

    plain = ambf_gym.RingLift()
    plain.reset(seed=1)
    _, same, _ = rests(mass=[RING_KG, RING_KG], scale=[1, 1], color=[[0, 0, 0], [1, 1, 1]])
    assert same == plain.world.hash()
    plain.close()
    height, _, info = rests(scale=[1.3, 1.3])
    assert info == {"ring2 scale": 1.3}
    assert height == pytest.approx(BOARD_M + 1.3 * RING_M, abs=2e-4)


def test_colours_and_lights_are_seen_and_move_nothing():
    goal = {"goal": [0.0, 0.0, 0.1]}
    green = {"ring2": {"color": [[0, 0.8, 0], [0, 0.9, 0]]}}
    dark = {"lights": {"key_light": {"location": [[5, 5, 0.1], [6, 6, 0.2]], "cutoff angle": [0.1, 0.2]}}}
    seen, hashes = {}, set()
    for name, ranges in (("plain", None), ("green", green), ("dark", dark)):
        env = ambf_gym.RingLift(randomization=ranges, observation="both", picture_size=(64, 48))
        observation, info = env.reset(seed=1, options=goal)
        seen[name] = observation["picture"].astype(int)
        hashes.add(env.world.hash())
        drawn = info.get("randomization", {})
        if name == "green":
            assert drawn["ring2 color"].shape == (3,) and 0.8 <= drawn["ring2 color"][1] <= 0.9
        if name == "dark":
            assert drawn.keys() == {"light key_light location", "light key_light cutoff angle"}
        env.close()
    assert len(hashes) == 1
    ring = np.abs(seen["green"] - seen["plain"]).max(-1) > 20
    assert 2 <= ring.sum() < 300, "the ring, and the ring alone"
    assert (seen["green"] - seen["plain"])[ring][:, 0].mean() < -20, "less red"
    assert seen["dark"].mean() < seen["plain"].mean() - 5


REFUSED = [
    ({"ring2": {"mass": [0.0, 1.0]}}, "ring2 mass: .* is not within 1e-09"),
    ({"ring2": {"mass": [-1.0, 1.0]}}, "ring2 mass: .* is not within"),
    ({"ring2": {"scale": [0.0, 1.0]}}, "ring2 scale: .* is not within"),
    ({"ring2": {"scale": [2.0, 1.0]}}, "ring2 scale: .* is not a range"),
    ({"ring2": {"color": [[0, 0, 0], [1, 1.5, 1]]}}, "ring2 color: .* is not within 0 to 1"),
    ({"ring2": {"color": [[-1, 0, 0], [1, 1, 1]]}}, "ring2 color"),
    ({"ring9": {"mass": [1.0, 2.0]}}, "'ring9'"),
    ({"ring3": {"mass": [1.0, 2.0]}}, "'ring3'"),  # removed
    ({"mat": {"mass": [1.0, 2.0]}}, "'mat': mass: it is static"),
    ({"table": {"scale": [1.0, 2.0]}}, "'table': it is in none of the files"),
    ({"ring2": {"mass": [1, 2]}, "/ambf/env/ring2": {"mass": [1, 2]}}, "mass: ring2 mass is the same"),
    ({"lights": {"lamp": {"location": [0, 1]}}}, "lights: 'lamp': .* key_light"),
    ({"lights": {"key_light": {"mass": [1, 2]}}}, "lights: 'key_light': .* not a map of location"),
    ({"lights": {"key_light": {"cutoff angle": [1, 4]}}}, "light key_light cutoff angle: .* is not within"),
    ({"lights": {"key_light": {"direction": [[0, 0, -1], [0, 0, 1]]}}}, "no direction"),
]


def test_ranges_that_no_world_can_have_are_refused_at_make():
    env = ambf_gym.RingLift
    with World(*env.files, world=env.ground, without=env.without) as world:
        for ranges, problem in REFUSED:
            with pytest.raises(ValueError, match=problem):
                ambf_gym.Randomization(ranges, world, "", env.files, env.ground, env.without)
    with pytest.raises(ValueError, match=REFUSED[0][1]):
        ambf_gym.make("ambf/RingLift-v0", randomization=REFUSED[0][0])
    with pytest.raises(ValueError, match="not for a WorldBatch"):
        gymnasium.make_vec("ambf/RingLift-v0", 2, randomization={"ring2": {"scale": [1.0, 2.0]}})


TEXTS = """\
namespace: /mine/
bodies: [BODY a, BODY b, {more}]
BODY a: {{name: a, mass: 2.0, shape: BOX, geometry: {{x: 1, y: 1, z: 1}}}}  # a comment
BODY b:
  # another one
  color rgba:
    r: 1
    g: 1
    b: 1
    a: 0.5
  shape: SPHERE
  mass:  1.0
  inertia:
    ix: 0.1
    iy: 0.1

    iz: 0.1
  # the end
  geometry: {{radius: 1}}
  inertial offset:
    position:
      x: 0.1
      y: 0.0
      z: 0.0
{further}"""


def test_texts_are_changed_where_they_say_it(tmp_path):
    """In blocks and braces, over several lines, where a key is there and where it is not."""
    file = tmp_path / "mine.yaml"
    file.write_text(TEXTS.format(more="BODY c", further='BODY c: {name: "my c", namespace: /c/}\n'))
    changed = ChangedWorld([file], None, ())
    values = {"scale": np.array([2.0]), "mass": np.array([3.0]), "color": np.array([0.1, 0.2, 0.3])}
    names = ("/mine/a", "/mine/b", "/c/myc")
    with changed.load({name: values for name in names}, {}) as world:
        assert (world.masses[[world.body(name) for name in names]] == 3.0).all()
    adf = changed._files[0]
    text = adf.changed([edit for name in names for edit in _of_body(adf.bodies[name], values)])
    assert text.count("#") == 3
    blocks = yaml.safe_load(text)
    assert all(blocks[f"BODY {each}"]["scale"] == 2.0 for each in "abc")
    opaque = {"a": 1.0, "b": 0.5, "c": 1.0}
    for each, a in opaque.items():
        assert blocks[f"BODY {each}"]["color rgba"] == {"r": 0.1, "g": 0.2, "b": 0.3, "a": a}
    assert blocks["BODY b"]["inertia"]["iz"] == pytest.approx(0.1 * 3 * 4)
    assert blocks["BODY b"]["inertial offset"]["position"] == {"x": 0.2, "y": 0.0, "z": 0.0}
    assert blocks["BODY b"]["geometry"] == {"radius": 1}
    file.write_text(TEXTS.format(more="BODY c", further="BODY c: *other\n").replace("BODY a: {", "BODY a: &other {"))
    with pytest.raises(ValueError, match="alias"):
        ChangedWorld([file], None, ())
