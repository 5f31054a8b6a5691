#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts the pages of the site together for MkDocs: docs/, README as its first page, and the pages outside of docs/ that others
link to. Links are rewritten to the pages' new places; links to files that are not pages become the names of these files.

Usage: scripts/docs.py FOLDER REFERENCES      REFERENCES: text for the end of the first page
"""
import os
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Pages outside of docs/, and their names in the site.
MOVED = {"README.md": "index.md", "CONTRIBUTING.md": "CONTRIBUTING.md", "CHANGELOG.md": "CHANGELOG.md", "bench/README.md": "bench.md",
         "data/README.md": "data.md", "packaging/README.md": "packages.md", "apps/planner/README.md": "planner_examples.md",
         **{f"bench/results/{path.name}": f"results/{path.name}" for path in sorted((ROOT / "bench" / "results").glob("*.md"))}}
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([\w./-]+)(#[\w-]*)?\)")
FENCE = re.compile(r"(^```.*?^```)", re.MULTILINE | re.DOTALL)


def place(path: pathlib.Path) -> str | None:
    """Where a file of the repository is in the site; None if it is not there."""
    name = path.relative_to(ROOT).as_posix()
    if name in MOVED:
        return MOVED[name]
    return name[len("docs/"):] if name.startswith("docs/") and path.is_file() else None


def rewritten(text: str, source: pathlib.Path) -> str:
    here = pathlib.PurePosixPath(place(source) or "").parent

    def link(match: re.Match) -> str:
        mark, label, target, anchor = match.groups()
        file = (source.parent / target).resolve()
        if not file.is_relative_to(ROOT) or not file.exists():
            return match.group()
        there = place(file)
        if there is None:
            return f"{label} (`{file.relative_to(ROOT)}`)" if label != target else f"`{target}`"
        return f"{mark}[{label}]({os.path.relpath(there, here)}{anchor or ''})"

    parts = FENCE.split(text)
    return "".join(part if i % 2 else LINK.sub(link, part) for i, part in enumerate(parts))


def main() -> int:
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    pages = sorted((ROOT / "docs").rglob("*.md")) + [ROOT / name for name in MOVED if (ROOT / name).exists()]
    for page in pages:
        target = folder / (place(page) or "")
        target.parent.mkdir(parents=True, exist_ok=True)
        text = rewritten(page.read_text(encoding="utf-8"), page)
        target.write_text(text + (sys.argv[2] if target.name == "index.md" else ""), encoding="utf-8")
    shutil.copy(ROOT / "docs" / "site.css", folder)
    shutil.copytree(ROOT / "docs" / "pictures", folder / "pictures", dirs_exist_ok=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
