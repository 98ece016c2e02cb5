"""Robots written as URDF, against KDL. AMBF_KDL_TREES=1000 is the long run."""

import math
import os
import random
import subprocess
from dataclasses import dataclass
from pathlib import Path

import harness
import numpy as np
import pytest
import yaml

kdl = pytest.importorskip("PyKDL", reason="needs Debian's python3-pykdl")
kinematics = pytest.importorskip("ambf_client.kinematics")

TREES = int(os.environ.get("AMBF_KDL_TREES", "2"))
LINKS = 30
TYPES = ("revolute", "prismatic", "continuous", "fixed")


@dataclass
class Link:
    parent: int
    type: str
    xyz: list[float]
    rpy: list[float]
    axis: list[float]
    mass: float
    com: list[float]
    com_rpy: list[float]
    moments: list[float]  # xx, yy, zz, xy, xz, yz


def vector(rng, size=1.0):
    return [rng.uniform(-size, size) for _ in range(3)]


def angles(rng):
    """A third of all are right angles, where roll, pitch and yaw meet."""
    return [rng.choice([-1, 0, 1]) * math.pi / 2 for _ in range(3)] if rng.random() < 0.3 else vector(rng, math.pi)


def random_link(rng, number):
    axis = vector(rng) if rng.random() < 0.5 else rng.choice([[1, 0, 0], [0, -1, 0], [0, 0, 1]])
    length = math.hypot(*axis)
    principal = [0.01 + 0.02 * rng.random() for _ in range(3)]
    products = vector(rng, 0.003)
    return Link(
        rng.randrange(max(number, 1)),
        rng.choice(TYPES),
        vector(rng, 0.3),
        angles(rng),
        [each / length for each in axis],
        0.1 + rng.random(),
        vector(rng, 0.1),
        angles(rng),
        principal + products,
    )


def words(numbers):
    return " ".join(repr(float(each)) for each in numbers)


def urdf_of(links):
    text = '<robot name="tree">'
    for i, link in enumerate(links):
        xx, yy, zz, xy, xz, yz = link.moments
        text += (
            f'<link name="l{i}"><inertial><origin xyz="{words(link.com)}" rpy="{words(link.com_rpy)}"/>'
            f'<mass value="{link.mass!r}"/><inertia ixx="{xx!r}" iyy="{yy!r}" izz="{zz!r}" ixy="{xy!r}" ixz="{xz!r}" '
            f'iyz="{yz!r}"/></inertial></link>'
        )
        if i > 0:
            text += (
                f'<joint name="j{i}" type="{link.type}"><origin xyz="{words(link.xyz)}" rpy="{words(link.rpy)}"/>'
                f'<parent link="l{link.parent}"/><child link="l{i}"/><axis xyz="{words(link.axis)}"/>'
                '<limit lower="-2" upper="2" effort="50" velocity="1"/></joint>'
            )
    return text + "</robot>"


def kdl_tree_of(links):
    tree = kdl.Tree("l0")
    for i, link in enumerate(links[1:], start=1):
        at = kdl.Frame(kdl.Rotation.RPY(*link.rpy), kdl.Vector(*link.xyz))
        kind = {"prismatic": kdl.Joint.TransAxis, "fixed": kdl.Joint.Fixed}.get(link.type, kdl.Joint.RotAxis)
        # As kdl_parser does it: the axis in the parent's frame, the joint's origin where the child's is.
        joint = (
            kdl.Joint(f"j{i}", kdl.Joint.Fixed)
            if kind == kdl.Joint.Fixed
            else kdl.Joint(f"j{i}", at.p, at.M * kdl.Vector(*link.axis), kind)
        )
        assert tree.addSegment(kdl.Segment(f"l{i}", joint, at), f"l{link.parent}")
    return tree


def kdl_inertia_of(link):
    """Mass, centre of mass and the tensor about the link's origin, in its axes."""
    at = kdl.Frame(kdl.Rotation.RPY(*link.com_rpy), kdl.Vector(*link.com))
    inertia = at * kdl.RigidBodyInertia(link.mass, kdl.Vector(0, 0, 0), kdl.RotationalInertia(*link.moments))
    tensor, com = inertia.getRotationalInertia(), inertia.getCOG()
    return inertia.getMass(), [com[i] for i in range(3)], [[tensor[3 * i + j] for j in range(3)] for i in range(3)]


def rotation_of(rpy):
    r, p, y = (rpy[key] for key in "rpy")
    return np.array([[kdl.Rotation.RPY(r, p, y)[i, j] for j in range(3)] for i in range(3)])


def inertia_in(block):
    place = block["inertial offset"]
    com = np.array([place["position"][key] for key in "xyz"])
    axes = rotation_of(place["orientation"])
    tensor = axes @ np.diag([block["inertia"][key] for key in ("ix", "iy", "iz")]) @ axes.T
    return block["mass"], com, tensor + block["mass"] * (com @ com * np.eye(3) - np.outer(com, com))


def converted(tmp_path, links, number):
    urdf, adf = tmp_path / f"tree{number}.urdf", tmp_path / f"tree{number}.yaml"
    urdf.write_text(urdf_of(links))
    done = subprocess.run(
        [str(harness.SIMULATOR), "--convert", str(urdf), str(adf)], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return adf


def test_forward_kinematics_masses_and_inertia_of_random_trees_are_those_of_kdl(tmp_path: Path):
    worst_pose = worst_inertia = 0.0
    poses = 0
    for seed in range(TREES):
        rng = random.Random(seed)
        links = [random_link(rng, i) for i in range(LINKS)]
        adf = converted(tmp_path, links, seed)
        blocks = yaml.safe_load(adf.read_text())
        for i, link in enumerate(links[1:], start=1):
            mass, com, tensor = inertia_in(blocks[f"BODY l{i}"])
            kdl_mass, kdl_com, kdl_tensor = kdl_inertia_of(link)
            assert mass == kdl_mass
            worst_inertia = max(worst_inertia, np.abs(com - kdl_com).max(), np.abs(tensor - kdl_tensor).max())
        tree = kdl_tree_of(links)
        tips = sorted(set(range(1, LINKS)) - {link.parent for link in links[1:]})
        for tip in tips[:4]:
            chain = tree.getChain("l0", f"l{tip}")
            if chain.getNrOfJoints() == 0:
                continue
            ours = kinematics.chain_of_adf(adf, "l0", f"l{tip}")
            values = [rng.uniform(-1.5, 1.5) for _ in range(chain.getNrOfJoints())]
            positions, there = kdl.JntArray(len(values)), kdl.Frame()
            for i, value in enumerate(values):
                positions[i] = value
            assert kdl.ChainFkSolverPos_recursive(chain).JntToCart(positions, there) >= 0
            expected = np.array([[there.M[i, j] for j in range(3)] + [there.p[i]] for i in range(3)])
            worst_pose = max(worst_pose, np.abs(ours.forward(np.array(values))[:3] - expected).max())
            poses += 1
    print(f"{TREES} trees, {poses} chains: poses within {worst_pose:.1e}, centres and tensors {worst_inertia:.1e}")
    assert poses >= TREES
    assert worst_pose < 1e-6
    assert worst_inertia < 1e-9
