# SPDX-License-Identifier: Apache-2.0
"""Meshes with fewer or more triangles, as `nef decimate` and `nef subdivide`.

    >>> import nef
    >>> ball = nef.sphere(1, 24)
    >>> coarse = nef.remeshing.decimate(ball, 60)
    >>> len(coarse.faces) <= 60, nef.from_mesh(coarse.vertices, coarse.faces).is_empty()
    (True, False)
"""
from typing import Any, NamedTuple, Tuple

import numpy

from . import _of_application, _remeshing
from ._nef import Polyhedron
from .arguments import require_int, shown
from .errors import InputError
from .meshes import _vertices_and_faces

__all__ = ["Decimated", "decimate", "subdivide"]

__getattr__ = _of_application(__name__, __all__, {"simplify": "decimate", "reduce": "decimate", "refine": "subdivide"})


class Decimated(NamedTuple):
    """A mesh of fewer triangles."""

    #: array of shape (N, 3)
    vertices: numpy.ndarray
    #: array of shape (M, 3) of vertex numbers, counterclockwise as seen from outside
    faces: numpy.ndarray
    #: proved bounds of the Hausdorff distance between its surface and that of the set: how far a point of one is from
    #: the other at most
    least_distance: float
    most_distance: float


def decimate(set: Polyhedron, triangles: int, *, threads: int = 1) -> Decimated:
    """A mesh of about `triangles` triangles for the solid parts of a set, by collapsing edges in the order of their quadric
    errors (Garland and Heckbert 1997). The result is legal: from_mesh takes it. Where fewer triangles would cross each
    other, more of them stay, and a warning says so.

    threads: 0 for as many as the machine has. Raises InputError if the set has no bounded solid part.
    """
    require_int("triangles", triangles, 0, 2**32 - 1)
    if triangles < 4:
        raise InputError(f"a solid has at least 4 triangles, not {triangles}")
    return Decimated(*_remeshing.decimate(set, triangles, threads))


def subdivide(vertices: Any, faces: Any = None, *, times: int = 1, scheme: str = "midpoint",
              exact: bool = False) -> Tuple[numpy.ndarray, numpy.ndarray]:
    """The vertices and faces of a mesh of triangles each of which is cut in four, `times` times.

    - vertices, faces: as of from_mesh; faces must be triangles
    - scheme: "midpoint" (the same surface) or "loop" (smoothed, Loop 1987; such a mesh may cross itself)
    - exact: coordinates as Fractions, instead of the nearest floats
    """
    if scheme not in ("midpoint", "loop"):
        raise InputError(f"scheme must be 'midpoint' or 'loop', not {shown(scheme)}")
    require_int("times", times, 0, 12)
    return _remeshing.subdivide(*_vertices_and_faces(vertices, faces), times, scheme == "loop", exact)
