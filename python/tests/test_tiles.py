# SPDX-License-Identifier: Apache-2.0
"""Sets in tiles are the sets that they are without: operators, questions, folders."""
import copy
import random
from fractions import Fraction

import numpy
import pytest

import nef


def wall(n=6):
    """A plate with a lattice of holes."""
    holes = [nef.box((i + Fraction(1, 4), k + Fraction(1, 4), -1), (i + Fraction(3, 4), k + Fraction(3, 4), 2))
             for i in range(n) for k in range(n)]
    return nef.box((0, 0, 0), (n, n, 1)) - nef.unite_all(holes).interior()


@pytest.mark.parametrize("threads", [1, 2])
def test_operators_and_questions(threads):
    plain = wall()
    tiled = nef.TiledPolyhedron(plain, limit=40, threads=threads)
    assert tiled.tile_count() > 3 and tiled.vertex_count() >= plain.counts().vertices
    tool = nef.box((1, 1, 0), (3, 2, 5))
    for a, b in ((tiled | tool, plain | tool), (tiled & tool, plain & tool), (tiled - tool, plain - tool),
                 (tiled ^ tool, plain ^ tool), (~tiled, ~plain),
                 (tiled - nef.TiledPolyhedron(tool), plain - tool)):
        assert a.polyhedron() == b
        assert a.volume() == b.volume() and a.bounding_box() == b.bounding_box()
        assert a == nef.TiledPolyhedron(b)
    assert tiled != tiled - tool and not nef.TiledPolyhedron() and tiled
    assert copy.deepcopy(tiled) == tiled
    rng = random.Random(1)
    points = numpy.array([[rng.randrange(-1, 26) / 4 for _ in range(3)] for _ in range(100)])
    assert tiled.contains(points).tolist() == plain.contains(points).tolist()
    assert ((0, 0, 0) in tiled) is True and tiled.contains((0, 0, 9)) is False
    for p in points[:20]:
        there, whole = tiled.locate(p), plain.locate(p)
        assert (there.kind, there.label, there.index) == (whole.kind, whole.label, None)
    assert tiled.ray((-1, Fraction(1, 3), Fraction(1, 2)), (1, 0, 0)).point == (0, Fraction(1, 3), Fraction(1, 2))
    assert tiled.ray((-1, 0, 9), (0, 0, 1)) is None
    for name in ("interior", "closure", "boundary", "exterior", "regularize"):
        assert getattr(tiled, name)().polyhedron() == getattr(plain, name)()
    assert tiled.transform([[0, 2, 0], [1, 0, 0], [0, 0, 1]]).volume() == 2 * plain.volume()


def test_pieces_and_meshes():
    rng = random.Random(2)
    boxes = []
    for _ in range(300):
        low = [rng.randrange(40) for _ in range(3)]
        boxes.append(nef.box(low, [x + rng.randrange(1, 4) for x in low]))
    assert nef.unite_in_tiles(boxes, limit=64).polyhedron() == nef.unite_all(boxes)
    vertices, faces = wall().to_mesh()
    assert nef.tiles_from_mesh(vertices, faces, limit=50).polyhedron() == wall()
    with pytest.raises(nef.InputError):
        nef.tiles_from_mesh(vertices, faces[1:])
    with pytest.raises(ValueError):
        nef.TiledPolyhedron(wall(), limit=3)


def test_folders(tmp_path):
    tiled = nef.TiledPolyhedron(wall(), limit=50)
    folder = tmp_path / "wall.tiles"
    tiled.write(folder)
    assert nef.read_tiles(folder) == tiled
    later = nef.read_tiles(folder, memory=10000)
    changed = later - nef.box((0, 0, 0), (1, 1, 1))
    assert changed.polyhedron() == wall() - nef.box((0, 0, 0), (1, 1, 1))
    changed.write(folder)
    assert nef.read_tiles(folder) == changed
    assert later == tiled  # the old version is still whole
    next(folder.glob("*.nef")).unlink()
    with pytest.raises(nef.InputError):
        nef.read_tiles(folder)
    with pytest.raises(nef.InputError):
        nef.read_tiles(tmp_path / "none.tiles")
