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

__all__ = ["Hull", "Masks", "RefinedView", "Refinement", "View", "compute", "masks", "read", "refine"]


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


class RefinedView(NamedTuple):
    """What has become of the camera of one view. Pixels are means over the view's outline."""

    name: str
    #: by how many pixels the image of the object has moved (root mean square), similarities of space aside
    moved: float
    #: by how many degrees the camera has turned towards the object
    turned: float
    #: pixels by which the outline is off, before and after
    before: float
    after: float
    #: "camera": it stood elsewhere and was moved; "mask": it disagrees wherever its camera stands; None
    fault: Optional[str]


class Refinement(NamedTuple):
    """Cameras from silhouettes."""

    #: matrices of shape (3, 4), to be given to compute
    cameras: List[Any]
    #: whether they are other than those given
    accepted: bool
    #: what was free: "turntable", "angles", "views", or "none"
    model: str
    #: pixels by which outlines are off (mean), before and after
    residual: Tuple[float, float]
    #: the same of pieces of outlines that the fit did not use
    held_out: Tuple[float, float]
    #: focal length of the first camera, in pixels
    focal: float
    #: what the silhouettes do not determine, in words
    undetermined: List[str]
    #: a list of RefinedView
    views: List[RefinedView]


def refine(masks: Sequence[Any], cameras: Optional[Sequence[Any]] = None, names: Optional[Sequence[str]] = None, *,
           half_pixels: bool = False, threads: int = 1) -> Refinement:
    """Cameras corrected so that the silhouettes agree, if pieces of outlines that were not used for that agree, too;
    otherwise those given. The result does not depend on the number of threads.

    - masks, names, half_pixels, threads: as compute has them
    - cameras: as compute has them; None: the masks are of one full turn of a turntable in equal steps of which nothing
      else is known, with square pixels; the camera then stands at a distance of about 1 from the axis, which is z

    Raises InputError for an empty mask, a matrix that is no camera, or too few views.
    """
    masks = [(numpy.asarray(mask) != 0).astype(numpy.uint8) for mask in masks]
    names = [f"view {i}" for i in range(len(masks))] if names is None else [str(name) for name in names]
    given = None if cameras is None else [numpy.asarray(camera).tolist() for camera in cameras]
    if len(masks) != len(names) or (given is not None and len(given) != len(masks)):
        raise ValueError(f"{len(masks)} masks need as many cameras and names")
    try:
        answer = _visual_hull.refine(names, masks, given, half_pixels, threads)
    except InputError as error:
        raise _told(error, names) from None
    matrices = [numpy.array(camera) for camera in answer["cameras"]]
    if not answer["accepted"] and cameras is not None:
        matrices = list(cameras)
    return Refinement(matrices, answer["accepted"], answer["model"], answer["residual"], answer["held_out"],
                      answer["focal"], answer["undetermined"], [RefinedView(*view) for view in answer["views"]])


class Masks(NamedTuple):
    """Masks of photographs."""

    #: arrays of shape (H, W), True where the object is
    masks: List[Any]
    #: how clearly both sides of each outline differ; 0: not at all
    quality: List[float]
    #: how they were made
    chosen: str
    #: masks to be looked at, and why; they are warnings, too
    notes: Sequence[str]


def masks(photographs: Sequence[Any], method: str = "auto", *, threads: int = 1) -> Masks:
    """Cuts one object out of photographs (files), by one rule for all: `method` is what `visual_hull --mask` takes
    ("auto", "threshold:red-blue", "background:median", "key:green", "grabcut", ...).

    Raises InputError for a photograph that cannot be read, and for a method that is none.
    """
    answer = Masks(*_visual_hull.masks([os.fspath(file) for file in photographs], method, threads))
    for note in answer.notes:
        warnings.warn(note, stacklevel=2)
    return answer
