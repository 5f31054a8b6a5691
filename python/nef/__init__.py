# SPDX-License-Identifier: Apache-2.0
"""Exact solid geometry: sets of points in space that no operation rounds.

    >>> import nef
    >>> a = nef.box((0, 0, 0), (2, 2, 2))
    >>> b = nef.box((1, 1, 1), (3, 3, 3)).interior()
    >>> (a - b).volume()
    Fraction(7, 1)
    >>> (1, 1, 1) in a - b, (1, 1, 1) in a & b
    (True, False)

A Polyhedron is any set made from half-spaces by intersection and complement: open or closed, bounded or not, of mixed
dimension. Numbers go in as ints, floats (the rational numbers that they are), Fractions, Decimals or text ("1/3"), and
come out as Fractions where they are exact. Lengths have the unit of the input.

Long calls release the interpreter's lock. In the main thread Ctrl-C ends a call within a few hundredths of a second: the
exception is raised at once, the computation stops soon after in its thread, and its result is discarded; sets are
immutable, so nothing is ever half done. Operators and functions of this package report their progress inside
`with nef.progress(function)`.

The applications are the modules nef.minkowski, nef.visual_hull, nef.planner and nef.remeshing, which are imported on first
use.
"""
import contextlib
import importlib.util
from typing import TYPE_CHECKING, Callable, Iterator, Optional

from . import _nef
from ._nef import (Polyhedron, TiledPolyhedron, __version__, box, cylinder, eval, everything, from_bytes, halfspace, hull,
                   intersect_all, mesh_with_origins, overlay, point, polygon, read, read_tiles, segment, sphere,
                   tiles_from_mesh, unite_all, unite_in_tiles)
from .errors import Error, InputError, InputWarning, MissingFileError, UnsupportedError
from .meshes import from_mesh, repair
from .notebook import show
from .results import (ApproximateMoments, Counts, Distance, Location, Measured, MeshWithOrigins, Millable, Moments, Penetration,
                      Polygon, RayHit, Reach, Repair, Section, SimplifiedOffset)
from . import meshes as _meshes, notebook as _notebook

__all__ = [
    "ApproximateMoments", "Counts", "Distance", "Error", "InputError", "InputWarning", "Location", "Measured", "MeshWithOrigins", "Millable", "MissingFileError", "Moments", "Penetration", "Polygon", "Polyhedron",
    "RayHit", "Reach", "Repair", "Section", "SimplifiedOffset", "TiledPolyhedron", "UnsupportedError", "box", "cylinder", "empty", "eval", "everything", "from_bytes", "from_mesh", "halfspace", "hull",
    "intersect_all", "mesh_with_origins", "overlay", "point", "polygon", "progress", "read", "read_tiles", "repair", "segment", "show", "sphere",
    "tiles_from_mesh", "unite_all", "unite_in_tiles",
]


if TYPE_CHECKING:
    from . import minkowski, planner, remeshing, visual_hull

_APPLICATIONS = ("minkowski", "planner", "remeshing", "visual_hull")


# What other packages call what this one has.
_OF_MODULE = {
    "union": "a | b, or unite_all", "intersection": "a & b, or intersect_all", "difference": "a - b",
    "symmetric_difference": "a ^ b", "complement": "~a", "cube": "box", "load": "read", "load_mesh": "read", "write": "a.write(path)", "save": "a.write(path)", "export": "a.write(path)", "Box": "box", "Sphere": "sphere",
    "mesh": "from_mesh", "Mesh": "from_mesh", "open": "read", "cone": "cylinder(height, radius, 0)",
    "extrude": "nef.minkowski.sum(polygon, segment)", "linear_extrude": "nef.minkowski.sum(polygon, segment)",
    "mirror": "a.scale((-1, 1, 1))", "section": "a.section(normal, offset)", "slice": "a.section(normal, offset)",
    "volume": "a.volume()", "distance": "a.distance(b)", "plot": "show", "view": "show", "Scene": "nef.planner.Scene",
    "convex_hull": "hull", "minkowski_sum": "minkowski.sum", "offset": "minkowski.offset",
    "decimate": "nef.remeshing.decimate", "simplify": "nef.remeshing.decimate", "subdivide": "nef.remeshing.subdivide",
}
_OF_SET = {
    "union": "a | b", "intersection": "a & b", "difference": "a - b", "symmetric_difference": "a ^ b", "complement": "~a",
    "issubset": "a <= b", "issuperset": "a >= b", "area": "surface_area", "bounds": "bounding_box", "copy": "a itself: sets are immutable",
    "vertices": "to_mesh, which returns vertices and faces", "faces": "to_mesh, which returns vertices and faces",
    "mesh": "to_mesh", "save": "write", "export": "write", "translated": "translate", "scaled": "scale", "rotated": "rotate",
    "transformed": "transform", "hull": "nef.minkowski.hull", "convex_hull": "nef.minkowski.hull",
    "offset": "nef.minkowski.offset", "minkowski_sum": "nef.minkowski.sum",
    "decimate": "nef.remeshing.decimate", "simplify": "nef.remeshing.decimate", "subdivide": "nef.remeshing.subdivide",
    "center": "moments().centroid", "centroid": "moments().centroid", "center_mass": "moments().centroid",
    "mirror": "scale((-1, 1, 1))", "slice": "section(normal, offset)", "cut": "section(normal, offset), or a & nef.halfspace(...)",
    "extrude": "nef.minkowski.sum(a, segment)", "erode": "nef.minkowski.erode", "is_convex": "nef.minkowski.is_convex",
    "inverse": "~a", "invert": "~a", "components": "split", "bbox": "bounding_box", "triangles": "to_mesh, which returns vertices and faces",
    "intersects": "isdisjoint, or distance", "show": "nef.show(a)", "plot": "nef.show(a)", "view": "nef.show(a)",
    "is_watertight": "to_mesh as it is: the mesh of a solid is always watertight", "is_valid": "it as it is: a set is always valid",
}


def _nearest(name, names):
    import difflib  # only after a mistake: it takes longer to import than the rest of the package

    near = () if name.startswith("_") else difflib.get_close_matches(name, [n for n in names if not n.startswith("_")], 1, 0.75)
    return f"; did you mean {near[0]!r}?" if near else ""


def _of_application(module, names, hints):
    """The __getattr__ of an application: what other names its functions may be looked for by."""
    def missing(name):
        hint = f"; use {hints[name]}" if name in hints else _nearest(name, names)
        raise AttributeError(f"module {module!r} has no attribute {name!r}{hint}")
    return missing


def __getattr__(name):
    if name not in _APPLICATIONS:
        hint = f"; use {_OF_MODULE[name]}" if name in _OF_MODULE else _nearest(name, __all__)
        raise AttributeError(f"module 'nef' has no attribute {name!r}{hint}")
    try:
        return importlib.import_module("nef." + name)
    except ImportError:
        if importlib.util.find_spec(f"nef._{name}") is not None:
            raise
    raise AttributeError(f"nef.{name} is not part of this build; CMake says which of its libraries are missing")


def __dir__():
    return sorted({*globals(), *_APPLICATIONS})


@contextlib.contextmanager
def progress(function: Optional[Callable[[str, int, int], object]]) -> Iterator[None]:
    """While the block runs, what it computes with nef's own operators and functions (Booleans, topological operations,
    unite_all, from_mesh, read) calls function(phase, done, total); a total of 0 means that it is not known.

    A large operation calls it some hundred times, a small one (a few thousand vertices) a few times. It may be called in
    another thread than the block's, one call at a time. An exception in it ends the operation, which raises it. Blocks
    nest; None switches reports off. The applications have `progress` arguments of their own.

    The block applies to its context (see contextvars): to no other task or thread, except those that run in a copy of the
    context, such as tasks that are made in the block and asyncio.to_thread.

        >>> with nef.progress(lambda phase, done, total: print(phase, done, total)):  # doctest: +SKIP
        ...     c = a - b
    """
    if function is not None and not callable(function):
        raise TypeError("progress must be a function or None")
    token = _nef._progress.set(function)
    try:
        yield
    finally:
        _nef._progress.reset(token)


def empty() -> Polyhedron:
    """The set without points."""
    return Polyhedron()


def _repr(self):
    if self.is_empty():
        return "<nef.Polyhedron: the empty set>"
    if self.is_everything():
        return "<nef.Polyhedron: all of space>"
    nouns = (("vertex", "vertices"), ("edge", "edges"), ("facet", "facets"), ("volume", "volumes"), ("shell", "shells"))
    counts = ", ".join(f"{count} {nouns[i][count != 1]}" for i, count in enumerate(self.counts()))
    return f"<nef.Polyhedron: {counts}>"


def _missing(self, name):
    hint = f"; use {_OF_SET[name]}" if name in _OF_SET else _nearest(name, dir(Polyhedron))
    raise AttributeError(f"'nef.Polyhedron' object has no attribute {name!r}{hint}")


def _tiled_repr(self):
    return f"<nef.TiledPolyhedron: {self.tile_count()} tiles, {self.vertex_count()} vertices in them>"


TiledPolyhedron.__module__ = "nef"
TiledPolyhedron.__repr__ = _tiled_repr
Polyhedron.__module__ = "nef"
Polyhedron.__repr__ = _repr
Polyhedron.__getattr__ = _missing
Polyhedron.to_trimesh = _meshes.to_trimesh
Polyhedron.to_open3d = _meshes.to_open3d
Polyhedron.to_meshio = _meshes.to_meshio
Polyhedron.to_pyvista = _meshes.to_pyvista
Polyhedron._repr_html_ = _notebook.html_of
Polyhedron._repr_png_ = _notebook.png_of
