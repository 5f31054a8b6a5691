# SPDX-License-Identifier: Apache-2.0
"""Calls with wrong arguments: one line that names the argument, what it must be, and what was given."""
import copy

import numpy
import pytest

import nef
from nef.arguments import complaint

CUBE = nef.box((0, 0, 0), (1, 1, 1))

REFUSED = [
    (lambda: nef.box(1, 2, 3), "box() was called with too many arguments, 3: box(low, high); "
                                "three coordinates are one argument, such as (0, 0, 1)"),
    (lambda: CUBE.translate(1, 2, 0.5), "translate() was called with too many arguments, 3: translate(by); "
                                        "three coordinates are one argument, such as (0, 0, 1)"),
    (lambda: nef.unite_all(CUBE, CUBE, CUBE), "unite_all() was called with too many arguments, 3: unite_all(sets, threads=1)"),
    (lambda: nef.hull(CUBE), "points must be points; the hull of sets is nef.minkowski.hull(a), or of a | b for two"),
    (lambda: nef.hull([CUBE, CUBE]), "points must be points; the hull of sets is nef.minkowski.hull(a), or of a | b for two"),
    (lambda: nef.box((0, 0, 0)), "box() lacks the argument 'high': box(low, high)"),
    (lambda: nef.box(low=(0, 0, 0), hi=(1, 1, 1)), "box() has no argument 'hi': box(low, high)"),
    (lambda: nef.box((0, 0, 0), (1, 1, 1), low=(2, 2, 2)), "box() was given the argument 'low' twice: box(low, high)"),
    (lambda: nef.sphere(1, corners=4.5), "sphere(): corners must be an int, not 4.5 (float)"),
    (lambda: nef.sphere(1, "many"), "sphere(): corners must be an int, not 'many' (str)"),
    (lambda: nef.eval(5), "eval(): text must be a str, not 5 (int)"),
    (lambda: nef.halfspace(1, 1, 1, 0, closed="yes"), "halfspace(): closed must be True or False, not 'yes' (str)"),
    (lambda: CUBE.volume(1), "volume() was called with too many arguments, 1: volume()"),
    (lambda: CUBE.isdisjoint("part.off"), "isdisjoint(): other must be a nef.Polyhedron, not 'part.off' (str)"),
    (lambda: nef.Polyhedron.volume("part.off"), "volume() is a method of a nef.Polyhedron, not of 'part.off' (str)"),
    (lambda: nef.TiledPolyhedron(CUBE, limit="all"), "TiledPolyhedron(): limit must be an int or None, not 'all' (str)"),
]


@pytest.mark.parametrize("number", range(len(REFUSED)))
def test_the_argument_is_named(number):
    call, text = REFUSED[number]
    with pytest.raises(TypeError) as caught:
        call()
    assert str(caught.value) == text


def test_a_value_that_only_its_function_refuses():
    with pytest.raises(TypeError, match=r"sphere\(\) does not take these values: 1 \(int\), corners=-1 \(int\); it is "):
        nef.sphere(1, corners=-1)


def test_applications(needs):
    needs("minkowski")
    with pytest.raises(TypeError, match=r"^sum\(\): b must be a nef.Polyhedron, not 1 \(int\)$"):
        nef.minkowski.sum(CUBE, 1)
    needs("planner")
    with pytest.raises(TypeError, match=r"^Scene\(\): robot must be a nef.Polyhedron, not 'robot.off' \(str\)$"):
        nef.planner.Scene("robot.off", [CUBE])
    with pytest.raises(TypeError, match=r"obstacles must be a list, each item a nef.Polyhedron"):
        nef.planner.Scene(CUBE, ["wall.off"])


def test_options_of_applications(needs):
    needs("visual_hull")
    with pytest.raises(TypeError, match=r"^tolerance must be a number, not 'x' \(str\)$"):
        nef.visual_hull.read("scene.json", tolerance="x")
    with pytest.raises(TypeError, match="^expected str"):
        nef.visual_hull.read("scene.json", images=5)
    with pytest.raises(TypeError, match=r"^channel must be a str, not 7 \(int\)$"):
        nef.visual_hull.read("scene.json", channel=7)
    with pytest.raises(TypeError, match=r"^turntable must be an int, not 1.5 \(float\)$"):
        nef.visual_hull.read("images", turntable=1.5)
    with pytest.raises(nef.InputError, match="from 5 to 100000 images"):
        nef.visual_hull.read("images", turntable=-2**31)
    needs("planner")
    scene = nef.planner.Scene(CUBE, [], box=((-9,) * 3, (9,) * 3))
    with pytest.raises(TypeError, match=r"seconds must be a number or None, not '1' \(str\)$"):
        scene.widest((0, 0, 0), (1, 1, 1), seconds="1")
    with pytest.raises(TypeError, match=r"^base must be a nef.Polyhedron or None, not 5 \(int\)$"):
        nef.planner.Linkage(5)
    with pytest.raises(TypeError, match=r"^axis must be 3 numbers, not None \(NoneType\)$"):
        nef.planner.Linkage().add("arm", axis=None)
    with pytest.raises(nef.InputError, match="^turn must be 4 numbers, not 3$"):
        nef.planner.Linkage().add("arm", turn=(1, 0, 0))
    with pytest.raises(nef.InputError) as caught:
        nef.planner.Scene(CUBE, [], rotation="SO(3)").certify([numpy.zeros((3, 3))])
    assert "\n" not in str(caught.value)


def test_labels_are_integers():
    with pytest.raises(TypeError, match=r"^a label that the function gives must be an int, not 'x' \(str\)$"):
        nef.overlay(CUBE, CUBE, lambda x, y: "x")


def test_faces_are_integers():
    with pytest.raises(TypeError, match="faces must be lists of integers, not of 0.5"):
        nef.from_mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0.5, 1, 2)])


def test_errors_of_functions_are_not_changed():
    with pytest.raises(nef.InputError, match="a corner needs three numbers"):
        nef.box((0, 0), (1, 1))
    with pytest.raises(TypeError, match="a number is needed"):
        nef.box((0, 0, 0), (1, 1, None))
    with pytest.raises(TypeError, match="unsupported operand"):
        CUBE - 3


def test_a_single_ring_is_not_a_list_of_rings():
    triangle = [(0, 0, 0), (1, 0, 0), ("1/3", 1, 0)]
    for ring in (triangle, numpy.array(triangle[:2]), [("1/3", 0, 0), (1, 0, 0)]):
        with pytest.raises(nef.InputError, match=r"^rings must be a list of rings, .* write \[ring\] for a single one$"):
            nef.polygon(ring)
    assert nef.polygon([triangle]).surface_area() == 0.5
    assert nef.polygon(iter([triangle])) == nef.polygon([triangle])


def test_names_of_other_packages_get_a_hint():
    for name, hint in (("cone", r"cylinder\(height, radius, 0\)"), ("mirror", r"a.scale\(\(-1, 1, 1\)\)"), ("slice", "a.section")):
        with pytest.raises(AttributeError, match=f"module 'nef' has no attribute '{name}'; use {hint}"):
            getattr(nef, name)
    for name, hint in (("centroid", r"moments\(\).centroid"), ("is_watertight", "to_mesh as it is"), ("show", r"nef.show\(a\)")):
        with pytest.raises(AttributeError, match=f"'nef.Polyhedron' object has no attribute '{name}'; use {hint}"):
            getattr(CUBE, name)


def test_several_overloads():
    text = ("f(): incompatible function arguments. The following argument types are supported:\n"
            "    1. (a: int) -> int\n    2. (text: str, sep: str = ', ') -> str\n\nInvoked with: 1.5")
    assert complaint(text, (1.5,), {}) == "f() takes none of these values: 1.5 (float); it is f(a) or f(text, sep=', ')"


def test_misspelt_names_get_a_suggestion(needs):
    with pytest.raises(AttributeError, match="no attribute 'half_space'; did you mean 'halfspace'"):
        nef.half_space
    for module, name, hint in (("minkowski", "summ", "did you mean 'sum'"), ("minkowski", "close", "use closing"), ("planner", "plan", r"use Scene\(robot, obstacles\).plan"),
                               ("visual_hull", "hull", "use compute"), ("remeshing", "decimte", "did you mean 'decimate'")):
        with pytest.raises(AttributeError, match=f"module 'nef.{module}' has no attribute '{name}'; {hint}"):
            getattr(needs(module), name)
    with pytest.raises(AttributeError, match="no attribute 'volum'; did you mean 'volume'"):
        CUBE.volum


def test_the_way_points_of_a_plan_are_found(needs):
    plan = needs("planner").Scene(CUBE, []).plan((5, 0, 0), (9, 0, 0))
    with pytest.raises(AttributeError, match="'Plan' object has no attribute 'path'; use waypoints"):
        plan.path
    with pytest.raises(AttributeError, match="no attribute 'lenght'; did you mean 'length'"):
        plan.lenght
    assert copy.copy(plan).waypoints == plan.waypoints
