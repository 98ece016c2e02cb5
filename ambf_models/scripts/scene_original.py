"""Small models for the original's places that no other of our scenes has: its parallel structure and its textured
ground. Names, order, masses and places are those of the original's files, so that old scripts find their objects; the
meshes, shapes that the original leaves to its meshes, and inertias are ours."""

import math

import mesh_tools as mt
import outlines
import shaped_holes as sh
from adf_writer import Model, box_inertia, shape_box
from mesh_folder import MeshFolder
from scene_worlds import View

HALF = math.pi / 2
GROUND, GROUND_Z = (4.0, 4.0, 0.082), -1.3
BAR, BAR_FROM, BAR_TO = 0.138, 0.069, -0.758  # thickness, ends along a link's y
SMALL = 0.04  # of the mark that stands for `world`
X = 0.001
# Links: where their frames are in y and z, how they are turned, and color. Frames are in the middle of a bar's end.
LINKS = {
    "l1": ((-0.360, -0.222), (-HALF, -HALF, -HALF), "coral"),
    "l2": ((-0.498, -0.083), (-HALF, 0.0, -HALF), "amber"),
    "l3": ((-0.361, 0.750), (-HALF, -HALF, -HALF), "sage"),
    "l4": ((0.469, 0.610), (HALF, 0.0, HALF), "sky"),
}
LAST_PIVOT = (0.410, -0.151)  # y, z of the joint that closes the loop
# Of each link in its own x and y: the pivots that lie beside its bar.
LUGS = {
    "l1": ((0.139, 0.138), (0.071, -0.770)),
    "l2": ((-0.137, -0.833),),
    "l3": ((-0.140, -0.830),),
    "l4": ((-0.059, -0.761),),
}


def link_mesh(name):
    """A square bar, and a strap from its end to each pivot beside it."""
    long = BAR_FROM - BAR_TO
    parts = [mt.box(BAR, long, BAR, 0.012, color="shell").moved(y=(BAR_FROM + BAR_TO) / 2)]
    parts.append(mt.cylinder(0.045, BAR + 0.02, 0.006, 28, "steel"))
    for x, y in LUGS[name]:
        end = 0.0 if y > 0 else BAR_TO + BAR / 2
        strap = outlines.stadium(math.hypot(x, y - end), 0.045, 10)
        turned = mt.rotation_about("z", math.atan2(y - end, x))
        for side in (-1, 1):
            plate = mt.extrude(strap, 0.02, 0.004, 2, "graphite").turned(turned)
            parts.append(plate.moved(y=end, z=side * (BAR / 2 + 0.012 if name in ("l1", "l3") else BAR / 2 - 0.03)))
    return mt.joined(parts)


def parallel_structure(folder):
    model = Model(
        "Four links and a loop, whose lowest one is fixed. Names, places and joints as in the original's\n"
        "parallel_structure; frames: in the end of each bar, y along it, outwards. World is a mark at the origin.",
        "/ambf/env/",
        folder.seen_from(1),
        **{"ignore inter-collision": True},
    )
    mark = (shape_box(SMALL, SMALL, SMALL), (0, 0, 0), (0, 0, 0))
    names = {"publish joint names": True, "publish joint positions": True}
    model.body("world", mesh="mark.obj", shape=mark, friction=(0.5, 0.01), **names)
    long, middle = BAR_FROM - BAR_TO, (0.0, (BAR_FROM + BAR_TO) / 2, 0.0)
    for name, ((y, z), turned, color) in LINKS.items():
        model.body(
            name,
            (X, y, z),
            turned,
            mass=1.0,
            inertia=box_inertia(1.0, BAR, long, BAR),
            com=(0.0, -0.344, 0.0),
            mesh=f"{name}.obj",
            color=color,
            shape=(shape_box(BAR, long, BAR), middle, (0, 0, 0)),
        )
    gains = {"controller": {"P": 1000.0, "I": 0.0, "D": 50.0}}
    across = (1.0, 0.0, 0.0)

    def at(link):
        return (X, *LINKS[link][0])

    model.joint("world-l1", "fixed", "world", "l1", at("l1"), across, **gains)
    for parent, child in (("l1", "l2"), ("l2", "l3"), ("l3", "l4")):
        name = f"{parent}-{child}"
        model.joint(name, "revolute", parent, child, at(child), across, limits=(-1.047, 1.047), **gains)
    model.joint("l1-l4", "continuous", "l1", "l4", (X, *LAST_PIVOT), across, redundant=True, **gains)
    return model


def ground(folder):
    model = Model(
        "A square of oak planks, 4 m wide, its top at z = -1.259; name and place as in the original's TexturedGround.",
        "/ambf/env/Ground/",
        folder.seen_from(1),
        **{"ignore inter-collision": False},
    )
    model.body(
        "Cube",
        (0.0, 0.0, GROUND_Z),
        mesh="ground.obj",
        shape=(shape_box(*GROUND), (0, 0, 0), (0, 0, 0)),
        friction=(0.5, 0.01),
        restitution=0.0,
        **{"collision margin": 0.001, "collision groups": [0]},
    )
    return model


def build(models):
    out = models / "original"
    out.mkdir(parents=True, exist_ok=True)
    folder = MeshFolder(models, "original")
    for name in LINKS:
        folder.add(f"{name}.obj", link_mesh(name))
    folder.add("mark.obj", mt.box(SMALL, SMALL, SMALL, 0.006, color="graphite"))
    folder.add("ground.obj", mt.extrude(outlines.rectangle(GROUND[0], GROUND[1], 0.02, 3), GROUND[2], 0.008, 2, "oak"))
    folder.close()
    parallel_structure(folder).write(out / "parallel_structure.yaml")
    ground(folder).write(out / "textured_ground.yaml")
    view = View((2.1, 1.25, -0.35), (-0.05, 0.0, -1.28), 0.5)
    title = "The low room with the floor's middle in view."
    world = sh.world(title, "../descriptions/world/lab_low_room.yaml", (0.0, 0.0, -1.2), 0.9, view)
    (out / "world.yaml").write_text(world, encoding="utf-8")
    title = "The second car and sophie of the original's launch file; one at a time."
    files = [f"./{name}.yaml" for name in ("toy_car2", "sophie")]
    (out / "launch.yaml").write_text(sh.launch(title, "world.yaml", files), encoding="utf-8")
