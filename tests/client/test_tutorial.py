"""The code of docs/python.md does what it says."""

import re

import scenes
from harness import ROOT, eventually


def test_the_tutorial_runs(tmp_path, master, start, script, ros):
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(), re.S)
    assert len(blocks) == 4
    crate = tmp_path / "crate.yaml"
    crate.write_text(scenes.model({"Crate": scenes.box("Crate", 1.0, (0.0, 0.0, 0.0))}))
    first, handle, loading, stepping = blocks
    assert "/models/crate.yaml" in loading
    loading = loading.replace("/models/crate.yaml", str(crate))
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
