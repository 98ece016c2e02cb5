"""Pictures on our meshes: colour maps and normal maps, made from noise and strokes. All tile unless they are prints.

Noise comes from an integer hash, so every machine makes the same pixels (give or take the last bit of a sine).
"""

import numpy as np
from lettering import Canvas
from mesh_io import write_png, write_png_indexed

FOLDER = "textures"  # below ambf_models/meshes


def hashed(*integers):
    """Uniform in 0..1 for each combination of integer arrays."""
    h = np.array(2166136261, dtype=np.uint32)
    for values in integers:
        h = (np.atleast_1d(values).astype(np.uint32) ^ h) * np.uint32(2654435761)
        h = (h ^ (h >> np.uint32(15))) * np.uint32(2246822519)
        h = h ^ (h >> np.uint32(13))
    return h.astype(np.float64) / 4294967296.0


def noise(rows, columns, cells_down, cells_across, seed):
    """Smooth value noise in -1..1 that tiles."""
    y = np.arange(rows) * cells_down / rows
    x = np.arange(columns) * cells_across / columns
    row, column = np.floor(y).astype(int), np.floor(x).astype(int)
    v, u = y - row, x - column
    v, u = (v * v * (3 - 2 * v))[:, None], (u * u * (3 - 2 * u))[None, :]

    def at(i, j):
        return hashed(((row + i) % cells_down)[:, None], ((column + j) % cells_across)[None, :], seed)

    low = at(0, 0) * (1 - u) + at(0, 1) * u
    high = at(1, 0) * (1 - u) + at(1, 1) * u
    return 2.0 * (low * (1 - v) + high * v) - 1.0


def normals_of(height, strength):
    """Normal map of a height field that tiles; x to the right, y up in the picture."""
    dx = (np.roll(height, -1, axis=1) - np.roll(height, 1, axis=1)) * strength
    dy = (np.roll(height, 1, axis=0) - np.roll(height, -1, axis=0)) * strength
    n = np.stack([-dx, -dy, np.ones_like(dx)], axis=-1)
    n /= np.linalg.norm(n, axis=-1)[..., None]
    return np.clip(np.rint(127.5 + 127.5 * n), 0, 255).astype(np.uint8)


# --- wood ------------------------------------------------------------------------------------------------------------

STAVES = 8  # in the picture, one below the other; they run along its x
STAVE_WIDTH, STAVE_PERIOD = 0.06, 0.48  # m: height of one in the picture, length after which it repeats


def wood():
    """Oak staves as (rows, columns) level in 0..1: growth rings cut lengthwise, fine pores, a tone for each."""
    size = 1024
    rows = size // STAVES
    level = np.empty((size, size))
    across = (np.arange(rows) + 0.5)[:, None] / rows
    for k in range(STAVES):
        bend = 0.30 * noise(rows, size, 2, 3, 10 + k) + 0.10 * noise(rows, size, 3, 7, 30 + k)
        rings = 0.5 + 0.5 * np.cos(2 * np.pi * ((3.0 + 2.0 * hashed(k, 7)) * across + 1.6 * bend + hashed(k, 3)))
        streaks = noise(rows, size, rows // 2, 6, 50 + k)
        pores = np.clip(noise(rows, size, rows, 40, 70 + k) - 0.45, 0, 1) * (0.4 + 0.6 * rings)
        wide = noise(rows, size, 5, 2, 90 + k)
        tone = 0.56 + 0.20 * (hashed(k, 11) - 0.5)
        body = tone + 0.10 * (rings**2 - 0.4) + 0.065 * streaks + 0.05 * wide - 0.30 * pores
        joint = np.minimum(across, 1 - across) * rows  # pixels to the edge of the stave
        body -= 0.34 * np.clip(1.0 - joint / 1.3, 0, 1)
        level[k * rows : (k + 1) * rows] = body
    return np.clip(level, 0, 1)


def grain():
    """Fine wood grain, nearly white: for what stains it."""
    size = 256
    bend = 0.10 * noise(size, size, 2, 2, 201)
    across = (np.arange(size) + 0.5)[:, None] / size
    rings = 0.5 + 0.5 * np.cos(2 * np.pi * (9.0 * across + 6.0 * bend))
    level = 241 - 20 * rings**2 - 9 * np.clip(noise(size, size, size // 2, 8, 202), 0, 1)
    return np.clip(np.rint(level[..., None] * np.array((1.0, 0.99, 0.97))), 0, 255).astype(np.uint8)


def wood_ramp(count):
    """Colours (sRGB) from the darkest to the lightest part of pale oak."""
    stops = np.array([0.0, 0.3, 0.55, 0.8, 1.0])
    colors = np.array([(76, 58, 44), (138, 110, 84), (180, 152, 122), (206, 182, 152), (228, 208, 182)], dtype=float)
    t = np.linspace(0, 1, count)
    return np.rint(np.stack([np.interp(t, stops, colors[:, c]) for c in range(3)], axis=1)).astype(np.uint8)


# --- normal maps -----------------------------------------------------------------------------------------------------


def brushed():
    """Scratches along x."""
    size = 256
    height = (
        noise(size, size, size, 4, 1) + 0.7 * noise(size, size, size // 2, 9, 2) + 0.4 * noise(size, size, 64, 2, 3)
    )
    return normals_of(height, 0.045)


def pebbled():
    """Moulded rubber and silicone."""
    size = 256
    height = noise(size, size, 64, 64, 5) + 0.6 * noise(size, size, 118, 118, 6)
    return normals_of(height, 0.16)


# --- floors and walls ------------------------------------------------------------------------------------------------


def floor():
    """One metre of poured floor with a grid of 0.1 m, every metre stronger."""
    size = 1024
    speckle = 1.2 * noise(size, size, 512, 512, 21) + 1.6 * noise(size, size, 128, 128, 22)
    cloud = 2.0 * noise(size, size, 9, 9, 23) + 2.0 * noise(size, size, 4, 4, 24)
    color = np.array((172.0, 176.0, 179.0)) + np.array((1.0, 1.0, 0.95)) * (speckle + cloud)[..., None]
    step = np.abs((np.arange(size) + 0.5) / size * 10 + 0.5) % 1.0 - 0.5  # in decimetres from the nearest line
    metre = np.abs(((np.arange(size) + 0.5) / size + 0.5) % 1.0 - 0.5) * size  # pixels from the nearest metre
    thin = np.clip(1.6 - np.abs(step) * size / 10, 0, 1)
    thick = np.clip(2.8 - metre, 0, 1)
    lines = np.maximum(
        np.maximum(thin[:, None], thin[None, :]) * 0.17, np.maximum(thick[:, None], thick[None, :]) * 0.42
    )
    color += lines[..., None] * (np.array((92.0, 104.0, 116.0)) - color)
    return np.clip(np.rint(color), 0, 255).astype(np.uint8)


def wall():
    """Height of a room: paint with the shade that gathers above the floor and below the ceiling."""
    rows, columns = 256, 16
    z = (np.arange(rows)[::-1, None] + 0.5) / rows * np.ones((1, columns))
    shade = 1.0 - 0.16 * np.exp(-z / 0.10) - 0.10 * np.exp(-(1 - z) / 0.2)
    color = np.array((212.0, 212.0, 208.0)) * shade[..., None]
    return np.clip(np.rint(color), 0, 255).astype(np.uint8)


# --- the sky: a bright room out of focus, for what looks past the walls and what mirrors it ---------------------------

SKY_SIDE = 256
# Of each face: name in the ADF, the direction of its middle, of its right and of its upper edge.
SKY_FACES = {
    "front": ((-1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "back": ((1, 0, 0), (0, -1, 0), (0, 0, 1)),
    "right": ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    "left": ((0, -1, 0), (-1, 0, 0), (0, 0, 1)),
    "top": ((0, 0, 1), (0, 1, 0), (1, 0, 0)),
    "bottom": ((0, 0, -1), (0, 1, 0), (-1, 0, 0)),
}


def sky_color(d):
    """sRGB by unit direction (..., 3)."""
    x, y, z = d[..., 0], d[..., 1], d[..., 2]

    def soft(edge, at, width):
        t = np.clip((at - edge) / width, 0, 1)
        return (t * t * (3 - 2 * t))[..., None]

    ground, horizon, ceiling = (np.array(c, dtype=float) for c in ((148, 150, 150), (205, 208, 208), (238, 239, 236)))
    color = ground + (horizon - ground) * soft(-0.55, z, 0.6)
    color = color + (ceiling - color) * soft(0.0, z, 0.8)
    # A window on the left, cool and bright; lamps above; a warm wall on the right.
    window = soft(0.35, -y, 0.5) * soft(-0.05, z, 0.25) * (1 - soft(0.5, z, 0.25)) * (1 - soft(0.3, np.abs(x), 0.45))
    color = color + (np.array((250.0, 253.0, 255.0)) - color) * window
    lamps = soft(0.78, z, 0.12) * (1 - soft(0.10, np.abs(x), 0.18))
    color = color + (np.array((255.0, 254.0, 250.0)) - color) * lamps
    warm = soft(0.2, y, 0.8) * (1 - soft(0.5, np.abs(z), 0.4))
    return color + (np.array((219.0, 209.0, 196.0)) - color) * 0.55 * warm


def sky_face(middle, right, up):
    t = (np.arange(SKY_SIDE) + 0.5) / SKY_SIDE * 2 - 1
    d = (
        np.array(middle, dtype=float)
        + t[None, :, None] * np.array(right, dtype=float)
        - t[:, None, None] * np.array(up, dtype=float)
    )
    color = sky_color(d / np.linalg.norm(d, axis=-1)[..., None])
    row, column = np.mgrid[0:SKY_SIDE, 0:SKY_SIDE]
    grain = hashed(row, column, 77)[..., None] - 0.5  # instead of steps between levels
    return np.clip(np.rint(color + 0.9 * grain), 0, 255).astype(np.uint8)


def write_canvas(folder, name, canvas: Canvas):
    write_png(folder / name, canvas.pixels())


def build(models):
    folder = models / "meshes" / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    levels = 96
    write_png_indexed(folder / "oak.png", np.rint(wood() * (levels - 1)).astype(np.uint8), wood_ramp(levels))
    write_png(folder / "grain.png", grain())
    write_png(folder / "brushed.png", brushed())
    write_png(folder / "pebbled.png", pebbled())
    write_png(folder / "floor.png", floor())
    write_png(folder / "wall.png", wall())
    for name, (middle, right, up) in SKY_FACES.items():
        write_png(folder / f"sky_{name}.png", sky_face(middle, right, up))
