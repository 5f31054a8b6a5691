#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the pages name files that exist: every path in backticks that begins with a folder of the repository, and every
relative link. Prints what does not hold; exits 1 if anything does not.

Usage: scripts/check_sources.py
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["nef", "apps", "python", "tests", "fuzz", "bench", "scripts", "docs", "data", ".ci"]
PATH = re.compile(rf"`((?:{'|'.join(FOLDERS)})/[\w./*-]+)`")
LINK = re.compile(r"\]\(([\w./-]+)(?:#[\w-]*)?\)")
CODE = re.compile(r"^```.*?^```|^ {4}.*?$", re.MULTILINE | re.DOTALL)

# Paths that stand for others.
PLACEHOLDERS = {"tests/NAME"}


def pages() -> list[pathlib.Path]:
    inside = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.md"))]
    return sorted(ROOT.glob("*.md")) + inside


def dead_paths(page: pathlib.Path) -> list[str]:
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    dead = [name for name in PATH.findall(text) if name not in PLACEHOLDERS and not any(ROOT.glob(name.rstrip("/")))]
    dead += [link for link in LINK.findall(re.sub(r"`[^`]*`", "", text)) if not (page.parent / link).exists()]
    return [f"{page.relative_to(ROOT)} names {name}, which does not exist" for name in dead]


def main() -> int:
    complaints = [line for page in pages() for line in dead_paths(page)]
    print("\n".join(complaints), end="\n" if complaints else "")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
