# SPDX-License-Identifier: Apache-2.0
"""Meshes in and out: arrays, files, and the meshes of other packages.

Open3D and meshio are tested for real where they are installed. trimesh and pyvista are not in Debian: what goes in is
tested with stand-ins that have their attributes, what comes out with a module of that name that keeps what it is given.
"""
import sys
import types
import warnings
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


def edge_uses(faces):
    """How many faces have each edge, by its two vertices."""
    uses = {}
    for face in faces:
        for a, b in zip(face, numpy.roll(face, -1)):
            uses[frozenset((int(a), int(b)))] = uses.get(frozenset((int(a), int(b))), 0) + 1
    return uses


def test_manifold_meshes():
    """Two boxes with one edge in common: four faces share it, or each box has it for itself."""
    touching = nef.box((0, 0, 0), (1, 1, 1)) | nef.box((1, 1, 0), (2, 2, 1))
    assert 4 in edge_uses(touching.to_mesh()[1]).values()
    for polygons in (False, True):
        vertices, faces = touching.to_mesh(polygons=polygons, manifold=True)
        assert set(edge_uses(faces).values()) == {2} and len(vertices) == 16
        assert nef.from_mesh(vertices, faces) == touching


def test_recentered_meshes():
    far = nef.box((1000, 0, -3), (1001, 1, -2)).translate(("1/3", 0, 0))
    for exact in (False, True):
        vertices, faces, offset = far.to_mesh(exact=exact, recenter=True)
        assert abs(vertices).max() <= 2 and offset[0] != 0
        back = nef.from_mesh(vertices, faces).translate(offset)
        assert back == far if exact else abs(back.volume() - 1) < 1e-12


def test_repaired_meshes():
    """A speck far out has no volume in floats, so that its mesh needs another place."""
    speck = nef.hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]).scale("1/1000000000").translate(
        ("100000000/3", "100000000/7", "100000000/9"))
    with pytest.raises(nef.InputError):
        nef.from_mesh(*speck.to_mesh())
    with pytest.raises(nef.UnsupportedError, match="recenter"):
        speck.to_mesh(repair=True)
    vertices, faces, offset = speck.to_mesh(repair=True, recenter=True)
    assert len(faces) == 4 and offset[0] != 0
    assert abs(nef.from_mesh(vertices, faces).volume() * 6 * 10**27 - 1) < 1e-6
    with pytest.raises(ValueError, match="exact"):
        speck.to_mesh(exact=True, repair=True)


def test_warnings_of_files(tmp_path):
    """Whoever reads a file with a bent face hears of it: read, expressions, scenes of the planner."""
    rows = [*CORNERS[:-1], [1, 1, 2]]
    off = f"OFF\n{len(rows)} {len(SQUARES)} 0\n" + "".join(" ".join(map(str, row)) + "\n" for row in rows)
    (tmp_path / "bent.off").write_text(off + "".join("4 " + " ".join(map(str, face)) + "\n" for face in SQUARES))
    with pytest.warns(UserWarning, match="is not planar"):
        bent = nef.read(tmp_path / "bent.off")
    with pytest.warns(UserWarning, match="is not planar"):
        assert nef.eval(f'file("{tmp_path}/bent.off") + box(0,0,0, 1,1,1)') == bent | nef.box((0, 0, 0), (1, 1, 1))
    planner = pytest.importorskip("nef.planner")
    (tmp_path / "scene.json").write_text('{"robot": "bent.off", "obstacles": ["box(9,9,9, 10,10,10)"]}')
    with pytest.warns(UserWarning, match="is not planar"):
        planner.read(tmp_path / "scene.json")


def test_crossings():
    corners = CORNERS + [[x + Fraction(1, 2) for x in v] for v in CORNERS]
    squares = SQUARES + [[v + 8 for v in face] for face in SQUARES]
    overlap = Fraction(1, 8)
    with pytest.raises(nef.InputError, match='crossings="union" selects points that are enclosed at least once'):
        nef.from_mesh(corners, squares)
    for rule, volume in (("union", 2 - overlap), ("nonzero", 2 - overlap), ("odd", 2 - 2 * overlap),
                         ("outside", 2 - overlap)):
        with pytest.warns(UserWarning, match="6 pairs of faces cross"):
            assert nef.from_mesh(corners, squares, crossings=rule).volume() == volume
    with pytest.raises(nef.InputError, match="refuse, union, nonzero, odd, outside, guess; not 'both'"):
        nef.from_mesh(corners, squares, crossings="both")


def test_repair():
    cube = nef.box((0, 0, 0), (1, 1, 1))
    sound = nef.repair(CORNERS, SQUARES)
    assert sound.set == cube and sound.problem is None and sound.done == [] and sound.faces == 6 * ["kept"]
    turned = nef.repair(CORNERS, [SQUARES[0][::-1]] + SQUARES[1:] + [SQUARES[2]])
    assert turned.set == cube and turned.faces == ["turned"] + 5 * ["kept"] + ["copy"]
    assert turned.done == ["1 face with the corners of another dropped", "1 face flipped to match adjacent faces"]

    corners = CORNERS + [[x + Fraction(1, 2) for x in v] for v in CORNERS]
    squares = SQUARES + [[v + 8 for v in face] for face in SQUARES]
    both = cube | cube.translate((Fraction(1, 2),) * 3)
    crossing = nef.repair(corners, squares)
    assert crossing.set == both and sorted(set(crossing.faces)) == ["cut", "kept"] and crossing.faces.count("cut") == 6
    # Of each side that is cut, a quarter is inside of the other cube.
    assert crossing.cut_kept.surface_area() == 6 * 0.75 and crossing.cut_off.surface_area() == 6 * 0.25
    assert crossing.cut_kept <= both.boundary() and crossing.cut_off.isdisjoint(both.boundary())
    assert {winding: parts for winding, (parts, _) in crossing.volumes.items()} == {1: 2, 2: 1}
    assert abs(crossing.volumes[2][1].value - 0.125) <= crossing.volumes[2][1].error
    refused = nef.repair(corners, squares, crossings="refuse")
    assert refused.set is None and "cross" in refused.problem

    is_open = nef.repair(CORNERS, SQUARES[:5], close=10)
    assert is_open.set is None and is_open.holes == 1 and not is_open.has_lids
    assert "close=17" in is_open.problem and "--" not in is_open.problem and abs(is_open.lid_share - 1 / 6) < 1e-9
    assert nef.repair(CORNERS, SQUARES[:5], close=True).lid_share == is_open.lid_share  # True is 10
    closed = nef.repair(CORNERS, SQUARES[:5], close=20)
    assert closed.set == cube and closed.has_lids and closed.faces == 5 * ["kept"] + ["added"]
    assert len(closed.added) == 1 and sorted(closed.added[0]) == sorted(SQUARES[5])
    assert nef.repair(CORNERS, SQUARES[:5], fill_holes=True).set == cube
    with pytest.raises(nef.InputError, match="not 'both'"):
        nef.repair(corners, squares, crossings="both")


def test_mesh_with_origins():
    block, pocket = nef.box((0, 0, 0), (4, 4, 4)), nef.box((1, 1, 2), (3, 3, 4))
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # open boundaries become closed, which is no news of a difference
        vertices, faces, origins = nef.mesh_with_origins("difference", [block, pocket], polygons=True, exact=True)
    # The sides and the floor of the pocket; the ring around its mouth is cut into triangles.
    cut = [vertices[face] for face, origin in zip(faces, origins) if origin == (1,)]
    assert len(cut) == 5 and len(faces) > 10 and {origin for origin in origins} == {(0,), (1,)}
    assert all((1 <= corners[:, :2]).all() and (corners[:, :2] <= 3).all() for corners in cut)
    assert nef.from_mesh(vertices, faces) == (block - pocket).closure()
    # A side in common is of both; a set that others cover is of none.
    _, faces, origins = nef.mesh_with_origins("union", [block, nef.box((0, 0, 0), (1, 1, 5)), nef.box((1, 1, 1), (2, 2, 2))])
    assert faces.shape == (len(origins), 3) and {(0,), (1,), (0, 1)} == set(origins)
    assert set(nef.mesh_with_origins("symdiff", [block, block, pocket], threads=2).origins) == {(2,), (0, 1, 2)}
    assert set(nef.mesh_with_origins("intersection", [block, pocket]).origins) == {(1,), (0, 1)}
    with pytest.raises(nef.InputError, match="write union, intersection"):
        nef.mesh_with_origins("sum", [block])


def test_holes(tmp_path):
    cube = nef.box((0, 0, 0), (1, 1, 1))
    with pytest.raises(nef.InputError, match="close=10 closes"):
        nef.from_mesh(CORNERS, SQUARES[:5])
    with pytest.raises(nef.InputError, match="close=17 accepts them"):
        nef.from_mesh(CORNERS, SQUARES[:5], close=10)
    with pytest.warns(UserWarning, match="1 hole closed by lids of 17 %"):
        assert nef.from_mesh(CORNERS, SQUARES[:5], close=17) == cube
    with pytest.warns(UserWarning, match="a guess"):
        assert nef.tiles_from_mesh(CORNERS, SQUARES[:5], close=17).volume() == 1
    with pytest.raises(nef.InputError, match="from 0 to 100"):
        nef.from_mesh(CORNERS, SQUARES, close=-1)
    open_box = tmp_path / "open.off"
    lines = [" ".join(str(x) for x in v) for v in CORNERS] + [f"4 {' '.join(str(v) for v in f)}" for f in SQUARES[:5]]
    open_box.write_text("OFF\n8 5 0\n" + "\n".join(lines) + "\n")
    with pytest.warns(UserWarning, match="a guess"):
        assert nef.read(open_box, close=20) == cube
    planner = pytest.importorskip("nef.planner")
    scene = tmp_path / "scene.json"
    scene.write_text('{"robot": "box(0,0,0, 1,1,1)", "obstacles": ["open.off"]}')
    with pytest.warns(UserWarning, match="taken as a surface"):
        planner.read(scene)
    with pytest.warns(UserWarning, match="a guess"):
        planner.read(scene, close=20)
    with pytest.raises(nef.InputError, match="open there"):
        planner.read(scene, crossings="refuse")


def test_crossings_of_files(tmp_path):
    two = tmp_path / "two.off"
    lines = [" ".join(str(x) for x in v) for v in CORNERS] + [" ".join(str(x + 3) for x in v) for v in CORNERS]
    lines += [f"4 {' '.join(str(v) for v in face)}" for face in SQUARES]
    lines += [f"4 {' '.join(str(v + 8) for v in face[::-1])}" for face in SQUARES]
    two.write_text("OFF\n16 12 0\n" + "\n".join(lines) + "\n")
    # The second one is far away and inside out: nothing is enclosed twice, and nothing in it once.
    with pytest.raises(nef.InputError):
        nef.read(two)
    with pytest.raises(nef.InputError):
        nef.eval(f'file("{two}")')
    with pytest.warns(UserWarning, match="inside out"):
        assert nef.eval(f'file("{two}")', crossings="union") == nef.box((0, 0, 0), (1, 1, 1))
    with pytest.warns(UserWarning, match="inside out"):
        assert nef.read(two, crossings="union") == nef.box((0, 0, 0), (1, 1, 1))
    with pytest.warns(UserWarning, match="inside out"):
        assert nef.read(two, crossings="nonzero").volume() == 2
    with pytest.warns(UserWarning, match="inside out"):
        vertices = CORNERS + [[x + 3 for x in v] for v in CORNERS]
        faces = SQUARES + [[v + 8 for v in face[::-1]] for face in SQUARES]
        assert nef.tiles_from_mesh(vertices, faces, crossings="nonzero").volume() == 2


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
    _, offset = TETRAHEDRON.translate((100, 0, 0)).to_trimesh(recenter=True, manifold=True, repair=True)
    assert nef.from_mesh(made[2]["vertices"], made[2]["faces"]).translate(offset) == TETRAHEDRON.translate((100, 0, 0))


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
