"""Lights that fit themselves to a picture or to illuminances."""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import Error
from .pictures import Path, write_picture


class Parameter(NamedTuple):
    """A fitted parameter: metres, degrees, or the unit of the power."""

    name: str
    start: float
    value: float
    sigma: Optional[float]  # standard error; None: not determined
    at_bound: bool
    determined: bool


class Solved(NamedTuple):
    """The result of solve()."""

    parameters: List[Parameter]
    lux: List[Dict[str, Any]]  # name, min, mean, max, outside and points of each target of illuminances
    converged: bool
    cost: float
    picture_error: float  # rms of the pictures' residuals
    notes: List[str]
    steps: List[Dict[str, Any]]


def _options(shadows: str, bounces: Union[int, str], quality: str, starts: int, seed: int, max_steps: int, tolerance: float, threads: int) -> Dict[str, Any]:
    number = -1 if bounces == "all" else bounces
    if not isinstance(number, int) or number < -1:
        raise Error("bounces", f"{bounces!r} is no number of bounces", "0 or more, or \"all\"")
    if starts < 1 or max_steps < 1 or not tolerance > 0:
        raise Error("starts", "starts and max_steps must be at least 1, and tolerance above 0")
    return dict(shadows=shadows, bounces=number, quality=quality, starts=starts, seed=seed, max_steps=max_steps, tolerance=tolerance, threads=threads)


def _with_files(spec: Dict[str, Any], folder: str) -> str:
    """The specification as JSON, its arrays of pictures and masks as files of a folder."""
    def kept(value: Any, key: str, number: int) -> Any:
        if key not in ("picture", "mask") or isinstance(value, str):
            return os.path.abspath(value) if key in ("picture", "mask") else value
        picture = np.asarray(value, dtype=np.float32)
        if key == "mask" and picture.ndim == 2:
            picture = np.repeat(picture[:, :, None], 3, axis=2)
        path = os.path.join(folder, f"{key}{number}.exr")
        write_picture(picture, path)
        return path

    targets = [{key: kept(value, key, i) for key, value in target.items()} for i, target in enumerate(spec.get("targets", []))]
    return json.dumps({**spec, "targets": targets}, default=lambda v: v.tolist())


def solve(scene: Path, spec: Dict[str, Any], output: Path = "", *, shadows: str = "on", bounces: Union[int, str] = 0,
          quality: str = "normal", starts: int = 1, seed: int = 1, max_steps: int = 100, tolerance: float = 1e-6, threads: int = 0,
          progress: Optional[Callable[[int, int, float], Any]] = None) -> Solved:
    """Finds lights of a glTF file whose light equals the targets.

    spec      "fit", "tie", "targets" and "least", as docs/solve-questions.md has them; a target's "picture" and "mask" may be arrays
    output    .gltf or .glb: the scene with the fitted lights; empty: it is not written
    progress  called as progress(start, step, cost) after each step; what it raises ends the search

    The other options are those of `steradian solve`.
    """
    options = _options(shadows, bounces, quality, starts, seed, max_steps, tolerance, threads)
    with tempfile.TemporaryDirectory() as folder:
        found = json.loads(_core.solve(os.fspath(scene), os.fspath(output), _with_files(spec, folder), "", options, progress))
    parameters = [Parameter(**p) for p in found["parameters"]]
    return Solved(parameters, found["lux"], found["converged"], found["cost"], found["picture_error"], found["notes"], found["steps"])


class LightModel:
    """The values of all targets as a function of the free parameters, with derivatives: for other optimizers.

    names, start, low, high  of the variables: metres, radians, and factors on the power; logarithms of these if geometry is free too
    wanted                   the pictures' values; NaN for illuminances, whose target is a band
    """

    def __init__(self, scene: Path, spec: Dict[str, Any], *, shadows: str = "on", bounces: Union[int, str] = 0, quality: str = "normal",
                 threads: int = 0) -> None:
        options = _options(shadows, bounces, quality, 1, 1, 1, 1e-6, threads)
        with tempfile.TemporaryDirectory() as folder:
            self._model = _core.LightModel(os.fspath(scene), _with_files(spec, folder), "", options)
        self.names: List[str] = self._model.names
        self.start: NDArray[np.float64] = self._model.start
        self.low: NDArray[np.float64] = self._model.low
        self.high: NDArray[np.float64] = self._model.high
        self.wanted: NDArray[np.float64] = self._model.wanted

    def values(self, x: ArrayLike) -> NDArray[np.float64]:
        """Red, green and blue of the pixels that count, row by row; an illuminance a point."""
        return self._model.values(np.asarray(x, dtype=float))

    def jacobian(self, x: ArrayLike) -> NDArray[np.float64]:
        """Derivatives of the values: one row a value, one column a variable."""
        return self._model.slopes(np.asarray(x, dtype=float))
