"""Single integrals over arrays of points."""
from __future__ import annotations

import json
import math
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import Error

Light = Dict[str, Any]
Lights = Union[Light, Sequence[Light]]
Material = Dict[str, Any]
Materials = Union[Material, Sequence[Material]]
Array = NDArray[Any]


class Reference(NamedTuple):
    """Ground truth and what it may be off."""

    radiance: Array  # (..., 3)
    bound: Array  # (...): on the absolute error of the largest channel


class Derivatives(NamedTuple):
    """A result and how it changes. `channel` counts red, green, blue; arrays are float64. None: there is none of it."""

    value: Array  # (..., 3): the radiance or irradiance
    # by the light
    d_vertices: Optional[Array] = None  # (..., channel, vertex, xyz): of a polygon or rect, the outline's first, then the holes'
    d_center: Optional[Array] = None  # (..., channel, xyz)
    d_x: Optional[Array] = None  # (..., channel, xyz): by the half axes
    d_y: Optional[Array] = None
    d_z: Optional[Array] = None
    d_ends: Optional[Array] = None  # (..., channel, end, xyz): of a capsule
    d_radius: Optional[Array] = None  # (..., channel): of a sphere or capsule
    d_light_position: Optional[Array] = None  # (..., channel, xyz): of a point light
    d_direction: Optional[Array] = None  # (..., channel, xyz): of parallel light
    d_radiance: Optional[Array] = None  # (..., channel): by the light's radiance in the same channel
    d_intensity: Optional[Array] = None  # likewise, of a point light
    d_illuminance: Optional[Array] = None  # likewise, of parallel light
    # by the surface
    d_position: Optional[Array] = None  # (..., channel, xyz): by the point, normal and view as they are
    d_normal: Optional[Array] = None  # (..., channel, xyz): by the normal as a direction, perpendicular to it
    d_view: Optional[Array] = None  # (..., channel, xyz): likewise by the view
    # by a single lobe
    d_albedo: Optional[Array] = None  # (..., channel)
    d_f0: Optional[Array] = None  # (..., channel)
    d_f90: Optional[Array] = None  # (..., channel)
    d_roughness: Optional[Array] = None  # (..., channel): by the perceptual roughness of an isotropic lobe
    d_alpha_x: Optional[Array] = None  # (..., channel): by the widths of an anisotropic lobe
    d_alpha_y: Optional[Array] = None
    d_exponent: Optional[Array] = None  # (..., channel)
    d_axis_exponent: Optional[Array] = None  # (..., channel)
    d_occluders: Optional[Array] = None  # (..., channel, position, xyz): by the occluders' positions


_LAMBERT = {"brdf": "lambert"}


def _jsonable(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"a light or a material may hold numbers, texts, lists and arrays, not {type(value).__name__}")


def _query(light: Lights, material: Materials, has_view: bool, keys: Dict[str, Any]) -> str:
    occluders = keys.get("occluders")
    if isinstance(occluders, np.ndarray) and (occluders.ndim != 3 or occluders.shape[1:] != (3, 3)):
        raise Error("occluders", f"has the shape {occluders.shape}", "triangles: (T, 3, 3), the corners of each and their x, y, z")
    query: Dict[str, Any] = {"light" if isinstance(light, dict) else "lights": light, "material": material,
                             "position": [0, 0, 0], "normal": [0, 0, 1]}
    if has_view:
        query["view"] = [0, 0, 1]
    query.update({key: value for key, value in keys.items() if value is not None})
    return json.dumps(query, default=_jsonable)


def _dtype(precision: Optional[str], arrays: Sequence[Array]) -> type:
    if precision == "float":
        return np.float32
    if precision == "double":
        return np.float64
    if precision is not None:
        raise Error("precision", f"'{precision}' is not known", "float, double, or None: as the arrays are")
    # Lists and the like do not count: a normal may be written [0, 1, 0] beside a million float32 points.
    return np.float32 if arrays and all(a.dtype == np.float32 for a in arrays) else np.float64


def _points(precision: Optional[str], **given: Any) -> Tuple[Tuple[int, ...], List[Array]]:
    """The common shape without its last axis, and each argument as (N, 3) in one type; steps of 0 where it is broadcast."""
    dtype = _dtype(precision, [a for a in given.values() if isinstance(a, np.ndarray)])
    arrays = []
    for name, value in given.items():
        try:
            array = np.asarray(value, dtype=dtype)
        except (TypeError, ValueError) as e:
            raise Error(name, f"is no array of numbers: {e}") from None
        if array.ndim == 0 or array.shape[-1] != 3:
            raise Error(name, f"has the shape {array.shape}", "the last axis is x, y, z: (3,), (N, 3), (H, W, 3)")
        arrays.append(array)
    try:
        shape = np.broadcast_shapes(*(a.shape for a in arrays))
    except ValueError:
        shapes = ", ".join(f"{name} {a.shape}" for name, a in zip(given, arrays))
        raise Error(", ".join(given), f"have shapes that do not go together: {shapes}", "equal, or 1 where an axis is repeated") from None
    rows = []
    for array in arrays:
        if array.ndim == 1:
            row = np.broadcast_to(array, (math.prod(shape[:-1]), 3))
        else:
            row = np.broadcast_to(array, shape).reshape(-1, 3)  # copies only what is broadcast along some axes and not along others
        aligned = row.flags.aligned and all(step % row.itemsize == 0 for step in row.strides)
        rows.append(row if aligned else np.ascontiguousarray(row))
    return shape[:-1], rows


def _evaluate(light: Lights, material: Materials, precision: Optional[str], keys: Dict[str, Any], position: ArrayLike,
              normal: ArrayLike, view: Optional[ArrayLike]) -> Tuple[Array, Array]:
    if view is None:
        shape, (p, n) = _points(precision, position=position, normal=normal)
        v = n
    else:
        shape, (p, n, v) = _points(precision, position=position, normal=normal, view=view)
    values, errors = _core.answer(_query(light, material, view is not None, keys), p, n, v)
    return values.reshape(*shape, 3), errors.reshape(shape)


def _derivatives(light: Lights, material: Materials, keys: Dict[str, Any], position: ArrayLike, normal: ArrayLike,
                 view: Optional[ArrayLike]) -> Derivatives:
    if view is None:
        shape, (p, n) = _points("double", position=position, normal=normal)
        v = n
    else:
        shape, (p, n, v) = _points("double", position=position, normal=normal, view=view)
    found = _core.derivatives(_query(light, material, view is not None, {**keys, "derivatives": True}), p, n, v)
    found = {key: a.reshape(*shape, *a.shape[1:]) for key, a in found.items()}
    return Derivatives(found.pop("radiance"), **found)


def radiance(light: Lights, position: ArrayLike, normal: ArrayLike, view: Optional[ArrayLike] = None,
             material: Materials = _LAMBERT, method: str = "auto", quality: str = "normal", *, precision: Optional[str] = None,
             spp: Optional[int] = None, seed: Optional[int] = None, table: Optional[str] = None, occluders: Any = None,
             geometric_normal: Optional[Sequence[float]] = None, derivatives: bool = False) -> Union[Array, Derivatives]:
    """Radiance that surface points send to the eye, [W/(m2 sr) or nits].

    light      a dictionary as of `steradian eval` ({"type": "rect", ...}), or a list of them, whose light adds
    position   (..., 3) points [m]
    normal     (..., 3) their normals; need not be unit. A normal of zero is no surface, and gets 0
    view       (..., 3) directions from the surface to the eye; need not be unit. May be left out where the material is Lambert
    material   {"brdf": "lambert" | "ggx" | "phong" | ..., ...}, or a list, whose results add
    method     "auto", "exact", "closed-form", "ltc", ..., "reference", "sampled": docs/methods.md
    quality    "draft", "normal" or "high"
    precision  "float" or "double"; None: float where every numpy array given is float32, else double
    spp, seed  of "sampled": pairs of samples, and the first point's seed
    table      with "ltc": a file of fit() in place of the shipped table of GGX
    occluders  what blocks the light: (T, 3, 3) triangles, {"positions", "indices"}, or the name of a scene
    geometric_normal  with occluders: the normal of the triangle that all positions lie on
    derivatives  True: a Derivatives, in double, for one light

    The arrays are broadcast against each other. Returns (..., 3), linear RGB; NaN where a number given is not finite.
    Raises Error where something is wrong with what was given, with its place, the problem and a hint.
    """
    keys = {"method": method, "quality": quality, "spp": spp, "seed": seed, "table": table, "occluders": occluders,
            "geometric_normal": geometric_normal}
    if derivatives:
        return _derivatives(light, material, keys, position, normal, view)
    return _evaluate(light, material, precision, keys, position, normal, view)[0]


def irradiance(light: Lights, position: ArrayLike, normal: ArrayLike, *, precision: Optional[str] = None, occluders: Any = None,
               geometric_normal: Optional[Sequence[float]] = None, derivatives: bool = False) -> Union[Array, Derivatives]:
    """Irradiance that surface points receive, [W/m2 or lux]: exact for every light.

    The arguments are those of radiance(). Returns (..., 3), linear RGB: pi times the radiance of a white Lambert surface.
    """
    keys = {"occluders": occluders, "geometric_normal": geometric_normal}
    # As an albedo of 1 over the kernel's factor: pi is in the light's colour, not in a second pass over the result.
    white = {"brdf": "lambert", "albedo": math.pi}
    if derivatives:
        return _derivatives(light, white, keys, position, normal, None)._replace(d_albedo=None)
    return _evaluate(light, white, precision, keys, position, normal, None)[0]


def reference(light: Lights, position: ArrayLike, normal: ArrayLike, view: Optional[ArrayLike] = None, material: Materials = _LAMBERT,
              *, occluders: Any = None, geometric_normal: Optional[Sequence[float]] = None) -> Reference:
    """Ground truth: adaptive quadrature in double, with a bound of its error. Slow: a millisecond a point, about.

    The arguments are those of radiance(). Returns a Reference of radiance (..., 3) and bound (...).
    """
    keys = {"method": "reference", "occluders": occluders, "geometric_normal": geometric_normal}
    return Reference(*_evaluate(light, material, "double", keys, position, normal, view))
