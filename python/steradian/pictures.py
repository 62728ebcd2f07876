"""Scenes, pictures and tables."""
from __future__ import annotations

import os
from typing import Any, Callable, Dict, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import Error

Path = Union[str, "os.PathLike[str]"]
Picture = NDArray[np.float32]  # (height, width, 3), linear radiance, the top row first


class Difference(NamedTuple):
    """What differs between two pictures."""

    rmse: float  # root of the mean square over pixels and channels
    relative_l2: float  # |a - b| / |b|
    max: float  # the largest absolute difference of a channel
    mean_ratio: float  # mean of a over mean of b


class Fit(NamedTuple):
    """How far a fitted table is off: integral of |lobe - fit| over the lobe's albedo; 2 is no overlap."""

    mean_error: float
    largest_error: float


def load_scene(path: Path, *, max_lights: Optional[int] = None, environment: str = "", environment_rotation: float = 0,
               lights: Sequence[str] = (), light_units: str = "auto", aspect: float = 16 / 9, max_memory: int = 4_000_000_000, max_work: int = 2_000_000_000) -> _core.Scene:
    """Reads a glTF 2.0 file (.gltf or .glb).

    max_lights   area lights kept, strongest first; None: 256, and each mesh and single light
    environment  light from all around: a map's path, "white" or "sky"; empty: the file's own
    environment_rotation  degrees about +y, counter-clockwise from above
    lights       beside the file's: "default", "none", "sun", "studio"
    light_units  of punctual lights beside emission: "auto", "candela" or "watt"
    aspect       width over height of the picture that a default camera fills

    Returns a Scene: its `warnings` say what was dropped, defaulted or not supported; `lights` are its area lights as
    dictionaries for radiance(); `cameras` and `materials` are names.
    """
    return _core.load_scene(os.fspath(path), dict(max_lights=max_lights, environment=environment,
                                                  environment_rotation=environment_rotation, lights=list(lights),
                                                  light_units=light_units, aspect=aspect, max_memory=max_memory, max_work=max_work))


def render(scene: Union[_core.Scene, Path], width: int = 1280, height: int = 720, *, camera: str = "", method: str = "auto",
           quality: str = "normal", shadows: str = "on", terminator: str = "smooth", lights: str = "auto", light_error: float = 0.01,
           indirect: str = "off", multiple_scattering: bool = False, background: bool = True, aa: int = 1, spp: int = 16,
           target_error: float = 0.01, table: Path = "", seed: int = 1, threads: int = 0, progress: Optional[Callable[[int, int], Any]] = None,
           stats: bool = False) -> Union[Picture, Tuple[Picture, Dict[str, Any]]]:
    """A scene as a picture of linear radiance, (height, width, 3) float32, the top row first.

    scene     what load_scene returned, or a path
    method    of the specular lobe: a name that `steradian methods` lists
    shadows   "on", "exact" (never by rays) or "off"
    lights    "all" one by one, "tree": far ones together, each within light_error of its light, or "auto": the tree from 64 on
    indirect  one bounce: "off", "ltc", "ltc-outgoing", "ggx" or "path"
    progress  called as progress(done, total) from any thread; what it raises ends the render
    stats     True: returns the picture and a dictionary of times, counts, warnings and further layers

    The other options are those of `steradian render`. Ctrl-C ends it soon.
    """
    loaded = scene if isinstance(scene, _core.Scene) else load_scene(scene, aspect=width / max(height, 1))
    options = dict(width=width, height=height, camera=camera, method=method, quality=quality, shadows=shadows, terminator=terminator,
                   lights=lights, light_error=light_error, indirect=indirect, multiple_scattering=multiple_scattering,
                   background=background, aa=aa, spp=spp, target_error=target_error, table=os.fspath(table), seed=seed, threads=threads)
    picture, told = _core.render(loaded, options, progress)
    return (picture, told) if stats else picture


def _pixels(picture: Union[ArrayLike, Path]) -> Picture:
    return read_picture(picture) if isinstance(picture, (str, os.PathLike)) else np.asarray(picture, dtype=np.float32)


def diff(a: Union[ArrayLike, Path], b: Union[ArrayLike, Path]) -> Difference:
    """The difference of two pictures (arrays of shape (height, width, 3), or paths) in numbers; b is the reference."""
    return Difference(**_core.diff(_pixels(a), _pixels(b)))


def read_picture(path: Path) -> Picture:
    """Reads .exr, .hdr, or .png and .jpg made linear: (height, width, 3) float32."""
    return _core.read_picture(os.fspath(path))


def write_picture(picture: ArrayLike, path: Path, exposure: float = 0.0) -> None:
    """Writes .exr (linear) or .png (exposure in stops, tone mapped, sRGB). The file appears when it is complete."""
    _core.write_picture(np.asarray(picture, dtype=np.float32), os.fspath(path), exposure)


def auto_exposure(picture: ArrayLike) -> float:
    """The exposure in stops that brings the geometric mean of a picture's luminance to middle grey."""
    return _core.auto_exposure(np.asarray(picture, dtype=np.float32))


def fit(output: Path, *, lobe: Optional[str] = None, samples: Optional[Path] = None, size: int = 64, threads: int = 0) -> Fit:
    """Fits linearly transformed cosines to a lobe and writes the table.

    output   .json (what radiance(table=...) and render(table=...) read), .h, .glsl, .dds or .exr
    lobe     "ggx", "beckmann", "charlie", "disney-diffuse" or "oren-nayar"
    samples  in its place, measured reflection: MERL's binary, or lines of angles and values
    size     nodes along roughness and along the view; 64 takes some seconds
    """
    if (lobe is None) == (samples is None):
        raise Error("fit", "takes either lobe or samples")
    return Fit(*_core.fit(os.fspath(output), lobe or "", os.fspath(samples) if samples is not None else "", size, threads))
