#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether every folder includes only what docs/architecture.md allows it to: of the core, folders before it in the list
below; of the applications, the core and the applications that they are built on; and whether no folder has more modules
than one takes in at a glance. Prints what breaks that; exits 1 if anything does.

Usage: scripts/checks/check_includes.py
"""
import collections
import pathlib
import re
import sys

# The order of docs/architecture.md. A folder may include those before it, and itself.
CORE = [
    "base", "number", "geometry", "sphere_map", "complex", "location", "synthesis", "boolean", "query", "mesh",
    "construct", "operation", "import", "export", "validation", "distance", "parts", "io", "tiles",
]
# The public face stands between the folders that make it and those that use it.
FACE = "polyhedron.h", "labeled_polyhedron.h"
SHARED = {"program", "remeshing", "view"}  # what programs share
APPS = {"program": set(), "remeshing": set(), "view": set(), "minkowski": SHARED, "nef": SHARED | {"minkowski"},
        "visual_hull": SHARED, "planner": SHARED | {"minkowski"},
        "studio": SHARED | {"minkowski", "planner", "visual_hull"}, "nef_mpi": SHARED | {"minkowski", "visual_hull"}}

MOST_MODULES = 13  # a dozen, and one
FOLDERS = ["nef", "apps", "python", "tests", "fuzz", "bench", "scripts", "cmake"]

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
INCLUDE = re.compile(r'^#include "((?:nef|apps|tests|fuzz|bench|python)/[^"]+)"', re.MULTILINE)


def allowed(source: pathlib.PurePath, target: pathlib.PurePath) -> bool:
    if source.parts[0] not in ("nef", "apps"):
        return True
    if target.parts[0] not in ("nef", "apps"):
        return False
    if source.parts[0] == "apps":
        return target.parts[0] == "nef" or target.parts[1] in APPS[source.parts[1]] | {source.parts[1]}
    if target.parts[0] == "apps":
        return False
    if len(source.parts) == 2 or len(target.parts) == 2:
        return True  # the public face
    return CORE.index(target.parts[1]) <= CORE.index(source.parts[1])


def crowded_folders() -> list[str]:
    """Folders with more than MOST_MODULES modules; a header, its source and scripts of one name are one."""
    modules = collections.defaultdict(set)
    for folder in FOLDERS:
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in (".h", ".cpp", ".js", ".mjs", ".py", ".sh") and "__pycache__" not in path.parts:
                modules[path.parent.relative_to(ROOT)].add(path.stem)
    return [f"{folder} has {len(names)} modules; put what belongs together into a folder of its own"
            for folder, names in sorted(modules.items()) if len(names) > MOST_MODULES]


def main() -> int:
    crowded = crowded_folders()
    for line in crowded:
        print(line)
    broken = len(crowded)
    for folder in ("nef", "apps"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            source = path.relative_to(ROOT)
            for target in INCLUDE.findall(path.read_text(encoding="utf-8")):
                if not allowed(source, pathlib.PurePath(target)):
                    print(f"{source} includes {target}, which docs/architecture.md does not allow")
                    broken += 1
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
