#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Proofs that the planner writes, replayed by python/proofs/check.py: all hold; thousands of copies with one thing changed
do not, or prove the same claim; and the planner says the same of each.

Usage: replay_test.py PLANNER CHECK_PY WORK_DIRECTORY [TEST ...]
"""
import copy
import importlib.util
import json
import operator
import os
import random
import re
import subprocess
import sys
import unittest
from fractions import Fraction

PLANNER, CHECKER, WORK = sys.argv[1:4]
SEEDS = int(os.environ.get("PLANNER_SEEDS", "1"))  # 3 in .ci/run: more than ten thousand changes

spec = importlib.util.spec_from_file_location("check", CHECKER)
check = importlib.util.module_from_spec(spec)
spec.loader.exec_module(check)

SLOT = {"robot": "box(-2,-1/4,-1/2, 2,1/4,1/2)", "obstacles": ["box(-6,4,-6, 6,5,6) - box(-3,4,-1/2, 3,5,1/2)"],
        "start": [0, 0, 0], "goal": [0, 9, 0]}
SHEET = {"robot": "hull(-1,-1,-1, 1,0,0, 0,1,0, 0,0,1)", "obstacles": ["polygon((-3,3,-3),(3,3,-3),(3,3,3),(-3,3,3))"],
         "box": [[-4, -4, -4], [4, 6, 4]]}

NARROW = {"robot": "box(0,0,0, 1,1,1)", "obstacles": ["box(4,0,0, 5,3,3) - box(4,1,1, 5,2,19/10)"],
          "box": [[0, 0, 0], [8, 2, 2]], "start": [1, 1, 1], "goal": [7, 1, 1]}

# A hole as wide as the robot, one as high, one between an obstacle and a side of the box, and a place of its own.
TIGHT = {"robot": "box(0,0,0, 1,1,1)", "box": [[0, 0, 0], [20, 8, 8]],
         "obstacles": ["box(4,0,0, 6,9,9) - box(3,3,3, 7,4,4)", "box(9,0,0, 10,9,9) - box(8,2,5, 11,6,6)",
                       "box(13,0,0, 14,9,8) - box(13,0,0, 14,2,2) + box(13,1,0, 14,2,2)",
                       "box(15,3,3, 18,6,6) - box(16,4,4, 17,5,5)"]}
BOXED = {"parts": {"box": "box(0,0,0, 3,3,3) - box(1,1,1, 2,2,2)", "cube": "box(1,1,1, 2,2,2)"}}
WEDGED = {"parts": {"mould": "box(-1,-1,-1, 4,4,4) - hull(0,0,0, 3,0,0, 0,3,0, 0,0,3)",
                    "left": "hull(0,0,0, 1,0,0, 0,3,0, 0,0,3)", "right": "hull(1,0,0, 3,0,0, 0,3,0, 0,0,3)"}}

WINDOW = {"robot": "box(-1/2,-1/2,-1/2, 1/2,1/2,1/2)", "obstacles": ["box(-1/2,-4,-4, 1/2,4,4) - box(-1,-1/16,-1/16, 1,1/16,1/16)"],
          "box": [[-3, -3, -3], [3, 3, 3]], "start": {"position": [-2, 0, 0], "quaternion": [1, 0, 0, 0]},
          "goal": {"position": [2, 0, 0], "quaternion": [1, 2, 0, 0]}, "rotation": "SO(3)"}
# A hole nearly as wide as the cube: points that both have in common drift.
SNUG = dict(WINDOW, obstacles=["box(-1/4,-4,-4, 1/4,4,4) - box(-1,-19/40,-19/40, 1,19/40,19/40)"])
CORNER = {"robot": "box(-3,-1/2,0, 3,1/2,1)", "rotation": {"range": [0, 90]},
          "obstacles": ["box(-20,-20,-1, 20,20,2) - interior(box(-20,-2,-2, 0,0,3)) - interior(box(-2,-2,-2, 0,20,3))"],
          "box": [[-15, -15, 0], [15, 15, 0]], "start": [-12, -1, 0, 0], "goal": [-1, 12, 0, 90]}

# The bar cannot turn round, although its middle may be anywhere; nor can it by a full turn in a range of two.
TUBE = {"robot": "box(-2,-1/2,-1/2, 2,1/2,1/2)", "obstacles": ["box(-9,-4,-4, 9,4,4) - box(-6,-1,-1, 6,1,1)"],
        "rotation": {"range": [0, 180]}, "start": [-3, 0, 0, 0], "goal": [-3, 0, 0, 180]}
WOUND = dict(TUBE, rotation={"range": [0, 450]}, goal=[-3, 0, 0, 360])

# A name, a scene or an assembly, a path (or none: it is looked for), what is proved.
CASES = [
    ("turning", SLOT, "0 0 0 0 0 1 1\n0 1 0 0 0 0 1\n0 9 0 0 0 0 1\n0 12 0 1 0 2 2\n", "path: all 3 motions are free"),
    ("tilted", SLOT, "0 0 0 1 0 0 9\n0 9 0 1 0 2 9\n", "blocked: motion 0"),
    ("found", SLOT, None, "path: all"),
    ("sheet", SHEET, "0 0 0 0 0 1 3\n0 5 0 0 0 0 1\n", "blocked: motion 0"),
    ("outside", SHEET, "0 0 0 0 0 1 3\n0 0 9 0 0 0 1\n", "blocked: pose 1 is outside"),
    ("narrower", NARROW, None, "infeasible: "),
    ("window", WINDOW, None, "infeasible: "),
    ("snug", SNUG, None, "infeasible: "),
    ("corner", CORNER, None, "infeasible: "),
    ("tube", TUBE, None, "infeasible: "),
    ("wound", WOUND, None, "infeasible: "),
    ("tight", TIGHT, None, "tight: 6 passages"),
    ("boxed", BOXED, None, "inseparable: no set of 2 parts"),
    ("wedged", WEDGED, None, "inseparable: no set of 2 parts"),
    ("apart", dict(SHEET, contact="forbid"), "0 0 0 0 0 1 3\n2 1 1 1 2 -1 3\n", "path: all 1 motions are free"),
]
# Proofs whose checks take a twentieth of a second and more.
TAMPERED = {"tight": 100, "narrower": 130, "boxed": 50, "wedged": 50, "window": 4, "snug": 2, "corner": 7, "tube": 4, "wound": 4}
TAMPERED_OTHERS = 600  # of each other one

# What may change in a proof that still holds: it has other numbers that show the same.
IRRELEVANT = re.compile(r"/witness/(motions/\d+(/\d+(/planes(/\d+(/(normal|robot|obstacle)(/\d)?)?)?|/until)?)?|collision/times(/\d)?|barrier/points(/\d+(/\d)?)?|"
                        r"barrier/triangles(/\d+(/corners(/\d)?|/robot|/obstacle)?)?|"
                        r"places(/\d+(/(planes(/\d+(/(normal|robot|obstacle)(/\d)?)?)?|contacts(/\d+(/(robot|obstacle))?)?|octants(/.*)?))?)?|"
                        r"contacts(/\d+(/(first|second)(/\d)?)?)?|octants(/.*)?|cells(/.*)?|layers(/.*)?)$")


def planner(*arguments):
    return subprocess.run([PLANNER, *arguments], capture_output=True, text=True, check=False)


def places(value, where=()):
    """The addresses of all values below one, each as a tuple of keys."""
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, entry in entries:
        yield *where, key
        yield from places(entry, (*where, key))


def other(chance, value):
    """Another value of the same kind."""
    if isinstance(value, bool) or value is None:
        return chance.choice(["0", {}, []])
    if isinstance(value, int):
        return chance.choice([value + 1, value - 1, -1, 0, 10 ** 12, str(value), float(value)])
    if isinstance(value, str):
        try:
            number = Fraction(value)
        except ValueError:
            return chance.choice([word for word in ("path", "blocked", "allow", "forbid", "") if word != value])
        return chance.choice([str(number + Fraction(1, chance.randint(1, 10 ** 6))), str(-number), "0", "1", float(number),
                              str(number * Fraction(1001, 1000)), value + "/0", "nan"])
    return chance.choice([[], {}, None, "0"])


def address(place):
    return "".join(f"/{key}" for key in place)


def at(value, place):
    """The value at an address."""
    for key in place:
        value = value[key]
    return value


def changed_at(value, place, change):
    """A copy of a value that has a copy of the object or list at an address instead, changed; the rest is shared."""
    result = copy.copy(value)
    if place:
        result[place[0]] = changed_at(value[place[0]], place[1:], change)
    else:
        change(result)
    return result


def tampered(chance, proof, all_places):
    """A copy with one value changed, dropped, written twice or exchanged with another one; and where. `all_places`: places of
    the proof."""
    place = chance.choice(all_places)
    *above, key = place
    value, kind = at(proof, place), chance.randrange(4)
    if kind == 0:
        changed = other(chance, value)
        return changed_at(proof, above, lambda parent: operator.setitem(parent, key, changed)), [address(place)]
    if kind == 1:
        return changed_at(proof, above, lambda parent: operator.delitem(parent, key)), [address(place)]
    if kind == 2 and isinstance(at(proof, above), list):
        return changed_at(proof, above, lambda parent: parent.insert(key, value)), [address(place)]
    elsewhere = chance.choice(all_places)
    if elsewhere[:len(place)] == place or place[:len(elsewhere)] == elsewhere:
        return proof, [address(place)]
    result = changed_at(proof, above, lambda parent: operator.setitem(parent, key, at(proof, elsewhere)))
    *above, key = elsewhere
    return changed_at(result, above, lambda parent: operator.setitem(parent, key, value)), [address(place), address(elsewhere)]


class Replay(unittest.TestCase):
    def setUp(self):
        os.makedirs(WORK, exist_ok=True)

    def file(self, name):
        return os.path.join(WORK, name)

    def write(self, name, text):
        with open(self.file(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.file(name)

    def prove(self, name, scene, path):
        file = self.write(name + ".json", json.dumps(scene))
        arguments = ["--assembly", file] if "parts" in scene else [file]
        if name == "tight":
            arguments.append("--tight")
        if path is not None:
            arguments += ["--path", self.write(name + ".path", path)]
        proof = self.file(name + ".proof")
        run = planner(*arguments, "--proof", proof)
        self.assertIn(run.returncode, (0, 1), run.stderr)
        if name == "tight":
            arguments.remove("--tight")
        with open(proof, encoding="utf-8") as file:
            return arguments, file.read()

    def test_proofs_hold(self):
        for name, scene, path, proved in CASES:
            with self.subTest(name):
                arguments, text = self.prove(name, scene, path)
                said, digest = check.check(text)
                self.assertTrue(said.startswith(proved), said)
                self.assertEqual(check.check(text, digest), (said, digest))
                run = subprocess.run([sys.executable, "-B", CHECKER, self.file(name + ".proof")], capture_output=True,
                                     text=True, check=True)
                self.assertEqual(run.stdout, f"{said}\nclaim {digest}\n")
                self.assertEqual(planner(*arguments, "--check-proof", self.file(name + ".proof")).returncode, 0)

    def test_tampered_proofs_are_refused(self):
        chance = random.Random(5)
        held = 0
        changes = 0
        for name, scene, path, _ in CASES:
            arguments, text = self.prove(name, scene, path)
            _, digest = check.check(text)
            proof = json.loads(text)
            all_places = list(places(proof))
            for _ in range(SEEDS * TAMPERED.get(name, TAMPERED_OTHERS)):
                changes += 1
                changed, where = tampered(chance, proof, all_places)
                if changed == proof:
                    continue
                try:
                    check.check(json.dumps(changed), digest)
                except check.Refused:
                    continue
                held += 1
                self.assertTrue(all(IRRELEVANT.search(address) for address in where), (name, where))
        self.assertGreater(changes, 3_900 * SEEDS)
        self.assertLess(held, changes / 20)

    def test_both_checkers_agree(self):
        chance = random.Random(6)
        for name, scene, path, _ in CASES:
            arguments, text = self.prove(name, scene, path)
            _, digest = check.check(text)
            proof = json.loads(text)
            all_places = list(places(proof))
            for _ in range(8 if name in ("window", "snug", "corner", "tube", "wound") else 40):
                changed, where = tampered(chance, proof, all_places)
                file = self.write("tampered.proof", json.dumps(changed))
                try:
                    check.check(json.dumps(changed), digest)
                    code = [0]
                except check.Refused:
                    code = [1, 2]
                # A vertex may change without the set, which the planner compares, but not the digest of the claim.
                pieces = [re.search("/claim/(robot|obstacles|parts)", address) for address in where]
                if any(pieces) and all(piece or IRRELEVANT.search(address) for piece, address in zip(pieces, where)):
                    code = [0, 1, 2]
                run = planner(*arguments, "--check-proof", file)
                self.assertIn(run.returncode, code, (name, where, run.stdout, run.stderr))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + [f"Replay.{name}" for name in sys.argv[4:]])
