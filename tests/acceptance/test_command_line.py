"""Flags, exit codes, and files to check."""

import os
import subprocess
import time

import pytest
import scenes
from harness import SIMULATOR


def run(*arguments, **environment):
    env = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
    return subprocess.run(
        [str(SIMULATOR), *map(str, arguments)], capture_output=True, text=True, timeout=120, env={**env, **environment}
    )


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["-p", "abc"], "abc"),
        (["-p", "0"], "phx_frequency"),
        (["-p"], "phx_frequency"),
        (["-g", "maybe"], "maybe"),
        (["-l", "abc"], "abc"),
        (["-l", "-1"], "-1"),
        (["-s", "-2"], "speed"),
        (["-d", "0"], "htx_frequency"),
        (["--no_such_flag"], "no_such_flag"),
        (["stray"], "-a FILE"),
        (["--override_max_comm_freq", "nan"], "override_max_comm_freq"),
        (["--override_max_comm_freq", "10", "--override_min_comm_freq", "20"], "below"),
        (["--solver", "nncg"], "nncg"),
        (["--friction_directions", "3"], "friction_directions"),
        (["--strict"], "--check"),
    ],
)
def test_bad_command_lines_are_refused_clearly(arguments, told):
    result = run(*arguments)
    assert result.returncode == 2, result
    assert told in result.stderr
    assert "--help" in result.stderr
    assert len(result.stderr.splitlines()) <= 3


def test_an_index_beyond_the_launch_file_is_refused(tmp_path):
    result = run("-g", "false", "--no_ros", "--launch_file", scenes.write(tmp_path), "-l", "99")
    assert result.returncode == 2, result
    assert "99" in result.stderr + result.stdout


def test_the_first_model_of_the_launch_file_brings_its_world(tmp_path):
    scenes.write(tmp_path)
    models = "multibody configs: [model.yaml, model.yaml]\n"
    (tmp_path / "heavy.yaml").write_text("namespace: /t/\nmax iterationz: 7\n")  # told by its finding
    (tmp_path / "l.yaml").write_text(models + "world configs: [world.yaml, heavy.yaml]\n")
    common = ("-g", "false", "--no_ros", "--launch_file", tmp_path / "l.yaml", "--run_for", "0.2")
    for models, own in (("0", False), ("1", True), ("1,0", True), ("0,1", False)):
        result = run(*common, "-l", models)
        assert result.returncode == 0, result
        assert ("iterationz" in result.stderr + result.stdout) == own, models


def test_help_and_version():
    result = run("--help")
    assert result.returncode == 0
    for flag in ("--phx_frequency", "--load_multibodies", "--no_ros", "--check", "--override_max_comm_freq"):
        assert flag in result.stdout
    version = run("--version")
    assert version.returncode == 0
    assert version.stdout.startswith("ambf_simulator 3.")


def test_check_prints_findings_and_says_by_its_code_whether_they_are_errors(tmp_path):
    scenes.write(tmp_path)
    good = run("--check", tmp_path / "model.yaml")
    assert (good.returncode, "good" in good.stdout) == (0, True)

    doubtful = tmp_path / "doubtful.yaml"
    doubtful.write_text(scenes.BENCH.replace("  mass: 2.0", "  mass: 2.0\n  colour: red"))
    warned = run("--check", doubtful)
    assert warned.returncode == 0
    assert "warning" in warned.stdout and "colour" in warned.stdout
    line = next(i for i, text in enumerate(doubtful.read_text().splitlines(), 1) if "colour" in text)
    assert f"doubtful.yaml:{line}:" in warned.stdout
    assert run("--check", doubtful, "--strict").returncode == 1

    wrong = tmp_path / "wrong.yaml"
    wrong.write_text(scenes.BENCH.replace("mass: 2.0", "mass: heavy"))
    failed = run("--check", tmp_path / "model.yaml", wrong)
    assert failed.returncode == 1
    assert "error" in failed.stdout and "mass" in failed.stdout and "heavy" in failed.stdout
    assert run("--check", tmp_path / "absent.yaml").returncode == 1


def test_without_a_display_it_says_so_and_runs_headless(tmp_path, start):
    simulator = start(
        *("--launch_file", scenes.write(tmp_path), "-l", "0", "--no_ros"), allowed=["display", "headless"], display=None
    )
    simulator.wait_log("(?i)display")
    time.sleep(0.5)
    assert simulator.running()
    assert simulator.stop()[0] == 0


def test_an_unusable_launch_file_ends_it(tmp_path):
    for name, text in (("absent.yaml", None), ("broken.yaml", "world config: [\n")):
        if text is not None:
            (tmp_path / name).write_text(text)
        result = run("-g", "false", "--no_ros", "--launch_file", tmp_path / name)
        assert result.returncode == 1, result
        assert name in result.stderr + result.stdout


def test_run_for_ends_by_itself_and_tells_what_was_achieved(tmp_path):
    result = run("-g", "false", "--no_ros", "--launch_file", scenes.write(tmp_path), "-l", "0", "--run_for", "0.5")
    assert result.returncode == 0
    assert "real-time factor:" in result.stdout


def test_check_reads_the_meshes(tmp_path):
    (tmp_path / "broken.obj").write_text("v a b c\n")
    model = tmp_path / "meshes.yaml"
    model.write_text(
        "namespace: /t/\nhigh resolution path: ./\nbodies: [BODY A]\n"
        "BODY A: {name: A, mass: 1, mesh: broken.obj, inertia: {ix: 1, iy: 1, iz: 1}}\n"
    )
    result = run("--check", model)
    assert result.returncode == 1
    assert "meshes.yaml:4:" in result.stdout and "broken.obj" in result.stdout and "vertex" in result.stdout


def test_a_launch_file_without_a_world_gets_the_default_one(tmp_path):
    (tmp_path / "launch.yaml").write_text("multibody configs: []\n")
    result = run("-g", "false", "--no_ros", "--launch_file", tmp_path / "launch.yaml", "-a", "", "--run_for", "0.2")
    assert result.returncode == 0, result
    assert "default world" in result.stderr + result.stdout
