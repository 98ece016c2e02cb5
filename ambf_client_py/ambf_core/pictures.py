"""Pictures of a world, drawn when they are asked for, of the very step. OpenGL is loaded with the first one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .arrays import find

_LARGEST = 8192  # px


class View(NamedTuple):
    """A camera that no file has: m, world axes; up is the world's z, or y when it looks along z."""

    eye: tuple[float, float, float]
    at: tuple[float, float, float]  #: what is in the middle of the picture
    field_of_view: float = 0.7  #: rad, from the lower edge to the upper one
    near: float = 0.01  #: m
    far: float = 30.0  #: m


class CameraInfo(NamedTuple):
    """Where in a picture a point is. Optical axes: x right, y down, z ahead; pixel centres at whole numbers.

    A point p (optical axes) is at u, v of `matrix @ p / p[2]`; of an orthographic camera, of `matrix @ (p x, p y, 1)`.
    """

    width: int
    height: int
    matrix: NDArray[np.float64]  #: (3, 3), px
    pose: NDArray[np.float64]  #: (7,) of the optical frame in the world: m, quaternion x y z w


class Picture(NamedTuple):
    """What a camera saw of one step. Rows go from top to bottom; what was not asked for is None."""

    rgb: NDArray[np.uint8] | None  #: (height, width, 3)
    depth: NDArray[np.float32] | None  #: (height, width) m along the camera's axis; NaN where nothing is
    mask: NDArray[np.int32] | None  #: (height, width) rows of World.bodies, soft bodies behind them; -1: nothing
    info: CameraInfo
    sim_step: int  #: state.sim_step


class Painter:
    """Draws one world. Of the thread that made it."""

    def __init__(self, renderer: str) -> None:
        """Raises RuntimeError where no pictures can be drawn."""
        import _ambf_view

        self._native = _ambf_view.Pictures(renderer)
        self.renderer: str = self._native.renderer

    def draw(
        self, frame: Any, slot: int, view: View | None, size: tuple[int, int], wanted: tuple[bool, bool, bool]
    ) -> tuple[Picture, list[str]]:
        """size: width and height; wanted: rgb, depth, mask. The picture, and what users should know."""
        width, height = size
        kinds = (((height, width, 3), np.uint8), ((height, width), np.float32), ((height, width), np.int32))
        arrays = [np.empty(shape if want else 0, kind) for (shape, kind), want in zip(kinds, wanted, strict=True)]
        numbers = [] if view is None else [*view.eye, *view.at, *view[2:]]
        intrinsics, pose, findings = self._native.draw(frame, slot, numbers, width, height, *arrays)
        fx, fy, cx, cy, skew = intrinsics
        info = CameraInfo(width, height, np.array([[fx, skew, cx], [0, fy, cy], [0, 0, 1.0]]), np.array(pose))
        rgb, depth, mask = (array if want else None for array, want in zip(arrays, wanted, strict=True))
        return Picture(rgb, depth, mask, info, 0), findings


def check_size(width: int, height: int) -> None:
    """Raises ValueError for sizes that no picture has."""
    if not (1 <= width <= _LARGEST and 1 <= height <= _LARGEST):
        raise ValueError(f"a picture of {width} x {height} pixels: 1 to {_LARGEST} each")


def seen_by(camera: str | View, cameras: Mapping[str, int]) -> tuple[int, View | None]:
    """The camera's row ("": the first one), or 0 and the view. Raises LookupError, or ValueError where it is none."""
    if isinstance(camera, View):
        _check_view(camera)
        return 0, camera
    if not camera and not cameras:
        raise LookupError("the world has no camera")
    return (find(cameras, camera) if camera else 0), None


def _check_view(view: View) -> None:
    """Raises ValueError for what is no view."""
    numbers = [*view.eye, *view.at, *view[2:]]
    if len(numbers) != 9 or not all(math.isfinite(each) for each in numbers):
        raise ValueError(f"{view!r}: not nine finite numbers")
    if tuple(view.eye) == tuple(view.at) or not 0 < view.field_of_view < math.pi or not 0 < view.near < view.far:
        raise ValueError(f"{view!r}: nothing can be seen so")
