# SPDX-License-Identifier: Apache-2.0
"""Assemblies, free directions, and the widest robot: answers known by hand."""
import json
from fractions import Fraction

import pytest

import nef


def tube(low, high):
    """A box without the interior of one that passes through it along z."""
    inner = nef.box((low[0] + 1, low[1] + 1, low[2] - 1), (high[0] - 1, high[1] - 1, high[2] + 1))
    return nef.box(low, high) - inner.interior()


def test_a_peg_leaves_upward(needs):
    planner = needs("planner")
    parts = {"block": nef.box((0, 0, 0), (3, 3, 3)) - nef.box((1, 1, 1), (2, 2, 4)).interior(),
             "peg": nef.box((1, 1, 1), (2, 2, 4))}
    parts["block"] = parts["block"].regularize()
    answer = planner.disassemble(parts)
    assert answer.status == "sequence" and answer.overlap is None and answer.inseparable == answer.undecided == []
    step = answer.steps[0]
    assert {step.parts[0], step.stay[0]} == {"peg", "block"} and step.straight
    up = 1 if step.parts == ["peg"] else -1
    assert step.path[-1][0] == step.path[-1][1] == 0 and up * step.path[-1][2] > 0
    free = planner.free_directions(parts, "peg")
    assert (free.dimension, free.rays, free.everything) == (1, [(0, 0, 1)], False)
    assert free.cone == nef.segment((0, 0, 0), (0, 0, 1))
    assert free.stops[0][0] == "block"
    assert planner.verdict(parts).parts[1].rays == free.rays


def test_linked_rings_are_inseparable(needs):
    planner = needs("planner")
    rings = {"flat": tube((0, 0, 0), (5, 5, 1)),
             "upright": nef.box((2, 2, -2), (7, 3, 3)) - nef.box((3, 1, -1), (6, 4, 2)).interior()}
    answer = planner.disassemble(rings)
    assert answer.status == "inseparable" and not answer.steps
    assert sorted(answer.inseparable[0].parts) == ["flat", "upright"]
    assert not answer.inseparable[0].nothing_moves  # there is play
    apart = planner.disassemble({"a": nef.box((0, 0, 0), (1, 1, 1)), "b": nef.box((2, 0, 0), (3, 1, 1))})
    assert apart.status == "sequence"


def test_a_part_in_a_closed_box_cannot_move(needs):
    planner = needs("planner")
    core = nef.box((1, 1, 1), (2, 2, 2))
    parts = {"shell": (nef.box((0, 0, 0), (3, 3, 3)) - core.interior()).regularize(), "core": core}
    free = planner.free_directions(parts, "core")
    assert (free.dimension, free.rays) == (0, []) and free.cone == nef.point((0, 0, 0))
    stuck = planner.disassemble(parts).inseparable[0]
    assert stuck.nothing_moves and stuck.blocked_by["core"] == ["shell"]


def test_parts_that_turn_move_at_once_or_keep_clear(needs):
    planner = needs("planner")
    # A bar across a slot: it turns a quarter, and leaves upward.
    block = nef.box((-3, -3, 0), (3, 3, 4)) - nef.box((-2, -2, 1), (2, 2, 2)) - nef.box((-2, -1, 1), (2, 1, 4))
    parts = {"block": block.closure().regularize(), "bar": nef.box(("-1/2", "-3/2", "9/8"), ("1/2", "3/2", "15/8"))}
    assert planner.disassemble(parts).status == "inseparable"
    step = planner.disassemble(parts, rotation=(0, 0, 1)).steps[0]
    assert step.turning is not None and len(step.turning.quaternions) == len(step.path)
    assert step.vectors == {}
    with pytest.raises(nef.InputError):
        planner.disassemble(parts, rotation="SO(2)")
    pair = {"a": nef.box((0, 0, 0), (1, 1, 1)), "b": nef.box((2, 0, 0), (3, 1, 1))}
    assert planner.disassemble(pair, keep_clear=1).status == "sequence"
    assert planner.disassemble(pair, keep_clear="3/2").status == "too_close"
    stuck = {"block": nef.box((0, 0, 0), (7, 3, 3)) - nef.box((1, 1, 1), (2, 2, 2)).interior()
             - nef.box((4, 1, 1), (5, 2, 2)).interior(),
             "left": nef.box((1, 1, 1), (2, 2, 2)), "right": nef.box((4, 1, 1), (5, 2, 2))}
    found = planner.disassemble(stuck).inseparable[0]
    assert len(found.parts) == 3 and len(found.interlocked) == 2 and found.interlocked_is_least
    assert planner.disassemble(stuck, simultaneous=True).status == "inseparable"


def test_overlaps_and_bad_parts(needs, tmp_path):
    planner = needs("planner")
    a, b = nef.box((0, 0, 0), (2, 2, 2)), nef.box((1, 1, 1), (3, 3, 3))
    assert planner.disassemble({"a": a, "b": b}).overlap in (("a", "b"), ("b", "a"))
    for call in (lambda: planner.free_directions({"a": a, "b": b}, "a"), lambda: planner.free_directions({"a": a}, "c"),
                 lambda: planner.disassemble({}), lambda: planner.disassemble({"a": nef.point((0, 0, 0))}),
                 lambda: planner.disassemble({"a": a}, digits=999), lambda: planner.verdict({"a": nef.everything()})):
        with pytest.raises(nef.InputError):
            call()
    file = tmp_path / "parts.json"
    file.write_text(json.dumps({"parts": {"a": "box(0,0,0, 2,2,2)", "b": "box(2,0,0, 3,1,1)"}}))
    assert planner.disassemble(file).status == "sequence"
    assert planner.free_directions(file, "b").dimension == 3


def test_the_widest_robot(needs):
    planner = needs("planner")
    wall = nef.box((4, 0, 0), (5, 9, 9)) - nef.box((3, 3, 3), (6, 5, 5)).interior()
    scene = planner.Scene(nef.box((0, 0, 0), (1, 1, 1)), [wall], box=((0, 0, 0), (8, 8, 8)))
    found = scene.widest((1, 1, 1), (6, 6, 6))
    assert found.low == 2 and 2 < found.high <= 2 + Fraction(2, 500) and not found.undecided
    assert found.robot == nef.box((0, 0, 0), (2, 2, 2))
    # The cube from -r to r widens the robot by 2 r, and leaves its reference point in place.
    grown = scene.widest((1, 1, 1), (6, 6, 6), growth="box", precision="1/100")
    assert grown.low == Fraction(1, 2) and grown.high > grown.low
    assert scene.widest((1, 1, 1), (6, 6, 6), seconds=0).undecided
    with pytest.raises(nef.InputError, match="growth"):
        scene.widest((1, 1, 1), (6, 6, 6), growth="ball")
    with pytest.raises(nef.InputError, match="max_cells"):
        scene.widest((1, 1, 1), (6, 6, 6), max_cells=7)
    with pytest.raises(nef.InputError, match="precision"):
        scene.widest((1, 1, 1), (6, 6, 6), precision=0)


def test_wrong_types_say_what_to_write(needs):
    planner = needs("planner")
    a = nef.box((0, 0, 0), (1, 1, 1))
    with pytest.raises(TypeError, match=r"write \[obstacle\] for one"):
        planner.Scene(a, a)
    with pytest.raises(TypeError, match="True .allow. or False .forbid., not 'forbid'"):
        planner.Scene(a, [a], contact="forbid")
    with pytest.raises(TypeError, match=r"such as Rotation\('z', 0, 360\)"):
        planner.Scene(a, [a], rotation="z")
    with pytest.raises(nef.InputError, match=r"check\(\) takes positions alone"):
        planner.Scene(a, [a]).certify([(0, 0, 0), (7, 0, 0)])
    with pytest.raises(TypeError, match="parts must be a dictionary"):
        planner.disassemble([a, a])
    with pytest.raises(TypeError, match=r"write \[fixed\] for one part"):
        planner.range_of_motion(a, a, planner.Hinge())
    with pytest.raises(TypeError, match=r"write \[obstacle\] for one"):
        planner.Linkage().check([], [], a)


def test_proofs_of_parts_that_cannot_move(needs):
    planner = needs("planner")
    shell = nef.box((0, 0, 0), (3, 3, 3)) - nef.box((1, 1, 1), (2, 2, 2)).interior()
    core = nef.box((1, 1, 1), (2, 2, 2))
    stuck = {"shell": shell, "core": core}
    text = planner.prove_inseparable(stuck)
    assert planner.complaint_about_inseparable(stuck, text) is None
    assert planner.complaint_about_inseparable({"shell": shell, "core": nef.box((1, 1, 1), ("3/2", 2, 2))}, text)
    assert planner.complaint_about_inseparable({"shell": shell, "heart": core}, text)
    with pytest.raises(nef.InputError, match="can begin to move"):
        planner.prove_inseparable({"shell": shell, "core": nef.box((1, 1, 1), ("3/2", 2, 2))})
    with pytest.raises(nef.InputError):
        planner.complaint_about_inseparable(stuck, "{}")
