"""Writes the seeds of fuzz_mesh: small files of each format, each behind the byte that chooses the format."""

import pathlib
import struct

FOLDER = pathlib.Path(__file__).parent / "corpus" / "mesh"
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 0, 0), (1, 1, 0), (0, 1, 0)]

OBJ = b"""mtllib a.mtl
v 0 0 0
v 1 0 0
v 1 1 0.5 1 0 0
v 0 1 0
v +.5 0.5e0 1
vt 0 0
vt 1 0 0
vt 1
vn 0 0 1
o part
g group
usemtl red
s 1
f 4 3 2 1
f 1//1 2//1 -1//1
s off
f 2/1/1 3/2/1 \\
  5/3/1
l 1 2 3
"""

PLY_HEADER = """ply
format {} 1.0
comment TextureFile wood.png
element vertex 4
property float x
property double y
property float z
property float nx
property float ny
property float nz
property float s
property float t
element face 1
property list uchar int vertex_indices
property list uchar float texcoord
element tristrips 1
property list int int vertex_indices
element edge 1
property short vertex1
property ushort vertex2
end_header
"""


def stl():
    facets = b""
    for i in range(0, len(SQUARE), 3):
        facets += struct.pack("<3f", 0, 0, 1) + b"".join(struct.pack("<3f", *p) for p in SQUARE[i : i + 3]) + b"\0\0"
    return b"binary".ljust(80) + struct.pack("<I", len(SQUARE) // 3) + facets


def stl_ascii():
    lines = ["solid part"]
    for i in range(0, len(SQUARE), 3):
        lines += ["facet normal 0 0 1", "outer loop"]
        lines += ["vertex {} {} {}".format(*p) for p in SQUARE[i : i + 3]] + ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid part", ""]).encode()


def ply_ascii():
    vertices = "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0 0 0 1 0 1\n"
    return (PLY_HEADER.format("ascii") + vertices + "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n6 0 1 2 -1 1 2\n0 2\n").encode()


def ply_binary(order, name):
    body = b""
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        body += struct.pack(order + "fdffffff", x, y, 0, 0, 0, 1, x, y)
    body += struct.pack(order + "B4iB8f", 4, 0, 1, 2, 3, 8, *range(8))
    body += struct.pack(order + "i5i", 5, 0, 1, 2, -1, 3) + struct.pack(order + "hH", 0, 2)
    return PLY_HEADER.format(name).encode() + body


def chunk(number, content):
    return struct.pack("<HI", number, len(content) + 6) + content


def threeds():
    material = chunk(0xA000, b"red\0") + chunk(
        0xA020, chunk(0x0011, b"\xff\0\0") + chunk(0x0010, struct.pack("<3f", 1, 0, 0))
    )
    material += chunk(0xA040, chunk(0x0030, struct.pack("<H", 50))) + chunk(
        0xA050, chunk(0x0031, struct.pack("<f", 0.5))
    )
    material += chunk(0xA200, chunk(0xA300, b"wood.png\0"))
    vertices = struct.pack("<H", 4) + b"".join(struct.pack("<3f", *p) for p in (*SQUARE[:3], SQUARE[5]))
    texcoords = struct.pack("<H8f", 4, 0, 0, 1, 0, 1, 1, 0, 1)
    faces = struct.pack("<H8H", 2, 0, 1, 2, 7, 0, 2, 3, 7)
    faces += chunk(0x4130, b"red\0" + struct.pack("<HHH", 2, 0, 1)) + chunk(0x4150, struct.pack("<II", 1, 2))
    mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces) + chunk(0x4140, texcoords))
    return chunk(0x4D4D, chunk(0x3D3D, chunk(0xAFFF, material) + chunk(0x4000, b"square\0" + mesh)))


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    dae = (pathlib.Path(__file__).parent / "square.dae").read_bytes()
    seeds = {
        "stl": (0, stl()),
        "stl_ascii": (0, stl_ascii()),
        "obj": (1, OBJ),
        "ply_ascii": (2, ply_ascii()),
        "ply_little": (2, ply_binary("<", "binary_little_endian")),
        "ply_big": (2, ply_binary(">", "binary_big_endian")),
        "3ds": (3, threeds()),
        "dae": (4, dae),
    }
    for name, (kind, content) in seeds.items():
        (FOLDER / name).write_bytes(bytes([kind]) + content)


if __name__ == "__main__":
    main()
