#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that fuzz/formats.cpp and the table of mesh formats feed every reader of files. Prints those that it does not; exits 1 if there are any.

A reader is a function read_*, parse_* or evaluate_* that a header of the folders below declares. It is fuzzed if the text of
one of these names it, or if a function that is fuzzed calls it: those have an entry in THROUGH, which says which one.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDERS = ["nef/io", "nef/io/mesh", "nef/io/mesh/formats", "nef/io/native", "nef/io/cgal", "apps/program/expression", "apps/program", "apps/program/reports", "apps/nef/command/apply",
           "apps/visual_hull/formats", "apps/planner/scene", "apps/planner/path",
           "apps/planner/proofs", "apps/planner/rigid", "apps/planner/linkage_urdf"]

# What the fuzzer takes its readers from: its own list, and the table of mesh formats.
FUZZED = ["fuzz/formats.cpp", "nef/io/mesh/mesh_formats.cpp"]

# Readers that another one calls, and what reads no format of its own.
THROUGH = {
    "read_mesh": "read_off and the other formats, which it chooses from",
    "read_native_binary": "read_native",
    "read_polyhedron": "read_native, read_nef3 and read_off, which it chooses from",
    "read_file": "no format",
    "read_blocks": "no format",
    "read_with_limits": "no format",
    "read_shape_file": "read_polyhedron and read_with_assimp",
    "read_with_assimp": "a library's parsers, in a process with limits",
    "read_cfg": "planner::read_scene",
    "parse_cfg": "planner::read_scene",
    "parse_number": "every text format",
    "parse_openscad": "evaluate_openscad",
    "parse_expression": "evaluate_expression",
    "parse_exact_json": "parse_scene",
    "parse_numbers": "words of the command line",
    "parse_lines": "read_path, which it reads for",
    "parse_triple": "words of the command line",
    "parse_plane": "words of the command line",
    "parse_steps": "evaluate_expression, a line each",
    "read_polygons": "read_json_scene, whose rings it reads",
    "read_queries": "parse_exact_json",
    "read_camera_folder": "read_text_scene, a file each",
    "read_rotations": "parse_proof",
    "read_layers": "parse_proof",
    "read_pose_cells": "parse_proof",
    "read_transforms": "read_json_scene",
}


def readers():
    for folder in FOLDERS:
        for header in sorted((ROOT / folder).glob("*.h")):
            for name in re.findall(r"^[A-Za-z][\w:<>, ]* ((?:read|parse|evaluate)_\w+)\(", header.read_text(), re.M):
                yield header, name


def main():
    fuzzed = "".join((ROOT / name).read_text() for name in FUZZED)
    complaints = []
    known = set()
    for header, name in readers():
        known.add(name)
        called = re.search(rf"\b{name}\b", fuzzed) is not None
        if not called and name not in THROUGH:
            complaints.append(f"{header.relative_to(ROOT)}: {name} is not fuzzed; add its format to fuzz/formats.cpp")
    complaints += [f"there is no reader {name}; take it from {sys.argv[0]}" for name in set(THROUGH) - known
                   if name != "read_with_limits"]
    print("\n".join(complaints))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
