# SPDX-License-Identifier: Apache-2.0
"""Parts, mechanisms and linkages: as the program says, and as geometry has it."""
import json
import math
import os
import pathlib
import subprocess
from fractions import Fraction

import pytest

import nef

ROOT = pathlib.Path(__file__).resolve().parents[3]
ASSEMBLIES = sorted((ROOT / "data" / "planner" / "assembly").glob("*.json"))


def program(*arguments):
    folder = os.environ.get("NEF_PROGRAM_DIR")
    if not folder:
        pytest.skip("NEF_PROGRAM_DIR does not say where the programs are")
    run = subprocess.run([pathlib.Path(folder) / "planner", *arguments, "--json"], stdout=subprocess.PIPE, check=False)
    return json.loads(run.stdout)


def exact(point):
    return tuple(Fraction(x) for x in point)


@pytest.mark.parametrize("path", ASSEMBLIES, ids=lambda path: path.stem)
def test_verdicts_are_those_of_the_program(path, needs):
    planner = needs("planner")
    found, told = planner.verdict(path), program("--verdict", path)
    assert found.interferes == (told["status"] == "overlap")
    for pair, report in zip(found.pairs, told["pairs"]):
        assert list(pair.parts) == report["parts"] and pair.contact == report["contact"]
        assert pair.squared == Fraction(report["squared"]) and pair.distance == report["distance"]
        assert pair.points == (exact(report["on_a"]), exact(report["on_b"]))
        assert (None if pair.items is None else list(pair.items)) == report.get("items")
    for part, report in zip(found.parts, told["parts"]):
        assert (part.name, part.status) == (report["name"], report["status"])
        assert part.direction == (exact(report["direction"]) if "direction" in report else None)
        first = report["first_motions"]
        assert part.dimension == first["dimension"] and [exact(ray) for ray in part.rays] == [exact(r) for r in first["rays"]]
        assert [(name, [exact(n) for n in normals]) for name, normals in part.stops] == [
            (stop["part"], [exact(n) for n in stop["normals"]]) for stop in first["stops"]]


def test_verdict_of_sets(needs):
    planner = needs("planner")
    cube = nef.box((0, 0, 0), (1, 1, 1))
    found = planner.verdict({"a": cube, "b": cube.translate(("1/2", 0, 0)), "c": cube.translate((3, 0, 0))}, exact=True)
    assert found.interferes and found.pairs[0].overlap.exact_volume == Fraction(1, 2)
    assert abs(found.pairs[0].overlap.volume - .5) <= found.pairs[0].overlap.volume_error
    assert found.pairs[0].overlap.box == (exact(("1/2", 0, 0)), exact((1, 1, 1)))
    assert found.smallest_gap.parts == ("b", "c") and found.smallest_gap.squared == Fraction(9, 4)
    assert [part.status for part in found.parts] == ["overlapping", "overlapping", "removable"]
    assert planner.verdict({"a": cube}).smallest_gap is None
    with pytest.raises(nef.InputError):
        planner.verdict({"a": cube, "b": nef.box((0, 0, 0), (1, 1, 0))})
    with pytest.raises(nef.InputError):
        planner.verdict({})


def test_range_of_motion(needs, tmp_path):
    planner = needs("planner")
    door, post = nef.box((0, 0, 0), (3, "1/5", 2)), nef.box((2, 1, 0), (3, 2, 1))
    parts = planner.range_of_motion(door, {"post": post}, planner.Hinge(), 0, 90)
    assert [part.status for part in parts] == ["free", "touching", "colliding", "touching", "free"]
    # The corner (2, 1) meets the door's upper side: 1 cos t - 2 sin t = 1/5 with 2 cos t + sin t <= 3; else (3, 1) does.
    stop = parts[1].start
    assert stop.measure == pytest.approx(15.61228568795044, abs=1e-9)
    assert stop.bounds[0] < stop.bounds[1] < stop.bounds[0] + Fraction(1, 2 ** 59)
    assert {found.part for found in stop.stops} == {"post"}
    slider = planner.range_of_motion(nef.box((0, 0, 0), (1, 1, 1)), [nef.box((4, 0, 0), (5, 1, 1))], planner.Slider((1, 0, 0)), 0, 9)
    assert [(part.status, part.start.bounds[0], part.end.bounds[1]) for part in slider] == [
        ("free", 0, 3), ("touching", 3, 3), ("colliding", 3, 5), ("touching", 5, 5), ("free", 5, 9)]
    (tmp_path / "door.json").write_text(json.dumps({
        "moving": "box(0,0,0, 3,1/5,2)", "fixed": ["box(2,1,0, 3,2,1)"],
        "joint": {"type": "hinge", "axis": "z", "range": [0, 90]}}))
    assert [part[:1] + (part.start.bounds, part.end.bounds) for part in planner.range_of_motion(tmp_path / "door.json")] == [
        part[:1] + (part.start.bounds, part.end.bounds) for part in parts]
    screw = planner.range_of_motion(nef.box((0, 0, 0), (1, 1, 1)), [nef.box((-3, -3, 4), (3, 3, 5))], planner.Screw(pitch=1), 0, 1080)
    assert screw[0].status == "free" and screw[-1].status in ("touching", "undecided")
    bars = planner.FourBar((0, 0, 1), (0, 0, 0), (4, 0, 0), (0, 1, 0), (4, 1, 0), "coupler")
    swing = planner.range_of_motion(nef.box((0, 1, 0), (4, "3/2", 1)), [nef.box(("9/2", -3, 0), (6, 3, 1))], bars, -80, 80)
    assert [part.status for part in swing] == ["colliding", "undecided", "free"] and round(swing[1].start.measure, 5) == -30
    with pytest.raises(nef.InputError, match="one line"):
        planner.range_of_motion(door, [post], bars, 0, 180)
    with pytest.raises(nef.InputError, match="moves"):
        planner.range_of_motion(door, [post], bars._replace(moves="crank"), 0, 10)
    with pytest.raises(nef.InputError):
        planner.range_of_motion(door)
    with pytest.raises(nef.InputError):
        planner.range_of_motion(door, [post], planner.Hinge((0, 0, 0)))
    with pytest.raises(nef.InputError):
        planner.range_of_motion(door, [post], planner.Hinge(), 90, 0)


def test_robots_from_urdf_files(needs):
    planner = needs("planner")
    folder = pathlib.Path(__file__).resolve().parents[3] / "data/planner/linkage"
    if not planner.reads_urdf():
        with pytest.raises(nef.InputError, match="liburdfdom-dev"):
            planner.Linkage.read(folder / "crane.urdf")
        return
    crane = planner.Linkage.read(folder / "crane.urdf", folder / "crane.srdf")
    assert crane.links == ["ground", "mast", "boom", "jib", "hook"]
    assert [joint.name for joint in crane.joints] == ["slew", "luff", "reach"]
    assert crane.joints[0].upper == pytest.approx(math.pi) and crane.joints[2] == ("reach", 0, 1.5, False)
    box = nef.box((3, -1, 1), (4, 1, 3))
    assert crane.check([0, 0, 0], [0, 0, 0.5], [box])
    assert crane.check([math.pi / 2, 0, 1], [-math.pi / 2, 0, 1], [box]).status == "blocked"
    assert crane.joints[0].continuous
    with pytest.raises(nef.InputError):
        planner.Linkage.read(folder / "crane.srdf")


def test_paths_of_linkages_are_those_of_the_program(needs, tmp_path):
    planner = needs("planner")
    if not planner.reads_urdf():
        return
    folder = pathlib.Path(__file__).resolve().parents[3] / "data/planner/linkage"
    crane = planner.Linkage.read(folder / "crane.urdf", folder / "crane.srdf")
    box = nef.box((3, -1, 1), (4, 1, 3))
    half = math.pi / 2
    round_it = [[half, 0, 1], [half, 0, 0], [-half, 0, 0], [-half, 0, 1]]
    for path in (round_it, round_it[:1] + round_it[-1:]):
        file = tmp_path / "joints.txt"
        file.write_text("".join(" ".join(map(repr, map(float, values))) + "\n" for values in path))
        found = crane.certify(path, [box])
        assert found == crane.certify(file, [box])
        told = program("--linkage", folder / "crane.urdf", "--srdf", folder / "crane.srdf", "--obstacle", "box(3,-1,1, 4,1,3)",
                       "--path", file)
        assert found.status == told["status"] and found.blocked == told.get("blocked_segment")
        assert [motion.status for motion in found.motions] == [verdict["status"] for verdict in told["verdicts"]]
        assert told["path"] == path and told["joints"] == [joint.name for joint in crane.joints]
        for motion, verdict in zip(found.motions, told["verdicts"]):
            if motion.status == "blocked":
                assert motion.parameter == verdict["collision"]["parameter"]
                assert list(motion.links) == verdict["collision"]["links"]
    assert crane.certify(round_it, [box])
    assert crane.certify(round_it, [box], seconds=1e-9).status in ("path", "undecided")
    with pytest.raises(nef.InputError, match="reach"):
        crane.certify([[0, 0, 2]])
    with pytest.raises(nef.InputError):
        crane.certify([])
    phases = []
    crane.certify(round_it, [box], progress=lambda *told: phases.append(told))
    assert ("certifying motions", 2, 3) in phases


def test_linkages(needs):
    planner = needs("planner")
    robot = planner.Linkage()
    bone = nef.box((0, "-1/4", "-1/4"), (2, "1/4", "1/4"))
    robot.add("arm", bone, kind="revolute")
    robot.add("hand", bone, "arm", "revolute", shift=(2.5, 0, 0))
    robot.add("finger", bone, "hand", "prismatic", shift=(0, 0, 1), axis=(1, 0, 0))
    wall = nef.box((1, 3, -1), (6, 4, 3))
    assert robot.check([0, 0, 0], [0.3, 0.3, 0.5], [wall])
    hit = robot.check([0, 0, 0], [math.pi / 2, 0, 0], [wall])
    assert hit.status == "blocked" and hit.links[1] is None and 0 < hit.parameter < 1
    assert robot.check([math.pi / 2, 0, 0], obstacles=[wall]).status == "path"     # beside the wall
    # The hand turned back lies along the arm; a gap of .5 at the joint keeps them apart until then.
    folded = robot.check([0, 0, 0], [0, math.pi, 0])
    assert folded.status == "path"       # links that share a joint are not compared
    other = planner.Linkage(nef.box((-1, -1, -3), (1, 1, -2)))
    other.add("slide", bone, kind="prismatic", shift=(0, 0, 2))
    other.add("end", bone, "slide", "revolute", shift=(0, 0, -2), axis=(0, 1, 0))
    assert other.check([0, 0], [-2.5, 0]).links == ("end", "base")
    other.allow("end", "base")
    assert other.check([0, 0], [-2.5, 0]).status == "path"
    for wrong in (lambda: robot.add("arm"), lambda: robot.add("x", None, "nobody"), lambda: robot.add("x", None, kind="ball")):
        with pytest.raises(nef.InputError):
            wrong()
    with pytest.raises(ValueError):
        robot.check([0])
