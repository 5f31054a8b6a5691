# SPDX-License-Identifier: Apache-2.0
"""Queries against closed forms."""
import json
import math
import os
import random
import subprocess
from fractions import Fraction

import numpy
import pytest

import nef

BOX = nef.box((0, 0, 0), (1, 2, 3))


def test_contains():
    assert BOX.contains((1, 2, 3)) is True
    assert BOX.contains([1, 2, 3]) is True
    assert BOX.contains(numpy.array([1.0, 2.0, 3.5])) is False
    assert (1, "2", Fraction(3)) in BOX and (0.5, 0.5, 4) not in BOX
    rng = numpy.random.default_rng(1)
    points = rng.integers(-2, 9, (2000, 3)) / 2
    truth = ((points >= 0) & (points <= [1, 2, 3])).all(axis=1)
    inner = ((points > 0) & (points < [1, 2, 3])).all(axis=1)
    for threads in (1, 2):
        assert (BOX.contains(points, threads=threads) == truth).all()
        assert (BOX.interior().contains(points, threads=threads) == inner).all()
    exact = [[Fraction(x) for x in p] for p in points]
    assert (BOX.contains(exact) == truth).all()
    assert (BOX.contains(numpy.array(exact, dtype=object)) == truth).all()
    assert (BOX.contains(numpy.arange(9).reshape(3, 3)) == [True, False, False]).all()
    assert BOX.contains(numpy.empty((0, 3))).shape == (0,)
    # A third is no double: the facet is exact.
    thin = nef.box((0, 0, 0), ("1/3", 1, 1))
    assert (Fraction(1, 3), 0, 0) in thin and (1 / 3, 0, 0) in thin and (numpy.nextafter(1 / 3, 1), 0, 0) not in thin


def test_locate_and_ray():
    assert BOX.locate((0, 0, 0))[0] == "vertex" and BOX.locate((0.5, 0, 0)).kind == "edge"
    assert BOX.locate((0.5, 0.5, 0)) .kind == "facet" and BOX.locate((0.5, 0.5, 0.5)).kind == "volume"
    assert BOX.locate((0.5, 0.5, 0.5)).label == 1 and BOX.locate((9, 9, 9)).label == 0
    hit = BOX.ray((-5, 1, 1), (1, 0, Fraction(1, 10)))
    assert hit.point == (0, 1, Fraction(3, 2)) and hit.location.kind == "facet"
    assert BOX.ray((-5, 1, 1), (-1, 0, 0)) is None
    with pytest.raises(nef.InputError):
        BOX.ray((0, 0, 0), (0, 0, 0))


def turned_balls(count):
    """Booleans of balls that are turned by rational rotations: coordinates of many digits."""
    for i in range(count):
        a, b = (nef.eval(f"rotate(sphere({r}, {6 + i}), [1, {i + 1}, 3], {17 * i + 5})") for r in (1, "9/8"))
        yield a - b.translate((Fraction(1, 3), Fraction(i, 7), Fraction(1, 5)))


def test_approximate_measures_hold_exact_ones():
    for solid in (BOX, *turned_balls(4)):
        value, error = solid.approximate_volume()
        assert abs(Fraction(value) - solid.volume()) <= Fraction(error) < Fraction(1, 10**9)
        assert solid.approximate_volume(threads=2) == (value, error)
        area = solid.approximate_area()
        assert abs(area.value - solid.surface_area()) <= area.error + 1e-14 * area.value and area.error < 1e-9
        exact, floats = solid.moments(), solid.approximate_moments()
        for i in range(3):
            assert abs(Fraction(floats.centroid[i]) - exact.centroid[i]) <= Fraction(floats.centroid_error)
            for j in range(3):
                off = Fraction(floats.inertia[i][j]) - exact.inertia[i][j]
                assert abs(off) <= Fraction(floats.inertia_error) < Fraction(1, 10**9)
        assert numpy.allclose(floats.principal_moments, exact.principal_moments)
    assert (~BOX).approximate_volume() == (math.inf, 0) and (~BOX).approximate_moments() is None
    assert nef.halfspace(1, 0, 0, 0).approximate_area() == (math.inf, 0)


def test_info_is_that_of_the_program(tmp_path):
    folder = os.environ.get("NEF_PROGRAM_DIR")
    if folder is None:
        pytest.skip("NEF_PROGRAM_DIR does not say where the programs are")
    for i, solid in enumerate((BOX, ~BOX, nef.point((1, 2, 3)), *turned_balls(2))):
        path = tmp_path / f"{i}.nef"
        solid.write(path)
        for flags, exact in (([], False), (["--exact"], True)):
            done = subprocess.run([os.path.join(folder, "nef"), "info", path, "--json", *flags], stdout=subprocess.PIPE, check=True)
            assert solid.info(exact=exact) == json.loads(done.stdout)["result"]


def test_measures():
    assert BOX.volume() == 6 and isinstance(BOX.volume(), Fraction)
    assert (~BOX).volume() is None
    assert BOX.surface_area() == 22
    assert BOX.bounding_box() == ((0, 0, 0), (1, 2, 3)) and nef.everything().bounding_box() is None
    assert BOX.counts() == (8, 12, 6, 2, 2)
    assert BOX.euler_numbers() == [2, 2]
    assert BOX.labels() == [0, 1]
    moments = BOX.moments()
    assert moments.volume == 6 and moments.centroid == (Fraction(1, 2), 1, Fraction(3, 2))
    assert moments.inertia[0] == (Fraction(6 * 13, 12), 0, 0)
    assert numpy.allclose(moments.principal_moments, sorted([6 * 13 / 12, 6 * 10 / 12, 6 * 5 / 12]))
    assert numpy.allclose(moments.principal_axes @ moments.principal_axes.T, numpy.eye(3))
    assert (~BOX).moments() is None and nef.point((1, 2, 3)).moments().centroid is None


def test_section():
    frame = nef.box((0, 0, 0), (9, 9, 9)) - nef.box((3, 3, -1), (6, 6, 10))
    cut = frame.section((0, 0, 1), -4)
    assert len(cut.polygons) == 1 and cut.polygons[0].outer.shape == (4, 3)
    assert [hole.shape for hole in cut.polygons[0].holes] == [(4, 3)]
    x, y = cut.polygons[0].outer[:, 0], cut.polygons[0].outer[:, 1]
    assert (x * numpy.roll(y, -1) - y * numpy.roll(x, -1)).sum() / 2 == 81
    assert cut.set == frame & nef.box((-9, -9, 4), (20, 20, 4))
    exact = BOX.section((3, 0, 0), -1, exact=True)
    assert {p[0] for p in exact.polygons[0].outer.tolist()} == {Fraction(1, 3)}
    assert BOX.section((0, 0, 1), -7).set.is_empty()
    assert nef.halfspace(1, 0, 0, 0).section((0, 0, 1), 0).unbounded == 1


def test_split():
    pieces = (BOX | BOX.translate((5, 0, 0)) | nef.point((20, 0, 0))).split()
    assert len(pieces) == 3 and pieces[0] == BOX
    touching = BOX | BOX.translate((1, 2, 0))
    assert len(touching.split()) == 1 and len(touching.split(by="volumes")) == 2
    with pytest.raises(ValueError):
        BOX.split(by="colour")
    two = BOX | BOX.scale(2).translate((9, 0, 0))
    assert two.split(above=BOX.volume()) == [two.largest_piece()] and two.largest_piece() == BOX.scale(2).translate((9, 0, 0))
    assert two.split(above="1000") == [] and len(two.split(above=0)) == 2
    assert touching.largest_piece() == touching and touching.largest_piece(by="volumes") == BOX
    assert nef.empty().largest_piece() == nef.empty()
    with pytest.raises(ValueError):
        BOX.largest_piece(by="colour")


def test_distance():
    far = BOX.distance(BOX.translate((4, 4, 0)))
    assert far.contact == "disjoint" and far.squared == 13 and far.value == math.sqrt(13)
    assert far.on_a[:2] == (1, 2) and far.on_b[:2] == (4, 4)
    beside = BOX.translate((1, 0, 0))
    assert BOX.distance(beside).contact == "touching" and BOX.distance(beside).common_point
    assert not BOX.distance(beside.interior()).common_point
    assert BOX.distance(BOX).contact == "overlapping"
    assert BOX.distance(nef.empty()) is None


def test_random_volumes():
    """Inclusion and exclusion of random tetrahedra, by their own arithmetic."""
    rng = random.Random(5)
    for _ in range(10):
        a, b = (nef.hull([[rng.randrange(9) for _ in range(3)] for _ in range(6)]) for _ in range(2))
        assert (a | b).volume() + (a & b).volume() == a.volume() + b.volume()
        assert (a ^ b).volume() == a.volume() + b.volume() - 2 * (a & b).volume()
