"""Worlds in this process. A build without nanobind has none, which is a failure in CI."""

import importlib.util
import os

import pytest

if importlib.util.find_spec("_ambf_core") is None:
    if os.environ.get("CI") and not os.environ.get("AMBF_SANITIZER"):
        raise RuntimeError("the Python module ambf_core was not built: cmake's output says what it lacks")
    collect_ignore_glob = ["test_*.py"]

# A box that falls on a static floor, and an arm of two links below a fixed base.
SCENE = """
bodies: [BODY floor, BODY box, BODY base, BODY upper, BODY lower]
joints: [JOINT shoulder, JOINT elbow]
namespace: /test/
BODY floor: {name: floor, mass: 0, shape: BOX, geometry: {x: 4, y: 4, z: 0.2},
  collision shape: BOX, collision geometry: {x: 4, y: 4, z: 0.2},
  location: {position: {x: 0, y: 0, z: -0.1}, orientation: {r: 0, p: 0, y: 0}}}
BODY box: {name: box, mass: 2, shape: BOX, geometry: {x: 0.1, y: 0.1, z: 0.1},
  collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 1, y: 1, z: 0.3}, orientation: {r: 0.3, p: 0.2, y: 0.1}}}
BODY base: {name: base, mass: 0, shape: BOX, geometry: {x: 0.05, y: 0.05, z: 0.05},
  location: {position: {x: 0, y: 0, z: 1}, orientation: {r: 0, p: 0, y: 0}}}
BODY upper: {name: upper, mass: 0.5, shape: BOX, geometry: {x: 0.02, y: 0.02, z: 0.2},
  location: {position: {x: 0, y: 0, z: 0.9}, orientation: {r: 0, p: 0, y: 0}}}
BODY lower: {name: lower, mass: 0.5, shape: BOX, geometry: {x: 0.02, y: 0.02, z: 0.2},
  location: {position: {x: 0, y: 0, z: 0.7}, orientation: {r: 0, p: 0, y: 0}}}
JOINT shoulder: {name: shoulder, parent: BODY base, child: BODY upper, type: revolute, max motor impulse: 0.05,
  parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0.1}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}, joint limits: {low: -2.0, high: 2.0}}
JOINT elbow: {name: elbow, parent: BODY upper, child: BODY lower, type: revolute, max motor impulse: 0.05,
  parent pivot: {x: 0, y: 0, z: -0.1}, child pivot: {x: 0, y: 0, z: 0.1}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
"""


@pytest.fixture
def scene():
    return SCENE


@pytest.fixture
def make_world():
    from ambf_core import World

    worlds = []

    def make(**options):
        worlds.append(World(text=SCENE, **options))
        return worlds[-1]

    yield make
    for each in worlds:
        each.close()
