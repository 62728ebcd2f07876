"""Exact view factors between plane polygons."""
from __future__ import annotations

from typing import Any, List, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import Error

Array = NDArray[Any]
Face = Union[ArrayLike, Mapping[str, Any]]


class ViewFactors(NamedTuple):
    """Exchange areas H = A_i F_ij of all pairs, as the lower triangle in compressed rows, with their errors."""

    indptr: Array
    indices: Array
    data: Array  # exchange areas [m2]
    errors: Array  # of each entry [m2]
    areas: Array
    row_sums: Array  # of view factors
    row_errors: Array

    def exchange(self) -> Any:
        """The symmetric matrix of exchange areas, as a scipy.sparse.csr_matrix."""
        return self._symmetric(self.data)

    def exchange_errors(self) -> Any:
        """The errors of the exchange areas, in the same form."""
        return self._symmetric(self.errors)

    def factors(self) -> Any:
        """The view factors F_ij from row i to column j, as a scipy.sparse.csr_matrix."""
        from scipy import sparse
        return sparse.diags(1 / self.areas) @ self.exchange()

    def dense(self) -> Array:
        """The view factors as an array; needs no SciPy."""
        n = len(self.areas)
        exchange = np.zeros((n, n))
        rows = np.repeat(np.arange(n), np.diff(self.indptr))
        exchange[rows, self.indices] = self.data
        exchange[self.indices, rows] = self.data
        return exchange / self.areas[:, None]

    def _symmetric(self, values: Array) -> Any:
        from scipy import sparse
        n = len(self.areas)
        lower = sparse.csr_matrix((values, self.indices, self.indptr), shape=(n, n))
        return (lower + lower.T).tocsr()


def _loop(corners: Any, place: str) -> Array:
    loop = np.asarray(corners, dtype=np.float64)
    if loop.ndim != 2 or loop.shape[1] != 3:
        raise Error(place, f"has the shape {loop.shape}", "corners: (N, 3)")
    return loop


def view_factors(faces: Sequence[Face], obstacles: Optional[ArrayLike] = None, *, eps: float = 1e-6, obstruction: bool = True) -> ViewFactors:
    """View factors between all faces, each of which exchanges from the side on which its corners run counter-clockwise.

    faces      corners (N, 3) of each, or {"outline": (N, 3), "holes": [(N, 3), ...], "name": text}
    obstacles  triangles (T, 3, 3) that obstruct and exchange nothing
    eps        error of an entry that is enough, relative to the unobstructed exchange area
    obstruction  False: neither faces nor obstacles obstruct
    """
    loops: List[List[Array]] = []
    names: List[str] = []
    for i, face in enumerate(faces):
        place = f"faces[{i}]"
        if isinstance(face, Mapping):
            unknown = set(face) - {"outline", "holes", "name"}
            if unknown or "outline" not in face:
                raise Error(place, f"has the key {sorted(unknown)[0]}" if unknown else "has no outline", "outline, holes, name")
            loops.append([_loop(face["outline"], place)] + [_loop(h, place) for h in face.get("holes", [])])
            names.append(str(face.get("name", "")))
        else:
            loops.append([_loop(face, place)])
            names.append("")
    triangles = np.zeros((0, 3, 3)) if obstacles is None else np.asarray(obstacles, dtype=np.float64)
    if triangles.ndim != 3 or triangles.shape[1:] != (3, 3):
        raise Error("obstacles", f"has the shape {triangles.shape}", "triangles: (T, 3, 3), the corners of each and their x, y, z")
    return ViewFactors(**_core.view_factors(loops, names, triangles, float(eps), bool(obstruction)))
