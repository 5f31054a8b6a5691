# SPDX-License-Identifier: Apache-2.0
"""Operators against Python's own sets of grid cells; copying, pickling, hashing."""
import copy
import itertools
import pickle
import random
from fractions import Fraction

import pytest

import nef

GRID = 4


def cells_of(low, high):
    """All grid cells, points, edges and squares among them, of a closed box: doubled coordinates."""
    return set(itertools.product(*[range(2 * a, 2 * b + 1) for a, b in zip(low, high)]))


def random_pair(rng):
    """A set and its cells, made by the same operations."""
    solid, cells = nef.empty(), set()
    for _ in range(rng.randrange(1, 5)):
        low = [rng.randrange(GRID) for _ in range(3)]
        high = [rng.randrange(a, GRID + 1) for a in low]
        box, box_cells = nef.box(low, high), cells_of(low, high)
        operation = rng.choice("|-&^" if cells else "|")
        if operation == "|":
            solid, cells = solid | box, cells | box_cells
        elif operation == "-":
            solid, cells = solid - box, cells - box_cells
        elif operation == "&":
            solid, cells = solid & box, cells & box_cells
        else:
            solid, cells = solid ^ box, cells ^ box_cells
    return solid, cells


@pytest.mark.parametrize("seed", range(12))
def test_operators_are_those_of_sets(seed):
    rng = random.Random(seed)
    a, cells_a = random_pair(rng)
    b, cells_b = random_pair(rng)
    everywhere = list(itertools.product(range(-1, 2 * GRID + 2), repeat=3))
    points = [[Fraction(c, 2) for c in cell] for cell in everywhere]
    for solid, cells in ((a | b, cells_a | cells_b), (a & b, cells_a & cells_b), (a - b, cells_a - cells_b),
                         (a ^ b, cells_a ^ cells_b), (~a, set(everywhere) - cells_a)):
        assert [cell in cells for cell in everywhere] == solid.contains(points).tolist()
        assert solid.validate() == ""
    assert (a == b) == (cells_a == cells_b)
    assert (a != b) == (cells_a != cells_b)
    assert (a <= b) == (cells_a <= cells_b)
    assert (a < b) == (cells_a < cells_b)
    assert (a >= b) == (cells_a >= cells_b)
    assert (a > b) == (cells_a > cells_b)
    assert a.isdisjoint(b) == cells_a.isdisjoint(cells_b)
    assert bool(a) == bool(cells_a)
    assert (a | b) - b == a - b
    assert hash((a | b) - b) == hash(a - b)
    assert len({a, a | a, a & a, ~~a}) == 1


def test_other_types_are_refused():
    a = nef.box((0, 0, 0), (1, 1, 1))
    with pytest.raises(TypeError):
        a | 3
    with pytest.raises(TypeError):
        a <= "box"
    assert (a == 3) is False
    assert a != "box"


def test_copies_and_pickles():
    open_box = nef.box((0, 0, 0), (1, "1/3", 0.1)).interior()
    half = nef.halfspace(1, 2, 3, 4, closed=False)
    for a in (open_box, half, nef.empty(), nef.everything(), ~open_box, open_box | nef.point((5, 5, 5))):
        assert copy.copy(a) == a
        assert copy.deepcopy([a])[0] == a
        back = pickle.loads(pickle.dumps(a))
        assert back == a and hash(back) == hash(a)
        assert nef.from_bytes(a.to_bytes()) == a


def test_damaged_bytes_are_refused():
    a = nef.box((0, 0, 0), (1, "1/3", 0.1)).interior() | nef.halfspace(1, 2, 3, 4)
    good = a.to_bytes()
    for at in range(len(good)):
        bad = bytearray(good)
        bad[at] ^= 1 << at % 8
        with pytest.raises(nef.InputError):
            nef.from_bytes(bytes(bad))


def test_text_of_earlier_versions_is_read():
    """What to_bytes and pickles held before they had a checksum."""
    text = """nef 1
planes 0 vertices 1 outer 0
vertex 3 6 1 3 0 0 0 1 0 0 0 1
 0 0
end
"""
    assert nef.from_bytes(text.encode()) == nef.point((1, 2, "1/3"))


def test_topology():
    a = nef.box((0, 0, 0), (2, 2, 2))
    assert a.is_closed() and not a.is_open() and a.is_regular() and a.is_bounded()
    inner = a.interior()
    assert inner.is_open() and inner < a and inner.closure() == a
    assert a - inner == a.boundary() == inner.boundary()
    assert a.exterior() == ~a
    assert (a | nef.segment((2, 1, 1), (5, 1, 1))).regularize() == a
    assert nef.everything().is_everything() and (a | ~a).is_everything()
    assert nef.unite_all([]).is_empty() and nef.intersect_all([]).is_everything()
    row = [nef.box((i, 0, 0), (i + 1, 1, 1)) for i in range(20)]
    assert nef.unite_all(row, threads=2) == nef.box((0, 0, 0), (20, 1, 1))
    assert nef.intersect_all(row[:2]) == nef.box((1, 0, 0), (1, 1, 1))


def test_transformations():
    a = nef.box((0, 0, 0), (1, 2, 3))
    third = Fraction(1, 3)
    moved = a.transform([[third, 0, 0, 1], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]])
    assert moved == nef.box((1, 0, -3), (1 + third, 2, 0))
    assert a.translate((third, 0, 0)).translate((-third, 0, 0)) == a
    assert a.scale(2) == nef.box((0, 0, 0), (2, 4, 6)) and a.scale((1, 1, third)) == nef.box((0, 0, 0), (1, 2, 1))
    turned = a.rotate((0, 0, 1), 90)
    assert turned == nef.box((-2, 0, 0), (0, 1, 3))
    assert a.rotate("z", 90) == turned and a.rotate("x", -180).bounding_box() == a.rotate((1, 0, 0), 180).bounding_box()
    with pytest.raises(nef.InputError, match="an axis is 'x', 'y', 'z' or three numbers, .* not 'w'"):
        a.rotate("w", 90)
    assert a.rotate((1, 2, 2), 33).volume() == 6
    for matrix in ([[1, 2, 3]], [[1, 0, 0]] * 3, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 1]], 3):
        with pytest.raises((ValueError, TypeError)):
            a.transform(matrix)


def test_labels():
    a = nef.box((0, 0, 0), (2, 2, 2))
    b = nef.box((1, 1, 1), (3, 3, 3))
    both = nef.overlay(a, b, lambda x, y: x + 2 * y)
    assert both.labels() == [0, 1, 2, 3]
    assert both.labels_at([[.5, .5, .5], [1.5, 1.5, 1.5], [2.5, 2.5, 2.5], [9, 9, 9]]).tolist() == [1, 3, 2, 0]
    assert both.labels_at((1.5, 1.5, 1.5)) == 3
    assert nef.overlay(both, nef.empty(), lambda x, y: int(x == 3)) == a & b
    assert both.labels() == [0, 1, 2, 3] and both.without_labels() == both | nef.empty() == both.regularize() == a | b
    assert ~both == ~(a | b) and both.is_regular()
    with pytest.raises(nef.InputError):
        nef.overlay(a, b, lambda x, y: -1)
    with pytest.raises(ZeroDivisionError):
        nef.overlay(a, b, lambda x, y: 1 // 0)


def test_a_loop_of_small_steps():
    """Steps of small sets wait until somebody looks; all versions are those of sets of cells."""
    rng = random.Random(3)
    boxes = [((3 * i, 3 * j, 0), (3 * i + 2, 3 * j + 2, 2)) for i in range(4) for j in range(4)]
    solid, cells = nef.unite_all([nef.box(*box) for box in boxes]), set().union(*[cells_of(*box) for box in boxes])
    versions = []
    for _ in range(60):
        low = [rng.randrange(11), rng.randrange(11), rng.randrange(2)]
        high = [a + 1 for a in low]
        if rng.random() < 0.2:
            solid, cells = solid + nef.box(low, high), cells | cells_of(low, high)
        else:
            solid, cells = solid - nef.box(low, high), cells - cells_of(low, high)
        versions.append((solid, cells))
    everywhere = list(itertools.product(range(-1, 25), range(-1, 25), range(-1, 6)))
    points = [[Fraction(c, 2) for c in cell] for cell in everywhere]
    for solid, cells in [versions[-1]] + rng.sample(versions, 5):
        assert [cell in cells for cell in everywhere] == solid.contains(points).tolist()
        assert solid.validate() == ""
    with pytest.raises(TypeError):
        solid - 3
    with pytest.raises(TypeError):
        3 | solid
