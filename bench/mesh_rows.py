#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What meshes that cross themselves cost: each row is generated, read by `nef info --crossings union`, and measured.

  bench/mesh_rows.py [--nef build/release/bin/nef] [--cgal build/release/bin/nef_bench_autorefine] [--passes 3]
                     [--keep FOLDER] [MESH ...]

Rows: two cylinders of 1457 sides that touch along a strip (slender triangles, few contacts); 5000 random tetrahedra in one mesh; 15 bumpy
spheres of 6720 triangles that overlap; one of 99,856 triangles with two small spikes that cross each other; and any MESH that is given. Columns: pairs of faces that cross, seconds
of reading (`load_s` of the report), CPU seconds and megabytes of the run: the best of the passes. Generated meshes stand for
models that are not shipped; --keep writes them. Coordinates have seven digits, as scans in single precision do; with --digits 17
they have all that doubles have, and planes are longer. With --cgal (target nef_bench_autorefine, where CGAL is installed) two more columns:
CPU seconds of its autorefine_and_remove_self_intersections on the mesh that is already read, in turn with ours, and reading by ours over that.
"""
import argparse
import json
import math
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile


def cylinders(sides=1457):
    vertices, faces = [], []
    for x, y in ((0, 0), (1.99, 0.013)):
        first = len(vertices)
        for k in range(sides):
            a = 2 * math.pi * k / sides
            vertices += [(x + math.cos(a), y + math.sin(a), x / 9), (x + math.cos(a), y + math.sin(a), 5 + x / 7)]
        low, high = len(vertices), len(vertices) + 1
        vertices += [(x, y, x / 9), (x, y, 5 + x / 7)]
        for k in range(sides):
            a, b = first + 2 * k, first + 2 * ((k + 1) % sides)
            faces += [(a, b, b + 1), (a, b + 1, a + 1), (low, b, a), (high, a + 1, b + 1)]
    return vertices, faces


def tetrahedra(count=5000):
    dice = random.Random(5)
    vertices, faces = [], []
    for _ in range(count):
        centre = [dice.uniform(0, 10) for _ in range(3)]
        corners = [[c + dice.uniform(-.35, .35) for c in centre] for _ in range(4)]
        u, v, w = ([corners[i][k] - corners[0][k] for k in range(3)] for i in (1, 2, 3))
        volume = sum(u[i] * (v[(i + 1) % 3] * w[(i + 2) % 3] - v[(i + 2) % 3] * w[(i + 1) % 3]) for i in range(3))
        if volume < 0:
            corners[2], corners[3] = corners[3], corners[2]
        first = len(vertices)
        vertices += corners
        faces += [tuple(first + i for i in f) for f in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))]
    return vertices, faces


def bumpy(rings, columns, centre, spikes=False):
    """A sphere of 2 columns (rings - 1) triangles with bumps; two of its vertices may reach through the surface."""
    vertices = [(0, 0, -1), (0, 0, 1)]
    for i in range(1, rings):
        for k in range(columns):
            t, p = math.pi * i / rings, 2 * math.pi * k / columns
            r = 1 + .05 * math.sin(5 * p) * math.sin(4 * t) + .01 * math.sin(31 * p + 17 * t)
            vertices.append((r * math.sin(t) * math.cos(p), r * math.sin(t) * math.sin(p), -r * math.cos(t)))
    at = lambda i, k: 2 + (i - 1) * columns + k % columns
    if spikes:
        for k, to, height in ((7, 11, 1.02), (8, 5, 1.01)):
            vertices[at(rings // 2, k)] = tuple(height * x for x in vertices[at(rings // 2, to)])
    faces = []
    for k in range(columns):
        faces += [(0, at(1, k + 1), at(1, k)), (1, at(rings - 1, k), at(rings - 1, k + 1))]
        for i in range(1, rings - 1):
            a, b, c, d = at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)
            faces += [(a, b, c), (a, c, d)]
    return [tuple(x + c for x, c in zip(v, centre)) for v in vertices], faces


def spheres(count=15):
    vertices, faces = [], []
    for i in range(count):
        first = len(vertices)
        more, those = bumpy(57, 60, (1.4 * i, .31 * (i % 3), .17 * (i % 2)))
        vertices += more
        faces += [tuple(v + first for v in f) for f in those]
    return vertices, faces


def write_off(path, mesh, digits):
    vertices, faces = mesh
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [" ".join(f"{x:.{digits}g}" for x in v) for v in vertices]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces]
    path.write_text("\n".join(lines) + "\n")


def measure(nef, path, passes):
    best = None
    for _ in range(passes):
        run = subprocess.run(["/usr/bin/time", "-f", "%U %S %M", nef, "info", str(path), "--json", "--crossings", "union",
                              "--threads", "1"], capture_output=True, text=True, check=False)
        if run.returncode != 0:
            return None
        user, system, kilobytes = run.stderr.split()[-3:]
        seconds = float(user) + float(system)
        load = json.loads(run.stdout)["phases"]["load_s"]
        pairs = re.search(r"(\d+) pairs? of faces cross", run.stderr)
        row = (load, seconds, int(kilobytes) / 1024, int(pairs.group(1)) if pairs else 0)
        best = row if best is None else min(best, row)
    return best


def autorefine(program, path, passes):
    """CPU seconds of CGAL, the best of the passes, or why there are none."""
    best = None
    for _ in range(passes):
        try:
            run = subprocess.run([program, str(path)], capture_output=True, text=True, check=False, timeout=600)
        except subprocess.TimeoutExpired:
            return "over 600 s"
        if run.returncode != 0:
            return "refused" if run.returncode > 0 else "crashed"
        seconds = json.loads(run.stdout)["seconds"]
        best = seconds if best is None else min(best, seconds)
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", type=pathlib.Path)
    parser.add_argument("--nef", default="build/release/bin/nef")
    parser.add_argument("--cgal", type=pathlib.Path, help="nef_bench_autorefine")
    parser.add_argument("--passes", type=int, default=3)
    parser.add_argument("--digits", type=int, default=7, help="of coordinates")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the generated meshes there")
    options = parser.parse_args()
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    made = {"slender": cylinders, "tetrahedra": tetrahedra, "spheres": spheres,
            "spikes": lambda: bumpy(159, 316, (0, 0, 0), True)}
    with tempfile.TemporaryDirectory() as folder:
        folder = options.keep or pathlib.Path(folder)
        paths = []
        for name, make in made.items():
            paths.append(folder / f"{name}.off")
            write_off(paths[-1], make(), options.digits)
        print(f"{'mesh':30}{'pairs':>8}{'load s':>9}{'CPU s':>9}{'MB':>7}" + (f"{'CGAL s':>12}{'ratio':>8}" if options.cgal else ""))
        for path in paths + options.meshes:
            row = measure(options.nef, path, options.passes)
            if row is None:
                print(f"{path.stem:30} refused")
            else:
                line = f"{path.stem:30}{row[3]:8}{row[0]:9.3f}{row[1]:9.2f}{row[2]:7.0f}"
                if options.cgal:
                    peer = autorefine(options.cgal, path, options.passes)
                    line += f"{peer:12.3f}{row[0] / peer:8.2f}" if isinstance(peer, float) else f"{peer:>12}"
                print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
