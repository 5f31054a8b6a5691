# SPDX-License-Identifier: Apache-2.0
"""Numbers go in as what they are and come out as Fractions."""
from decimal import Decimal
from fractions import Fraction

import numpy
import pytest

import nef


@pytest.mark.parametrize("number, value", [
    (3, 3), (0.1, Fraction(0.1)), ("0.1", Fraction(1, 10)), ("-22/7", Fraction(-22, 7)), (Fraction(1, 3), Fraction(1, 3)),
    (Decimal("0.1"), Fraction(1, 10)), (numpy.float64(0.1), Fraction(0.1)),
    (numpy.float32(0.1), Fraction(float(numpy.float32(0.1)))),
    (numpy.int64(7), 7), (numpy.uint64(2**64 - 1), 2**64 - 1), (-2**63, -2**63), (2**63, 2**63), (10**40, 10**40),
    (-10**40, -10**40), (True, 1), (1e-310, Fraction(1e-310)), (Fraction(10**30, 3**50), Fraction(10**30, 3**50)),
])
def test_what_a_number_is(number, value):
    box = nef.point((number, 0, 0)).bounding_box()
    assert box[0] == (value, 0, 0)
    assert all(isinstance(x, Fraction) for x in box[0])


@pytest.mark.parametrize("number", [float("nan"), float("inf"), Decimal("NaN"), "1/0", "", "x"])
def test_what_is_no_number(number):
    with pytest.raises(nef.InputError):
        nef.point((number, 0, 0))
    with pytest.raises(ValueError):  # InputError is one
        nef.point((0, number, 0))


@pytest.mark.parametrize("number", [None, [1], 1j, object()])
def test_what_is_not_meant_as_a_number(number):
    with pytest.raises(TypeError):
        nef.point((number, 0, 0))


@pytest.mark.parametrize("point", [(1, 2), (1, 2, 3, 4), 5, "123", None, numpy.zeros((2, 3))])
def test_what_is_no_point(point):
    with pytest.raises((ValueError, TypeError)):
        nef.point(point)


@pytest.mark.parametrize(("call", "name"), [
    (lambda: nef.from_mesh(1, 2), "vertices"),
    (lambda: nef.from_mesh(CORNERS, 2), "faces"),
    (lambda: nef.from_mesh(CORNERS, [1, 2]), "each face"),
    (lambda: nef.hull(1), "points"),
    (lambda: nef.point((0, 0, 0)).transform(3), "a matrix"),
    (lambda: nef.point((0, 0, 0)).transform([1, 2, 3]), "each row of a matrix"),
])
def test_what_is_no_list_is_named(call, name):
    with pytest.raises(TypeError, match=f"^{name} must be a list or an array, not int$"):
        call()


CORNERS = [[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]]


@pytest.mark.parametrize("kind", ["float64", "float32", "int64", "uint8", "object", "list", "fortran", "strided"])
def test_arrays_of_points(kind):
    if kind == "list":
        points = CORNERS
    elif kind == "fortran":
        points = numpy.asfortranarray(numpy.array(CORNERS, float))
    elif kind == "strided":
        points = numpy.repeat(numpy.array(CORNERS, float), 2, axis=0)[::2]
    elif kind == "object":
        points = numpy.array([[Fraction(x) for x in p] for p in CORNERS], dtype=object)
    else:
        points = numpy.array(CORNERS, dtype=kind)
    assert nef.hull(points).volume() == Fraction(9, 2)


def test_large_integers_stay_exact():
    big = 2**60
    points = numpy.array([[big, 0, 0], [big + 1, 0, 0], [big, 1, 0], [big, 0, 1]], dtype=numpy.int64)
    assert nef.hull(points).volume() == Fraction(1, 6)
    assert nef.hull(points.astype(numpy.uint64)).volume() == Fraction(1, 6)


def test_shapes_are_told():
    with pytest.raises(ValueError, match=r"\(N, 3\).*\(4, 2\)"):
        nef.hull(numpy.zeros((4, 2)))
    with pytest.raises(ValueError, match="each row of points needs three numbers, such as"):
        nef.hull([[1, 2], [3, 4]])
    with pytest.raises(ValueError, match="rings must be a list of rings.*write"):
        nef.polygon([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    with pytest.raises(ValueError, match="write b <= a for sets"):
        nef.point((0, 0, 0)) in nef.box((0, 0, 0), (1, 1, 1))
    with pytest.raises(nef.InputError, match="point 1"):
        nef.box((0, 0, 0), (1, 1, 1)).contains(numpy.array([[0, 0, 0], [0, numpy.nan, 0]]))
