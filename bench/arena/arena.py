#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs engines that speak the protocol of solidean/boolean-benchmark-runners on the same cases, and prints one table.

  bench/arena/arena.py [--engine NAME=COMMAND ...] [--work FOLDER] [--timeout 300] [CASE ...]

An engine is a program that takes --request FILE --result FILE; without --engine it is build/release/bin/nef_arena_runner.
Each case is a request of its own, in a process of its own. Cases ask for one thing each that engines claim:

  exact    A - B and A * B together are A: nothing is left of the differences of the two
  iterate  a plate is milled by a ball in 60 steps, each applied to the result of the one before
  touch    cubes that have faces, edges and corners in common, united and cut
  self     a mesh that crosses itself is united with itself: 1500 tetrahedra, and 15 bumpy spheres
  large    two bumpy spheres of 79,600 triangles: union, intersection, difference
  many     500 boxes united in one operation

Columns: the sum of import_ms, of operation_ms, the last export_ms, and the volume of the last file, beside the one that it must
have where that is known. A volume is computed from the file in doubles, so it is within about 1e-9 of what is written there.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))
import mesh_rows  # pylint: disable=wrong-import-position


def read_mesh(path):
    """Of OFF or OBJ, which engines write."""
    lines = [line.split("#")[0] for line in pathlib.Path(path).read_text(encoding="ascii").splitlines()]
    if pathlib.Path(path).suffix == ".obj":
        rows = [line.split() for line in lines]
        vertices = [[float(x) for x in row[1:4]] for row in rows if row[:1] == ["v"]]
        return vertices, [[int(word.split("/")[0]) - 1 for word in row[1:]] for row in rows if row[:1] == ["f"]]
    numbers = iter(" ".join(lines).split()[1:])
    vertex_count, face_count, _ = (int(next(numbers)) for _ in range(3))
    vertices = [[float(next(numbers)) for _ in range(3)] for _ in range(vertex_count)]
    return vertices, [[int(next(numbers)) for _ in range(int(next(numbers)))] for _ in range(face_count)]


def volume(path):
    """Of the solid that a closed mesh bounds."""
    vertices, faces = read_mesh(path)
    terms = []
    for face in faces:
        a = vertices[face[0]]
        for b, c in zip(face[1:], face[2:]):
            b, c = vertices[b], vertices[c]
            terms.append(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                         + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return math.fsum(terms) / 6


def box(low, high):
    vertices = [[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return vertices, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def ball(centre, radius):
    vertices, faces = mesh_rows.bumpy(16, 24, (0, 0, 0))
    return [[radius * x + c for x, c in zip(v, centre)] for v in vertices], faces


class Case:
    """Operations on meshes that are written to a folder; `volume` is what the last result must have, if that is known."""

    def __init__(self, folder):
        self.folder = folder
        self.operations = []
        self.volume = None

    def load(self, mesh):
        path = self.folder / f"mesh_{len(self.operations)}.off"
        mesh_rows.write_off(path, mesh, 17)
        return self.add({"op": "load-mesh", "path": str(path), "name": path.name})

    def apply(self, name, *arguments):
        return self.add({"op": f"boolean-{name}", "args": list(arguments)})

    def add(self, operation):
        self.operations.append(operation)
        return len(self.operations) - 1


def exact(case):
    a, b = case.load(mesh_rows.bumpy(40, 60, (0, 0, 0))), case.load(mesh_rows.bumpy(40, 60, (.3, .17, .11)))
    both = case.apply("union", case.apply("difference", a, b), case.apply("intersection", a, b))
    case.apply("union", case.apply("difference", a, both), case.apply("difference", both, a))
    case.volume = 0


def iterate(case):
    part = case.load(box((0, 0, 0), (10, 10, 2)))
    for step in range(60):
        tool = case.load(ball((1 + 8 * (step % 8) / 7, 1 + 8 * (step // 8) / 7, 2.1), .8))
        part = case.apply("difference", part, tool)


def touch(case):
    cubes = [case.load(box(low, [x + 1 for x in low])) for low in ((0, 0, 0), (1, 0, 0), (2, 1, 0), (3, 2, 1))]
    bar = case.load(box((0, 0, 0), (4, 1, .5)))
    united = cubes[0]
    for cube in cubes[1:]:
        united = case.apply("union", united, cube)
    case.apply("difference", united, bar)
    case.volume = 3


def itself(case):
    for mesh in (mesh_rows.tetrahedra(1500), mesh_rows.spheres()):
        case.apply("union", case.load(mesh))


def large(case):
    a, b = case.load(mesh_rows.bumpy(200, 200, (0, 0, 0))), case.load(mesh_rows.bumpy(200, 200, (.3, .17, .11)))
    for name in ("union", "intersection", "difference"):
        case.apply(name, a, b)


def many(case):
    dice = random.Random(3)
    boxes = []
    for _ in range(500):
        low = [dice.randrange(0, 60) for _ in range(3)]
        boxes.append((low, [x + dice.randrange(1, 12) for x in low]))
    case.apply("union", *[case.load(box(*b)) for b in boxes])
    inside = {(x, y, z) for low, high in boxes for x in range(low[0], high[0]) for y in range(low[1], high[1])
              for z in range(low[2], high[2])}
    case.volume = len(inside)


CASES = {"exact": exact, "iterate": iterate, "touch": touch, "self": itself, "large": large, "many": many}


def ask(command, case, folder, timeout):
    """The result of the one run, or a problem."""
    out = folder / "out"
    out.mkdir(parents=True, exist_ok=True)
    request, result = folder / "request.json", folder / "result.json"
    request.write_text(json.dumps({
        "kind": "boolean-benchmark", "version": 1, "id": case.folder.name, "system_snapshot": {},
        "runs": [{"case_id": case.folder.name, "out_dir": str(out), "bounding_box": {"min": [-10] * 3, "max": [80] * 3},
                  "operations": case.operations}]}), encoding="ascii")
    try:
        subprocess.run(command.split() + ["--request", str(request), "--result", str(result)], timeout=timeout, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        run = json.loads(result.read_text(encoding="utf-8"))["runs"][0]
    except subprocess.TimeoutExpired:
        return None, f"over {timeout} s"
    except (OSError, ValueError, IndexError, KeyError):
        return None, "no result"
    if run["status"] != "success":
        return None, run["status"] + ": " + run["ops"][-1].get("error", "")[:60]
    return run, ""


def row(name, run, case):
    sums = {key: sum(op.get(key, 0) for op in run["ops"]) for key in ("import_ms", "operation_ms")}
    found = volume(run["ops"][-1]["file"])
    wanted = "" if case.volume is None else f"   must be {case.volume:.9g}"
    wrong = case.volume is not None and abs(found - case.volume) > 1e-9 * max(1, case.volume)
    print(f"  {name:20} {sums['import_ms']:10.1f} {sums['operation_ms']:10.1f} {run['ops'][-1].get('export_ms', 0):10.1f} "
          f"  {found:.9g}{wanted}{'   WRONG' if wrong else ''}", flush=True)
    return not wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--engine", action="append", default=[], help="NAME=COMMAND")
    parser.add_argument("--work", type=pathlib.Path)
    parser.add_argument("--timeout", type=float, default=300)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"of {', '.join(CASES)}; all by default")
    options = parser.parse_args()
    unknown = set(options.cases) - set(CASES)
    if unknown:
        parser.error(f"no such case: {', '.join(sorted(unknown))}; there are {', '.join(CASES)}")
    engines = dict(word.split("=", 1) for word in options.engine) or {"nef": str(ROOT / "build/release/bin/nef_arena_runner")}
    good = True
    with tempfile.TemporaryDirectory() as temporary:
        work = (options.work or pathlib.Path(temporary)).resolve()
        for name in options.cases or CASES:
            folder = work / name
            folder.mkdir(parents=True, exist_ok=True)
            case = Case(folder)
            CASES[name](case)
            print(f"{name}: {len(case.operations)} operations\n  {'engine':20} {'import ms':>10} {'operate ms':>10} {'export ms':>10} "
                  "  volume of the last file")
            for engine, command in engines.items():
                run, problem = ask(command, case, folder / engine, options.timeout)
                if run is None:
                    print(f"  {engine:20} {problem}", flush=True)
                    good = good and engine != "nef"
                else:
                    good = row(engine, run, case) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
