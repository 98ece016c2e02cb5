"""Verbs of ambf-cli that go on for a while: recordings and measurements, and how they end."""

import json
import os
import re
import resource
import signal
import subprocess
import sys
import time

import pytest
from ambf_tools import read_bag
from harness import eventually
from shells import environment


def test_record_and_bag(bench, cli, ask, tmp_path):
    names = ("--subject", "Ann", "--study", "peg", "-o", tmp_path)
    done = ask("record", "/ambf/env/*/State", "--for", 1, "--min-free", 0, *names)
    assert done["complete"] and done["lost"] == 0
    assert re.fullmatch(r"Ann_peg_\d{4}(-\d\d){5}\.bag", os.path.basename(done["path"]))
    with read_bag.open(done["path"]) as bag:
        assert "/ambf/env/Plate/State" in bag.topics
    assert "/ambf/env/Plate/State" in cli("bag", "info", done["path"]).stdout
    checked = ask("bag", "check", done["path"])
    assert checked["/ambf/env/Plate/State"]["lost"] == 0 and checked["/ambf/env/Plate/State"]["messages"] > 20
    text = cli("record", "/never", "--for", 0.5, "--min-free", 0, "-o", tmp_path / "b.bag").stdout
    assert "nobody sent anything: /never" in text
    text = cli("record", "*/Stat", "*/State", "--for", 1, "--min-free", 0, "-o", tmp_path / "d.bag").stdout
    assert "no topic fits */Stat\n" in text and "no topic fits */State" not in text
    assert "is no bag" in cli("bag", "info", __file__, code=1).stderr
    for action in ("info", "check", "repair"):
        assert "is no file" in cli("bag", action, "/dev/zero", code=1).stderr


def test_a_recording_goes_nowhere_but_where_there_is_a_place_for_it(bench, cli, ask, tmp_path):
    where = ("--for", 0.5, "--min-free", 0, "-o")
    for words in (("a/b/x.bag",), ("a/b/", "--subject", "Ann")):
        assert "there is no folder" in cli("record", *where, tmp_path / words[0], *words[1:], code=1).stderr
    assert not (tmp_path / "a").exists()
    assert ask("record", *where, tmp_path / "study", "--subject", "Ann")["complete"]


def test_a_recording_that_the_disk_ends_has_failed(bench, cli, tmp_path):
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, hard))
    try:
        said = cli("record", "--for", 30, "--min-free", 0, "-o", tmp_path / "x.bag", code=1)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert "cut short: the disk refused" in said.stderr
    with read_bag.open(tmp_path / "x.bag") as bag:
        assert bag.topics


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_recording_ended_by_a_signal_is_complete(bench, master, tmp_path, number):
    """Also one that a script started in the background, where shells switch SIGINT off."""
    program = [sys.executable, "-m", "ambf_tools.cli", "record", "--min-free", "0", "-o", tmp_path / "c.bag"]
    command = ["env", "--ignore-signal=INT", *program]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, env=environment(), **pipes) as process:
        eventually((tmp_path / "c.bag.active").exists, 20)
        eventually(lambda: (tmp_path / "c.bag.active").stat().st_size > 20_000, 20)
        process.send_signal(number)
        out, err = process.communicate(timeout=30)
    assert process.returncode == 0, out + err
    assert "0 lost" in out
    with read_bag.open(tmp_path / "c.bag") as bag:
        assert bag.topics["/ambf/env/Box/State"].messages > 0


@pytest.mark.parametrize("words", [("record", "--min-free", "0"), ("rates", "--watch"), ("latency", "--for", "20")])
def test_one_interrupted_early_ends_quietly(bench, master, tmp_path, words):
    """Whatever it is importing, connecting to or starting then."""
    # -X importtime reports when its own code begins: before, Python itself starts, and prints tracebacks.
    command = [sys.executable, "-X", "importtime", "-m", "ambf_tools.cli", *words]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    for moment in range(5):
        with subprocess.Popen(command, env=environment(), cwd=tmp_path, **pipes) as process:
            begun = any("ambf_tools.cli.entry" in line for line in process.stdout)
            assert begun
            time.sleep(0.02 + 0.07 * moment)
            process.send_signal(signal.SIGINT)
            out, _ = process.communicate(timeout=30)
        assert "Traceback" not in out and "built" not in out, (moment, out)
        assert process.returncode in (0, 1, 130, -signal.SIGINT), (moment, out)


def test_an_interrupt_waits_for_the_end_of_an_import(tmp_path):
    """Python's import lock drops exceptions that arise while it is let go, and the program would go on."""
    (tmp_path / "slow.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\nwhole = True\n")
    program = (
        "import time\nfrom ambf_tools.cli import main\nmain._interruptible()\n"
        "try:\n    import slow\n    print('whole', slow.whole, flush=True)\n    time.sleep(20)\n"
        "except KeyboardInterrupt:\n    print('interrupted')\n"
    )
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, env=environment(), cwd=tmp_path, capture_output=True, text=True, timeout=30)
    assert done.stdout.split("\n") == ["whole True", "interrupted", ""], done.stderr


def test_killed_recordings_are_repaired(bench, cli, master, tmp_path):
    command = [sys.executable, "-m", "ambf_tools.recording.engine"]
    settings = {"path": str(tmp_path / "d.bag"), "patterns": ["/ambf/env/*/State"], "min_free_bytes": 0}
    process = subprocess.Popen(
        [*command, json.dumps(settings)], env=environment(), stdin=subprocess.PIPE, stdout=subprocess.DEVNULL
    )
    active = tmp_path / "d.bag.active"
    eventually(lambda: active.exists() and active.stat().st_size > 50_000, 20)
    process.kill()
    process.wait()
    assert "is complete" in cli("bag", "repair", tmp_path / "d.bag").stdout
    assert "Box/State" in cli("bag", "info", tmp_path / "d.bag").stdout


def test_latency_measures_and_draws(bench, cli, ask, tmp_path):
    from PIL import Image

    picture = tmp_path / "l.png"
    rows = ask("latency", "--objects", "1,3", "--queues", "1,10", "--for", 0.5, "--png", picture)
    assert [(row["objects"], row["queue"]) for row in rows] == [(1, 1), (1, 10), (3, 1), (3, 10)]
    for row in rows:
        assert 0 < row["one_way_p50_ms"] <= row["round_trip_p50_ms"] < 1000
        assert row["states_per_second"] > 0
    with Image.open(picture) as image:
        assert image.width > 500
    # What was loaded for it is gone.
    assert not [each for each in ask("list")["objects"] if "latency" in each["name"]]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_latency_ended_by_a_signal_leaves_no_probes(bench, master, ask, tmp_path, number):
    """SIGHUP: its terminal was closed."""

    def probes():
        return [each for each in ask("list")["objects"] if "latency" in each["name"]]

    command = [sys.executable, "-m", "ambf_tools.cli", "latency", "--objects", "2", "--queues", "1", "--for", "60"]
    command = ["env", "--default-signal", *command]  # tests run under nohup, too, where hang-ups are ignored
    with subprocess.Popen(command, env=environment(), cwd=tmp_path, stderr=subprocess.DEVNULL) as process:
        eventually(probes, 30.0, "probes are there")
        process.send_signal(number)
        assert process.wait(30) == 130
    assert not probes()
