"""Light computed without sampling.

Integrals of area lights over arrays of surface points, pictures of scenes, light in the plane, and tables:

    import numpy as np, steradian
    panel = {"type": "rect", "center": [0, 2, 0], "x": [1, 0, 0], "y": [0, 0, 1], "radiance": 10}
    points = np.random.rand(1000, 3).astype(np.float32)
    steradian.irradiance(panel, points, [0, 1, 0])              # (1000, 3)

Lights and materials are the dictionaries of `steradian eval`. Lengths are metres; radiance is W/(m2 sr) or nits, linear RGB.
The manual is docs/python.md.
"""
from . import plane, units
from ._core import Scene, simd, version as __version__
from .errors import Error, UsageError
from .integrals import Derivatives, Reference, irradiance, radiance, reference
from .pictures import Difference, Fit, auto_exposure, diff, fit, load_scene, read_picture, render, write_picture
from .solving import LightModel, Parameter, Solved, solve
from .view_factors import ViewFactors, view_factors

__all__ = [
    "Derivatives", "Difference", "Error", "Fit", "LightModel", "Parameter", "Reference", "Scene", "Solved", "UsageError", "ViewFactors", "__version__", "auto_exposure",
    "diff", "fit", "irradiance", "load_scene", "plane", "radiance", "read_picture", "reference", "render", "simd", "solve", "units", "view_factors",
    "write_picture",
]
