#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether `nef check` accepts what was exported, in every format: Booleans of scans, Minkowski sums and hulls.

Usage: exports.py PROGRAMS DATA WORK      the folders of the programs, of data/ and for files
"""
import itertools
import json
import os
import subprocess
import sys

FORMATS = ["a.off", "a.obj", "a.ply", "a.stl", "a.glb", "a.3mf", "binary.ply", "binary.stl"]


def run(programs: str, program: str, *arguments: str) -> str:
    done = subprocess.run([os.path.join(programs, program), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          check=False, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{program} {' '.join(arguments)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def fitted(programs: str, path: str, turn: str, to: str) -> None:
    """The mesh in a box of size 1 about the origin, turned by an angle that is no nice one."""
    low, high = json.loads(run(programs, "nef", "info", path, "--json"))["result"]["bbox"]
    size = max(h - l for l, h in zip(low, high))
    middle = ",".join(str(-(l + h) / 2) for l, h in zip(low, high))
    run(programs, "nef", "transform", path, "--translate", middle, "--scale", f"1/{size}" if size >= 1 else str(1 / size),
        "--rotate", turn, "-o", to, "-q")


def main() -> int:
    programs, data, work = (os.path.abspath(path) for path in sys.argv[1:4])
    os.makedirs(work, exist_ok=True)
    models = sys.argv[4:] or ["eight.off", "hand.off", "rotor.off", "cross_quad.off"]
    turns = itertools.cycle(["z,17", "1,2,3,41", "x,5", "y,77"])
    solids = []
    for index, (model, turn) in enumerate(zip(models, turns)):
        solids.append(os.path.join(work, f"{index}.nef"))
        fitted(programs, os.path.join(data, "meshes", model), turn, solids[-1])
    results = []
    for (i, a), (k, b) in itertools.combinations(enumerate(solids), 2):
        for operation in ("union", "intersection", "difference", "symdiff"):
            results.append(os.path.join(work, f"{operation}_{i}_{k}.nef"))
            run(programs, "nef", operation, a, b, "-o", results[-1], "-q")
    for name in ("star", "cross_quad"):
        results.append(os.path.join(work, f"sum_{name}.nef"))
        run(programs, "minkowski", os.path.join(data, "meshes", name + ".off"), "--ball", "1/7,2", "-o", results[-1], "-q")
    for index, solid in enumerate(solids):
        results.append(os.path.join(work, f"hull_{index}.nef"))
        run(programs, "minkowski", "--hull", solid, "-o", results[-1], "-q")
    for name in ("eight/eight.json", "elk/elk.json"):
        results.append(os.path.join(work, "visual_" + os.path.basename(name) + ".nef"))
        run(programs, "visual_hull", os.path.join(data, "visual_hull", name), "--simplify", "1", "-o", results[-1], "-q")
    refused = repaired = 0
    for index, result in enumerate(results):
        for name in FORMATS[index % 2 :: 2]:  # every other format, in turn
            path = os.path.join(work, name)
            binary = ["--binary"] if name.startswith("binary") else []
            report = json.loads(run(programs, "nef", "convert", result, "-o", path, "--json", *binary))
            repaired += any("was repaired" in line for line in report.get("messages", []))
            done = subprocess.run([os.path.join(programs, "nef"), "check", path], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, check=False, text=True)
            if done.returncode != 0:
                refused += 1
                print(f"{os.path.basename(result)} as {name}: {done.stdout}{report.get('messages')}")
    print(f"{len(results)} sets, each in half of {len(FORMATS)} formats: {repaired} repaired, {refused} refused")
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
