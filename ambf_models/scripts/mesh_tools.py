"""Small solid modeller for our own meshes: bevelled extrusions, turned parts, tori, capsules.

Every shape is a closed triangle surface, counter-clockwise seen from outside, in metres. Triangles carry the name of
a palette colour. Normals are computed once, when a mesh is written (mesh_io): smooth across shallow edges, hard
across creases, so bevels catch the light. Nothing here depends on time, hashing or random numbers.
"""

import itertools
import math

import numpy as np
from outlines import circle, inset, rectangle

AXES = {"x": 0, "y": 1, "z": 2}


class Mesh:
    """Triangles by vertex position; `colors` names the palette colour of each triangle, `flat` marks triangles whose
    normal rules at their corners (plates that a bevel leaves tangentially). `uv`: places of the corners on the
    colour's picture: metres where it tiles, 0..1 for a print; NaN where the writer shall lay the picture on from the
    side that the triangle faces."""

    def __init__(self, vertices=(), faces=(), color="shell"):
        self.vertices = np.array(vertices, dtype=float).reshape(-1, 3)
        self.faces = np.array(faces, dtype=int).reshape(-1, 3)
        self.colors = [color] * len(self.faces)
        self.flat = [False] * len(self.faces)
        self.uv = np.full((len(self.faces), 3, 2), np.nan)

    def painted(self, color):
        mesh = self.copy()
        mesh.colors = [color] * len(mesh.faces)
        return mesh

    def copy(self):
        mesh = Mesh(self.vertices, self.faces)
        mesh.colors, mesh.flat, mesh.uv = list(self.colors), list(self.flat), self.uv.copy()
        return mesh

    def repainted(self, old, new):
        mesh = self.copy()
        mesh.colors = [new if color == old else color for color in self.colors]
        return mesh

    def printed(self, color, width, height, middle=(0, 0, 0), right=(0, 1, 0), up=(-1, 0, 0)):
        """Gives the faces that look at the reader (exactly: caps, not bevels) the print `color`, which covers `width`
        x `height` metres around `middle`; `right` and `up` as the reader sees it. By default it lies flat and is read
        from +x."""
        mesh = self.copy()
        right, up = np.array(right, dtype=float), np.array(up, dtype=float)
        corners = mesh.vertices[mesh.faces]
        facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        facing /= np.linalg.norm(facing, axis=1)[:, None]
        for f in np.nonzero(facing @ np.cross(right, up) > 0.9999)[0]:
            mesh.colors[f] = color
            mesh.uv[f, :, 0] = 0.5 + (corners[f] - middle) @ right / width
            mesh.uv[f, :, 1] = 0.5 + (corners[f] - middle) @ up / height
        return mesh

    def moved(self, x=0.0, y=0.0, z=0.0):
        mesh = self.copy()
        mesh.vertices = mesh.vertices + np.array([x, y, z])
        return mesh

    def turned(self, rotation):
        """`rotation`: 3x3 rows, determinant +1."""
        mesh = self.copy()
        mesh.vertices = mesh.vertices @ np.array(rotation, dtype=float).T
        return mesh

    def along(self, axis):
        """Turns a shape made along +z so that it lies along +axis (a cyclic permutation, so exact)."""
        mesh = self.copy()
        mesh.vertices = np.roll(mesh.vertices, {"z": 0, "x": 1, "y": 2}[axis], axis=1)
        return mesh

    def __add__(self, other):
        mesh = Mesh()
        mesh.vertices = np.vstack([self.vertices, other.vertices])
        mesh.faces = np.vstack([self.faces, other.faces + len(self.vertices)])
        mesh.colors, mesh.flat = self.colors + other.colors, self.flat + other.flat
        mesh.uv = np.concatenate([self.uv, other.uv])
        return mesh

    def with_flat(self, first):
        """Marks the triangles from index `first` on as flat (changes this mesh, for its maker)."""
        self.flat[first:] = [True] * (len(self.flat) - first)
        return self


def joined(parts):
    """Union by putting closed parts into one mesh (overlaps stay inside and are never seen)."""
    total = Mesh()
    for part in parts:
        total = total + part
    return total


def rotation_about(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    i = AXES[axis]
    j, k = (i + 1) % 3, (i + 2) % 3
    r = np.eye(3)
    r[j, j], r[j, k], r[k, j], r[k, k] = c, -s, s, c
    return r


def _bevel_steps(height, bevel, segments):
    """(inset, z) rings of a bevelled side, from the bottom face to the top face, centred on z = 0."""
    if bevel <= 0.0:
        return [(0.0, -height / 2), (0.0, height / 2)]
    steps = []
    for k in range(segments + 1):
        a = 0.5 * math.pi * k / segments
        steps.append((bevel * (1.0 - math.sin(a)), -height / 2 + bevel * (1.0 - math.cos(a))))
    return steps + [(d, -z) for d, z in reversed(steps)]


def _skin(rings, faces, start, count, closed=True):
    """Side triangles between consecutive rings of `count` vertices."""
    for ring in range(rings - 1):
        for i in range(count if closed else count - 1):
            a = start + ring * count + i
            b = start + ring * count + (i + 1) % count
            faces.append((a, b, b + count))
            faces.append((a, b + count, a + count))


def extrude(outline, height, bevel=0.0, segments=2, color="shell"):
    """Plate with the outline in x-y, centred on z = 0, both rims rounded by `bevel`. The outline must be star-shaped
    about its mean."""
    steps = _bevel_steps(height, bevel, segments)
    n = len(outline)
    vertices, faces = [], []
    for distance, z in steps:
        vertices.extend((p[0], p[1], z) for p in inset(outline, distance))
    _skin(len(steps), faces, 0, n)
    sides = len(faces)
    centre = outline.mean(axis=0)
    vertices += [(centre[0], centre[1], -height / 2), (centre[0], centre[1], height / 2)]
    bottom, top, last = len(vertices) - 2, len(vertices) - 1, (len(steps) - 1) * n
    for i in range(n):
        j = (i + 1) % n
        faces.append((bottom, j, i))
        faces.append((top, last + i, last + j))
    return Mesh(vertices, faces, color).with_flat(sides)


def extrude_ring(outer, inner, height, bevel=0.0, segments=2, color="shell"):
    """As extrude, with a hole. `outer` and `inner` run counter-clockwise and have equally many points, matched by
    index."""
    if len(outer) != len(inner):
        raise ValueError("a ring needs as many inner as outer points")
    steps = _bevel_steps(height, bevel, segments)
    n, rings = len(outer), len(steps)
    vertices, faces = [], []
    for distance, z in steps:
        vertices.extend((p[0], p[1], z) for p in inset(outer, distance))
    _skin(rings, faces, 0, n)
    hole_faces = []
    for distance, z in steps:
        vertices.extend((p[0], p[1], z) for p in inset(inner, -distance))
    _skin(rings, hole_faces, rings * n, n)
    faces += [(a, c, b) for a, b, c in hole_faces]
    sides = len(faces)
    for i in range(n):
        j = (i + 1) % n
        outer_low, inner_low = i, rings * n + i
        faces.append((outer_low, inner_low, rings * n + j))
        faces.append((outer_low, rings * n + j, j))
        outer_top, inner_top = (rings - 1) * n, (2 * rings - 1) * n
        faces.append((outer_top + i, outer_top + j, inner_top + j))
        faces.append((outer_top + i, inner_top + j, inner_top + i))
    return Mesh(vertices, faces, color).with_flat(sides)


def ngon_tube(points, radius, sides=10, color="shell"):
    """Cable: a tube of round section along a polyline, closed at both ends. `points` (m), smooth enough for mitres."""
    points = np.array(points, dtype=float)
    ahead = np.gradient(points, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1)[:, None]
    up = np.array([0.0, 0.0, 1.0]) if abs(ahead[0, 2]) < 0.9 else np.array([1.0, 0.0, 0.0])
    vertices, faces = [], []
    for point, direction in zip(points, ahead, strict=True):
        up = up - direction * float(up @ direction)  # carried along without twist
        up /= np.linalg.norm(up)
        aside = np.cross(direction, up)
        for k in range(sides):
            a = 2.0 * math.pi * k / sides
            vertices.append(point + radius * (math.cos(a) * up + math.sin(a) * aside))
    _skin(len(points), faces, 0, sides)
    vertices += [points[0], points[-1]]
    first, last, base = len(vertices) - 2, len(vertices) - 1, (len(points) - 1) * sides
    for i in range(sides):
        j = (i + 1) % sides
        faces += [(first, j, i), (last, base + i, base + j)]
    return Mesh(vertices, faces, color)


def box(x, y, z, bevel=0.0, corner=None, color="shell", segments=2):
    """Box with rounded edges: the vertical ones by `corner` (default: as the rims), the rims by `bevel`."""
    corner = bevel if corner is None else corner
    corner = max(corner, 1.001 * bevel)
    return extrude(rectangle(x, y, corner, segments + 1), z, bevel, segments, color)


def lathe(profile, segments=32, color="shell"):
    """Turned part about z. `profile`: (radius, z) points from the bottom to the top of the axis; radius 0 closes an
    end. Pictures are wound around it, so that brushed metal shines as turned metal does."""
    vertices, faces, wound = [], [], []
    widest = max(radius for radius, _ in profile)
    passed = np.concatenate([[0.0], np.cumsum([math.dist(a, b) for a, b in itertools.pairwise(profile)])])
    ring_of = []
    for radius, z in profile:
        if radius <= 1e-12:
            ring_of.append((len(vertices), 1))
            vertices.append((0.0, 0.0, z))
        else:
            ring_of.append((len(vertices), segments))
            vertices.extend((p[0], p[1], z) for p in circle(radius, segments))
    step = 2.0 * math.pi * widest / segments  # m along the picture
    for ring, ((a0, na), (b0, nb)) in enumerate(itertools.pairwise(ring_of)):
        low, high = passed[ring], passed[ring + 1]
        for i in range(segments):
            j = (i + 1) % segments
            a, a_next = (a0, a0) if na == 1 else (a0 + i, a0 + j)
            b, b_next = (b0, b0) if nb == 1 else (b0 + i, b0 + j)
            if na > 1:
                faces.append((a, a_next, b_next))
                wound.append(((i * step, low), ((i + 1) * step, low), ((i + 1) * step, high)))
            if nb > 1:
                faces.append((a, b_next, b))
                wound.append(((i * step, low), ((i + 1) * step, high), (i * step, high)))
    mesh = Mesh(vertices, faces, color)
    mesh.uv = np.array(wound)
    return mesh


def rounded_profile(points, radii, segments=3):
    """Rounds the inner points of a lathe profile; `radii` has one number a point (0 keeps a corner; ends stay)."""
    points = [np.array(p, dtype=float) for p in points]
    result = [tuple(points[0])]
    for i in range(1, len(points) - 1):
        r, corner = radii[i], points[i]
        before, after = points[i - 1] - corner, points[i + 1] - corner
        before /= np.linalg.norm(before)
        after /= np.linalg.norm(after)
        cosine = max(-1.0, min(1.0, float(before @ after)))
        if r <= 0.0 or cosine < -0.9999:
            result.append(tuple(corner))
            continue
        half = 0.5 * math.acos(cosine)
        centre = corner + (before + after) / np.linalg.norm(before + after) * (r / math.sin(half))
        start, end = corner + before * (r / math.tan(half)) - centre, corner + after * (r / math.tan(half)) - centre
        sweep = math.atan2(start[0] * end[1] - start[1] * end[0], float(start @ end))
        for k in range(segments + 1):
            a = sweep * k / segments
            c, s = math.cos(a), math.sin(a)
            result.append(tuple(centre + np.array([c * start[0] - s * start[1], s * start[0] + c * start[1]])))
    return result + [tuple(points[-1])]


def collar(inner, outer, low, high, bevel=0.0, segments=32, color="shell"):
    """Ring of rectangular section between two heights, outer edges bevelled: an accent around a turned part."""
    corners = [(inner, low), (outer, low), (outer, high), (inner, high)]
    profile = rounded_profile(corners, [0, bevel, bevel, 0], 1)
    return lathe(profile + profile[:1], segments, color)


def cylinder(radius, height, bevel=0.0, segments=28, color="shell"):
    """Cylinder along z, centred, with rounded rims."""
    h = height / 2
    return lathe(
        rounded_profile([(0, -h), (radius, -h), (radius, h), (0, h)], [0, bevel, bevel, 0], 2), segments, color
    )


def tube(outer, inner, height, bevel=0.0, segments=28, color="shell"):
    return extrude_ring(circle(outer, segments), circle(inner, segments), height, bevel, 1, color)


def capsule(radius, height, segments=20, color="shell"):
    """Capsule along z, centred; `height` counts the caps, as in ADF."""
    h, profile = height / 2 - radius, []
    for k in range(9):
        a = -0.5 * math.pi + 0.5 * math.pi * k / 8
        profile.append((radius * math.cos(a) if k else 0.0, -h + radius * math.sin(a)))
    return lathe(profile + [(r, -z) for r, z in reversed(profile)], segments, color)


def torus(ring_radius, tube_radius, segments=36, sides=14, color="shell"):
    """Ring about z."""
    vertices, faces = [], []
    for i in range(segments):
        a = 2.0 * math.pi * i / segments
        for k in range(sides):
            b = 2.0 * math.pi * k / sides
            r = ring_radius + tube_radius * math.cos(b)
            vertices.append((r * math.cos(a), r * math.sin(a), tube_radius * math.sin(b)))
    for i in range(segments):
        for k in range(sides):
            p, q = i * sides + k, ((i + 1) % segments) * sides + k
            p_up, q_up = i * sides + (k + 1) % sides, ((i + 1) % segments) * sides + (k + 1) % sides
            faces += [(p, q, q_up), (p, q_up, p_up)]
    return Mesh(vertices, faces, color)


def screw(radius, height, color="steel"):
    """Cap screw with a hexagon socket, its head's top at z = `height`, along z."""
    socket = 0.5 * radius
    head = rounded_profile(
        [
            (0, -0.001),
            (radius, -0.001),
            (radius, height),
            (1.2 * socket, height),
            (socket, 0.5 * height),
            (0, 0.5 * height),
        ],
        [0, 0, 0.25 * radius, 0, 0, 0],
        2,
    )
    return lathe(head, 18, color)


def arc_band(inner, outer, width, start, end, segments=12, color="shell"):
    """Curved strip about the y axis, from angle `start` to `end` in x-z (0 is +x, counter-clockwise towards +z)."""
    vertices, faces = [], []
    for k in range(segments + 1):
        a = start + (end - start) * k / segments
        c, s = math.cos(a), math.sin(a)
        vertices += [
            (r * c, y, r * s)
            for r, y in ((inner, -width / 2), (outer, -width / 2), (outer, width / 2), (inner, width / 2))
        ]
    for k in range(segments):
        for i in range(4):
            a, b = 4 * k + i, 4 * k + (i + 1) % 4
            faces += [(a, b + 4, b), (a, a + 4, b + 4)]
    last = 4 * segments
    faces += [(0, 1, 2), (0, 2, 3), (last, last + 2, last + 1), (last, last + 3, last + 2)]
    return Mesh(vertices, faces, color)


def volume(mesh):
    """Signed volume in m^3 (positive when the triangles face outwards)."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)
