# SPDX-License-Identifier: Apache-2.0
"""The package as a whole: what an import loads, versions, errors and warnings in the words of Python."""
import pathlib
import pickle
import re
import subprocess
import sys
import tempfile
import warnings

import numpy
import pytest

import nef

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def in_new_python(code):
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.strip()


@pytest.mark.parametrize("name", ["minkowski", "planner", "remeshing", "visual_hull"])
def test_applications_load_on_first_use(name, needs):
    needs(name)
    assert in_new_python(f"import nef, sys; print('nef.{name}' in sys.modules, nef.{name}.__name__)") == f"False nef.{name}"
    assert name in dir(nef)


def test_unknown_attributes_are_attribute_errors():
    with pytest.raises(AttributeError, match="no attribute 'minkovski'"):
        nef.minkovski
    assert not hasattr(nef, "__path_of_nothing__")
    assert not hasattr(nef.empty(), "minkovski")


def test_names_of_other_packages_lead_to_ours():
    with pytest.raises(AttributeError, match=r"no attribute 'union'; use a \| b, or unite_all"):
        nef.union
    with pytest.raises(AttributeError, match=r"no attribute 'union'; use a \| b$"):
        nef.empty().union
    with pytest.raises(TypeError, match="not str; nef.read reads a file"):
        nef.show("part.off")
    with pytest.raises(TypeError, match="nef.read reads a file"):
        nef.from_mesh("part.off")


def test_an_application_that_was_not_built_is_an_attribute_error(tmp_path):
    package = pathlib.Path(nef.__file__).parent
    (tmp_path / "nef").mkdir()
    for file in package.iterdir():
        if file.is_file() and not file.name.startswith("_planner."):
            (tmp_path / "nef" / file.name).symlink_to(file)
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import nef; print(hasattr(nef, 'planner')); nef.planner"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.stdout == "False\n"
    assert "nef.planner is not part of this build" in run.stderr


def test_an_import_loads_little():
    # Beyond what numpy loads; each of these takes tens of milliseconds on some machines.
    loaded = in_new_python("import numpy, sys; before = set(sys.modules); import nef; print(*sorted(set(sys.modules) - before))")
    heavy = {"webbrowser", "html", "asyncio", "http", "email", "socket", "unittest", "importlib.metadata"}
    assert not heavy & set(loaded.split())
    assert not [name for name in loaded.split() if re.search("planner|visual_hull|minkowski", name)]


def test_version():
    version = re.search('define NEF_VERSION "(.*)"', (SOURCE / "nef" / "version.h").read_text()).group(1)
    assert nef.__version__ == version


def test_missing_files(tmp_path, needs):
    missing = tmp_path / "missing.off"
    reads = [lambda: nef.read(missing), lambda: nef.eval(f'file("{missing}")'),
             lambda: nef.eval(str(missing.with_suffix(".csg"))), lambda: needs("planner").read(missing.with_suffix(".json")),
             lambda: needs("planner").verdict(missing.with_suffix(".json")),
             lambda: needs("visual_hull").read(missing.with_suffix(".json"))]
    for read in reads:
        with pytest.raises(FileNotFoundError) as raised:
            read()
        assert isinstance(raised.value, (nef.MissingFileError, nef.InputError, ValueError))
        assert "missing" in str(raised.value) and "\n" not in str(raised.value)


def test_errors_can_be_pickled():
    for error in (nef.InputError("text"), nef.MissingFileError("text"), nef.UnsupportedError("text")):
        assert str(pickle.loads(pickle.dumps(error))) == "text"


def test_wrong_shapes_are_input_errors(needs):
    a = nef.box((0, 0, 0), (1, 1, 1))
    calls = [lambda: nef.from_mesh(numpy.zeros((4, 2)), [[0, 1, 2]]), lambda: nef.hull(numpy.zeros(5)),
             lambda: nef.from_mesh(numpy.zeros((4, 3)), numpy.zeros(3, dtype=int)), lambda: a.transform([[1, 2], [3, 4]]),
             lambda: a.translate((1, 2)), lambda: a.contains(numpy.zeros((2, 4))), lambda: a.split(by="colour"),
             lambda: nef.TiledPolyhedron(a, limit=1), lambda: a.to_mesh(exact=True, repair=True),
             lambda: needs("minkowski").offset(a, 1, side="left"),
             lambda: needs("minkowski").configuration_space(a, [a], box=[(0, 0, 0)]),
             lambda: needs("planner").Scene(a, [a], box=[(0, 0, 0)]), lambda: needs("planner").Scene(a, [a], names=[]),
             lambda: needs("visual_hull").compute([numpy.ones((3, 3))], [numpy.eye(3)]),
             lambda: needs("visual_hull").compute([numpy.ones(3)], [numpy.eye(4)[:3]]), lambda: nef.show(a, names=[])]
    for call in calls:
        with pytest.raises(nef.InputError):
            call()


def test_errors_name_arguments(needs, tmp_path):
    visual_hull, planner = needs("visual_hull"), needs("planner")
    a = nef.box((0, 0, 0), (1, 1, 1))
    camera = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3]]
    mask = numpy.zeros((8, 8))
    mask[2:6, 2:6] = 1
    open_mesh = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2], [0, 3, 1]])
    twisted = [[0, 0, 0], [4, 0, 0], [4, 4, 1], [0, 4, 0], [2, 2, -3]]
    calls = [lambda: visual_hull.compute([mask], [camera]), lambda: visual_hull.compute([0 * mask], [camera]),
             lambda: visual_hull.compute([mask], [camera], at_least=4, box=((-1, -1, 0), (1, 1, 1))),
             lambda: visual_hull.compute([mask], [camera], tolerance=-1, box=((-1, -1, 0), (1, 1, 1))),
             lambda: visual_hull.refine([mask], [camera]), lambda: visual_hull.board(tmp_path / "a.pdf", "chess:7x5"),
             lambda: planner.Scene(a, [a]).keep_clear(-1), lambda: planner.Scene(a, [a]).widest(),
             lambda: planner.Scene(a.translate((5, 0, 0)), [a]).widest((9, 0, 0), (12, 0, 0)),
             lambda: nef.from_mesh(*open_mesh),
             lambda: nef.from_mesh(twisted, [[0, 1, 2, 3], [1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]], strict=True)]
    for call in calls:
        with pytest.raises(nef.Error) as raised:
            call()
        text = str(raised.value)
        assert not re.search(r"(^|[ (`])--", text) and " in Python" not in text, text
        assert tempfile.gettempdir() not in text.replace(str(tmp_path), ""), text


def test_warnings_have_a_category_and_the_line_of_the_caller(tmp_path):
    assert issubclass(nef.InputWarning, UserWarning)
    (tmp_path / "empty.off").write_text("OFF\n0 0 0\n")
    calls = [lambda: nef.read(tmp_path / "empty.off"), lambda: nef.from_mesh(numpy.zeros((0, 3)), []),
             lambda: nef.halfspace(0, 0, 1, 0).to_mesh(), lambda: nef.eval(f'file("{tmp_path / "empty.off"}")')]
    for call in calls:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            call()
        assert [warning.category for warning in caught] == [nef.InputWarning]
        assert caught[0].filename == __file__


def test_plus_is_union():
    a, b = nef.box((0, 0, 0), (2, 2, 2)), nef.box((1, 1, 1), (3, 3, 3))
    assert a + b == a | b
    assert nef.TiledPolyhedron(a) + b == nef.TiledPolyhedron(a | b)
    with pytest.raises(TypeError):
        a + 1


def test_generators_go_where_lists_do(needs):
    minkowski, planner = needs("minkowski"), needs("planner")
    boxes = [nef.box((i, 0, 0), (i + 2, 1, 1)) for i in range(4)]
    assert nef.unite_all(box for box in boxes) == nef.box((0, 0, 0), (5, 1, 1))
    assert nef.intersect_all(box for box in boxes[:2]) == nef.box((1, 0, 0), (2, 1, 1))
    assert nef.unite_in_tiles(box for box in boxes).polyhedron() == nef.unite_all(boxes)
    assert nef.hull((i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)) == nef.box((0, 0, 0), (1, 1, 1))
    assert len(nef.mesh_with_origins("union", (box for box in boxes)).origins) > 0
    ring = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
    assert nef.polygon(r for r in [ring]) == nef.polygon([ring])
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
    assert nef.from_mesh((c for c in corners), (f for f in faces)) == nef.from_mesh(corners, faces)
    robot = nef.box((0, 0, 0), (1, 1, 1))
    assert (minkowski.configuration_space(robot, (box for box in boxes), box=(c for c in [(-9, -9, -9), (9, 9, 9)]))
            == minkowski.configuration_space(robot, boxes, box=((-9, -9, -9), (9, 9, 9))))
    assert planner.Scene(robot, (box for box in boxes)).obstacles == boxes
    with pytest.raises(TypeError, match="Polyhedron"):
        nef.unite_all(iter([boxes[0], 3]))
    with pytest.raises(ZeroDivisionError):
        nef.unite_all(boxes[1 // 0] for _ in range(2))


def test_eval_speaks_the_language_of_the_program(needs, tmp_path):
    minkowski = needs("minkowski")
    cube = nef.box((0, 0, 0), (2, 2, 2))
    assert nef.eval("ball(2, 3)") == minkowski.ball(2, 3)
    assert nef.eval("minkowski(box(0,0,0, 2,2,2), ball(1, 2))") == minkowski.sum(cube, minkowski.ball(1, 2))
    assert nef.eval("erode(box(0,0,0, 2,2,2), box(0,0,0, 1,1,1))") == minkowski.erode(cube, nef.box((0, 0, 0), (1, 1, 1)))
    assert nef.eval("hull(halfspace(0,0,1,-1))") == nef.halfspace(0, 0, 1, -1)
    assert nef.eval("h = 7/2; a = cylinder(2*h, 1, 0, 8); a") == nef.cylinder(7, 1, 0, 8)
    assert nef.eval("sphere(3, 12) + cylinder(2, 1)") == nef.sphere(3, 12) | nef.cylinder(2, 1)
    (tmp_path / "m.csg").write_text("difference() { cube(size = [2, 2, 2], center = false); cube(size = [1, 1, 1], center = false); }")
    assert nef.eval(str(tmp_path / "m.csg")) == nef.eval("regularize(box(0,0,0, 2,2,2) - box(0,0,0, 1,1,1))")
    # Every function of the language is known: without arguments it is complained of for these, if at all.
    for name in ("interior closure boundary exterior regularize complement union intersection hull difference symdiff "
                 "minkowski erode translate scale rotate transform box halfspace point segment polyline polygon sphere "
                 "cylinder ball").split():
        try:
            nef.eval(name + "()")
        except nef.InputError as error:
            assert "there is no set or function" not in str(error), name
    with pytest.raises(nef.InputError, match="there is no set or function"):
        nef.eval("bal(1)")


def test_round_shapes():
    assert nef.cylinder(2, 1, corners=4).volume() == 4
    assert nef.cylinder(3, 1, 0, 4).volume() == 2
    assert len(nef.sphere(1, 8).to_mesh()[0]) == 8 * 4
    for call in (lambda: nef.sphere(0), lambda: nef.sphere(1, 2), lambda: nef.cylinder(0, 1), lambda: nef.cylinder(1, 0),
                 lambda: nef.cylinder(1, -1), lambda: nef.cylinder(1, 1, corners=10**6)):
        with pytest.raises(nef.InputError):
            call()
