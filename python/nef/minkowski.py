# SPDX-License-Identifier: Apache-2.0
"""Minkowski sums, erosions, openings, closings, offsets, convex decompositions and configuration spaces, exact.

    >>> import nef
    >>> from nef import minkowski
    >>> a = nef.box((0, 0, 0), (1, 1, 1))
    >>> minkowski.sum(a, a) == a.scale(2)
    True
"""
from ._minkowski import (ball, ball_error, closing, configuration_space, decompose, erode, is_convex, negate, offset, opening,
                         sum)

__all__ = ["ball", "ball_error", "closing", "configuration_space", "decompose", "erode", "is_convex", "negate", "offset",
           "opening", "sum"]
