"""Flags, exit codes, and files to check."""

import os
import subprocess
import time
from pathlib import Path

import pytest
import scenes
from harness import SIMULATOR

ROOT = Path(__file__).resolve().parents[2]


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
        (["--check"], "--check needs a FILE"),
        (["--check", "--strict"], "--check needs a FILE"),
        (["--check", "model.yaml", "--strickt", "other.yaml"], "--strickt"),
        (["--screenshot", "--at", "1"], "--screenshot needs a FILE"),
        (["--convert"], "two files"),
        (["--convert", "arm.urdf"], "two files"),
        (["--convert", "a.urdf", "--merge-fixed", "b.yaml", "c.yaml"], "two files"),
        (["--screenshot", "--at", "1", "picture.gif"], "picture.gif"),
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


def test_an_empty_place_of_the_launch_file_is_refused_and_the_others_load(tmp_path):
    scenes.write(tmp_path)
    (tmp_path / "places.yaml").write_text('multibody configs: ["", model.yaml]\n')
    common = ("-g", "false", "--no_ros", "--launch_file", tmp_path / "places.yaml", "--run_for", "0.1")
    result = run(*common, "-l", "0")
    assert result.returncode == 2, result
    assert "-l 0: that place of" in result.stderr + result.stdout
    assert run(*common, "-l", "1").returncode == 0


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
    for arguments in (
        ("--check", doubtful, "--strict"),
        ("--check", "--strict", doubtful),
        ("--strict", "--check", tmp_path / "model.yaml", doubtful),
        ("--check", tmp_path / "model.yaml", "--strict", "--log_file", tmp_path / "log.txt", doubtful),
    ):
        strict = run(*arguments)
        assert (strict.returncode, strict.stderr) == (1, "") and "colour" in strict.stdout, arguments
    assert run("--check", "--strict", tmp_path / "model.yaml").returncode == 0

    wrong = tmp_path / "wrong.yaml"
    wrong.write_text(scenes.BENCH.replace("mass: 2.0", "mass: heavy"))
    failed = run("--check", tmp_path / "model.yaml", wrong)
    assert failed.returncode == 1
    assert "error" in failed.stdout and "mass" in failed.stdout and "heavy" in failed.stdout
    assert run("--check", tmp_path / "absent.yaml").returncode == 1


INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
ARM = f"""\
<robot name="arm">
  <link name="base"/>
  <link name="fore arm">{INERTIAL}</link>
  <link name="tool">{INERTIAL}</link>
  <joint name="elbow" type="continuous"><parent link="base"/><child link="fore arm"/></joint>
  <joint name="flange" type="fixed"><parent link="fore arm"/><child link="tool"/></joint>
</robot>
"""


def test_a_urdf_robot_is_converted_and_nothing_is_ever_overwritten(tmp_path):
    urdf, adf = tmp_path / "arm.urdf", tmp_path / "arm.yaml"
    urdf.write_text(ARM)
    result = run("--convert", urdf, adf)
    assert (result.returncode, "written" in result.stdout) == (0, True), result
    assert "BODY tool" in adf.read_text()
    assert run("--check", adf).returncode == 0
    adf.write_text("mine")
    assert (run("--convert", urdf, adf).returncode, adf.read_text()) == (1, "mine")
    merged = tmp_path / "merged.yaml"
    assert run("--convert", "--merge-fixed", "--free-base", urdf, merged).returncode == 0
    assert "BODY tool" not in merged.read_text()
    assert "mass: 0\n" not in merged.read_text()
    refused = run("--convert", merged, tmp_path / "twice.yaml")
    assert refused.returncode == 1 and "no URDF" in refused.stdout
    run_on = run("-g", "false", "--no_ros", "-a", urdf, "--merge-fixed", "--run_for", "0.2")
    assert run_on.returncode == 0, run_on


FOLLOWING = """\
  <link name="mirror">{INERTIAL}</link>
  <joint name="knee" type="continuous"><parent link="base"/><child link="mirror"/><mimic joint="elbow"/></joint>
</robot>
"""


def test_a_solver_without_a_row_for_followers_says_which_joint_moves_freely(tmp_path):
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(ARM.replace("</robot>\n", FOLLOWING.replace("{INERTIAL}", INERTIAL)))
    world = ("-g", "false", "--no_ros", "--launch_file", scenes.write(tmp_path), "-a", urdf, "--run_for", "0.1")
    for solver in ("si", "mlcp"):
        result = run(*world, "--solver", solver)
        assert result.returncode == 0, result
        found = [line for line in (result.stdout + result.stderr).splitlines() if "does not follow" in line]
        assert len(found) == 1, result
        for part in ("arm.urdf:8:", '"knee"', "JOINT elbow", f"({solver})", "--solver direct"):
            assert part in found[0], (part, found)
    good = run(*world)
    assert good.returncode == 0 and "does not follow" not in good.stdout + good.stderr, good


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


def test_ros_arguments_are_taken_as_roslaunch_gives_them(tmp_path):
    arguments = ("-g", "false", "--no_ros", "--launch_file", scenes.write(tmp_path), "-l", "0", "--run_for", "0.2")
    result = run(*arguments, "__name:=simulator", "__log:=/tmp/log")
    assert result.returncode == 0 and ":=" not in result.stdout + result.stderr, result
    result = run(*arguments, "/ambf/env/Box/State:=/box", "__name:=simulator")
    assert result.returncode == 0
    assert "'/ambf/env/Box/State:=/box' has no effect" in result.stdout + result.stderr


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


# Each is told by loading; the checker must say the same, or `--strict` passes what warns.
DOUBTFUL = """\
namespace: /t/
bodies: [BODY A, BODY B, BODY C, BODY D]
joints: [J, K]
cameras: [C1, C2, C3]
BODY A: {name: A, mass: 1, mesh: painted.obj, high resolution path: ./, low resolution path: ./}
BODY B:
  name: B
  mass: 0.01
  shape: Box
  geometry: {x: 0.1, y: 0.1, z: 0.1}
  collision shape: Box
  collision geometry: {x: 0.1, y: 0.1, z: 0.1}
  controller output type: FORCE
  controller: {linear: {P: 100, D: 1}, angular: {P: 1, D: 5}}
BODY C: {name: C, mass: 0}
BODY D: {name: D, mass: 10, inertia: {ix: 10, iy: 10, iz: 10}}
J: {name: J, type: revolute, parent: BODY C, child: BODY D, controller: {P: 1.0e+9, D: 1.0e+9}, PIVOTS}
K: {name: K, type: fixed, parent: BODY A, child: BODY A, PIVOTS}
C1: {name: C1, parent: C2, location: {x: 1, y: 0, z: 0}}
C2: {name: C2, parent: C1, location: {x: 1, y: 0, z: 0}}
C3: {name: C3, parent: C3, location: {x: 1, y: 0, z: 0}}
""".replace(
    "PIVOTS",
    "parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0}, "
    "parent axis: {x: 0, y: 0, z: 1}, child axis: {x: 0, y: 0, z: 1}",
)
PAINTED = """\
mtllib PAINT.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
usemtl gold
f 1 2 3
f 1 2 4
f 1 3 4
f 2 3 4
"""


def findings(text, file):
    """Warnings and errors about this file, as they are written."""
    lines = (line[line.index(file) :] for line in text.splitlines() if f"{file}:" in line)
    return sorted(line for line in lines if ": warning:" in line or ": error:" in line)


@pytest.mark.parametrize(("paint", "complaints"), [("absent", 2), ("empty", 1)])
def test_check_says_what_loading_says(tmp_path, paint, complaints):
    scenes.write(tmp_path)
    (tmp_path / "painted.obj").write_text(PAINTED.replace("PAINT", paint))
    (tmp_path / "empty.mtl").write_text("newmtl silver\n")
    (tmp_path / "doubtful.yaml").write_text(DOUBTFUL)
    checked = run("--check", tmp_path / "doubtful.yaml")
    loaded = run(
        *("-g", "false", "--no_ros", "--launch_file", tmp_path / "launch.yaml"),
        *("-a", tmp_path / "doubtful.yaml", "--run_for", "0.1"),
    )
    told = findings(checked.stdout, "doubtful.yaml")
    assert told == findings(loaded.stderr + loaded.stdout, "doubtful.yaml")
    assert sum("[BODY A: mesh]" in line and "gold" in line for line in told) == 1, told
    assert sum("[BODY A: mesh]" in line for line in told) == complaints, told
    for part in (
        "[BODY B: controller] gains cannot be stable",
        "same body",
        '[C2: parent] "C1" hangs on this one',
        "[C3: parent] it cannot hang on itself",
    ):
        assert sum(part in line for line in told) == 1, (part, told)
    assert not [line for line in told if "[J" in line], "gains of joints act implicitly: none is too large"
    assert "of this file is called" not in checked.stdout


def test_a_file_that_is_no_model_is_not_loaded_as_one(tmp_path):
    scenes.write(tmp_path)
    launch_told = "this is a launch file, no model (start with --launch_file"
    for file, told in (("launch.yaml", launch_told), ("world.yaml", "this is a world file, no model")):
        result = run(
            *("-g", "false", "--no_ros", "--launch_file", tmp_path / "launch.yaml"),
            *("-a", tmp_path / file, "--run_for", "0.1"),
        )
        text = result.stderr + result.stdout
        assert told in text and "was refused" in text, text
        assert result.returncode == 1
        assert f"loaded '{file}'" not in text and "unknown key" not in text, text


def test_a_model_named_on_the_command_line_that_cannot_be_read_ends_the_program(tmp_path):
    launch = scenes.write(tmp_path)
    common = ("-g", "false", "--no_ros", "--launch_file", launch, "--run_for", "0.2")
    for files in ("nope.yaml", f"{tmp_path / 'model.yaml'},nope.yaml"):
        result = run(*common, "-a", files)
        assert result.returncode == 1 and "nope.yaml" in result.stderr + result.stdout, result
    launch.write_text(launch.read_text() + "  - ./nope.yaml\n")
    assert run(*common, "-l", "1").returncode == 0, "what a launch file lists is reported, and the rest runs"


def test_a_launch_file_without_a_world_gets_the_default_one(tmp_path):
    (tmp_path / "launch.yaml").write_text("multibody configs: []\n")
    result = run("-g", "false", "--no_ros", "--launch_file", tmp_path / "launch.yaml", "-a", "", "--run_for", "0.2")
    assert result.returncode == 0, result
    assert "default world" in result.stderr + result.stdout


@pytest.mark.skipif(SIMULATOR.parent != ROOT / "build/bin", reason="./dev run builds the release tree")
def test_dev_run_prints_nothing_but_the_program_does_on_stdout(tmp_path):
    scenes.write(tmp_path)
    checked = subprocess.run(
        [ROOT / "dev", "run", "--check", tmp_path / "model.yaml"], capture_output=True, text=True, timeout=300
    )
    assert checked.returncode == 0, checked
    assert checked.stdout == run("--check", tmp_path / "model.yaml").stdout
    assert "building" in checked.stderr
