"""A scene of three coloured plates under cameras of every kind, and what tests of their pictures do with messages."""

from pathlib import Path

import numpy as np
import scenes
from harness import eventually

WIDTH, HEIGHT = 320, 240
FIELD_OF_VIEW = 0.8
CAMERAS = "/ambf/env/cameras"
SHADERS = Path(__file__).resolve().parents[1] / "render/shaders"


def camera(name, extra="", location="{x: 2.0, y: 0.0, z: 0.0}", look_at="{x: 0.0, y: 0.0, z: 0.0}"):
    return f"""\
{name}:
  namespace: cameras/
  name: {name}
  location: {location}
  look at: {look_at}
  up: {{x: 0.0, y: 0.0, z: 1.0}}
  clipping plane: {{near: 0.01, far: 20.0}}
  field view angle: {FIELD_OF_VIEW}
  publish image: true
  publish image resolution: {{width: {WIDTH}, height: {HEIGHT}}}
{extra}"""


CAMERA_BLOCKS = {
    "eye": camera(
        "eye",
        f"  publish depth: true\n  publish depth interval: 1\n"
        f"  publish depth resolution: {{width: {WIDTH}, height: {HEIGHT}}}\n",
    ),
    "slow": camera(
        "slow",
        "  visible: false\n  publish image interval: 3\n  publish depth: true\n  publish depth interval: 2\n"
        "  publish depth resolution: {width: 80, height: 60}\n"
        "  publish depth noise: {mean: 0.05, std_dev: 0.01, bias: 0.02}\n",
    ),
    "pair": camera("pair", "  stereo: {mode: PASSIVE_LEFT_RIGHT, eye separation: 0.1, focal length: 2.0}\n"),
    # As of a calibrated endoscope, for pictures twice as large.
    "scope": camera(
        "scope",
        f"  window resolution: {{width: {2 * WIDTH}, height: {2 * HEIGHT}}}\n"
        "  camera intrinsics: {fx: 600, fy: 500, cx: 368, cy: 216, s: 20}\n"
        f"  publish depth: true\n  publish depth interval: 1\n"
        f"  publish depth resolution: {{width: {WIDTH}, height: {HEIGHT}}}\n",
    ),
    "flat": camera("flat", "  orthographic view width: 2.0\n"),
    "sensor": camera(
        "sensor",
        f"  publish depth: true\n  publish depth interval: 1\n"
        f"  publish depth resolution: {{width: {WIDTH}, height: {HEIGHT}}}\n"
        f"  depth compute shaders: {{path: {SHADERS}, vertex: points.vs, fragment: half_range.fs}}\n",
    ),
    "rider": camera("rider", "  parent: BODY Carrier\n", "{x: 2.0, y: 0.0, z: 0.0}", "{x: 0.0, y: 0.0, z: 0.0}"),
}

COLORS = "red: {r: 230, g: 20, b: 20}\ngreen: {r: 20, g: 200, b: 20}\nblue: {r: 20, g: 20, b: 230}\n"


def plate(name, color, position, y=0.2, z=0.1):
    """So thin that its picture is its front face, whose middle is where it is."""
    px, py, pz = position
    return f"""\
BODY {name}:
  name: {name}
  mass: 1.0
  inertia: {{ix: 0.01, iy: 0.01, iz: 0.01}}
  location: {{position: {{x: {px}, y: {py}, z: {pz}}}, orientation: {{r: 0.0, p: 0.0, y: 0.0}}}}
  shape: BOX
  geometry: {{x: 0.0002, y: {y}, z: {z}}}
  collision shape: BOX
  collision geometry: {{x: 0.01, y: {y}, z: {z}}}
  damping: {{linear: 0.0, angular: 0.0}}
  color: {color}
"""


PLATES = {"Red": (0.0, 0.45, 0.3), "Green": (0.5, -0.3, -0.25), "Blue": (-0.4, 0.1, 0.0)}
MODEL = scenes.model(
    {
        **{name: plate(name, name.lower(), position) for name, position in PLATES.items()},
        "Carrier": scenes.box("Carrier", 1.0, (0.0, 0.0, -5.0)),
    }
)


def write(folder):
    launch = scenes.write(folder, MODEL)
    world = scenes.WORLD.split("cameras: [eye]")
    world = world[0] + "cameras: [" + ", ".join(CAMERA_BLOCKS) + "]" + world[1].split("eye:\n")[0]
    # From above the cameras, so that nothing mirrors the light.
    world = world.replace("location: {x: 0.0, y: 0.0, z: 3.0}", "location: {x: 4.0, y: 0.0, z: 4.0}")
    world = world.replace("direction: {x: 0.0, y: 0.0, z: -1.0}", "direction: {x: -1.0, y: 0.0, z: -1.0}")
    (folder / "world.yaml").write_text(world + "".join(CAMERA_BLOCKS.values()))
    (folder / "colors.yaml").write_text(scenes.COLORS + COLORS)
    return launch


def pixels(image):
    kinds = {"rgb8": (np.uint8, 3), "mono16": (np.uint16, 1), "32FC1": (np.float32, 1)}
    kind, channels = kinds[image.encoding]
    assert image.step == image.width * channels * np.dtype(kind).itemsize
    array = np.frombuffer(image.data, dtype=kind).reshape(image.height, image.width, channels)
    return array if channels > 1 else array[:, :, 0]


def middle_of(pixels_of_it):
    rows, columns = np.nonzero(pixels_of_it)
    assert len(rows) > 20
    return columns.mean(), rows.mean()


def colored(array, name):
    """Where a picture shows a plate."""
    channel = {"Red": 0, "Green": 1, "Blue": 2}[name]
    others = [array[:, :, c].astype(int) for c in range(3) if c != channel]
    return array[:, :, channel].astype(int) > np.maximum(*others) + 40


def cloud_points(message):
    assert [field.name for field in message.fields] == ["x", "y", "z", "rgb"]
    raw = np.frombuffer(message.data, dtype=np.float32).reshape(message.height, message.width, 4)
    return raw[:, :, :3], raw[:, :, 3].copy().view(np.uint32)


def matching(stamp, *listeners):
    """The messages of several topics with that stamp."""

    def find():
        found = [next((m for m in each.messages if m.header.stamp == stamp), None) for each in listeners]
        return found if all(found) else None

    return eventually(find, 5.0, "messages of one moment on every topic")


def one_moment(*listeners):
    """One message of each, all of the same frame."""

    def find():
        common = set.intersection(*({m.header.stamp for m in each.messages} for each in listeners))
        return max(common) if common else None

    return matching(eventually(find, 20.0, "a moment that all topics show"), *listeners)
