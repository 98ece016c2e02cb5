"""Our own scenes: generated files are what the scripts write."""

import re
import struct
import zlib

import generate
import mesh_io
import numpy as np
from own_files import DESCRIPTIONS, MODELS

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?(?![\w.])")


def png_pixels(data):
    """(all but the pixels, pixels): compressed bytes differ between versions of zlib, pixels must not."""
    position, rest, compressed = 8, b"", b""
    while position < len(data):
        (length,) = struct.unpack(">I", data[position : position + 4])
        kind, body = data[position + 4 : position + 8], data[position + 8 : position + 8 + length]
        if kind == b"IDAT":
            compressed += body
        else:
            rest += kind + body
        position += 12 + length
    (rows,) = struct.unpack(">I", data[20:24])
    lines = np.frombuffer(zlib.decompress(compressed), dtype=np.uint8).reshape(rows, -1)
    assert set(lines[:, 0]) in ({0}, {2}), "filters that mesh_io does not write"
    pixels = lines[:, 1:]
    return rest, np.cumsum(pixels, axis=0, dtype=np.uint8) if lines[0, 0] == 2 else pixels


def same_content(ours, fresh):
    if ours == fresh:
        return True
    if ours.startswith(b"\x89PNG"):
        (rest, pixels), (fresh_rest, fresh_pixels) = png_pixels(ours), png_pixels(fresh)
        if rest != fresh_rest:
            return False
        # Another machine's sine may round to the next level.
        return bool((np.abs(pixels.astype(int) - fresh_pixels.astype(int)) <= 1).all())
    # Another machine's sine may differ in the last bit.
    a, b = ours.decode(), fresh.decode()
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return False
    numbers = np.array([[float(x), float(y)] for x, y in zip(NUMBER.findall(a), NUMBER.findall(b), strict=True)])
    tolerance = 1.1e-3 if "\nvn " in a else 1e-12  # the last written digit of a normal
    return bool((np.abs(numbers[:, 0] - numbers[:, 1]) <= tolerance).all())


def test_generated_files_are_what_the_scripts_write(tmp_path):
    generate.generate(tmp_path)
    fresh = {path.relative_to(tmp_path) for path in tmp_path.rglob("*") if path.is_file()}
    folders = ("meshes", "studies", "original", "suturing", "dvrk", "instruments")
    written = [path for folder in folders for path in (MODELS / folder).rglob("*")]
    ours = {path.relative_to(MODELS) for path in written if path.is_file()}
    ours |= {path.relative_to(MODELS) for path in DESCRIPTIONS.rglob("*.yaml") if "generate.py" in path.read_text()}
    assert ours == fresh
    assert len(fresh) > 60
    stale = [
        str(path)
        for path in sorted(fresh)
        if not same_content((MODELS / path).read_bytes(), (tmp_path / path).read_bytes())
    ]
    assert stale == [], "run ambf_models/scripts/generate.py"


def test_the_comparison_notices_a_changed_number_and_a_changed_word():
    assert same_content(b"a: 1.0000000000000002", b"a: 1.0")
    assert not same_content(b"a: 1.00001", b"a: 1.0")
    assert not same_content(b"b: 1.0", b"a: 1.0")


def test_the_comparison_of_pictures_lets_rounding_pass_and_nothing_else(tmp_path):
    pixels = np.arange(75, dtype=np.uint8).reshape(5, 5, 3)
    files = []
    for change in (0, 1, 2):
        changed = pixels.copy()
        changed[2, 3, 1] += change
        mesh_io.write_png(tmp_path / f"{change}.png", changed)
        files.append((tmp_path / f"{change}.png").read_bytes())
    assert same_content(files[0], files[1])
    assert not same_content(files[0], files[2])
    mesh_io.write_png_indexed(tmp_path / "a.png", pixels[..., 0], np.zeros((75, 3), dtype=np.uint8))
    mesh_io.write_png_indexed(tmp_path / "b.png", pixels[..., 0], np.ones((75, 3), dtype=np.uint8))
    assert not same_content((tmp_path / "a.png").read_bytes(), (tmp_path / "b.png").read_bytes())
