"""World files: the room or the bench, lights and cameras, one world for each scene and `world.yaml` for all others.

The operator stands at +x and looks along -x, so +y is to the right. Light comes from three sides, as in a studio: a key
light from the right casts the shadows, a wide fill light comes from the windows on the left, and a light from behind
draws the edges. They stand around what is looked at, further away the larger that is.
"""

from dataclasses import dataclass, field

from adf_writer import block, vector
from textures import FOLDER, SKY_FACES


@dataclass
class View:
    location: tuple
    look_at: tuple
    angle: float  # rad, vertical
    more: dict = field(default_factory=dict)  # further keys of the camera block


@dataclass
class World:
    name: str
    title: str
    environment: str
    focus: tuple
    size: float  # m: half of what is to be seen
    cameras: dict  # of View by name; the first is the main one


WORLDS = [
    World(
        "world",
        "The world of models that bring none: a room with its floor at z = 0 and a grid of 0.1 m.",
        "lab_room",
        (0.0, 0.0, 0.2),
        0.9,
        {"main_camera": View((1.75, 1.0, 1.15), (0.0, 0.0, 0.22), 0.7)},
    ),
    World(
        "four_bar_world",
        "The bench with the four-bar linkage in view.",
        "lab_bench",
        (0.0, 0.0, 0.17),
        0.3,
        {"main_camera": View((0.92, 0.36, 0.48), (0.0, 0.01, 0.20), 0.50)},
    ),
    World(
        "peg_transfer_world",
        "The bench with the peg board in view. close_camera looks at the pegs from the operator's right.",
        "lab_bench",
        (0.0, 0.0, 0.06),
        0.2,
        {
            "main_camera": View((0.44, 0.0, 0.315), (0.0, 0.0, 0.070), 0.45),
            "close_camera": View((0.33, 0.22, 0.17), (0.0, 0.0, 0.062), 0.55, {"visible": False}),
        },
    ),
    World(
        "two_views_world",
        "The bench with the peg board, seen by two people at once: the operator, and the assistant beside the board\n"
        "# (on the second monitor where there is one).",
        "lab_bench",
        (0.0, 0.0, 0.06),
        0.2,
        {
            "operator_camera": View((0.44, 0.0, 0.315), (0.0, 0.0, 0.070), 0.45),
            "assistant_camera": View((0.10, 0.42, 0.24), (0.0, 0.0, 0.060), 0.5, {"monitor": 1}),
        },
    ),
    World(
        "two_users_world",
        "The bench with the peg board, for two people at once: a window each, and a camera without one whose axes are\n"
        "# the world's, for a partner that moves by itself.",
        "lab_bench",
        (0.0, 0.0, 0.06),
        0.2,
        {
            "operator_camera": View((0.44, 0.0, 0.315), (0.0, 0.0, 0.070), 0.45),
            "assistant_camera": View((0.10, 0.42, 0.24), (0.0, 0.0, 0.060), 0.5, {"monitor": 1}),
            "partner_camera": View((0.5, 0.0, 0.1), (0.0, 0.0, 0.1), 0.45, {"visible": False}),
        },
    ),
    World(
        "stereo_world",
        "The bench with the peg board through a stereo endoscope: both eyes side by side in the window, and each\n"
        "# as a stream of pictures. They are 5 mm apart; what is 0.22 m away, near the middle of the board, is in the\n"
        "# same place of both.",
        "lab_bench",
        (0.0, 0.0, 0.06),
        0.2,
        {
            "endoscope": View(
                (0.205, 0.0, 0.165),
                (0.0, 0.0, 0.052),
                0.85,
                {
                    "stereo": {"mode": "PASSIVE_LEFT_RIGHT", "eye separation": 0.005, "focal length": 0.22},
                    "publish image": True,
                    "publish image interval": 2,
                    "publish image resolution": {"width": 640, "height": 480},
                },
            ),
        },
    ),
    World(
        "ring_wire_world",
        "The bench with the ring on its wire in view.",
        "lab_bench",
        (0.0, 0.0, 0.08),
        0.15,
        {"main_camera": View((0.50, 0.0, 0.25), (0.0, 0.0, 0.080), 0.44)},
    ),
    World(
        "arm7_world",
        "The room with the seven-joint arm in view.",
        "lab_room",
        (-0.3, 0.0, 0.4),
        0.7,
        {"main_camera": View((1.20, 0.98, 0.80), (-0.30, -0.02, 0.385), 0.50)},
    ),
    World(
        "stewart_platform_world",
        "The bench with the Stewart platform in view.",
        "lab_bench",
        (0.0, 0.0, 0.17),
        0.3,
        {"main_camera": View((0.86, 0.36, 0.54), (0.0, 0.0, 0.155), 0.55)},
    ),
    World(
        "two_finger_world",
        "The bench with the two-finger gripper in view.",
        "lab_bench",
        (0.0, 0.0, 0.2),
        0.15,
        {"main_camera": View((0.44, 0.24, 0.30), (0.0, 0.0, 0.205), 0.46)},
    ),
    World(
        "cubes_300_world",
        "The room with 300 cubes in view.",
        "lab_room",
        (0.0, 0.0, 0.0),
        1.0,
        {"main_camera": View((1.75, 0.70, 0.85), (0.06, 0.03, -0.02), 0.60)},
    ),
    World(
        "toy_car_world",
        "The room with the toy car in view.",
        "lab_room",
        (0.0, 0.0, 0.05),
        0.25,
        {"main_camera": View((0.58, 0.06, 0.24), (0.0, 0.0, 0.040), 0.46)},
    ),
    World(
        "grasps_world",
        "The bench with the two hands and what they hold in view.",
        "lab_bench",
        (0.0, 0.0, 0.2),
        0.3,
        {"main_camera": View((1.05, 0.46, 0.52), (0.0, 0.0, 0.205), 0.54)},
    ),
    World(
        "magnet_world",
        "The bench with the magnet's crane in view.",
        "lab_bench",
        (0.0, 0.0, 0.15),
        0.25,
        {"main_camera": View((0.78, 0.34, 0.44), (0.0, 0.0, 0.145), 0.50)},
    ),
    World(
        "door_world",
        "The bench with the cabinet in view.",
        "lab_bench",
        (0.0, 0.0, 0.17),
        0.25,
        {"main_camera": View((1.08, 0.3, 0.5), (0.08, -0.04, 0.155), 0.48)},
    ),
    World(
        "ghost_world",
        "The bench with the gate, the needle and the tank in view.",
        "lab_bench",
        (0.0, 0.0, 0.1),
        0.2,
        {"main_camera": View((0.62, 0.3, 0.34), (0.0, 0.01, 0.095), 0.50)},
    ),
    World(
        "slope_world",
        "The bench with the slope in view.",
        "lab_bench",
        (0.0, 0.0, 0.1),
        0.25,
        {"main_camera": View((0.72, 0.52, 0.4), (0.0, 0.0, 0.09), 0.50)},
    ),
    World(
        "stick_slip_world",
        "The bench with the block on its board in view.",
        "lab_bench",
        (0.0, 0.0, 0.0),
        0.3,
        {"main_camera": View((0.62, 0.12, 0.38), (0.0, 0.0, 0.015), 0.54)},
    ),
    World(
        "screwdriver_world",
        "The bench with the two hands on the screwdriver in view.",
        "lab_bench",
        (0.0, 0.0, 0.2),
        0.3,
        {"main_camera": View((1.02, 0.62, 0.52), (-0.10, 0.0, 0.255), 0.52)},
    ),
    World(
        "thread_world",
        "The bench with the thread, its pegs and the two hands in view.",
        "lab_bench",
        (0.05, 0.0, 0.08),
        0.3,
        {"main_camera": View((0.46, 0.17, 0.47), (0.055, 0.0, 0.060), 0.56)},
    ),
    World(
        "rover_world",
        "The room with the rover in view, and room to drive.",
        "lab_room",
        (0.0, 0.0, 0.15),
        0.9,
        {"main_camera": View((1.6, 0.96, 0.92), (0.06, 0.0, 0.10), 0.54)},
    ),
    World(
        "cloth_world",
        "The bench with the cloth over its stand in view.",
        "lab_bench",
        (0.0, 0.0, 0.1),
        0.25,
        {"main_camera": View((0.74, 0.36, 0.42), (0.02, 0.015, 0.11), 0.41)},
    ),
    *(
        World(
            f"{hands}_world",
            f"The bench with the two hands above {below} in view.",
            "lab_bench",
            (0.0, 0.0, 0.12),
            0.3,
            {"main_camera": View((0.80, 0.30, 0.42), (-0.04, 0.0, 0.185), 0.50)},
        )
        for hands, below in (("cloth_two_hands", "their cloth"), ("cloth_two_hands_tissue", "a sheet of tissue"))
    ),
    World(
        "tissue_world",
        "The bench with the dish of tissue in view.",
        "lab_bench",
        (0.0, 0.0, 0.05),
        0.2,
        {"main_camera": View((0.42, 0.20, 0.30), (0.0, 0.0, 0.025), 0.40)},
    ),
    World(
        "incision_world",
        "The bench with the block of tissue, scalpel and needle in view. close_camera looks at the cut.",
        "lab_bench",
        (0.0, 0.0, 0.04),
        0.2,
        {
            "main_camera": View((0.16, -0.24, 0.20), (-0.005, 0.0, 0.045), 0.50),
            "close_camera": View((0.055, -0.115, 0.115), (0.0, 0.0, 0.026), 0.42, {"visible": False}),
        },
    ),
    World(
        "thread_over_pegs_world",
        "The bench with the thread over its pegs in view.",
        "lab_bench",
        (0.0, 0.0, 0.08),
        0.2,
        {"main_camera": View((0.455, 0.125, 0.215), (0.0, 0.0, 0.074), 0.42)},
    ),
    World(
        "suture_pad_world",
        "The bench with the pad, the needle and its thread in view. close_camera looks at the wound.",
        "lab_bench",
        (0.0, 0.0, 0.04),
        0.2,
        {
            "main_camera": View((0.10, -0.26, 0.17), (0.020, 0.0, 0.033), 0.47),
            "close_camera": View((0.055, -0.165, 0.115), (0.006, 0.0, 0.041), 0.47, {"visible": False}),
        },
    ),
    World(
        "needle_drive_world",
        "The PSM's jaws, and the pad into which they drive a needle, in view.",
        "lab_low_room",
        (0.4, 0.5141, -0.78),
        0.2,
        {"main_camera": View((0.47, 0.41, -0.70), (0.405, 0.514, -0.778), 0.44)},
    ),
    World(
        "peritoneum_world",
        "The bench with the membrane, the organs below it and the forceps in view.",
        "lab_bench",
        (0.0, 0.0, 0.04),
        0.2,
        {"main_camera": View((0.20, -0.32, 0.25), (0.0, 0.004, 0.050), 0.50)},
    ),
    World(
        "gallbladder_world",
        "The bench with the gallbladder on its liver, the membrane over it and the instruments in view.",
        "lab_bench",
        (0.0, 0.0, 0.06),
        0.2,
        {"main_camera": View((0.24, 0.19, 0.20), (0.0, 0.0, 0.058), 0.52)},
    ),
    World(
        "swab_world",
        "The bench with the liver, the omentum over its thin end, the swab before it and the instruments in view.\n"
        "# close_camera looks at where the swab is laid.",
        "lab_bench",
        (0.0, 0.0, 0.05),
        0.2,
        {
            "main_camera": View((0.32, 0.16, 0.26), (-0.005, 0.0, 0.052), 0.48),
            "close_camera": View((0.13, 0.07, 0.15), (-0.022, 0.002, 0.048), 0.50, {"visible": False}),
        },
    ),
    World(
        "psm_world",
        "The room with the patient side manipulator in view.",
        "lab_low_room",
        (0.5, 0.85, -0.6),
        0.6,
        {"main_camera": View((1.95, 0.22, -0.12), (0.5, 0.84, -0.56), 0.52)},
    ),
    World(
        "ecm_world",
        "The room with the endoscope's arm in view.",
        "lab_low_room",
        (0.5, -0.75, -0.5),
        0.6,
        {"main_camera": View((1.95, -0.22, 0.05), (0.5, -0.92, -0.47), 0.56)},
    ),
    World(
        "mtmr_world",
        "The room with the right master tool manipulator in view.",
        "lab_low_room",
        (-0.3, 0.0, -0.2),
        0.6,
        {"main_camera": View((0.62, 0.95, 0.12), (-0.34, -0.01, -0.26), 0.56)},
    ),
    World(
        "mtml_world",
        "The room with the left master tool manipulator in view.",
        "lab_low_room",
        (-0.3, -0.5, -0.2),
        0.6,
        {"main_camera": View((0.01, -1.80, 0.12), (-0.34, -0.49, -0.26), 0.56)},
    ),
    World(
        "original_world",
        "The world of launch_original.yaml: a floor as low as the original's, for arms that reach below z = 0, and a\n"
        "# camera where its camera is.",
        "lab_low_room",
        (0.0, 0.0, -0.5),
        1.6,
        {"main_camera": View((4.0, 0.0, 2.0), (0.0, 0.0, -0.5), 0.7)},
    ),
    World(
        "suj_world",
        "The room with the patient cart in view.",
        "lab_room",
        (0.5, 0.0, 0.9),
        1.6,
        {"main_camera": View((3.67, 2.70, 2.1), (0.45, 0.0, 0.75), 0.60)},
    ),
    World(
        "kuka_lwr_world",
        "The room with the LWR 4+ in view.",
        "lab_low_room",
        (0.0, 0.0, -0.7),
        0.9,
        {"main_camera": View((2.94, 0.21, -0.25), (0.0, 0.0, -0.76), 0.56)},
    ),
    World(
        "kuka_lbr_med_world",
        "The room with the LBR Med 14 in view.",
        "lab_low_room",
        (-0.59, 0.18, 0.2),
        0.9,
        {"main_camera": View((2.54, 0.73, 0.75), (-0.59, 0.18, 0.2), 0.56)},
    ),
    World(
        "neuro_robot_world",
        "The room with the robot for needles under MRI in view.",
        "lab_low_room",
        (0.21, -0.04, 0.12),
        0.3,
        {"main_camera": View((0.86, -0.80, 0.46), (0.205, -0.040, 0.140), 0.52)},
    ),
    World(
        "raven2_world",
        "The bench with the Raven II's arms in view.",
        "lab_bench",
        (0.05, 0.0, 0.35),
        0.5,
        {"main_camera": View((2.00, 0.62, 1.02), (0.05, 0.0, 0.445), 0.52)},
    ),
    World(
        "pr2_world",
        "The room with the PR2 in view, its floor under the wheels.",
        "lab_sunk_room",
        (-0.35, 0.0, 0.1),
        0.9,
        {"main_camera": View((2.05, 1.35, 0.95), (-0.33, 0.0, 0.13), 0.60)},
    ),
    World(
        "pr2_gripper_world",
        "The room with the PR2's gripper in view.",
        "lab_low_room",
        (0.3, 0.0, -0.5),
        0.3,
        {"main_camera": View((0.30, -0.33, -0.06), (0.292, -0.012, -0.5), 0.56)},
    ),
    World(
        "pr2_gripper_small_red_world",
        "The room with the PR2's small red gripper in view.",
        "lab_low_room",
        (0.38, 0.0, -0.5),
        0.25,
        {"main_camera": View((0.38, 0.30, -0.24), (0.368, -0.003, -0.5), 0.50)},
    ),
]

# name: (direction from what is looked at to the light, distance in sizes, at least so many metres away, cutoff angle,
# exponent, shadow quality)
LIGHTS = {
    "key light": ((0.55, 0.45, 1.0), 4.5, 1.4, 1.2, 0.3, 4),
    "fill light": ((0.35, -1.0, 0.75), 5.0, 2.0, 1.4, 0.0, 0),
    "back light": ((-1.0, 0.25, 0.9), 5.0, 2.0, 1.4, 0.0, 0),
}


def light(world, name):
    toward, sizes, min_distance, cutoff, exponent, quality = LIGHTS[name]
    length = sum(v * v for v in toward) ** 0.5
    distance = max(sizes * world.size, min_distance)
    offset = [round(distance * v / length, 3) for v in toward]
    return {
        "namespace": "lights/",
        "name": name.replace(" ", "_"),
        "location": vector([round(f + o, 3) for f, o in zip(world.focus, offset, strict=True)]),
        "direction": vector([-o for o in offset]),
        "spot exponent": exponent,
        "cutoff angle": cutoff,
        "shadow quality": quality,
    }


def camera(name, view):
    return {
        "namespace": "cameras/",
        "name": name,
        "location": vector(view.location),
        "look at": vector(view.look_at),
        "up": vector((0, 0, 1)),
        "clipping plane": {"near": 0.01, "far": 30.0},
        "field view angle": view.angle,
        "monitor": 0,
        **view.more,
    }


def text(world):
    lines = [
        f"# {world.title}",
        "# Generated by ambf_models/scripts/generate.py: change the script, not this file.",
        "adf version: 1.0",
        "namespace: /ambf/env/",
        f"environment: ./{world.environment}.yaml",
        "gravity: {x: 0.0, y: 0.0, z: -9.81}",
        f"lights: [{', '.join(LIGHTS)}]",
        f"cameras: [{', '.join(world.cameras)}]",
    ]
    faces = {face: f"sky_{face}.png" for face in SKY_FACES}
    lines += [block("skybox", {"path": f"../../meshes/{FOLDER}/", **faces})]
    for name in LIGHTS:
        lines += ["", block(name, light(world, name))]
    for name, view in world.cameras.items():
        lines += ["", block(name, camera(name, view))]
    return "\n".join(lines) + "\n"


def build(models):
    folder = models / "descriptions" / "world"
    folder.mkdir(parents=True, exist_ok=True)
    for world in WORLDS:
        (folder / f"{world.name}.yaml").write_text(text(world), encoding="utf-8")
