#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sets the version of the suite everywhere at once: nef/version.h, from which CMake, the programs, the Python package and the Debian
packages have it; recipes of packages and CITATION.cff; and the heading "Unreleased" of CHANGELOG.md. scripts/checks/check_sources.py
finds files that disagree.

Usage: scripts/release/set_version.py 1.0.0 [DATE]      DATE: of the release, today if it is left out
"""
import datetime
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# Where the version stands: the file, and a pattern whose group is the version.
PLACES = {
    "nef/version.h": r'#define NEF_VERSION "(.*)"',
    "packaging/vcpkg/vcpkg.json": r'"version-semver": "(.*)"',
    "packaging/conda/recipe.yaml": r'  version: "(.*)"',
    "CITATION.cff": r'^version: "(.*)"',
}


def version_in(name: str) -> str:
    """The version that a file names; "" if it names none."""
    found = re.search(PLACES[name], (ROOT / name).read_text(encoding="utf-8"), re.MULTILINE)
    return found.group(1) if found else ""


def replaced(name: str, pattern: str, value: str) -> None:
    """Puts `value` in place of the group of the first match."""
    path = ROOT / name
    text = path.read_text(encoding="utf-8")
    found = re.search(pattern, text, re.MULTILINE)
    if not found:
        sys.exit(f"set_version.py: {name}: nothing matches {pattern}")
    path.write_text(text[:found.start(1)] + value + text[found.end(1):], encoding="utf-8")


def main() -> int:
    if len(sys.argv) not in (2, 3) or not re.fullmatch(r"\d+\.\d+\.\d+", sys.argv[1]):
        print(__doc__, file=sys.stderr)
        return 2
    version = sys.argv[1]
    date = sys.argv[2] if len(sys.argv) == 3 else datetime.date.today().isoformat()
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    if not re.search(rf"^## {re.escape(version)}\b", changes, re.MULTILINE):
        replaced("CHANGELOG.md", r"^## (Unreleased)$", f"{version} ({date})")
    for name, pattern in PLACES.items():
        replaced(name, pattern, version)
    replaced("CITATION.cff", r"^date-released: (.*)$", date)
    print(f"version {version}; commit this, then run scripts/release/release.sh")
    return 0


if __name__ == "__main__":
    sys.exit(main())
