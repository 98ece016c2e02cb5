"""Worlds with cameras, written for one test."""

# A model to be dropped on a window.
BOX = """
adf version: 1.0
namespace: /dropped/
bodies: [BODY box]
BODY box:
  name: box
  shape: Box
  geometry: {x: 0.05, y: 0.05, z: 0.05}
  mass: 0.1
  location: {position: {x: 0.1, y: 0.0, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}
"""

WORLD = """
adf version: 1.0
namespace: /test/
gravity: {{x: 0.0, y: 0.0, z: -9.81}}
lights: [lamp]
cameras: [{names}]

lamp:
  name: lamp
  location: {{x: 1.0, y: 1.0, z: 2.0}}
  direction: {{x: -1.0, y: -1.0, z: -2.0}}
"""

CAMERA = """
{name}:
  namespace: cameras/
  name: {name}
  location: {{x: {x}, y: {y}, z: 0.5}}
  look at: {{x: 0.0, y: 0.0, z: 0.0}}
  clipping plane: {{near: 0.01, far: 20.0}}
{extra}
"""

# Things in several colours that stay where they are, different from every side.
THINGS = """
adf version: 1.0
namespace: /test/
bodies: [BODY red, BODY green, BODY blue, BODY floor]
BODY red:
  name: red
  shape: Box
  geometry: {x: 0.1, y: 0.2, z: 0.1}
  mass: 0.0
  color components: {diffuse: {r: 0.8, g: 0.1, b: 0.1}}
  location: {position: {x: 0.0, y: -0.2, z: 0.05}}
BODY green:
  name: green
  shape: Sphere
  geometry: {radius: 0.08}
  mass: 0.0
  color components: {diffuse: {r: 0.1, g: 0.7, b: 0.2}}
  location: {position: {x: 0.05, y: 0.15, z: 0.1}}
BODY blue:
  name: blue
  shape: Cylinder
  geometry: {radius: 0.05, height: 0.3}
  mass: 0.0
  color components: {diffuse: {r: 0.1, g: 0.2, b: 0.8}}
  location: {position: {x: -0.1, y: 0.0, z: 0.15}}
BODY floor:
  name: floor
  shape: Box
  geometry: {x: 1.0, y: 1.0, z: 0.02}
  mass: 0.0
  color components: {diffuse: {r: 0.6, g: 0.6, b: 0.6}}
  location: {position: {x: 0.0, y: 0.0, z: -0.02}}
"""

COLORS = "white: {r: 255, g: 255, b: 255, a: 255}\n"


def write(folder, cameras, things=THINGS):
    """A launch file with these cameras: {name: (x, y, further lines)}; entry 0 of its list are coloured things."""
    names = ", ".join(cameras)
    world = WORLD.format(names=names)
    for name, (x, y, extra) in cameras.items():
        lines = "\n".join("  " + line for line in extra.splitlines())
        world += CAMERA.format(name=name, x=x, y=y, extra=lines)
    (folder / "world.yaml").write_text(world)
    (folder / "things.yaml").write_text(things)
    (folder / "colors.yaml").write_text(COLORS)
    launch = folder / "launch.yaml"
    launch.write_text("world config: ./world.yaml\ncolor config: ./colors.yaml\nmultibody configs: [./things.yaml]\n")
    return launch
