# SPDX-License-Identifier: Apache-2.0
"""Minkowski sums, visual hulls and plans against closed forms."""
import json
import os
import pathlib
import re
from fractions import Fraction

import numpy
import pytest

import nef

CUBE = nef.box((0, 0, 0), (1, 1, 1))
ROOT = pathlib.Path(os.environ.get("NEF_SOURCE_DIR", pathlib.Path(__file__).parents[3]))


def test_sums(needs):
    minkowski = needs("minkowski")
    told = []
    l_shape = CUBE | nef.box((1, 0, 0), (2, 1, 3))
    total = minkowski.sum(l_shape, CUBE, progress=lambda phase, done, total: told.append((done, total)))
    assert total == nef.box((0, 0, 0), (2, 2, 2)) | nef.box((1, 0, 0), (3, 2, 4))
    assert told and told[-1][0] == told[-1][1]
    assert minkowski.sum(CUBE.interior(), nef.point((1, 2, 3))) == CUBE.interior().translate((1, 2, 3))
    with pytest.raises(ZeroDivisionError):
        minkowski.sum(l_shape, CUBE, progress=lambda *what: 1 // 0)
    assert minkowski.negate(CUBE) == nef.box((-1, -1, -1), (0, 0, 0))
    assert minkowski.is_convex(CUBE) and not minkowski.is_convex(l_shape)
    cells = minkowski.decompose(l_shape)
    assert nef.unite_all(cells) == l_shape and all(minkowski.is_convex(cell) for cell in cells)


def test_erosion(needs):
    minkowski = needs("minkowski")
    big = nef.box((0, 0, 0), (5, 5, 5))
    assert minkowski.erode(big, CUBE) == nef.box((0, 0, 0), (4, 4, 4))
    assert minkowski.erode(big.interior(), CUBE) == nef.box((0, 0, 0), (4, 4, 4)).interior()
    assert minkowski.erode(big, CUBE.interior()) == nef.box((0, 0, 0), (4, 4, 4))
    assert minkowski.erode(CUBE, CUBE) == nef.point((0, 0, 0))
    assert minkowski.erode(CUBE, big).is_empty()
    assert minkowski.erode(nef.empty(), CUBE).is_empty()
    assert minkowski.erode(CUBE, nef.empty()).is_everything()
    frame = big - nef.box((2, 2, -1), (3, 3, 6)).interior()
    eroded = minkowski.erode(frame, CUBE)
    for x in range(-1, 11):
        for y in range(-1, 11):
            p = (Fraction(x, 2), Fraction(y, 2), 1)
            assert (p in eroded) == (CUBE.translate(p) <= frame)
    # Of an unbounded set: where no point of a cube is in the other one.
    assert minkowski.erode(~CUBE, CUBE) == ~nef.box((-1, -1, -1), (1, 1, 1))
    told = []
    minkowski.erode(frame, CUBE, progress=lambda phase, done, total: told.append((done, total)))
    assert told


def test_opening_and_closing(needs):
    minkowski = needs("minkowski")
    antenna = nef.box((5, 2, 2), (9, 2, 2))
    thorny = nef.box((0, 0, 0), (5, 5, 5)) | antenna | nef.box((1, 1, 5), ("1.5", "1.5", 7))
    assert minkowski.opening(thorny, CUBE) == nef.box((0, 0, 0), (5, 5, 5))
    gap = nef.box((0, 0, 0), (2, 2, 2)) | nef.box(("2.5", 0, 0), (5, 2, 2))
    assert minkowski.closing(gap, CUBE) == nef.box((0, 0, 0), (5, 2, 2))
    wide = nef.box((0, 0, 0), (2, 2, 2)) | nef.box(("3.5", 0, 0), (5, 2, 2))
    assert minkowski.closing(wide, CUBE) == wide
    for function in (minkowski.opening, minkowski.closing):
        with pytest.raises(nef.InputError):
            function(gap, nef.empty())


def test_sweep_hull_and_components(needs):
    minkowski = needs("minkowski")
    path = [(0, 0, 0), (3, 0, 0), (3, 4, 0)]
    assert minkowski.sweep(CUBE, path) == nef.box((0, 0, 0), (4, 1, 1)) | nef.box((3, 0, 0), (4, 5, 1))
    assert minkowski.sweep(CUBE, [(1, 2, 3)]) == CUBE.translate((1, 2, 3))
    two = CUBE.interior() | CUBE.translate((2, 0, 0)).interior()
    assert minkowski.hull(two) == nef.box((0, 0, 0), (3, 1, 1)).interior()
    assert minkowski.component(two, ("2.5", "0.5", "0.5")) == CUBE.translate((2, 0, 0)).interior()
    assert minkowski.component(two, (0, 0, 0)).is_empty() and minkowski.component(two).is_empty()
    assert minkowski.component(~CUBE) == ~CUBE
    with pytest.raises(nef.InputError):
        minkowski.sweep(CUBE, numpy.empty((0, 3)))
    assert minkowski.hull(~CUBE).is_everything()


def test_sums_in_tiles(needs):
    minkowski = needs("minkowski")
    frame = nef.box((0, 0, 0), (8, 8, 8)) - nef.box((2, 2, -1), (5, 5, 9)).interior()
    tiled = nef.TiledPolyhedron(frame, limit=32)
    report = {}
    total = minkowski.sum(tiled, CUBE, report=report, threads=2)
    assert isinstance(total, nef.TiledPolyhedron) and total.polyhedron() == minkowski.sum(frame, CUBE)
    assert "regions" in report["strategies"][0]["why"]
    for function in (minkowski.erode, minkowski.opening, minkowski.closing):
        assert function(tiled, CUBE).polyhedron() == function(frame, CUBE)
    assert minkowski.offset(tiled, -1, 2).polyhedron() == minkowski.offset(frame, -1, 2)
    with pytest.raises(nef.UnsupportedError):
        minkowski.sum(nef.TiledPolyhedron(~frame), CUBE)
    with pytest.raises(TypeError, match="a must be a nef.Polyhedron or a nef.TiledPolyhedron"):
        minkowski.sum(1, CUBE)


def test_simplified_offset(needs):
    minkowski = needs("minkowski")
    ball = nef.sphere(1, 60)
    found = minkowski.simplified_offset(ball, 1 / 4, triangles=40, digits=3, detail=2)
    exact = minkowski.offset(ball, 1 / 4, 2)
    assert exact <= found.set and found.set <= minkowski.offset(ball, 1 / 4 + found.error, 2)
    assert all((x * 1000).denominator == 1 for point in found.set.to_mesh(exact=True)[0] for x in point)
    with pytest.raises(nef.InputError, match="number of triangles"):
        minkowski.simplified_offset(ball, 1)


def test_penetration(needs):
    minkowski = needs("minkowski")
    inside = minkowski.penetration(nef.box((0, 0, 0), (4, 4, 4)), CUBE.translate((1, 1, Fraction(14, 5))))
    assert inside.contact == "overlapping" and inside.squared_length == Fraction(36, 25)
    assert inside.translation == (0, 0, Fraction(6, 5))
    touching = minkowski.penetration(CUBE, CUBE.translate((1, 1, 1)))
    assert touching == nef.Penetration("touching", (0, 0, 0), 0)
    apart = minkowski.penetration(CUBE, CUBE.translate((4, 5, 0)))
    assert apart.contact == "disjoint" and apart.translation == (-3, -4, 0) and apart.squared_length == 25
    assert apart.squared_length == CUBE.distance(CUBE.translate((4, 5, 0))).squared
    with pytest.raises(nef.InputError):
        minkowski.penetration(CUBE, nef.empty())


def test_no_fit_and_reach(needs):
    minkowski = needs("minkowski")
    # A slot as wide as the cube: it slides in there, and along all sides.
    slotted = nef.box((0, 0, 0), (3, 3, 1)) - nef.box((1, 1, -1), (2, 4, 2)).interior()
    fits = minkowski.no_fit(slotted, CUBE)
    for x in range(-3, 8):
        for y in range(-3, 8):
            p = (Fraction(x, 2), Fraction(y, 2), 0)
            moved = CUBE.translate(p)
            d = slotted.distance(moved)
            assert (p in fits) == (d.contact == "touching"), p
    found = minkowski.reach(CUBE, slotted)
    assert (1, 2, 0) in found.positions and (1, 1, 0) in found.positions
    assert found.touched | found.untouched == slotted.closure().boundary()
    assert (Fraction(3, 2), 1, Fraction(1, 2)) in found.touched  # the slot's end
    hollow = nef.box((0, 0, 0), (9, 9, 9)) - nef.box((3, 3, 3), (6, 6, 6)).interior()
    assert (3, 4, 4) in minkowski.reach(CUBE, hollow).untouched
    assert (3, 4, 4) in minkowski.reach(CUBE, hollow, start=(4, 4, 4)).touched
    with pytest.raises(nef.InputError):
        minkowski.reach(CUBE, hollow, start=(1, 1, 1))


def test_how_sums_are_made(needs):
    minkowski = needs("minkowski")
    part = nef.box((0, 0, 0), (3, 3, 3)) - nef.box((1, 1, 1), (4, 4, 4)).interior()
    sums = []
    for union, chosen in ("auto", "convolution"), ("convolution", "convolution"), ("queue", "queue"):
        report = {}
        sums.append(minkowski.sum(part, part, threads=2, union=union, report=report))
        assert [entry["chosen"] for entry in report["strategies"]] == [chosen]
        assert report["strategies"][0]["why"] and report["seconds"] >= 0
        assert (report["cells"] == (0, 0)) == (chosen == "convolution")
        assert (report["convolution"]["facets"] > 0) == (chosen == "convolution")
    assert sums[0] == sums[1] == sums[2]
    report = {}
    minkowski.opening(part, CUBE, report=report)
    assert len(report["strategies"]) == 2
    with pytest.raises(ValueError):
        minkowski.sum(part, part, union="cells")
    with pytest.raises(TypeError):
        minkowski.sum(part, part, report=[])


def test_millable(needs):
    minkowski = needs("minkowski")
    undercut = nef.box((3, 0, 1), (5, 2, 2))
    narrow = nef.box((7, 0, 1), ("7.5", 2, 4))
    part = nef.box((0, 0, 0), (9, 2, 4)) - nef.box((1, -1, 1), (3, 3, 5)).interior() - undercut - narrow
    found = minkowski.millable(part, CUBE, axes=3)
    assert found.unreached == [undercut, narrow] and found.shape == part | undercut | narrow
    found = minkowski.millable(part, CUBE)
    assert found.unreached == [narrow] and found.shape == (part | narrow).closure()
    with pytest.raises(ValueError):
        minkowski.millable(part, CUBE, axes=5)
    with pytest.raises(nef.InputError):
        minkowski.millable(part, nef.point((0, 0, 0)))


def test_offset(needs):
    minkowski = needs("minkowski")
    ball = minkowski.ball(2, detail=3)
    vertices = ball.to_mesh(exact=True)[0]
    assert len(vertices) == 4 * 9 + 2 and all(sum(x * x for x in v) == 4 for v in vertices.tolist())
    around = minkowski.ball(2, detail=3, side="outer")
    assert ball < around and around.distance(nef.point((0, 0, 0))).squared == 0
    assert (~around).distance(nef.point((0, 0, 0))).squared >= 4
    # Both surfaces are within their bounds of the sphere.
    within = 2 - minkowski.ball_error(2, 3)
    assert 0 < within < 2 and (~ball).distance(nef.point((0, 0, 0))).squared >= within**2
    beyond = 2 + minkowski.ball_error(2, 3, "outer")
    assert all(sum(x * x for x in v) <= beyond**2 for v in around.to_mesh(exact=True)[0].tolist())
    grown = minkowski.offset(CUBE, Fraction(1, 2), detail=2, side="inner")
    assert grown == minkowski.sum(CUBE, minkowski.ball(Fraction(1, 2), 2))
    assert grown.bounding_box() == ((Fraction(-1, 2),) * 3, (Fraction(3, 2),) * 3)
    assert grown < minkowski.offset(CUBE, Fraction(1, 2), detail=2)
    # An octahedron with its corners on the sphere.
    assert minkowski.offset(CUBE, Fraction(-1, 4), detail=1) == nef.box(*[[Fraction(k, 4)] * 3 for k in (1, 3)])
    assert minkowski.offset(CUBE, Fraction(-1, 4), 1, "inner") < nef.box(*[[Fraction(k, 4)] * 3 for k in (1, 3)])
    assert minkowski.offset(CUBE, 0) == CUBE
    with pytest.raises(ValueError):
        minkowski.offset(CUBE, 1, side="left")
    with pytest.raises(nef.InputError):
        minkowski.ball(-1)


def test_configuration_space(needs):
    minkowski = needs("minkowski")
    box = ((0, 0, 0), (8, 8, 8))
    slit = nef.box((4, 0, 0), (5, 9, 9)) - nef.box((3, 3, -1), (6, 4, 10)).interior()
    space = minkowski.configuration_space(CUBE, [slit.closure()], box=box)
    assert (4, 3, 4) in space and (4, "3.001", 4) not in space
    assert (space & nef.box((4, 0, 0), (4, 8, 8))).volume() == 0


def test_plans(needs):
    planner = needs("planner")
    wall = nef.box((4, 0, 0), (5, 9, 9)) - nef.box((3, 3, 3), (6, 4, 4)).interior()
    phases = []
    scene = planner.Scene(CUBE, [wall], box=((0, 0, 0), (8, 8, 8)), names=["wall"])
    scene.build(progress=lambda phase, done, total: phases.append(phase))
    assert phases
    plan = scene.plan((1, 1, 1), (7, 7, 7))
    assert plan and plan.waypoints[0] == (1, 1, 1) and plan.waypoints[-1] == (7, 7, 7)
    assert all(isinstance(x, Fraction) for p in plan.waypoints for x in p)
    floats = numpy.asarray(plan)
    assert floats.shape == (len(plan.waypoints), 3)
    assert abs(numpy.linalg.norm(numpy.diff(floats, axis=0), axis=1).sum() - plan.length) < 1e-9
    # Into the segment that is the passage one comes through its end, a vertex.
    assert plan.thinness == (1, 0) and 1 in plan.segment_dimensions and plan.passages == [0]
    passage, = scene.passages()
    assert passage.dimension == 1 and {tuple(v) for v in passage.cells[0].vertices} == {(3, 3, 3), (5, 3, 3)}
    assert scene.check(plan.waypoints).status == "path"
    blocked = scene.check([(1, 1, 1), (7, 1, 1)])
    assert blocked.status == "blocked" and "wall" in blocked.collision
    assert scene.plan((4, 0, 0), (7, 7, 7)).status == "invalid_start"
    assert scene.plan((1, 1, 1), (7, 7, 7), min_dimension=2).status == "infeasible"
    assert not scene.plan((1, 1, 1), (9, 9, 9))
    closed = planner.Scene(CUBE, [wall], box=((0, 0, 0), (8, 8, 8)), contact=False).plan((1, 1, 1), (7, 7, 7))
    assert closed.status == "infeasible" and closed.proof.start_component != closed.proof.goal_component
    with pytest.raises(nef.Error):
        numpy.asarray(closed)
    with pytest.raises(nef.InputError):
        scene.plan()


def test_scene_files(tmp_path, needs):
    planner = needs("planner")
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(4,0,0, 5,9,9)"], "start": [1, 1, 1],
                                "goal": [7, 7, 7], "box": [[0, 0, 0], [8, 8, 8]]}))
    scene = planner.read(path)
    assert scene.robot == CUBE and scene.start == (1, 1, 1) and scene.plan().status == "infeasible"
    with pytest.raises(nef.InputError, match="nowhere"):
        planner.read(tmp_path / "nowhere.json")


def test_visual_hull(needs):
    visual_hull = needs("visual_hull")
    # Three cameras along the axes, far away; the object is the cube [-1, 1]^3 as they see it: 40 x 40 pixels or so.
    far, focal = 1000, 20000
    axes = [numpy.eye(3)[[1, 2, 0]], numpy.eye(3)[[2, 0, 1]], numpy.eye(3)]
    cameras = []
    for rows in axes:
        matrix = numpy.column_stack([rows, [0, 0, far]])
        cameras.append(numpy.array([[focal, 0, 31.5], [0, focal, 31.5], [0, 0, 1]]) @ matrix)
    mask = numpy.zeros((64, 64), numpy.uint8)
    mask[12:52, 12:52] = 255
    told = []
    hull = visual_hull.compute([mask] * 3, cameras, box=((-2, -2, -2), (2, 2, 2)),
                               progress=lambda *step: told.append(step))
    assert told[:3] == [(f"load view {i}", i, 3) for i in range(3)] and told[-1] == ("verify view 2", 2, 3)
    low, high = hull.solid.bounding_box()
    assert all(abs(float(x) + 1) < 0.01 for x in low) and all(abs(float(x) - 1) < 0.01 for x in high)
    assert all(view.inside and view.score > 0.9 and not view.cut_by_frame for view in hull.views)
    assert [view.name for view in hull.views] == ["view 0", "view 1", "view 2"]
    with pytest.raises(nef.InputError) as caught:
        visual_hull.compute([mask, 0 * mask, mask], cameras, names=["a", "blank", "c"], box=((-2, -2, -2), (2, 2, 2)))
    assert caught.value.view == "blank"
    with pytest.raises(nef.InputError):
        visual_hull.compute([mask], [numpy.zeros((3, 4))])
    with pytest.raises(ValueError):
        visual_hull.compute([mask], cameras)
    with pytest.raises(TypeError, match=r"array of shape \(H, W\), not 'a.png'"):
        visual_hull.compute(["a.png"], cameras)
    with pytest.raises(TypeError, match="photographs must be a list of files"):
        visual_hull.masks("photographs")
    with pytest.raises(nef.InputError, match="^view 1: the silhouette is empty: its mask is 0 everywhere$"):
        visual_hull.compute([mask, 0 * mask, mask], cameras, box=((-2, -2, -2), (2, 2, 2)))
    with pytest.raises(nef.InputError, match="^view 0: the silhouette is empty: no number of its mask is 128 or more$"):
        visual_hull.compute([mask // 4], cameras[:1], soft=True)
    with pytest.raises(nef.InputError, match="^view 2: the silhouette is empty: its mask is 0 everywhere$"):
        visual_hull.refine([mask, mask, 0 * mask], cameras)


def test_soft_masks(needs, tmp_path):
    visual_hull = needs("visual_hull")
    # As above, but the silhouettes are discs of radius 20.3 about the middle, by 8 x 8 points a pixel.
    place = (numpy.arange(64 * 8) + 0.5) / 8 - 0.5 - 31.5
    inside = place[:, None] ** 2 + place[None, :] ** 2 < 20.3 ** 2
    covered = inside.reshape(64, 8, 64, 8).mean((1, 3))
    opacity = (255 * covered).round().astype(numpy.uint8)
    matrix = numpy.array([[20000, 0, 31.5], [0, 20000, 31.5], [0, 0, 1]])
    cameras = [matrix @ numpy.column_stack([numpy.eye(3)[order], [0, 0, 1000]]) for order in ([1, 2, 0], [2, 0, 1], [0, 1, 2])]
    # Three cylinders of one radius meet in a solid of (16 - 8 sqrt(2)) r^3.
    truth = (16 - 8 * 2 ** .5) * (20.3 / 20) ** 3

    def error(masks, **options):
        hull = visual_hull.compute(masks, cameras, box=((-2, -2, -2), (2, 2, 2)), **options)
        return abs(float(hull.solid.volume()) / truth - 1)
    assert error([opacity] * 3, soft=True) < 0.005 < error([opacity >= 128] * 3)
    with pytest.raises(nef.InputError, match="numbers from 0 to 255"):
        visual_hull.compute([opacity >= 128] * 3, cameras, soft=True)
    file = tmp_path / "disc.png"
    visual_hull._visual_hull.write_mask((40 + 160 * covered).round().astype(numpy.uint8), str(file))
    hard, soft = (visual_hull.masks([file], "threshold:gray", soft=how).masks[0] for how in (False, True))
    assert hard.dtype == bool and ((soft >= 128) == (covered >= 0.5))[covered != 0.5].all()
    assert 0 < ((soft > 0) & (soft < 255)).sum() < 500


def test_texture_of_photographs(needs, tmp_path):
    visual_hull = needs("visual_hull")
    masks, cameras = turntable_of_balls(6, shape=(100, 120), focal=150)
    photographs = [numpy.full((*mask.shape, 3), (200, 100, 50), numpy.uint8) for mask in masks]
    hull = visual_hull.compute(masks, cameras, tolerance=1, photographs=photographs, verify=False)
    texture = hull.texture
    assert texture.triangles.shape[1:] == (3,) and texture.places.shape == (*texture.triangles.shape, 2)
    assert texture.places.min() >= 0 and texture.places.max() <= 1 and 0 <= texture.unseen < 0.5
    assert abs(texture.image.astype(int) - (200, 100, 50)).max() <= 1
    for name in ("hull.glb", "hull.obj", "hull.ply", "hull.3mf"):
        texture.write(tmp_path / name)
        assert nef.read(tmp_path / name).bounding_box() is not None
    assert {"hull.mtl", "hull_texture.png"} <= {file.name for file in tmp_path.iterdir()}
    with pytest.raises(nef.InputError, match="OBJ, PLY, GLB or 3MF"):
        texture.write(tmp_path / "hull.stl")
    with pytest.raises(nef.InputError, match="photograph of shape"):
        visual_hull.compute(masks, cameras, photographs=photographs[1:])
    assert visual_hull.compute(masks, cameras, tolerance=1, verify=False).texture is None


def turntable_of_balls(count, focal=300, distance=4, shape=(200, 240), turned=numpy.eye(3)):
    """Masks and cameras of a few balls, turned over, on a turntable."""
    balls = [((0, 0, 0), .5), ((.5, .2, .3), .3), ((-.3, .5, -.3), .35), ((.1, -.6, .2), .25), ((.2, .1, .7), .2)]
    balls = [(turned @ centre, radius) for centre, radius in balls]
    v, u = numpy.mgrid[0:shape[0], 0:shape[1]]
    masks, cameras = [], []
    for i in range(count):
        azimuth, elevation = 2 * numpy.pi * i / count, .35
        eye = distance * numpy.array([numpy.cos(azimuth) * numpy.cos(elevation),
                                      numpy.sin(azimuth) * numpy.cos(elevation), numpy.sin(elevation)])
        ahead = -eye / distance
        right = numpy.cross(ahead, (0, 0, 1))
        right /= numpy.linalg.norm(right)
        rows = numpy.stack([right, numpy.cross(ahead, right), ahead])
        k = numpy.array([[focal, 0, (shape[1] - 1) / 2], [0, focal, (shape[0] - 1) / 2], [0, 0, 1]])
        cameras.append(k @ numpy.column_stack([rows, -rows @ eye]))
        rays = numpy.stack([u, v, numpy.ones(shape)], -1) @ numpy.linalg.inv(k @ rows).T
        mask = numpy.zeros(shape, bool)
        for centre, radius in balls:
            away = eye - centre
            b = rays @ away
            mask |= b * b >= (rays * rays).sum(-1) * (away @ away - radius * radius)
        masks.append(mask)
    return masks, cameras


def test_cameras_from_silhouettes(needs):
    visual_hull = needs("visual_hull")
    masks, cameras = turntable_of_balls(12)
    right = visual_hull.refine(masks, cameras)
    assert not right.accepted and right.model == "none" and right.residual[0] == right.residual[1] < .1
    assert all(numpy.array_equal(a, b) for a, b in zip(right.cameras, cameras))
    off = [numpy.array(camera) for camera in cameras]
    off[4][0] += 4 * off[4][2]  # by four pixels
    refined = visual_hull.refine(masks, off, names=list("abcdefghijkl"))
    assert refined.accepted and [view.name for view in refined.views if view.fault] == ["e"]
    assert refined.residual[1] < refined.residual[0] / 2 and refined.held_out[1] < refined.held_out[0] / 2
    # Cameras that are known to a hundredth of a pixel stay; one that stands elsewhere nevertheless is named and moved.
    held = visual_hull.refine(masks, off, camera_error=0.01)
    assert [view.moved > .01 for view in held.views] == [i == 4 for i in range(12)] and held.views[4].fault == "camera"
    with pytest.raises(nef.InputError, match="camera_error must be above 0"):
        visual_hull.refine(masks, off, camera_error=0)
    found = visual_hull.refine(masks)
    assert found.accepted and found.model == "turntable" and found.residual[1] < .1
    assert abs(found.focal / 300 - 1) < .03
    hull = visual_hull.compute(masks, found.cameras, tolerance=1)
    truth = visual_hull.compute(masks, cameras, tolerance=1)
    assert all(view.inside for view in hull.views)
    eye = -numpy.linalg.solve(found.cameras[0][:, :3], found.cameras[0][:, 3])
    scale = 4 * numpy.cos(.35) / numpy.hypot(eye[0], eye[1])  # by the distance from the axis, which is z
    assert abs(hull.solid.approximate_volume().value * scale ** 3 / truth.solid.approximate_volume().value - 1) < .05
    with pytest.raises(nef.InputError, match="five images"):
        visual_hull.refine(masks[:3])
    with pytest.raises(ValueError):
        visual_hull.refine(masks, cameras[:3])


def test_series_of_an_object_that_was_turned_over(needs, tmp_path):
    visual_hull = needs("visual_hull")
    turned = numpy.array([[0, 0, 1], [0, -1, 0], [1, 0, 0]])  # half a turn about (1, 0, 1)
    scenes = []
    for name, turn in ("upright", numpy.eye(3)), ("lying", turned):
        masks, cameras = turntable_of_balls(6, turned=turn)
        views = []
        for i, (mask, camera) in enumerate(zip(masks, cameras)):
            file = tmp_path / f"{name}{i}.pgm"
            file.write_bytes(b"P5 %d %d 255 " % mask.shape[::-1] + (255 * mask).astype(numpy.uint8).tobytes())
            views.append({"name": str(i), "image": file.name, "P": camera.tolist()})
        scenes.append(tmp_path / f"{name}.json")
        scenes[-1].write_text(json.dumps({"cameras": views}))
    made = visual_hull.combine(scenes, tmp_path / "both.json")
    (placed,) = made.series
    assert made.fits and not placed.ambiguous and placed.views == 6 and placed.scale == 1
    assert abs(placed.rotation - turned.T).max() < .01 and abs(placed.translation).max() < .01
    assert placed.together < placed.alone + .1 < placed.runner_up
    volumes = [visual_hull.read(file, tolerance=1).solid.approximate_volume().value
               for file in (*scenes, tmp_path / "both.json")]
    assert volumes[2] < .97 * min(volumes[:2])
    with pytest.raises(nef.InputError, match="two scenes"):
        visual_hull.combine(scenes[:1], tmp_path / "one.json")


def test_masks_of_photographs(needs, tmp_path):
    visual_hull = needs("visual_hull")
    photograph = numpy.full((60, 80, 3), 40, numpy.uint8)
    photograph[20:40, 30:60] = (200, 180, 190)
    file = tmp_path / "photograph.ppm"
    file.write_bytes(b"P6 80 60 255 " + photograph.tobytes())
    made = visual_hull.masks([file])
    assert made.chosen and made.masks[0].shape == (60, 80) and made.masks[0][20:40, 30:60].mean() > .95
    assert made.masks[0].sum() == pytest.approx(600, abs=40)
    with pytest.raises(nef.InputError):
        visual_hull.masks([tmp_path / "nowhere.png"])


def test_options_of_hulls(needs):
    visual_hull = needs("visual_hull")
    masks, cameras = turntable_of_balls(12)
    plain = visual_hull.compute(masks, cameras, tolerance=1)
    outer = visual_hull.compute(masks, cameras, tolerance=1, outer=True)
    assert visual_hull.compute(masks, cameras).solid <= outer.solid and not plain.suspects
    largest = visual_hull.compute(masks, cameras, tolerance=1, largest=True)
    assert len(largest.solid.split()) == 1 and largest.solid <= plain.solid and largest.pieces == plain.pieces
    # A mask that lost its lower half is a suspect, and is left out.
    cut = [mask.copy() for mask in masks]
    cut[3][100:] = False
    assert visual_hull.compute(cut, cameras, tolerance=1, suspects=True).suspects == ["view 3"]
    dropped = visual_hull.compute(cut, cameras, tolerance=1, drop_suspects=True)
    assert dropped.suspects == ["view 3"] and len(dropped.views) == 11
    most = visual_hull.compute(masks[:4], cameras[:4], tolerance=4, at_least=3, box=((-2, -2, -2), (2, 2, 2)))
    assert visual_hull.compute(masks[:4], cameras[:4], tolerance=4).solid <= most.solid and most.views[0].inside is None
    # A lens that does nothing, and one that makes the image larger.
    k = numpy.array([[300, 0, 119.5], [0, 300, 99.5], [0, 0, 1]])
    straight = visual_hull.compute(masks, cameras, lens=(k, [0, 0, 0, 0]), tolerance=1).solid.approximate_volume().value
    assert straight == pytest.approx(plain.solid.approximate_volume().value, rel=.02)
    bent = visual_hull.compute(masks, cameras, lens=[(k, [.1, 0, 0, 0])] * 12, tolerance=1)
    assert bent.solid.approximate_volume().value < plain.solid.approximate_volume().value
    with pytest.raises(ValueError):
        visual_hull.compute(masks, cameras, lens=(k, [0, 0]))
    with pytest.raises(ValueError):
        visual_hull.compute(masks, cameras, lens=[(k, [0, 0, 0, 0])] * 3)


def photographs_of_board(folder, svg, count, focal=700, shape=(480, 640)):
    """Photographs of the page of a board, tilted and turned, and the matrices of their cameras, about its middle."""
    page = [float(x) for x in re.search(r'viewBox="0 0 (\S+) (\S+)"', svg).groups()]
    pixels = 5
    sheet = numpy.full((int(page[1] * pixels), int(page[0] * pixels)), 220.)
    for x, y, w, h in re.findall(r"M([\d.]+) ([\d.]+)h([\d.]+)v([\d.]+)h", svg):
        left, top, right, bottom = (round(float(t) * pixels) for t in (x, y, float(x) + float(w), float(y) + float(h)))
        sheet[top:bottom, left:right] = 20
    k = numpy.array([[focal, 0, (shape[1] - 1) / 2], [0, focal, (shape[0] - 1) / 2], [0, 0, 1]])
    # Four samples a pixel.
    v, u = numpy.mgrid[-.25:shape[0] - .5:.5, -.25:shape[1] - .5:.5]
    files, cameras = [], []
    for i in range(count):
        a, e = 2 * i, .7 + .3 * (i % 2)
        eye = 380 * numpy.array([numpy.cos(a) * numpy.cos(e), numpy.sin(a) * numpy.cos(e), numpy.sin(e)])
        ahead = -eye / numpy.linalg.norm(eye)
        right = numpy.cross(ahead, (0, 0, 1))
        right /= numpy.linalg.norm(right)
        rows = numpy.stack([right, numpy.cross(ahead, right), ahead])
        cameras.append(k @ numpy.column_stack([rows, -rows @ eye]))
        rays = numpy.stack([u, v, numpy.ones(u.shape)], -1) @ numpy.linalg.inv(k @ rows).T
        at = eye - eye[2] / rays[..., 2:] * rays
        x = numpy.floor((at[..., 0] + page[0] / 2) * pixels).astype(int)
        y = numpy.floor((page[1] / 2 - at[..., 1]) * pixels).astype(int)
        on = (rays[..., 2] < 0) & (x >= 0) & (y >= 0) & (x < sheet.shape[1]) & (y < sheet.shape[0])
        seen = numpy.where(on, sheet[y * on, x * on], 110)
        gray = seen.reshape(shape[0], 2, shape[1], 2).mean((1, 3)).astype(numpy.uint8)
        files.append(folder / f"photo{i}.ppm")
        files[-1].write_bytes(b"P6 %d %d 255 " % (shape[1], shape[0]) + numpy.repeat(gray, 3).tobytes())
    return files, cameras


def test_cameras_by_a_board(needs, tmp_path):
    visual_hull = needs("visual_hull")
    visual_hull.board(tmp_path / "board.svg", "charuco:6x4,30mm,22mm,DICT_4X4")
    files, cameras = photographs_of_board(tmp_path, (tmp_path / "board.svg").read_text(), 6)
    scene = tmp_path / "scene.json"
    with pytest.warns(UserWarning, match="middle"):  # which the principal point is taken to be
        found = visual_hull.calibrate(files, "charuco:6x4,30mm,22mm,DICT_4X4", scene=scene)
    assert found.error < .3 and found.focal[0] == pytest.approx(700, rel=.01)
    assert sum(view.corners for view in found.views) > 70 and not found.lens_views
    for view, camera in zip(found.views, cameras):
        # Points around the board are seen within two pixels of where they are.
        for point in (0, 0, 0, 1), (60, 40, 0, 1), (-60, 40, 30, 1):
            a, b = view.camera @ point, camera @ point
            assert numpy.linalg.norm(a[:2] / a[2] - b[:2] / b[2]) < 2
    assert [camera["image"] for camera in json.loads(scene.read_text())["cameras"]] == [file.name for file in files]
    with pytest.raises(nef.InputError, match="board"):
        visual_hull.calibrate(files, "charuco:6x4,30mm")
    with pytest.raises(nef.InputError, match="0 of 6"):
        visual_hull.calibrate(files, "charuco:6x4,30mm,22mm,DICT_7X7")


def test_visual_hull_of_files(needs):
    visual_hull = needs("visual_hull")
    scenes = sorted((ROOT / "data/visual_hull").glob("eight/eight.json"))
    if not scenes:
        pytest.skip("no scene in data/visual_hull")
    hull = visual_hull.read(scenes[0], tolerance=2, verify=False)
    assert hull.solid.is_bounded() and not hull.solid.is_empty()


def test_how_files_are_read(needs):
    visual_hull = needs("visual_hull")
    scene = ROOT / "data" / "visual_hull" / "eight" / "eight.json"
    hull = visual_hull.read(scene, tolerance=3, verify=False)
    assert visual_hull.read(scene, tolerance=3, verify=False, threshold="otsu").solid == hull.solid
    names = [view.name for view in hull.views]
    some = visual_hull.read(scene, tolerance=3, verify=False, without=names[:2])
    assert [view.name for view in some.views] == names[2:] and hull.solid < some.solid
    with pytest.raises(nef.InputError, match="view nobody cannot be left out"):
        visual_hull.read(scene, without=["nobody"])
    assert visual_hull.read(scene, tolerance=3, verify=False, threshold=100, channel="gray").solid == hull.solid
    assert visual_hull.read(scene, tolerance=3, verify=False, way="cones").solid == hull.solid
    turned = visual_hull.read(scene, tolerance=3, verify=False, up="x").solid
    low, high = hull.solid.bounding_box()
    # What was along x is along z now, in the same sense.
    assert (turned.bounding_box()[0][2], turned.bounding_box()[1][2]) == (low[0], high[0])
    assert turned.volume() == hull.solid.volume()
    for bad in (dict(mask="auto", threshold=3), dict(way="short"), dict(way="direct", at_least=4), dict(up="w"),
                dict(channel="colour"), dict(threshold="dark"), dict(turntable=12, radius=2)):
        with pytest.raises(nef.InputError):
            visual_hull.read(scene, **bad)
    assert not hull.views[0].cut_by_frame  # and what is around the object is
    assert visual_hull.read(scene, tolerance=3, verify=False, invert=True, threshold=100, box=hull.box).views[0].cut_by_frame


def test_turntables(needs, tmp_path):
    visual_hull = needs("visual_hull")
    # A ball of radius 1 at the origin, seen by a camera at the distance 4: a circle of radius f / sqrt(15).
    size, focal, distance, count = 201, 300, 4, 12
    v, u = numpy.mgrid[:size, :size]
    disk = 255 * ((u - 100) ** 2 + (v - 100) ** 2 < focal ** 2 / 15).astype(numpy.uint8)
    for i in range(count):
        (tmp_path / f"{i:02}.pgm").write_bytes(b"P5 %d %d 255 " % (size, size) + disk.tobytes())
    hull = visual_hull.read(tmp_path, turntable=count, intrinsics=(focal, 100, 100), radius=distance, tolerance=1, verify=False)
    cameras = []
    for i in range(count):
        angle = 2 * numpy.pi * i / count
        back = numpy.array([numpy.cos(angle), numpy.sin(angle), 0])
        rotation = numpy.array([[-back[1], back[0], 0], [0, 0, -1], -back])
        k = numpy.array([[focal, 0, 100], [0, focal, 100], [0, 0, 1]])
        cameras.append(k @ numpy.column_stack([rotation, -rotation @ (distance * back)]))
    known = visual_hull.compute([disk] * count, cameras, tolerance=1, verify=False)
    assert hull.solid.approximate_volume().value == pytest.approx(known.solid.approximate_volume().value, rel=0.02)
    assert (0, 0, "0.9") in hull.solid and (0, "0.9", 0) in hull.solid and (0, "1.2", 0) not in hull.solid
