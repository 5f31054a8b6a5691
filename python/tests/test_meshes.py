# SPDX-License-Identifier: Apache-2.0
"""Meshes in and out: arrays, files, and the meshes of other packages.

Open3D and meshio are tested for real where they are installed. trimesh and pyvista are not in Debian: what goes in is
tested with stand-ins that have their attributes, what comes out with a module of that name that keeps what it is given.
"""
import sys
import types
from fractions import Fraction

import numpy
import pytest

import nef

VERTICES = numpy.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]], float)
FACES = numpy.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
TETRAHEDRON = nef.hull(VERTICES)
SQUARES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
CORNERS = [[i & 1, i >> 1 & 1, i >> 2] for i in range(8)]


def test_arrays_in():
    for vertices in (VERTICES, VERTICES.astype(int), VERTICES.tolist(),
                     numpy.array([[Fraction(x) for x in v] for v in VERTICES], dtype=object)):
        for faces in (FACES, FACES.tolist(), FACES.astype(numpy.uint32)):
            assert nef.from_mesh(vertices, faces) == TETRAHEDRON
    assert nef.from_mesh(CORNERS, SQUARES) == nef.box((0, 0, 0), (1, 1, 1))
    # Triangles and squares together.
    mixed = SQUARES[1:] + [[0, 2, 3], [0, 3, 1]]
    assert nef.from_mesh(CORNERS, mixed) == nef.box((0, 0, 0), (1, 1, 1))
    third = [[Fraction(x, 3) for x in v] for v in CORNERS]
    assert nef.from_mesh(third, SQUARES).volume() == Fraction(1, 27)
    assert nef.from_mesh(VERTICES, FACES[:1], surface=True).volume() == 0


def test_arrays_out():
    vertices, faces = TETRAHEDRON.to_mesh()
    assert vertices.dtype == float and vertices.shape == (4, 3) and faces.shape == (4, 3)
    assert nef.from_mesh(vertices, faces) == TETRAHEDRON
    third = TETRAHEDRON.scale("1/3")
    vertices, faces = third.to_mesh(exact=True)
    assert vertices.dtype == object and nef.from_mesh(vertices, faces) == third
    vertices, faces = nef.box((0, 0, 0), (1, 1, 1)).to_mesh(polygons=True)
    assert sorted(len(face) for face in faces) == [4] * 6
    assert nef.from_mesh(vertices, faces) == nef.box((0, 0, 0), (1, 1, 1))
    with pytest.warns(UserWarning):
        (TETRAHEDRON | nef.segment((5, 5, 5), (6, 6, 6))).to_mesh()


def test_guilty_elements():
    with pytest.raises(nef.InputError) as caught:
        nef.from_mesh(VERTICES, FACES[:3])
    assert set(map(frozenset, caught.value.edges)) == {frozenset(e) for e in ((1, 2), (2, 3), (1, 3))}
    flipped = FACES.copy()
    flipped[0] = flipped[0][::-1]
    with pytest.raises(nef.InputError) as caught:
        nef.from_mesh(VERTICES, flipped)
    assert 0 in caught.value.faces
    with pytest.raises(nef.InputError, match="vertex 9"):
        nef.from_mesh(VERTICES, [[0, 1, 9]])
    with pytest.raises(nef.InputError):
        nef.from_mesh(VERTICES, FACES + (FACES == 3) * -9)
    crossing = numpy.vstack([VERTICES, VERTICES + [0.5, 0.5, -0.5]])
    with pytest.raises(nef.InputError) as caught:
        nef.from_mesh(crossing, numpy.vstack([FACES, FACES + 4]))
    assert len(caught.value.faces) >= 2
    with pytest.raises(ValueError):
        nef.from_mesh(VERTICES.ravel(), FACES)
    with pytest.raises(TypeError):
        nef.from_mesh(VERTICES, FACES.astype(float))
    with pytest.raises(TypeError, match="neither"):
        nef.from_mesh(object())


@pytest.mark.parametrize("check", [True, False])
def test_folded_surfaces(check):
    """Faces that lie on each other, turned against each other, enclose nothing; beside a solid they add nothing."""
    square = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    for vertices, faces in ((square[:3], [[0, 1, 2], [0, 2, 1]]), (square, [[0, 1, 2, 3], [3, 2, 1, 0]]),
                            (square, [[0, 1, 2, 3], [2, 1, 0], [3, 2, 0]])):
        with pytest.raises(nef.InputError, match="enclose nothing"):
            nef.from_mesh(vertices, faces, check=check)
    assert nef.from_mesh(VERTICES, [*FACES.tolist(), [0, 1, 2], [0, 2, 1]], check=check) == TETRAHEDRON


def test_meshes_without_faces():
    """The empty set, as files hold it; vertices alone are no set."""
    for vertices, faces in (([], []), (numpy.zeros((0, 3)), numpy.zeros((0, 3), int))):
        with pytest.warns(UserWarning, match="empty set"):
            assert nef.from_mesh(vertices, faces).is_empty()
    with pytest.raises(nef.InputError, match="no faces"):
        nef.from_mesh(VERTICES, numpy.zeros((0, 3), int))


@pytest.mark.parametrize("extension", ["off", "obj", "stl", "ply", "nef", "nef3"])
def test_files(tmp_path, extension):
    path = tmp_path / f"set.{extension}"
    TETRAHEDRON.write(path)
    assert nef.read(path) == TETRAHEDRON
    assert nef.read(str(path)) == TETRAHEDRON


def test_wrong_files(tmp_path):
    with pytest.raises(nef.InputError, match="nowhere"):
        nef.read(tmp_path / "nowhere.off")
    (tmp_path / "bad.off").write_text("OFF\n1 1 0\n0 0\n")
    with pytest.raises(nef.InputError, match="bad.off"):
        nef.read(tmp_path / "bad.off")
    with pytest.raises(nef.InputError) as caught:
        nef.eval("box(0,0,0, 1,1,1) + ")
    assert caught.value.offset is not None
    assert nef.eval("box(0,0,0, 1,1,0.1) - point(1,1,0.1)") == nef.box((0, 0, 0), (1, 1, "0.1")) - nef.point((1, 1, "0.1"))


def test_stand_ins_of_trimesh_and_pyvista(monkeypatch):
    trimesh_like = types.SimpleNamespace(vertices=VERTICES, faces=FACES)
    assert nef.from_mesh(trimesh_like) == TETRAHEDRON
    pyvista_like = types.SimpleNamespace(points=VERTICES, faces=numpy.column_stack([[3] * 4, FACES]).ravel())
    assert nef.from_mesh(pyvista_like) == TETRAHEDRON
    made = []
    monkeypatch.setitem(sys.modules, "trimesh", types.SimpleNamespace(Trimesh=lambda **given: made.append(given)))
    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(PolyData=lambda *given: made.append(given)))
    TETRAHEDRON.to_trimesh()
    TETRAHEDRON.to_pyvista()
    assert nef.from_mesh(made[0]["vertices"], made[0]["faces"]) == TETRAHEDRON and made[0]["process"] is False
    assert nef.from_mesh(types.SimpleNamespace(points=made[1][0], faces=made[1][1])) == TETRAHEDRON


def test_meshio(tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh = TETRAHEDRON.to_meshio()
    assert nef.from_mesh(mesh) == TETRAHEDRON
    box = nef.box((0, 0, 0), (1, 2, 3))
    assert nef.from_mesh(box.to_meshio(polygons=True)) == box
    meshio.write(tmp_path / "set.vtu", mesh)
    assert nef.from_mesh(meshio.read(tmp_path / "set.vtu")) == TETRAHEDRON


def test_open3d():
    open3d = pytest.importorskip("open3d")
    mesh = TETRAHEDRON.to_open3d()
    assert mesh.is_watertight()
    assert nef.from_mesh(mesh) == TETRAHEDRON
    ball = nef.from_mesh(open3d.geometry.TriangleMesh.create_sphere(1.0, 10))
    assert abs(float(ball.volume()) - 4.1) < 0.2
