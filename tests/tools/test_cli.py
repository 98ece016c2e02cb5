"""ambf-cli, started as users start it, against a live simulator."""

import json
import re
import subprocess
import sys
import time

import pytest
import scenes
from harness import BENCH_ALLOWED, eventually
from shells import environment

# Its only body is absurdly fast after one step.
BOMB = scenes.model({"Box": scenes.box("Box", 1.0, (0.0, 0.0, 5.0))}) + "\ngravity: {x: 0, y: 0, z: 1.0e+6}\n"


@pytest.fixture
def model(tmp_path):
    """A file with one free body."""
    file = tmp_path / "extra.yaml"
    file.write_text(scenes.model({"Extra": scenes.box("Extra", 1.0, (0.0, 0.0, 3.0))}))
    return file


def test_list_shows_objects_joints_and_models(bench, cli, ask):
    text = cli("list").stdout
    assert re.search(r"/ambf/env/Plate +rigid_body +model.yaml", text) and "/ambf/env/World" in text
    found = ask("list")
    assert {each["name"] for each in found["objects"]} >= {"/ambf/env/Box", "/ambf/env/cameras/eye"}
    assert [each["name"] for each in ask("list", "--joints")] == ["/ambf/env/turn", "/ambf/env/lift"]
    assert [each["name"] for each in ask("list", "*/B*")["objects"]] == ["/ambf/env/Base", "/ambf/env/Box"]
    assert {each["kind"] for each in ask("list", "--kind", "light")["objects"]} == {"light"}
    assert any(each["name"] == "model.yaml" for each in ask("list", "--models"))


def test_info(bench, cli, ask):
    text = cli("info", "Plate").stdout
    assert "mass         1 kg" in text and "joints       1 below it" in text
    assert ask("info", "Plate")["state"]["pose"]["position"]["z"] == pytest.approx(0.2, abs=0.01)
    assert "revolute joint" in cli("info", "turn").stdout
    assert "real time, step" in cli("info").stdout


def test_echo_prints_states_and_fields(bench, cli, ask):
    lines = cli("echo", "Box", "-n", 3, "--field", "pose.position.y", "--json").stdout.split()
    assert [float(line) for line in lines] == pytest.approx([1.0] * 3)
    text = cli("echo", "World", "-n", 2).stdout
    assert text.count("---") == 2 and "sim_step:" in text
    assert "no field" in cli("echo", "Box", "-n", 1, "--field", "pose.nothing", code=2).stderr


def test_joints_are_measured(bench, cli, ask):
    rows = ask("joints", "Base")
    assert [(row["name"], row["type"]) for row in rows] == [("turn", "revolute"), ("lift", "prismatic")]
    assert all(abs(row["position"]) < 0.01 for row in rows)
    assert "turn" in cli("joints", "Base").stdout
    assert "no joints below" in cli("joints", "Box", code=1).stderr


def test_joints_of_a_second_copy_go_by_their_full_names(bench, ask, tmp_path):
    copy = tmp_path / "copy.yaml"
    copy.write_text(scenes.BENCH)
    ask("load", copy, "--pos", 5, 0, 0)
    rows = ask("joints", "Base1")
    assert [(row["name"], row["type"]) for row in rows] == [("turn", "revolute"), ("lift", "prismatic")]
    done = ask("set", "Base1", "--joint", "/ambf/env/turn1=0.3", "--for", 1.5)
    assert done["joints"] == pytest.approx({"/ambf/env/turn1": 0.3}, abs=0.02)
    assert ask("joints", "Base")[0]["position"] == pytest.approx(0.0, abs=0.02)


def test_set_moves_bodies_and_joints(bench, cli, ask):
    done = ask("set", "Table", "--pos", 1, 2, 3, "--rpy", 0, 0, 0.5, "--for", 0.5)
    assert done["position"] == pytest.approx([1, 2, 3]) and done["rpy"] == pytest.approx([0, 0, 0.5])
    done = ask("set", "Base", "--joint", "turn=0.4", "lift=0.02", "--for", 1.5)
    assert done["joints"] == pytest.approx({"turn": 0.4, "lift": 0.02}, abs=0.01)
    before = ask("info", "Box")["state"]["pose"]["position"]["x"]
    ask("set", "Box", "--force", 5, 0, 0, "--for", 0.5)
    assert ask("info", "Box")["state"]["pose"]["position"]["x"] > before + 0.1
    assert "position" in cli("set", "eye", "--pos", 1, 0, 1, "--for", 0.2).stdout


MISTAKES = [
    (["set", "Box"], 2, "nothing to set"),
    (["set", "Box", "--pos", "1", "2", "3", "--force", "1", "0", "0"], 2, "one of pose, force"),
    (["set", "Box", "--pos", "nan", "0", "0"], 2, "no finite number"),
    (["set", "Base", "--joint", "nothing=1"], 1, "has no joint 'nothing'; it has: turn, lift"),
    (["set", "Base", "--joint", "turn"], 2, "NAME=VALUE"),
    (["info", "Bxo"], 1, "did you mean Box"),
    (["info", "e"], 1, "fits several"),
    (["load", "/nowhere.yaml"], 1, "nowhere.yaml"),
    (["unload", "nothing"], 1, "no model"),
    (["remove", "nothing"], 1, "no object"),
    (["restore"], 2, "kept: none"),
    (["restore", "nothing"], 1, "nothing"),
    (["--ns", "/left", "list"], 3, "no AMBF simulator below /left"),
    (["latency", "--objects", "0"], 2, "0 is not between 1 and 200"),
    (["set", "eye", "--force", "1", "0", "0"], 1, "a camera has no force"),
    (["set", "sun", "--angvel", "1", "0", "0"], 1, "a light has no angular velocity"),
    (["set", "eye", "--joint", "turn=1"], 1, "a camera has no joints"),
    (["joints", "eye"], 1, "a camera has no joints"),
    (["record", "re:[", "--for", "1"], 1, "'re:[' is no regular expression"),
    (["record", "--for", "-1"], 2, "--for: -1 must not be negative"),
    (["record", "--min-free", "-1"], 2, "must not be negative"),
    (["set", "Table", "--pos", "1", "0", "0", "--for", "-1e-3"], 2, "--for: -1e-3 must not be negative"),
    (["echo", "Box", "-n", "-1"], 2, "must not be negative"),
    (["echo", "Box", "--rate", "-5"], 2, "must not be negative"),
    (["publish", "Box/Command", "--for", "-1"], 2, "must not be negative"),
    (["set", "Table", "--pos", "-inf", "0", "0"], 2, "-inf is no finite number"),
    (["set", "Table", "--pos", "-1e", "0", "0"], 2, "expected 3 arguments"),
    (["set", "Base", "--joint", "turn=x"], 2, "'x' is no number"),
    (["set", "Table", "--quat", "0", "0", "0", "0"], 2, "zeros are no orientation"),
    (["tf", "--rate", "1e-320"], 2, "1e-320 is not between 0.001 and 1000"),
    ([], 2, "VERB"),
]


def test_mistakes_are_told(bench, cli):
    bench.allowed.append("/nowhere.yaml: error")
    for words, code, says in MISTAKES:
        said = cli(*words, code=code).stderr
        assert says in said and "Traceback" not in said, words


def test_mistakes_are_told_in_json_too(bench, cli):
    told = json.loads(cli("info", "nothing", "--json", code=1).stdout)
    assert told["code"] == 1 and "nothing" in told["error"]


@pytest.mark.parametrize("problem", ["AttributeError('no such\\nthing')", "KeyError('thing')"])
def test_mistakes_of_its_own_take_one_line(run_python, problem):
    program = (
        "import sys; from ambf_tools import read_bag; from ambf_tools.cli.main import main\n"
        f"def broken(_): raise {problem}\n"
        "read_bag.open = broken\n"
        "sys.exit(main(['bag', 'info', 'any.bag', *sys.argv[1:]]))"
    )
    said = run_python("-c", program, code=1).stderr
    assert said.count("\n") == 1 and "<string>:2" in said and "thing" in said, said
    assert said.startswith(f"ambf-cli: unexpected {problem.split('(')[0]}: "), said
    assert json.loads(run_python("-c", program, "--json", code=1).stdout)["code"] == 1


def test_numbers_may_be_negative_and_have_exponents(bench, ask, model):
    done = ask("set", "Table", "--pos", "-0.1", "-2E+0", "-1e-3", "--rpy", "-.5e-1", "0", "0", "--for", "0.5")
    assert done["position"] == pytest.approx([-0.1, -2.0, -1e-3])
    assert done["rpy"] == pytest.approx([-0.05, 0.0, 0.0])
    ask("load", model, "--pos", "-1e-1", "0", "-3.e0")
    assert ask("info", "Extra")["state"]["pose"]["position"]["x"] == pytest.approx(-0.1)


def test_without_a_master_and_without_a_simulator(run_python, master):
    nothing = run_python("-m", "ambf_tools.cli", "list", code=3)
    assert "knows no AMBF simulator" in nothing.stderr


def test_without_a_master(tmp_path):
    env = dict(environment(), ROS_MASTER_URI="http://127.0.0.1:1")
    done = subprocess.run(
        [sys.executable, "-m", "ambf_tools.cli", "list"], env=env, capture_output=True, text=True, timeout=30
    )
    assert done.returncode == 3 and "no ROS master answers at http://127.0.0.1:1" in done.stderr
    assert "Traceback" not in done.stderr


def test_load_unload_remove(bench, cli, ask, model):
    loaded = ask("load", model, "--pos", 0, 0, 2)
    assert loaded[0]["objects"] == ["/ambf/env/Extra"]
    assert ask("info", "Extra")["state"]["pose"]["position"]["z"] == pytest.approx(5.0)
    text = cli("load", model, model, "--prefix", "two").stdout
    assert text.count("1 object,") == 2
    removed = ask("remove", "/ambf/env/Extra")["removed"]
    assert removed == ["/ambf/env/Extra"]
    assert ask("unload", loaded[0]["model"], code=0)["removed"] == []
    models = [each["name"] for each in ask("list", "--models") if each["name"].startswith("extra")]
    assert len(models) == 2
    for name in models:
        ask("unload", name)
    assert not [each for each in ask("list")["objects"] if "Extra" in each["name"]]


def test_save(bench, cli, ask, model, tmp_path):
    loaded = ask("load", model, "--pos", 0, 0, 2)[0]["model"]
    cli("save", loaded, tmp_path / "saved.yaml")
    assert (tmp_path / "saved.yaml").read_bytes() == model.read_bytes()
    assert "it exists" in cli("save", loaded, tmp_path / "saved.yaml", code=1).stderr
    saved = ask("save", loaded, tmp_path / "saved.yaml", "--current-pose", "--overwrite")
    assert saved["size"] == (tmp_path / "saved.yaml").stat().st_size
    assert (tmp_path / "saved.yaml").read_bytes() != model.read_bytes()
    assert ask("save", loaded, tmp_path / "all", "--bundle")["path"] == str(tmp_path / "all" / f"{model.stem}.yaml")
    assert "needs a folder" in cli("save", loaded, "--bundle", code=1).stderr
    ask("unload", loaded)


def test_save_scene(bench, cli, ask, model, tmp_path):
    loaded = ask("load", model)[0]["model"]
    folder = tmp_path / "scene"
    said = cli("save-scene", folder).stdout
    assert f"--launch_file {folder}/launch.yaml -l 0,1" in said
    assert (folder / "models" / model.name).read_bytes() == model.read_bytes()
    assert cli("save-scene", folder).stdout == said, "the same once more costs nothing"
    saved = ask("save-scene", folder, "--current-pose", "--overwrite", "--bundle")
    assert saved["path"] == f"{folder}/launch.yaml"
    ask("unload", loaded)


def test_of_several_files_each_is_told_how_it_went(bench, cli, ask, model):
    bench.allowed.append("/nowhere.yaml: error")
    done = cli("load", "/nowhere.yaml", model, code=1)
    assert done.stdout == "extra.yaml: 1 object, 0 joints\n"
    assert "/nowhere.yaml; error: cannot be read" in done.stderr and "1 of 2 files were not loaded" in done.stderr
    assert "loaded 'extra.yaml'" in bench.log() and "'/nowhere.yaml' was refused" in bench.log()
    assert ask("info", "Extra")["model"] == "extra.yaml"
    told = ask("load", model, "/nowhere.yaml", code=1)
    assert [each["file"] for each in told] == [str(model), "/nowhere.yaml"]
    assert told[0]["model"] == "extra.yaml1" and "error" not in told[0]
    assert "cannot be read" in told[1]["error"] and told[1]["findings"][0]["severity"] == "error"


def test_a_file_is_checked_without_loading_it(bench, cli, ask, model):
    model.write_text(model.read_text().replace("mass: 1.0", "mass: heavy"))
    text = cli("load", model, "--check", code=1).stderr
    assert "extra.yaml" in text and "mass" in text
    assert not [each for each in ask("list")["objects"] if "Extra" in each["name"]]


def test_pause_step_resume(bench, cli, ask):
    at = ask("pause")["sim_step"]
    assert ask("step", 10)["sim_step"] == at + 10
    assert ask("step", 250)["sim_step"] == at + 260  # in several calls
    time.sleep(0.3)
    assert ask("step")["sim_step"] == at + 261
    assert "running" in cli("resume").stdout
    now = ask("info")["sim_step"]
    eventually(lambda: ask("info")["sim_step"] > now, 10, "the world runs")


def test_resume_says_what_halted_a_diverged_world(tmp_path, master, start, cli, ask):
    launch = scenes.write(tmp_path, BOMB)
    start("--launch_file", launch, "-l", "0", master_uri=master.uri, allowed=[*BENCH_ALLOWED, "diverged"])
    eventually(lambda: "/ambf/env/Box/State" in master.published(), 20.0, "the only body")
    eventually(lambda: ask("rates")["halted_by"], 10, "it diverges")
    refused = cli("resume", code=1).stderr
    assert "Box diverged" in refused and "ambf-cli reset" in refused and "window" not in refused


def test_wild_commands_and_bombs_stop_nobody(tmp_path, master, start, cli, ask):
    launch = scenes.write(tmp_path)
    allowed = [*BENCH_ALLOWED, "asks for more than 1000 m/s", "diverged at step"]
    start("--launch_file", launch, "-l", "0", master_uri=master.uri, allowed=allowed)
    eventually(lambda: "/ambf/env/Box/State" in master.published(), 20.0, "the bench")
    for wild in (("--force", 9e8, 0, 0), ("--vel", 0, 0, 1e6), ("--pos", 0, 0, 1e6)):
        cli("set", "Box", *wild, "--for", 0.2)
    assert ask("rates")["halted_by"] == ""
    bomb = tmp_path / "bomb.yaml"
    bomb.write_text(BOMB.replace("Box", "Bomb"))
    cli("load", bomb)
    eventually(lambda: ask("rates")["halted_by"] == "/ambf/env/Bomb is frozen", 10, "it is named")
    at = ask("info")["sim_step"]
    eventually(lambda: ask("info")["sim_step"] > at, 10, "the world goes on")


def test_snapshot_restore_reset(bench, cli, ask, tmp_path):
    ask("pause")
    kept = ask("snapshot", "here", "--file", tmp_path / "state.bin")
    assert (tmp_path / "state.bin").stat().st_size > 0 and ask("list", "--snapshots") == ["here"]
    ask("step", 50)
    assert ask("restore", "here")["sim_step"] == kept["sim_step"]
    ask("step", 50)
    assert ask("restore", "--file", tmp_path / "state.bin")["sim_step"] == kept["sim_step"]
    ask("forget", "here")
    assert ask("list", "--snapshots") == []
    assert "here" in cli("forget", "here", code=1).stderr
    ask("resume")
    ask("set", "Box", "--pos", 0, 3, 0, "--for", 0.5)
    cli("reset")
    assert ask("info", "Box")["state"]["pose"]["position"]["y"] == pytest.approx(1.0, abs=0.01)
    steps = ask("info")["sim_step"]
    cli("reset", "--bodies")
    assert ask("info")["sim_step"] >= steps


def test_rates(bench, cli, ask):
    rates = ask("rates")
    assert 0.5 < rates["real_time_factor"] < 1.5 and rates["solver"] == "direct"
    assert re.search(r"physics +SCHED_", cli("rates").stdout)


def test_commands(bench, cli, ask):
    assert "nothing has been commanded" in cli("commands").stdout
    ask("set", "Box", "--force", 0, 0, 1, "--for", 1.5)
    (box,) = ask("commands")["objects"]
    assert box["name"] == "/ambf/env/Box" and box["source"] == "topic"
    assert box["received"] == box["applied"] + box["coalesced"] > 10
    assert box["periods"] > 0 and 0.0 < box["period_least"] <= box["period_mean"] <= box["period_most"] < 0.5
    assert re.search(r"/ambf/env/Box +topic +", cli("commands").stdout)


def test_a_name_is_looked_for_among_objects_and_joints_together(bench, cli, ask):
    several = cli("info", "li", code=1).stderr
    assert "'li' fits several objects and joints: " in several
    assert "/ambf/env/Slide" in several and "/ambf/env/lift" in several
    assert cli("remove", "li", code=1).stderr == several
    assert ask("info", "lift")["type"] == "prismatic" and ask("info", "Slide")["kind"] == "rigid_body"


def test_a_verb_with_a_typing_error_gets_the_nearest_one(cli):
    said = cli("lst", code=2).stderr
    assert "there is no verb 'lst'; did you mean list?" in said and "snapshot" not in said.splitlines()[-1]
    assert "there is no verb 'xyzzy'; there are: list, info" in cli("xyzzy", code=2).stderr


def test_targets_are_held_on_request(bench, cli, ask, ros):
    """The arm of a turntable is pushed aside when its command has ended, or comes back to where it is held."""
    from ambf_msgs.msg import RigidBodyState

    plate = ros.listen("/ambf/env/Base/State", RigidBodyState)
    assert "keeps its position target" in cli("set", "turn", "--hold").stdout
    assert "is let go" in cli("set", "turn", "--no-hold").stdout
    for hold in (True, False):
        ask("set", "Base", "--joint", "turn=0.5", "--hold" if hold else "--no-hold", "--for", 1.5)
        time.sleep(0.8)  # the watchdog's time
        ask("set", "Plate", "--torque", 0, 0, 1, "--for", 1)
        time.sleep(2.0)
        assert (abs(plate.last().joint_positions[0] - 0.5) < 0.05) == hold
    assert "no body or joint" in cli("set", "cameras/eye", "--hold", code=1).stderr


def test_two_simulators_are_told_apart(bench, cli, ask, start, master, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    left = start(
        "--launch_file", scenes.write(other, scenes.cubes(1)), "-l", "0", "--ns", "/left", master_uri=master.uri
    )
    eventually(lambda: "/left/ambf/env/World/State" in master.published(), 20)
    assert "choose by --ns" in cli("list", code=2).stderr
    assert ask("--ns", "/left", "list")["world"] == "/left/ambf/env/World"
    assert ask("list", "--ns", "/ambf")["world"] == "/ambf/env/World"
    left.stop()


def complete(line):
    """What bash would offer behind this line."""
    env = dict(environment(), _ARGCOMPLETE="1", COMP_LINE=line, COMP_POINT=str(len(line)), _ARGCOMPLETE_IFS="\n")
    script = "import sys; from ambf_tools.cli.main import main; sys.argv[0] = 'ambf-cli'; sys.exit(main())"
    command = ["bash", "-c", '"$0" -c "$1" 8>&1 9>/dev/null', sys.executable, script]
    done = subprocess.run(command, env=env, capture_output=True, text=True, timeout=30)
    return [word.strip() for word in done.stdout.split("\n") if word.strip()]


def test_completion(bench, master, cli):
    assert set(complete("ambf-cli re")) >= {"record", "remove", "reset", "restore", "resume"}
    assert complete("ambf-cli info Pl") == ["Plate"]
    assert complete("ambf-cli set Base --joint tu") == ["turn="]
    assert "/ambf/env/Plate" in complete("ambf-cli info /ambf/env/P")
    assert complete("ambf-cli unload mod") == ["model.yaml"]
    assert "--joint-vel" in complete("ambf-cli set Box --j")
    assert "complete" in cli("completion", "bash").stdout


def test_output_into_a_closed_pipe_is_no_error(bench, master):
    line = f"{sys.executable} -m ambf_tools.cli echo World | head -n 1"
    done = subprocess.run(["bash", "-c", line], env=environment(), capture_output=True, text=True, timeout=30)
    assert "Traceback" not in done.stderr
