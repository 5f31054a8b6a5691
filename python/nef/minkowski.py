# SPDX-License-Identifier: Apache-2.0
"""Minkowski sums, erosions, openings, closings, offsets, sweeps, hulls, convex decompositions and configuration spaces;
penetration depths, no-fit sets, the reach of tools, and what milling tools leave around a part. All exact.

    >>> import nef
    >>> from nef import minkowski
    >>> a = nef.box((0, 0, 0), (1, 1, 1))
    >>> minkowski.sum(a, a) == a.scale(2)
    True
"""
from . import _of_application
from ._minkowski import (ball, ball_error, closing, component, configuration_space, decompose, erode, hull, is_convex, millable,
                         negate, no_fit, offset, opening, penetration, reach, simplified_offset, sum, sweep)

__all__ = ["ball", "ball_error", "closing", "component", "configuration_space", "decompose", "erode", "hull", "is_convex",
           "millable", "negate", "no_fit", "offset", "opening", "penetration", "reach", "simplified_offset", "sum", "sweep"]

__getattr__ = _of_application(__name__, __all__, {"minkowski_sum": "sum", "add": "sum", "dilate": "sum", "open": "opening", "close": "closing", "convex_hull": "hull", "intersects": "penetration"})
