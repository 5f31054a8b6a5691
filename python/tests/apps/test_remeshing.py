# SPDX-License-Identifier: Apache-2.0
"""Meshes with fewer and with more triangles."""
from fractions import Fraction

import numpy
import pytest

import nef


@pytest.fixture(autouse=True)
def remeshing(needs):
    return needs("remeshing")


def test_decimated_meshes_are_legal_and_near(remeshing):
    ball = nef.sphere(1, 32)
    made = remeshing.decimate(ball, 200)
    assert len(made.faces) <= 200
    solid = nef.from_mesh(made.vertices, made.faces)
    assert 0 < made.least_distance <= made.most_distance < 0.2
    # Vertices of the result are vertices of the ball, rounded.
    farthest = max(ball.distance(nef.point(vertex)).squared for vertex in made.vertices[:20])
    assert farthest < 1e-30
    assert abs(float(solid.volume()) - float(ball.volume())) < 0.3
    with pytest.raises(nef.InputError, match="at least 4 triangles"):
        remeshing.decimate(ball, 3)
    with pytest.raises(nef.InputError):
        remeshing.decimate(nef.halfspace(0, 0, 1, 0), 10)


def test_subdivided_meshes(remeshing):
    vertices, faces = nef.box((0, 0, 0), (1, 2, 3)).to_mesh()
    finer = remeshing.subdivide(vertices, faces, times=2)
    assert len(finer[1]) == 16 * len(faces)
    assert nef.from_mesh(*finer) == nef.box((0, 0, 0), (1, 2, 3))
    exact = remeshing.subdivide([[0, 0, 0], [Fraction(1, 3), 0, 0], [0, 1, 0]], [[0, 1, 2]], exact=True)
    assert Fraction(1, 6) in numpy.asarray(exact[0]).ravel().tolist()
    smooth = remeshing.subdivide(vertices, faces, scheme="loop")
    assert 0 < nef.from_mesh(*smooth).volume() < 6
    for wrong in ({"scheme": "butterfly"}, {"times": -1}, {"times": 13}):
        with pytest.raises(nef.InputError):
            remeshing.subdivide(vertices, faces, **wrong)
    with pytest.raises(nef.InputError):
        remeshing.subdivide([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]])
