"""docs/gallery.md shows every scene with a picture that is there, and says how to open it. That each scene can be seen
at all is own_pictures_test.cpp."""

import pathlib
import re
import struct

import pytest
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
LAUNCH = yaml.safe_load((ROOT / "ambf_models" / "descriptions" / "launch.yaml").read_text(encoding="utf-8"))
SCENES = [pathlib.Path(file).stem for file in LAUNCH["multibody configs"]]
PICTURES = re.findall(r"!\[([^\]]*)\]\(([^)]*)\)", GALLERY)


def section_with(picture):
    return next(part for part in re.split(r"^## ", GALLERY, flags=re.M) if f"({picture})" in part)


def size_of(data):
    """(width, height) of a JPEG."""
    assert data.startswith(b"\xff\xd8")
    position = 2
    while True:
        marker, length = data[position + 1], struct.unpack(">H", data[position + 2 : position + 4])[0]
        if marker in (0xC0, 0xC1, 0xC2):
            height, width = struct.unpack(">HH", data[position + 5 : position + 9])
            return width, height
        position += 2 + length


@pytest.mark.parametrize("place", range(len(SCENES)), ids=SCENES)
def test_every_scene_has_its_picture_and_the_command_that_opens_it(place):
    section = section_with(f"pictures/{SCENES[place]}.jpg")
    # Entry 1 is what opens by default.
    command = "./dev run" if place == 1 else f"./dev run -l {place}"
    assert f"    {command}\n" in section + "\n"


@pytest.mark.parametrize(("words", "file"), PICTURES, ids=[file for _, file in PICTURES])
def test_pictures_are_there_and_small(words, file):
    data = (ROOT / "docs" / file).read_bytes()
    assert len(words) > 10, "says what it shows to who cannot see it"
    assert len(data) <= 200_000
    assert size_of(data) == (1280, 720)


def test_no_picture_is_left_over():
    named = {file.rpartition("/")[2] for _, file in PICTURES}
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    named |= set(re.findall(r"\(docs/pictures/([^)]*)\)", readme))
    assert {path.name for path in (ROOT / "docs" / "pictures").iterdir()} == named


def test_cameras_and_launch_files_that_it_names_exist():
    for camera in re.findall(r":(\w+_camera)", GALLERY):
        worlds = (ROOT / "ambf_models" / "descriptions" / "world").glob("*.yaml")
        assert any(camera in (yaml.safe_load(world.read_text()).get("cameras") or []) for world in worlds), camera
    for file in re.findall(r"--launch_file (\S+)", GALLERY):
        assert (ROOT / file).is_file()
