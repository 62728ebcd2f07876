"""Light in the plane: exact two-dimensional light from drawings.

    world = steradian.plane.load("lamps.svg")
    steradian.plane.mean_radiance(world, [320, 200])       # (3,)
    steradian.plane.render(world)                          # (height, width, 3)

Coordinates are the drawing's user units, y downwards. What is a light and what blocks: docs/plane.md.
"""
from __future__ import annotations

import os
from typing import NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import World
from .errors import Error

Path = Union[str, "os.PathLike[str]"]

__all__ = ["Moments", "World", "load", "loads", "mean_radiance", "moments", "render"]


class Moments(NamedTuple):
    """Averages over the circle of directions, (..., 3) each."""

    radiance: NDArray[np.float64]
    x: NDArray[np.float64]  # of radiance times the direction's x (towards the light)
    y: NDArray[np.float64]


def load(path: Path) -> World:
    """Reads a drawing (.svg)."""
    return _core.plane_load(os.fspath(path))


def loads(svg: str, name: str = "drawing") -> World:
    """The same of the text of a drawing; name stands for its file in messages."""
    return _core.plane_loads(svg, name)


def render(world: Union[World, Path], width: int = 0, height: int = 0, *, method: str = "exact", occluders: str = "black", aa: int = 1,
           spp: int = 64, seed: int = 1, threads: int = 0) -> NDArray[np.float32]:
    """Mean radiance at every pixel's centre, (height, width, 3) float32.

    width, height  0: the drawing's own size, a unit a pixel
    method         "exact", "par", "sampled" or "marched"; spp and seed are of the last two
    occluders      "black", "fill" or "clear": what a picture shows where they are. clear: a fourth channel, alpha
    """
    picture, layers = _core.plane_render(_world(world), dict(width=width, height=height, method=method, occluders=occluders, aa=aa,
                                                             spp=spp, seed=seed, threads=threads))
    return np.concatenate([picture, layers["alpha"][..., :1]], axis=-1) if "alpha" in layers else picture


def mean_radiance(world: Union[World, Path], position: ArrayLike, *, method: str = "exact", spp: int = 64,
                  seed: int = 1) -> NDArray[np.float64]:
    """Radiance averaged over the circle of directions at points (..., 2): (..., 3), in double."""
    return _query(world, position, method, spp, seed)[..., 0, :]


def moments(world: Union[World, Path], position: ArrayLike, *, method: str = "exact", spp: int = 64, seed: int = 1) -> Moments:
    """The same, and its first moments: which way the light comes from."""
    found = _query(world, position, method, spp, seed)
    return Moments(found[..., 0, :], found[..., 1, :], found[..., 2, :])


def _world(world: Union[World, Path]) -> World:
    return world if isinstance(world, World) else load(world)


def _query(world: Union[World, Path], position: ArrayLike, method: str, spp: int, seed: int) -> NDArray[np.float64]:
    points = np.asarray(position, dtype=np.float64)
    if points.ndim == 0 or points.shape[-1] != 2:
        raise Error("position", f"has the shape {points.shape}", "the last axis is x, y: (2,), (N, 2), (H, W, 2)")
    found = _core.plane_query(_world(world), np.ascontiguousarray(points.reshape(-1, 2)), method, spp, seed)
    return found.reshape(*points.shape[:-1], 3, 3)
