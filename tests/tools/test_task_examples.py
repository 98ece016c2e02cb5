"""The experts of ambf_client_py/examples/tasks: each does its task, started as its first lines say."""

import re

import pytest
from harness import BENCH_ALLOWED, ROOT, eventually

EXAMPLES = ROOT / "ambf_client_py/examples/tasks"
LAUNCH = ROOT / "ambf_models/descriptions/launch_tasks.yaml"
STUDIES = ROOT / "ambf_models/studies"


@pytest.fixture
def expert(start, master, run_python):
    def run(indices, topic, name, *words, launch=LAUNCH):
        start("--launch_file", launch, "-l", indices, master_uri=master.uri, allowed=BENCH_ALLOWED)
        eventually(lambda: topic in master.published(), 30, topic)
        return run_python(EXAMPLES / name, *words).stdout

    return run


def test_every_expert_is_tested():
    tested = set(re.findall(r'"(\w+_expert\.py)"', (ROOT / "tests/tools/test_task_examples.py").read_text()))
    assert tested == {file.name for file in EXAMPLES.glob("*_expert.py")}


def test_a_ring_goes_from_hand_to_hand_to_its_peg(expert):
    out = expert("1,2", "/ambf/env/one_ring/State", "peg_transfer_expert.py", "one_ring", "--seed", 3)
    assert "0 drops, 1 hand-overs" in out and "1 of 1 done" in out


def test_the_ring_is_led_along_its_wire(expert):
    out = expert("0", "/ambf/env/ring_wire/lead/State", "ring_wire_expert.py")
    assert "done in" in out and "1 of 1 done without a touch" in out


def test_four_hands_put_the_plate_over_its_pegs(expert):
    launch = STUDIES / "launch_four_hands.yaml"
    out = expert("0,1,2", "/ambf/env/four_hands/State", "four_hands_expert.py", "--plate", launch=launch)
    assert "0 drops" in out and "1 of 1 done" in out


def test_a_piece_of_the_practice_scene_goes_into_its_cavity(expert):
    launch, topic = STUDIES / "launch_practice.yaml", "/ambf/env/each_in_its_cavity/State"
    out = expert("0,1,2", topic, "practice_expert.py", "--pieces", "Cylinder_A", launch=launch)
    assert "1 of 1 pieces" in out and "1 of 1 done" in out


def test_a_triangle_goes_from_peg_to_peg(expert):
    out = expert("5,6,14", "/ambf/icl/a_b_c_a/State", "triangles_expert.py", "a_b_c_a", "--moves", 1)
    assert "0 drops" in out and "1 of 1 done" in out


def test_the_screwdriver_turns_its_disc(expert):
    launch, topic = STUDIES / "launch_screwdriver_env.yaml", "/ambf/env/ScrewDriverEnv/turn_the_disc/State"
    out = expert("0,1,2", topic, "screwdriver_expert.py", launch=launch)
    assert "0 drops" in out and "1 of 1 done" in out
