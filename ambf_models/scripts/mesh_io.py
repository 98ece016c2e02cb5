"""Writes meshes as OBJ + MTL and pictures as PNG, with the standard library and numpy only.

Numbers are rounded to a tenth of a micrometre, so that files are small and do not depend on the last bit of a sine.
"""

import functools
import struct
import zlib
from pathlib import Path

import numpy as np

# name: (diffuse r, g, b in 0..1, sRGB; specular level; shininess). One calm palette for all scenes; ADF colours use it
# too.
PALETTE = {
    "shell": (0.89, 0.89, 0.88, 0.35, 60),
    "ivory": (0.92, 0.905, 0.865, 0.30, 40),
    "graphite": (0.265, 0.275, 0.29, 0.30, 36),
    "slate": (0.40, 0.45, 0.50, 0.28, 36),
    "carbon": (0.225, 0.23, 0.24, 0.35, 40),
    "steel": (0.72, 0.73, 0.74, 0.90, 110),
    "aluminium": (0.80, 0.81, 0.82, 0.80, 60),
    "brass": (0.82, 0.68, 0.42, 0.85, 90),
    "teal": (0.08, 0.50, 0.52, 0.35, 48),
    "sky": (0.27, 0.50, 0.73, 0.30, 48),
    "liver": (0.44, 0.1725, 0.157, 0.65, 70),
    "skin": (0.878, 0.675, 0.569, 0.30, 40),
    "coral": (0.88, 0.41, 0.33, 0.30, 48),
    "amber": (0.93, 0.69, 0.27, 0.30, 48),
    "sage": (0.50, 0.67, 0.50, 0.25, 36),
    "plum": (0.50, 0.38, 0.60, 0.30, 48),
    "sand": (0.85, 0.79, 0.68, 0.15, 16),
    "night": (0.173, 0.227, 0.267, 0.20, 24),
    "rubber": (0.16, 0.16, 0.165, 0.10, 8),
    "tinted": (0.13, 0.17, 0.20, 0.80, 160),
    "lamp": (0.98, 0.97, 0.93, 0.30, 60),
}

# Drawn as bare metal: the diffuse colour is what they mirror.
METALS = {"steel", "aluminium", "brass"}

# What a colour's surface carries besides: (colour map, normal map, metres that one picture covers). With a colour map
# the diffuse colour multiplies it. None for the metres: a print, laid on by its mesh.
BRUSHED, PEBBLED = "../../textures/brushed.png", "../../textures/pebbled.png"
FINISHES = {
    "steel": (None, BRUSHED, 0.03),
    "aluminium": (None, BRUSHED, 0.06),
    "rubber": (None, PEBBLED, 0.02),
    "night": (None, PEBBLED, 0.03),
    "oak": ("../../textures/oak.png", None, 0.48),
    "stained": ("../../textures/grain.png", None, 0.12),
    "resin": ("../../textures/floor.png", None, 1.0),
    "paint": ("../../textures/wall.png", None, None),
}
# Surfaces that only exist with their picture: specular level and shininess; their colour is the picture's.
PICTURED = {"stained": (0.20, 24), "oak": (0.20, 20), "resin": (0.30, 60), "paint": (0.05, 8), "check": (0.04, 8)}

CREASE_COSINE = 0.64  # edges sharper than 50 degrees stay hard
FLAT_WEIGHT = 1000.0


def corner_normals(mesh):
    """One unit normal per triangle corner: mean of the neighbours within the crease angle, weighted by angle and
    area, so that large flat faces stay flat and the narrow bevels between them carry the turn."""
    points = mesh.vertices[mesh.faces]
    face_normal = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    length = np.linalg.norm(face_normal, axis=1)
    if (length < 1e-16).any():
        raise ValueError("a triangle without area")
    face_normal /= length[:, None]
    weight = np.empty((len(points), 3))
    for k in range(3):
        u, v = points[:, (k + 1) % 3] - points[:, k], points[:, (k + 2) % 3] - points[:, k]
        cosine = np.einsum("ij,ij->i", u, v) / (np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1))
        weight[:, k] = np.arccos(np.clip(cosine, -1.0, 1.0)) * length
    weight[np.array(mesh.flat)] *= FLAT_WEIGHT
    around = {}
    for f, face in enumerate(mesh.faces):
        for k, vertex in enumerate(face):
            around.setdefault(int(vertex), []).append((f, k))
    normals = np.empty((len(points), 3, 3))
    for corners in around.values():
        faces = np.array([f for f, _ in corners])
        weights = np.array([weight[f, k] for f, k in corners])
        close = (face_normal[faces] @ face_normal[faces].T) > CREASE_COSINE
        sums = (close * weights) @ face_normal[faces]
        sums /= np.linalg.norm(sums, axis=1)[:, None]
        for (f, k), normal in zip(corners, sums, strict=True):
            normals[f, k] = normal
    return normals


@functools.cache  # coordinates come back in face after face, and in solid after solid
def _number(value, digits):
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


class _Numbering:
    """Gives equal lines one index, in order of first use (OBJ counts from 1)."""

    def __init__(self, keyword):
        self.keyword, self.index = keyword, {}

    def __call__(self, text):
        return self.index.setdefault(text, len(self.index) + 1)

    def lines(self):
        return [f"{self.keyword} {text}" for text in self.index]


def laid_on(mesh):
    """Texture coordinates of all corners in metres: the mesh's own, elsewhere from the side that a face looks to."""
    points = mesh.vertices[mesh.faces]
    normal = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    side = np.argmax(np.abs(normal) * np.array([1.0, 1.001, 1.002]), axis=1)
    u, v = np.array([1, 0, 1])[side], np.array([2, 2, 0])[side]  # grain along y where there is a choice
    rows = np.arange(len(points))
    seen = np.stack([points[rows, :, u], points[rows, :, v]], axis=-1)
    return np.where(np.isnan(mesh.uv), seen, mesh.uv)


def write_obj(path, mesh, finishes, material_library="palette.mtl"):
    """Faces are grouped by colour, in order of first use; those of a finish get texture coordinates."""
    positions, normals, uvs = _Numbering("v"), _Numbering("vn"), _Numbering("vt")
    corner_normal, places = corner_normals(mesh).tolist(), laid_on(mesh).tolist()
    points = [" ".join([_number(c, 7) for c in point]) for point in mesh.vertices.tolist()]
    groups = {}
    for f, face in enumerate(mesh.faces):
        corners = []
        for k, vertex in enumerate(face):
            v = positions(points[vertex])
            n = normals(" ".join([_number(c, 3) for c in corner_normal[f][k]]))
            t = ""
            if mesh.colors[f] in finishes:
                metres = finishes[mesh.colors[f]][2] or 1.0
                t = uvs(" ".join([_number(c / metres, 4) for c in places[f][k]]))
            corners.append(f"{v}/{t}/{n}")
        groups.setdefault(mesh.colors[f], []).append("f " + " ".join(corners))
    lines = ["# Generated by ambf_models/scripts/generate.py; metres.", f"mtllib {material_library}"]
    lines += positions.lines() + uvs.lines() + normals.lines()
    for color, faces in groups.items():
        lines += [f"usemtl {color}"] + faces
    Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return set(groups)


def write_palette(path, colors, finishes):
    """MTL with the named colours."""
    lines = ["# Generated by ambf_models/scripts/generate.py."]
    for name in sorted(colors):
        r, g, b, specular, shininess = (
            PALETTE[name] if name in PALETTE else (1.0, 1.0, 1.0, *PICTURED.get(name, (0.2, 24)))
        )
        lines += [
            "",
            f"newmtl {name}",
            f"Ka {r * 0.4:.3f} {g * 0.4:.3f} {b * 0.4:.3f}",
            f"Kd {r:.3f} {g:.3f} {b:.3f}",
            f"Ks {specular:.3f} {specular:.3f} {specular:.3f}",
            f"Ns {shininess}",
            "d 1",
            "illum 3" if name in METALS else "illum 2",
        ]
        if name in METALS:
            lines.append("Pm 1")
        picture, bumps, _ = finishes.get(name, (None, None, None))
        if name == "lamp":
            lines.append(f"Ke {r * 0.9:.3f} {g * 0.9:.3f} {b * 0.9:.3f}")
        if picture:
            lines.append(f"map_Kd {picture}")
        if bumps:
            lines.append(f"norm {bumps}")
    Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")


def _write_png(path, rows, columns, kind, lines, palette=None):
    """`lines`: bytes of each row with its filter in front; `kind`: PNG colour type."""

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", columns, rows, 8, kind, 0, 0, 0)
    Path(path).write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + (chunk(b"PLTE", palette.tobytes()) if palette is not None else b"")
        + chunk(b"IDAT", zlib.compress(b"".join(lines), 9))
        + chunk(b"IEND", b"")
    )


def write_png(path, pixels):
    """`pixels`: (rows, columns, 3) uint8, top row first. Written as differences from the row above, which pack well."""
    rows, columns, _ = pixels.shape
    above = np.vstack([np.zeros_like(pixels[:1]), pixels[:-1]])
    changes = pixels - above  # modulo 256, as PNG's filter 2 wants it
    _write_png(path, rows, columns, 2, [b"\2" + changes[row].tobytes() for row in range(rows)])


def write_png_indexed(path, indices, palette):
    """`indices`: (rows, columns) uint8; `palette`: (up to 256, 3) uint8."""
    rows, columns = indices.shape
    _write_png(path, rows, columns, 3, [b"\0" + indices[row].tobytes() for row in range(rows)], palette)
