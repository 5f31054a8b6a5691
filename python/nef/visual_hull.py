# SPDX-License-Identifier: Apache-2.0
"""Exact visual hulls: the largest set that fits all silhouettes.

    >>> hull = visual_hull.compute(masks, cameras, box=((-1, -1, -1), (1, 1, 1)))   # doctest: +SKIP
    >>> hull.solid.write("hull.off")                                               # doctest: +SKIP
"""
import os
import tempfile
import warnings
from typing import Any, Callable, List, NamedTuple, Optional, Sequence, Tuple

import numpy

from . import _of_application, _visual_hull
from ._nef import Polyhedron
from .arguments import shown
from .errors import InputError, InputWarning

Progress = Optional[Callable[[str, int, int], object]]

#: the board that is used if none is named
USUAL_BOARD = "charuco:7x5,30mm,22mm,DICT_5X5"

__all__ = ["CalibratedView", "Calibration", "Combination", "Hull", "Masks", "PlacedSeries", "RefinedView", "Refinement", "Texture",
           "USUAL_BOARD", "View", "board", "calibrate", "combine", "compute", "masks", "read", "refine"]

__getattr__ = _of_application(__name__, __all__, {"visual_hull": "compute", "hull": "compute", "load": "read"})


class View(NamedTuple):
    """The result for one view."""

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


class Texture(NamedTuple):
    """An image on the surface of a hull, from the photographs."""

    #: the corners of the hull's triangles, of shape (N, 3), rounded to single precision, which all formats keep
    vertices: Any
    #: three indices of vertices for each, of shape (M, 3)
    triangles: Any
    #: where the three corners of each triangle are in the image, of shape (M, 3, 2): from (0, 0) at the lower left to (1, 1)
    places: Any
    #: red, green and blue, of shape (H, W, 3)
    image: Any
    #: the share of the surface that no view sees; it has the colours of its neighbours
    unseen: float

    def write(self, path: Any) -> None:
        """Writes mesh and texture: .glb, .3mf, or .obj or .ply, whose image is a file beside them (NAME_texture.png)."""
        _visual_hull.write_textured(os.fspath(path), self.vertices, self.triangles, self.places, self.image)


class Hull(NamedTuple):
    """A visual hull."""

    #: the hull, a closed Polyhedron
    solid: Polyhedron
    #: a list of View
    views: List[View]
    #: the box that bounds it, two tuples of three Fractions
    box: tuple
    #: (view, reason) if the hull is empty or flat from that view on; else None
    vanished: Optional[Tuple[str, str]]
    #: lines on how images were paired with views, where that was not obvious, and the like; they are warnings, too
    notes: Sequence[str] = ()
    #: volumes of its pieces, the largest first, if there are several; of those that were left out, too
    pieces: Sequence[float] = ()
    #: names of the views that disagree with the others, with `suspects` or `drop_suspects`; those left out first
    suspects: Sequence[str] = ()
    #: a Refinement, if the cameras were refined
    refinement: Optional["Refinement"] = None
    #: a Texture, if there are photographs and it was wished for
    texture: Optional[Texture] = None


_OPTIONS = dict(box=None, tolerance=0, outer=False, soft=False, min_area=0, half_pixels=False, unknown_beyond=False, images=None,
                mask=None, threshold=None, channel=None, invert=False, way="best", repair_masks=False, refine=False, suspects=False, drop_suspects=False, at_least=None,
                largest=False, verify=True, threads=1)


def _options(**given):
    return _visual_hull.Options({**_OPTIONS, **given})


def _hull(answer):
    for note in answer["notes"]:
        warnings.warn(note, InputWarning, stacklevel=3)
    refinement = answer["refinement"]
    return Hull(answer["hull"], [View(*view) for view in answer["views"]], answer["box"], answer["vanished"],
                answer["notes"], answer["pieces"], answer["suspects"], refinement and _refinement(refinement),
                answer["texture"] and Texture(*answer["texture"]))


def _files(files):
    """The names of files, of which there is a list."""
    if isinstance(files, (str, bytes, os.PathLike)):
        raise TypeError(f"photographs must be a list of files, such as sorted(glob.glob('photographs/*.png')), not {shown(files)}")
    return [os.fspath(file) for file in files]


def _mask(mask):
    if isinstance(mask, (str, bytes, os.PathLike)):
        raise TypeError(f"a mask is an array of shape (H, W), not {shown(mask)}; read() takes files")
    return numpy.asarray(mask)


def _opacity(mask, soft):
    """Bytes: 255 where a mask is not 0, or, if `soft`, what the mask has."""
    if not soft:
        return numpy.where(mask != 0, 255, 0).astype(numpy.uint8)
    if mask.dtype == bool or mask.size and not (0 <= mask.min() and mask.max() <= 255):
        raise InputError("soft masks are numbers from 0 to 255")
    return mask.astype(numpy.uint8)


def _opacities(masks, names, soft):
    """The bytes of all masks, which must show something."""
    opacities = [_opacity(mask, soft) for mask in masks]
    for name, opacity in zip(names, opacities):
        if not (opacity >= 128).any():
            why = "no number of its mask is 128 or more" if soft else "its mask is 0 everywhere"
            raise InputError(f"{name}: the silhouette is empty: {why}", view=name)
    return opacities


def _told(error, names):
    """The error with `view` set to the view that its text names."""
    text = str(error).replace("view view ", "view ")  # "view 0" is a name
    error.args = (text,)
    error.view = next((name for name in sorted(names, key=len, reverse=True) if name in text), None)
    return error


def compute(masks: Sequence[Any], cameras: Sequence[Any], names: Optional[Sequence[str]] = None, *, box: Any = None,
            tolerance: float = 0, outer: bool = False, soft: bool = False, min_area: float = 0, half_pixels: bool = False,
            unknown_beyond: bool = False, lens: Any = None, photographs: Optional[Sequence[Any]] = None, suspects: bool = False, drop_suspects: bool = False,
            at_least: Optional[int] = None, largest: bool = False, verify: bool = True, threads: int = 1,
            progress: Progress = None) -> Hull:
    """The visual hull of masks.

    - masks: arrays of shape (H, W); what is not 0 is the object
    - cameras: matrices of shape (3, 4), one for each mask: x = P X, (x1 / x3, x2 / x3) = (right, down) in pixels, x3 > 0
      in front; floats and Fractions are taken exactly
    - names: names of the views for messages; "view 0", ... if None
    - box: two corners that bound the hull; found from the cameras if None
    - tolerance: by how many pixels silhouettes may be simplified; 0 keeps every corner
    - outer: simplified silhouettes contain the masks, so the hull is an outer bound
    - soft: masks are opacities from 0 to 255, and outlines run where these are half, between centres of pixels, instead of
      along edges of pixels
    - min_area: islands and holes of fewer square pixels are dropped and filled (with outer: holes only)
    - half_pixels: False: whole coordinates are centres of pixels, as OpenCV has it; True: corners of pixels
    - unknown_beyond: keep, instead of carving, what lies beyond the frame of an image
    - lens: the distortion that the masks have, (K, coefficients) as OpenCV has them, or one such pair per mask;
      the matrices are those of the undistorted images
    - photographs: arrays of shape (H, W, 3), one for each mask, from which `texture` of the result is made
    - suspects: compare the views, for `suspects`; drop_suspects: leave out the one that disagrees, and so on
    - at_least: the points in at least this many silhouettes, instead of in all; not verified
    - largest: keep the piece of the largest volume only
    - verify: project the hull back, for `inside` and `score` of the views
    - threads: 0 for as many as the machine has; the result does not depend on it
    - progress: a function of (phase, done, total): the phase and the view at work, "contours left.png"

    Raises InputError, whose `view` is the name of the view at fault, for an empty mask or a matrix that is not a camera.
    """
    masks = [_mask(mask) for mask in masks]
    if not masks:
        raise InputError("there are no masks: one array of shape (H, W) for each camera is needed")
    cameras = [numpy.asarray(camera).tolist() for camera in cameras]
    names = [f"view {i}" for i in range(len(masks))] if names is None else [str(name) for name in names]
    if not len(masks) == len(cameras) == len(names):
        raise InputError(f"{len(masks)} masks need as many cameras and names, not {len(cameras)} and {len(names)}")
    if photographs is not None:
        shapes = [numpy.shape(photograph) for photograph in photographs]
        if shapes != [(*mask.shape, 3) for mask in masks]:
            raise InputError("each mask of shape (H, W) needs a photograph of shape (H, W, 3)")
    lenses = None if lens is None else _lenses(lens, len(masks))
    options = _options(box=box, tolerance=tolerance, outer=outer, soft=soft, min_area=min_area, half_pixels=half_pixels,
                       unknown_beyond=unknown_beyond, suspects=suspects, drop_suspects=drop_suspects, at_least=at_least,
                       largest=largest, verify=verify, threads=threads)
    opacities = _opacities(masks, names, soft)
    with tempfile.TemporaryDirectory() as folder:
        images = _written(opacities, photographs, folder)
        try:
            hull = _hull(_visual_hull.from_views(names, images, cameras, lenses, folder, options, photographs is not None,
                                                 progress))
        except InputError as error:
            for image, name in zip(images, names):
                error.args = (str(error).replace(image, f"the mask of {name}"),)
            raise _told(error, names) from None
    return hull._replace(views=[view._replace(image="") for view in hull.views])


def _written(masks, photographs, folder):
    """Writes masks into `folder`/masks and photographs, if any, into `folder`/images; the files of the masks."""
    images = []
    for sub in ("masks", "images"):
        os.mkdir(os.path.join(folder, sub))
    for i, mask in enumerate(masks):
        images.append(os.path.join(folder, "masks", f"{i}.png"))
        _visual_hull.write_mask(mask, images[-1])
        if photographs is not None:
            _visual_hull.write_photograph(numpy.asarray(photographs[i], numpy.uint8), os.path.join(folder, "images", f"{i}.png"))
    return images


def _lenses(lens, count):
    """A pair of K and coefficients for each of `count` masks."""
    pairs = [lens] * count if len(lens) == 2 and len(lens[0]) == 3 else list(lens)  # K has three rows
    if len(pairs) != count:
        raise InputError(f"{count} masks need one lens, or as many, not {len(pairs)}")
    return [(numpy.asarray(k).tolist(), [float(c) for c in coefficients]) for k, coefficients in pairs]


def read(path: Any, *, box: Any = None, tolerance: float = 0, outer: bool = False, soft: bool = False, min_area: float = 0,
         half_pixels: bool = False, unknown_beyond: bool = False, images: Any = None, without: Sequence[str] = (), threshold: Any = None,
         channel: Optional[str] = None, invert: bool = False, mask: Optional[str] = None, repair_masks: bool = False,
         matrices: Optional[str] = None, up: Optional[str] = None, turntable: Optional[int] = None,
         intrinsics: Optional[Sequence[float]] = None, radius: Optional[float] = None, height: float = 0,
         refine: bool = False, suspects: bool = False, drop_suspects: bool = False, at_least: Optional[int] = None,
         largest: bool = False, way: str = "best", texture: bool = False, verify: bool = True, threads: int = 1,
         progress: Progress = None) -> Hull:
    """The visual hull of a scene: a file or folder of cameras and images in any format that `visual_hull` reads (JSON,
    NeRF's transforms.json, COLMAP, Middlebury, matrices); arguments as in compute, and:

    - images: a folder with an image for each view, instead of those that the scene names
    - without: names of views that are left out
    - threshold, channel, invert: pixels brighter than `threshold` (a number or "otsu") in this channel ("red", ...) are the
      object; with `invert`, those that are darker
    - matrices: which matrices of an OpenCV or MATLAB file are the projections, such as "world_mat_*"
    - up: the axis of the scene that becomes +z: "x", "y", "z", "-x", "-y" or "-z"
    - turntable: `path` is a folder of images between which the object turns by 1/turntable of a turn (negative: clockwise);
      `intrinsics` (f, cx, cy or fx, fy, cx, cy or nine numbers), `radius` (distance of the camera from the axis, which is z)
      and `height` (above the origin, which it looks at) describe the camera; without them `refine` finds it
    - mask: the images are photographs, of which masks are made by this method, as in `masks`
    - repair_masks: correct pixels of these masks that the other views contradict; `notes` report each change
    - refine: correct the cameras by the silhouettes first, as in `refine`
    - way: "direct" (vertex by vertex), "cones", or "best", whichever suits the views; the hull is the same
    - texture: make `texture` of the result from the photographs: the images themselves, or for masks/NAME those of the same
      names in images/
    """
    options = _options(box=box, tolerance=tolerance, outer=outer, soft=soft, min_area=min_area, half_pixels=half_pixels,
                       unknown_beyond=unknown_beyond, images=None if images is None else os.fspath(images), mask=mask,
                       threshold=threshold, channel=channel, invert=invert, way=way, repair_masks=repair_masks, refine=refine, suspects=suspects, drop_suspects=drop_suspects,
                       at_least=at_least, largest=largest, verify=verify, threads=threads)
    table = None if turntable is None else dict(turntable=turntable, intrinsics=intrinsics, radius=radius, height=height)
    try:
        return _hull(_visual_hull.from_file(os.fspath(path), options, matrices or "", up or "", table, [str(name) for name in without], texture, progress))
    except InputError as error:
        error.args = (str(error).replace("--texture", "texture"),)
        raise


class RefinedView(NamedTuple):
    """The refined camera of one view. Pixels are means over the view's outline."""

    name: str
    #: by how many pixels the image of the object has moved (root mean square), similarities of space aside
    moved: float
    #: by how many degrees the camera has turned towards the object
    turned: float
    #: pixels by which the outline is off, before and after
    before: float
    after: float
    #: "camera": it was off and was moved; "mask": the mask disagrees wherever the camera is placed; None
    fault: Optional[str]


class Refinement(NamedTuple):
    """Cameras from silhouettes."""

    #: matrices of shape (3, 4), to be given to compute
    cameras: List[Any]
    #: whether they replace those given
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
           half_pixels: bool = False, soft: bool = False, camera_error: Optional[float] = None, threads: int = 1) -> Refinement:
    """Corrects cameras so that the silhouettes agree, if this also improves pieces of outlines that were not used;
    otherwise returns those given. The result does not depend on the number of threads.

    - masks, names, half_pixels, soft, threads: as in compute
    - cameras: as in compute; None: the masks are of one full turn of a turntable in equal steps, with square pixels, of
      which nothing else is known; the distance of the camera from the axis, which is z, is then about 1
    - camera_error: by how many pixels the cameras are known to be off in their images of the object (root mean square; as
      Calibration has it): they stay as near as that, unless the silhouettes say more

    Raises InputError for an empty mask, a matrix that is not a camera, or too few views.
    """
    masks = [_mask(mask) for mask in masks]
    names = [f"view {i}" for i in range(len(masks))] if names is None else [str(name) for name in names]
    given = None if cameras is None else [numpy.asarray(camera).tolist() for camera in cameras]
    if len(masks) != len(names) or (given is not None and len(given) != len(masks)):
        raise InputError(f"{len(masks)} masks need as many cameras and names")
    opacities = _opacities(masks, names, soft)
    try:
        answer = _visual_hull.refine(names, opacities, given, half_pixels, soft, camera_error, threads)
    except InputError as error:
        raise _told(error, names) from None
    found = _refinement(answer)
    return found if found.accepted or cameras is None else found._replace(cameras=list(cameras))


def _refinement(answer):
    return Refinement([numpy.array(camera) for camera in answer["cameras"]], answer["accepted"], answer["model"],
                      answer["residual"], answer["held_out"], answer["focal"], answer["undetermined"],
                      [RefinedView(*view) for view in answer["views"]])


class Masks(NamedTuple):
    """Masks of photographs."""

    #: arrays of shape (H, W), True where the object is; if soft, opacities from 0 to 255
    masks: List[Any]
    #: how clearly both sides of each outline differ; 0: not at all
    quality: List[float]
    #: how they were made
    chosen: str
    #: masks to check, and why; they are warnings, too
    notes: Sequence[str]


def masks(photographs: Sequence[Any], method: str = "auto", *, soft: bool = False, threads: int = 1) -> Masks:
    """Cuts one object out of photographs (files), by one method for all, as `visual_hull --mask` takes it
    ("auto", "threshold:red-blue", "background:median", "key:green", "grabcut", ...). With `soft`, masks are opacities, for
    `compute(..., soft=True)`: outlines to a fraction of a pixel, except from "grabcut".

    Raises InputError for a photograph that cannot be read, and for an unknown method.
    """
    answer = Masks(*_visual_hull.masks(_files(photographs), method, soft, threads))
    if not soft:
        answer = answer._replace(masks=[mask != 0 for mask in answer.masks])
    for note in answer.notes:
        warnings.warn(note, InputWarning, stacklevel=2)
    return answer


def board(path: Any, description: str = USUAL_BOARD) -> None:
    """Writes a ChArUco board for printing, by which `calibrate` finds cameras: .pdf or .svg, to scale, or .png.

    `description` is "charuco:COLUMNSxROWS,SQUARE,MARKER,DICTIONARY", lengths in mm unless m, cm or in follows. Raises
    InputError for any other description or extension.
    """
    data = _visual_hull.board(description, os.path.splitext(os.fspath(path))[1])
    with open(path, "wb") as file:
        file.write(data)


class CalibratedView(NamedTuple):
    """The result for one photograph."""

    photograph: str
    #: corners of the board that were found, without those that the camera does not follow, if it has one
    corners: int
    #: places on borders between black and white that the camera follows; 0: it follows the corners, or was refused
    borders: int
    #: pixels that borders (corners, if there are none) are off by from where the camera sees them (root mean square);
    #: None if it was refused
    error: Optional[float]
    #: the matrix of shape (3, 4), in millimetres from the middle of the board, z up, the lens undone; None if refused
    camera: Any
    #: why the photograph was refused; None: it has a camera
    refused: Optional[str]


class Calibration(NamedTuple):
    """Cameras by a board."""

    #: focal lengths along x and y, in pixels
    focal: Tuple[float, float]
    #: standard deviation of the focal length, as a share of it
    focal_deviation: float
    #: where the axis of the lens meets the image, in pixels
    principal_point: Tuple[float, float]
    #: whether that is the middle of the image because the boards do not determine it
    principal_point_assumed: bool
    #: k1, k2, p1, p2, k3, as OpenCV has them
    distortion: List[float]
    #: the same of all views
    error: float
    #: pixels that the cameras are off by in their images of things on the board, as far as the noise of borders tells
    camera_error: Optional[float]
    #: a list of CalibratedView, in the order of the photographs
    views: List[CalibratedView]
    #: the same of the photographs that the lens was determined by, if there were any
    lens_views: List[CalibratedView]
    #: photographs that were refused, and what the series does not determine; they are warnings, too
    notes: Sequence[str]


def calibrate(photographs: Sequence[Any], board: str = USUAL_BOARD, *, lens: Sequence[Any] = (), scene: Any = None,
              threads: int = 1) -> Calibration:
    """The cameras of photographs (files) of an object that lies on a board, or turns with it.

    - board: a description as in `board`
    - lens: photographs of the board at several tilts, by the same camera at the same zoom and focus, that determine the
      lens; if there are none, the photographs themselves do
    - scene: a file (.json) for the cameras, their lens and the names of the photographs, to be given to `read`

    Raises InputError if the board is found in fewer than three photographs, or for a file that is not an image.
    """
    answer = _visual_hull.calibrate(_files(photographs), board, _files(lens), "" if scene is None else os.fspath(scene),
                                    threads)
    for note in answer["notes"]:
        warnings.warn(note, InputWarning, stacklevel=2)
    for key in "views", "lens_views":
        answer[key] = [CalibratedView(*view)._replace(camera=None if view[4] is None else numpy.array(view[4]))
                       for view in answer[key]]
    return Calibration(**answer)


class PlacedSeries(NamedTuple):
    """The place of a series of views in the space of the first one. Pixels are means over all outlines."""

    #: the file of its scene
    scene: str
    #: how many it has
    views: int
    #: whether the outlines of both agree nearly as well as those of each series
    fits: bool
    #: whether another place fits nearly as well
    ambiguous: bool
    #: a point X of its space is at scale * rotation @ X + translation in that of the first
    rotation: Any
    scale: float
    translation: Any
    #: by how much outlines are off within each series, among both, and where the fit did not use them
    alone: float
    together: float
    held_out: float
    #: the same of the next best place, by some of the views
    runner_up: float


class Combination(NamedTuple):
    """Several series of one object in one space."""

    #: whether all series fit, and the scene was written
    fits: bool
    #: a list of PlacedSeries, all but the first
    series: List[PlacedSeries]
    #: what to look at; they are warnings, too
    notes: Sequence[str]


def combine(scenes: Sequence[Any], scene: Any, *, soft: bool = False, min_area: float = 0, threshold: Any = None, channel: Optional[str] = None,
            invert: bool = False, mask: Optional[str] = None, threads: int = 1) -> Combination:
    """Places series of photographs of one rigid object, which was turned over in between, by their silhouettes.

    - scenes: two files or more, one for each pose, as `read` takes them, with their images
    - scene: the file (.json) with the cameras of all views, in the space of the first series, to be given to `read`; its hull
      is the intersection of the hulls of all series
    - the others: how images become silhouettes, as in `read`

    If a series fits nowhere, `fits` is False and nothing is written. Raises InputError for fewer than two scenes, and for
    images or cameras that `read` refuses.
    """
    if isinstance(scenes, (str, bytes, os.PathLike)):
        raise TypeError(f"scenes must be a list of files, not {shown(scenes)}")
    options = _options(soft=soft, min_area=min_area, threshold=threshold, channel=channel, invert=invert, mask=mask, threads=threads)
    series, notes = _visual_hull.combine([os.fspath(file) for file in scenes], os.fspath(scene), options)
    for note in notes:
        warnings.warn(note, InputWarning, stacklevel=2)
    placed = [PlacedSeries(*one)._replace(rotation=numpy.array(one[4]), translation=numpy.array(one[6])) for one in series]
    return Combination(all(one.fits for one in placed), placed, notes)
