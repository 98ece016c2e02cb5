"""A kind of object that the product does not know, in a simulator that knows it: beacon.h says where what is."""

import difflib
import json
import os
import runpy
import shutil
import subprocess
from pathlib import Path

import pytest
import scenes
from harness import BENCH_ALLOWED, ROOT, SIMULATOR, eventually

HERE = Path(__file__).parent
PROGRAM = SIMULATOR.with_name("ambf_simulator_with_beacon")
BEACONS = """\
beacons: [BEACON lamp, BEACON buoy]
BEACON lamp: {name: lamp, parent: BODY tower, position: {x: 0.0, y: 0.0, z: -0.5}, blink rate: 10.0}
BEACON buoy: {name: buoy, position: {x: 5.0, y: 0.0, z: 0.0}, publish frequency: {low: 20}}
"""
LIGHTHOUSE = scenes.model({"tower": scenes.box("tower", 1.0, (0.0, 0.0, 1.0))}) + BEACONS

pytestmark = pytest.mark.skipif(
    shutil.which("rosmaster") is None or not PROGRAM.exists(), reason=f"no rosmaster or no {PROGRAM}"
)


@pytest.fixture
def simulator(tmp_path, master, start, ros, monkeypatch):
    monkeypatch.setattr("harness.SIMULATOR", PROGRAM)
    launch = scenes.write(tmp_path, LIGHTHOUSE)
    made = start("--launch_file", launch, "-l", "0", master_uri=master.uri, allowed=BENCH_ALLOWED)
    made.wait_loaded()
    yield made
    made.stop()
    eventually(lambda: not master.names(), 5.0, "no topics are left behind")


@pytest.fixture
def client(simulator, monkeypatch):
    """A client that knows beacons, until the test ends."""
    from ambf_client import Client, kinds

    monkeypatch.setattr("ambf_client.kinds._handles", dict(kinds._handles))
    runpy.run_path(str(HERE / "beacon.py"))
    with Client() as made:
        yield made


def test_it_publishes_and_takes_commands(simulator, client, ros):
    from std_msgs.msg import Float64

    lamp = client.wait_for("lamp")
    assert type(lamp).__name__ == "Beacon"
    assert lamp.get_identifier() == "/ambf/env/BEACON lamp"
    assert lamp.get_parent_name() == "/ambf/env/tower"
    assert lamp.position.tolist() == [0.0, 0.0, -0.5]
    assert lamp.get_rate() == 10.0
    lamp.set_rate(40.0)
    state = ros.listen("/ambf/env/lamp/State", type(lamp).state_type)
    begin = state.next(lambda m: m.range[0] == 40.0)
    end = state.next(lambda m: m.sim_step > begin.sim_step + 500)
    blinks = 0.001 * (end.sim_step - begin.sim_step) * 40.0
    assert end.measurement[0] - begin.measurement[0] == pytest.approx(blinks, rel=1e-3)

    simulator.allowed.append("refused: the rate is not within")
    ros.talk("/ambf/env/buoy/Command", Float64).publish(Float64(-1.0))
    simulator.wait_log("'/ambf/env/buoy' refused: the rate is not within 0 .. 1000 Hz")
    assert client.wait_for("buoy").get_rate() == 1.0


def test_it_is_listed_reset_and_removed(simulator, client, master):
    lamp = client.wait_for("lamp")
    listed = {each.name: each for each in client.list().objects if each.kind == "beacon"}
    assert sorted(listed) == ["/ambf/env/buoy", "/ambf/env/lamp"]
    assert listed["/ambf/env/lamp"].parent == "/ambf/env/tower"
    assert listed["/ambf/env/lamp"].topic == "/ambf/env/lamp"
    eventually(lambda: lamp.get_phase() > 5.0)
    client.world.reset()
    eventually(lambda: lamp.get_phase() < 5.0)

    loaded = client.load(text=LIGHTHOUSE, name_prefix="/left")
    assert "/left/ambf/env/lamp" in loaded.objects
    assert client.wait_for("/left/ambf/env/lamp").get_parent_name() == "/left/ambf/env/tower"
    assert "/left/ambf/env/lamp" in client.unload(loaded.model)
    assert client.remove("/ambf/env/buoy") == ["/ambf/env/buoy"]
    eventually(lambda: not any("buoy" in name or "left" in name for name in master.names()), 5.0, "topics are gone")
    assert client.list().objects and lamp.wait_for_next_state()


def test_commands_arrive_while_the_client_steps_too(client):
    lamp = client.wait_for("lamp")
    client.world.step(5)
    lamp.set_rate(25.0)

    def commanded():
        client.world.step(5)
        return lamp.get_rate() == 25.0

    eventually(commanded)
    client.world.step(1000)  # longer than the watchdog waits: the command is repeated
    eventually(commanded)
    lamp.clear_cmd()
    assert not lamp.is_commanded()


def test_what_follows_a_snapshot_is_repeated_bit_for_bit(simulator, client, ros, tmp_path):
    from std_msgs.msg import Float64

    from ambf_msgs.msg import SensorState

    world = client.world
    world.step(7)
    state = ros.listen("/ambf/env/lamp/State", SensorState)
    ros.talk("/ambf/env/lamp/Command", Float64).publish(Float64(30.0))
    before = state.next(lambda m: m.range[0] == 30.0)
    kept = world.snapshot("here")
    assert before.sim_step == kept.sim_step

    def go_on(name):
        world.step(600)  # the watchdog ends the command on the way
        shown = state.next(lambda m: m.sim_step == kept.sim_step + 600)
        world.snapshot(path=str(tmp_path / name))
        return shown.measurement, (tmp_path / name).read_bytes()

    first = go_on("first")
    assert first[0][0] - before.measurement[0] == pytest.approx(600 * 0.001 * 30.0, abs=1e-4)
    world.step(20)
    assert world.restore("here").sim_step == kept.sim_step
    assert go_on("second") == first


@pytest.fixture
def window(tmp_path, monkeypatch):
    """The program with a window, and its user."""
    monkeypatch.syspath_prepend(str(HERE.parent / "acceptance/window"))
    x11 = pytest.importorskip("x11")
    import program

    monkeypatch.setattr(program, "SIMULATOR", PROGRAM)
    server = x11.XServer()
    user = x11.User(server.name)
    launch = scenes.write(tmp_path, LIGHTHOUSE)
    shown = program.Simulator(server.name, tmp_path / "log", "--launch_file", launch, "-l", "0")
    yield user
    shown.close()
    user.close()
    server.kill()
    assert "OpenGL:" not in shown.log(), shown.log()


def test_its_key_switches_its_layer_in_the_window(window):
    def pixels():
        """Of the two colours in which a beacon is drawn, as blue, green, red."""
        picture = window.picture()
        colours = [picture[i : i + 3] for i in range(0, len(picture), 4)]
        return colours.count(bytes((51, 230, 255))) + colours.count(bytes((102, 26, 102)))

    window.window()
    eventually(lambda: window.colours() > 30, 30.0, "a scene", 0.1)
    assert pixels() == 0
    window.key("y", "Shift_L")
    eventually(lambda: pixels() > 300, 30.0, "the lamp", 0.1)
    window.key("y", "Shift_L")
    eventually(lambda: pixels() == 0, 30.0, "no lamp", 0.1)


def test_documentation_made_with_it_holds_its_keys_beside_all_others(tmp_path):
    command = [PROGRAM.with_name("ambf_kinds_tests"), "--gtest_filter=MadeUpKind.IsInTheGeneratedDocumentation"]
    subprocess.run(
        command, env={**os.environ, "TEST_TMPDIR": str(tmp_path)}, check=True, capture_output=True, timeout=60
    )
    made = (tmp_path / "adf.md").read_text().splitlines()
    ours = (ROOT / "docs/adf.md").read_text().splitlines()
    changes = [line for line in difflib.unified_diff(ours, made, n=0) if line[:3] not in ("---", "+++")]
    assert [line for line in changes if line.startswith("-")] == []
    assert sum(line.startswith("+| `blink rate`") for line in changes) == 1
    schema = json.loads((tmp_path / "adf.schema.json").read_text())
    known = json.loads((ROOT / "docs/adf.schema.json").read_text())
    assert schema["definitions"].keys() - known["definitions"].keys() == {"beacon"}
    assert {"parent", "position", "blink rate", "name", "passive"} <= schema["definitions"]["beacon"][
        "properties"
    ].keys()


def test_check_names_its_mistakes(tmp_path):
    file = tmp_path / "wrong.yaml"
    file.write_text(LIGHTHOUSE.replace("blink rate: 10.0", "blink rate: often"))
    done = subprocess.run([PROGRAM, "--check", file], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    line = 1 + file.read_text().split("BEACON lamp: {")[0].count("\n")
    assert f"{file}:{line}:" in done.stdout
    assert "error: [BEACON lamp: blink rate] expected a number, found the text 'often'" in done.stdout
    known = subprocess.run([SIMULATOR, "--check", file], capture_output=True, text=True, timeout=60)
    assert "[beacons] unknown key" in known.stdout
