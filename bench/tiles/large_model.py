#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A lattice of 1000 boxes off a model of ten million triangles, in tiles in files; volumes checked exactly.

Usage: large_model.py [--nef build/release/bin/nef] [--edge 913] [--memory 1G] [--folder DIR] [--threads N]

The model is a cube of 12 * EDGE^2 triangles, blown up to a sphere with bumps; its corners are integers, so that its
volume is a sum of integers, computed here without the program. First the boxes lie wholly inside: what is left must have
the volume of the model minus 1000 times that of a box. Then they lie all over it, some of them across its surface, which is
there to be timed. Prints for each run of the program the seconds on the clock, those of the processors and the peak of
memory; the last line is "volumes: as they must be" (exit code 0) or what differs (1).
"""
import argparse
import fractions
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy

RADIUS = 10**6  # the determinant of three corners fits into 64 bits
LATTICE = 10    # boxes along each axis


def model(edge):
    """Corners (int64) and triangles (int32) of the model."""
    at = numpy.arange(edge + 1, dtype=numpy.int64)
    u, v = (x.ravel() for x in numpy.meshgrid(at, at, indexing="ij"))
    sides = []
    for axis in range(3):
        for end in (0, edge):
            points = numpy.empty((len(u), 3), dtype=numpy.int64)
            points[:, axis] = end
            points[:, (axis + 1) % 3] = u
            points[:, (axis + 2) % 3] = v
            sides.append(points)
    grid = numpy.concatenate(sides)
    keys = (grid[:, 0] * (edge + 1) + grid[:, 1]) * (edge + 1) + grid[:, 2]
    _, first, names = numpy.unique(keys, return_index=True, return_inverse=True)
    names = names.reshape(-1)
    corner = (numpy.arange(edge)[:, None] * (edge + 1) + numpy.arange(edge)[None, :]).ravel()
    quad = numpy.stack([corner, corner + edge + 1, corner + edge + 2, corner + 1], axis=1)
    triangles = []
    for side in range(6):
        q = names[quad + side * len(u)]
        if side % 2 == 0:  # seen from outside
            q = q[:, ::-1]
        triangles += [q[:, [0, 1, 2]], q[:, [0, 2, 3]]]
    direction = numpy.tan((grid[first] / edge - 0.5) * (numpy.pi / 2))
    direction /= numpy.linalg.norm(direction, axis=1)[:, None]
    bumps = numpy.sin(9 * direction[:, 0]) * numpy.sin(11 * direction[:, 1]) * numpy.sin(7 * direction[:, 2])
    corners = numpy.rint(direction * (RADIUS * (0.95 + 0.04 * bumps))[:, None]).astype(numpy.int64)
    return corners, numpy.concatenate(triangles).astype(numpy.int32)


def volume_of(corners, triangles):
    """Exact: a sixth of the sum of determinants."""
    total = 0
    for part in numpy.array_split(triangles, 64):
        a, b, c = (corners[part[:, i]] for i in range(3))
        determinants = (a[:, 0] * (b[:, 1] * c[:, 2] - b[:, 2] * c[:, 1]) + a[:, 1] * (b[:, 2] * c[:, 0] - b[:, 0] * c[:, 2])
                        + a[:, 2] * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]))
        total += (int((determinants >> 32).sum()) << 32) + int((determinants & 0xFFFFFFFF).sum())
    return fractions.Fraction(total, 6)


def write_ply(path, corners, triangles):
    """Binary; integers below 2^24 are exact in 32-bit floating point, too, but these are integers."""
    with open(path, "wb") as file:
        file.write((f"ply\nformat binary_little_endian 1.0\nelement vertex {len(corners)}\nproperty int x\nproperty int y\n"
                    f"property int z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n").encode())
        corners.astype("<i4").tofile(file)
        faces = numpy.empty(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
        faces["count"] = 3
        faces["corners"] = triangles
        faces.tofile(file)


def steps(path, operator, low, high, side):
    """A lattice of boxes between two coordinates."""
    with open(path, "w", encoding="utf-8") as file:
        for i in range(LATTICE**3):
            place = (i // LATTICE**2, i // LATTICE % LATTICE, i % LATTICE)
            corner = [low + (high - side - low) * k // (LATTICE - 1) for k in place]
            file.write(f"{operator} box({','.join(str(x) for x in corner)}, {','.join(str(x + side) for x in corner)})\n")


def run(what, command):
    """Runs the program; prints what that took, and returns what it printed."""
    with tempfile.TemporaryFile() as out:
        start = time.monotonic()
        process = subprocess.Popen([str(word) for word in command], stdout=out)
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.monotonic() - start
        if status != 0:
            sys.exit(f"{' '.join(str(word) for word in command)}: exit status {status}")
        print(f"{what}: {seconds:.1f} s, processors {usage.ru_utime + usage.ru_stime:.1f} s, peak {usage.ru_maxrss / 2**20:.2f} GB",
              flush=True)
        out.seek(0)
        return out.read().decode()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nef", default="build/release/bin/nef")
    parser.add_argument("--edge", type=int, default=913)
    parser.add_argument("--memory", default="1G")
    parser.add_argument("--threads", default="0")
    parser.add_argument("--folder", help="for the files, some gigabytes (default: a new one, removed at the end)")
    arguments = parser.parse_args()
    folder = arguments.folder or tempfile.mkdtemp(prefix="large_model_")
    nef = os.path.abspath(arguments.nef)
    bound = ["--memory", arguments.memory, "--threads", arguments.threads]
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    corners, triangles = model(arguments.edge)
    whole = volume_of(corners, triangles)
    print(f"{len(triangles)} triangles")
    write_ply("model.ply", corners, triangles)
    del corners, triangles

    def volume(name):  # tile by tile
        return fractions.Fraction(json.loads(run(f"volume of {name}", [nef, "info", name, "--json"]))["result"]["volume"])

    run("into tiles", [nef, "convert", "model.ply", "-o", "model.tiles"] + bound)
    wrong = []
    if volume("model.tiles") != whole:
        wrong.append("the model in tiles")
    inside = RADIUS // 2  # the corners of this cube are nearer to the middle than all of the surface
    steps("inside.txt", "-", -inside, inside, inside // 20)
    run("1000 boxes inside", [nef, "apply", "model.tiles", "--steps", "inside.txt", "-o", "holes.tiles"] + bound)
    if volume("holes.tiles") != whole - LATTICE**3 * (inside // 20)**3:
        wrong.append("the model minus boxes inside")
    steps("across.txt", "-", -RADIUS, RADIUS, RADIUS // 11)
    run("1000 boxes across", [nef, "apply", "model.tiles", "--steps", "across.txt", "-o", "rest.tiles"] + bound)
    os.chdir("/")
    if not arguments.folder:
        subprocess.run(["rm", "-rf", folder], check=False)
    print("volumes: " + ("as they must be" if not wrong else "WRONG: " + "; ".join(wrong)))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
