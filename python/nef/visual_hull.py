# SPDX-License-Identifier: Apache-2.0
"""Exact visual hulls: the largest set that silhouettes allow.

    >>> hull = visual_hull.compute(masks, cameras, box=((-1, -1, -1), (1, 1, 1)))   # doctest: +SKIP
    >>> hull.solid.write("hull.off")                                               # doctest: +SKIP
"""
import os
import tempfile
import warnings
from typing import Any, Callable, List, NamedTuple, Optional, Sequence, Tuple

import numpy

from . import _visual_hull
from ._nef import Polyhedron
from .errors import InputError

Progress = Optional[Callable[[str, str, int, int], object]]

__all__ = ["Hull", "View", "compute", "read"]


class View(NamedTuple):
    """What one view has come to."""

    name: str
    #: the file of its image
    image: str
    #: rings of the silhouette, holes included
    contours: int
    holes: int
    #: whether the silhouette reaches the border of the image
    cut_by_frame: bool
    #: whether the hull's projection lies in the silhouette, decided exactly; None if it was not verified
    inside: Optional[bool]
    #: pixels where silhouette and projection differ, and pixels of the silhouette; None if not known
    difference: Optional[float]
    area: Optional[float]

    @property
    def score(self) -> Optional[float]:
        """The share of the silhouette that the hull explains, 1 for a perfect fit; None if not known."""
        return None if not self.area else 1 - self.difference / self.area


class Hull(NamedTuple):
    """A visual hull."""

    #: the hull, a closed Polyhedron
    solid: Polyhedron
    #: a list of View
    views: List[View]
    #: the box that bounds it, two tuples of three Fractions
    box: tuple
    #: (view, reason) if nothing is left of the hull at that view; else None
    vanished: Optional[Tuple[str, str]]
    #: lines on how images were paired with views, where that was not obvious; they are warnings, too
    notes: Sequence[str] = ()


def _hull(answer):
    for note in answer["notes"]:
        warnings.warn(note, stacklevel=3)
    return Hull(answer["hull"], [View(*view) for view in answer["views"]], answer["box"], answer["vanished"],
                answer["notes"])


def _told(error, names):
    """The error with the view that it names, so that programs need not read it."""
    text = str(error)
    error.view = next((name for name in sorted(names, key=len, reverse=True) if name in text), None)
    return error


def compute(masks: Sequence[Any], cameras: Sequence[Any], names: Optional[Sequence[str]] = None, *, box: Any = None,
            tolerance: float = 0, half_pixels: bool = False, unknown_beyond: bool = False, verify: bool = True,
            threads: int = 1, progress: Progress = None) -> Hull:
    """The visual hull of masks.

    - masks: arrays of shape (H, W); what is not 0 is the object
    - cameras: matrices of shape (3, 4), one for each mask: x = P X, (x1 / x3, x2 / x3) = (right, down) in pixels, x3 > 0
      in front; floats are taken as the numbers that they are, Fractions as what they say
    - names: of the views, for messages; "view 0", ... if None
    - box: two corners that bound the hull; found from the cameras if None
    - tolerance: by how many pixels silhouettes may be simplified; 0 keeps every corner
    - half_pixels: False: whole coordinates are centres of pixels, as OpenCV has it; True: corners of pixels
    - unknown_beyond: what lies beyond the frame of an image is kept, not carved
    - verify: project the hull back, for `inside` and `score` of the views
    - threads: 0 for as many as the machine has; the result does not depend on it
    - progress: a function of (phase, view, done, total)

    Raises InputError, whose `view` is the name of the guilty one, for an empty mask or a matrix that is no camera.
    """
    masks = [numpy.asarray(mask) for mask in masks]
    cameras = [numpy.asarray(camera).tolist() for camera in cameras]
    names = [f"view {i}" for i in range(len(masks))] if names is None else [str(name) for name in names]
    if not len(masks) == len(cameras) == len(names):
        raise ValueError(f"{len(masks)} masks need as many cameras and names, not {len(cameras)} and {len(names)}")
    options = _visual_hull.Options(tolerance, half_pixels, unknown_beyond, box, verify, threads)
    with tempfile.TemporaryDirectory() as folder:
        images = []
        for i, mask in enumerate(masks):
            images.append(os.path.join(folder, f"{i}.png"))
            _visual_hull.write_mask((mask != 0).astype(numpy.uint8), images[-1])
        try:
            hull = _hull(_visual_hull.from_views(names, images, cameras, folder, options, progress))
        except InputError as error:
            raise _told(error, names) from None
    return hull._replace(views=[view._replace(image="") for view in hull.views])


def read(path: Any, *, box: Any = None, tolerance: float = 0, half_pixels: bool = False, unknown_beyond: bool = False,
         verify: bool = True, threads: int = 1, progress: Progress = None) -> Hull:
    """The visual hull of a scene: a file or folder of cameras and images in any format that the command reads (JSON,
    NeRF's transforms.json, COLMAP, Middlebury, matrices); see compute for the rest."""
    options = _visual_hull.Options(tolerance, half_pixels, unknown_beyond, box, verify, threads)
    return _hull(_visual_hull.from_file(os.fspath(path), options, progress))
