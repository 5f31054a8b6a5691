# SPDX-License-Identifier: Apache-2.0
"""Every scene that is shipped, and random ones, with every option: the program and the package say the same."""
import itertools
import json
import os
import pathlib
import random
import subprocess
import sys
import warnings
from fractions import Fraction

import numpy
import pytest

import nef

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCENES = sorted((ROOT / "data" / "planner").glob("*.json")) + sorted((ROOT / "data" / "planner").glob("*/*.cfg"))

#: options of the program, and the arguments of Scene.plan that mean the same
TRANSLATION = [
    ("", {}),
    ("--raw", {"raw": True}),
    ("--clearance", {"clearance": True}),
    ("--prefer roomy", {"roomy": True}),
    ("--quick", {"quick": True}),
    ("--digits 2", {"digits": 2}),
    ("--min-dimension 1", {"min_dimension": 1}),
    ("--min-dimension 2", {"min_dimension": 2}),
    ("--min-dimension 3", {"min_dimension": 3}),
]
TURNING = [("", {}), ("--digits 2", {"digits": 2}), ("--max-cells 4", {"max_cells": 4})]


def read(planner, path):
    """A scene; its messages are its warnings."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        scene = planner.read(path)
    assert [str(warning.message) for warning in told] == scene.messages
    return scene


def program():
    """The program `planner` of the same build; skips the test of an installed wheel, which has none."""
    folder = os.environ.get("NEF_PROGRAM_DIR")
    if not folder:
        pytest.skip("NEF_PROGRAM_DIR does not say where the programs are")
    path = pathlib.Path(folder) / "planner"
    assert path.exists()
    return path


def asked(*arguments):
    """The report of the program, and None for what it refuses."""
    run = subprocess.run([program(), *map(str, arguments), "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                         universal_newlines=True)
    if run.returncode == 2:
        assert run.stderr.startswith("planner: ") and run.stderr.count("\n") == 1
        return None
    report = json.loads(run.stdout)
    codes = {"path": 0, "infeasible": 1, "invalid_start": 3, "invalid_goal": 3, "undecided": 5}
    assert run.returncode == (0 if "--tight" in arguments else codes[report["status"]])
    return report


def exact(point):
    return tuple(Fraction(x) for x in point)


def compare(report, scene, ends, options):
    """The program's report and what the package says."""
    try:
        plan = scene.plan(*ends, **options)
    except nef.InputError:
        assert report is None
        return "refused"
    assert report is not None and plan.status == report["status"] and plan.motions == report["motions"]
    if plan.collision:
        assert plan.collision == report["collision"]["text"]
    if not plan:
        assert plan.waypoints is None and "path" not in report
    elif scene.rotation is not None:
        assert plan.waypoints == [exact(pose["position"]) for pose in report["path"]]
        assert plan.turns == [exact(pose["turn"]["quaternion"]) for pose in report["path"]]
        assert plan.degrees == [pose["turn"]["degrees"] for pose in report["path"]]
        assert plan.unrounded == report["unrounded"]
    else:
        assert plan.waypoints == [exact(point) for point in report["path"]]
        assert plan.length == pytest.approx(report["length"], rel=1e-12) and plan.unrounded == report["unrounded"]
        assert plan.thinness == (report["thinnest_piece"], report["thinnest_junction"])
        checked = scene.check(plan.waypoints)
        assert checked.status == "path" and checked.length == pytest.approx(plan.length)
        if report["tight"] is not None:
            compare_passages(report["tight"], scene.passages())
    if plan.status == "infeasible" and scene.rotation is not None:
        assert plan.proof.cells == len(report["proof"]["cells"])
    elif plan.status == "infeasible":
        assert plan.proof == (report["proof"]["start_component"], report["proof"]["goal_component"])
    if plan.status == "undecided":
        assert len(plan.open_ranges) == len(report["undecided"])
    return plan.status


def compare_passages(tight, passages):
    assert len(tight) == len(passages)
    for told, passage in zip(tight, passages):
        assert (told["dimension"], told["component"]) == passage[:2]
        for key in ("cells", "mouths"):
            cells = getattr(passage, key)
            assert [cell["cell"] for cell in told[key]] == [cell.name for cell in cells]
            assert [[exact(v) for v in cell["vertices"]] for cell in told[key]] == [cell.vertices for cell in cells]


def without_contact(planner, scene):
    return planner.Scene(scene.robot, scene.obstacles, scene.box, False, scene.names, scene.rotation)


def compare_scene(planner, path):
    scene = read(planner, path)
    ends = (scene.start, scene.goal)
    found = []
    for option, arguments in TRANSLATION if scene.rotation is None else TURNING:
        found.append(compare(asked(path, *option.split()), scene, (), arguments))
    if scene.rotation is None and ends[0] is not None and ends[1] is not None:
        compare_passages(asked(path, "--tight")["tight"], scene.passages())
    found.append(compare(asked(path, "--contact", "forbid"), without_contact(planner, scene), ends, {}))
    found.append(compare(asked(path, "--keep-clear", "1/16"), scene.keep_clear("1/16"), (), {}))
    if ends[0] is not None and ends[1] is not None:
        back = ["--start", ",".join(map(str, ends[1])), "--goal", ",".join(map(str, ends[0]))]
        found.append(compare(asked(path, *back), scene, (ends[1], ends[0]), {}))
    return found


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_shipped_scene(path, needs):
    compare_scene(needs("planner"), path)


def test_every_kind_of_scene_is_shipped(needs):
    planner = needs("planner")
    kinds = {(read(planner, path).rotation is not None, path.suffix) for path in SCENES}
    assert kinds == set(itertools.product((False, True), (".json", ".cfg")))


def random_scene(seed):
    """Boxes, some of them flat, among which a box translates, or turns about an axis."""
    rng = random.Random(seed)

    def box(low, high, flat):
        corners = [sorted(rng.sample(range(low, high + 1), 2)) for _ in range(3)]
        if flat:
            axis = rng.randrange(3)
            corners[axis][1] = corners[axis][0]
        return "box(" + ",".join(str(c[side]) for side in (0, 1) for c in corners) + ")"

    turns = seed % 3 == 0
    scene = {
        "robot": box(-1, 1, not turns and rng.random() < 0.3),
        "obstacles": [box(0, 6, rng.random() < 0.3) for _ in range(rng.randint(1, 3))],
        "box": [[-1, -1, -1], [7, 7, 7]],
        "contact": rng.choice(["allow", "forbid"]),
        "start": [rng.randint(-1, 7) for _ in range(3)],
        "goal": [rng.randint(-1, 7) for _ in range(3)],
    }
    if turns:
        scene["rotation"] = {"axis": rng.choice(["x", "y", "z", [1, 2, 2]]), "range": [0, rng.choice([90, 360])]}
        scene["start"].append(0)
        scene["goal"].append(rng.choice([0, 90]))
    return scene


def test_random_scenes(needs, tmp_path):
    planner = needs("planner")
    found = []
    for seed in range(12):
        path = tmp_path / f"random_{seed}.json"
        path.write_text(json.dumps(random_scene(seed)))
        found += compare_scene(planner, path)
    assert {"path", "invalid_start", "invalid_goal"} <= set(found) and "refused" not in found


def test_a_robot_that_turns(needs):
    planner = needs("planner")
    path = ROOT / "data" / "planner" / "corner.json"
    scene = read(planner, path)
    assert scene.rotation is not None and len(scene.start) == 4
    plan = scene.plan()
    assert plan.status == "path" and plan.motions == "translation and turning"
    assert len(plan.turns) == len(plan.degrees) == len(plan.waypoints)
    # The same scene from its parts. Without its rotation nothing leads round the corner.
    rotation = planner.Rotation(*scene.rotation)
    made = planner.Scene(scene.robot, scene.obstacles, scene.box, rotation=rotation)
    assert made.plan(scene.start, scene.goal).turns == plan.turns
    fixed = planner.Scene(scene.robot, scene.obstacles, scene.box)
    still = fixed.plan(scene.start[:3], scene.goal[:3])
    assert still.status == "invalid_goal" and still.motions == "translation"
    # Whatever is about translations only refuses.
    for question in (made.build, made.free_space, made.components, made.passages, lambda: made.check([(0, 0, 0)])):
        with pytest.raises(nef.InputError, match="rotation"):
            question()
    for wrong in ({"raw": True}, {"clearance": True}, {"roomy": True}, {"quick": True}, {"min_dimension": 1}):
        with pytest.raises(nef.InputError, match="turns"):
            made.plan(scene.start, scene.goal, **wrong)
    with pytest.raises(nef.InputError, match="rotation"):
        fixed.plan(scene.start[:3], scene.goal[:3], max_cells=4)
    with pytest.raises(nef.InputError, match="axis"):
        planner.Scene(scene.robot, scene.obstacles, rotation=planner.Rotation("w"))
    # A wall without a hole: a proof that verifies itself.
    cube = nef.box(("-1/2",) * 3, ("1/2",) * 3)
    closed = planner.Scene(cube, [nef.box((4, -9, -9), (5, 18, 18))], ((0, 0, 0), (9, 9, 9)), rotation=planner.Rotation())
    none = closed.plan((2, 4, 4, 0), (7, 4, 4, 45))
    assert none.status == "infeasible" and isinstance(none.proof, planner.TurningProof)
    assert none.proof.cells > 0 and none.proof.complaint() is None
    text = none.proof.text()
    assert closed.prove(start=(2, 4, 4, 0), goal=(7, 4, 4, 45)) == text
    assert list(json.loads(text)["witness"]) == ["layers"]


def test_time_ends_a_plan(needs):
    planner = needs("planner")
    boxes = [nef.box((i, j, 3 * (i + j) % 7), (i + 1, j + 1, 8)) for i in range(9) for j in range(9)]
    scene = planner.Scene(nef.box((0, 0, 0), ("1/3", "1/5", "1/7")), boxes)
    assert scene.plan((-5, 0, 0), (15, 0, 0), seconds=1e-3).status == "undecided"
    assert scene.plan((-5, 0, 0), (15, 0, 0), seconds=1000)


def test_unbounded_robots_are_refused(needs):
    planner = needs("planner")
    with pytest.raises(nef.InputError, match="the robot is unbounded"):
        planner.Scene(~nef.box((0, 0, 0), (1, 1, 1)), [nef.box((3, 0, 0), (4, 1, 1))]).plan((-5, 0, 0), (15, 0, 0))


def test_certified_paths_are_those_of_the_program(needs, tmp_path):
    planner = needs("planner")
    bar = nef.box((-2, "-1/4", "-1/2"), (2, "1/4", "1/2"))
    wall = nef.box((-6, 4, -6), (6, 5, 6)) - nef.box((-3, 4, "-1/2"), (3, 5, "1/2"))
    scene = planner.Scene(bar, [wall])
    fits = [((0, 0, 0), (1, 0, 0, 1)), ((0, 1, 0), (1, 0, 0, 0)), ((0, 9, 0), (1, 0, 0, 0))]
    found = scene.certify(fits)
    assert found and found.status == "path" and found.touching == [1] and found.undecided == []
    tilted = tmp_path / "tilted.path"
    tilted.write_text("0 0 0 1 0 0 9\n0 9 0 1 0 0 9\n")
    assert scene.certify(fits, seconds=1e-9).status in ("path", "undecided")
    phases = []
    found = scene.certify(tilted, progress=lambda *told: phases.append(told))
    assert phases == [("certifying motions", 0, 1)]
    assert not found and found.collision.motion == 0
    # The pose collides by the definition, with sets.
    w, x, y, z = found.collision.quaternion
    assert (y, z) == (0, 0)
    n = w * w + x * x
    c, s = (w * w - x * x) / n, 2 * w * x / n
    px, py, pz = found.collision.position
    moved = bar.transform([[1, 0, 0, px], [0, c, -s, py], [0, s, c, pz]])
    assert not (moved.interior() & wall.interior()).is_empty()
    turning = planner.Scene(bar, [wall], rotation=planner.Rotation("z", 0, 90), box=((-9, -9, -9), (9, 3, 9)))
    plan = turning.plan((0, 0, 0, 0), (0, 1, 0, 90))
    assert plan and turning.certify(plan)
    for bad in ([], [((0, 0, 0), (0, 0, 0, 0))], [((0, 0, 0), (1, 0, 0))]):
        with pytest.raises((ValueError, nef.InputError)):
            scene.certify(bad)


def replayed(text, folder):
    """The exit code of python/proofs/check.py, which shares nothing with the package."""
    file = folder / "a.proof"
    file.write_text(text)
    checker = pathlib.Path(__file__).resolve().parents[2] / "proofs" / "check.py"
    return subprocess.run([sys.executable, str(checker), str(file)], capture_output=True, check=False).returncode


def test_proofs(needs, tmp_path):
    planner = needs("planner")
    cube = nef.box((0, 0, 0), (1, 1, 1))
    wall = nef.box((4, 0, 0), (5, 9, 9))
    closed = planner.Scene(cube, [wall], box=((0, 0, 0), (8, 8, 8)))
    text = closed.prove(start=(1, 1, 1), goal=(7, 7, 7))
    assert json.loads(text)["claim"]["status"] == "infeasible"
    assert closed.complaint(text) is None and replayed(text, tmp_path) == 0
    holed = planner.Scene(cube, [wall - nef.box((3, 3, 3), (6, 4, 4)).interior()], box=((0, 0, 0), (8, 8, 8)))
    assert "obstacles" in holed.complaint(text)
    path = holed.prove(start=(1, 1, 1), goal=(7, 7, 7))
    assert json.loads(path)["claim"]["status"] == "path"
    assert holed.complaint(path) is None and replayed(path, tmp_path) == 0
    into = holed.prove([((1, 1, 1), (1, 0, 0, 0)), ((7, 7, 7), (1, 0, 0, 1))])
    assert json.loads(into)["claim"]["status"] == "blocked"
    assert holed.complaint(into) is None and replayed(into, tmp_path) == 0
    tampered = path.replace('"allow"', '"forbid"')
    assert tampered != path and holed.complaint(tampered) is not None and replayed(tampered, tmp_path) == 1
    for wrong in ("", "{}", '{"claim": 1}'):
        with pytest.raises(nef.InputError):
            holed.complaint(wrong)
    tight = holed.prove_tight()
    assert json.loads(tight)["claim"]["status"] == "tight"
    assert holed.complaint(tight) is None and replayed(tight, tmp_path) == 0
    with pytest.raises(nef.InputError):
        closed.prove_tight()
    with pytest.raises(nef.InputError, match="start and a goal"):
        holed.prove()
    with pytest.raises(nef.InputError, match="not both"):
        holed.prove([((1, 1, 1), (1, 0, 0, 0))], start=(1, 1, 1))


def test_robots_that_turn_freely(needs):
    planner = needs("planner")
    path = ROOT / "data" / "planner" / "rigid" / "elbow.json"
    scene = planner.read(path)
    assert scene.rotation == "SO(3)" and scene.start == ((-3, 0, 0), (1, 0, 0, 0))
    report = asked(path)
    plan = scene.plan()
    assert plan.status == report["status"] == "path" and plan.motions == report["motions"] == "rigid"
    assert plan.waypoints == [exact(pose["position"]) for pose in report["path"]]
    assert plan.turns == [exact(pose["quaternion"]) for pose in report["path"]]
    assert (plan.samples, plan.slices) == (report["samples"], report["slices"]) and plan.degrees is None
    assert numpy.asarray(plan).shape == (len(plan.waypoints), 7)
    assert scene.certify(plan) and json.loads(scene.prove(plan))["claim"]["status"] == "path"
    # A problem of OMPL.app, whose robot fits only upright: it may turn, or not.
    wall = ROOT / "data" / "planner" / "omplapp" / "wall_turned.cfg"
    with pytest.warns(nef.InputWarning, match="turn_freely=True"):
        assert planner.read(wall).plan().status == "infeasible"
    turning = planner.read(wall, turn_freely=True)
    report = asked(wall, "--turn-freely")
    assert turning.plan().waypoints == [exact(pose["position"]) for pose in report["path"]]
    with pytest.raises(nef.InputError, match="only the robots of .cfg files"):
        planner.read(path, turn_freely=True)
    # The same scene from its parts; with too little to find a path, and with a start that is not free.
    made = planner.Scene(scene.robot, scene.obstacles, scene.box, rotation="SO(3)")
    assert made.plan(scene.start, scene.goal, max_cells=2).status == "undecided"
    hole = planner.Scene(nef.box((-1, -1, -1), (1, 1, 1)), [nef.box((-1, -9, -9), (0, 9, 9)) - nef.box((-2, "-19/20", "-19/20"), (2, "19/20", "19/20"))],
                         ((-9, -9, -9), (9, 9, 9)), rotation="SO(3)")
    few = hole.plan(((-5, 0, 0), (1, 0, 0, 0)), ((5, 0, 0), (1, 0, 0, 0)), max_cells=2)
    assert few.status == "undecided" and len(few.reference_in_question) == 3
    assert few.boxes_in_question and all(low[0] < high[0] for low, high in few.boxes_in_question)
    assert made.plan(scene.start, scene.goal, seconds=0).status == "undecided"
    assert made.plan(((0, 0, 0), (1, 1, 1, 1)), scene.goal).status == "invalid_start"
    for call in (made.components, made.passages, lambda: made.plan((0, 0, 0), (1, 0, 0)), made.plan,
                 lambda: made.plan(scene.start, scene.goal, digits=3), lambda: made.plan(((0, 0, 0), (0, 0, 0, 0)))):
        with pytest.raises(nef.InputError):
            call()
