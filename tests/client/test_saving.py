"""Models are written as ADF: the user's text, edited where something has changed."""

import os

import pytest
from ambf_client import RequestRefused

TEXT = """# Mine: two crates and a weld.
adf version: 1.0
namespace: /ambf/env/
bodies: [BODY Crate, BODY Lid]  # both
joints: []
my own block: {kept: in full}
BODY Crate:
  name: Crate
  mass: 1.0   # kg
  shape: BOX
  geometry: {x: 0.2, y: 0.2, z: 0.2}
  location:
    position: {x: 4.0, y: 4.0, z: 2.0}
    orientation: {r: 0.3, p: 0.0, y: 0.0}
BODY Lid: {name: Lid, mass: 0, location: {position: {x: 4.0, y: 4.0, z: 0.0}, orientation: {r: 0, p: 0, y: 0}}}
"""


@pytest.fixture
def crates(tmp_path):
    file = tmp_path / "crates.yaml"
    file.write_text(TEXT)
    return file


def test_unchanged_it_is_the_same_bytes_and_a_removed_body_leaves_its_list(bench, client, crates, tmp_path):
    loaded = client.load(crates, pose=[0.0, 0.0, 1.0, 0.0, 0.0, 0.0])
    saved = client.save(loaded, tmp_path / "same.yaml")
    assert (tmp_path / "same.yaml").read_text() == TEXT
    assert saved.path == str(tmp_path / "same.yaml") and saved.size == len(TEXT)
    client.remove("/ambf/env/Lid")
    client.save(loaded, overwrite=True)
    assert crates.read_text() == TEXT.replace(", BODY Lid]", "]")


def test_at_the_current_pose_it_loads_where_it_was(bench, client, crates, tmp_path):
    loaded = client.load(crates, pose=[0.0, 1.0, 1.0, 0.0, 0.0, 0.5])
    client.world.step(20)  # the crate falls; from now on the world waits
    crate = client.get_obj_handle("Crate")
    position, rotation = [*crate.position], [*crate.orientation]
    client.save(loaded, tmp_path / "now.yaml", current_pose=True)
    before, after = TEXT.splitlines(), (tmp_path / "now.yaml").read_text().splitlines()
    changed = [number for number, pair in enumerate(zip(before, after, strict=True)) if pair[0] != pair[1]]
    assert changed == [12, 13, 14]  # places alone
    client.unload(loaded)
    client.load(tmp_path / "now.yaml")
    crate = client.get_obj_handle("Crate")
    assert crate.position == pytest.approx(position, abs=1e-9)
    assert crate.orientation == pytest.approx(rotation, abs=1e-9)


def test_no_file_is_lost(bench, client, crates, tmp_path):
    loaded = client.load(crates)
    taken = tmp_path / "taken.yaml"
    taken.write_text("precious")
    with pytest.raises(RequestRefused, match="it exists"):
        client.save(loaded, taken)
    assert taken.read_text() == "precious"
    with pytest.raises(RequestRefused, match="not an ordinary file"):
        client.save(loaded, tmp_path, overwrite=True)
    with pytest.raises(RequestRefused, match="No such file or directory"):
        client.save(loaded, tmp_path / "absent/a.yaml")
    with pytest.raises(RequestRefused, match="cannot write '/sys/a.yaml'"):  # not even root may
        client.save(loaded, "/sys/a.yaml")
    with pytest.raises(RequestRefused, match="there is no model 'nothing' to save; loaded: .*crates"):
        client.save("nothing", tmp_path / "a.yaml")
    # What somebody wrote into the file since it was loaded is not overwritten.
    crates.write_text(TEXT + "# more\n")
    with pytest.raises(RequestRefused, match="has changed since it was loaded"):
        client.save(loaded, overwrite=True)
    assert crates.read_text() == TEXT + "# more\n"
    assert not [name for name in os.listdir(tmp_path) if name.endswith(".part")]


def test_a_bundle_has_its_meshes_and_loads_wherever_it_is_moved(bench, client, tmp_path):
    home = tmp_path / "mine"
    (home / "meshes").mkdir(parents=True)
    (home / "meshes/a.obj").write_text(
        "mtllib a.mtl\nv 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nusemtl m\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    )
    (home / "meshes/a.mtl").write_text("newmtl m\nKd 1 0 0\n")
    text = TEXT.replace("my own", "high resolution path: ./meshes/\nmy own").replace("shape: BOX", "mesh: a.obj")
    (home / "crates.yaml").write_text(text.replace("  geometry: {x: 0.2, y: 0.2, z: 0.2}\n", ""))
    loaded = client.load(home / "crates.yaml")
    saved = client.save(loaded, tmp_path / "bundle", bundle=True)
    client.unload(loaded)
    assert saved.path == str(tmp_path / "bundle/crates.yaml") and not saved.findings
    (tmp_path / "bundle").rename(tmp_path / "moved")
    home.rename(tmp_path / "away")
    assert (tmp_path / "moved/crates_meshes/a.mtl").exists()
    again = client.load(tmp_path / "moved/crates.yaml")
    assert not [finding for finding in again.findings if finding.severity != "information"]
    client.unload(again)
    with pytest.raises(ValueError, match="needs a folder"):
        client.save(again, bundle=True)
