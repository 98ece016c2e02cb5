"""Print on boards, mats and floors: a canvas in metres and letters of straight strokes, drawn by their distance."""

import numpy as np

# Strokes on a grid 4 wide and 6 high, baseline at 0. One polyline a word, points as digit pairs.
_GLYPHS = {
    "0": "10 01 05 16 36 45 41 30 10",
    "1": "04 26 20|00 40",
    "2": "05 16 36 45 44 00 40",
    "3": "06 46 23 33 42 41 30 10 01",
    "4": "30 36 02 42",
    "5": "46 06 03 33 42 41 30 10 01",
    "6": "36 16 05 01 10 30 41 42 33 03",
    "7": "06 46 10",
    "8": "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33",
    "9": "43 13 04 05 16 36 45 41 30 10",
    "A": "00 26 40|12 32",
    "B": "00 06 36 45 44 33 03|33 42 41 30 00",
    "C": "45 36 16 05 01 10 30 41",
    "D": "00 06 26 44 42 20 00",
    "E": "46 06 00 40|03 33",
    "F": "46 06 00|03 33",
    "G": "45 36 16 05 01 10 30 41 43 23",
    "H": "00 06|40 46|03 43",
    "I": "20 26",
    "K": "00 06|46 03 40",
    "L": "06 00 40",
    "M": "00 06 23 46 40",
    "N": "00 06 40 46",
    "O": "10 01 05 16 36 45 41 30 10",
    "P": "00 06 36 45 44 33 03",
    "R": "00 06 36 45 44 33 03|23 40",
    "S": "45 36 16 05 04 13 33 42 41 30 10 01",
    "T": "06 46|26 20",
    "U": "06 01 10 30 41 46",
    "Y": "06 23 46|23 20",
    "m": "00 04|03 14 23 20|23 34 43 40",
    "c": "33 24 14 03 01 10 20 31",
    ".": "20 21",
    "-": "13 33",
    " ": "",
}


def strokes(words):
    """Polylines of the words, in sixths of a letter's height, from the left end of the baseline."""
    for k, letter in enumerate(words):
        for line in filter(None, _GLYPHS[letter].split("|")):
            yield [(6.0 * k + int(point[0]), float(point[1])) for point in line.split()]


def length_of(words):
    """In sixths of a letter's height."""
    return len(words) * 6.0 - 2.0


class Canvas:
    """A picture that covers `width` x `height` metres, y upwards, origin in its middle."""

    def __init__(self, width, height, pixels_per_metre, color):
        self.scale = pixels_per_metre
        self.columns, self.rows = round(width * pixels_per_metre), round(height * pixels_per_metre)
        self.width, self.height = width, height
        self.color = np.empty((self.rows, self.columns, 3))
        self.color[:] = color
        self.x = ((np.arange(self.columns) + 0.5) / self.scale - width / 2)[None, :]
        self.y = (height / 2 - (np.arange(self.rows) + 0.5) / self.scale)[:, None]

    def paint(self, distance, color, alpha=1.0, window=(slice(None), slice(None))):
        """Where the signed `distance` (m) to an outline is negative; edges are soft by a pixel."""
        cover = alpha * np.clip(0.5 - distance * self.scale, 0.0, 1.0)
        part = self.color[window]
        part += cover[..., None] * (np.array(color) - part)

    def glow(self, distance, reach, color, alpha):
        """Soft: `alpha` at the outline, nothing `reach` metres away from it. For the shade beside what stands there."""
        cover = alpha * np.clip(1.0 - distance / reach, 0.0, 1.0) ** 2
        self.color += cover[..., None] * (np.array(color) - self.color)

    def disc(self, x, y, radius):
        return np.hypot(self.x - x, self.y - y) - radius

    def box(self, x, y, width, height, corner=0.0):
        dx, dy = np.abs(self.x - x) - width / 2 + corner, np.abs(self.y - y) - height / 2 + corner
        return np.hypot(np.maximum(dx, 0), np.maximum(dy, 0)) + np.minimum(np.maximum(dx, dy), 0) - corner

    def _window(self, low_x, low_y, high_x, high_y):
        column = [int(np.floor((v + self.width / 2) * self.scale)) for v in (low_x, high_x)]
        row = [int(np.floor((self.height / 2 - v) * self.scale)) for v in (high_y, low_y)]
        return (slice(max(row[0] - 2, 0), max(row[1] + 3, 0)), slice(max(column[0] - 2, 0), max(column[1] + 3, 0)))

    def stroke(self, points, thickness, color, alpha=1.0):
        """A polyline of `points` (m), of the given thickness and round at its ends."""
        points = np.array(points, dtype=float)
        low, high = points.min(axis=0) - thickness, points.max(axis=0) + thickness
        window = self._window(*low, *high)
        x, y = self.x[:, window[1]], self.y[window[0], :]
        nearest = np.full((y.shape[0], x.shape[1]), np.inf)
        for a, b in zip(points[:-1], points[1:], strict=True):
            d = b - a
            t = np.clip(((x - a[0]) * d[0] + (y - a[1]) * d[1]) / max(float(d @ d), 1e-18), 0.0, 1.0)
            nearest = np.minimum(nearest, np.hypot(x - a[0] - t * d[0], y - a[1] - t * d[1]))
        self.paint(nearest - thickness / 2, color, alpha, window)

    def text(self, words, x, y, height, color, alpha=1.0, thickness=0.16, up=(0.0, 1.0), align=0.5):
        """`x`, `y`: middle of the line (`align` 0: its left end); `up`: where the letters' heads point."""
        unit = height / 6.0
        ahead = np.array([up[1], -up[0]])
        above = np.array(up)
        start = np.array([x, y]) - align * length_of(words) * unit * ahead - 0.5 * height * above
        for line in strokes(words):
            points = [start + right * unit * ahead + high * unit * above for right, high in line]
            self.stroke(points, thickness * height, color, alpha)

    def pixels(self):
        return np.clip(np.rint(self.color), 0, 255).astype(np.uint8)
