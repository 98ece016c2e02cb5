"""KUKA's LWR 4+ and LBR Med 14, upright at home.

Names, order, types and home frames are those of the original AMBF's files. Numbers: distances between the joints,
limits, masses and torques as published. Chosen, since no source has them in these frames: centres of mass (on the
links' axes), inertias (of cylinders as large as the links), shapes, which are those of arm7.
"""

import math
from dataclasses import dataclass

import adf_kinematics as kinematics
import dvrk_parts as dvrk
import mesh_tools as mt
import robot_files
import scene_arm7 as arm7
from adf_writer import Model, cylinder_inertia, placed, shape_round, vector
from mesh_folder import MeshFolder

HALF = math.pi / 2
FLOOR = -1.65  # m, of the room with the arms of the dVRK
LIMITS = tuple(math.radians(d) for d in (170, 120, 170, 120, 170, 120))


@dataclass
class Link:
    """One link, in the world at home: its body's frame, and where it begins and ends along the arm's axis."""

    name: str
    frame: tuple  # m
    roll: float  # rad: of the frame
    begin: float  # m: height of its joint
    end: float  # m: height of the next one
    axis: tuple  # of its joint
    limit: float  # rad, both ways
    mass: float  # kg
    torque: float  # Nm
    size: float  # of the meshes


def short_flange(height):
    """Disc of an arm whose wrist ends close to the flange."""
    return mt.lathe(
        mt.rounded_profile(
            [(0, 0), (0.040, 0), (0.040, height - 0.006), (0.031, height), (0, height)], [0, 0.002, 0.002, 0.001, 0], 3
        ),
        48,
        "aluminium",
    )


def mesh_of(number, link):
    """In the upright frame at the link's joint."""
    length = link.end - link.begin
    if number == 7:
        return arm7.flange_mesh() if length > 0.04 else short_flange(length)
    return (arm7.odd_mesh if number % 2 else arm7.even_mesh)(length, link.size)


def capsule_of(number, link):
    """(shape, height of its middle above the joint, radius, extent)"""
    length, s = link.end - link.begin, link.size
    radius = (0.07 if number % 2 else 0.056) * s
    if number == 7:
        radius, low, high = 0.04, 0.0, length
    else:
        low, high = (0.0, length + 0.06 * s) if number % 2 else (-0.056 * s, length)
    kind = "CYLINDER" if number >= 6 else "CAPSULE"
    return shape_round(kind, radius, high - low), (low + high) / 2, radius, high - low


def build_arm(models, folder_name, title, base, foot, links, **header):
    """`base`: position of the base body's frame; `foot`: height of the flange that the arm stands on."""
    folder = MeshFolder(models, folder_name)
    model = Model(
        f"{title} (docs/models.md). Gravity does not act on it, as in the original's file; its motors keep their last\n"
        "target.",
        namespace="/ambf/env/",
        meshes=folder.seen_from(3),
        low_resolution=True,
        gravity=vector((0, 0, 0)),
        **header,
    )
    down = (0.0, 0.0, foot - base[2])
    mesh = folder.add("base.obj", arm7.base_mesh().moved(*down))
    folder.add("base.obj", arm7.base_hull_mesh().moved(*down), "low_res")
    model.body("base", base, mesh=mesh, hull="base.obj")
    previous = "base"
    for number, link in enumerate(links, 1):
        turn = kinematics.rpy(-link.roll, 0.0, 0.0)  # from the world's axes to the body's

        def in_body(height, link=link, turn=turn):
            return kinematics.rotate(turn, (base[0] - link.frame[0], base[1] - link.frame[1], height - link.frame[2]))

        shape, middle, radius, extent = capsule_of(number, link)
        across, _, along = cylinder_inertia(link.mass, radius, extent)
        where = in_body(link.begin + middle)
        model.body(
            link.name,
            link.frame,
            (link.roll, 0.0, 0.0),
            mass=link.mass,
            com=where,
            mesh=folder.add(f"{link.name}.obj", mesh_of(number, link).turned(turn).moved(*in_body(link.begin))),
            inertia=(across, across, along) if link.roll == 0.0 else (across, along, across),
            compound=[placed(shape, where, (-link.roll, 0.0, 0.0))],
        )
        limits = {"limits": (-link.limit, link.limit)}
        point = (base[0], base[1], link.begin)
        model.joint(
            f"{previous}-{link.name}",
            "revolute",
            previous,
            link.name,
            point,
            link.axis,
            **limits,
            **dvrk.servo(link.torque),
        )
        previous = link.name
    stand, shapes = dvrk.stand(foot - FLOOR)
    at = (base[0], base[1], foot)
    model.body("stand", at, mesh=folder.add("stand.obj", stand), compound=shapes, passive=True)
    folder.close()
    robot_files.write(model, models, folder_name)


def build_lwr(models):
    x, y, foot = 0.0, 0.0, -1.3
    shoulder = foot + 0.3105
    elbow, wrist = shoulder + 0.400, shoulder + 0.790
    flange = wrist + 0.078
    ends = (foot + 0.1575, shoulder, shoulder + 0.1955, elbow, elbow + 0.1995, wrist, wrist + 0.060, flange)
    # Frames of even links may lie anywhere on the axes of their joints.
    frames = (
        (0.0, 0.0, -1.197),
        (0.0, 0.013, shoulder),
        (0.0, 0.0, -0.794),
        (0.0, -0.009, elbow),
        (0.0, 0.0, -0.390),
        (0.0, -0.053, wrist + 0.007),
        (0.0, 0.0, -0.136),
    )
    rolls, forward, up = (0.0, -HALF, 0.0, HALF, 0.0, -HALF, 0.0), (0, 1, 0), (0, 0, 1)
    axes = (up, forward, up, (0, -1, 0), up, forward, up)
    torques = (176.0, 176.0, 100.0, 100.0, 100.0, 38.0, 38.0)
    limits = (*LIMITS, math.radians(170))
    links = [
        Link(f"link{k + 1}", frames[k], rolls[k], ends[k], ends[k + 1], axes[k], limits[k], 2.0, torques[k], 0.80)
        for k in range(7)
    ]
    title = "KUKA's LWR 4+, 7 x 2 kg"
    build_arm(models, "kuka_lwr", title, (x, y, foot), foot, links, **{"ignore inter-collision": True})


def build_lbr(models):
    x, y = -0.5876, 0.1799
    shoulder = -0.037  # where all frames are within 10 mm of the original's
    foot, elbow, wrist = shoulder - 0.3595, shoulder + 0.420, shoulder + 0.820
    flange = wrist + 0.126
    ends = (foot + 0.1575, shoulder, shoulder + 0.2045, elbow, elbow + 0.1845, wrist, wrist + 0.081, flange)
    frames = (
        (x, y, shoulder - 0.195),
        (x, y, shoulder),
        (x, y, shoulder + 0.217),
        (x, y, elbow),
        (x, y, elbow + 0.198),
        (x, y - 0.0724, wrist),
        (x, y, wrist + 0.090),
    )
    rolls, forward, up = (0.0, -HALF, 0.0, -HALF, 0.0, -HALF, 0.0), (0, 1, 0), (0, 0, 1)
    axes = (up, forward, up, forward, up, forward, up)
    masses = (8.1464, 5.5914, 6.0134, 3.6588, 4.3583, 1.6530, 2.5982)
    limits = (*LIMITS, math.radians(175))
    links = [
        Link(f"Link{k + 1}", frames[k], rolls[k], ends[k], ends[k + 1], axes[k], limits[k], masses[k], 200.0, s)
        for k, s in enumerate(arm7.SCALE)
    ]
    # The original's base lies a metre below its first joint; that is taken for a slip.
    base = (x, y, -0.29008)
    build_arm(models, "kuka_lbr_med", "KUKA's LBR Med 14", base, foot, links, **{"ignore inter-collision": True})


def build(models):
    build_lwr(models)
    build_lbr(models)
