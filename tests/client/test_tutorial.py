"""The code of docs/python.md and of the tutorials does what it says."""

import re

import pytest
import scenes
from harness import ROOT, eventually

from ambf_msgs.msg import RigidBodyState


def test_the_tutorial_runs(tmp_path, master, start, script, ros):
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)
    assert len(blocks) == 4
    crate = tmp_path / "crate.yaml"
    crate.write_text(scenes.model({"Crate": scenes.box("Crate", 1.0, (0.0, 0.0, 0.0))}))
    first, handle, loading, stepping = blocks
    assert "/models/crate.yaml" in loading
    assert "/models/new.yaml" in loading
    loading = loading.replace("/models/crate.yaml", str(crate)).replace("/models/new.yaml", str(tmp_path / "new.yaml"))
    start("-l", "1,2", master_uri=master.uri, allowed=["WatchDog", "warning"])
    eventually(lambda: "/ambf/env/World/Step" in master.state()[2], 20.0)
    text = "def policy(positions, velocities):\n    return positions * 0.99\n\n"
    text += first + handle + "\nclient = Client()\nclient.connect()\n"
    text += loading + "\nprint('loaded', crate.get_name())\n"
    text += stepping.replace("range(1000)", "range(200)") + "\nclient.clean_up()\nprint('done')\n"
    tutorial = script(text, master.uri)
    assert tutorial.finish(120.0) == 0, tutorial.text()
    assert "loaded /ambf/env/Crate" in tutorial.text()
    assert "Crate is gone" in tutorial.text()
    assert tutorial.text().endswith("done")
    assert (tmp_path / "new.yaml").is_file()


def blocks_of(page):
    return re.findall(r"```python\n(.*?)```", (ROOT / "docs" / page).read_text(), re.S)


def test_the_first_scene_script_and_plot(tmp_path, master, start, script, ros):
    scene = ROOT / "ambf_models/descriptions/first_scene.yaml"
    start("-a", scene, master_uri=master.uri)
    eventually(lambda: "/ambf/env/table/State" in master.published(), 20.0)
    moving, looking = blocks_of("first_script.md")
    first = script(moving, master.uri)
    assert first.finish() == 0, first.text()
    assert first.lines[:2] == ["['turn', 'lift']", "the boom is at 1.2 rad"], first.text()
    assert 0.01 < float(re.search(r"slid ([-\d.]+) m", first.text()).group(1)) < 0.3
    camera = script(looking, master.uri)
    assert camera.finish() == 0 and camera.lines[-1].startswith("(480, 640, 3) "), camera.text()
    # The boom stayed up though the script has ended, and its commands long have.
    table = ros.listen("/ambf/env/table/State", RigidBodyState)
    assert table.last().joint_positions[1] == pytest.approx(1.2, abs=0.02)

    recording, plotting = blocks_of("bag_to_plot.md")
    inside = f"import os\nos.chdir({str(tmp_path)!r})\n"
    recorder = script(inside + recording, master.uri)
    assert recorder.finish() == 0 and recorder.lines[-1].endswith(" 0 lost"), recorder.text()
    plot = script(inside + plotting, master.uri)
    assert plot.finish() == 0, plot.text()
    assert (tmp_path / "barrier.png").stat().st_size > 10_000
