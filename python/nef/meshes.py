# SPDX-License-Identifier: Apache-2.0
"""Meshes of other packages, by what they look like. Each package is imported only when one of its objects is used."""
import os
from typing import Any

import numpy

from . import _nef
from ._nef import Polyhedron
from .errors import InputError
from .results import Repair


def _arrays_of(mesh):
    """(vertices, faces) of a mesh object: trimesh, Open3D, meshio, pyvista, or anything with .vertices and .faces."""
    vertices = getattr(mesh, "vertices", None)
    if vertices is not None:
        faces = getattr(mesh, "faces", None)
        if faces is None:
            faces = getattr(mesh, "triangles", None)  # Open3D
        if faces is not None:
            return numpy.asarray(vertices), _indices(faces)
    points = getattr(mesh, "points", None)
    if points is not None and hasattr(mesh, "cells") and isinstance(mesh.cells, (list, tuple)):  # meshio
        # In the newer versions a block is an object with type and data, in the older ones a pair of these.
        faces = []
        for block in mesh.cells:
            kind, data = (block.type, block.data) if hasattr(block, "data") else block
            if kind in ("triangle", "quad", "polygon"):
                faces.extend(numpy.asarray(data).tolist())
        return _three_columns(points), faces
    if points is not None and hasattr(mesh, "faces"):  # pyvista: 3, a, b, c, 4, a, b, c, d, ...
        flat = numpy.asarray(mesh.faces)
        faces, at = [], 0
        while at < len(flat):
            faces.append(flat[at + 1:at + 1 + flat[at]].tolist())
            at += 1 + flat[at]
        return numpy.asarray(points), faces
    hint = "; nef.read reads a file" if isinstance(mesh, (str, os.PathLike)) else ""
    raise TypeError(
        f"a mesh needs .vertices and .faces; {type(mesh).__name__} has neither these nor .points and .cells{hint}")


def _three_columns(points):
    points = numpy.asarray(points)
    if points.ndim == 2 and points.shape[1] == 2:  # meshio leaves z out of flat meshes
        points = numpy.column_stack([points, numpy.zeros(len(points))])
    return points


def _indices(faces):
    """An integer array, or a list of lists where faces have different numbers of corners."""
    if isinstance(faces, numpy.ndarray) and faces.dtype.kind in "iu":
        if faces.ndim != 2:
            raise InputError(f"faces must be an array of shape (M, K) or a list of lists of indices, not of shape {faces.shape}")
        return faces
    try:
        faces = list(faces)
        sizes = {len(face) for face in faces}
    except TypeError:
        return faces  # the error of what follows names what is no list
    if len(sizes) == 1:
        array = numpy.asarray(faces)
        if array.dtype.kind in "iu":
            return array
    return faces


def from_mesh(vertices: Any, faces: Any = None, *, strict: bool = False, surface: bool = False,
              check: bool = True, crossings: str = "refuse", close: float = 0) -> Polyhedron:
    """The closed solid that a closed orientable mesh bounds.

    - vertices: array of shape (N, 3) of floats, integers or Fractions (dtype object); or, without `faces`, a mesh object:
      of trimesh, Open3D, meshio, pyvista, or anything with .vertices and .faces
    - faces: integer array of shape (M, K), or a sequence of M sequences of vertex numbers, counterclockwise as seen from
      outside
    - strict: refuse faces that are not exactly planar instead of triangulating them with a warning
    - surface: take the union of the faces as a two-dimensional set; any mesh will do
    - check: detect faces that meet outside of common vertices and edges (a fourth of the time). Set it to False only if
      there are none: some are found anyway, others would make the set meaningless
    - crossings: which points are inside a closed mesh whose faces cross or that encloses points several times, by winding
      number: "refuse" (an InputError), "union" (enclosed at least once), "nonzero" (parts that are inside out, too),
      "odd" (overlaps are cavities), "outside" (not reachable from outside), "guess" (for meshes with holes: a winding
      number of at least one half). A warning reports the choice. "odd" and "outside" ignore the orientation of faces
    - close: a percentage; True is 10, as of `nef repair --close` without a number. If above 0, a mesh that does not bound a solid is repaired as by
      `nef repair --close`: its holes get lids if these have at most this percentage of the area of the mesh with lids.
      Open pieces that lie in one plane are left out, unless the rule is "outside" or "guess".
      Lids are a guess, and reported as a warning

    A mesh may touch itself; a mesh without vertices and faces is the empty set (with a warning). Raises InputError if the
    mesh is open, inconsistently oriented, crosses itself, or has vertices but no faces; `vertices`, `edges` and `faces` of
    the error are the elements at fault.
    """
    return _nef._from_mesh(*_vertices_and_faces(vertices, faces), strict, surface, check, crossings, close)


def repair(vertices: Any, faces: Any = None, *, crossings: str = "union", close: float = 0, fill_holes: bool = False,
           strict: bool = False) -> Repair:
    """Repairs a mesh that does not bound a solid, as `nef repair`: the solid, and what happened to each face.

    A mesh that bounds a solid is not changed. Otherwise doubled faces and faces without area are removed, T-junctions are
    closed, and faces are flipped to match adjacent faces, components outward. Holes are closed with `close` (percent of the
    area, see from_mesh) or `fill_holes` (planar holes of any size). Crossings that remain are resolved by the rule
    `crossings`. Vertices do not move.

        >>> r = nef.repair([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
        >>> r.set.volume(), r.done
        (Fraction(1, 6), ['1 face flipped to match adjacent faces'])
    """
    return _nef._repair(*_vertices_and_faces(vertices, faces), strict, fill_holes, crossings, close)


def _vertices_and_faces(vertices, faces):
    if faces is None:
        vertices, faces = _arrays_of(vertices)
    else:
        faces = _indices(faces)
    return vertices, faces


def _with_offset(mesh, offset):
    return (mesh, *offset) if offset else mesh


def to_trimesh(self, manifold=False, recenter=False, repair=False, **options):
    """The boundary as a trimesh.Trimesh; vertices are left as they are (process=False). Needs trimesh.

    - manifold, recenter, repair: as in `to_mesh`; with `recenter` the result is the mesh and what was subtracted
    - options: for trimesh.Trimesh
    """
    import trimesh

    vertices, faces, *offset = self.to_mesh(manifold=manifold, recenter=recenter, repair=repair)
    return _with_offset(trimesh.Trimesh(vertices=vertices, faces=faces, **{"process": False, **options}), offset)


def to_open3d(self, manifold=False, recenter=False, repair=False):
    """The boundary as an open3d.geometry.TriangleMesh; arguments as for `to_trimesh`. Needs Open3D."""
    import open3d

    vertices, faces, *offset = self.to_mesh(manifold=manifold, recenter=recenter, repair=repair)
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(vertices),
                                        open3d.utility.Vector3iVector(faces.astype(numpy.int32)))
    return _with_offset(mesh, offset)


def to_meshio(self, polygons=False, manifold=False, recenter=False, repair=False):
    """The boundary as a meshio.Mesh of triangles; with `polygons`, facets without holes stay whole. Needs meshio.

    Other arguments as for `to_trimesh`.
    """
    import meshio

    vertices, faces, *offset = self.to_mesh(polygons=polygons, manifold=manifold, recenter=recenter, repair=repair)
    if not polygons:
        return _with_offset(meshio.Mesh(vertices, [("triangle", faces)]), offset)
    names = {3: "triangle", 4: "quad"}
    blocks = []
    for size in sorted({len(face) for face in faces}):
        blocks.append((names.get(size, "polygon"), numpy.array([face for face in faces if len(face) == size])))
    return _with_offset(meshio.Mesh(vertices, blocks), offset)


def to_pyvista(self, manifold=False, recenter=False, repair=False):
    """The boundary as a pyvista.PolyData; arguments as for `to_trimesh`. Needs pyvista."""
    import pyvista

    vertices, faces, *offset = self.to_mesh(manifold=manifold, recenter=recenter, repair=repair)
    table = numpy.column_stack([numpy.full(len(faces), 3), faces]).ravel()
    return _with_offset(pyvista.PolyData(vertices, table), offset)
