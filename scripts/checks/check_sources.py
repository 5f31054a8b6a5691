#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether long sources open with what they do, whether the pages name files that exist (every path in backticks that begins
with a folder of the repository, and every relative link), whether ctest can run every test by its name, whether each
source has a test near it (scripts/tests_of.py), whether all files that name a version name the same, and whether
pages have both versions of a merge. Prints what does not hold; exits 1 if anything does not.

Usage: scripts/checks/check_sources.py [FOLDER]      with FOLDER only the links of the pages in it, as installed
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "scripts" / "release")]
import set_version  # noqa: E402
import tests_of  # noqa: E402

FOLDERS = ["nef", "apps", "python", "tests", "fuzz", "bench", "scripts", "docs", "data", ".ci"]
PATH = re.compile(rf"`((?:{'|'.join(FOLDERS)})/[\w./*-]+)`")
LINK = re.compile(r"\]\(([\w./-]+)(?:#[\w-]*)?\)")
CODE = re.compile(r"^```.*?^```|^ {4}.*?$", re.MULTILINE | re.DOTALL)

# A source of more lines than this opens with a comment of at least so many words, below the line of its licence.
LONG = 150
WORDS = 12
SOURCES = ["nef", "apps", "python"]

# CMake splits lists at semicolons, and Catch takes a name that begins with a dash for an option: ctest then passes
# without running the test.
TEST_NAME = re.compile(r'TEST_CASE\(\s*"((?:[^"\\]|\\.)*)"')

# Paths that stand for others.
PLACEHOLDERS = {"tests/NAME", "nef/FOLDER/NAME.cpp"}


def pages() -> list[pathlib.Path]:
    inside = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.md"))]
    return sorted(ROOT.glob("*.md")) + inside


def dead_links(page: pathlib.Path) -> list[str]:
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    dead = [link for link in LINK.findall(re.sub(r"`[^`]*`", "", text)) if not (page.parent / link).exists()]
    return [f"{page} links to {link}, which does not exist" for link in dead]


def dead_paths(page: pathlib.Path) -> list[str]:
    text = CODE.sub("", page.read_text(encoding="utf-8"))
    dead = [name for name in PATH.findall(text) if name not in PLACEHOLDERS and not any(ROOT.glob(name.rstrip("/")))]
    return [f"{page.relative_to(ROOT)} names {name}, which does not exist" for name in dead] + dead_links(page)


def unresolved_merges(page: pathlib.Path) -> list[str]:
    lines = page.read_text(encoding="utf-8").splitlines()
    return [f"{page.relative_to(ROOT)}:{number}: a merge left both versions" for number, line in enumerate(lines, 1)
            if line.startswith(("<<<<<<< ", ">>>>>>> "))]


def opening(lines: list[str]) -> str:
    words = []
    for line in lines[1:]:
        if not line.startswith("//"):
            break
        words.append(line.lstrip("/ "))
    return " ".join(words)


def silent_sources() -> list[str]:
    complaints = []
    for path in (path for folder in SOURCES for path in sorted((ROOT / folder).rglob("*"))):
        if path.suffix not in (".cpp", ".h"):
            continue
        lines = path.read_text(encoding="utf-8").splitlines()
        if len(lines) > LONG and len(opening(lines).split()) < WORDS:
            complaints.append(f"{path.relative_to(ROOT)} has {len(lines)} lines and does not begin with what it does and how")
    return complaints


def unrunnable_tests() -> list[str]:
    complaints = []
    for path in sorted((ROOT / "tests").rglob("*.cpp")):
        for name in TEST_NAME.findall(path.read_text(encoding="utf-8")):
            if ";" in name or name.startswith("-"):
                complaints.append(f"{path.relative_to(ROOT)}: ctest cannot run the test '{name}': no semicolon, no dash in front")
    return complaints


def untested_sources() -> list[str]:
    advice = "include its header in one, or name its path in a comment of the test that meets it"
    return [f"{source} is far from any test: {advice}" for source in tests_of.untested()]


def other_versions() -> list[str]:
    """Files that name another version than nef/version.h does, and a version without a section in CHANGELOG.md."""
    version = set_version.version_in("nef/version.h")
    named = {path: set_version.version_in(path) for path in set_version.PLACES}
    complaints = [f"{path} is of version {other!r}, nef/version.h of {version!r}; scripts/release/set_version.py sets both"
                  for path, other in named.items() if other != version]
    if not re.search(rf"^## {re.escape(version)}\b", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE):
        complaints.append(f"CHANGELOG.md has no section of the version {version}; scripts/release/set_version.py makes it of 'Unreleased'")
    return complaints


def main() -> int:
    if len(sys.argv) > 1:
        installed = sorted(pathlib.Path(sys.argv[1]).rglob("*.md"))
        complaints = [line for page in installed for line in dead_links(page)] or ([] if installed else ["there are no pages"])
    else:
        complaints = complaints_of_sources()
    print("\n".join(complaints), end="\n" if complaints else "")
    return 1 if complaints else 0


def complaints_of_sources() -> list[str]:
    return other_versions() + silent_sources() + untested_sources() + unrunnable_tests() + [
        line for page in pages() for line in dead_paths(page) + unresolved_merges(page)]


if __name__ == "__main__":
    sys.exit(main())
