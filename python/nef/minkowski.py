# SPDX-License-Identifier: Apache-2.0
"""Minkowski sums, erosions, offsets, convex decompositions and configuration spaces, exact.

    >>> import nef
    >>> from nef import minkowski
    >>> a = nef.box((0, 0, 0), (1, 1, 1))
    >>> minkowski.sum(a, a) == a.scale(2)
    True
"""
from fractions import Fraction
from typing import TYPE_CHECKING, Callable, Optional

from . import _nef
from ._minkowski import configuration_space, decompose, is_convex, negate, sum
from ._nef import Polyhedron
from .errors import InputError, UnsupportedError

if TYPE_CHECKING:
    from ._nef import Number

Progress = Optional[Callable[[int, int], object]]

__all__ = ["ball", "configuration_space", "decompose", "erode", "is_convex", "negate", "offset", "sum"]


def _extent(a, what):
    if not a.is_bounded():
        raise UnsupportedError(f"{what} must be bounded")
    return a.bounding_box()


def erode(a: Polyhedron, b: Polyhedron, threads: int = 1, progress: Progress = None) -> Polyhedron:
    """The Minkowski difference: the points x for which b, moved by x, lies in a. Exact.

    - a, b: bounded sets; all of space if b is empty
    """
    if b.is_empty():
        return _nef.everything()
    if a.is_empty():
        return _nef.Polyhedron()
    low, high = _extent(a, "an eroded set")
    b_low, b_high = _extent(b, "what a set is eroded by")
    # Where x can be at all, and a box that holds b moved by any such x.
    where = _nef.box([p - q for p, q in zip(low, b_low)], [p - q for p, q in zip(high, b_high)])
    if where.is_empty():
        return where
    around = _nef.box([min(p, 2 * p - q) for p, q in zip(low, high)], [max(q, 2 * q - p) for p, q in zip(low, high)])
    return where - sum(around - a, negate(b), threads=threads, progress=progress)


def ball(radius: "Number", detail: int = 3) -> Polyhedron:
    """A polyhedron whose vertices lie exactly on a sphere about the origin.

    - radius: a positive number
    - detail: 1 for an octahedron; the number of steps from a pole to the equator
    """
    radius = Fraction(radius)
    if radius <= 0 or detail < 1:
        raise InputError("a ball needs a positive radius and a detail of at least 1")
    # t = tan(angle / 2) from 0 to 1 makes the rational points of a quarter of a circle.
    quarter = [((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)) for t in (Fraction(i, detail) for i in range(detail + 1))]
    circle = [(s * c, r * d) for c, d in quarter for s in (1, -1) for r in (1, -1)]
    return _nef.hull([(radius * c * x, radius * c * y, sign * radius * z)
                      for c, z in quarter for x, y in circle for sign in (1, -1)])


def offset(a: Polyhedron, radius: "Number", detail: int = 3, threads: int = 1, progress: Progress = None) -> Polyhedron:
    """The set grown by a ball of the radius; shrunk for a negative one. The ball is the polyhedron ball(abs(radius),
    detail), which lies within the true ball; with it, the answer is exact."""
    radius = Fraction(radius)
    if radius == 0:
        return a
    if radius < 0:
        return erode(a, ball(-radius, detail), threads=threads, progress=progress)
    return sum(a, ball(radius, detail), threads=threads, progress=progress)
