"""Small scenes for the acceptance tests: no gravity, so that what is commanded is what happens."""

from pathlib import Path

WORLD = """\
adf version: 1.0
namespace: /ambf/env/
environment: ./empty.yaml
gravity: {x: 0.0, y: 0.0, z: 0.0}
lights: [sun]
cameras: [eye]
sun:
  namespace: lights/
  name: sun
  location: {x: 0.0, y: 0.0, z: 3.0}
  direction: {x: 0.0, y: 0.0, z: -1.0}
  spot exponent: 0.3
  cutoff angle: 0.7
  shadow quality: 0
eye:
  namespace: cameras/
  name: eye
  location: {x: 3.0, y: 0.0, z: 1.0}
  look at: {x: 0.0, y: 0.0, z: 0.0}
  up: {x: 0.0, y: 0.0, z: 1.0}
  clipping plane: {near: 0.01, far: 20.0}
  field view angle: 0.7
  monitor: 0
"""

EMPTY = """\
adf version: 1.0
namespace: /ambf/env/
bodies: []
"""

COLORS = """\
white: {r: 255, g: 255, b: 255}
"""


def box(name, mass, position, size=0.1, extra=""):
    """One body block: a box of that size."""
    x, y, z = position
    inertia = mass * size * size / 6.0
    return f"""\
BODY {name}:
  name: {name}
  mass: {mass}
  inertia: {{ix: {inertia}, iy: {inertia}, iz: {inertia}}}
  location: {{position: {{x: {x}, y: {y}, z: {z}}}, orientation: {{r: 0.0, p: 0.0, y: 0.0}}}}
  shape: BOX
  geometry: {{x: {size}, y: {size}, z: {size}}}
  collision shape: BOX
  collision geometry: {{x: {size}, y: {size}, z: {size}}}
  damping: {{linear: 0.0, angular: 0.0}}
  color: white
{extra}"""


def joint(name, kind, parent, child, pivot_parent, extra=""):
    """A joint about or along z through the child's centre."""
    x, y, z = pivot_parent
    return f"""\
JOINT {name}:
  name: {name}
  type: {kind}
  parent: BODY {parent}
  child: BODY {child}
  parent pivot: {{x: {x}, y: {y}, z: {z}}}
  parent axis: {{x: 0.0, y: 0.0, z: 1.0}}
  child pivot: {{x: 0.0, y: 0.0, z: 0.0}}
  child axis: {{x: 0.0, y: 0.0, z: 1.0}}
  damping: 0.0
{extra}"""


def model(bodies, joints=(), namespace="/ambf/env/"):
    """bodies, joints: {name: block}"""
    lines = ["adf version: 1.0", f"namespace: {namespace}", "ignore inter-collision: true"]
    lines += ["bodies: [" + ", ".join(f"BODY {name}" for name in bodies) + "]"]
    if joints:
        lines += ["joints: [" + ", ".join(f"JOINT {name}" for name in joints) + "]"]
    return "\n".join(lines) + "\n" + "\n".join([*dict(bodies).values(), *dict(joints).values()])


# Used by most tests: a free box, a fixed one, and a turntable with a slide on it.
BENCH = model(
    {
        "Box": box("Box", 2.0, (0.0, 1.0, 0.0)),
        "Table": box("Table", 0.0, (0.0, -1.0, 0.0)),
        "Base": box("Base", 0.0, (0.0, 0.0, 0.0)),
        "Plate": box("Plate", 1.0, (0.0, 0.0, 0.2), 0.2, "  publish children names: true\n"),
        "Slide": box("Slide", 0.5, (0.0, 0.0, 0.5)),
    },
    {
        "turn": joint(
            "turn", "revolute", "Base", "Plate", (0.0, 0.0, 0.2), "  controller: {P: 20.0, I: 0.0, D: 1.0}\n"
        ),
        "lift": joint(
            "lift", "prismatic", "Plate", "Slide", (0.0, 0.0, 0.3), "  controller: {P: 200.0, I: 0.0, D: 10.0}\n"
        ),
    },
)


def cubes(count, namespace="/ambf/env/"):
    return model(
        {f"Cube{i:03}": box(f"Cube{i:03}", 1.0, (0.3 * (i % 20), 0.3 * (i // 20), 0.0)) for i in range(count)},
        namespace=namespace,
    )


def write(folder: Path, text: str = BENCH) -> Path:
    """A launch file and its parts, with one model of that text."""
    (folder / "world.yaml").write_text(WORLD)
    (folder / "empty.yaml").write_text(EMPTY)
    (folder / "colors.yaml").write_text(COLORS)
    (folder / "model.yaml").write_text(text)
    launch = folder / "launch.yaml"
    launch.write_text("world config: ./world.yaml\ncolor config: ./colors.yaml\nmultibody configs:\n  - ./model.yaml\n")
    return launch
