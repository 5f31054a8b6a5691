#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the section of CHANGELOG.md about a version.

Usage: scripts/release/release_notes.py VERSION [--or-unreleased]: with the option, what is unreleased where the version has no section.
"""
import argparse
import pathlib
import re
import sys


def sections(text: str) -> dict[str, str]:
    """The text below each heading "## NAME", by the first word of NAME."""
    parts = re.split(r"^## (\S+).*$", text, flags=re.MULTILINE)
    return {name: body.strip() for name, body in zip(parts[1::2], parts[2::2])}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("version")
    parser.add_argument("--or-unreleased", action="store_true")
    arguments = parser.parse_args()
    found = sections((pathlib.Path(__file__).resolve().parent.parent.parent / "CHANGELOG.md").read_text(encoding="utf-8"))
    notes = found.get(arguments.version) or (found.get("Unreleased") if arguments.or_unreleased else None)
    if not notes:
        print(f"release_notes.py: CHANGELOG.md has no section '## {arguments.version}'; name the unreleased one so",
              file=sys.stderr)
        return 1
    print(notes)
    return 0


if __name__ == "__main__":
    sys.exit(main())
