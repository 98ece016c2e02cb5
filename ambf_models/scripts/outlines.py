"""Outlines in the plane for mesh_tools: convex, counter-clockwise, rows of (x, y) in metres."""

import math

import numpy as np


def rounded_outline(corners, radius, segments=4):
    """Convex outline, counter-clockwise, with each corner replaced by an arc. `radius`: one number or one a corner."""
    corners = [np.array(c, dtype=float) for c in corners]
    radii = [radius] * len(corners) if np.isscalar(radius) else list(radius)
    points = []
    for i, corner in enumerate(corners):
        r = radii[i]
        to_previous = corners[i - 1] - corner
        to_next = corners[(i + 1) % len(corners)] - corner
        to_previous /= np.linalg.norm(to_previous)
        to_next /= np.linalg.norm(to_next)
        if to_next[0] * to_previous[1] - to_next[1] * to_previous[0] <= 0.0:
            raise ValueError(f"corner {i} of an outline is not convex")
        if r <= 0.0:
            points.append(corner)
            continue
        half = 0.5 * math.acos(max(-1.0, min(1.0, float(to_previous @ to_next))))
        bisector = (to_previous + to_next) / np.linalg.norm(to_previous + to_next)
        centre = corner + bisector * (r / math.sin(half))
        start = corner + to_previous * (r / math.tan(half)) - centre
        sweep = math.pi - 2.0 * half
        for k in range(segments + 1):
            a = sweep * k / segments
            c, s = math.cos(a), math.sin(a)
            points.append(centre + np.array([c * start[0] - s * start[1], s * start[0] + c * start[1]]))
    return np.array(points)


def rectangle(x, y, radius=0.0, segments=4):
    return rounded_outline([(x / 2, -y / 2), (x / 2, y / 2), (-x / 2, y / 2), (-x / 2, -y / 2)], radius, segments)


def circle(radius, segments=32, phase=0.0):
    a = phase + 2.0 * math.pi * np.arange(segments) / segments
    return np.stack([radius * np.cos(a), radius * np.sin(a)], axis=1)


def stadium(length, radius, segments=12):
    """Bar outline: two half circles of `radius` whose centres lie at x = 0 and x = length."""
    a = -0.5 * math.pi + math.pi * np.arange(segments + 1) / segments
    right = np.stack([length + radius * np.cos(a), radius * np.sin(a)], axis=1)
    left = np.stack([-radius * np.cos(a), -radius * np.sin(a)], axis=1)
    return np.vstack([right, left])


def inset(outline, distance):
    """Moves every edge of a convex outline inwards by `distance` (outwards when negative)."""
    n = len(outline)
    result = []
    for i in range(n):
        edge_in = outline[i] - outline[i - 1]
        edge_out = outline[(i + 1) % n] - outline[i]
        normal_in = np.array([-edge_in[1], edge_in[0]]) / np.linalg.norm(edge_in)
        normal_out = np.array([-edge_out[1], edge_out[0]]) / np.linalg.norm(edge_out)
        miter = (normal_in + normal_out) / (1.0 + float(normal_in @ normal_out))
        result.append(outline[i] + distance * miter)
    return np.array(result)


def ray_outline(outline, angles):
    """Points where rays from the origin at `angles` cut a convex outline around the origin: matches two outlines
    point by point."""
    points = []
    for angle in angles:
        d = np.array([math.cos(angle), math.sin(angle)])
        best = None
        for i in range(len(outline)):
            p, q = outline[i - 1], outline[i]
            e = q - p
            det = d[0] * -e[1] + d[1] * e[0]
            if abs(det) < 1e-15:
                continue
            t = (p[0] * -e[1] + p[1] * e[0]) / det
            u = (d[0] * p[1] - d[1] * p[0]) / det
            if t > 0.0 and -1e-9 <= u <= 1.0 + 1e-9 and (best is None or t > best):
                best = t
        points.append(best * d)
    return np.array(points)
