#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which sources have no test of their own: none of their name (overlay.cpp: overlay.cpp, overlay_test.cpp or
test_overlay.py, below the application's folder of tests for a source of an application), and none that includes their
header. Other tests reach them through what they are part of. Prints these sources and their number.

Usage: scripts/checks/untested_sources.py [--count]
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
APPS = sorted(path.name for path in (ROOT / "apps").iterdir() if path.is_dir())
INCLUDE = re.compile(r'^#include "((?:nef|apps)/[^"]+)"', re.MULTILINE)


def tests() -> list[pathlib.Path]:
    found = [path for kind in ("*.cpp", "*.h", "*.mjs") for path in (ROOT / "tests").rglob(kind)]
    return sorted(found) + sorted((ROOT / "python/tests").rglob("*.py"))


def owner(test: pathlib.Path) -> str:
    """The application that a test is about, "nef" for the core, "" for all."""
    parts = test.relative_to(ROOT).parts
    if parts[0] == "python":
        return ""
    return parts[1] if parts[1] in APPS else "nef"


def main() -> int:
    named = set()
    included = set()
    for test in tests():
        named.add((owner(test), re.sub(r"^test_|_test$", "", test.stem)))
        included.update(INCLUDE.findall(test.read_text(encoding="utf-8")))
    sources = sorted(path.relative_to(ROOT) for folder in ("nef", "apps") for path in (ROOT / folder).rglob("*.cpp"))
    bare = []
    for source in sources:
        about = source.parts[1] if source.parts[0] == "apps" and source.parts[1] != "nef" else "nef"
        if not {(about, source.stem), ("", source.stem)} & named and str(source.with_suffix(".h")) not in included:
            bare.append(source)
    if "--count" not in sys.argv:
        print("\n".join(map(str, bare)))
    print(f"{len(bare)} of {len(sources)} sources have no test of their own")
    return 0


if __name__ == "__main__":
    sys.exit(main())
