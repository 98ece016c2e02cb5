"""Instruments of a PSM are exchanged while all runs: nothing jumps; kinematics, jaw and limits are the new ones."""

import math

import numpy as np
import pytest
import yaml
from ambf_client import instruments, rotations
from ambf_client.kinematics import load_arm
from harness import ROOT

MODELS = ROOT / "ambf_models"
PSM = MODELS / "descriptions/multi-bodies/robots/psm.yaml"
WORDS = sorted(instruments.INSTRUMENTS)


def short(name):
    return name.rpartition("/")[2].replace(" ", "")


class Arm:
    """A PSM in a world of this process."""

    def __init__(self):
        from ambf_core import World

        self.world = World(PSM, world=MODELS / "descriptions/world/empty_world.yaml")
        self.namespace = "/ambf/env/psm/"
        self.arm = load_arm("PSM")
        self.model = None  # that the last exchange brought

    def positions(self):
        measured = self.world.state.joint_position
        return {short(name): float(q) for name, q in zip(self.world.joints, measured, strict=True)}

    def pose(self, body):
        x, y, z, qx, qy, qz, qw = self.world.state.body_pose[self.world.body(self.namespace + body)]
        made = np.identity(4)
        made[:3, :3], made[:3, 3] = rotations.matrix_from_quaternion([qx, qy, qz, qw]), (x, y, z)
        return made

    def go(self, joints, opening, steps=2500):
        rows = {short(name): row for row, name in enumerate(self.world.joints)}
        for name, value in self.arm.to_adf(joints, opening).items():
            self.world.commands.set_joints([value], joints=[self.world.joints[rows[short(name)]]])
        self.world.step(steps)

    def measured(self):
        now = self.positions()
        return self.arm.from_adf({name: now[short(name)] for name in self.arm.to_adf(self.arm.home)})

    def exchange(self, word):
        pose, positions = self.pose(instruments.CARRIER), self.positions()
        if self.model:
            self.world.unload(self.model)
        for name in [each for each in self.world.bodies if short(each).startswith("tool")]:
            self.world.remove(name)
        self.model = self.world.load(text=instruments.mounted(word, self.namespace, pose, positions))
        self.arm = load_arm("PSM", instruments.INSTRUMENTS[word].tool)


@pytest.fixture(scope="module")
def psm():
    pytest.importorskip("_ambf_core")
    return Arm()


@pytest.mark.parametrize("word", [word for word in WORDS if word != "lnd"] + ["lnd"])
def test_an_exchange_moves_nothing_and_brings_its_kinematics(psm, word):
    psm.go([0.3, -0.2, 0.13, 0.9, 0.4, -0.3], 0.5)
    before = psm.positions()
    rest = {each: psm.pose(short(each)) for each in psm.world.bodies if "psm/" in each and "tool" not in each}
    psm.exchange(word)
    for steps in (1, 200):
        psm.world.step(steps)
        now = psm.positions()
        assert max(abs(now[name] - q) for name, q in before.items() if name in now) < math.radians(0.01)
        assert {name for name in now if "apart" not in name} == {name for name in before if "apart" not in name}
        assert max(np.linalg.norm(psm.pose(short(each))[:3, 3] - pose[:3, 3]) for each, pose in rest.items()) < 1e-4
    wanted = np.array([-0.4, 0.3, 0.16, -1.2, 0.5, 0.4])
    psm.go(wanted, 0.6)
    joints, opening = psm.measured()
    assert np.abs(joints - wanted).max() < 1e-3 and abs(opening - 0.6) < 1e-3
    tip = np.linalg.inv(psm.pose("baselink")) @ psm.pose("toolgripper1link")
    assert np.linalg.norm(tip[:3, 3] - psm.arm.forward(joints)[:3, 3]) < 1e-4
    answer = psm.arm.inverse(psm.arm.forward(joints), seed=joints)
    assert np.abs(answer.joints - joints).max() < 1e-6


def test_inside_the_cannula_nothing_touches(psm):
    psm.go([0.1, 0.1, 0.005, 0.0, 0.0, 0.0], 0.0)
    psm.exchange("prograsp")
    before = psm.positions()
    psm.world.step(300)
    assert psm.world.state.contact_count == 0
    assert max(abs(q - before[name]) for name, q in psm.positions().items() if name in before) < 1e-4


@pytest.mark.parametrize("word", WORDS)
def test_files_have_the_wrist_and_the_limits_of_their_tool(word):
    model = yaml.safe_load(instruments.file_of(word).read_text(encoding="utf-8"))
    arm = load_arm("PSM", instruments.INSTRUMENTS[word].tool)
    assert model["JOINT tool pitch link-tool gripper1 link"]["parent pivot"]["x"] == pytest.approx(arm.rows[5].a)
    for number in (1, 2):
        limits = model[f"JOINT tool pitch link-tool gripper{number} link"]["joint limits"]
        assert limits["low"] == pytest.approx(arm.lower[5] + 0.5 * arm.jaw.lower)
        assert limits["high"] == pytest.approx(arm.upper[5] + 0.5 * arm.jaw.upper)
    names = [name for name in model["joints"] if "apart" not in name]
    original = yaml.safe_load(PSM.read_text(encoding="utf-8"))
    for name in names:
        ours, theirs = model[name], original[name]
        assert ours["max motor impulse"] == theirs["max motor impulse"] and ours["controller"] == theirs["controller"]


def test_the_needle_driver_is_that_of_the_psm():
    model = yaml.safe_load(instruments.file_of("lnd").read_text(encoding="utf-8"))
    original = yaml.safe_load(PSM.read_text(encoding="utf-8"))
    for block in model["bodies"]:
        same = {key: value for key, value in original[block].items() if key != "mesh"}
        assert {key: value for key, value in model[block].items() if key != "mesh"} == same


def test_words_and_arms_are_found_by_their_names():
    assert instruments.word_of("PROGRASP_FORCEPS:400093") == instruments.word_of("ProGrasp") == "prograsp"
    assert instruments.word_of("large_needle_driver") == "lnd"
    with pytest.raises(KeyError, match="spoon"):
        instruments.word_of("spoon")
    two = ["/ambf/env/psm1/main insertion link", "/ambf/env/psm2/maininsertionlink", "/ambf/env/ecm/baselink"]
    for arm in ("PSM2", "psm2", "/ambf/env/psm2/"):
        assert instruments.namespace_of(arm, two) == "/ambf/env/psm2/"
    assert instruments.namespace_of("PSM1", ["/ambf/env/psm/maininsertionlink"]) == "/ambf/env/psm/"
    with pytest.raises(KeyError, match="PSM3"):
        instruments.namespace_of("PSM3", two)
